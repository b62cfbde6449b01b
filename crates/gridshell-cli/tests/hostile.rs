//! Whatever is handed to the command, it answers in words: devices and pipes, paths in grid files, recipes, terminals that
//! are gone, too many threads and points.
#![cfg(unix)]

use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

const PROGRAM: &str = env!("CARGO_BIN_EXE_gridshell");

fn gridshell(folder: &Path, args: &str) -> Output {
    let mut command = Command::new(PROGRAM);
    command.args(args.split_whitespace()).current_dir(folder).output().expect("the command starts")
}

fn shell(folder: &Path, line: &str) -> Output {
    let mut command = Command::new("sh");
    command.args(["-c", line, PROGRAM]).current_dir(folder).output().expect("a shell")
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn folder() -> TempDir {
    tempfile::tempdir().expect("a folder for the test")
}

/// Run with an end: what waits for a pipe would wait for ever.
fn ends(folder: &Path, args: &str) -> (i32, String) {
    let mut command = Command::new(PROGRAM);
    command.args(args.split_whitespace()).current_dir(folder);
    let mut run = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("it starts");
    let begun = Instant::now();
    while run.try_wait().expect("a child").is_none() {
        if begun.elapsed() > Duration::from_secs(60) {
            run.kill().expect("a child");
            panic!("{args}: it does not end");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let output = run.wait_with_output().expect("it has ended");
    (output.status.code().expect("ended by itself"), stderr(&output))
}

#[test]
fn devices_and_pipes_are_refused_wherever_a_file_is_read() {
    let folder = folder();
    let made = Command::new("mkfifo").arg("pipe").current_dir(folder.path()).status();
    assert!(made.expect("mkfifo is there").success());
    for name in
        ["obj", "ply", "stl", "off", "glb", "json", "step", "igs", "3dm", "gridshell", "toml"]
    {
        symlink("/dev/zero", folder.path().join(format!("zero.{name}"))).expect("room");
        symlink("pipe", folder.path().join(format!("pipe.{name}"))).expect("room");
    }
    for device in ["zero", "pipe"] {
        let mut all: Vec<String> =
            ["obj", "ply", "stl", "off", "glb", "json", "step", "igs", "3dm"]
                .map(|end| format!("inspect {device}.{end}"))
                .to_vec();
        all.extend(["guides", "anchors", "size", "direction", "supports", "recipe"].map(
            |option| format!("generate hexagon -l 1 --effort draft --{option} {device}.toml"),
        ));
        all.push(format!("generate {device}.gridshell"));
        all.push(format!("measure {device}.gridshell"));
        all.push(format!("edit {device}.obj --log {device}.json"));
        for args in all {
            let (code, said) = ends(folder.path(), &args);
            assert_eq!(code, 3, "{args}: {said}");
            assert!(
                said.contains("a device or a pipe") || said.contains("without Rhino"),
                "{args}: {said}"
            );
        }
    }
}

#[test]
fn a_grid_file_is_not_followed_out_of_its_folder_unless_asked() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("in")).expect("room");
    let square = "v 0 0 0\nv 8 0 0\nv 8 8 0\nv 0 8 0\nf 1 2 3 4\n";
    fs::write(at("out.obj"), square).expect("room");
    fs::write(at("in/near.obj"), square).expect("room");
    let inner = at("in");
    let whole = at("out.obj").display().to_string();
    for (surface, follows) in [("near.obj", true), ("../out.obj", false), (whole.as_str(), false)] {
        let laid = format!("generate {surface} -l 1 --effort draft -o a.gridshell");
        assert_eq!(gridshell(&inner, &laid).status.code(), Some(0), "{surface}");
        let run = gridshell(&inner, "generate a.gridshell -o b.obj");
        assert_eq!(
            run.status.code(),
            Some(if follows { 0 } else { 3 }),
            "{surface}: {}",
            stderr(&run)
        );
        assert_eq!(stderr(&run).contains("--follow"), !follows, "{surface}");
        let measured = stderr(&gridshell(&inner, "measure a.gridshell"));
        assert_eq!(measured.contains("--follow"), !follows, "{surface}: {measured}");
        for args in ["generate a.gridshell --follow -o b.obj", "measure a.gridshell --follow"] {
            let run = gridshell(&inner, args);
            assert_eq!(run.status.code(), Some(0), "{args}: {}", stderr(&run));
            assert!(!stderr(&run).contains("its own surface"), "{args}");
        }
    }
    // A device named in a grid file is not read even then.
    let text = fs::read_to_string(at("in/a.gridshell")).expect("written");
    fs::write(at("in/evil.gridshell"), text.replace(&whole, "/dev/zero")).expect("written");
    let (code, said) = ends(&inner, "measure evil.gridshell --follow");
    assert!(code == 0 && said.contains("a device or a pipe"), "{said}");
}

#[test]
fn recipes_with_wrong_types_and_wrong_values_leave_with_2() {
    let folder = folder();
    for (k, text) in [
        "seed = \"seven\"\n",
        "edge_length = true\n",
        "[pack]\ndrews = 3\n",
        "[regularize]\ntemperature = [nan, 0]\n",
        "[regularize]\ntemperature = [0.1, 0.0]\n",
        "[regularize]\nresidual_weight = nan\n",
        "[relax]\nstraightness = inf\n",
        "[pack]\nxi = -inf\n",
        "edge_length = nan\n",
        "border = 2\n",
        "anchors = [[0, nan, 0]]\n",
        "this is not toml",
    ]
    .iter()
    .enumerate()
    {
        let file = format!("{k}.toml");
        fs::write(folder.path().join(&file), text).expect("written");
        let run = gridshell(folder.path(), &format!("generate hexagon -n 60 --recipe {file}"));
        assert_eq!(run.status.code(), Some(2), "{text}: {}", stderr(&run));
        assert!(stderr(&run).contains(&file), "{text}: {}", stderr(&run));
    }
}

#[test]
fn a_terminal_that_is_gone_changes_no_exit_code_and_panics_nobody() {
    let folder = folder();
    for (line, code) in [
        ("exec \"$0\" nosuch 2>/dev/full", 2),
        ("exec \"$0\" generate nosuch.obj 2>/dev/full", 3),
        ("exec \"$0\" generate nosuch.obj 2>&-", 3),
        ("exec \"$0\" inspect dome 2>&-", 0),
        ("exec \"$0\" --help", 0),
        ("exec \"$0\" --version", 0),
        ("exec \"$0\" --help >/dev/full", 1),
        ("exec \"$0\" generate --help >/dev/full", 1),
        ("exec \"$0\" --version >/dev/full", 1),
        ("exec \"$0\" surfaces >/dev/full", 1),
        ("exec \"$0\"", 2),
    ] {
        let run = shell(folder.path(), line);
        assert_eq!(run.status.code(), Some(code), "{line}: {}", stderr(&run));
        assert!(!stderr(&run).contains("panicked"), "{line}: {}", stderr(&run));
    }
}

#[test]
fn a_file_that_may_not_grow_is_an_error_and_no_signal() {
    let folder = folder();
    for (args, file) in [
        ("generate hexagon -n 400 --effort draft -o a.ifc", "a.ifc"),
        ("generate hexagon -n 400 --effort draft -o a.obj", "a.obj"),
        ("inspect dome --picture a.png", "a.png"),
    ] {
        let run = shell(folder.path(), &format!("ulimit -f 4; exec \"$0\" {args}"));
        let said = stderr(&run);
        assert_eq!(run.status.code(), Some(1), "{args}: {said}");
        assert!(said.contains(file), "{args}: {said}");
        assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 0, "{args}");
    }
}

