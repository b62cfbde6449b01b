//! A closed sphere of radius 10 m: two halves joined along the equator.
//!
//! Each half is the stereographic image of the unit disc, (2u, 2v, 1 - u^2 - v^2) / (1 + u^2 + v^2): a
//! rational biquadratic patch that is exact, conformal and has no pole.

use super::conic::circle;
use super::known;
use super::sketch::{Sketch, against, along};
use crate::surface::{Brep, Curve, Shape};
use glam::DVec3;

/// Radius in metres.
pub(super) const RADIUS: f64 = 10.0;
/// The patch reaches a little beyond the unit circle, so that the equator lies inside it.
const REACH: f64 = 1.2;

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("sphere");
    let rim = equator(&mut sketch);
    sketch.face(half(DVec3::ZERO, RADIUS, DVec3::Y, DVec3::Z), vec![vec![along(rim)]]);
    sketch.face(half(DVec3::ZERO, RADIUS, -DVec3::Y, -DVec3::Z), vec![vec![against(rim)]]);
    sketch.finish()
}

/// The equator, counter-clockwise seen from above.
pub(super) fn equator(sketch: &mut Sketch) -> u32 {
    let curve = circle(DVec3::ZERO, DVec3::X * RADIUS, DVec3::Y * RADIUS);
    sketch.ring(Curve::Nurbs(curve), [0.0, 1.0])
}

/// The half sphere whose middle points to `up`; `side` is the direction of v there, x that of u.
pub(super) fn half(center: DVec3, radius: f64, side: DVec3, up: DVec3) -> Shape {
    let knots = vec![-REACH, -REACH, -REACH, 0.0, REACH, REACH, REACH];
    // B-spline coefficients of t and of t^2; the knot at 0 keeps all weights positive.
    let linear = [-REACH, -REACH / 2.0, REACH / 2.0, REACH];
    let square = [REACH * REACH, 0.0, 0.0, REACH * REACH];
    let (mut points, mut weights) = (Vec::new(), Vec::new());
    for i in 0..4 {
        for j in 0..4 {
            let weight = 1.0 + square[i] + square[j];
            let top = DVec3::X * (2.0 * linear[i])
                + side * (2.0 * linear[j])
                + up * (1.0 - square[i] - square[j]);
            points.push(center + top * (radius / weight));
            weights.push(weight);
        }
    }
    Shape::Nurbs(known::surface([2, 2], [knots.clone(), knots], [4, 4], points, weights))
}
