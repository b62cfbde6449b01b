//! A folded-plate roof of 18 x 24 m: six plane plates, each at an angle to the next.

use super::quilt::{Quilt, bezier};
use super::sketch::Sketch;
use crate::surface::Brep;
use glam::DVec3;

/// Plates side by side.
const PLATES: usize = 6;
/// Width of a plate in plan and its height, metres.
const PLATE: [f64; 2] = [3.0, 2.25];
/// Length of the plates, metres.
const LENGTH: f64 = 24.0;

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("pleats");
    let control = |a: usize, b: usize| {
        let ridge = if a % 2 == 1 { PLATE[1] } else { 0.0 };
        (DVec3::new(PLATE[0] * a as f64, LENGTH * b as f64, ridge), 1.0)
    };
    let quilt = Quilt {
        degree: [1, 1],
        knots: [bezier(1), bezier(1)],
        pieces: [PLATES, 1],
        closed: [false, false],
        control,
    };
    quilt.sew(&mut sketch, |_, _| true);
    sketch.finish()
}
