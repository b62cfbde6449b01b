//! Outputs appear whole or not at all, whatever comes between.
#![cfg(unix)]

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

const PROGRAM: &str = env!("CARGO_BIN_EXE_gridshell");

/// Every way to write, and the files that come of it.
const WRITING: [(&str, &[&str]); 10] = [
    ("convert grid.off -o a.gridshell -o a.obj", &["a.gridshell"]),
    ("convert grid.off -o a.saf.xlsx", &["a.saf.xlsx"]),
    (
        "convert grid.off -o a.csv",
        &["a.nodes.csv", "a.members.csv", "a.panels.csv", "a.summary.csv"],
    ),
    ("edit grid.off -o a.glb", &["a.glb"]),
    ("measure grid.off --report a.html", &["a.html"]),
    ("compare grid.off grid.off --html a.html", &["a.html"]),
    ("draw grid.off --paper a4 -o a.svg", &["a.svg"]),
    ("draw grid.off --paper a4 -o a.png -o a.pdf", &["a.png"]),
    ("inspect dome --picture a.svg", &["a.svg"]),
    ("generate dome --nodes 60 --effort draft -o a.ifc --report a.html", &["a.ifc", "a.html"]),
];

/// A folder with a flat lattice of `side` by `side` nodes.
fn folder(side: usize) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let mut text = format!("OFF\n{} {} 0\n", side * side, 2 * (side - 1) * (side - 1));
    for k in 0..side * side {
        let (x, y) = ((k % side) as f64, (k / side) as f64);
        text += &format!("{} {} 0\n", x + 0.5 * y, 0.75f64.sqrt() * y);
    }
    for k in 0..side * (side - 1) {
        if k % side + 1 < side {
            let (b, c) = (k + 1, k + side);
            text += &format!("3 {k} {b} {c}\n3 {b} {} {c}\n", c + 1);
        }
    }
    fs::write(folder.path().join("grid.off"), text).expect("written");
    folder
}

/// Names in the folder, the hidden ones too.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("readable").flatten();
    let mut names: Vec<String> =
        entries.map(|e| e.file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

fn is_old(folder: &Path, file: &str, args: &str) {
    assert_eq!(fs::read(folder.join(file)).expect("still there"), b"old", "{args}: {file}");
}

#[test]
fn a_disk_that_is_full_leaves_the_old_files_and_nothing_else() {
    for (args, files) in WRITING {
        let folder = folder(20);
        for file in files {
            fs::write(folder.path().join(file), "old").expect("written");
        }
        let before = names(folder.path());
        // No file may grow beyond four kilobytes; the signal for it is left out, so that writing fails.
        let limited = format!("trap '' XFSZ; ulimit -f 8; exec \"$0\" {args}");
        let shell = Command::new("sh")
            .args(["-c", &limited, PROGRAM])
            .current_dir(folder.path())
            .output()
            .expect("a shell");
        let said = String::from_utf8_lossy(&shell.stderr);
        assert_eq!(shell.status.code(), Some(1), "{args}: {said}");
        assert!(said.contains("gridshell: a."), "{args}: {said}");
        for file in files {
            is_old(folder.path(), file, args);
        }
        assert_eq!(names(folder.path()), before, "{args}: nothing is left over");
    }
}

#[test]
fn an_output_that_fails_does_not_keep_the_others_from_being_written() {
    let folder = folder(20);
    // No file may grow beyond twenty kilobytes: the plain one does not.
    let args =
        "trap '' XFSZ; ulimit -f 40; exec \"$0\" convert grid.off -o a.ifc -o a.off -o b.ifc";
    let shell = Command::new("sh").args(["-c", args, PROGRAM]).current_dir(folder.path()).output();
    let shell = shell.expect("a shell");
    let said = String::from_utf8_lossy(&shell.stderr);
    assert_eq!(shell.status.code(), Some(1), "{said}");
    assert!(
        said.contains("wrote a.off") && said.contains("a.ifc") && said.contains("b.ifc"),
        "{said}"
    );
    assert_eq!(names(folder.path()), ["a.off", "grid.off"]);
}

#[test]
fn a_folder_in_the_way_is_told_before_the_work() {
    for (args, files) in WRITING {
        for file in files {
            let folder = folder(3);
            fs::create_dir(folder.path().join(file)).expect("a folder");
            let before = names(folder.path());
            let mut command = Command::new(PROGRAM);
            let run = command.args(args.split(' ')).current_dir(folder.path()).output();
            let run = run.expect("the command starts");
            assert_eq!(run.status.code(), Some(2), "{args}");
            assert!(String::from_utf8_lossy(&run.stderr).contains("is a folder"), "{args}");
            assert_eq!(names(folder.path()), before, "{args}: nothing was written");
        }
    }
}

#[test]
fn killed_at_any_time_it_leaves_the_old_file_or_the_new_one() {
    let folder = folder(60);
    let file = folder.path().join("a.ifc");
    let start = || {
        let mut command = Command::new(PROGRAM);
        command.args(["convert", "grid.off", "-o", "a.ifc"]).current_dir(folder.path());
        command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("the command starts")
    };
    let begun = Instant::now();
    assert!(start().wait().expect("it ends").success());
    let (took, new) = (begun.elapsed(), fs::read(&file).expect("written"));
    for k in 1..=12 {
        fs::write(&file, "old").expect("written");
        let mut run = start();
        std::thread::sleep(took * k / 12 + Duration::from_millis(1));
        // It may have ended already.
        let _ = run.kill();
        run.wait().expect("it ends");
        let now = fs::read(&file).expect("still there");
        assert!(now == b"old" || now == new, "killed after {k} twelfths: {} bytes", now.len());
    }
}
