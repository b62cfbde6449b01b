//! The files in `files/`, opened and held against what OpenCascade measured of them when it made them.
//!
//! A format that `io` does not read is passed over, and its files come in by themselves once it does.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use gridshell::io::Choice;
use gridshell::io::{LengthUnit, Opening};
use gridshell::job::Job;
use gridshell::mesh::Mesh;
use gridshell::surface::{Chain, Model, Sampling, Surface, SurfacePoint};
use std::path::{Path, PathBuf};

/// Largest share by which an area may be off.
const AREA: f64 = 1e-4;
/// Carrier edges over the size of the model.
const EDGE: f64 = 1.0 / 40.0;

/// A row of the table.
struct Row {
    path: PathBuf,
    area: f64,
    faces: usize,
    loops: usize,
    corners: usize,
    joined: String,
}

fn rows() -> Vec<Row> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files");
    let table = std::fs::read_to_string(folder.join("table.csv")).unwrap();
    table.lines().skip(1).map(|line| row(&folder, line)).collect()
}

/// `file,what,area_m2,faces,loops,corners,joined`; what is told may hold commas between quotes.
fn row(folder: &Path, line: &str) -> Row {
    let (file, rest) = line.split_once(',').unwrap();
    let mut cells = rest.rsplitn(6, ',');
    let mut next = || cells.next().unwrap().to_owned();
    let (joined, corners, loops, faces, area) = (next(), next(), next(), next(), next());
    Row {
        path: folder.join(file),
        area: area.parse().unwrap(),
        faces: faces.parse().unwrap(),
        loops: loops.parse().unwrap(),
        corners: corners.parse().unwrap(),
        joined,
    }
}

/// The surface of a file; None where nobody reads its format.
fn open(row: &Row) -> Option<Result<(Model, Surface), String>> {
    let model = match gridshell::io::load(&row.path, &Opening::default(), &Job::default()) {
        Err(gridshell::Error::Option(_)) => return None,
        Err(e) => return Some(Err(e.to_string())),
        Ok(model) => model,
    };
    let max_edge = EDGE * model.size();
    Some(sampled(&model, max_edge).map(|s| (model, s)))
}

fn sampled(model: &Model, max_edge: f64) -> Result<Surface, String> {
    let sampling = Sampling { max_edge, chord_error: 0.004 * max_edge, corner_angle: 0.5 };
    model.surface(&sampling, &Job::default()).map_err(|e| e.to_string())
}

/// What is not as the table says.
fn faults(row: &Row, model: &Model, surface: &Surface) -> Vec<String> {
    let mut faults = Vec::new();
    let mut hold = |what: &str, is: f64, should: f64, share: f64| {
        if (is - should).abs() > share * should {
            faults.push(format!("{what} {is}, not {should}"));
        }
    };
    hold("area", surface.area, row.area, AREA);
    if let Model::Brep(brep) = model {
        hold("faces", brep.faces.len() as f64, row.faces as f64, 0.0);
    }
    let corners: usize = surface.loops.iter().map(|l| l.corners.len()).sum();
    // Whether faces that only touch are one depends on sewing.
    if ["shared", "solid"].contains(&row.joined.as_str()) {
        hold("loops", surface.loops.len() as f64, row.loops as f64, 0.0);
        hold("corners", corners as f64, row.corners as f64, 0.0);
    }
    let c = &surface.carrier;
    if let Err(e) = Mesh::from_triangles(c.points.len(), &c.triangles) {
        faults.push(format!("no manifold: {e}"));
    }
    let mut off = 0.0_f64;
    for t in 0..c.triangles.len() as u32 {
        let middle = SurfacePoint { triangle: t, bary: [1.0 / 3.0; 3] };
        off = off.max(surface.exact(&middle).distance(c.xyz(&middle)));
    }
    if off > 0.3 * EDGE * model.size() {
        faults.push(format!("a point of the carrier is {off} m off the surface"));
    }
    faults
}

#[test]
fn every_file_opens_with_the_area_loops_and_corners_of_its_table() {
    let mut read = 0;
    let mut faults_of_all = Vec::new();
    for row in rows() {
        let name = row.path.file_name().unwrap().to_string_lossy().into_owned();
        let found = match open(&row) {
            None => continue,
            Some(Err(e)) => vec![e],
            Some(Ok((model, surface))) => faults(&row, &model, &surface),
        };
        read += 1;
        faults_of_all.extend(found.into_iter().map(|f| format!("{name}: {f}")));
    }
    assert!(faults_of_all.is_empty(), "\n{}", faults_of_all.join("\n"));
    let least = if cfg!(feature = "3dm") { 91 } else { 69 };
    assert!(read >= least, "only {read} files are read");
}

/// The surfaces of all files whose names begin so, sampled equally.
fn alike(start: &str) -> Vec<Surface> {
    let models: Vec<Model> = rows()
        .iter()
        .filter(|r| r.path.file_name().unwrap().to_string_lossy().starts_with(start))
        .filter_map(|r| open(r).map(|s| s.unwrap().0))
        .collect();
    // A size is looked up at a few points of each edge: files that cut edges elsewhere differ in its fourth digit.
    let max_edge = EDGE * models[0].size();
    models.iter().map(|m| sampled(m, max_edge).unwrap()).collect()
}

