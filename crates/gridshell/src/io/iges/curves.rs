//! Curve entities as exact splines: 100, 102, 104, 106, 110, 112, 126.

use super::directory::{Entry, Parameters};
use super::{Fault, File, MOST_LEVELS, VISIT, arc, bezier};
use crate::surface::nurbs::{MAX_DEGREE, NurbsCurve};
use glam::{DAffine3, DMat3, DVec2, DVec3, DVec4};

/// A curve and the part of it that is meant.
#[derive(Clone, Debug)]
pub(super) struct Arc {
    pub curve: NurbsCurve,
    pub range: [f64; 2],
}

impl Arc {
    fn whole(curve: NurbsCurve) -> Arc {
        let range = curve.domain();
        Arc { curve, range }
    }

    pub fn start(&self) -> DVec3 {
        self.curve.point(self.range[0])
    }

    pub fn end(&self) -> DVec3 {
        self.curve.point(self.range[1])
    }

    /// Whether it ends where it begins.
    fn is_closed(&self) -> bool {
        let middle = self.curve.point(0.5 * (self.range[0] + self.range[1]));
        self.start().distance(self.end()) < 1e-9 * self.start().distance(middle)
    }

    /// Run the other way.
    pub fn reversed(&self) -> Arc {
        let mut back = self.curve.clone();
        back.points.reverse();
        back.weights.reverse();
        back.knots = self.curve.knots.iter().rev().map(|k| -k).collect();
        Arc { curve: back, range: [-self.range[1], -self.range[0]] }
    }

    fn placed(mut self, place: &DAffine3) -> Arc {
        for p in &mut self.curve.points {
            *p = place.transform_point3(*p);
        }
        self
    }
}

impl File<'_> {
    /// The curve of entity `number` in the space of the model, as one curve.
    pub fn curve(&self, number: u32) -> Result<Arc, Fault> {
        let entry = self.known(number)?;
        let mut arcs = in_line(self.arcs(number, 0)?);
        if arcs.len() == 1 {
            return Ok(arcs.remove(0));
        }
        let pieces: Vec<_> = arcs.iter().flat_map(|a| bezier::pieces(&a.curve, a.range)).collect();
        let curve = bezier::joined(&pieces).map_err(|e| entry.fault(e.to_string()))?;
        Ok(Arc::whole(curve))
    }

    /// The pieces of a curve one after the other, in the space of the model. Those of a composite curve that run the
    /// wrong way are turned.
    pub fn arcs(&self, number: u32, level: usize) -> Result<Vec<Arc>, Fault> {
        let entry = self.known(number)?;
        self.visit(&entry, level)?;
        let place = self.place(&entry)?;
        let p = self.directory.parameters(&entry)?;
        let mut arcs = if entry.kind == 102 {
            let mut all: Vec<Arc> = Vec::new();
            for k in 1..=p.count(0)? {
                let part = p.pointer(k)?.ok_or_else(|| p.fault("a part is missing"))?;
                // Points and connect points join the others.
                if matches!(self.known(part)?.kind, 116 | 132) {
                    continue;
                }
                all.extend(self.arcs(part, level + 1)?);
            }
            all
        } else {
            vec![single(&entry, &p)?]
        };
        if arcs.is_empty() {
            return Err(p.fault("it is a curve without parts"));
        }
        arcs = arcs.into_iter().map(|a| a.placed(&place)).collect();
        Ok(arcs)
    }

    /// An entity that may be visited: not too deep, and not too often in all.
    pub fn visit(&self, entry: &Entry, level: usize) -> Result<(), Fault> {
        if level > MOST_LEVELS {
            return Err(entry.fault("entities are nested too deep here; one may contain itself"));
        }
        self.spend(entry, VISIT)
    }

    /// Where an entity is placed: its transformation and those of that one.
    pub fn place(&self, entry: &Entry) -> Result<DAffine3, Fault> {
        let mut place = DAffine3::IDENTITY;
        let mut next = entry.transform;
        for level in 0.. {
            if next == 0 {
                break;
            }
            let matrix = self.known(next)?;
            self.visit(&matrix, level)?;
            if matrix.kind != 124 {
                return Err(matrix.fault("a transformation is asked for here, which this is not"));
            }
            let p = self.directory.parameters(&matrix)?;
            let m = p.numbers(0, 12)?;
            let row = |i: usize| DVec3::new(m[4 * i], m[4 * i + 1], m[4 * i + 2]);
            let axes = DMat3::from_cols(row(0), row(1), row(2)).transpose();
            place = DAffine3::from_mat3_translation(axes, DVec3::new(m[3], m[7], m[11])) * place;
            next = matrix.transform;
        }
        Ok(place)
    }
}

/// A curve that is no composite, in its own space.
fn single(entry: &Entry, p: &Parameters) -> Result<Arc, Fault> {
    let plain = |curve: Result<NurbsCurve, String>| curve.map(Arc::whole).map_err(|e| p.fault(e));
    match entry.kind {
        100 => {
            let n = p.numbers(0, 7)?;
            let at = |k: usize| DVec2::new(n[k], n[k + 1]);
            plain(arc::circle(at(1), at(3), at(5), n[0]))
        }
        104 => {
            let n = p.numbers(0, 11)?;
            let k = [n[0], n[1], n[2], n[3], n[4], n[5]];
            plain(arc::conic(k, DVec2::new(n[7], n[8]), DVec2::new(n[9], n[10]), n[6]))
        }
        106 => polyline(entry, p).map(Arc::whole),
        110 => {
            let n = p.numbers(0, 6)?;
            let (a, b) = (DVec3::new(n[0], n[1], n[2]), DVec3::new(n[3], n[4], n[5]));
            Ok(Arc::whole(NurbsCurve::line(p.reached(a)?, p.reached(b)?)))
        }
        112 => cubic(p).map(Arc::whole),
        126 => spline(p),
        _ => Err(p.fault("this type of entity is not read as a curve")),
    }
}

