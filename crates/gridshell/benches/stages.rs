//! Times of the stages on the saddle, over three sizes, and of what large grids need over 2,000, 10,000 and
//! 100,000 nodes. Never a gate.

#![allow(clippy::unwrap_used, reason = "a benchmark fails by panicking")]
#![allow(missing_docs, reason = "criterion's macros make functions without any")]

use criterion::{BatchSize, BenchmarkId, Criterion, criterion_group, criterion_main};
use gridshell::balance::{self, balance};
use gridshell::bubbles::Bubbles;
use gridshell::edit::{Edit, Editor};
use gridshell::grid::Grid;
use gridshell::job::Job;
use gridshell::recipe::Recipe;
use gridshell::stages::{pack, regularize, triangulate};
use gridshell::surface::chart::Chart;
use gridshell::surface::{Sampling, Surface, builtin};
use std::hint::black_box;
use std::sync::Arc;

/// Wanted members, metres: about 140, 520 and 2,000 nodes.
const LENGTHS: [f64; 3] = [3.0, 1.5, 0.75];

/// One size of the problem: what every stage starts from.
struct Size {
    length: f64,
    recipe: Recipe,
    surface: Surface,
    bubbles: Bubbles,
    grid: Grid,
}

impl Size {
    fn new(length: f64) -> Size {
        let recipe = Recipe { edge_length: Some(length), ..Recipe::named("paper").unwrap() };
        let sampling = Sampling {
            max_edge: 0.5 * length,
            chord_error: 2e-3 * length,
            corner_angle: recipe.corner_angle_deg.to_radians(),
        };
        let surface =
            builtin::model("saddle").unwrap().surface(&sampling, &Job::default()).unwrap();
        let pieces = pack::boundary::pieces(&surface);
        let counts: Vec<usize> =
            pieces.iter().map(|p| pack::boundary::member_count(p, length)).collect();
        let boundary = pack::boundary::place(&surface, &pieces, &counts, 0.0);
        let count = pack::interior_count(&surface, boundary.len(), length, recipe.pack.k_n);
        let mut bubbles = Bubbles { boundary, ..Bubbles::default() };
        bubbles.interior = pack::scatter(
            &surface,
            count,
            &bubbles.xyz(&surface),
            0.6 * length,
            &mut fastrand::Rng::with_seed(1),
            &Job::default(),
        );
        let mut settled = bubbles.clone();
        pack::settle(&surface, &mut settled, length, &recipe.pack, &Job::default());
        let grid = triangulate::triangulate(&surface, &settled, &Job::default()).unwrap().0;
        Size { length, recipe, surface, bubbles, grid }
    }
}

fn stages(criterion: &mut Criterion) {
    for size in LENGTHS.map(Size::new) {
        let id = |stage: &str| BenchmarkId::new(stage, format!("{} nodes", size.grid.xyz.len()));
        let Size { length, recipe, surface, bubbles, grid } = &size;
        let mut group = criterion.benchmark_group("saddle");
        group.sample_size(10);
        // A hundred steps: how many it takes to settle depends on chance.
        let steps = gridshell::recipe::Pack { max_steps: 100, ..recipe.pack.clone() };
        group.bench_function(id("pack 100 steps"), |b| {
            b.iter_batched_ref(
                || bubbles.clone(),
                |bubbles| pack::settle(surface, bubbles, *length, &steps, &Job::default()),
                BatchSize::LargeInput,
            );
        });
        group.bench_function(id("triangulate"), |b| {
            b.iter(|| {
                triangulate::triangulate(surface, black_box(bubbles), &Job::default()).unwrap()
            });
        });
        group.bench_function(id("regularize"), |b| {
            b.iter_batched(
                || grid.clone(),
                |grid| {
                    let job = Job::default();
                    regularize::regularize(surface, grid, *length, recipe, recipe.seed, &job)
                },
                BatchSize::LargeInput,
            );
        });
        let options = balance::Options {
            straightness: 0.3,
            border: 2.0,
            settled: 1e-6,
            max_steps: 10,
            accuracy: 1e-3,
        };
        group.bench_function(id("balance 10 steps"), |b| {
            b.iter_batched_ref(
                || grid.clone(),
                |grid| balance(surface, grid, &options, &Job::default()),
                BatchSize::LargeInput,
            );
        });
        group.finish();
    }
}

