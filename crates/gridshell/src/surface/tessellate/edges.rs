//! Edges as polylines: the points that the faces on both sides share.

use super::trim::Polyline;
use crate::error::{Error, Result};
use crate::job::Job;
use crate::math::trig;
use crate::surface::brep::BrepEdge;
use crate::surface::{Brep, Curve, PREPARING, Sampling};
use glam::DVec3;

/// Pieces are never shorter than this share of the longest allowed, however sharp the bend.
pub(super) const LEAST_SHARE: f64 = 1.0 / 64.0;
/// Probes taken along an edge at most; enough to see any sensible curve bend.
const MAX_PROBES: f64 = 4096.0;
/// More pieces than this are not made of one edge.
const MOST_PIECES: f64 = 1e6;
/// An edge that turns by more than this, radians, has at least two pieces.
const TURNS: f64 = 0.2;

/// Knots nearer to an end of an edge than this share of its range are that end: ends that were computed are off by
/// rounding, and two vertices at one place would tear the faces beside them apart.
const AT_END: f64 = 1e-9;

/// Lengths that differ by this share are the same one, rounded differently: files hold nine digits and more. What
/// only just needs splitting, one piece more or one more probe, so does not depend on how a file was written.
pub(super) const ROUNDING: f64 = 1e-6;

/// Piece length that keeps both bounds where the curvature is `bend` (1/m): a circle's chord of length h
/// has sagitta h^2 bend / 8.
pub(super) fn piece_length(sampling: &Sampling, bend: f64) -> f64 {
    let by_chord = (8.0 * sampling.chord_error / bend.max(1e-300)).sqrt();
    by_chord.clamp(sampling.max_edge * LEAST_SHARE, sampling.max_edge)
}

/// Parameters of the vertices along an edge, its two ends included: pieces are no longer than
/// `max_edge`, their sagitta no more than `chord_error`, and every kink is a vertex. None where that asks
/// for too many.
pub(in crate::surface) fn parameters(edge: &BrepEdge, sampling: &Sampling) -> Option<Vec<f64>> {
    let kinks = kinks(edge);
    let closed = edge.ends[0] == edge.ends[1];
    let least = if closed { 4_usize.div_ceil(kinks.len() - 1) } else { 1 };
    let mut all = vec![kinks[0]];
    for w in kinks.windows(2) {
        all.extend(stretch(&edge.curve, [w[0], w[1]], sampling, least)?);
    }
    Some(all)
}

/// Ends of the edge, and the parameters between where its curve may turn sharply.
fn kinks(edge: &BrepEdge) -> Vec<f64> {
    let [a, b] = edge.range;
    let mut kinks = vec![a];
    if let Curve::Nurbs(c) | Curve::OnShape(_, c) = &edge.curve {
        let polyline = c.degree == 1 && matches!(edge.curve, Curve::Nurbs(_));
        // A knot as often as the degree joins two pieces by position only.
        let joints = c.knots.windows(c.degree).filter(|w| w[0] == w[c.degree - 1]).map(|w| w[0]);
        let end = AT_END * (b - a);
        for k in joints.filter(|&k| k < b - end) {
            let last = kinks[kinks.len() - 1];
            if k > last + end && (polyline || turns(&edge.curve, k, b - a)) {
                kinks.push(k);
            }
        }
    }
    kinks.push(b);
    kinks
}

/// Whether the curve's tangent turns at `t`.
fn turns(curve: &Curve, t: f64, width: f64) -> bool {
    let h = 1e-7 * width;
    trig::angle(curve.jet(t - h)[1], curve.jet(t + h)[1]) > 1e-3
}

