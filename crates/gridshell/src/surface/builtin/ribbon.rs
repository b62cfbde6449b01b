//! A long vault along an S: an arc swept along two opposite arcs of 120 degrees.

use super::conic::{Flat, arcs, turned};
use super::quilt::{Quilt, bezier};
use super::sketch::Sketch;
use crate::surface::Brep;
use glam::DVec3;
use std::f64::consts::FRAC_PI_3;

/// Radius of the S in plan, metres.
const BEND: f64 = 30.0;
/// Half the span, metres.
const HALF_SPAN: f64 = 4.0;
/// Height of the crown over the springings, metres.
const RISE: f64 = 1.6;

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("ribbon");
    let first = arcs(&[3.5, 2.5, 1.5].map(|a| a * FRAC_PI_3));
    let second = arcs(&[-1.5, -0.5, 0.5].map(|a| a * FRAC_PI_3));
    let center = DVec3::Y * (2.0 * BEND);
    let control = |a: usize, b: usize| {
        let (out, z, weight) = section(b);
        let at = |side: f64| -> Flat { ([BEND + side * out, z], weight) };
        if a <= 4 {
            return turned(first[a], at(1.0));
        }
        let (point, weight) = turned(second[a - 4], at(-1.0));
        (center + point, weight)
    };
    let quilt = Quilt {
        degree: [2, 2],
        knots: [bezier(2), bezier(2)],
        pieces: [4, 1],
        closed: [false, false],
        control,
    };
    quilt.sew(&mut sketch, |_, _| true);
    sketch.finish()
}

/// Distance to the left of the S, height and weight of the section's control point, from right to left.
fn section(b: usize) -> (f64, f64, f64) {
    let radius = (HALF_SPAN * HALF_SPAN + RISE * RISE) / (2.0 * RISE);
    // Cosine and tangent of half the opening angle.
    let cosine = (radius - RISE) / radius;
    let tangent = HALF_SPAN / (radius - RISE);
    let z = if b == 1 { HALF_SPAN * tangent } else { 0.0 };
    ([-HALF_SPAN, 0.0, HALF_SPAN][b], z, if b == 1 { cosine } else { 1.0 })
}