#[test]
fn every_output_that_fails_is_named_the_report_too() {
    let folder = folder();
    let args =
        "generate hexagon -n 400 --effort draft -o a.ifc -o a.saf.xlsx -o a.csv --report a.html";
    let run = shell(folder.path(), &format!("ulimit -f 4; exec \"$0\" {args}"));
    let said = stderr(&run);
    assert_eq!(run.status.code(), Some(1), "{said}");
    for file in ["a.ifc", "a.html"] {
        assert!(said.contains(file), "{file}: {said}");
    }
    let run = shell(
        folder.path(),
        "ulimit -f 4; exec \"$0\" inspect dome --picture a.png --picture b.png",
    );
    assert!(stderr(&run).contains("a.png") && stderr(&run).contains("b.png"), "{}", stderr(&run));
}

#[test]
fn too_many_threads_are_told_and_cut_down() {
    let folder = folder();
    for line in [
        "exec \"$0\" generate hexagon -n 60 --effort draft --threads 1000 -o a.obj",
        "RAYON_NUM_THREADS=100000 exec \"$0\" generate hexagon -n 60 --effort draft -o a.obj",
        "RAYON_NUM_THREADS=100000 exec \"$0\" inspect dome",
    ] {
        let run = shell(folder.path(), line);
        assert_eq!(run.status.code(), Some(0), "{line}: {}", stderr(&run));
        assert!(stderr(&run).contains("are used"), "{line}: {}", stderr(&run));
    }
    let run =
        gridshell(folder.path(), "generate hexagon -n 60 --effort draft --threads 2 -o a.obj");
    assert!(!stderr(&run).contains("threads"), "{}", stderr(&run));
}