/// Parameters after the first over one smooth stretch.
fn stretch(curve: &Curve, range: [f64; 2], sampling: &Sampling, least: usize) -> Option<Vec<f64>> {
    let at = |share: f64| range[0] + (range[1] - range[0]) * share;
    let rough: f64 = {
        let p: Vec<DVec3> = (0..=16).map(|i| curve.point(at(f64::from(i) / 16.0))).collect();
        p.windows(2).map(|w| w[0].distance(w[1])).sum()
    };
    let spans = match curve {
        Curve::Nurbs(c) => (c.points.len() - c.degree) * (c.degree + 1),
        Curve::OnShape(..) | Curve::UvLine { .. } | Curve::Guide { .. } => 16,
    };
    let probes = 8.0 * rough / sampling.max_edge * (1.0 + ROUNDING);
    let probes = probes.max(4.0 * spans as f64).clamp(32.0, MAX_PROBES) as usize;
    let jets: Vec<_> = (0..=probes).map(|i| curve.jet(at(i as f64 / probes as f64))).collect();
    let steps: Vec<(f64, f64)> = jets
        .windows(2)
        .map(|w| (w[0][0].distance(w[1][0]), trig::angle(w[0][1], w[1][1])))
        .collect();
    let turning: f64 = steps.iter().map(|s| s.1).sum();
    let bend = |i: usize| {
        steps.get(i).map_or(0.0, |&(length, turn)| if length > 0.0 { turn / length } else { 0.0 })
    };
    // Pieces wanted up to each probe: length over the local piece length. Bends seen just before and behind count too,
    // so that a piece cannot begin or end right beside one, whichever way the curve runs.
    let mut wanted = vec![0.0];
    let mut total = 0.0;
    for (i, &(length, _)) in steps.iter().enumerate() {
        let sharpest = bend(i).max(bend(i.wrapping_sub(1))).max(bend(i + 1));
        total += length / piece_length(sampling, sharpest);
        wanted.push(total);
    }
    if total == 0.0 {
        return Some(vec![range[1]]);
    }
    let least = if turning > TURNS { least.max(2) } else { least };
    if total > MOST_PIECES {
        return None;
    }
    let pieces = ((total - ROUNDING).ceil() as usize).max(least);
    let mut result = Vec::with_capacity(pieces);
    let mut k = 0;
    for i in 1..pieces {
        let goal = total * i as f64 / pieces as f64;
        while wanted[k + 1] < goal {
            k += 1;
        }
        let share = k as f64 + (goal - wanted[k]) / (wanted[k + 1] - wanted[k]);
        result.push(at(share / probes as f64));
    }
    result.push(range[1]);
    Some(result)
}

/// Sample every edge once. Brep vertices come first among the points.
pub(super) fn sample_edges(
    brep: &Brep,
    sampling: &Sampling,
    job: &Job,
) -> Result<(Vec<DVec3>, Vec<Polyline>)> {
    let mut points = brep.vertices.clone();
    let mut polylines = Vec::with_capacity(brep.edges.len());
    for (i, e) in brep.edges.iter().enumerate() {
        job.check(PREPARING)?;
        let t = parameters(e, sampling).ok_or_else(|| too_long(brep, i))?;
        let mut vertices = vec![e.ends[0]];
        for &t in &t[1..t.len() - 1] {
            vertices.push(points.len() as u32);
            points.push(e.curve.point(t));
        }
        vertices.push(e.ends[1]);
        polylines.push(Polyline { t, vertices });
    }
    Ok((points, polylines))
}

/// An edge that is too long for its surface, as members suit the surface's area.
fn too_long(brep: &Brep, i: usize) -> Error {
    let at = brep.origin.told(brep.vertices[brep.edges[i].ends[0] as usize]);
    Error::Surface(format!(
        "an edge that starts near {at} is far too long for its surface, or too crumpled; repair it in the program that \
         made the file, or ask for longer members"
    ))
}

