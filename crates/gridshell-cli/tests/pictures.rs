//! Sheets, reports and comparisons as their users get them.

use gridshell_report::colourings;
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
    for view in ["plan", "top", "front", "iso", "elevations", "perspective"] {
        done(folder.path(), &format!("draw dome.gridshell --view {view} --paper a4 -o {view}.svg"));
        let svg = text(&folder, &format!("{view}.svg"));
        assert!(svg.contains("width=\"297mm\" height=\"210mm\""), "{view}");
        assert!(svg.contains("Fluency") || svg.contains("fluency"), "{view}: figures");
        assert_eq!(svg.contains(">1:"), view != "perspective", "{view}: a scale");
        done(
            folder.path(),
            &format!("draw dome.gridshell --view {view} --paper none -o small.svg"),
        );
        let svg = text(&folder, "small.svg");
        let pixels = svg.split("width=\"").nth(1).and_then(|w| w.split('"').next());
        let pixels: f64 = pixels.and_then(|w| w.parse().ok()).expect("a width without a unit");
        assert!(pixels <= 760.0 && !svg.contains("luency"), "{view}: no sheet");
    }
    assert_eq!(text(&folder, "plan.svg"), text(&folder, "top.svg"));
    for colour in colourings::ALL.iter().map(|c| c.key).chain(["none"]) {
        let args = format!("draw dome.gridshell --color {colour} --paper a4 -o c.png -o c.pdf");
        done(folder.path(), &args);
        let png = fs::read(folder.path().join("c.png")).expect("written");
        assert_eq!(&png[1..4], b"PNG");
        // A4 at 150 dots to the inch.
        assert_eq!(png[16..24], [0, 0, 6, 218, 0, 0, 4, 217], "{colour}");
        // The pixels were once stored as they are.
        assert!(png.len() < 1754 * 1241 / 4, "{colour}: {} bytes", png.len());
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

/// A label's corners: in the middle of its place, by the widths of Helvetica, turned as the sheet says.
fn corners(line: &str) -> Option<[[f64; 2]; 4]> {
    let number = |name: &str| line.split(name).nth(1)?.split(['"', ' ', ')']).next()?.parse().ok();
    let words = line.split('>').nth(1)?.split('<').next()?;
    let width = match (words.chars().next()?, words.len() - 1) {
        ('N', digits) => 0.722 + 0.556 * digits as f64,
        ('M', digits) => 0.833 + 0.556 * digits as f64,
        ('P', digits) => 0.667 + 0.556 * digits as f64,
        _ => return None,
    };
    words[1..].parse::<usize>().ok()?;
    let size: f64 = number("font-size=\"")?;
    let at: [f64; 2] = [number("x=\"")?, number(" y=\"")?];
    let at = [at[0], at[1] - 0.36 * size];
    let turn = number("rotate(").map_or(0.0, f64::to_radians);
    let [x, y] = [0.5 * width * size, 0.36 * size];
    let turned = |[x, y]: [f64; 2]| {
        [at[0] + x * turn.cos() - y * turn.sin(), at[1] + x * turn.sin() + y * turn.cos()]
    };
    Some([[-x, -y], [x, -y], [x, y], [-x, y]].map(turned))
}

/// Whether two rectangles share a place: no side of either parts them.
fn touch(a: &[[f64; 2]; 4], b: &[[f64; 2]; 4]) -> bool {
    let sides = |r: &[[f64; 2]; 4]| [[r[0], r[1]], [r[1], r[2]]];
    sides(a).into_iter().chain(sides(b)).all(|[p, q]| {
        let along = [q[0] - p[0], q[1] - p[1]];
        let span = |r: &[[f64; 2]; 4]| {
            let places = r.map(|c| c[0] * along[0] + c[1] * along[1]);
            let low = places.iter().copied().fold(f64::INFINITY, f64::min);
            (low, places.iter().copied().fold(f64::NEG_INFINITY, f64::max))
        };
        let ((a, b), (c, d)) = (span(a), span(b));
        a < d && c < b
    })
}

#[test]
fn labels_of_all_kinds_do_not_touch_one_another() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    // The dome's rim is steep: seen from above, its panels are slivers. Of eight seeds 1 to 3.5 in a hundred touched.
    for (surface, allowed) in [("saddle", 0.0), ("hexagon", 0.0), ("dome", 0.04)] {
        let lay = format!("generate {surface} --nodes 150 --effort draft -o g.gridshell");
        done(folder.path(), &lay);
        for view in ["plan", "iso"] {
            let draw =
                format!("draw g.gridshell --view {view} --labels nodes,members,panels -o l.svg");
            done(folder.path(), &draw);
            let svg = text(&folder, "l.svg");
            let labels: Vec<_> = svg.lines().filter_map(corners).collect();
            let touching = (0..labels.len())
                .filter(|&k| labels[..k].iter().any(|other| touch(&labels[k], other)))
                .count();
            let most = allowed * labels.len() as f64;
            let told = format!("{surface}, {view}: {touching} of {}", labels.len());
            assert!(labels.len() > 200 && touching as f64 <= most, "{told}");
        }
    }
}

#[test]
fn what_is_hidden_has_no_label() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    done(folder.path(), "generate sphere --nodes 150 --effort draft -o g.gridshell");
    done(folder.path(), "draw g.gridshell --labels nodes -o l.svg");
    let labels = text(&folder, "l.svg").lines().filter_map(corners).count();
    assert!((50..100).contains(&labels), "{labels} of about 150: the upper half");
}

#[test]
fn a_name_in_any_tongue_is_on_the_sheet() {
    let folder = dome();
    let grid =
        text(&folder, "dome.gridshell").replace("\"name\": \"dome\"", "\"name\": \"Θόλος Łódź ü\"");
    fs::write(folder.path().join("name.gridshell"), grid).expect("written");
    done(folder.path(), "draw name.gridshell --paper a4 -o n.svg -o n.png -o n.pdf");
    assert!(text(&folder, "n.svg").contains("Θόλος Łódź ü"));
    done(folder.path(), "draw dome.gridshell --paper a4 -o d.png");
    let read = |name: &str| fs::read(folder.path().join(name)).expect("written");
    assert!(read("n.png") != read("d.png"));
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
fn a_report_tells_candidates_symmetry_and_parts() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let args = "generate dome --nodes 120 --effort draft --candidates 3 --symmetry x --report a.html -o a.obj";
    done(folder.path(), args);
    let page = text(&folder, "a.html");
    assert!(page.contains("Candidates: ") && page.contains("Symmetric: 1 mirror plane"));
    assert!(!page.contains("<h2>Parts"));
    let square = |x: f64| format!("v {x} 0 0\nv {} 0 0\nv {} 4 0\nv {x} 4 0\n", x + 4.0, x + 4.0);
    let two = square(0.0) + &square(9.0) + "f 1 2 3 4\nf 5 6 7 8\n";
    fs::write(folder.path().join("two.obj"), two).expect("written");
    let args = "generate two.obj --part all -l 1 --effort draft --report b.html -o b.obj";
    done(folder.path(), args);
    let page = text(&folder, "b.html");
    assert!(page.contains("<h2>Parts") && page.contains("N0 to N"));
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