/// Wanted members, metres: about 2,000, 10,000 and 100,000 nodes.
const FINE_LENGTHS: [f64; 3] = [0.76, 0.338, 0.1062];

/// What a lattice start is made of.
fn scale(criterion: &mut Criterion) {
    for length in FINE_LENGTHS {
        let sampling =
            Sampling { max_edge: 0.7 * length, chord_error: 2e-3 * length, corner_angle: 0.5 };
        let model = builtin::model("saddle").unwrap();
        let surface = model.surface(&sampling, &Job::default()).unwrap();
        let flatten = || Chart::flatten(&surface, &Job::default()).unwrap().unwrap();
        let chart = flatten();
        let mut rng = fastrand::Rng::with_seed(1);
        let pieces = pack::boundary::pieces(&surface).len();
        let lattice = pack::lattice::Lattice::draw(pieces, &mut rng);
        let lay = || lattice.bubbles(&surface, &chart, length, 1.0, None, &Job::default());
        let bubbles = lay();
        let connect = || {
            triangulate::triangulate_in_chart(&surface, &chart, &bubbles, &Job::default()).unwrap()
        };
        let grid = connect();
        let id = |stage: &str| BenchmarkId::new(stage, format!("{} nodes", grid.xyz.len()));
        let mut group = criterion.benchmark_group("scale");
        group.sample_size(10);
        group.bench_function(id("tessellate"), |b| {
            b.iter(|| model.surface(&sampling, &Job::default()).unwrap());
        });
        group.bench_function(id("flatten"), |b| b.iter(flatten));
        group.bench_function(id("lay a lattice"), |b| b.iter(lay));
        group.bench_function(id("triangulate in the chart"), |b| b.iter(connect));
        let options = balance::Options {
            straightness: 0.3,
            border: 1.0,
            settled: 1e-6,
            max_steps: 3,
            accuracy: 0.05,
        };
        group.bench_function(id("balance 3 steps"), |b| {
            b.iter_batched_ref(
                || grid.clone(),
                |grid| balance(&surface, grid, &options, &Job::default()),
                BatchSize::LargeInput,
            );
        });
        group.finish();
    }
}

/// What editing takes: 2,000 and 5,000 nodes.
fn edit(criterion: &mut Criterion) {
    for length in [0.76, 0.48] {
        let sampling =
            Sampling { max_edge: 0.7 * length, chord_error: 2e-3 * length, corner_angle: 0.5 };
        let surface =
            builtin::model("saddle").unwrap().surface(&sampling, &Job::default()).unwrap();
        let pieces = pack::boundary::pieces(&surface).len();
        let chart = Chart::flatten(&surface, &Job::default()).unwrap().unwrap();
        let lattice = pack::lattice::Lattice::draw(pieces, &mut fastrand::Rng::with_seed(1));
        let bubbles = lattice.bubbles(&surface, &chart, length, 1.0, None, &Job::default());
        let mut grid =
            triangulate::triangulate_in_chart(&surface, &chart, &bubbles, &Job::default()).unwrap();
        grid.settle_exactly(&surface);
        let recipe = Recipe { edge_length: Some(length), ..Recipe::default() };
        let mut editor = Editor::new(Arc::new(surface), grid, recipe, length);
        let mesh = &editor.grid().mesh;
        let inside = |&(a, b): &(u32, u32)| !mesh.is_boundary(a) && !mesh.is_boundary(b);
        let nodes: [u32; 2] = mesh.edges().filter(inside).nth(500).unwrap().into();
        let id = |what: &str| BenchmarkId::new(what, format!("{} nodes", mesh.vertex_count()));
        let mut group = criterion.benchmark_group("edit");
        group.sample_size(20);
        let flip = Edit::Flip { nodes };
        group.bench_function(id("preview of a flip"), |b| {
            b.iter(|| editor.preview(black_box(&flip)).unwrap());
        });
        group.bench_function(id("hover"), |b| b.iter(|| editor.hover(nodes[0], nodes[1])));
        group.bench_function(id("suggest 10"), |b| b.iter(|| editor.suggest(10, &Job::default())));
        let id = id("apply and undo a flip");
        group.bench_function(id, |b| {
            b.iter(|| {
                editor.apply(flip.clone()).unwrap();
                editor.undo().unwrap();
            });
        });
        group.finish();
    }
}

criterion_group!(benches, stages, scale, edit);
criterion_main!(benches);
