//! The command as its users meet it: exit codes, what is printed where, what is written.

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

fn folder() -> TempDir {
    tempfile::tempdir().expect("a folder for the test")
}

fn code(output: &Output) -> i32 {
    output.status.code().expect("ended by itself")
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("UTF-8")
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("UTF-8")
}

fn document(output: &Output) -> Value {
    assert_eq!(code(output), 0, "{}", stderr(output));
    serde_json::from_str(&stdout(output)).expect("one JSON document and nothing else")
}

/// A hexagon of six equilateral panels of side 1, and its file.
fn write_hexagon(folder: &Path) {
    let h = 0.75f64.sqrt();
    let mut text = "v 0 0 0\n".to_owned();
    for (x, y) in [(1.0, 0.0), (0.5, h), (-0.5, h), (-1.0, 0.0), (-0.5, -h), (0.5, -h)] {
        text += &format!("v {x} {y} 0\n");
    }
    for k in 0..6 {
        text += &format!("f 1 {} {}\n", 2 + k, 2 + (k + 1) % 6);
    }
    fs::write(folder.join("six.obj"), text).expect("written");
}

#[test]
fn usage_errors_leave_with_2() {
    let folder = folder();
    for args in [
        "",
        "conjure",
        "generate hexagon --edge-length 0",
        "generate hexagon --edge-length -1",
        "generate hexagon --edge-length nan",
        "generate hexagon --edge-length 1 --nodes 61",
        "generate hexagon --nodes 0",
        "generate hexagon --nodes 999999999999",
        "generate hexagon --threads 0",
        "generate hexagon --time-limit 0",
        "generate hexagon --method magic",
        "generate hexagon -o grid.docx",
        "generate hexagon -o nowhere/grid.obj",
    ] {
        let output = gridshell(folder.path(), args);
        assert_eq!(code(&output), 2, "{args}: {}", stderr(&output));
        assert!(!output.stderr.is_empty() && output.stdout.is_empty(), "{args}");
    }
    assert_eq!(fs::read_dir(folder.path()).expect("readable").count(), 0, "nothing was written");
}

