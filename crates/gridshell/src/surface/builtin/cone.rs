//! A truncated cone, open at the top: 28 m wide below, 10 m above, 6 m high.

use super::conic::{quarters, turned};
use super::quilt::{Quilt, bezier};
use super::sketch::Sketch;
use crate::surface::Brep;

/// Distances from the axis and heights of the two rims, metres.
const RIMS: [[f64; 2]; 2] = [[14.0, 0.0], [5.0, 6.0]];

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("cone");
    let round = quarters();
    let quilt = Quilt {
        degree: [2, 1],
        knots: [bezier(2), bezier(1)],
        pieces: [4, 1],
        closed: [true, false],
        control: |a: usize, b: usize| turned(round[a], (RIMS[b], 1.0)),
    };
    quilt.sew(&mut sketch, |_, _| true);
    sketch.finish()
}
