//! Reading, welding and writing meshes, over files written to the system's temporary folder.

use super::*;
use crate::grid::Grid;
use crate::mesh::Mesh;
use crate::schedule::{Schedule, Tolerances};
use crate::structure::{Structure, Supports};
use crate::surface::Sampling;
use glam::DVec3;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

mod odd;

/// A file of this name that is removed at the end of the test.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str, contents: impl AsRef<[u8]>) -> Scratch {
        let path = std::env::temp_dir().join(format!("gridshell-{}-{name}", std::process::id()));
        fs::write(&path, contents).expect("room in the temporary folder");
        Scratch(path)
    }

    /// The mesh, its points where the file has them.
    fn read(&self) -> Result<PolygonMesh> {
        let mut mesh = read_mesh(&self.0, &Job::default())?;
        mesh.points.iter_mut().for_each(|p| *p = mesh.origin.world(*p));
        Ok(mesh)
    }

    fn refused(&self) -> String {
        self.read().expect_err("an error").to_string()
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.0);
    }
}

/// A grid with all that goes into a file.
struct Made {
    document: Document,
    schedule: Schedule,
    structure: Structure,
}

impl Made {
    fn new(xyz: &[DVec3], panels: &[[u32; 3]]) -> Made {
        let (grid, surface) = Grid::alone("made", xyz.to_vec(), panels).expect("a manifold");
        let schedule = Schedule::new(&grid, &surface, &Tolerances::default());
        let supports = Supports::Boundary.nodes(&grid, &surface).expect("a boundary");
        let document = Document {
            seed: Some(1),
            supports,
            ..Document::of_grid("made, seed 1", &grid, surface.origin)
        };
        Made { document, schedule, structure: Structure::default() }
    }

    fn write(&self, path: &Path) {
        let Made { document, schedule, structure } = self;
        write(path, &GridFile { document, schedule, structure }, &Job::default()).expect("written");
    }
}

/// A unit square of two triangles and a quad beside it, at coordinates that single precision cannot hold.
const FAR: &str = "v 500000.0000000001 4000000.1234567 0.1\nv 500001 4000000 0\nv 500001 4000001 0\n\
                   v 500000 4000001 0\nv 500002 4000000 0\nv 500002 4000001 0\n\
                   f 1 2 3\nf -6/1/1 -4//2 -3\nf 2 5 6 3\nl 1 2\n";

#[test]
fn obj_keeps_far_coordinates_and_understands_negative_indices() {
    let mesh = Scratch::new("far.obj", FAR).read().expect("a mesh");
    assert_eq!(mesh.points[0], DVec3::new(500000.0000000001, 4000000.1234567, 0.1));
    assert_eq!(mesh.faces, vec![vec![0, 1, 2], vec![0, 2, 3], vec![1, 4, 5, 2]]);
}

/// Faces before the vertices they name, an exponent as Fortran writes it, and a relative number counted from its own line.
#[test]
fn obj_takes_vertices_in_any_place_and_exponents_of_fortran() {
    let text = "f 1 2 3\nv 1.0D+01 0 0\nv 0 1d1 0\nf -1 -2 4\nv 0 0 0\nv 10 10 0\n";
    let mesh = Scratch::new("late.obj", text).read().expect("a mesh");
    assert_eq!(mesh.faces, vec![vec![0, 1, 2], vec![1, 0, 3]]);
    assert_eq!(mesh.points[1], DVec3::new(0.0, 10.0, 0.0));
    let error = Scratch::new("few.obj", "v 0 0 0\nf 1 2 3\n").read().unwrap_err().to_string();
    assert!(error.contains("line 2") && error.contains("only 1 are given"), "{error}");
}

#[test]
fn grids_read_back_exactly_from_every_format() {
    let mesh = Scratch::new("source.obj", FAR).read().expect("a mesh");
    let triangles = [[0, 1, 2], [0, 2, 3], [1, 4, 5], [1, 5, 2]];
    for extension in ["obj", "ply", "off", "stl"] {
        // Single precision holds small coordinates in eighths.
        let near = |p: &DVec3| ((*p - DVec3::new(500000.0, 4000000.0, 0.0)) * 8.0).round() / 8.0;
        let xyz: Vec<DVec3> = if extension == "stl" {
            mesh.points.iter().map(near).collect()
        } else {
            mesh.points.clone()
        };
        let file = Scratch::new(&format!("round.{extension}"), "");
        Made::new(&xyz, &triangles).write(&file.0);
        let back = file.read().expect("a mesh");
        assert_eq!(back.points.len(), xyz.len(), "{extension}");
        assert_eq!(back.faces.len(), 4, "{extension}");
        for (face, t) in back.faces.iter().zip(&triangles) {
            let corners: Vec<DVec3> = face.iter().map(|&v| back.points[v as usize]).collect();
            assert_eq!(corners, t.map(|v| xyz[v as usize]), "{extension}");
        }
        let text = String::from_utf8_lossy(&fs::read(&file.0).expect("just written")).into_owned();
        assert!(text.contains("metre"), "{extension} states the unit");
        if extension == "obj" {
            assert!(text.contains("\nl 1 3\n"));
        }
    }
}

