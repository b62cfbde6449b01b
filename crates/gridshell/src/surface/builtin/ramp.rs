//! A spiral ramp of one and a half turns, 4 m wide: a helicoid, whose upper end lies over its lower one.
//!
//! Splines draw no helix exactly; cubic pieces of 45 degrees are within 3 millionths of the radius.

use super::quilt::{Control, Quilt, bezier};
use super::sketch::Sketch;
use crate::math::trig::{cos, sin};
use crate::surface::Brep;
use glam::{DVec2, DVec3};
use std::f64::consts::FRAC_PI_4;

/// Inner and outer radius, metres.
const RADII: [f64; 2] = [7.0, 11.0];
/// Rise of a piece, metres: 3.2 m for a turn.
const STEP: f64 = 0.4;
/// Pieces of 45 degrees.
const PIECES: usize = 12;

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("ramp");
    let quilt = Quilt {
        degree: [1, 3],
        knots: [bezier(1), bezier(3)],
        pieces: [1, PIECES],
        closed: [false, false],
        control,
    };
    quilt.sew(&mut sketch, |_, _| true);
    sketch.finish()
}

/// Control point `a` from the inner to the outer edge and `b` along the ramp.
fn control(a: usize, b: usize) -> Control {
    let (piece, part) = (b / 3, b % 3);
    let at = |angle: f64| DVec2::new(cos(angle), sin(angle));
    // The handles of a cubic that comes nearest to an arc.
    let handle = 4.0 / 3.0 * (sin(FRAC_PI_4 / 4.0) / cos(FRAC_PI_4 / 4.0));
    let start = at(FRAC_PI_4 * piece as f64);
    let end = at(FRAC_PI_4 * (piece + 1) as f64);
    let plan = match part {
        0 => start,
        1 => start + start.perp() * handle,
        _ => end - end.perp() * handle,
    };
    let height = STEP * (piece as f64 + part as f64 / 3.0);
    (DVec3::new(RADII[a] * plan.x, RADII[a] * plan.y, height), 1.0)
}