#[test]
fn the_same_surface_has_the_same_carrier_in_every_format_unit_and_schema() {
    // Files begin loops elsewhere, list faces and edges in other orders and run curves backwards.
    for (start, least) in [("roof", 7), ("patch", 4)] {
        let surfaces = alike(start);
        assert!(surfaces.len() >= least);
        let first = &surfaces[0];
        for surface in &surfaces {
            assert!((surface.area / first.area - 1.0).abs() < 1e-6);
            let length = |s: &Surface| s.loops.iter().map(Chain::length).sum::<f64>();
            assert!((length(surface) / length(first) - 1.0).abs() < 1e-6);
            let (a, b) = (&surface.carrier, &first.carrier);
            assert!(a.triangles == b.triangles, "{}: other triangles", surface.name);
            let apart = a.points.iter().zip(&b.points).map(|(p, q)| p.distance(*q));
            let farthest = apart.fold(0.0, f64::max);
            assert!(farthest < 1e-6, "{}: {farthest} m apart", surface.name);
            let corners = |s: &Surface| s.loops.iter().map(|l| l.vertices[0]).collect::<Vec<_>>();
            assert_eq!(corners(surface), corners(first), "{}: loops begin elsewhere", surface.name);
        }
    }
}

#[cfg(feature = "3dm")]
#[test]
fn layers_and_objects_of_a_rhino_file_are_chosen_by_name() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files/objects_v7.3dm");
    let load = |layers: &[&str], objects: &[&str]| {
        let [layers, objects] = [layers, objects].map(|n| n.iter().map(|&s| s.into()).collect());
        let choice = Choice { layers, objects };
        gridshell::io::load(&file, &Opening { choice, ..Opening::default() }, &Job::default())
    };
    let kinds = |model: &Model| match model {
        Model::Brep(b) => b.source.objects.iter().filter(|o| o.faces > 0).count(),
        Model::Mesh(_) => 0,
    };
    // Ball, box, tube and beam; the mesh is told, the line is none of our business.
    assert_eq!(kinds(&load(&[], &[]).unwrap()), 4);
    assert_eq!(load(&["Tubes"], &[]).unwrap().parts().len(), 2);
    assert_eq!(load(&["tubes"], &["beam"]).unwrap().parts().len(), 1);
    assert_eq!(load(&[], &["box"]).unwrap().face_count(), 6);
    let mesh = load(&["meshes"], &[]).unwrap();
    assert!(matches!(&mesh, Model::Mesh(m) if !m.faces.is_empty()));
    let unknown = load(&["roof"], &[]).unwrap_err().to_string();
    assert!(unknown.contains("tubes") && unknown.contains("solids"), "{unknown}");
}

/// Tags are often wrong: the unit that was asked for goes before the one that the file states, in any format, and is told.
#[test]
fn a_unit_that_was_asked_for_goes_before_the_files() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files");
    let mut files = vec![
        "roof_mm_ap214.step",
        "roof_inch_ap242.step",
        "roof_mm.igs",
        "offset_free.step",
        "offset_tube.step",
    ];
    if cfg!(feature = "3dm") {
        files.extend(["patch_v5_mm.3dm", "patch_v8_in.3dm"]);
    }
    for file in files {
        let load = |unit| {
            gridshell::io::load(
                &folder.join(file),
                &Opening { unit, ..Opening::default() },
                &Job::default(),
            )
            .unwrap()
        };
        let area = |model: &Model| sampled(model, EDGE * model.size()).unwrap().area;
        let unit_of = |model: &Model| match model {
            Model::Brep(brep) => brep.unit_in_metres,
            Model::Mesh(_) => 1.0,
        };
        let stated = load(None);
        for (unit, metres) in [(LengthUnit::Metre, 1.0), (LengthUnit::Foot, 0.3048)] {
            let wanted = load(Some(unit));
            let factor = metres / unit_of(&stated);
            let share = area(&wanted) / (area(&stated) * factor * factor);
            assert!((share - 1.0).abs() < 1e-6, "{file}: {share}");
            assert_eq!(unit_of(&wanted), metres, "{file}");
            let told = wanted.notes().iter().any(|n| n.contains("was asked for"));
            assert_eq!(told, factor != 1.0, "{file}: {:?}", wanted.notes());
        }
    }
}