/// What is wrong with the `i`th face.
pub(super) fn fault(brep: &Brep, i: usize, what: &str) -> Error {
    Error::Surface(format!("{}: {what}", brep.faces[i].told(i)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::exact::nurbs::NurbsCurve;

    fn edge(
        degree: usize,
        knots: Vec<f64>,
        points: Vec<DVec3>,
        weights: Vec<f64>,
        ends: [u32; 2],
    ) -> BrepEdge {
        let range = [knots[0], knots[knots.len() - 1]];
        BrepEdge {
            curve: Curve::Nurbs(NurbsCurve::new(degree, knots, points, weights).unwrap()),
            range,
            ends,
        }
    }

    fn sampling(max_edge: f64, chord_error: f64) -> Sampling {
        Sampling { max_edge, chord_error, corner_angle: 0.5 }
    }

    #[test]
    fn an_edge_drawn_the_other_way_round_has_the_same_points() {
        // IGES files of a roof ran their holes backwards, and got other carriers: bends counted once passed only.
        let points: Vec<DVec3> = [(0., 0.), (1., 3.), (2., -1.), (6., 0.), (7., 0.)]
            .map(|(x, y)| DVec3::new(x, y, 0.0))
            .into();
        let knots = vec![0., 0., 0., 0., 0.5, 1., 1., 1., 1.];
        let back: Vec<DVec3> = points.iter().rev().copied().collect();
        let there = edge(3, knots.clone(), points, vec![], [0, 1]);
        let back = edge(3, knots, back, vec![], [0, 1]);
        let [a, b] = [there, back].map(|e| parameters(&e, &sampling(0.5, 1e-3)).unwrap());
        assert_eq!(a.len(), b.len());
        assert!(a.iter().zip(b.iter().rev()).all(|(s, t)| (s + t - 1.0).abs() < 1e-12));
    }

    #[test]
    fn straight_edge_is_cut_into_equal_pieces() {
        let e = edge(1, vec![0., 0., 2., 2.], vec![DVec3::ZERO, DVec3::X * 5.0], vec![], [0, 1]);
        let t = parameters(&e, &sampling(0.5, 0.01)).unwrap();
        assert_eq!(t.len(), 11);
        assert!(t.windows(2).all(|w| (w[1] - w[0] - 0.2).abs() < 1e-12));
    }

    #[test]
    fn kink_of_a_polyline_is_a_vertex() {
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.1, 0.0)];
        let e = edge(1, vec![0., 0., 0.3, 1., 1.], points, vec![], [0, 1]);
        assert!(parameters(&e, &sampling(5.0, 1.0)).unwrap().contains(&0.3));
    }

    #[test]
    fn a_knot_that_rounding_parts_from_an_end_is_no_second_vertex() {
        // A folded face came apart where the end of a cut was 1e-16 beyond the knot it was made at.
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.1, 0.0)];
        for range in [[0.3 - 1e-16, 1.0], [0.3 - 1e-13, 1.0], [0.0, 0.3 + 1e-13]] {
            let e = edge(1, vec![0., 0., 0.3, 1., 1.], points.clone(), vec![], [0, 1]);
            let t = parameters(&BrepEdge { range, ..e }, &sampling(5.0, 1.0)).unwrap();
            assert!(t.windows(2).all(|w| w[1] - w[0] > 1e-3), "{t:?}");
        }
    }

    #[test]
    fn arc_keeps_the_chord_error() {
        let points = vec![DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
        let w = vec![1.0, std::f64::consts::FRAC_1_SQRT_2, 1.0];
        let e = edge(2, vec![0., 0., 0., 1., 1., 1.], points, w, [0, 1]);
        let t = parameters(&e, &sampling(1.0, 1e-3)).unwrap();
        for w in t.windows(2) {
            let mid = (e.curve.point(w[0]) + e.curve.point(w[1])) / 2.0;
            assert!(1.0 - mid.length() < 1.05e-3, "{}", 1.0 - mid.length());
        }
        // The chord of sagitta 1e-3 spans 0.0894 radians.
        assert_eq!(t.len() - 1, 18);
    }

    #[test]
    fn tiny_closed_edge_still_bounds_an_area() {
        let ring = [
            DVec3::X,
            DVec3::new(1., 2., 0.),
            DVec3::new(-2., 0., 0.),
            DVec3::new(1., -2., 0.),
            DVec3::X,
        ];
        let e = edge(2, vec![0., 0., 0., 0.3, 0.6, 1., 1., 1.], ring.to_vec(), vec![], [0, 0]);
        assert!(parameters(&e, &sampling(100.0, 10.0)).unwrap().len() >= 5);
    }
}
