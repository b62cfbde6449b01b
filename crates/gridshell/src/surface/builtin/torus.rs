//! A closed torus of radii 10 and 4 m: four rational biquadratic patches, half a turn each way.

use super::conic::{CIRCLE_POINTS, CIRCLE_WEIGHTS, turned};
use super::quilt::{Control, Quilt};
use super::sketch::Sketch;
use crate::surface::Brep;

/// From the axis to the middle of the tube, metres.
const MAJOR: f64 = 10.0;
/// Radius of the tube, metres.
const MINOR: f64 = 4.0;
/// Knots of half a circle of two quadratic quarters.
const HALF_KNOTS: [f64; 8] = [0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0];

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("torus");
    let quilt = Quilt {
        degree: [2, 2],
        knots: [HALF_KNOTS.to_vec(), HALF_KNOTS.to_vec()],
        pieces: [2, 2],
        closed: [true, true],
        control,
    };
    quilt.sew(&mut sketch, |_, _| true);
    sketch.finish()
}

/// Control point and weight of the whole torus: `a` round the axis, `b` round the tube, 0 to 8 each.
fn control(a: usize, b: usize) -> Control {
    let [out, up] = CIRCLE_POINTS[b];
    let section = ([MAJOR + MINOR * out, MINOR * up], CIRCLE_WEIGHTS[b]);
    turned((CIRCLE_POINTS[a], CIRCLE_WEIGHTS[a]), section)
}