/// A model that no one builds at its size most likely has the wrong unit, be it patches or a mesh.
#[test]
fn an_odd_size_is_told_of_patches_and_meshes() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files");
    let odd = |path: &Path, unit| {
        let opening = Opening { unit: Some(unit), ..Opening::default() };
        let model = gridshell::io::load(path, &opening, &Job::default()).unwrap();
        model.notes().iter().any(|n| n.contains("m across") && n.contains("--units"))
    };
    let step = folder.join("roof_m_ap203.step");
    assert!(!odd(&step, LengthUnit::Metre) && odd(&step, LengthUnit::Millimetre));
    for (end, text) in [
        ("obj", "v 0 0 0\nv 10 0 0\nv 0 10 0\nf 1 2 3\n"),
        ("off", "OFF\n3 1 0\n0 0 0\n10 0 0\n0 10 0\n3 0 1 2\n"),
    ] {
        let path = std::env::temp_dir().join(format!("gridshell-odd-{}.{end}", std::process::id()));
        std::fs::write(&path, text).unwrap();
        assert!(!odd(&path, LengthUnit::Metre) && odd(&path, LengthUnit::Millimetre));
        std::fs::remove_file(&path).unwrap();
    }
}

/// The class of an object, or of a part of one, made one that nobody knows: as new versions of Rhino write them.
#[cfg(feature = "3dm")]
fn unknown(bytes: &mut [u8], class: [u8; 16]) {
    let places: Vec<usize> = (0..bytes.len() - 16).filter(|&k| bytes[k..k + 16] == class).collect();
    assert!(!places.is_empty());
    for k in places {
        bytes[k..k + 16].fill(0xEE);
    }
}

/// Identifiers of classes, the way they lie in a file.
#[cfg(feature = "3dm")]
const EXTRUSION: [u8; 16] = [
    0x75, 0x31, 0xF5, 0x36, 0xB8, 0x72, 0x47, 0x4D, 0xBF, 0x1F, 0xB4, 0xE6, 0xFC, 0x24, 0xF4, 0xB9,
];
#[cfg(feature = "3dm")]
const BREP: [u8; 16] = [
    0xC5, 0xDB, 0xB5, 0x60, 0x60, 0xE6, 0xD3, 0x11, 0xBF, 0xE4, 0x00, 0x10, 0x83, 0x01, 0x22, 0xF0,
];
#[cfg(feature = "3dm")]
const BLOCK: [u8; 16] = [
    0x38, 0xB6, 0xCF, 0xF9, 0xD4, 0xB9, 0x40, 0x43, 0x87, 0xE3, 0xC5, 0x6E, 0x78, 0x65, 0xD9, 0x6A,
];

/// A mesh beside exact surfaces, an extrusion, breps and a block that nobody can read: each with name and layer.
#[cfg(feature = "3dm")]
#[test]
fn what_is_left_out_of_a_rhino_file_is_told_by_name_and_layer() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files");
    let told = |file: &str, class: Option<[u8; 16]>, choice: Choice| -> Vec<String> {
        let mut bytes = std::fs::read(folder.join(file)).unwrap();
        if let Some(class) = class {
            unknown(&mut bytes, class);
        }
        let path = std::env::temp_dir().join(format!("gridshell-{}-left.3dm", std::process::id()));
        std::fs::write(&path, bytes).unwrap();
        let model =
            gridshell::io::load(&path, &Opening { choice, ..Opening::default() }, &Job::default());
        std::fs::remove_file(&path).unwrap();
        match model {
            Ok(model) => {
                let losses = &model.source().losses;
                assert!(losses.iter().all(|loss| loss.whole));
                losses.iter().map(ToString::to_string).collect()
            }
            Err(e) => vec![e.to_string()],
        }
    };
    let all = Choice::default;
    let mesh = "left out mesh `mesh` on layer `meshes` (2 faces, about 4.45 m2)";
    let one = |told: Vec<String>| {
        assert_eq!(told.len(), 1, "{told:?}");
        told.concat()
    };
    let only = one(told("objects_v7.3dm", None, all()));
    assert!(only.starts_with(mesh), "{only}");
    let lost = told("objects_v7.3dm", Some(EXTRUSION), all());
    assert!(lost.len() == 2 && lost[0].contains("extrusion `beam` on layer `tubes`"), "{lost:?}");
    let lost = told("objects_v7.3dm", Some(BREP), all());
    assert_eq!(lost.len(), 4, "{lost:?}");
    for (loss, name) in lost.iter().zip([
        "ball` on layer `solids",
        "box` on layer `solids",
        "tube` on layer `tubes",
    ]) {
        assert!(loss.contains(name) && loss.contains("export it as STEP"), "{loss}");
    }
    // What was not asked for is not a loss.
    let tubes = Choice { layers: vec!["tubes".into()], ..Choice::default() };
    assert_eq!(told("objects_v7.3dm", Some(BREP), tubes).len(), 1);
    // Nothing else is there: the error says it.
    let refused = one(told("tube_v6.3dm", Some(BREP), all()));
    assert!(refused.contains("brep `tube` on layer `tubes`"), "{refused}");
    let refused = one(told("block_mirrored_v5.3dm", Some(BREP), all()));
    assert!(refused.contains("brep `member`"), "{refused}");
    let refused = one(told("block_stretched_v7.3dm", Some(BLOCK), all()));
    assert!(refused.contains("block `stretched`"), "{refused}");
}