#[test]
fn inputs_that_cannot_be_used_leave_with_3() {
    let folder = folder();
    fs::write(folder.path().join("broken.obj"), "v 0 0\nf 1 2 9\n").expect("written");
    fs::write(folder.path().join("drawing.docx"), "no surface").expect("written");
    fs::write(folder.path().join("square.obj"), "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
        .expect("written");
    for args in [
        "generate great-cart",
        "generate broken.obj",
        "generate drawing.docx",
        "generate hexagon --recipe none.toml",
        "inspect none.step",
        "measure none.obj",
        "measure broken.obj",
        "measure square.obj",
    ] {
        let output = gridshell(folder.path(), args);
        assert_eq!(code(&output), 3, "{args}: {}", stderr(&output));
        assert!(stderr(&output).starts_with("gridshell: "), "{args}: {}", stderr(&output));
        assert!(output.stdout.is_empty(), "{args}");
    }
}

#[test]
fn a_damaged_grid_file_is_told_with_its_line_and_what_is_wrong() {
    let folder = folder();
    let run = gridshell(folder.path(), "generate hexagon -l 1 --effort draft -o a.gridshell");
    assert_eq!(code(&run), 0, "{}", stderr(&run));
    let text = fs::read_to_string(folder.path().join("a.gridshell")).expect("written");
    for (damaged, told) in [
        (&text[..text.len() / 2], "was cut off"),
        ("", "it is empty"),
        ("{}", "not a grid file of gridshell: missing field `schema`"),
        (&text.replace("\"nodes\": [", "\"nodes\": [\n[1, 2],"), "not a grid file of gridshell"),
        (
            &text.replace("\"panels\": [", "\"panels\": [\n[0, 1, 999],"),
            "panel 0: it uses node 999",
        ),
        (&text.replace("gridshell.grid/1", "gridshell.grid/9"), "use the version of gridshell"),
    ] {
        fs::write(folder.path().join("b.gridshell"), damaged).expect("written");
        for command in
            ["convert b.gridshell -o b.obj", "measure b.gridshell", "generate b.gridshell"]
        {
            let run = gridshell(folder.path(), command);
            let said = stderr(&run);
            assert_eq!(code(&run), 3, "{command}: {said}");
            assert!(said.starts_with("gridshell: b.gridshell: ") && said.contains(told), "{said}");
        }
    }
    let run = gridshell(folder.path(), "convert a.ifc -o b.obj");
    assert!(stderr(&run).contains("is not one of gridshell, obj"), "{}", stderr(&run));
}

#[test]
fn an_unknown_surface_is_answered_with_the_known_ones() {
    let output = gridshell(folder().path(), "generate great-cart");
    assert!(stderr(&output).contains("great-court"), "{}", stderr(&output));
}

#[test]
fn a_misspelt_option_in_a_recipe_is_shown_with_its_line() {
    let folder = folder();
    fs::write(folder.path().join("bad.toml"), "seed = 3\n[pack]\ndrews = 3\n").expect("written");
    let output = gridshell(folder.path(), "generate hexagon --recipe bad.toml");
    assert!(
        stderr(&output).contains("line 3") && stderr(&output).contains("draws"),
        "{}",
        stderr(&output)
    );
}

#[test]
fn surfaces_lists_the_built_in_ones() {
    let output = gridshell(folder().path(), "surfaces");
    assert_eq!(code(&output), 0);
    for name in
        ["great-court", "hexagon", "dome", "saddle", "barrel", "torus", "sphere", "roof", "facade"]
    {
        assert!(stdout(&output).lines().any(|l| l.starts_with(name)), "{name}");
    }
}

#[test]
fn a_grid_is_measured_by_itself() {
    let folder = folder();
    write_hexagon(folder.path());
    let document = document(&gridshell(folder.path(), "measure six.obj --json"));
    assert_eq!(document["schema"], "gridshell.measure/1");
    let quality = &document["quality"];
    assert_eq!((quality["nodes"].as_u64(), quality["panels"].as_u64()), (Some(7), Some(6)));
    assert_eq!(quality["mu"], 0.0);
    assert!(quality["fluency"].is_null(), "infinite on a perfect lattice");
    let people = gridshell(folder.path(), "measure six.obj");
    assert_eq!(code(&people), 0);
    assert!(stdout(&people).contains("7 nodes, 12 members, 6 panels"), "{}", stdout(&people));
}

#[test]
fn a_mesh_is_inspected() {
    let folder = folder();
    write_hexagon(folder.path());
    let document = document(&gridshell(folder.path(), "inspect six.obj --json"));
    let surface = &document["surface"];
    assert_eq!((surface["loops"].as_u64(), surface["corners"].as_u64()), (Some(1), Some(6)));
    assert!((surface["area"].as_f64().expect("a number") - 1.5 * 3f64.sqrt()).abs() < 1e-9);
    assert_eq!(surface["box"]["max"][0], 1.0);
}

#[test]
fn a_run_prints_one_document_and_writes_every_output() {
    let folder = folder();
    let run = gridshell(
        folder.path(),
        "generate hexagon --edge-length 1 --json -o a.obj -o b.ply -o c.stl -o d.off",
    );
    let document = document(&run);
    assert_eq!(document["schema"], "gridshell.run/1");
    assert_eq!((&document["seed"], &document["units"]), (&Value::from(1), &Value::from("m")));
    let names: Vec<_> =
        document["stages"].as_array().expect("a list").iter().map(|s| s["name"].clone()).collect();
    assert_eq!(names, ["pack", "triangulate", "regularize", "relax"]);
    let quality = document["quality"].as_object().expect("an object");
    for field in [
        "nodes",
        "members",
        "panels",
        "interior_nodes",
        "boundary_nodes",
        "euler_characteristic",
        "edge_length",
        "shape",
        "irregular",
        "mu",
        "mu_floor",
        "delta_deg",
        "delta_floor_deg",
        "rho",
        "fluency",
        "area_ratio",
        "surface_deviation",
        "boundary_deviation",
        "min_angle_deg",
    ] {
        assert!(quality.contains_key(field), "{field}");
    }
    for file in ["a.obj", "b.ply", "c.stl", "d.off"] {
        let measured = gridshell(folder.path(), &format!("measure {file} --json"));
        assert_eq!(self::document(&measured)["quality"]["nodes"], quality["nodes"], "{file}");
    }
}

#[test]
fn without_an_output_the_grid_goes_to_the_current_folder_and_says_so() {
    let folder = folder();
    let run = gridshell(folder.path(), "generate hexagon --edge-length 1");
    assert_eq!(code(&run), 0, "{}", stderr(&run));
    assert!(stdout(&run).contains("wrote hexagon.obj"), "{}", stdout(&run));
    assert!(folder.path().join("hexagon.obj").is_file());
    for stage in ["pack", "triangulate", "regularize", "relax"] {
        assert!(stdout(&run).lines().any(|l| l.starts_with(stage)), "{stage}");
    }
}

#[test]
fn a_design_mesh_in_the_current_folder_is_not_overwritten_unasked() {
    let folder = folder();
    write_hexagon(folder.path());
    let before = fs::read(folder.path().join("six.obj")).expect("readable");
    let run = gridshell(folder.path(), "generate six.obj --edge-length 0.5");
    assert_eq!(code(&run), 0, "{}", stderr(&run));
    assert_eq!(fs::read(folder.path().join("six.obj")).expect("readable"), before);
    assert!(folder.path().join("six-grid.obj").is_file());
}

#[test]
fn a_time_limit_leaves_with_5_and_the_best_grid_so_far() {
    let folder = folder();
    let run = gridshell(
        folder.path(),
        "generate hexagon --edge-length 0.25 --time-limit 0.001 -o early.obj",
    );
    assert_eq!(code(&run), 5, "{}", stderr(&run));
    let measured = document(&gridshell(folder.path(), "measure early.obj --json"));
    assert_eq!(measured["quality"]["euler_characteristic"], 1);
}

#[test]
fn a_time_limit_ends_every_command_with_5() {
    let folder = folder();
    fs::write(folder.path().join("large.obj"), sheet(300)).expect("written");
    let run = gridshell(folder.path(), "generate hexagon --edge-length 0.5 -o grid.gridshell");
    assert_eq!(code(&run), 0, "{}", stderr(&run));
    for args in [
        "inspect large.obj",
        "generate large.obj --nodes 50000",
        "measure large.obj --report r.html",
        "convert large.obj -o large.ifc",
        "draw large.obj -o large.svg",
        "compare large.obj large.obj",
    ] {
        let run = gridshell(folder.path(), &format!("{args} --time-limit 0.000001"));
        assert_eq!(code(&run), 5, "{args}: {}", stderr(&run));
        assert!(stderr(&run).contains("stopped"), "{args}: {}", stderr(&run));
    }
    assert!(!folder.path().join("large.ifc").exists());
}

#[test]
fn a_memory_limit_is_told_and_leaves_with_5() {
    let folder = folder();
    fs::write(folder.path().join("sheet.obj"), sheet(30)).expect("written");
    for args in [
        "generate hexagon -n 400 --memory-limit 1M",
        "generate hexagon -n 1900000 --memory-limit 500M",
        "inspect sheet.obj --memory-limit 1M",
        "measure sheet.obj --memory-limit 1000k",
    ] {
        let run = gridshell(folder.path(), args);
        assert_eq!(code(&run), 5, "{args}: {}", stderr(&run));
        assert!(stderr(&run).contains("memory limit"), "{args}: {}", stderr(&run));
    }
    for size in ["0", "many", "-1G", "2X"] {
        let run = gridshell(folder.path(), &format!("generate hexagon --memory-limit={size}"));
        assert_eq!(code(&run), 2, "{size}: {}", stderr(&run));
    }
}

/// SIGTERM and SIGINT while the surface is prepared: the program ends by itself, with 5 or with what it had done.
#[cfg(unix)]
#[test]
fn a_signal_ends_the_command_while_the_surface_is_prepared() {
    let folder = folder();
    for signal in ["TERM", "INT"] {
        let mut run = Command::new(env!("CARGO_BIN_EXE_gridshell"))
            .args(["generate", "hexagon", "-n", "2000000", "--effort", "draft"])
            .current_dir(folder.path())
            .stderr(std::process::Stdio::null())
            .spawn()
            .expect("the command starts");
        std::thread::sleep(std::time::Duration::from_secs(1));
        let sent =
            Command::new("kill").args([&format!("-{signal}"), &run.id().to_string()]).status();
        assert!(sent.expect("there is a kill").success());
        assert_eq!(run.wait().expect("it ends").code(), Some(5), "{signal}");
    }
}

/// A wavy sheet of squares, as OBJ with triangles.
fn sheet(side: usize) -> String {
    let mut text = String::new();
    for k in 0..(side + 1) * (side + 1) {
        let (x, y) = ((k / (side + 1)) as f64, (k % (side + 1)) as f64);
        text += &format!("v {x} {y} {}\n", 0.1 * (x - y) * (x + y) / side as f64);
    }
    for k in 0..side * side {
        let a = 1 + k / side * (side + 1) + k % side;
        let (b, c, d) = (a + side + 1, a + side + 2, a + 1);
        text += &format!("f {a} {b} {c}\nf {a} {c} {d}\n");
    }
    text
}

#[test]
fn flags_override_the_recipe_and_the_rest_of_it_stands() {
    let folder = folder();
    fs::write(
        folder.path().join("r.toml"),
        "seed = 7\nedge_length = 2.0\n[measure]\nlambda = 0.8\n",
    )
    .expect("written");
    let run = document(&gridshell(
        folder.path(),
        "generate hexagon --recipe r.toml --edge-length 1 --json",
    ));
    assert_eq!((&run["seed"], &run["edge_length"]), (&Value::from(7), &Value::from(1.0)));
    assert_eq!(run["recipe"]["measure"]["lambda"], 0.8);
}

#[test]
fn threads_do_not_change_a_byte() {
    let folder = folder();
    for n in [1, 2] {
        let run = gridshell(
            folder.path(),
            &format!("generate hexagon --edge-length 0.7 --threads {n} -o {n}.obj"),
        );
        assert_eq!(code(&run), 0, "{}", stderr(&run));
    }
    let read = |name: &str| fs::read(folder.path().join(name)).expect("written");
    assert!(read("1.obj") == read("2.obj"));
}

#[test]
fn a_run_is_repeated_from_its_file_to_the_last_byte() {
    let folder = folder();
    let anchored =
        "generate hexagon --edge-length 1 --effort draft --anchor 0.5,0.3,0 --supports corners";
    for args in
        [anchored.to_owned() + " -o a.gridshell", "generate a.gridshell -o b.gridshell".into()]
    {
        let run = gridshell(folder.path(), &args);
        assert_eq!(code(&run), 0, "{args}: {}", stderr(&run));
    }
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).expect("written");
    assert!(read("a.gridshell") == read("b.gridshell"));
    let document: Value = serde_json::from_str(&read("a.gridshell")).expect("JSON");
    assert_eq!(document["supports"].as_array().expect("a list").len(), 6);
    assert_eq!(document["anchors"].as_array().expect("a list").len(), 1);
    let measured = gridshell(folder.path(), "measure a.gridshell --json");
    assert_eq!(self::document(&measured)["surface"]["name"], "hexagon");
}

