//! Arcs of circles and conics as exact rational curves of degree 2.

use super::bezier::{Piece, joined};
use crate::math::trig;
use crate::surface::nurbs::NurbsCurve;
use glam::{DMat2, DVec2, DVec3, DVec4};
use std::f64::consts::{FRAC_PI_2, TAU};

/// An arc starts where it ends, so it is a whole circle, when its angle is below this, radians.
const WHOLE: f64 = 1e-9;

/// Pieces of the unit circle from angle `from` on through `sweep` > 0 radians, each at most a quarter: parameters
/// are angles at the ends of pieces.
pub(super) fn unit_circle(from: f64, sweep: f64) -> Vec<Piece> {
    let count = (sweep / FRAC_PI_2 - 1e-9).ceil().max(1.0);
    let half = 0.5 * sweep / count;
    let cosine = trig::cos(half);
    (0..count as usize)
        .map(|i| {
            let a = from + 2.0 * half * i as f64;
            let b = if i + 1 == count as usize { from + sweep } else { a + 2.0 * half };
            let [p, m, q] = [a, a + half, b].map(|t| DVec2::new(trig::cos(t), trig::sin(t)));
            let corner = m / cosine;
            let points = vec![
                DVec4::new(p.x, p.y, 0.0, 1.0),
                DVec4::new(corner.x * cosine, corner.y * cosine, 0.0, cosine),
                DVec4::new(q.x, q.y, 0.0, 1.0),
            ];
            Piece { range: [a, b], points }
        })
        .collect()
}

/// The angle from `a` counter-clockwise to `b`, in (0, 2 pi].
fn turn(a: DVec2, b: DVec2) -> f64 {
    let angle = trig::atan2(a.perp_dot(b), a.dot(b));
    if angle > WHOLE { angle } else { angle + TAU }
}

/// The image of pieces over the unit circle's plane by x -> centre + axes x, at height z.
fn placed(
    pieces: Vec<Piece>,
    centre: DVec2,
    axes: DMat2,
    z: f64,
) -> crate::error::Result<NurbsCurve> {
    let place = |p: DVec4| {
        let xy = axes * p.truncate().truncate() + centre * p.w;
        DVec4::new(xy.x, xy.y, z * p.w, p.w)
    };
    let pieces: Vec<Piece> = pieces
        .into_iter()
        .map(|p| Piece { range: p.range, points: p.points.into_iter().map(place).collect() })
        .collect();
    joined(&pieces)
}

/// The circular arc round `centre` counter-clockwise from `start` to `end`, at height `z`.
pub(super) fn circle(
    centre: DVec2,
    start: DVec2,
    end: DVec2,
    z: f64,
) -> Result<NurbsCurve, String> {
    let (a, b) = (start - centre, end - centre);
    let radius = a.length();
    if radius <= 0.0 || b.length() <= 0.0 {
        return Err("an arc has no radius".into());
    }
    let from = trig::atan2(a.y, a.x);
    let axes = DMat2::from_diagonal(DVec2::splat(radius));
    let pieces = unit_circle(from, turn(a, b));
    placed(pieces, centre, axes, z).map_err(|e| e.to_string())
}

/// The arc of the conic a x^2 + b x y + c y^2 + d x + e y + f = 0 from `start` to `end`, at height `z`; of an
/// ellipse the one counter-clockwise.
pub(super) fn conic(k: [f64; 6], start: DVec2, end: DVec2, z: f64) -> Result<NurbsCurve, String> {
    let [a, b, c, d, e, f] = k;
    let value = |p: DVec2| a * p.x * p.x + b * p.x * p.y + c * p.y * p.y + d * p.x + e * p.y + f;
    let slope = |p: DVec2| DVec2::new(2.0 * a * p.x + b * p.y + d, b * p.x + 2.0 * c * p.y + e);
    let form = a * c - 0.25 * b * b;
    let size = a * a + b * b + c * c;
    if form > 1e-9 * size {
        let determinant = 4.0 * form;
        let centre = DVec2::new(b * e - 2.0 * c * d, b * d - 2.0 * a * e) / determinant;
        let level = -value(centre);
        let sign = level.signum();
        // (x - centre)^T M (x - centre) = 1 with M = L L^T, so L^T (x - centre) runs on the unit circle.
        let [m, n, o] = [a, 0.5 * b, c].map(|x| x * sign / level.abs());
        if m <= 0.0 || !m.is_finite() || m * o - n * n <= 0.0 {
            return Err("an ellipse has no points".into());
        }
        let l = m.sqrt();
        let (l21, l22) = (n / l, (o - n * n / m).sqrt());
        let to_circle = DMat2::from_cols(DVec2::new(l, 0.0), DVec2::new(l21, l22));
        let [p, q] = [start, end].map(|x| to_circle * (x - centre));
        let pieces = unit_circle(trig::atan2(p.y, p.x), turn(p, q));
        return placed(pieces, centre, to_circle.inverse(), z).map_err(|e| e.to_string());
    }
    // Parabolas and arcs of hyperbolas are one piece: its middle corner is where the tangents at the ends meet.
    let (s, t) = (slope(start), slope(end));
    let det = s.perp_dot(t);
    if det.abs() <= 1e-14 * s.length() * t.length() {
        return Err("the ends of a conic arc have parallel tangents".into());
    }
    let (r, q) = (s.dot(start), t.dot(end));
    let corner = DVec2::new(r * t.y - q * s.y, q * s.x - r * t.x) / det;
    // The conic crosses the line from the middle of the chord to the corner at the share w / (1 + w).
    let middle = 0.5 * (start + end);
    let (at_middle, at_corner) = (value(middle), value(corner));
    let bend = value(0.5 * (middle + corner));
    let (p2, p1) =
        (2.0 * (at_middle + at_corner - 2.0 * bend), 4.0 * bend - 3.0 * at_middle - at_corner);
    let share =
        root_within(p2, p1, at_middle).ok_or("a conic arc does not pass between its ends")?;
    let weight = share / (1.0 - share);
    let points = [start, corner, end].map(|p| DVec3::new(p.x, p.y, z)).to_vec();
    let weights = if (weight - 1.0).abs() < 1e-12 { Vec::new() } else { vec![1.0, weight, 1.0] };
    NurbsCurve::new(2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], points, weights)
        .map_err(|e| e.to_string())
}

