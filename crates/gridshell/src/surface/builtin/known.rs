//! B-splines written out in this room: right by construction.

use crate::surface::exact::nurbs::{NurbsCurve, NurbsSurface};
use glam::DVec3;

pub(super) fn curve(
    degree: usize,
    knots: Vec<f64>,
    points: Vec<DVec3>,
    weights: Vec<f64>,
) -> NurbsCurve {
    NurbsCurve::new(degree, knots, points, weights).expect("a well-formed spline")
}

pub(super) fn surface(
    degree: [usize; 2],
    knots: [Vec<f64>; 2],
    count: [usize; 2],
    points: Vec<DVec3>,
    weights: Vec<f64>,
) -> NurbsSurface {
    NurbsSurface::new(degree, knots, count, points, weights).expect("a well-formed patch")
}