/// A PLY of the unit square as one quad, with a colour per vertex, in binary.
fn binary_ply(big: bool) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let mut bytes = format!(
        "ply\nformat binary_{order}_endian 1.0\ncomment x\nelement vertex 4\nproperty double x\n\
         property float y\nproperty double z\nproperty uchar red\nelement face 1\n\
         property list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    let order = |mut b: Vec<u8>| {
        if big {
            b.reverse();
        }
        b
    };
    for [x, y] in [[0.1, 0.0_f32], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
        bytes.extend(order(f64::to_le_bytes(f64::from(x)).to_vec()));
        bytes.extend(order(y.to_le_bytes().to_vec()));
        bytes.extend(order(7.25_f64.to_le_bytes().to_vec()));
        bytes.push(255);
    }
    bytes.push(4);
    for i in [0_i32, 1, 2, 3] {
        bytes.extend(order(i.to_le_bytes().to_vec()));
    }
    bytes
}

#[test]
fn ply_reads_both_byte_orders_and_names_the_vertex_it_is_cut_at() {
    for big in [false, true] {
        let bytes = binary_ply(big);
        let mesh = Scratch::new(&format!("{big}.ply"), &bytes).read().expect("a mesh");
        assert_eq!(mesh.points[2], DVec3::new(1.0, 1.0, 7.25));
        assert_eq!(mesh.faces, vec![vec![0, 1, 2, 3]]);
        let cut = Scratch::new(&format!("cut-{big}.ply"), &bytes[..bytes.len() - 50]).refused();
        assert!(cut.contains("vertex 2"), "{cut}");
    }
}

#[test]
fn promises_of_huge_counts_cost_no_memory() {
    let head = "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty double x\n\
                property double y\nproperty double z\nend_header\n";
    assert!(Scratch::new("huge.ply", head).refused().contains("vertex 0"));
    let empty = "ply\nformat ascii 1.0\nelement nothing 18446744073709551615\nend_header\n";
    assert!(Scratch::new("nothing.ply", empty).refused().contains("no faces"));
    assert!(
        Scratch::new("huge.off", "OFF\n4000000000 4000000000 0\n0 0 0\n")
            .refused()
            .contains("ends")
    );
    assert!(
        Scratch::new("long.off", "OFF\n1 1 0\n0 0 0\n4000000000 0").refused().contains("line 4")
    );
    let mut stl = b"solid but binary".to_vec();
    stl.resize(80, b' ');
    stl.extend(4_000_000_000_u32.to_le_bytes());
    stl.resize(84 + 75, 0);
    assert!(Scratch::new("huge.stl", stl).refused().contains("facet 2"));
}

