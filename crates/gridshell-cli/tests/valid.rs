//! Grids that are not valid, as users of the command meet them; and borders that touch, as engineers do.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn gridshell(folder: &Path, args: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_gridshell"))
        .args(args.split_whitespace())
        .current_dir(folder)
        .output()
        .expect("the command starts")
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("ended by itself")
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn read(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).expect("written")
}

#[test]
fn no_valid_grid_leaves_with_4_unless_it_is_kept_and_then_every_file_is_marked() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    for (surface, nodes) in [("sphere", 4), ("sphere", 8), ("dome", 4)] {
        let args = format!(
            "generate {surface} -n {nodes} --effort draft -o a.obj -o a.gridshell -o a.ply -o a.tcl"
        );
        let refused = gridshell(at, &args);
        assert_eq!(code(&refused), 4, "{}", said(&refused));
        assert!(said(&refused).contains("area") && said(&refused).contains("edge length"));
        assert!(!at.join("a.obj").exists(), "nothing is written");

        let kept = gridshell(at, &format!("{args} --keep-invalid --json --report a.html"));
        assert_eq!(code(&kept), 0, "{}", said(&kept));
        let run: serde_json::Value = serde_json::from_slice(&kept.stdout).expect("a document");
        assert_eq!(run["valid"], false);
        assert!(run["faults"].as_array().is_some_and(|f| !f.is_empty()));
        assert!(run["warnings"].to_string().contains("not valid"), "{}", run["warnings"]);
        for file in ["a.obj", "a.ply", "a.tcl", "a.html"] {
            assert!(read(at, file).contains("NOT VALID"), "{file}");
        }
        assert!(read(at, "a.gridshell").contains("\"invalid\""));
        // It stays marked in every format that it is converted to, and repeats as it was made.
        let converted = gridshell(at, "convert a.gridshell -o b.obj");
        assert_eq!(code(&converted), 0, "{}", said(&converted));
        assert!(said(&converted).contains("not valid") && read(at, "b.obj").contains("NOT VALID"));
        let measured = gridshell(at, "measure a.gridshell --json");
        let measured: serde_json::Value =
            serde_json::from_slice(&measured.stdout).expect("a document");
        assert_eq!(measured["valid"], false);
        for file in ["a.obj", "a.gridshell", "a.ply", "a.tcl", "a.html", "b.obj"] {
            fs::remove_file(at.join(file)).expect("written before");
        }
    }
}

#[test]
fn a_node_of_a_file_that_is_off_the_surface_is_seen_however_far_its_plane_goes_on() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    for far in [0.2, 3.0, 96.0] {
        let x = 4.0 + far;
        let grid = format!("v 0 0 0\nv {x} 0 0\nv 2 3 0\nf 1 2 3\n");
        fs::write(at.join("far.obj"), grid).expect("written");
        let measured = gridshell(at, "measure far.obj -s hexagon --json");
        let measured: serde_json::Value =
            serde_json::from_slice(&measured.stdout).expect("a document");
        let length = measured["edge_length"].as_f64().expect("a length");
        let off = measured["quality"]["surface_deviation"].as_f64().expect("a share") * length;
        assert!(off > 0.8 * far && off < 1.01 * far, "{off} for {far}");
        assert_eq!(measured["valid"], false);
    }
}

/// A square of `n` by `n` squares without these.
fn pierced(n: usize, holes: &[(usize, usize)], side: f64) -> String {
    let mut text = String::new();
    for j in 0..=n {
        for i in 0..=n {
            text += &format!("v {} {} 0\n", side * i as f64, side * j as f64);
        }
    }
    for j in 0..n {
        for i in (0..n).filter(|&i| !holes.contains(&(i, j))) {
            let v = j * (n + 1) + i + 1;
            text += &format!("f {v} {} {} {}\n", v + 1, v + n + 2, v + n + 1);
        }
    }
    text
}

#[test]
fn where_openings_touch_in_a_point_structural_files_have_one_joint() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    let cases: [(usize, &[(usize, usize)], f64); 3] = [
        (5, &[(1, 1), (2, 2)], 2.0),
        (6, &[(1, 3), (2, 2), (3, 1)], 20.0),
        (7, &[(1, 1), (2, 2), (3, 1), (5, 5)], 0.3),
    ];
    for (n, holes, side) in cases {
        fs::write(at.join("holes.obj"), pierced(n, holes, side)).expect("written");
        let length = 0.5 * side;
        let made = gridshell(
            at,
            &format!("generate holes.obj -l {length} --effort draft -o a.obj -o a.tcl -o a.ifc"),
        );
        assert_eq!(code(&made), 0, "{}", said(&made));
        let grid = read(at, "a.obj");
        let nodes: Vec<&str> = grid.lines().filter(|l| l.starts_with("v ")).collect();
        let joints = nodes.iter().collect::<BTreeSet<_>>().len();
        assert!(joints < nodes.len(), "the surface has two nodes where openings touch");
        let tcl = read(at, "a.tcl");
        assert_eq!(tcl.lines().filter(|l| l.starts_with("node ")).count(), joints);
        assert_eq!(read(at, "a.ifc").matches("=IFCSTRUCTURALPOINTCONNECTION(").count(), joints);
        let known: BTreeSet<&str> =
            tcl.lines().filter_map(|l| l.strip_prefix("node ")?.split(' ').next()).collect();
        for line in tcl.lines().filter(|l| l.starts_with("element ")) {
            let words: Vec<&str> = line.split(' ').collect();
            assert!(known.contains(words[3]) && known.contains(words[4]), "{line}");
        }
    }
}
