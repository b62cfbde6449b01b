//! Meshes that programs write in odd ways: faces without width, OFF files with any line breaks, copies in glTF.

use super::*;
use crate::surface::Model;

/// The parts of a mesh, its area and its corners.
fn measured(mesh: &PolygonMesh) -> (usize, f64) {
    let sampling = Sampling { max_edge: 1e9, chord_error: 1e9, corner_angle: 0.5 };
    let parts = Model::Mesh(mesh.clone()).parts().len();
    (parts, mesh.surface(&sampling, &Job::default()).expect("a surface").area)
}

fn told(mesh: &PolygonMesh, what: &str) -> bool {
    mesh.notes.iter().any(|note| note.contains(what))
}

/// A square of 10 with a face without width: inside it on its own, along its border, and between two faces where a
/// third one ends in its middle.
#[test]
fn faces_without_width_are_no_parts_and_leave_no_slits() {
    let square = "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\n";
    for (name, rest) in [
        ("inside", "v 3 3 0\nv 5 5 0\nv 7 7 0\nf 1 2 3\nf 1 3 4\nf 5 6 7\n"),
        ("border", "v 4 0 0\nf 1 2 3\nf 1 3 4\nf 1 5 2\n"),
        ("longer", "v 14 0 0\nf 1 2 3\nf 1 3 4\nf 1 2 5\n"),
        ("quad", "v 4 0 0\nv 7 0 0\nf 1 2 3\nf 1 3 4\nf 1 5 6 2\n"),
        ("diagonal", "v 5 5 0\nf 1 2 3\nf 1 5 4\nf 5 3 4\nf 1 3 5\n"),
        ("fan", "v 2 2 0\nv 7 7 0\nf 1 2 3\nf 1 5 4\nf 5 6 4\nf 6 3 4\nf 1 3 6\nf 1 6 5\n"),
        ("pentagon", "v 2 2 0\nv 7 7 0\nf 1 2 3\nf 1 5 4\nf 5 6 4\nf 6 3 4\nf 1 3 6 5\n"),
        ("bent", "v 5 5.0000001 0\nf 1 2 3\nf 1 5 4\nf 5 3 4\nf 1 3 5\n"),
    ] {
        for scale in [1.0, 1e-3, 1e4] {
            let scaled = |line: &str| {
                let Some(p) = line.strip_prefix("v ") else { return format!("{line}\n") };
                let p: Vec<f64> = p.split(' ').map(|x| x.parse::<f64>().unwrap() * scale).collect();
                format!("v {} {} {}\n", p[0], p[1], p[2])
            };
            let text: String = format!("{square}{rest}").lines().map(scaled).collect();
            let mesh = Scratch::new(&format!("{name}.obj"), text).read().expect(name);
            assert!(told(&mesh, "without width"), "{name}, {scale}: {:?}", mesh.notes);
            let (parts, area) = measured(&mesh);
            assert_eq!(parts, 1, "{name}, {scale}");
            let off = area / (100.0 * scale * scale) - 1.0;
            assert!(off.abs() < 1e-7, "{name}, {scale}: {off}");
            let surface = Model::Mesh(mesh).surface(
                &Sampling { max_edge: 1e9, chord_error: 1e9, corner_angle: 0.5 },
                &Job::default(),
            );
            assert_eq!(surface.expect(name).loops.len(), 1, "{name}, {scale}: no slit");
        }
    }
}

/// A triangle a thousand times as long as it is wide is a face, however small; a tetrahedron of needles stays closed.
#[test]
fn narrow_faces_that_can_be_seen_stay() {
    for (text, count) in [
        ("v 0 0 0\nv 10 0 0\nv 5 0.01 0\nf 1 2 3\n", 1),
        ("v 0 0 0\nv 1e-4 0 0\nv 0 1e-6 0\nv 1e-4 1e-6 0\nf 1 2 4 3\n", 1),
        ("v 0 0 0\nv 9 0 0\nv 4 0.01 0\nv 4 0 0.01\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n", 4),
    ] {
        let mesh = Scratch::new("narrow.obj", text).read().expect("a mesh");
        assert_eq!(mesh.faces.len(), count);
        assert!(!told(&mesh, "without width"), "{:?}", mesh.notes);
    }
}