#[test]
fn bad_input_names_its_line() {
    for (name, contents, line) in [
        ("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "line 4"),
        ("zero.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "line 4"),
        ("word.obj", "# head\nv 0 0 0\nv 1 x 0\n", "line 3"),
        (
            "comma.obj",
            "v 0,5 0 0\n",
            "line 1: `0,5` is not a coordinate (x): write numbers with a point",
        ),
        ("inf.obj", "v 0 0 inf\n", "line 1"),
        ("continued.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\n 2 3\nf 1 2\n", "line 6"),
        ("short.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1\n3 0 1 2", "line 5"),
        ("index.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3", "line 5"),
        ("text.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n", "line 4"),
        (
            "type.ply",
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty quad x\nend_header\n",
            "line 4",
        ),
    ] {
        let message = Scratch::new(name, contents).refused();
        assert!(message.contains(line), "{name}: {message}");
    }
    assert!(Scratch::new("empty.obj", "").refused().contains("no faces"));
    assert!(Scratch::new("empty.stl", "").refused().contains("no STL"));
}

/// Two quads side by side, in OBJ.
const PAIR: &str = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nf 1 2 5 4\nf 2 3 6 5\n";

#[test]
fn texts_are_read_whichever_program_wrote_them() {
    let wide = |text: &str| text.encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<u8>>();
    let stl = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    let ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
               element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (name, bytes, faces) in [
        ("mark.obj", [b"\xEF\xBB\xBF", PAIR.as_bytes()].concat(), 2),
        ("wide.obj", [b"\xFF\xFE".to_vec(), wide(PAIR)].concat(), 2),
        ("mac.obj", PAIR.replace('\n', "\r").into(), 2),
        // A folder in a comment is not a continuation, a backslash before blanks is one.
        ("folder.obj", format!("# from C:\\roofs\\\n{PAIR}").into(), 2),
        ("blanks.obj", PAIR.replace("1 2 5", "1 2 \\ \n5").into(), 2),
        ("mac.ply", ply.replace('\n', "\r").into(), 1),
        ("mark.off", b"\xEF\xBB\xBFoff\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n".to_vec(), 1),
        ("loud.stl", format!("SOLID A\n{}ENDSOLID\n", stl.to_uppercase()).into(), 1),
        ("mark.stl", format!("\u{FEFF}solid a\ncolor 1 0 0\n{stl}endsolid\n").into(), 1),
        ("mac.stl", format!("solid a\n{stl}endsolid\n").replace('\n', "\r").into(), 1),
    ] {
        let mesh = Scratch::new(name, bytes).read().expect(name);
        assert_eq!((mesh.faces.len(), mesh.points.len()), (faces, faces * 3), "{name}");
    }
}

#[test]
fn binary_stl_whose_count_was_never_filled_in_is_read_to_its_end() {
    let mut stl = vec![b' '; 84];
    stl[80..].fill(0);
    for c in [0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0_u8].map(f32::from) {
        stl.extend(c.to_le_bytes());
    }
    stl.extend([0, 0]);
    let mesh = Scratch::new("uncounted.stl", stl).read().expect("a mesh");
    assert_eq!(mesh.faces.len(), 1);
    assert!(mesh.notes.iter().any(|n| n.contains("no facets")), "{:?}", mesh.notes);
}

#[test]
fn strips_of_a_ply_are_triangles_that_agree() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n\
               element tristrips 1\nproperty list int int vertex_indices\nend_header\n\
               0 0 0\n0 1 0\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n8 1 0 3 2 -1 2 4 3\n";
    let mesh = Scratch::new("strips.ply", ply).read().expect("a mesh");
    assert_eq!((mesh.faces.len(), mesh.points.len()), (3, 5));
    assert!(!mesh.notes.iter().any(|n| n.contains("turned")), "{:?}", mesh.notes);
    let beyond = ply.replace(" 4 3\n", " 9 3\n");
    assert!(Scratch::new("beyond.ply", beyond).refused().contains("vertex 9"));
}

#[test]
fn a_t_junction_leaves_no_slit() {
    // The large quad does not know the vertex between its two small neighbours.
    let text = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 2 1 0\nv 3 0 0\nv 3 1 0\nv 3 2 0\n\
                f 1 2 3 4\nf 2 6 7 5\nf 5 7 8 3\n";
    let mesh = Scratch::new("slit.obj", text).read().expect("a mesh");
    assert!(mesh.notes.iter().any(|n| n.contains("joined 1 vertex to")), "{:?}", mesh.notes);
    let sampling = Sampling { max_edge: 9.0, chord_error: 1.0, corner_angle: 0.5 };
    let surface = mesh.surface(&sampling, &Job::default()).expect("a surface");
    assert_eq!((surface.loops.len(), surface.euler_characteristic()), (1, 1));
    assert!((surface.area - 6.0).abs() < 1e-12);
}

#[test]
fn copies_of_vertices_further_apart_than_rounding_are_sewn_when_asked() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1.0003 0 0\nv 0 1.0003 0\nv 1 1 0\nf 1 2 3\nf 4 6 5\n";
    let file = Scratch::new("apart.obj", text);
    assert_eq!(file.read().expect("two pieces").points.len(), 6);
    let sewn = |sew| {
        read_mesh_with(&file.0, &Opening { sew: Some(sew), ..Opening::default() }, &Job::default())
    };
    assert_eq!(sewn(0.001).expect("one piece").points.len(), 4);
    assert!(sewn(0.5).expect_err("too much").to_string().contains("from 0 to 0.01"));
}

#[test]
fn files_without_faces_say_what_they_have() {
    let said = Scratch::new("cloud.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n").refused();
    assert!(said.contains("only 2 vertices; export"), "{said}");
    assert!(Scratch::new("page.obj", "<html></html>\n").refused().contains("not of this format"));
}

