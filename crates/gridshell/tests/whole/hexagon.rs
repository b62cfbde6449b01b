//! The hexagon of side 4 with members of 1: one grid is right, and it is known.

use crate::promise::{kept, model, paper, recipe};
use gridshell::recipe::Recipe;

#[test]
fn every_seed_finds_the_perfect_lattice() {
    for seed in 1..=10 {
        let run = kept(&model("hexagon"), &Recipe { seed, ..recipe(1.0) });
        let q = &run.quality;
        assert_eq!((q.nodes, q.members, q.panels), (61, 156, 96), "seed {seed}");
        assert_eq!(q.mu, 0.0, "seed {seed}");
        assert!(q.edge_length.cv < 1e-9, "seed {seed}: {}", q.edge_length.cv);
        assert_eq!(q.fluency, None, "seed {seed}");
        assert!(run.irregular.is_empty(), "seed {seed}");
    }
}

#[test]
fn the_method_as_printed_gives_a_valid_grid() {
    let run = kept(&model("hexagon"), &paper(1.0));
    assert!((55..=67).contains(&run.quality.nodes), "{}", run.quality.nodes);
    assert!(run.quality.edge_length.cv < 0.2, "{}", run.quality.edge_length.cv);
}