/// 106, forms 11 to 13 and 63: straight pieces.
fn polyline(entry: &Entry, p: &Parameters) -> Result<NurbsCurve, Fault> {
    if !matches!(entry.form, 11..=13 | 63) {
        return Err(p.fault(format!("form {} of copious data is not a curve", entry.form)));
    }
    let count = p.count(1)?;
    let points: Vec<DVec3> = match p.number(0)? as i64 {
        1 => {
            let z = p.number(2)?;
            p.numbers(3, 2 * count)?.chunks_exact(2).map(|c| DVec3::new(c[0], c[1], z)).collect()
        }
        2 => p.numbers(2, 3 * count)?.chunks_exact(3).map(DVec3::from_slice).collect(),
        3 => p.numbers(2, 6 * count)?.chunks_exact(6).map(DVec3::from_slice).collect(),
        other => return Err(p.fault(format!("points of kind {other} are unknown"))),
    };
    let mut points = points;
    if entry.form == 63 && points.first() != points.last() {
        points.extend(points.first().copied());
    }
    points.dedup();
    if points.len() < 2 {
        return Err(p.fault("it has fewer than two points"));
    }
    let mut knots = vec![0.0];
    knots.extend((0..points.len()).map(|i| i as f64));
    knots.push((points.len() - 1) as f64);
    NurbsCurve::new(1, knots, points, Vec::new()).map_err(|e| p.fault(e.to_string()))
}

/// 112: cubic pieces given by their coefficients.
fn cubic(p: &Parameters) -> Result<NurbsCurve, Fault> {
    let count = p.count(3)?;
    let breaks = p.numbers(4, count + 1)?;
    let coefficients = p.numbers(5 + count, 12 * count)?;
    let mut pieces = Vec::with_capacity(count);
    for (w, c) in breaks.windows(2).zip(coefficients.chunks_exact(12)) {
        let points =
            to_bezier([0, 1, 2, 3].map(|k| DVec3::new(c[k], c[4 + k], c[8 + k])), w[1] - w[0]);
        let points = points.map(|q: DVec3| DVec4::new(q.x, q.y, q.z, 1.0)).to_vec();
        pieces.push(bezier::Piece { range: [w[0], w[1]], points });
    }
    bezier::joined(&pieces).map_err(|e| p.fault(e.to_string()))
}

/// Control points of a + b s + c s^2 + d s^3 over [0, h].
pub(super) fn to_bezier(k: [DVec3; 4], h: f64) -> [DVec3; 4] {
    let [a, b, c, d] = [k[0], k[1] * h, k[2] * (h * h), k[3] * (h * h * h)];
    [a, a + b / 3.0, a + b * (2.0 / 3.0) + c / 3.0, a + b + c + d]
}

/// 126: a rational B-spline.
fn spline(p: &Parameters) -> Result<Arc, Fault> {
    let (last, degree) = (p.count(0)?, p.count(1)?);
    if degree > MAX_DEGREE {
        return Err(p.fault(format!("degree {degree} is more than {MAX_DEGREE}")));
    }
    let knot_count = last + degree + 2;
    let knots = p.numbers(6, knot_count)?;
    let weights = p.numbers(6 + knot_count, last + 1)?;
    let from = 7 + knot_count + last;
    let points = p.numbers(from, 3 * (last + 1))?;
    let points = points.chunks_exact(3).map(DVec3::from_slice).collect();
    let curve = NurbsCurve::new(degree, knots, points, plain(weights))
        .map_err(|e| p.fault(e.to_string()))?;
    let end = from + 3 * (last + 1);
    let range =
        within(curve.domain(), [p.number_or(end, f64::NAN), p.number_or(end + 1, f64::NAN)]);
    Ok(Arc { curve, range })
}

/// Weights, or none where all are the same.
pub(super) fn plain(weights: Vec<f64>) -> Vec<f64> {
    if weights.iter().all(|&w| w == weights[0] && w > 0.0) { Vec::new() } else { weights }
}

/// The range that is asked for where it lies in the domain; the whole domain where it makes no sense.
pub(super) fn within(domain: [f64; 2], asked: [f64; 2]) -> [f64; 2] {
    let width = domain[1] - domain[0];
    let [a, b] = asked;
    if (b - a).is_nan() || b - a < 1e-9 * width {
        return domain;
    }
    // Ends a rounding error away from the domain's are the domain's.
    let snap = |t: f64, end: f64| if (t - end).abs() <= 1e-9 * width { end } else { t };
    let (a, b) = (snap(a, domain[0]).max(domain[0]), snap(b, domain[1]).min(domain[1]));
    if a < b { [a, b] } else { domain }
}

/// Pieces of a path turned to run one after the other. Closed ones run as the file has them: which of their ends is
/// nearer is rounding.
pub(super) fn in_line(mut arcs: Vec<Arc>) -> Vec<Arc> {
    for k in 1..arcs.len() {
        let next = [arcs[k].start(), arcs[k].end()];
        let off = |p: DVec3| p.distance(next[0]).min(p.distance(next[1]));
        if k == 1 && !arcs[0].is_closed() && off(arcs[0].start()) < off(arcs[0].end()) {
            arcs[0] = arcs[0].reversed();
        }
        let end = arcs[k - 1].end();
        if !arcs[k].is_closed() && end.distance(next[1]) < end.distance(next[0]) {
            arcs[k] = arcs[k].reversed();
        }
    }
    arcs
}