#[test]
fn text_stl_is_welded_to_one_piece() {
    let facet = |c: [[i32; 3]; 3]| {
        let v = c.map(|[x, y, z]| format!("vertex {x} {y} {z}\n")).concat();
        format!("facet normal 0 0 0\nouter loop\n{v}endloop\nendfacet\n")
    };
    // The second facet faces the other way.
    let text = format!(
        "solid roof\n{}{}endsolid\n",
        facet([[0, 0, 0], [1, 0, 0], [0, 1, 0]]),
        facet([[1, 0, 0], [0, 1, 0], [1, 1, 0]])
    );
    let mesh = Scratch::new("text.stl", text).read().expect("a mesh");
    assert_eq!((mesh.points.len(), mesh.faces.len()), (4, 2));
    assert!(mesh.notes.iter().any(|n| n.contains("merged 2")), "{:?}", mesh.notes);
    assert!(mesh.notes.iter().any(|n| n.contains("turned 1")), "{:?}", mesh.notes);
    for face in &mesh.faces {
        let [a, b, c] = [0, 1, 2].map(|k| mesh.points[face[k] as usize]);
        assert!((b - a).cross(c - a).z > 0.0, "open surfaces face upwards");
    }
}

#[test]
fn closed_mesh_turned_inside_out_is_turned_back() {
    let tetrahedron = "v 0 0 9\nv 1 0 9\nv 0 1 9\nv 0 0 10\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n";
    let mesh = Scratch::new("closed.obj", tetrahedron).read().expect("a mesh");
    let centre = mesh.points.iter().sum::<DVec3>() / 4.0;
    for face in &mesh.faces {
        let [a, b, c] = [0, 1, 2].map(|k| mesh.points[face[k] as usize]);
        assert!((b - a).cross(c - a).dot(a - centre) > 0.0);
    }
}

#[test]
fn edge_of_three_faces_is_refused_with_its_place() {
    let book = "v 0 0 0\nv 0 1 0\nv 1 0.5 0\nv -1 0.5 0\nv 0 0.5 1\nf 1 2 3\nf 1 2 4\nf 1 2 5\n";
    let message = Scratch::new("book.obj", book).refused();
    assert!(message.contains("(0, 0, 0)") && message.contains("(0, 1, 0)"), "{message}");
}

#[test]
fn moebius_strip_is_refused() {
    // Five quads in a ring; the last one joins the first upside down.
    let mut text = String::new();
    for k in 0..5 {
        let _ = write!(text, "v {k} 0 {k}\nv {k} 1 {}\n", k * k);
    }
    for k in 0..4 {
        let a = 2 * k + 1;
        let _ = writeln!(text, "f {} {} {} {}", a, a + 1, a + 3, a + 2);
    }
    text += "f 9 10 1 2\n";
    assert!(Scratch::new("strip.obj", text).refused().contains("one side"));
}

#[test]
fn repeated_degenerate_and_unused_parts_go_and_touching_fans_part() {
    let text = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv -1 0 0\nv -1 -1 0\nv 1 1 0.00000000001\n\
                f 2 3 4\nf 3 4 2\nf 2 2 3\nf 4 7 4\nf 2 5 6\n";
    let mesh = Scratch::new("mixed.obj", text).read().expect("a mesh");
    assert_eq!((mesh.points.len(), mesh.faces.len()), (6, 2), "{:?}", mesh.notes);
    for told in ["merged 1", "2 degenerate", "1 repeated", "2 separate", "split 1"] {
        assert!(mesh.notes.iter().any(|n| n.contains(told)), "{told}: {:?}", mesh.notes);
    }
}

