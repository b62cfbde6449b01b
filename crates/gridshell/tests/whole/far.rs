//! Far from the origin is as near: the same grid, bit for bit where the file's numbers allow it, for meshes and patches,
//! in metres and millimetres, far in one axis or three, on both sides of zero; all that goes in beside the surface and
//! all that comes out is in the file's coordinates.

use crate::promise::{check, quick};
use gridshell::design::{Design, Reopening};
use gridshell::edit::Edit;
use gridshell::io::{self, LengthUnit, Opening};
use gridshell::job::Job;
use gridshell::recipe::{Direction, Effort, Recipe, Size};
use gridshell::run::Run;
use gridshell::structure::Supports;
use gridshell::surface::brep::BrepFace;
use gridshell::surface::nurbs::NurbsSurface;
use gridshell::surface::{Brep, Model, Shape};
use gridshell::{DVec3, pipeline};
use std::fmt::Write;
use std::path::PathBuf;

/// Where models are drawn: far in two axes, in one, in three, and below and left of the origin.
const PLACES: [DVec3; 4] = [
    DVec3::new(500_000.0, 4_000_000.0, 0.0),
    DVec3::new(0.0, 0.0, -30_000.0),
    DVec3::new(653_000.0, 5_412_000.0, 2_000.0),
    DVec3::new(-4_000_000.0, 7_000.0, -1_000.0),
];
/// A place comes back to this, metres.
const BACK: f64 = 1e-6;

/// A file of its own for each test.
fn scratch(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("gridshell-far-{}-{name}", std::process::id()))
}

/// A dome of quads over 24 x 20 m, its numbers in 64ths, drawn at `place` in a unit of so many to the metre.
fn mesh(name: &str, place: DVec3, to_metre: f64) -> Model {
    let path = scratch(name);
    std::fs::write(&path, text(place, to_metre)).unwrap();
    let unit = (to_metre != 1.0).then_some(LengthUnit::Millimetre);
    let model = io::load(&path, &Opening { unit, ..Opening::default() }, &Job::default()).unwrap();
    std::fs::remove_file(&path).unwrap();
    model
}

/// The same as OBJ.
fn text(place: DVec3, to_metre: f64) -> String {
    let mut text = String::new();
    for i in 0..=12 {
        for j in 0..=10 {
            let [x, y] = [f64::from(2 * i), f64::from(2 * j)];
            let p = place + DVec3::new(x, y, (x * (24.0 - x) + y * (20.0 - y)) / 64.0);
            writeln!(text, "v {} {} {}", p.x * to_metre, p.y * to_metre, p.z * to_metre).unwrap();
        }
    }
    for i in 0..12 {
        for j in 1..=10 {
            let a = 11 * i + j;
            writeln!(text, "f {a} {} {} {}", a + 11, a + 12, a + 1).unwrap();
        }
    }
    text
}

/// A bicubic patch over 18 x 18 m, its control points in 64ths.
fn patch(place: DVec3) -> Model {
    let lift =
        [[0.0, 1.5, 2.5, 0.5], [1.0, 6.0, 7.25, 2.0], [0.5, 4.0, 6.5, 3.0], [0.0, 1.0, 2.0, 0.25]];
    let points = (0..16).map(|k| {
        let (i, j) = (k / 4, k % 4);
        place + DVec3::new(6.0 * i as f64, 6.0 * j as f64, lift[i][j])
    });
    let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
    let shape =
        NurbsSurface::new([3, 3], [knots.clone(), knots], [4, 4], points.collect(), Vec::new());
    let face = BrepFace {
        shape: Shape::Nurbs(shape.unwrap()),
        loops: Vec::new(),
        reversed: false,
        label: String::new(),
    };
    let mut model = Model::Brep(Brep { faces: vec![face], unit_in_metres: 1.0, ..Brep::default() });
    model.settle().unwrap();
    model
}

fn lay(model: &Model, recipe: &Recipe) -> Run {
    let run = pipeline::generate(model, recipe, &Job::default()).unwrap();
    check(model, &run);
    run
}

fn panels(run: &Run) -> Vec<[u32; 3]> {
    run.grid.mesh.triangles().collect()
}

fn world(run: &Run) -> Vec<DVec3> {
    run.grid.xyz.iter().map(|&p| run.origin.world(p)).collect()
}

/// The same grid, and moved back the same places.
fn assert_same(near: &Run, far: &Run, place: DVec3) {
    assert_eq!(panels(near), panels(far), "{place}");
    for (p, q) in world(near).into_iter().zip(world(far)) {
        assert!(p.distance(q - place) < BACK, "{place}: {p} {q}");
    }
    let figures = |run: &Run| {
        let q = &run.quality;
        [q.fluency.unwrap(), q.mu, q.delta_deg, q.edge_length.cv, q.shape.mean, q.area_ratio]
    };
    for (a, b) in figures(near).into_iter().zip(figures(far)) {
        assert!((a - b).abs() <= 1e-9 * a.abs(), "{place}: {a} {b}");
    }
}

