//! Every built-in surface, coarse.

use crate::promise::{kept, model, quick};
use gridshell::surface::builtin;

/// Edge lengths over the sensible ones.
const COARSER: f64 = 2.5;

fn coarse(name: &str) {
    let length = builtin::ALL.iter().find(|b| b.name == name).unwrap().edge_length;
    let mut recipe = quick(COARSER * length);
    if name == "fold" {
        // At a gap of a sixth of a member, two grids are too few to choose one without leaps from.
        recipe.candidates = None;
    }
    let run = kept(&model(name), &recipe);
    let mean = run.quality.edge_length.mean / run.edge_length;
    assert!((0.85..1.15).contains(&mean), "{name}: mean length {mean} l0");
}

/// A test for each, so that they run side by side and fail by name.
macro_rules! coarse {
    ($($test:ident: $name:literal,)*) => {
        $(#[test]
        fn $test() {
            coarse($name);
        })*

        #[test]
        fn every_built_in_surface_is_tested() {
            let all: Vec<_> = builtin::ALL.iter().map(|b| b.name).collect();
            assert_eq!(all, [$($name),*]);
        }
    };
}

coarse! {
    great_court: "great-court",
    hexagon: "hexagon",
    dome: "dome",
    saddle: "saddle",
    barrel: "barrel",
    torus: "torus",
    sphere: "sphere",
    roof: "roof",
    facade: "facade",
    fold: "fold",
    ribbon: "ribbon",
    ramp: "ramp",
    skylights: "skylights",
    tripod: "tripod",
    sail: "sail",
    wave: "wave",
    ring: "ring",
    cone: "cone",
    tower: "tower",
    onion: "onion",
    pleats: "pleats",
    pyramid: "pyramid",
    vault: "vault",
}
