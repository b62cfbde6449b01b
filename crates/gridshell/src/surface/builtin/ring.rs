//! A torus with a doorway: a handle and a boundary with four corners.

use super::conic::{arcs, turned};
use super::quilt::{Quilt, bezier};
use super::sketch::Sketch;
use crate::surface::Brep;

/// From the axis to the middle of the tube, metres.
const MAJOR: f64 = 10.0;
/// Radius of the tube, metres.
const MINOR: f64 = 4.0;
/// Where pieces begin round the axis; the doorway is the first one. Degrees.
const ROUND_AXIS: [f64; 5] = [-138.0, -102.0, 6.0, 114.0, 222.0];
/// Where pieces begin round the tube; the doorway is the first one. Degrees.
const ROUND_TUBE: [f64; 5] = [-30.0, 40.0, 140.0, 235.0, 330.0];

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("ring");
    let [axis, tube] = [ROUND_AXIS, ROUND_TUBE].map(|a| arcs(&a.map(f64::to_radians)));
    let control = |a: usize, b: usize| {
        let ([out, up], weight) = tube[b];
        turned(axis[a], ([MAJOR + MINOR * out, MINOR * up], weight))
    };
    let quilt = Quilt {
        degree: [2, 2],
        knots: [bezier(2), bezier(2)],
        pieces: [4, 4],
        closed: [true, true],
        control,
    };
    quilt.sew(&mut sketch, |i, j| (i, j) != (0, 0));
    sketch.finish()
}