#[test]
fn units_are_taken_from_comments_and_from_the_designer() {
    let text = "# units: mm\nv 0 0 0\nv 1000 0 0\nv 0 1000 0\nf 1 2 3\n";
    let file = Scratch::new("unit.obj", text);
    let mesh = file.read().expect("a mesh");
    assert_eq!(mesh.points[1], DVec3::X);
    assert!(mesh.notes.is_empty(), "{:?}", mesh.notes);
    let opening = Opening { unit: Some(LengthUnit::Foot), ..Opening::default() };
    let mesh = read_mesh_with(&file.0, &opening, &Job::default()).expect("a mesh");
    assert_eq!(mesh.points[1].x, 1000.0 * 0.3048);
    assert!(mesh.notes.iter().any(|n| n.contains("states mm")), "{:?}", mesh.notes);
    let file = Scratch::new("unit.gltf", gltf(r#"{"mesh": 0}"#));
    let mesh = read_mesh_with(&file.0, &opening, &Job::default()).expect("a mesh");
    assert!(mesh.notes.iter().any(|n| n.contains("states m, but ft")), "{:?}", mesh.notes);
}

#[test]
fn small_pieces_far_away_and_stray_lines_are_left_out_with_a_note() {
    let text = "v 500000 4000000 0\nv 500010 4000000 0\nv 500010 4000010 0\nv 500000 4000010 0\n\
                f 1 2 3 4\nv 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nf 5 6 7\nl 1 6\nl 1 2 3\nv 0 0 1\np 7 8\n";
    let mesh = Scratch::new("stray.obj", text).read().expect("a mesh");
    assert_eq!((mesh.points.len(), mesh.faces.len()), (4, 1));
    for told in ["1 line that", "1 point that"] {
        assert!(mesh.notes.iter().any(|n| n.contains(told)), "{told}: {:?}", mesh.notes);
    }
    let [lost] = mesh.source.losses.as_slice() else { panic!("{:?}", mesh.source.losses) };
    assert_eq!((lost.faces, lost.whole), (1, false));
    assert!((lost.area.expect("known") - 0.005).abs() < 1e-6 && lost.why.contains("far"), "{lost}");
}

#[test]
fn sliver_on_an_edge_of_two_faces_is_cut_off() {
    let text = "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nv 5 5 0.001\nf 1 2 3\nf 1 3 4\nf 1 3 5\n";
    let mesh = Scratch::new("sliver.obj", text).read().expect("a mesh");
    assert_eq!(mesh.faces.len(), 2);
    let [lost] = mesh.source.losses.as_slice() else { panic!("{:?}", mesh.source.losses) };
    assert!(lost.faces == 1 && lost.why.contains("two other faces"), "{lost}");
}

#[test]
fn crowded_edge_is_named_with_its_faces() {
    let book = "OFF\n5 3 0\n0 0 0\n0 1 0\n1 0.5 0\n-1 0.5 0\n0 0.5 1\n3 0 1 2\n3 0 1 3\n3 0 1 4\n";
    let message = Scratch::new("book.off", book).refused();
    assert!(message.contains("3 faces (0, 1, 2)"), "{message}");
}

#[test]
fn coordinates_beyond_all_bounds_are_named() {
    let text = "v 0 0 0\nv 1e15 0 0\nv 0 1 0\nf 1 2 3\n";
    let message = Scratch::new("beyond.obj", text).refused();
    assert!(message.contains("face 1 uses vertex 2"), "{message}");
    // What no face uses does no harm.
    let text = "v 0 0 0\nv 1e300 0 0\nv 0 1 0\nv 1 0 0\nf 1 3 4\n";
    assert_eq!(Scratch::new("unused.obj", text).read().expect("a mesh").points.len(), 3);
}

#[test]
fn faces_without_any_area_are_refused() {
    let text = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 5 0 0\nf 1 2 3\nf 2 4 3\n";
    assert!(Scratch::new("flat.obj", text).refused().contains("no area"));
}

#[test]
fn face_cut_open_to_its_hole_keeps_its_area() {
    // A square ring as one polygon: round the outside, in along a cut, round the hole, out again.
    let text = "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 0\nv 3 1 0\nv 3 3 0\nv 1 3 0\n\
                f 1 2 3 4 1 5 8 7 6 5\n";
    let mesh = Scratch::new("slit.obj", text).read().expect("a mesh");
    let sampling = Sampling { max_edge: 9.0, chord_error: 0.1, corner_angle: 0.5 };
    let surface = mesh.surface(&sampling, &Job::default()).expect("a surface");
    assert!((surface.area - 12.0).abs() < 1e-12, "{}", surface.area);
    assert_eq!(surface.loops.len(), 2);
}

#[test]
fn cone_of_very_many_faces_round_one_vertex_takes_no_time() {
    let mut text = String::from("v 0 0 1\n");
    let n = 60_000;
    for k in 0..n {
        let t = f64::from(k) / f64::from(n);
        let _ = writeln!(text, "v {} {} 0", t * 4.0 - 2.0, t * t);
    }
    for k in 2..=n {
        let _ = writeln!(text, "f 1 {} {k}", k + 1);
    }
    let start = std::time::Instant::now();
    let mesh = Scratch::new("cone.obj", text).read().expect("a mesh");
    assert_eq!(mesh.faces.len(), 59_999);
    assert!(start.elapsed().as_secs() < 5);
}

/// A COMPAS mesh of two quads, the second marked as an opening.
const FORM: &str = r#"{"vertex": {"a": {"x": 0, "y": 0}, "1": {"x": 1.5, "y": 0, "z": 0.25}, "2": {"x": 1, "y": 1},
  "3": {"x": 0, "y": 1}, "4": {"x": 2, "y": 0}, "5": {"x": 2, "y": 1}},
  "face": {"0": ["a", 1, 2, 3], "7": [1, 4, "5", 2]}, "facedata": {"7": {"_is_loaded": false}}, "dva": {"z": 3}}"#;