#[test]
fn a_grid_is_converted_and_several_tables_are_told() {
    let folder = folder();
    write_hexagon(folder.path());
    let run = gridshell(folder.path(), "convert six.obj -o six.csv -o six.dxf -o six.gridshell");
    assert_eq!(code(&run), 0, "{}", stderr(&run));
    for name in ["six.nodes.csv", "six.members.csv", "six.panels.csv", "six.dxf", "six.gridshell"] {
        assert!(folder.path().join(name).is_file(), "{name}");
        assert!(stdout(&run).contains(&format!("wrote {name}")), "{name}");
    }
    let again = gridshell(folder.path(), "generate six.gridshell");
    assert_eq!(code(&again), 3, "it tells of no run");
}

#[test]
fn supports_and_sections_that_cannot_be_are_refused() {
    let folder = folder();
    write_hexagon(folder.path());
    fs::write(folder.path().join("far.txt"), "100 0 0\n").expect("written");
    for (args, leaves) in [
        ("convert six.obj -o a.ifc --section HEB", 2),
        ("convert six.obj -o a.ifc --material wood", 2),
        ("convert six.obj -o a.saf.xlsx --saf 3", 2),
        ("convert six.obj -o a.ifc --supports far.txt", 2),
        ("convert six.obj -o a.ifc --supports none.txt", 3),
        ("convert six.obj", 2),
        ("convert none.obj -o a.ifc", 3),
    ] {
        let run = gridshell(folder.path(), args);
        assert_eq!(code(&run), leaves, "{args}: {}", stderr(&run));
        assert!(!folder.path().join("a.ifc").exists(), "{args}");
    }
}