/// Thin faces come in other formats too; in single precision they are as thin as its roundings.
#[test]
fn faces_without_width_go_in_every_format() {
    let off = "OFF\n5 3 0\n0 0 0\n9 0 0\n9 9 0\n0 9 0\n4 0 0\n4 0 1 2 3\n3 0 4 1\n3 0 1 4\n";
    let ply = "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\nproperty double z\n\
               element face 2\nproperty list uchar int vertex_indices\nend_header\n\
               0 0 0\n9 0 0\n9 9 0\n0 9 0\n4 0 0\n4 0 1 2 3\n3 0 4 1\n";
    let facet = |c: [[f64; 3]; 3]| {
        let v = c.map(|[x, y, z]| format!("vertex {x} {y} {z}\n")).concat();
        format!("facet normal 0 0 0\nouter loop\n{v}endloop\nendfacet\n")
    };
    let [a, b, c, d] = [[0.1, 0.1, 0.3], [9.1, 0.1, 0.3], [9.1, 9.1, 0.3], [0.1, 9.1, 0.3]];
    let m = [3.7, 0.1, 0.3 + 1e-7];
    let stl =
        format!("solid a\n{}{}{}endsolid\n", facet([a, b, c]), facet([a, c, d]), facet([a, m, b]));
    for (name, text) in [("thin.off", off), ("thin.ply", ply), ("thin.stl", &stl)] {
        let mesh = Scratch::new(name, text).read().expect(name);
        assert!(told(&mesh, "without width"), "{name}: {:?}", mesh.notes);
        let (parts, area) = measured(&mesh);
        assert!(parts == 1 && (area - 81.0).abs() < 1e-4, "{name}: {parts} parts of {area} m2");
    }
}

/// Two triangles of a square, and what programs write before, between and behind their numbers.
#[test]
fn off_is_read_by_words_wherever_its_lines_break() {
    let points = "0 0 0 2 0 0 2 2 0 0 2 0";
    let faces = "3 0 1 2 3 0 2 3";
    let plain = format!("OFF 4 2 5 {points} {faces}");
    let behind = |what: &str| {
        points
            .split(' ')
            .collect::<Vec<_>>()
            .chunks(3)
            .map(|p| p.join(" ") + " " + what + "\n")
            .collect::<String>()
    };
    let files = [
        ("one line", plain.clone()),
        ("a word a line", plain.replace(' ', "\n")),
        (
            "comments",
            plain.replace(" 5 ", " 5 # edges\n# now points\n").replace(" 3 0", "\n#\n3 0"),
        ),
        (
            "broken vertices",
            "OFF\n4 2 0\n0\n0 0\n2 0 0 2\n2 0 0 2 0\n3 0\n1 2\n3\n0 2 3\n".to_owned(),
        ),
        ("no number of edges", format!("OFF\n4 2\n{}{}", behind(""), "3 0 1 2\n3 0 2 3\n")),
        ("colours of four", format!("COFF 4 2 0\n{}{faces}", behind("1 0 0 1"))),
        ("colours of three", format!("COFF\n4 2 0\n{}{faces}", behind("255 0 7"))),
        ("normals", format!("NOFF 4 2 0 {} {faces}", behind("0 0 1"))),
        ("small letters", format!("noff\n4 2 0\n{}{faces}", behind("0 0 1"))),
        ("texture", format!("STOFF\n4 2 0\n{}{faces}", behind("0.5 0.5"))),
        (
            "all of it",
            format!(
                "STCNOFF\n4 2 0\n{}{faces}",
                behind("0 0 1 1 0 0 1 0.5 0.5").replace('\n', " ")
            ),
        ),
        ("weights", format!("4OFF\n4 2 0\n0 0 0 1 4 0 0 2 2 2 0 1 0 1 0 0.5\n{faces}")),
        ("three dimensions", format!("nOFF 3\n4 2 0\n{points}\n{faces}")),
        ("colours of faces", format!("OFF\n4 2 0\n{}3 0 1 2 255 0 0\n3 0 2 3 7\n", behind(""))),
        (
            "colours unannounced",
            format!("OFF\n4 2 0\n{}3 0 1 2 0.5 0.5 1\n3 0 2 3\n", behind("9 9 9 9")),
        ),
        (
            "broken, with colours of faces",
            format!("OFF\n4 2 0\n{points}\n3 0\n1 2 1 0 0\n3 0 2 3 1 0 0\n"),
        ),
    ];
    for (what, text) in &files {
        let mesh = Scratch::new("words.off", text).read().expect(what);
        assert_eq!(mesh.faces, [[0, 1, 2], [0, 2, 3]], "{what}");
        assert_eq!(mesh.points[2], DVec3::new(2.0, 2.0, 0.0), "{what}");
        assert_eq!(mesh.points[1], DVec3::new(2.0, 0.0, 0.0), "{what}");
    }
    for (text, told) in [
        ("OFF BINARY\n4 2 0\n\0\0".to_owned(), "binary OFF cannot be read"),
        (format!("nOFF 4\n4 2 0\n{points}"), "only three dimensions can be read, not 4"),
        (format!("{plain} 9"), "`9` stands behind the last face"),
        (plain.replace(" 3 0 2 3", " 3 0 2"), "the file ends before"),
        (plain.replace("2 3", "2 4"), "uses vertex 4"),
    ] {
        let message = Scratch::new("wrong.off", text).refused();
        assert!(message.contains(told), "{told}: {message}");
    }
}

