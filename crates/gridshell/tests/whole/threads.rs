//! The same surface, recipe and seed: the same grid, bit for bit, on any number of threads.

use crate::promise::{model, paper, quick};
use gridshell::job::Job;
use gridshell::pipeline;
use gridshell::recipe::Recipe;

type Grid = (Vec<u64>, Vec<[u32; 3]>);

/// The bits of all positions, and the panels.
fn grid(name: &str, recipe: &Recipe, threads: usize) -> Grid {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let run = pool.install(|| pipeline::generate(&model(name), recipe, &Job::default())).unwrap();
    let bits = run.grid.flat_xyz().iter().map(|x| x.to_bits()).collect();
    (bits, run.grid.mesh.triangles().collect())
}

fn check(name: &str, recipe: &Recipe) {
    let once = grid(name, recipe, 1);
    assert!(once == grid(name, recipe, 2), "{name}: two threads give another grid than one");
    assert!(once == grid(name, recipe, 2), "{name}: a repeat gives another grid");
    let other = Recipe { seed: recipe.seed + 1, ..recipe.clone() };
    assert!(once != grid(name, &other, 2), "{name}: the seed changes nothing");
}

#[test]
fn a_lattice_start_does_not_depend_on_threads() {
    check("saddle", &quick(3.0));
}

#[test]
fn a_bubble_start_does_not_depend_on_threads() {
    check("torus", &quick(3.0));
}

#[test]
fn what_is_fixed_does_not_depend_on_threads() {
    let recipe = Recipe {
        guides: vec![vec![[-9.0, -9.0, 0.0], [0.0, -8.0, -1.0], [9.0, 6.0, 0.7]]],
        anchors: vec![[-8.0, 8.0, 0.0]],
        ..quick(3.0)
    };
    check("saddle", &recipe);
}

#[test]
fn the_method_as_printed_does_not_depend_on_threads() {
    check("saddle", &paper(3.0));
}
