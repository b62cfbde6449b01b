//! The stages as the paper prints them, one by one: each does what it is for.

use crate::promise::{kept, model, paper, surface};
use gridshell::bubbles::Bubbles;
use gridshell::degree;
use gridshell::grid::Grid;
use gridshell::job::Job;
use gridshell::recipe::{self, Recipe};
use gridshell::stages::measure::{Quality, compare};
use gridshell::stages::{pack, regularize, relax, triangulate};
use gridshell::surface::{ChainPoint, Surface};

const LENGTH: f64 = 3.0;

fn random_bubbles(surface: &Surface) -> Bubbles {
    let pieces = pack::boundary::pieces(surface);
    let counts: Vec<usize> =
        pieces.iter().map(|p| pack::boundary::member_count(p, LENGTH)).collect();
    let boundary = pack::boundary::place(surface, &pieces, &counts, 0.0);
    let count = pack::interior_count(surface, boundary.len(), LENGTH, 1.0);
    let mut bubbles = Bubbles { boundary, ..Bubbles::default() };
    let mut rng = fastrand::Rng::with_seed(5);
    bubbles.interior = pack::scatter(
        surface,
        count,
        &bubbles.xyz(surface),
        0.6 * LENGTH,
        &mut rng,
        &Job::default(),
    );
    bubbles
}

fn settled(surface: &Surface, recipe: &Recipe) -> (Bubbles, Vec<ChainPoint>, pack::Report) {
    let mut bubbles = random_bubbles(surface);
    let before = bubbles.boundary.clone();
    let report = pack::settle(surface, &mut bubbles, LENGTH, &recipe.pack, &Job::default());
    (bubbles, before, report)
}

fn triangulated(surface: &Surface, recipe: &Recipe) -> Grid {
    triangulate::triangulate(surface, &settled(surface, recipe).0, &Job::default()).unwrap().0
}

fn quality(grid: &Grid, surface: &Surface) -> Quality {
    compare(grid, surface, LENGTH, &recipe::Measure::default())
}

/// Mean distance of an interior bubble to its nearest neighbour, over l0.
fn mean_gap(bubbles: &Bubbles, surface: &Surface) -> f64 {
    let xyz = bubbles.xyz(surface);
    let nearest = |i: usize| {
        let others = (0..xyz.len()).filter(|&j| j != i);
        others.map(|j| xyz[i].distance(xyz[j])).fold(f64::MAX, f64::min)
    };
    let interior = bubbles.boundary.len()..xyz.len();
    interior.clone().map(nearest).sum::<f64>() / interior.len() as f64 / LENGTH
}

#[test]
fn bubbles_settle_and_part_while_the_boundary_stays() {
    for name in ["saddle", "dome", "barrel"] {
        let surface = surface(&model(name), LENGTH);
        let recipe = paper(LENGTH);
        let (bubbles, boundary, report) = settled(&surface, &recipe);
        assert!(report.converged, "{name}: {report:?}");
        assert!(report.last_move < recipe.pack.settled, "{name}: {report:?}");
        assert_eq!(bubbles.boundary, boundary, "{name}");
        let gap = mean_gap(&bubbles, &surface);
        assert!(gap > 0.85, "{name}: bubbles are {gap} l0 apart");
    }
}

#[test]
fn algorithm_1_lowers_the_residual_and_keeps_the_node_count_in_its_range() {
    for name in ["saddle", "dome", "torus"] {
        let surface = surface(&model(name), LENGTH);
        let recipe = paper(LENGTH);
        let before = triangulated(&surface, &recipe);
        let residual = |g: &Grid| degree::residual(&g.mesh, &g.xyz, recipe.measure.lambda);
        let (after, report) = regularize::regularize(
            &surface,
            before.clone(),
            LENGTH,
            &recipe,
            recipe.seed,
            &Job::default(),
        );
        after.mesh.check().unwrap();
        assert_eq!(after.mesh.euler_characteristic(), before.mesh.euler_characteristic());
        assert!(
            residual(&after) < residual(&before),
            "{name}: {} to {}, {report}",
            residual(&before),
            residual(&after)
        );
        let change = after.mesh.vertex_count() as f64 / before.mesh.vertex_count() as f64 - 1.0;
        assert!(change.abs() <= recipe.regularize.node_range + 0.01, "{name}: {change}");
    }
}

#[test]
fn the_net_evens_the_lengths_and_leaves_connectivity_alone() {
    for name in ["saddle", "dome", "torus"] {
        let surface = surface(&model(name), LENGTH);
        let recipe = paper(LENGTH);
        let before = triangulated(&surface, &recipe);
        let mut after = before.clone();
        let report = relax::relax(&surface, &mut after, &recipe, &Job::default());
        assert!(report.converged, "{name}: {report:?}");
        let cv = |g: &Grid| quality(g, &surface).edge_length.cv;
        assert!(cv(&after) < cv(&before), "{name}: {} to {}", cv(&before), cv(&after));
        let panels = |g: &Grid| g.mesh.triangles().collect::<Vec<_>>();
        assert_eq!(panels(&after), panels(&before), "{name}");
    }
}

#[test]
fn the_whole_method_as_printed_keeps_every_promise() {
    for name in ["saddle", "dome", "torus"] {
        kept(&model(name), &paper(LENGTH));
    }
}