/// The root of p2 x^2 + p1 x + p0 inside (0, 1).
fn root_within(p2: f64, p1: f64, p0: f64) -> Option<f64> {
    let inside = |x: &f64| *x > 1e-9 && *x < 1.0 - 1e-9;
    if p2.abs() <= 1e-14 * (p1.abs() + p0.abs()) {
        return Some(-p0 / p1).filter(inside);
    }
    let root = (p1 * p1 - 4.0 * p2 * p0).sqrt();
    let q = -0.5 * (p1 + root.copysign(p1));
    [q / p2, p0 / q].into_iter().find(inside)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn along(c: &NurbsCurve) -> impl Iterator<Item = DVec3> + '_ {
        let [a, b] = c.domain();
        (0..=50).map(move |i| c.point(a + (b - a) * f64::from(i) / 50.0))
    }

    #[test]
    fn circle_of_three_quarters_is_round_and_runs_counter_clockwise() {
        let c =
            circle(DVec2::new(1.0, 2.0), DVec2::new(3.0, 2.0), DVec2::new(1.0, 0.0), 5.0).unwrap();
        for p in along(&c) {
            assert!((p.truncate().distance(DVec2::new(1.0, 2.0)) - 2.0).abs() < 1e-13, "{p}");
            assert!((p.z - 5.0).abs() < 1e-13, "{p}");
        }
        let [a, b] = c.domain();
        assert!((b - a - 1.5 * std::f64::consts::PI).abs() < 1e-12);
        assert!(c.jet(a)[1].y > 0.0);
    }

    #[test]
    fn arc_from_a_point_to_itself_is_the_whole_circle() {
        let c = circle(DVec2::ZERO, DVec2::X, DVec2::X, 0.0).unwrap();
        assert!(c.closed());
        assert!(along(&c).any(|p| p.x < -0.99));
    }

    #[test]
    fn conics_keep_to_their_equations() {
        let ellipse = [0.25, 0.1, 1.0, -0.5, 0.0, -0.75];
        let on = |k: [f64; 6], p: DVec3| {
            k[0] * p.x * p.x + k[1] * p.x * p.y + k[2] * p.y * p.y + k[3] * p.x + k[4] * p.y + k[5]
        };
        let at = |y: f64| {
            // The larger root in x.
            let (a, b, c) = (0.25, 0.1 * y - 0.5, y * y - 0.75);
            DVec2::new((-b + f64::sqrt(b * b - 4.0 * a * c)) / (2.0 * a), y)
        };
        let c = conic(ellipse, at(0.5), at(-0.5), 0.0).unwrap();
        assert!(along(&c).all(|p| on(ellipse, p).abs() < 1e-13));
        assert!(along(&c).any(|p| p.x < -0.8), "the long way round");
        let parabola = [1.0, 0.0, 0.0, 0.0, -1.0, 0.0];
        let c = conic(parabola, DVec2::new(-1.0, 1.0), DVec2::new(2.0, 4.0), 0.0).unwrap();
        assert!(along(&c).all(|p| on(parabola, p).abs() < 1e-13));
        let hyperbola = [1.0, 0.0, -1.0, 0.0, 0.0, -1.0];
        let y = |x: f64| DVec2::new(x, f64::sqrt(x * x - 1.0));
        let c = conic(hyperbola, y(1.1), y(3.0), 0.0).unwrap();
        assert!(along(&c).all(|p| on(hyperbola, p).abs() < 1e-12));
    }
}
