//! Triangulating by itself: the surface's topology is kept even where the bubbles could not carry it.

use crate::promise::{model, surface};
use gridshell::bubbles::Bubbles;
use gridshell::job::Job;
use gridshell::stages::{pack, triangulate};

/// Triangulate as few bubbles on the boundary as there may be, and `count` random ones inside; gives the
/// number of nodes added.
fn few(name: &str, edge_length: f64, count: usize, seed: u64) -> usize {
    added(name, edge_length, f64::INFINITY, count, seed)
}

/// As [`few`], with members of `along` metres on the boundary.
fn added(name: &str, edge_length: f64, along: f64, count: usize, seed: u64) -> usize {
    let surface = surface(&model(name), edge_length);
    let pieces = pack::boundary::pieces(&surface);
    let counts: Vec<usize> =
        pieces.iter().map(|p| pack::boundary::member_count(p, along)).collect();
    let boundary = pack::boundary::place(&surface, &pieces, &counts, 0.0);
    let mut rng = fastrand::Rng::with_seed(seed);
    let interior = pack::scatter(&surface, count, &[], 0.0, &mut rng, &Job::default());
    let bubbles = Bubbles { boundary, interior, ..Bubbles::default() };
    let (grid, report) = triangulate::triangulate(&surface, &bubbles, &Job::default()).unwrap();
    grid.mesh.check().unwrap();
    assert_eq!(grid.mesh.euler_characteristic(), surface.euler_characteristic(), "{name} {seed}");
    assert_eq!(grid.mesh.boundary_loops().len(), surface.loops.len(), "{name} {seed}");
    assert_eq!(grid.xyz.len(), bubbles.len() + report.added.len(), "{name} {seed}");
    report.added.len()
}

#[test]
fn a_torus_takes_seven_nodes_and_gets_them() {
    for seed in 0..3 {
        for count in [0, 1, 3, 6] {
            let added = few("torus", 9.0, count, seed);
            assert!(count + added >= 7, "{count} bubbles and {added} nodes make no torus");
        }
    }
}

#[test]
fn a_sphere_takes_four_nodes_and_gets_them() {
    for seed in 0..3 {
        for count in [0, 1, 2, 3] {
            let added = few("sphere", 9.0, count, seed);
            assert!(count + added >= 4, "{count} bubbles and {added} nodes make no sphere");
        }
    }
}

#[test]
fn enough_bubbles_need_no_nodes_beside_them() {
    for name in ["torus", "sphere", "saddle", "great-court"] {
        assert_eq!(added(name, 4.0, 2.0, 400, 1), 0, "{name}");
    }
}

#[test]
fn boundaries_without_bubbles_inside_keep_their_loops() {
    for name in ["dome", "saddle", "great-court", "roof"] {
        few(name, 4.0, 0, 1);
    }
}
