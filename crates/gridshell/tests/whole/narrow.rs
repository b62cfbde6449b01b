//! Places where the surface is narrower than a member.

use crate::promise::{kept, paper, quick};
use gridshell::job::Job;
use gridshell::pipeline;
use gridshell::recipe::Recipe;
use gridshell::surface::{Model, PolygonMesh, Sampling, builtin};
use gridshell::{DVec3, Error};
use std::f64::consts::TAU;

fn sheet(name: &str, xy: &[[f64; 2]], faces: Vec<Vec<u32>>) -> Model {
    let points = xy.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect();
    Model::Mesh(PolygonMesh { name: name.into(), points, faces, ..PolygonMesh::default() })
}

/// Two squares of side 6 joined by a neck of length 2, half a metre wide, about the origin.
fn dumbbell() -> Model {
    let right = [[1.0, -0.25], [1.0, -3.0], [7.0, -3.0], [7.0, 3.0], [1.0, 3.0], [1.0, 0.25]];
    let xy: Vec<[f64; 2]> = right.into_iter().chain(right.map(|[x, y]| [-x, -y])).collect();
    sheet("dumbbell", &xy, vec![(0..12).collect()])
}

/// A square of side 8 with a round hole of this radius about the origin.
fn pierced(radius: f64) -> Model {
    let ring = |k: u32| {
        let (sin, cos) = (TAU * f64::from(k) / 16.0).sin_cos();
        [radius * cos, radius * sin]
    };
    let rim = |k: u32| {
        let [x, y] = ring(k);
        let scale = 4.0 / x.abs().max(y.abs());
        [x * scale, y * scale]
    };
    let xy: Vec<[f64; 2]> = (0..16).map(ring).chain((0..16).map(rim)).collect();
    let faces = (0..16).map(|k| vec![k, 16 + k, 16 + (k + 1) % 16, (k + 1) % 16]).collect();
    sheet("pierced", &xy, faces)
}

#[test]
fn a_neck_narrower_than_a_member_is_kept_and_named() {
    for recipe in [quick(1.0), paper(1.0)] {
        let run = kept(&dumbbell(), &recipe);
        assert!(run.warnings.iter().any(|w| w.contains("narrower")), "{:?}", run.warnings);
    }
}

#[test]
fn a_hole_smaller_than_a_member_is_kept_and_named() {
    for recipe in [quick(1.0), paper(1.0)] {
        let run = kept(&pierced(0.1), &recipe);
        let loops = run.grid.mesh.boundary_loops();
        let around =
            loops.iter().filter(|l| l.iter().all(|&v| run.grid.xyz[v as usize].length() < 1.0));
        let nodes: Vec<_> = around.map(Vec::len).collect();
        assert!(nodes.len() == 1 && nodes[0] >= 3, "nodes round the hole: {nodes:?}");
        assert!(run.warnings.iter().any(|w| w.contains("narrower")), "{:?}", run.warnings);
    }
}

/// A patch with one coordinate out by half a million metres took a minute to find that no grid fits into it.
#[test]
fn a_strip_far_narrower_than_a_member_is_refused_at_once() {
    let strip = |width: f64| {
        let xy = [[0.0, 0.0], [50.0, 0.0], [50.0, width], [0.0, width]];
        sheet("strip", &xy, vec![(0..4).collect()])
    };
    for width in [0.01, 0.02, 0.04] {
        let told = pipeline::generate(&strip(width), &quick(1.0), &Job::default());
        let told = told.map(|_| ()).unwrap_err().to_string();
        assert!(told.contains("wide, far narrower than members of 1.000 m"), "{told}");
    }
    assert!(pipeline::generate(&strip(0.2), &quick(1.0), &Job::default()).is_ok());
}

/// Damaged files asked for nodes were answered with an edge length that nobody had given.
#[test]
fn nodes_that_no_members_make_are_refused_by_the_surface_s_own_figures() {
    let strip =
        sheet("strip", &[[0.0, 0.0], [1e6, 0.0], [1e6, 1.0], [0.0, 1.0]], vec![vec![0, 1, 2, 3]]);
    let recipe = Recipe { nodes: Some(400), edge_length: None, ..Recipe::default() };
    let error = pipeline::generate(&strip, &recipe, &Job::default()).expect_err("no room");
    assert!(matches!(error, Error::Surface(_)), "{error}");
    let message = error.to_string();
    assert!(message.contains("400 nodes") && message.contains("boundary"), "{message}");
}

/// A damaged file's edge, millions of times as long as its surface suits, was laid to an edge length that nobody gave.
#[test]
fn an_edge_far_too_long_for_its_surface_is_refused_by_its_place() {
    let sampling = Sampling { max_edge: 1e-7, chord_error: 1e-9, corner_angle: 1.0 };
    for name in ["dome", "barrel", "saddle"] {
        let model = builtin::model(name).expect("it is built in");
        let error = model.surface(&sampling, &Job::default()).err().expect("too many pieces");
        assert!(matches!(error, Error::Surface(_)), "{name}: {error}");
        assert!(error.to_string().contains("starts near ("), "{name}: {error}");
    }
}