/// A text glTF of a triangle (0 0 0, 1 0 0, 0 2 0), and these bytes behind it, seen by more views and accessors.
fn more_gltf(node: &str, bytes: &[u8], views: &str, accessors: &str) -> String {
    let mut all: Vec<u8> = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0, 0.0]
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    all.extend(bytes);
    let data = base64::Engine::encode(&base64::engine::general_purpose::STANDARD, &all);
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "nodes": [{node}],
        "meshes": [{{"name": "tile", "primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}}{accessors}],
        "bufferViews": [{{"buffer": 0, "byteLength": 36}}{views}],
        "buffers": [{{"byteLength": {}, "uri": "data:;base64,{data}"}}]}}"#,
        all.len()
    )
}

fn floats(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
}

fn instanced(places: &str) -> String {
    format!(
        r#"{{"mesh": 0, "extensions": {{"EXT_mesh_gpu_instancing": {{"attributes": {{{places}}}}}}}}}"#
    )
}

/// Copies moved; moved, turned in whole numbers and mirrored; scaled by a sparse accessor. Up is y there.
#[test]
fn copies_of_a_gltf_mesh_are_all_there() {
    let view =
        |length: usize| format!(r#", {{"buffer": 0, "byteOffset": 36, "byteLength": {length}}}"#);
    let moved = floats(&[0.0, 0.0, 0.0, 10.0, 0.0, 0.0, 20.0, 0.0, 5.0]);
    let accessor = r#", {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"}"#;
    let text = more_gltf(&instanced(r#""TRANSLATION": 1"#), &moved, &view(36), accessor);
    for required in ["", r#""extensionsRequired": ["EXT_mesh_gpu_instancing"], "#] {
        let text = text.replace("\"nodes\"", &format!("{required}\"nodes\""));
        let mesh = Scratch::new("moved.gltf", &text).read().expect("a mesh");
        assert!(mesh.notes.iter().all(|n| n.contains("separate")), "{:?}", mesh.notes);
        assert_eq!(measured(&mesh).0, 3);
        let farthest = mesh.points.iter().fold(DVec3::MIN, |m, p| m.max(*p));
        assert_eq!(farthest, DVec3::new(21.0, 0.0, 2.0));
        assert!(mesh.points.contains(&DVec3::new(20.0, -5.0, 0.0)));
    }

    // Half a turn about y (0, 1, 0, 0) as 16-bit numbers, the second copy mirrored in x.
    let turned: Vec<u8> =
        [0_i16, i16::MAX, 0, 0, 0, 0, 0, i16::MAX].iter().flat_map(|x| x.to_le_bytes()).collect();
    let bytes =
        [floats(&[5.0, 0.0, 0.0, 8.0, 0.0, 0.0]), turned, floats(&[1.0, 1.0, 1.0, -1.0, 1.0, 1.0])]
            .concat();
    let views = r#", {"buffer": 0, "byteOffset": 36, "byteLength": 24},
        {"buffer": 0, "byteOffset": 60, "byteLength": 16}, {"buffer": 0, "byteOffset": 76, "byteLength": 24}"#;
    let accessors = r#", {"bufferView": 1, "componentType": 5126, "count": 2, "type": "VEC3"},
        {"bufferView": 2, "componentType": 5122, "count": 2, "type": "VEC4", "normalized": true},
        {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"}"#;
    let places = instanced(r#""TRANSLATION": 1, "ROTATION": 2, "SCALE": 3"#);
    let mesh = Scratch::new("turned.gltf", more_gltf(&places, &bytes, views, accessors))
        .read()
        .expect("a mesh");
    let normal = |f: usize| {
        let [a, b, c] = [0, 1, 2].map(|k| mesh.points[mesh.faces[f][k] as usize]);
        (b - a).cross(c - a)
    };
    // The triangle faces z there, which is -y here: turned about, it faces y; mirrored, it stays.
    assert!(normal(0).y > 1.9 && normal(1).y < -1.9, "{} {}", normal(0), normal(1));
    let least = mesh.points.iter().fold(DVec3::MAX, |m, p| m.min(*p));
    let most = mesh.points.iter().fold(DVec3::MIN, |m, p| m.max(*p));
    assert!((least.x - 4.0).abs() < 1e-9 && (most.x - 8.0).abs() < 1e-9, "{least} {most}");

    // Sizes that are zero but for the second, which lies apart.
    let bytes = [floats(&[3.0, 3.0, 3.0]), vec![1]].concat();
    let views = r#", {"buffer": 0, "byteOffset": 36, "byteLength": 12}, {"buffer": 0, "byteOffset": 48, "byteLength": 1}"#;
    let accessor = r#", {"componentType": 5126, "count": 2, "type": "VEC3", "sparse": {"count": 1,
        "indices": {"bufferView": 2, "componentType": 5121}, "values": {"bufferView": 1}}}"#;
    let text = more_gltf(&instanced(r#""SCALE": 1"#), &bytes, views, accessor);
    let mesh = Scratch::new("sparse.gltf", text).read().expect("a mesh");
    assert!((measured(&mesh).1 - 9.0).abs() < 1e-9, "one triangle, three times as large");

    let unequal = more_gltf(
        &instanced(r#""TRANSLATION": 1, "SCALE": 0"#),
        &moved[..24],
        &view(24),
        &accessor_of(2),
    );
    let message = Scratch::new("unequal.gltf", unequal).refused();
    assert!(message.contains("node 0: its copies"), "{message}");
}

fn accessor_of(count: usize) -> String {
    format!(r#", {{"bufferView": 1, "componentType": 5126, "count": {count}, "type": "VEC3"}}"#)
}

/// Morph targets are followed, hidden nodes and coarser stand-ins left out, skins lost by name, compression refused.
#[test]
fn what_changes_the_shape_of_a_gltf_mesh_is_followed_or_named() {
    let view = r#", {"buffer": 0, "byteOffset": 36, "byteLength": 36}"#;
    let rise = floats(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let morphed = more_gltf(r#"{"mesh": 0, "weights": [2.0]}"#, &rise, view, &accessor_of(3))
        .replace(r#"{"POSITION": 0}"#, r#"{"POSITION": 0}, "targets": [{"POSITION": 1}]"#);
    let mesh = Scratch::new("morphed.gltf", morphed).read().expect("a mesh");
    assert!((measured(&mesh).1 - 3.0).abs() < 1e-9, "three wide, two high");

    let hidden =
        r#"{"mesh": 0}, {"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": false}}}"#;
    let mesh = Scratch::new("hidden.gltf", gltf(hidden)).read().expect("a mesh");
    assert!(mesh.faces.len() == 1 && told(&mesh, "left out 1 hidden"), "{:?}", mesh.notes);

    let coarser = r#"{"mesh": 0, "extensions": {"MSFT_lod": {"ids": [1]}}}, {"mesh": 0, "translation": [9, 0, 0]}"#;
    let mesh = Scratch::new("coarser.gltf", gltf(coarser)).read().expect("a mesh");
    assert_eq!(mesh.faces.len(), 1);

    let skinned = more_gltf(r#"{"mesh": 0}, {"name": "arm", "mesh": 0, "skin": 0}"#, &[], "", "");
    let mesh = Scratch::new("skinned.gltf", &skinned).read().expect("a mesh");
    let loss = &mesh.source.losses[0];
    assert!(loss.what.contains("`tile`") && loss.faces == 1 && loss.whole, "{loss}");
    let alone = skinned.replace(r#"{"mesh": 0}, "#, "");
    let message = Scratch::new("alone.gltf", alone).refused();
    assert!(message.contains("bent by a skin; apply"), "{message}");

    let draco = gltf(r#"{"mesh": 0}"#).replace(
        "\"POSITION\": 0}",
        "\"POSITION\": 0}, \"extensions\": {\"KHR_draco_mesh_compression\": {}}",
    );
    assert!(Scratch::new("beside.gltf", &draco).read().is_ok(), "the numbers are there as well");
    let message = Scratch::new("draco.gltf", draco.replace("\"bufferView\": 0, ", "")).refused();
    assert!(message.contains("KHR_draco_mesh_compression); export it without"), "{message}");
    let packed = r#"{"buffer": 1, "extensions": {"EXT_meshopt_compression": {"buffer": 0}}, "#;
    let packed =
        gltf(r#"{"mesh": 0}"#).replace(r#"{"buffer": 0, "#, packed).replace("}]}", "}, {}]}");
    let message = Scratch::new("packed.gltf", packed).refused();
    assert!(message.contains("EXT_meshopt_compression), which cannot be read"), "{message}");
}