#[test]
fn guides_of_very_many_points_take_no_longer_than_others() {
    let folder = folder();
    let mut grids = Vec::new();
    for n in [2_000, 20_000, 100_000] {
        let mut text = String::new();
        for k in 0..n {
            let t = f64::from(k) / f64::from(n - 1);
            let x = 5.0 * t - 2.5;
            text += &format!("{x} {} 0\n", 1.5 * (1.2 * x).sin());
        }
        fs::write(folder.path().join("guide.txt"), text).expect("written");
        let args = format!("generate hexagon -l 0.5 --effort draft --guides guide.txt -o {n}.obj");
        let begun = Instant::now();
        let (code, said) = ends(folder.path(), &args);
        assert_eq!(code, 0, "{said}");
        grids.push((n, begun.elapsed()));
    }
    let [first, .., last] = grids.as_slice() else { unreachable!() };
    assert!(last.1 < 4 * first.1 + Duration::from_secs(5), "{grids:?}");
}

#[test]
fn an_anchor_given_very_often_is_one() {
    let folder = folder();
    let anchor = |n: usize, name: &str| {
        fs::write(folder.path().join("anchors.txt"), "0.31 0.42 0\n".repeat(n)).expect("written");
        let args = format!("generate hexagon -l 1 --effort draft --anchors anchors.txt -o {name}");
        let begun = Instant::now();
        let (code, said) = ends(folder.path(), &args);
        assert_eq!(code, 0, "{said}");
        (begun.elapsed(), fs::read(folder.path().join(name)).expect("written"))
    };
    let (one, many) = (anchor(1, "1.obj"), anchor(90_000, "2.obj"));
    assert!(one.1 == many.1 && many.0 < 4 * one.0 + Duration::from_secs(5), "{:?}", many.0);
}

#[test]
fn what_is_replaced_keeps_its_mode_and_links_and_devices_are_left_as_they_are() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    let convert = |name: &str| gridshell(folder.path(), &format!("convert grid.obj -o {name}"));
    let laid = gridshell(folder.path(), "generate hexagon -l 1 --effort draft -o grid.obj");
    assert_eq!(laid.status.code(), Some(0), "{}", stderr(&laid));
    for (name, mode) in [("a.obj", 0o600), ("a.ply", 0o660), ("a.gridshell", 0o640)] {
        fs::write(at(name), "old").expect("room");
        fs::set_permissions(at(name), PermissionsExt::from_mode(mode)).expect("own file");
        assert_eq!(convert(name).status.code(), Some(0), "{name}");
        assert_eq!(
            fs::metadata(at(name)).expect("there").permissions().mode() & 0o777,
            mode,
            "{name}"
        );
        assert_ne!(fs::read(at(name)).expect("readable"), b"old", "{name}");
    }
    symlink("a.ply", at("link.ply")).expect("room");
    assert_eq!(convert("link.ply").status.code(), Some(0));
    assert!(at("link.ply").is_symlink() && !at("a.ply").is_symlink());
    symlink("/dev/null", at("null.obj")).expect("room");
    symlink("nowhere.obj", at("dangling.obj")).expect("room");
    fs::write(at("fixed.obj"), "old").expect("room");
    fs::set_permissions(at("fixed.obj"), PermissionsExt::from_mode(0o444)).expect("own file");
    for name in ["null.obj", "dangling.obj", "fixed.obj"] {
        let run = convert(name);
        assert_eq!(run.status.code(), Some(2), "{name}: {}", stderr(&run));
    }
    assert_eq!(fs::read(at("fixed.obj")).expect("readable"), b"old");
    // As long as the file system takes it, hidden names beside it included.
    for length in [200, 240, 255] {
        let name = "n".repeat(length - 4) + ".obj";
        assert_eq!(convert(&name).status.code(), Some(0), "{length}");
        assert!(at(&name).is_file(), "{length}");
    }
}