#[test]
fn a_run_on_a_file_in_another_unit_and_on_a_part_is_repeated() {
    let folder = folder();
    let square = |x: f64, first: usize| {
        let corners = [[0.0, 0.0], [4000.0, 0.0], [4000.0, 4000.0], [0.0, 4000.0]];
        let nodes: String = corners
            .iter()
            .map(|c| format!("v {} {} 0\n", c[0] + x, c[1]))
            .collect::<Vec<_>>()
            .concat();
        format!("{nodes}f {} {} {} {}\n", first, first + 1, first + 2, first + 3)
    };
    fs::write(folder.path().join("two.obj"), square(0.0, 1) + &square(9000.0, 5)).expect("written");
    for (part, pieces) in [("2", 1), ("all", 2)] {
        let first = format!(
            "generate two.obj --units mm --part {part} -l 1 --effort draft -o a.gridshell -o a.csv"
        );
        for args in [first.as_str(), "generate a.gridshell -o b.gridshell"] {
            let run = gridshell(folder.path(), args);
            assert_eq!(code(&run), 0, "{args}: {}", stderr(&run));
        }
        let read = |name: &str| fs::read_to_string(folder.path().join(name)).expect("written");
        assert!(read("a.gridshell") == read("b.gridshell"), "part {part}");
        let grid: Value = serde_json::from_str(&read("a.gridshell")).expect("JSON");
        let nodes = grid["nodes"].as_array().expect("a list").len();
        assert_eq!(
            read("a.nodes.csv").lines().count(),
            nodes + 1,
            "a row for each node of all parts"
        );
        let measured = document(&gridshell(folder.path(), "measure a.gridshell --json"));
        assert_eq!(measured["quality"]["euler_characteristic"], pieces);
        assert!(measured["quality"]["surface_deviation"].as_f64().expect("told") < 1e-6);
    }
}

#[test]
fn completions_and_man_pages_are_made_of_the_arguments() {
    let folder = folder();
    let output = gridshell(folder.path(), "manual papers");
    assert_eq!(code(&output), 0, "{}", stderr(&output));
    let read = |name: &str| {
        let text = fs::read_to_string(folder.path().join("papers").join(name));
        text.unwrap_or_else(|e| panic!("{name}: {e}"))
    };
    for name in ["gridshell.bash", "gridshell.fish", "_gridshell", "_gridshell.ps1"] {
        assert!(read(&format!("completions/{name}")).contains("time-limit"), "{name}");
    }
    assert!(read("man/gridshell.1").contains("Exit codes"));
    assert!(read("man/gridshell-generate.1").contains("edge\\-length"));
    assert!(!folder.path().join("papers/man/gridshell-manual.1").exists());
}
