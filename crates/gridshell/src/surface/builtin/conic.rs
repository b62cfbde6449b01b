//! Lines and circles as exact rational B-splines (Piegl & Tiller, *The NURBS Book*, chapter 7).

use super::known;
use crate::math::trig::{cos, sin};
use crate::surface::exact::nurbs::NurbsCurve;
use glam::DVec3;
use std::f64::consts::FRAC_1_SQRT_2;

/// Knots of a full circle of four quadratic quarters.
pub(super) const CIRCLE_KNOTS: [f64; 12] =
    [0.0, 0.0, 0.0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1.0, 1.0, 1.0];

/// Weights of a full circle.
pub(super) const CIRCLE_WEIGHTS: [f64; 9] =
    [1.0, FRAC_1_SQRT_2, 1.0, FRAC_1_SQRT_2, 1.0, FRAC_1_SQRT_2, 1.0, FRAC_1_SQRT_2, 1.0];

/// Control points of the unit circle, counter-clockwise from (1, 0).
pub(super) const CIRCLE_POINTS: [[f64; 2]; 9] = [
    [1.0, 0.0],
    [1.0, 1.0],
    [0.0, 1.0],
    [-1.0, 1.0],
    [-1.0, 0.0],
    [-1.0, -1.0],
    [0.0, -1.0],
    [1.0, -1.0],
    [1.0, 0.0],
];

/// The straight line from `a` to `b`, parameter 0 to 1.
pub(super) fn line(a: DVec3, b: DVec3) -> NurbsCurve {
    known::curve(1, vec![0.0, 0.0, 1.0, 1.0], vec![a, b], Vec::new())
}

/// The full circle (or ellipse) round `center` from `center + x` by way of `center + y`, parameter 0 to 1.
pub(super) fn circle(center: DVec3, x: DVec3, y: DVec3) -> NurbsCurve {
    known::curve(
        2,
        CIRCLE_KNOTS.to_vec(),
        CIRCLE_POINTS.iter().map(|p| center + x * p[0] + y * p[1]).collect(),
        CIRCLE_WEIGHTS.to_vec(),
    )
}

/// A conic arc from `a` to `b`, whose tangents meet in `apex`; on a circle the `weight` is the cosine of
/// half the arc's angle. Weight 1 makes a parabola. Parameter 0 to 1.
pub(super) fn arc(a: DVec3, apex: DVec3, b: DVec3, weight: f64) -> NurbsCurve {
    known::curve(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], vec![a, apex, b], vec![1.0, weight, 1.0])
}

/// A control point in a plane, and its weight.
pub(super) type Flat = ([f64; 2], f64);

/// Control points of arcs of the unit circle, one quadratic piece from each angle to the next, radians.
pub(super) fn arcs(angles: &[f64]) -> Vec<Flat> {
    let at = |angle: f64| [cos(angle), sin(angle)];
    let mut points = vec![(at(angles[0]), 1.0)];
    for pair in angles.windows(2) {
        let weight = cos((pair[1] - pair[0]) / 2.0);
        let apex = at(f64::midpoint(pair[0], pair[1])).map(|x| x / weight);
        points.extend([(apex, weight), (at(pair[1]), 1.0)]);
    }
    points
}

/// Control points of the unit circle, one quadratic piece for each quarter.
pub(super) fn quarters() -> Vec<Flat> {
    CIRCLE_POINTS.into_iter().zip(CIRCLE_WEIGHTS).collect()
}

/// The control point of a surface of revolution about the z axis: a point of the unit circle round the axis,
/// and one of the section, as distance from the axis and height.
pub(super) fn turned(([x, y], u): Flat, ([rho, z], v): Flat) -> (DVec3, f64) {
    (DVec3::new(rho * x, rho * y, z), u * v)
}
