//! Nothing is left out in silence: what a reader could not take is told by every command, and no grid is laid on what is
//! left of a surface unless that is accepted.

use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use tempfile::TempDir;

fn gridshell(folder: &Path, args: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gridshell"));
    command.args(args.split_whitespace()).current_dir(folder).output().expect("the command starts")
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A plate of `n` by `n` quadrilaterals of side `side` as OBJ.
fn plate(n: usize, side: f64) -> String {
    let mut text = String::new();
    for k in 0..(n + 1) * (n + 1) {
        let (i, j) = (k % (n + 1), k / (n + 1));
        text += &format!("v {} {} 0\n", i as f64 * side, j as f64 * side);
    }
    for k in 0..n * n {
        let a = k % n + k / n * (n + 1) + 1;
        text += &format!("f {} {} {} {}\n", a, a + 1, a + n + 2, a + n + 1);
    }
    text
}

/// As an OBJ file whose curved surface cannot be read.
fn curved() -> String {
    plate(4, 2.0) + "cstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 6 7\nend\n"
}

/// As a COMPAS session of two meshes, of which one is read.
fn two_meshes() -> String {
    let mesh = |x: f64| {
        format!(
            r#"{{"dtype": "compas.datastructures/Mesh", "vertices": [[{x},0,0],[{0},0,0],[{0},9,0],[{x},9,0]],
                "faces": [[0,1,2,3]]}}"#,
            x + 9.0
        )
    };
    format!(r#"{{"roof": {}, "porch": {}}}"#, mesh(0.0), mesh(20.0))
}

/// As a STEP file of two plates, one of which names a surface that is not there.
fn broken_step() -> String {
    let points: [[i32; 2]; 6] =
        [[0, 0], [8000, 0], [8000, 8000], [0, 8000], [16000, 0], [16000, 8000]];
    let mut text = String::from(
        "ISO-10303-21;HEADER;FILE_DESCRIPTION((''),'2;1');FILE_NAME('','',(''),(''),'','','');\
         FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));ENDSEC;DATA;\n\
         #1=DIRECTION('',(0.,0.,1.));\n#2=DIRECTION('',(1.,0.,0.));\n",
    );
    for (k, [x, y]) in points.iter().enumerate() {
        let (p, v) = (10 + k, 20 + k);
        text += &format!("#{p}=CARTESIAN_POINT('',({x}.,{y}.,0.));\n#{v}=VERTEX_POINT('',#{p});\n");
    }
    text += "#3=AXIS2_PLACEMENT_3D('',#10,#1,#2);\n#4=PLANE('',#3);\n#5=NO_SUCH_SURFACE('',#3);\n";
    // Edges round both plates, the second from the end of the first.
    let edges = [(0, 1), (1, 2), (2, 3), (3, 0), (1, 4), (4, 5), (5, 2)];
    for (k, (a, b)) in edges.iter().enumerate() {
        let ([xa, ya], [xb, yb]) = (points[*a], points[*b]);
        let (dx, dy) = ((xb - xa).signum(), (yb - ya).signum());
        let id = 100 + 10 * k;
        text += &format!(
            "#{id}=DIRECTION('',({dx}.,{dy}.,0.));\n#{}=VECTOR('',#{id},1.);\n#{}=LINE('',#{},#{});\n\
             #{}=EDGE_CURVE('',#{},#{},#{},.T.);\n",
            id + 1,
            id + 2,
            10 + a,
            id + 1,
            id + 3,
            20 + a,
            20 + b,
            id + 2
        );
    }
    let mut face = |first: usize, surface: usize, edges: [(usize, char); 4]| {
        let mut uses = Vec::new();
        for (k, (e, way)) in edges.into_iter().enumerate() {
            let id = first + k;
            text += &format!("#{id}=ORIENTED_EDGE('',*,*,#{},.{way}.);\n", 103 + 10 * e);
            uses.push(format!("#{id}"));
        }
        text += &format!(
            "#{}=EDGE_LOOP('',({}));\n#{}=FACE_BOUND('',#{},.T.);\n#{}=ADVANCED_FACE('',(#{}),#{surface},.T.);\n",
            first + 4,
            uses.join(","),
            first + 5,
            first + 4,
            first + 6,
            first + 5
        );
    };
    face(300, 4, [(0, 'T'), (1, 'T'), (2, 'T'), (3, 'T')]);
    face(400, 5, [(4, 'T'), (5, 'T'), (6, 'T'), (1, 'F')]);
    text + "#500=OPEN_SHELL('',(#306,#406));\n#501=SHELL_BASED_SURFACE_MODEL('',(#500));\nENDSEC;END-ISO-10303-21;\n"
}

/// A folder with surfaces of which a part cannot be read, each with what is said of it.
fn folder() -> (TempDir, [(&'static str, &'static str); 3]) {
    let folder = tempfile::tempdir().expect("a folder for the test");
    for (name, text) in
        [("curved.obj", curved()), ("two.json", two_meshes()), ("broken.step", broken_step())]
    {
        fs::write(folder.path().join(name), text).expect("written");
    }
    (
        folder,
        [
            ("curved.obj", "1 curved surface"),
            ("two.json", "mesh porch"),
            ("broken.step", "face #406"),
        ],
    )
}

