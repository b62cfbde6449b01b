//! Sheets, reports and comparisons as their users get them.

use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use tempfile::TempDir;

/// Run `gridshell` in `folder` with these arguments, split at spaces.
fn gridshell(folder: &Path, args: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_gridshell"))
        .args(args.split_whitespace())
        .current_dir(folder)
        .output()
        .expect("the command starts")
}

fn done(folder: &Path, args: &str) -> String {
    let output = gridshell(folder, args);
    assert!(output.status.success(), "{args}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// A folder with a grid on a dome.
fn dome() -> TempDir {
    let folder = tempfile::tempdir().expect("a folder for the test");
    done(folder.path(), "generate dome --nodes 120 --effort draft -o dome.gridshell");
    folder
}

fn text(folder: &TempDir, name: &str) -> String {
    fs::read_to_string(folder.path().join(name)).expect("written")
}

#[test]
fn every_view_and_every_colour_gives_a_sheet_in_every_format() {
    let folder = dome();
    for view in ["plan", "top", "front", "iso", "elevations"] {
        done(folder.path(), &format!("draw dome.gridshell --view {view} --paper a4 -o {view}.svg"));
        let svg = text(&folder, &format!("{view}.svg"));
        assert!(svg.contains("width=\"297mm\" height=\"210mm\""), "{view}");
        assert!(svg.contains("Fluency") || svg.contains("fluency"), "{view}: figures");
        assert!(svg.contains(">1:"), "{view}: a scale");
    }
    assert_eq!(text(&folder, "plan.svg"), text(&folder, "top.svg"));
    for colour in ["length", "degree", "disfluency", "shape", "none"] {
        let args = format!("draw dome.gridshell --color {colour} --paper a4 -o c.png -o c.pdf");
        done(folder.path(), &args);
        let png = fs::read(folder.path().join("c.png")).expect("written");
        assert_eq!(&png[1..4], b"PNG");
        // A4 at 150 dots to the inch.
        assert_eq!(png[16..24], [0, 0, 6, 218, 0, 0, 4, 217], "{colour}");
        let pdf = fs::read(folder.path().join("c.pdf")).expect("written");
        assert!(pdf.starts_with(b"%PDF-") && pdf.ends_with(b"%%EOF"), "{colour}");
    }
}

#[test]
fn every_element_gets_its_number() {
    let folder = dome();
    let document: Value = serde_json::from_str(&text(&folder, "dome.gridshell")).expect("JSON");
    done(folder.path(), "draw dome.gridshell --labels nodes,members,panels -o l.svg");
    let svg = text(&folder, "l.svg");
    let (nodes, panels) = (&document["nodes"], &document["panels"]);
    let [nodes, panels] = [nodes, panels].map(|list| list.as_array().expect("a list").len());
    // Euler: a disc.
    let members = nodes + panels - 1;
    for (letter, count) in [("N", nodes), ("M", members), ("P", panels)] {
        assert!(svg.contains(&format!(">{letter}{}<", count - 1)), "{letter}");
        assert!(!svg.contains(&format!(">{letter}{count}<")), "{letter}");
    }
}

#[test]
fn a_scale_is_true() {
    // A hexagon of side 1 is 2 m wide: at 1:4 that is 500 mm.
    let folder = tempfile::tempdir().expect("a folder for the test");
    let h = 0.75f64.sqrt();
    let mut obj = "v 0 0 0\n".to_owned();
    for (x, y) in [(1.0, 0.0), (0.5, h), (-0.5, h), (-1.0, 0.0), (-0.5, -h), (0.5, -h)] {
        obj += &format!("v {x} {y} 0\n");
    }
    for k in 0..6 {
        obj += &format!("f 1 {} {}\n", 2 + k, 2 + (k + 1) % 6);
    }
    fs::write(folder.path().join("six.obj"), obj).expect("written");
    done(folder.path(), "draw six.obj --color none -o six.svg");
    let svg = text(&folder, "six.svg");
    assert!(svg.contains(">1:4<"), "the scale is told");
    let lines = svg.lines().filter(|l| l.starts_with("<polyline"));
    let ends = |line: &str| -> Option<[[f64; 2]; 2]> {
        let points = line.split("points=\"").nth(1)?.split('"').next()?;
        let numbers: Vec<f64> = points.split([' ', ',']).filter_map(|x| x.parse().ok()).collect();
        (numbers.len() == 4).then(|| [[numbers[0], numbers[1]], [numbers[2], numbers[3]]])
    };
    let long = |[a, b]: [[f64; 2]; 2]| ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)).sqrt();
    let members = lines.filter_map(ends).filter(|&m| (long(m) - 250.0).abs() < 0.02).count();
    assert_eq!(members, 12);
}

#[test]
fn a_report_needs_nothing_else_and_holds_the_whole_run() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let args = "generate dome --nodes 120 --effort draft --report dome.html -o dome.obj";
    done(folder.path(), args);
    let page = text(&folder, "dome.html");
    for foreign in ["src=", "<link", "@import", "url(", "https://", "fetch("] {
        assert!(!page.contains(foreign), "{foreign}");
    }
    for (start, end) in [("<svg", "</svg>"), ("<section", "</section>"), ("<script", "</script>")] {
        assert_eq!(page.matches(start).count(), page.matches(end).count(), "{start}");
    }
    for part in ["Stages", "Fluency Q", "regularize", "Recipe", "seed = 1", "Plan", "canvas"] {
        assert!(page.contains(part), "{part}");
    }
    assert!(page.len() < 1_000_000, "{} bytes", page.len());
}

#[test]
fn grids_are_compared_and_the_best_is_marked() {
    let folder = dome();
    done(folder.path(), "generate dome --nodes 60 --effort draft -o small.gridshell");
    let table = done(folder.path(), "compare dome.gridshell small.gridshell --html c.html");
    assert!(table.lines().next().is_some_and(|l| l.contains("dome") && l.contains("small")));
    let fluency = table.lines().find(|l| l.starts_with("fluency")).expect("a row");
    assert_eq!(fluency.matches('*').count(), 1, "{fluency}");
    assert!(text(&folder, "c.html").matches("class=\"best\"").count() > 3);
    let json = done(folder.path(), "compare dome.gridshell small.gridshell --json");
    let json: Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json["grids"].as_array().map(Vec::len), Some(2));
    // A grid beside itself is no better.
    let table = done(folder.path(), "compare dome.gridshell dome.gridshell");
    assert!(table.lines().filter(|l| !l.starts_with('*')).all(|l| !l.contains('*')), "{table}");
}

#[test]
fn what_cannot_be_drawn_is_refused_before_the_work() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    for args in [
        "draw none.obj -o a.jpg",
        "draw none.obj -o a.svg --view above",
        "generate dome --report a.txt",
        "generate dome --report nowhere/a.html",
        "compare none.obj --html a.txt",
        "compare",
    ] {
        assert_eq!(gridshell(folder.path(), args).status.code(), Some(2), "{args}");
    }
}