#[test]
fn compas_meshes_old_and_new_are_read_and_openings_left_out() {
    for (name, text) in [
        ("top.json", FORM.to_owned()),
        ("new.json", format!("{{\"dtype\": \"compas.datastructures/Mesh\", \"data\": {FORM}}}")),
        ("old.json", format!("{{\"dtype\": \"compas.datastructures/Mesh\", \"value\": {FORM}}}")),
    ] {
        let mesh = Scratch::new(name, text).read().expect("a mesh");
        assert_eq!((mesh.points.len(), mesh.faces.len()), (4, 1), "{name}");
        assert_eq!(mesh.points[1], DVec3::new(1.5, 0.0, 0.25));
        assert_eq!(mesh.points[0].z, 3.0, "{name}: the usual z");
        assert!(mesh.notes.iter().any(|n| n.contains("1 face marked as not loaded")));
    }
}

#[test]
fn compas_faces_as_rings_and_meshes_as_lists_are_read() {
    let vertices = r#"{"a":{"x":0,"y":0,"z":0},"b":{"x":1,"y":0,"z":0},"7":{"x":0,"y":1,"z":0}}"#;
    let ring = format!(r#"{{"vertex":{vertices},"face":{{"0":{{"a":"b","b":7,"7":"a"}}}}}}"#);
    assert_eq!(Scratch::new("ring.json", ring).read().expect("a ring").faces, [[0, 1, 2]]);
    let lists = r#"{"vertices":[[0,0,0],[1,0,0],[0,1,0]],"faces":[[0,1,2]]}"#;
    assert_eq!(Scratch::new("lists.json", lists).read().expect("lists").faces, [[0, 1, 2]]);
    let beyond = Scratch::new("beyond.json", lists.replace("[0,1,2]]", "[0,1,3]]")).refused();
    assert!(beyond.contains("face 0: 3 is not a place"), "{beyond}");
    let odd = Scratch::new("odd.json", lists.replace("[1,0,0]", "[NaN,0,0]")).refused();
    assert!(odd.contains("line 1") && odd.contains("`NaN`"), "{odd}");
}

#[test]
fn of_a_compas_session_the_thrust_diagram_is_taken() {
    let flat = FORM.replace("0.25", "0").replace("\"z\": 3", "\"z\": 0");
    let session = format!(
        "{{\"form\": {{\"dtype\": \"x/FormDiagram\", \"data\": {flat}}}, \"items\": [1, {{\"thrust\": {FORM}}}]}}"
    );
    let mesh = Scratch::new("session.json", session).read().expect("a mesh");
    assert_eq!(mesh.points[0].z, 3.0);
    assert!(mesh.notes.iter().any(|n| n.contains("items.1.thrust")), "{:?}", mesh.notes);
}

#[test]
fn damaged_compas_files_name_their_place() {
    for (text, told) in [
        ("{\"vertex\": {}}", "no COMPAS mesh"),
        ("{\n\"vertex\": [}", "line 2"),
        (&FORM.replace("1.5", "null"), "vertex 1: its x"),
        (&FORM.replace("\"a\", 1, 2", "\"a\", 1, 99"), "face 0: vertex 99"),
        (&FORM.replace("[\"a\", 1, 2, 3]", "5"), "face 0: it is not a list"),
    ] {
        let message = Scratch::new("damaged.json", text).refused();
        assert!(message.contains(told), "{told}: {message}");
    }
}

/// A text glTF of one triangle (0 0 0, 1 0 0, 0 2 0), with these nodes.
fn gltf(nodes: &str) -> String {
    let bytes: Vec<u8> = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0, 0.0]
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    let data = base64::Engine::encode(&base64::engine::general_purpose::STANDARD, bytes);
    format!(
        r#"{{"nodes": [{nodes}], "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 36}}],
        "buffers": [{{"byteLength": 36, "uri": "data:application/octet-stream;base64,{data}"}}]}}"#
    )
}

#[test]
fn gltf_is_placed_by_its_nodes_with_z_up() {
    let nodes = r#"{"translation": [500000, 7, -4000000], "children": [1]}, {"mesh": 0, "scale": [1, 1, -1]}"#;
    let mesh = Scratch::new("placed.gltf", gltf(nodes)).read().expect("a mesh");
    // Up is y there: (x, y, z) is (x, -z, y) here.
    let at = DVec3::new(500000.0, 4000000.0, 7.0);
    assert_eq!(mesh.points, [at, at + DVec3::X, at + DVec3::new(0.0, 0.0, 2.0)]);
    // A mirror image turns its faces: the normal was z there, so -y here, and is y now.
    let [a, b, c] = [0, 1, 2].map(|k| mesh.points[mesh.faces[0][k] as usize]);
    assert!((b - a).cross(c - a).y > 0.0);
    assert!(mesh.notes.is_empty(), "{:?}", mesh.notes);
}