#[test]
fn no_grid_is_laid_on_a_part_of_a_surface_unless_that_is_accepted() {
    let (folder, files) = folder();
    for (file, what) in files {
        let run =
            gridshell(folder.path(), &format!("generate {file} -l 1 --effort draft -o a.obj"));
        let said = stderr(&run);
        assert_eq!(run.status.code(), Some(3), "{file}: {said}");
        assert!(
            said.contains(&format!("left out {what}")) && said.contains("--accept-losses"),
            "{said}"
        );
        assert!(run.stdout.is_empty() && !folder.path().join("a.obj").exists(), "{file}");
        let args = format!(
            "generate {file} -l 1 --effort draft --accept-losses --json -o {file}.gridshell"
        );
        let run = gridshell(folder.path(), &args);
        let said = stderr(&run);
        assert_eq!(run.status.code(), Some(0), "{file}: {said}");
        assert!(said.contains(&format!("warning: left out {what}")), "{file}: {said}");
        let document: Value = serde_json::from_slice(&run.stdout).expect("one document");
        let losses = document["surface"]["losses"].as_array().expect("a list");
        assert!(
            losses.iter().any(|l| l["what"].as_str().expect("a text").contains(what)),
            "{losses:?}"
        );
    }
}

#[test]
fn a_recipe_may_accept_what_is_missing() {
    let (folder, files) = folder();
    fs::write(
        folder.path().join("r.toml"),
        "accept_losses = true\nedge_length = 1.0\neffort = \"draft\"\n",
    )
    .expect("written");
    for (file, _) in files {
        let run = gridshell(folder.path(), &format!("generate {file} --recipe r.toml -o a.obj"));
        assert_eq!(run.status.code(), Some(0), "{file}: {}", stderr(&run));
    }
}

#[test]
fn every_command_tells_what_is_missing() {
    let (folder, files) = folder();
    for (file, what) in files {
        let grid = format!("{file}.gridshell");
        let laid = format!("generate {file} -l 1 --effort draft --accept-losses -o {grid}");
        assert_eq!(gridshell(folder.path(), &laid).status.code(), Some(0), "{file}");
        for args in [
            format!("inspect {file}"),
            format!("inspect {file} --json"),
            format!("measure {grid}"),
            format!("convert {grid} -o a.off"),
            format!("edit {grid} -o a.off"),
            format!("draw {grid} --paper a4 -o a.svg"),
            format!("compare {grid} {grid}"),
        ] {
            let run = gridshell(folder.path(), &args);
            let said = stderr(&run);
            assert_eq!(run.status.code(), Some(0), "{args}: {said}");
            assert!(said.contains("left out") && said.contains(what), "{args}: {said}");
        }
        let run = gridshell(folder.path(), &format!("inspect {file} --json"));
        let document: Value = serde_json::from_slice(&run.stdout).expect("one document");
        assert_eq!(document["source"]["losses"].as_array().expect("a list").len(), 1, "{file}");
    }
}

#[test]
fn a_piece_below_a_hundredth_of_the_area_is_told_and_no_more() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    for (name, side) in [("large.obj", 20.0), ("middle.obj", 2.0), ("small.obj", 0.5)] {
        // A scrap far away, a thousandth of the whole.
        let far = 1000.0 * side;
        let text = plate(5, side)
            + &format!(
                "v {far} 0 0\nv {} 0 0\nv {far} {} 0\nf 37 38 39\n",
                far + 0.2 * side,
                far * 2e-4
            );
        fs::write(folder.path().join(name), text).expect("written");
        let args = format!("generate {name} -n 100 --effort draft -o a.obj");
        let run = gridshell(folder.path(), &args);
        let said = stderr(&run);
        assert_eq!(run.status.code(), Some(0), "{said}");
        assert!(said.contains("warning: left out 1 small piece (1 face, about"), "{said}");
        assert!(!said.contains("0.000 m2"), "{said}");
    }
}

#[test]
fn a_grid_that_was_written_here_opens_without_a_word_on_its_own_lines_and_points() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    for (surface, extension) in
        [("hexagon", "obj"), ("dome", "obj"), ("barrel", "ply"), ("saddle", "glb")]
    {
        let grid = format!("{surface}.{extension}");
        let laid = format!("generate {surface} -n 80 --effort draft -o {grid}");
        assert_eq!(gridshell(folder.path(), &laid).status.code(), Some(0));
        let said = stderr(&gridshell(folder.path(), &format!("measure {grid}")));
        assert!(!said.contains("skipped") && !said.contains("left out"), "{grid}: {said}");
    }
}

#[test]
fn a_part_that_is_at_fault_is_named_and_the_others_have_their_grids() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    // A scrap beside the roof: one triangle far smaller than a member, in each of the formats.
    let scrap = |side: f64| {
        let (a, b) = (9.0, 9.0 + side);
        format!("v {a} 0 0\nv {b} 0 0\nv {a} {side} 0\nf 26 27 28\n")
    };
    for (name, side) in [("tiny.obj", 0.2), ("small.obj", 0.4), ("speck.obj", 0.05)] {
        fs::write(folder.path().join(name), plate(4, 2.0) + &scrap(side)).expect("written");
        let args = format!("generate {name} -l 1 --part all --effort draft -o a.gridshell --json");
        let run = gridshell(folder.path(), &args);
        let said = stderr(&run);
        assert_eq!(run.status.code(), Some(6), "{name}: {said}");
        assert!(said.contains("warning: part 2 has no grid"), "{name}: {said}");
        let document: Value = serde_json::from_slice(&run.stdout).expect("one document");
        assert_eq!(document["failed"][0]["number"], 2);
        assert_eq!(document["parts"].as_array().expect("a list").len(), 1);
        // Repeated, it is left out as the recipe says: the same grid, and nothing that failed.
        let again = gridshell(folder.path(), "generate a.gridshell -o b.gridshell");
        assert_eq!(again.status.code(), Some(0), "{name}: {}", stderr(&again));
        let read = |name: &str| fs::read(folder.path().join(name)).expect("written");
        assert!(read("a.gridshell") == read("b.gridshell"), "{name}");
    }
}