#[test]
fn a_mesh_far_from_the_origin_gives_the_grid_that_it_gives_near() {
    let recipe = quick(2.4);
    let near = lay(&mesh("near.obj", DVec3::ZERO, 1.0), &recipe);
    for place in PLACES {
        let model = mesh("far.obj", place, 1.0);
        let far = lay(&model, &recipe);
        assert_same(&near, &far, place);
        let carrier = |run: &Run, model: &Model| {
            pipeline::surface(model, &run.recipe, &Job::default()).unwrap().0.carrier
        };
        let near = carrier(&near, &mesh("again.obj", DVec3::ZERO, 1.0));
        assert_eq!(near.triangles, carrier(&far, &model).triangles, "the same work");
    }
}

#[test]
fn a_patch_far_from_the_origin_gives_the_grid_that_it_gives_near() {
    let recipe = quick(2.2);
    let near = lay(&patch(DVec3::ZERO), &recipe);
    for place in PLACES {
        assert_same(&near, &lay(&patch(place), &recipe), place);
    }
}

/// Millimetres round at ten digits before the point: the figures are the same, whatever the search does with the last
/// digits.
#[test]
fn a_mesh_in_millimetres_far_away_gives_a_grid_as_good() {
    let recipe = Recipe { effort: Effort::Draft, ..quick(2.4) };
    let near = lay(&mesh("near-mm.obj", DVec3::ZERO, 1000.0), &recipe);
    for place in PLACES {
        let far = lay(&mesh("far-mm.obj", place, 1000.0), &recipe);
        assert_eq!(far.quality.nodes, near.quality.nodes);
        let q = |run: &Run| run.quality.fluency.unwrap();
        assert!((q(&near) - q(&far)).abs() < 1e-3 * q(&near), "{} {}", q(&near), q(&far));
    }
}

/// What is fixed and wished for, in the coordinates of a surface drawn at `place`.
fn wishes(place: DVec3) -> Recipe {
    let at = |x: f64, y: f64| {
        (place + DVec3::new(x, y, (x * (24.0 - x) + y * (20.0 - y)) / 64.0)).to_array()
    };
    let row = |p: [f64; 3], more: f64| [p[0], p[1], p[2], more];
    let way = |p: [f64; 3]| [p[0], p[1], p[2], 1.0, 0.25, 0.0];
    Recipe {
        guides: vec![vec![at(4.0, 6.0), at(12.0, 6.0), at(20.0, 6.0)]],
        anchors: vec![at(10.0, 14.0), at(16.0, 12.0)],
        size: Size::Points { points: vec![row(at(0.0, 0.0), 2.0), row(at(24.0, 20.0), 3.0)] },
        direction: Direction::Points { points: vec![way(at(2.0, 2.0)), way(at(20.0, 18.0))] },
        ..quick(2.4)
    }
}

#[test]
fn what_is_fixed_is_given_in_the_files_coordinates_and_holds() {
    let near = lay(&mesh("near-fixed.obj", DVec3::ZERO, 1.0), &wishes(DVec3::ZERO));
    for place in PLACES {
        let recipe = wishes(place);
        let far = lay(&mesh("far-fixed.obj", place, 1.0), &recipe);
        assert_same(&near, &far, place);
        assert_eq!(far.recipe, recipe, "the run tells what was asked for");
        let nodes = world(&far);
        for &at in recipe.anchors.iter().chain(&recipe.guides[0]) {
            let off = nodes.iter().map(|p| p.distance(at.into())).fold(f64::INFINITY, f64::min);
            let anchor = recipe.anchors.contains(&at) || at == recipe.guides[0][0];
            assert!(!anchor || off < BACK, "{at:?}: {off}");
        }
        let box_of = |run: &Run| run.surface.bounds;
        for k in 0..3 {
            assert!((box_of(&far).min[k] - box_of(&near).min[k] - place[k]).abs() < BACK);
        }
        assert!(far.irregular.iter().all(|n| nodes[n.node as usize].to_array() == n.xyz));
    }
}

#[test]
fn places_in_refusals_are_the_files() {
    let place = PLACES[0];
    let model = mesh("refused.obj", place, 1.0);
    let mut recipe = wishes(place);
    recipe.anchors = vec![(place + DVec3::new(10.0, 10.0, 90.0)).to_array()];
    let told = pipeline::generate(&model, &recipe, &Job::default()).unwrap_err().to_string();
    assert!(told.contains("500010.000, 4000010.000, 90.000"), "{told}");
    recipe = Recipe { symmetry: gridshell::recipe::Symmetry::Turns(3), ..quick(2.4) };
    let told = pipeline::generate(&model, &recipe, &Job::default()).unwrap_err().to_string();
    assert!(told.contains("of its point (5000") && told.contains(", 40000"), "{told}");
    let symmetric = Recipe { symmetry: gridshell::recipe::Symmetry::X, ..quick(2.4) };
    let centre = lay(&model, &symmetric).symmetry.unwrap().centre;
    assert!((centre[0] - 500_012.0).abs() < 1e-6, "{centre:?}");
}