#[test]
fn sparse_gltf_has_its_items_replaced() {
    // Points that are zero but for two, whose places lie in a buffer of their own.
    let sparse = r#""sparse": {"count": 2, "indices": {"bufferView": 1, "componentType": 5121},
        "values": {"bufferView": 0, "byteOffset": 12}}, "componentType""#;
    let text = gltf("{\"mesh\": 0}")
        .replace("\"bufferView\": 0, \"componentType\"", sparse)
        .replace("36}],", "36}, {\"buffer\": 1, \"byteLength\": 2}],")
        .replace("\"}]}", "\"}, {\"uri\": \"data:;base64,AQI=\"}]}");
    let mesh = Scratch::new("sparse.gltf", &text).read().expect("a mesh");
    assert_eq!(mesh.points, [DVec3::ZERO, DVec3::X, DVec3::new(0.0, 0.0, 2.0)]);
    let beyond = Scratch::new("beyond.gltf", text.replace("AQI=", "AQk=")).refused();
    assert!(beyond.contains("accessor 0: it replaces item 9 of 3"), "{beyond}");
    let huge = Scratch::new("huge.gltf", text.replace("\"count\": 3", "\"count\": 4000000000"));
    assert!(huge.refused().contains("accessor 0"), "zeros cost the file nothing");
}

#[test]
fn damaged_gltf_names_its_place() {
    let whole = gltf("{\"mesh\": 0}");
    for (text, told) in [
        (
            whole.replace("\"count\": 3", "\"count\": 4000000000"),
            "accessor 0: its 4000000000 items",
        ),
        (
            whole.replace("\"bufferView\": 0", "\"bufferView\": 9"),
            "accessor 0: it has no buffer view",
        ),
        (whole.replace("5126", "5120"), "faces"),
        (whole.replace("\"mesh\": 0", "\"mesh\": 3"), "mesh 3 is used"),
        (
            gltf("{\"children\": [1]}, {\"children\": [0]}, {\"children\": [0, 0]}"),
            "node 0: it is used twice",
        ),
        (whole.replace("data:", "../secret"), "not a file in this folder"),
        (whole.replace("base64,AAA", "base64,A!A"), "buffer 0: its base64"),
        ("glTF".to_owned(), "byte 4"),
        (String::new(), "line 1"),
    ] {
        let message = Scratch::new("damaged.gltf", text).refused();
        assert!(message.contains(told), "{told}: {message}");
    }
}

proptest::proptest! {
    /// Whatever the faces, the door lets through only what makes a manifold once it is in triangles.
    #[test]
    fn what_passes_the_door_is_a_manifold(
        points in proptest::collection::vec(proptest::array::uniform3(0_i8..4), 4..9),
        faces in proptest::collection::vec(proptest::collection::vec(0_usize..9, 3..6), 1..8),
    ) {
        let mut text = String::new();
        for [x, y, z] in &points {
            let _ = writeln!(text, "v {x} {y} {z}");
        }
        for face in faces {
            let corners: Vec<String> = face.iter().map(|v| (v % points.len() + 1).to_string()).collect();
            let _ = writeln!(text, "f {}", corners.join(" "));
        }
        if let Ok(mesh) = Scratch::new("soup.obj", text).read() {
            let sampling = Sampling { max_edge: 1.0, chord_error: 0.1, corner_angle: 0.5 };
            let surface = mesh.surface(&sampling, &Job::default()).expect("a surface");
            let carrier = &surface.carrier;
            Mesh::from_triangles(carrier.points.len(), &carrier.triangles).expect("a manifold");
        }
    }

    /// Readers answer damaged files with a mesh or an error, never a panic.
    #[test]
    fn damaged_files_do_no_harm(
        format in 0_usize..5,
        cut in 0_usize..400,
        damage in proptest::collection::vec((0_usize..400, proptest::num::u8::ANY), 0..6),
    ) {
        let name = ["a.obj", "b.off", "c.stl", "d.ply", "e.ply"][format];
        let mut bytes = if format == 4 {
            binary_ply(false)
        } else {
            let xyz = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE];
            let file = Scratch::new(&format!("whole-{name}"), "");
            Made::new(&xyz, &[[0, 1, 2], [1, 3, 2]]).write(&file.0);
            fs::read(&file.0).expect("just written")
        };
        for (at, byte) in damage {
            let n = bytes.len();
            bytes[at % n] = byte;
        }
        bytes.truncate(bytes.len().saturating_sub(cut.saturating_sub(200)));
        let _ = Scratch::new(&format!("damaged-{name}"), bytes).read();
    }
}

