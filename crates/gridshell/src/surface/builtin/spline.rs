//! Cubic B-splines from control points.

use super::known;
use crate::surface::exact::nurbs::NurbsCurve;
use glam::DVec3;

/// Knots of a clamped cubic over [start, end] with `count` control points.
pub(super) fn clamped_knots(count: usize, start: f64, end: f64) -> Vec<f64> {
    let spans = count - 3;
    let inner = (1..spans).map(|k| start + (end - start) * k as f64 / spans as f64);
    std::iter::repeat_n(start, 4).chain(inner).chain(std::iter::repeat_n(end, 4)).collect()
}

/// Greville abscissae of cubic knots: control points there make the spline linear.
pub(super) fn greville(knots: &[f64]) -> Vec<f64> {
    knots[1..knots.len() - 1].windows(3).map(|w| (w[0] + w[1] + w[2]) / 3.0).collect()
}

/// The clamped cubic with these control points in the plane, parameter 0 to 1.
pub(super) fn clamped(points: &[[f64; 2]]) -> NurbsCurve {
    known::curve(3, clamped_knots(points.len(), 0.0, 1.0), plane(points).collect(), Vec::new())
}

/// The closed, smooth uniform cubic with these control points in the plane, and its parameter range.
pub(super) fn closed(points: &[[f64; 2]]) -> (NurbsCurve, [f64; 2]) {
    let n = points.len();
    let curve = known::curve(
        3,
        (0..n + 7).map(|k| k as f64 - 3.0).collect(),
        plane(points).chain(plane(&points[..3])).collect(),
        Vec::new(),
    );
    (curve, [0.0, n as f64])
}

fn plane(points: &[[f64; 2]]) -> impl Iterator<Item = DVec3> {
    points.iter().map(|&[x, y]| DVec3::new(x, y, 0.0))
}