/// A grid laid far away, in all formats.
#[test]
fn every_format_has_the_files_coordinates_and_ours_open_again() {
    for (k, place) in PLACES.into_iter().enumerate() {
        let path = scratch(&format!("surface{k}.obj"));
        let model = mesh("format.obj", place, 1.0);
        std::fs::write(&path, text(place, 1.0)).unwrap();
        let reference =
            io::reference(&path.to_string_lossy(), &Opening::default(), &Job::default()).unwrap();
        let design = Design::generate(&model, &wishes(place), &Job::default()).unwrap();
        let mut design = design.referring_to(Some(reference));
        let nodes = world(design.run.as_ref().unwrap());
        design.support(&Supports::Points(vec![nodes[0], nodes[1]])).unwrap();
        assert_eq!(design.document.supports, [0, 1]);
        assert_eq!(design.document.anchors.len(), 2);
        for end in ["obj", "ply", "stl", "off", "glb", "json", "gridshell"] {
            let path = scratch(&format!("grid{k}.{end}"));
            design.write(&path, &Job::default()).unwrap();
            let opened = Design::open(&path, &Job::default()).unwrap();
            // STL holds no order of nodes.
            let loose = if end == "stl" { 1e-6 } else { 0.0 };
            let single = if end == "glb" { 1e-5 } else { loose };
            let back: Vec<DVec3> = opened.document.nodes.iter().map(|&p| p.into()).collect();
            for p in &nodes {
                let off = back.iter().map(|q| q.distance(*p)).fold(f64::INFINITY, f64::min);
                assert!(off <= single + 1e-9, "{end} at {place}: {off}");
            }
            if end == "gridshell" {
                assert_eq!(opened.document, design.document);
                assert_eq!(opened.grid.xyz, design.grid.xyz, "on its surface again, bit for bit");
                let of_surface = |n: &String| n.contains("the file states no unit");
                assert!(opened.summary.is_some(), "{:?}", opened.notes);
                assert!(opened.notes.iter().all(of_surface), "{:?}", opened.notes);
            }
            let how = Reopening { surface: Some(path_of(k)), ..Reopening::default() };
            let on = Design::open_with(&path, &how, &Job::default()).unwrap();
            assert!(on.schedule.nodes.off_surface.iter().all(|&d| d < 1e-4), "{end}");
            std::fs::remove_file(&path).unwrap();
        }
        for end in ["dxf", "csv", "compas.json", "vtu", "saf.xlsx", "ifc", "tcl"] {
            let written =
                design.write(&scratch(&format!("handed{k}.{end}")), &Job::default()).unwrap();
            let text = std::fs::read(&written[0]).unwrap();
            let text = String::from_utf8_lossy(&text);
            let first = nodes[0].y.to_string();
            assert!(
                end == "saf.xlsx" || text.contains(first.trim_end_matches(".0")),
                "{end}: {first}"
            );
            for file in &written {
                std::fs::remove_file(file).unwrap();
            }
        }
        std::fs::remove_file(&path).unwrap();
    }
}

fn path_of(k: usize) -> String {
    scratch(&format!("surface{k}.obj")).to_string_lossy().into_owned()
}

#[test]
fn edits_name_places_in_the_files_coordinates() {
    let edited = |place: DVec3| {
        let model = patch(place);
        let design = Design::generate(&model, &quick(2.2), &Job::default()).unwrap();
        let mut editor = design.edit();
        let run = design.run.as_ref().unwrap();
        let inside = |v: &u32| !run.grid.mesh.is_boundary(*v);
        let node = run.grid.mesh.vertices().filter(inside).nth(7).unwrap();
        let to = run.origin.world(run.grid.xyz[node as usize] + DVec3::new(0.25, 0.125, 0.0));
        editor.apply(Edit::Move { node, to: to.to_array() }).unwrap();
        let at = run.origin.world(run.grid.xyz[node as usize + 9]);
        editor.apply(Edit::AddAnchor { at: at.to_array() }).unwrap();
        let told = editor.preview(&Edit::AddAnchor { at: (place + DVec3::Z * 500.0).to_array() });
        let told = told.unwrap_err().to_string();
        let up = place + DVec3::Z * 500.0;
        assert!(told.contains(&format!("({:.3}, {:.3}, {:.3})", up.x, up.y, up.z)), "{told}");
        assert!(editor.log().edits.contains(&Edit::AddAnchor { at: at.to_array() }));
        let grid = editor.finished();
        grid.xyz.iter().map(|&p| run.origin.world(p)).collect::<Vec<DVec3>>()
    };
    let near = edited(DVec3::ZERO);
    for place in PLACES {
        let far = edited(place);
        assert!(near.iter().zip(&far).all(|(p, q)| p.distance(*q - place) < BACK), "{place}");
    }
}