#[test]
fn a_grid_file_reads_back_to_the_last_bit() {
    let xyz = [DVec3::new(1.0 / 3.0, -0.0, 5e-324), DVec3::X * 1e300, DVec3::Y, DVec3::ONE];
    let mut document = Document {
        surface: Some(Reference::Builtin("hexagon".into())),
        seed: Some(u64::MAX),
        edge_length: Some(0.1 + 0.2),
        recipe: Some(crate::recipe::Recipe::default()),
        places: vec![
            PlaceRecord::Interior(7, [0.1, 0.2, 0.7]),
            PlaceRecord::Boundary(0, 1.0 / 7.0),
            PlaceRecord::Corner(1, 2.0),
            PlaceRecord::Feature(2, 3.0),
        ],
        edits: vec![
            serde_json::json!({ "kind": "flip", "members": [[0, 1]], "at": 0.30000000000000004 }),
        ],
        ..Made::new(&[DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE], &[[0, 1, 2], [1, 3, 2]])
            .document
    };
    document.nodes = xyz.iter().map(DVec3::to_array).collect();
    let file = Scratch::new("again.gridshell", native::encode(&document, &Job::default()));
    let back = read_document(&file.0, &Job::default()).expect("a grid file");
    assert_eq!(back, document);
    assert!(back.nodes[0][1].is_sign_negative());
    assert_eq!(native::encode(&back, &Job::default()), fs::read(&file.0).expect("readable"));
}

#[test]
fn grid_files_that_are_none_are_refused_with_where() {
    let good = native::encode(
        &Made::new(&[DVec3::ZERO, DVec3::X, DVec3::Y], &[[0, 1, 2]]).document,
        &Job::default(),
    );
    let good = String::from_utf8(good).expect("JSON");
    for (from, to, told) in [
        ("gridshell.grid/1", "gridshell.grid/9", "schema: its schema is `gridshell.grid/9`"),
        ("[0,1,2]", "[0,1,7]", "panel 0: it uses node 7"),
        ("[0,1,2]", "[0,1]", "line"),
        ("\"units\": \"m\"", "\"units\": \"mm\"", "units: lengths in `mm`"),
        ("\"edits\"", "\"edots\"", "line"),
    ] {
        assert!(good.contains(from), "{from}");
        let file = Scratch::new("wrong.gridshell", good.replace(from, to));
        let error = read_document(&file.0, &Job::default()).expect_err(to).to_string();
        assert!(error.contains(told), "{error}");
    }
}

#[test]
fn every_format_is_written_and_names_its_version() {
    let made = Made::new(&[DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE], &[[0, 1, 2], [1, 3, 2]]);
    for name in ["a.gridshell", "a.glb", "a.dxf", "a.compas.json", "a.vtu", "a.ifc", "a.tcl"] {
        let file = Scratch::new(name, "");
        made.write(&file.0);
        let text = String::from_utf8_lossy(&fs::read(&file.0).expect("written")).into_owned();
        assert!(text.contains(env!("CARGO_PKG_VERSION")) && text.contains("seed"), "{name}");
    }
    let file = Scratch::new("a.saf.xlsx", "");
    made.write(&file.0);
    let bytes = fs::read(&file.0).expect("written");
    made.write(&file.0);
    assert!(bytes == fs::read(&file.0).expect("written") && bytes.starts_with(b"PK"));
}

#[test]
fn unknown_names_and_extensions_are_answered_with_the_known_ones() {
    let message = open("great-curt", &Job::default()).expect_err("an error").to_string();
    assert!(message.contains("great-court") && message.contains("facade"), "{message}");
    let message = Scratch::new("roof.xyz", "").refused();
    assert!(message.contains("obj, ply, stl, off"), "{message}");
    assert!(matches!(open("hexagon", &Job::default()), Ok(Model::Brep(_))));
}

#[test]
fn a_mesh_with_one_vertex_far_away_is_refused_by_that_vertex() {
    // One coordinate of 65536 made a spike of 65 km, and a minute of work.
    let sheet = |far: [f64; 3], scale: f64| {
        let mut text = String::new();
        for k in 0..16 {
            let p = [f64::from(k % 4) * scale, f64::from(k / 4) * scale, 0.0];
            let [x, y, z] = if k == 5 { far } else { p };
            text += &format!("v {x} {y} {z}\n");
        }
        for k in (1..=11).filter(|k| k % 4 != 0) {
            text += &format!("f {} {} {} {}\n", k, k + 1, k + 5, k + 4);
        }
        text
    };
    for (far, scale) in
        [([1.0, 1.0, 65536.0], 1.0), ([-1e5, 1.0, 0.0], 5.0), ([9.0, 9.0, 9.0], 0.01)]
    {
        let told = Scratch::new("spike.obj", sheet(far, scale)).refused();
        assert!(
            told.contains("face 1: its vertex at") && told.contains("most likely wrong"),
            "{told}"
        );
    }
    assert!(Scratch::new("hill.obj", sheet([1.0, 1.0, 20.0], 1.0)).read().is_ok());
}
