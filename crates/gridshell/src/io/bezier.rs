//! Curves taken apart into Bezier pieces, which makes degrees and knots agree: exact, and simple.

use crate::surface::nurbs::NurbsCurve;
use glam::{DVec3, DVec4};

/// One polynomial piece of a curve, in homogeneous coordinates (w x, w y, w z, w).
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// Parameters of its ends.
    pub range: [f64; 2],
    pub points: Vec<DVec4>,
}

/// The pieces of `curve` between the parameters of `range`.
pub(super) fn pieces(curve: &NurbsCurve, range: [f64; 2]) -> Vec<Piece> {
    let p = curve.degree;
    let mut knots = curve.knots.clone();
    let weight = |i: usize| curve.weights.get(i).copied().unwrap_or(1.0);
    let mut points: Vec<DVec4> =
        curve.points.iter().enumerate().map(|(i, &c)| (c * weight(i)).extend(weight(i))).collect();
    let [a, b] = range;
    let mut breaks = vec![a];
    breaks.extend(curve.knots.iter().copied().filter(|&k| k > a && k < b));
    breaks.push(b);
    breaks.dedup();
    for &t in &breaks {
        let have = knots.iter().filter(|&&k| k == t).count();
        for _ in have..p {
            insert(&mut knots, &mut points, p, t);
        }
    }
    breaks
        .windows(2)
        .map(|w| {
            // The last knot equal to the start of the piece.
            let span = knots.partition_point(|&k| k <= w[0]) - 1;
            Piece { range: [w[0], w[1]], points: points[span - p..=span].to_vec() }
        })
        .collect()
}

/// Insert the knot `t` once (Boehm).
fn insert(knots: &mut Vec<f64>, points: &mut Vec<DVec4>, p: usize, t: f64) {
    let span = (knots.partition_point(|&k| k <= t) - 1).clamp(p, points.len() - 1);
    let mut new = Vec::with_capacity(points.len() + 1);
    for i in 0..=points.len() {
        let point = if i + p <= span {
            points[i]
        } else if i > span {
            points[i - 1]
        } else {
            let width = knots[i + p] - knots[i];
            let share = if width > 0.0 { (t - knots[i]) / width } else { 0.0 };
            points[i - 1] * (1.0 - share) + points[i] * share
        };
        new.push(point);
    }
    *points = new;
    knots.insert(span + 1, t);
}

/// A piece with its degree raised to `degree`.
pub(super) fn elevate(piece: &Piece, degree: usize) -> Piece {
    let mut points = piece.points.clone();
    while points.len() <= degree {
        let n = points.len();
        let raised = (0..=n).map(|i| {
            let share = i as f64 / n as f64;
            let before = if i > 0 { points[i - 1] * share } else { DVec4::ZERO };
            let after = if i < n { points[i] * (1.0 - share) } else { DVec4::ZERO };
            before + after
        });
        points = raised.collect();
    }
    Piece { range: piece.range, points }
}

/// One curve of pieces that follow each other, all brought to the highest degree. Where the pieces' own parameters
/// do not follow each other, each gets one unit.
pub(super) fn joined(pieces: &[Piece]) -> crate::error::Result<NurbsCurve> {
    let degree = pieces.iter().map(|p| p.points.len() - 1).max().unwrap_or(1);
    let follows = pieces.windows(2).all(|w| w[0].range[1] == w[1].range[0]);
    let (mut knots, mut points): (Vec<f64>, Vec<DVec4>) = (Vec::new(), Vec::new());
    for (i, piece) in pieces.iter().enumerate() {
        let mut piece = elevate(piece, degree);
        if !follows {
            piece.range = [i as f64, i as f64 + 1.0];
        }
        // Weights of neighbours are made to agree where they meet.
        if let Some(last) = points.last() {
            let scale = last.w / piece.points[0].w;
            piece.points.iter_mut().for_each(|p| *p *= scale);
        } else {
            knots.extend(vec![piece.range[0]; degree + 1]);
        }
        knots.extend(vec![piece.range[1]; degree]);
        let from = usize::from(!points.is_empty());
        points.extend(&piece.points[from..]);
    }
    knots.push(*knots.last().unwrap_or(&0.0));
    let weights: Vec<f64> = points.iter().map(|p| p.w).collect();
    let weights = if weights.iter().all(|&w| w == 1.0) { Vec::new() } else { weights };
    let places: Vec<DVec3> = points.iter().map(|p| p.truncate() / p.w).collect();
    NurbsCurve::new(degree, knots, places, weights)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wavy() -> NurbsCurve {
        let points =
            (0..6).map(|i| DVec3::new(f64::from(i), f64::from(i * i % 5), 0.3 * f64::from(i)));
        let knots = vec![0., 0., 0., 0., 0.4, 0.7, 1., 1., 1., 1.];
        let weights = vec![1.0, 2.0, 0.7, 1.0, 1.5, 1.0];
        NurbsCurve::new(3, knots, points.collect(), weights).unwrap()
    }

    #[test]
    fn taking_apart_raising_and_joining_changes_no_point() {
        let curve = wavy();
        let parts: Vec<Piece> = pieces(&curve, [0.0, 1.0]).iter().map(|p| elevate(p, 5)).collect();
        assert_eq!(parts.len(), 3);
        let again = joined(&parts).unwrap();
        for i in 0..=40 {
            let t = f64::from(i) / 40.0;
            assert!(again.point(t).distance(curve.point(t)) < 1e-13, "{t}");
        }
    }

    #[test]
    fn a_part_of_an_unclamped_curve_is_the_curve_there() {
        let points: Vec<DVec3> =
            (0..7).map(|i| DVec3::new(f64::from(i), f64::from(i * i % 4), 0.0)).collect();
        let curve = NurbsCurve::new(3, (0..11).map(f64::from).collect(), points, vec![]).unwrap();
        let parts = joined(&pieces(&curve, [3.5, 6.25])).unwrap();
        assert_eq!(parts.domain(), [3.5, 6.25]);
        for i in 0..=20 {
            let t = 3.5 + 2.75 * f64::from(i) / 20.0;
            assert!(parts.point(t).distance(curve.point(t)) < 1e-13, "{t}");
        }
        let whole = joined(&pieces(&curve, curve.domain())).unwrap();
        assert!(whole.point(7.0).distance(curve.point(7.0)) < 1e-13);
        assert!(whole.point(3.2).distance(curve.point(3.2)) < 1e-13);
    }
}
