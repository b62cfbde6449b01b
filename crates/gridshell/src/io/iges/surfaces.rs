//! Surface entities as exact splines: 108, 114, 118, 120, 122, 128, 190, 192, 194, 196, 198; `offset` has 140.

use super::curves::{Arc, plain, to_bezier, within};
use super::directory::{Entry, Parameters};
use super::trimmed::placed;
use super::{Fault, File, arc, bezier};
use crate::math::trig;
use crate::surface::Shape;
use crate::surface::nurbs::{MAX_DEGREE, NurbsCurve, NurbsSurface};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// Surfaces without end are made larger than what bounds them by this share.
const MARGIN: f64 = 0.1;

/// A surface and the part of its parameters that is meant.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    pub shape: Shape,
    pub range: [[f64; 2]; 2],
}

impl Sheet {
    fn whole(surface: NurbsSurface) -> Sheet {
        let range = surface.domain();
        Sheet { shape: Shape::Nurbs(surface), range }
    }

    /// Whether only a part of the surface's own domain is meant.
    pub fn is_part(&self) -> bool {
        self.range != self.shape.domain()
    }
}

/// Types of entities that are surfaces here.
pub(super) fn is_surface(kind: u32) -> bool {
    matches!(kind, 108 | 114 | 118 | 120 | 122 | 128 | 140 | 190 | 192 | 194 | 196 | 198)
}

impl File<'_> {
    /// The surface of entity `number` in the space of the model. Surfaces without end are made to reach all of
    /// `reach`.
    pub fn surface(&self, number: u32, reach: &[DVec3]) -> Result<Sheet, Fault> {
        self.surface_at(number, reach, 0)
    }

    pub fn surface_at(&self, number: u32, reach: &[DVec3], level: usize) -> Result<Sheet, Fault> {
        let entry = self.known(number)?;
        self.visit(&entry, level)?;
        let place = self.place(&entry)?;
        let back = place.inverse();
        if !back.is_finite() {
            return Err(entry.fault("its transformation flattens it"));
        }
        let reach: Vec<DVec3> = reach.iter().map(|&p| back.transform_point3(p)).collect();
        let p = self.directory.parameters(&entry)?;
        let sheet = match entry.kind {
            128 => spline(&p)?,
            114 => cubic(&p)?,
            118 => self.ruled(&entry, &p)?,
            120 => self.revolved(&p)?,
            122 => self.tabulated(&p)?,
            108 | 190 => self.plane(&entry, &p, &reach)?,
            192 | 194 | 196 | 198 => self.round(&entry, &p, &reach)?,
            140 => self.offset(&p, &reach, level)?,
            _ => return Err(p.fault("this type of entity is not read as a surface")),
        };
        let shape = placed(sheet.shape, &place);
        self.spend(&entry, shape.spline().map_or(0, |s| s.points.len()))?;
        Ok(Sheet { shape, range: sheet.range })
    }

    /// 118: straight lines between two curves at the same share of their parameters.
    fn ruled(&self, entry: &Entry, p: &Parameters) -> Result<Sheet, Fault> {
        let arc =
            |k: usize| self.curve(p.pointer(k)?.ok_or_else(|| p.fault("a curve is missing"))?);
        let (one, mut two): (Arc, Arc) = (arc(0)?, arc(1)?);
        if p.flag(2) {
            two = two.reversed();
        }
        if entry.form == 0 {
            self.note(format!(
                "{}: taken as ruled by parameters, not by arc length",
                entry.place()
            ));
        }
        // Both over [0, 1], with the same breaks and the same degree.
        let unit = |arc: &Arc| -> Vec<f64> {
            let [a, b] = arc.range;
            let inner = arc.curve.knots.iter().filter(|&&k| k > a && k < b);
            inner.map(|k| (k - a) / (b - a)).collect()
        };
        let mut breaks: Vec<f64> = unit(&one).into_iter().chain(unit(&two)).collect();
        breaks.extend([0.0, 1.0]);
        breaks.sort_by(f64::total_cmp);
        breaks.dedup_by(|a, b| *a - *b < 1e-9);
        if let Some(last) = breaks.last_mut() {
            *last = 1.0;
        }
        let degree = one.curve.degree.max(two.curve.degree);
        let rows = [one, two].map(|arc| {
            let [a, b] = arc.range;
            let at = |s: f64| if s == 1.0 { b } else { a + (b - a) * s };
            let mut pieces = Vec::new();
            for w in breaks.windows(2) {
                // Rounding may leave a tiny piece beside a knot: the longest is the one.
                let found = bezier::pieces(&arc.curve, [at(w[0]), at(w[1])]);
                let longest = found
                    .into_iter()
                    .max_by(|p, q| (p.range[1] - p.range[0]).total_cmp(&(q.range[1] - q.range[0])));
                if let Some(piece) = longest {
                    let mut piece = bezier::elevate(&piece, degree);
                    piece.range = [w[0], w[1]];
                    pieces.push(piece);
                }
            }
            bezier::joined(&pieces)
        });
        let [first, second] = rows;
        let fault = |e: crate::error::Error| p.fault(e.to_string());
        let (first, second) = (first.map_err(fault)?, second.map_err(fault)?);
        let pairs = first.points.iter().zip(&second.points);
        let points = pairs.flat_map(|(a, b)| [*a, *b]).collect();
        let weight = |c: &NurbsCurve, i: usize| c.weights.get(i).copied().unwrap_or(1.0);
        let weights =
            (0..first.points.len()).flat_map(|i| [weight(&first, i), weight(&second, i)]).collect();
        let knots = [first.knots.clone(), vec![0.0, 0.0, 1.0, 1.0]];
        let count = [first.points.len(), 2];
        NurbsSurface::new([first.degree, 1], knots, count, points, plain(weights))
            .map(Sheet::whole)
            .map_err(fault)
    }

    /// 120: a curve turned about a line.
    fn revolved(&self, p: &Parameters) -> Result<Sheet, Fault> {
        let axis = self.curve(p.pointer(0)?.ok_or_else(|| p.fault("its axis is missing"))?)?;
        let turned = self.curve(p.pointer(1)?.ok_or_else(|| p.fault("its curve is missing"))?)?;
        let (from, to) = (p.number(2)?, p.number(3)?);
        let direction = (axis.end() - axis.start()).normalize_or_zero();
        if direction == DVec3::ZERO {
            return Err(p.fault("its axis has no length"));
        }
        revolve(&turned, axis.start(), direction, from, to - from)
            .map(Sheet::whole)
            .map_err(|e| p.fault(e))
    }

    /// 122: a curve moved along a straight line.
    fn tabulated(&self, p: &Parameters) -> Result<Sheet, Fault> {
        let base = self.curve(p.pointer(0)?.ok_or_else(|| p.fault("its curve is missing"))?)?;
        let n = p.numbers(1, 3)?;
        let along = DVec3::from_slice(&n) - base.start();
        let curve = bezier::joined(&bezier::pieces(&base.curve, base.range));
        let curve = curve.map_err(|e| p.fault(e.to_string()))?;
        let points: Vec<DVec3> = curve.points.iter().flat_map(|&q| [q, q + along]).collect();
        let weights = curve.weights.iter().flat_map(|&w| [w, w]).collect();
        let count = [curve.points.len(), 2];
        let knots = [curve.knots, vec![0.0, 0.0, 1.0, 1.0]];
        NurbsSurface::new([curve.degree, 1], knots, count, points, weights)
            .map(Sheet::whole)
            .map_err(|e| p.fault(e.to_string()))
    }

    /// 108 and 190: a plane, as large as what bounds it.
    fn plane(&self, entry: &Entry, p: &Parameters, reach: &[DVec3]) -> Result<Sheet, Fault> {
        let (origin, normal, along) = if entry.kind == 108 {
            let n = p.numbers(0, 4)?;
            let normal = DVec3::from_slice(&n[..3]);
            (normal * (n[3] / normal.length_squared()), normal.normalize_or_zero(), DVec3::ZERO)
        } else {
            let along = if entry.form == 1 { self.direction(p, 2)? } else { DVec3::ZERO };
            (self.spot(p, 0)?, self.direction(p, 1)?, along)
        };
        if normal == DVec3::ZERO || !origin.is_finite() {
            return Err(p.fault("it is a plane without a normal"));
        }
        if reach.is_empty() {
            return Err(p.fault("it is a plane that nothing bounds"));
        }
        let [x, y] = across(normal, along);
        let flat = |q: &DVec3| DVec2::new((*q - origin).dot(x), (*q - origin).dot(y));
        let (lo, hi) = reach
            .iter()
            .map(flat)
            .fold((DVec2::MAX, DVec2::MIN), |(lo, hi), q| (lo.min(q), hi.max(q)));
        let margin = MARGIN * (hi - lo).max_element();
        if !(margin > 0.0 && margin.is_finite()) {
            return Err(p.fault("what bounds its plane has no size"));
        }
        let (lo, hi) = (lo - margin, hi + margin);
        let corner = |u: f64, v: f64| origin + x * u + y * v;
        let points =
            vec![corner(lo.x, lo.y), corner(lo.x, hi.y), corner(hi.x, lo.y), corner(hi.x, hi.y)];
        let knots = [vec![lo.x, lo.x, hi.x, hi.x], vec![lo.y, lo.y, hi.y, hi.y]];
        NurbsSurface::new([1, 1], knots, [2, 2], points, Vec::new())
            .map(Sheet::whole)
            .map_err(|e| p.fault(e.to_string()))
    }

    /// 192 to 198: cylinder, cone, sphere, torus, all turned about their axis.
    fn round(&self, entry: &Entry, p: &Parameters, reach: &[DVec3]) -> Result<Sheet, Fault> {
        let centre = self.spot(p, 0)?;
        let sphere = entry.kind == 196;
        let axis = match (sphere, entry.form) {
            (true, 0) => DVec3::Z,
            (true, _) => self.direction(p, 2)?,
            _ => self.direction(p, 1)?,
        };
        let at = match entry.kind {
            194 | 198 => 4,
            _ => 3,
        };
        let along = if entry.form == 1 { self.direction(p, at)? } else { DVec3::ZERO };
        if axis == DVec3::ZERO {
            return Err(p.fault("its axis has no direction"));
        }
        let [x, _] = across(axis, along);
        let radius = p.number(if sphere { 1 } else { 2 })?;
        if radius < 0.0 || (radius == 0.0 && entry.kind != 194) {
            return Err(p.fault("its radius is not positive"));
        }
        let heights = reach.iter().map(|q| (*q - centre).dot(axis));
        let (lo, hi) = heights.fold((f64::MAX, f64::MIN), |(lo, hi), h| (lo.min(h), hi.max(h)));
        let margin = MARGIN * (hi - lo);
        let (lo, hi) = (lo - margin, hi + margin);
        let generator = match entry.kind {
            192 | 194 if !(lo < hi && lo.is_finite() && hi.is_finite()) => {
                return Err(p.fault("it has no end, and nothing bounds it"));
            }
            192 => {
                NurbsCurve::line(centre + x * radius + axis * lo, centre + x * radius + axis * hi)
            }
            194 => {
                let slope =
                    trig::sin(p.number(3)?.to_radians()) / trig::cos(p.number(3)?.to_radians());
                // Not past the tip.
                let tip = -radius / slope;
                let (lo, hi) = if slope > 0.0 { (lo.max(tip), hi) } else { (lo, hi.min(tip)) };
                let at = |h: f64| centre + x * (radius + h * slope) + axis * h;
                NurbsCurve::line(at(lo), at(hi))
            }
            _ => {
                let (middle, small, from, sweep) = if sphere {
                    (centre, radius, -PI / 2.0, PI)
                } else {
                    (centre + x * radius, p.number(3)?, 0.0, TAU)
                };
                if small <= 0.0 {
                    return Err(p.fault("its radius is not positive"));
                }
                let circle = bezier::joined(&arc::unit_circle(from, sweep));
                let mut circle = circle.map_err(|e| p.fault(e.to_string()))?;
                for q in &mut circle.points {
                    *q = middle + x * (q.x * small) + axis * (q.y * small);
                }
                circle
            }
        };
        let range = generator.domain();
        // Round the axis first, so that their normals point outwards.
        revolve(&Arc { curve: generator, range }, centre, axis, 0.0, TAU)
            .and_then(|s| transposed(&s))
            .map(Sheet::whole)
            .map_err(|e| p.fault(e))
    }

    /// The point (116) that parameter `k` names.
    fn spot(&self, p: &Parameters, k: usize) -> Result<DVec3, Fault> {
        let point = self.known(p.pointer(k)?.ok_or_else(|| p.fault("a point is missing"))?)?;
        if point.kind != 116 {
            return Err(point.fault("a point is asked for here, which this is not"));
        }
        let n = self.directory.parameters(&point)?.numbers(0, 3)?;
        Ok(self.place(&point)?.transform_point3(DVec3::from_slice(&n)))
    }

    /// The unit direction (123) that parameter `k` names.
    fn direction(&self, p: &Parameters, k: usize) -> Result<DVec3, Fault> {
        let entry = self.known(p.pointer(k)?.ok_or_else(|| p.fault("a direction is missing"))?)?;
        if entry.kind != 123 {
            return Err(entry.fault("a direction is asked for here, which this is not"));
        }
        let n = self.directory.parameters(&entry)?.numbers(0, 3)?;
        Ok(self.place(&entry)?.transform_vector3(DVec3::from_slice(&n)).normalize_or_zero())
    }
}

/// Two unit directions perpendicular to `normal` and to each other, the first near `along` where that is given.
fn across(normal: DVec3, along: DVec3) -> [DVec3; 2] {
    let x = (along - normal * along.dot(normal)).normalize_or_zero();
    let x = if x == DVec3::ZERO { normal.any_orthonormal_vector() } else { x };
    [x, normal.cross(x)]
}

/// A curve turned about an axis through `sweep` radians: u along the curve, v round the axis.
fn revolve(
    turned: &Arc,
    centre: DVec3,
    axis: DVec3,
    from: f64,
    sweep: f64,
) -> Result<NurbsSurface, String> {
    if !(sweep > 0.0 && sweep <= TAU + 1e-6) {
        return Err(format!(
            "it turns through {sweep} radians, which is not from 0 to a whole turn"
        ));
    }
    let text = |e: crate::error::Error| e.to_string();
    let circle = bezier::joined(&arc::unit_circle(from, sweep.min(TAU))).map_err(text)?;
    let curve = bezier::joined(&bezier::pieces(&turned.curve, turned.range)).map_err(text)?;
    let (mut points, mut weights) = (Vec::new(), Vec::new());
    let weight = |c: &NurbsCurve, i: usize| c.weights.get(i).copied().unwrap_or(1.0);
    for (i, &q) in curve.points.iter().enumerate() {
        let foot = centre + axis * (q - centre).dot(axis);
        let (x, y) = (q - foot, axis.cross(q - foot));
        for (j, c) in circle.points.iter().enumerate() {
            points.push(foot + x * c.x + y * c.y);
            weights.push(weight(&curve, i) * weight(&circle, j));
        }
    }
    let count = [curve.points.len(), circle.points.len()];
    let knots = [curve.knots, circle.knots];
    NurbsSurface::new([curve.degree, circle.degree], knots, count, points, plain(weights))
        .map_err(text)
}

/// The same surface with u and v exchanged.
fn transposed(s: &NurbsSurface) -> Result<NurbsSurface, String> {
    let [m, n] = s.count;
    let order = || (0..m * n).map(|k| k % m * n + k / m);
    let points = order().map(|k| s.points[k]).collect();
    let weights = order().filter_map(|k| s.weights.get(k).copied()).collect();
    let knots = [s.knots[1].clone(), s.knots[0].clone()];
    NurbsSurface::new([s.degree[1], s.degree[0]], knots, [n, m], points, weights)
        .map_err(|e| e.to_string())
}

/// 128: a rational B-spline surface.
fn spline(p: &Parameters) -> Result<Sheet, Fault> {
    let last = [p.count(0)?, p.count(1)?];
    let degree = [p.count(2)?, p.count(3)?];
    if degree.iter().any(|&d| d > MAX_DEGREE) {
        return Err(p.fault(format!("a degree is more than {MAX_DEGREE}")));
    }
    let count = [last[0] + 1, last[1] + 1];
    let knot_count = [last[0] + degree[0] + 2, last[1] + degree[1] + 2];
    let total = count[0].checked_mul(count[1]).filter(|&n| n <= p.len());
    let total = total.ok_or_else(|| {
        p.fault(format!(
            "{} x {} control points are more than there are parameters",
            count[0], count[1]
        ))
    })?;
    let knots = [p.numbers(9, knot_count[0])?, p.numbers(9 + knot_count[0], knot_count[1])?];
    let from = 9 + knot_count[0] + knot_count[1];
    let weights = p.numbers(from, total)?;
    let places = p.numbers(from + total, 3 * total)?;
    // The file has u running fastest.
    let turned = |k: usize| k / count[1] + k % count[1] * count[0];
    let points = (0..total).map(|k| DVec3::from_slice(&places[3 * turned(k)..])).collect();
    let weights = plain((0..total).map(|k| weights[turned(k)]).collect());
    let surface = NurbsSurface::new(degree, knots, count, points, weights)
        .map_err(|e| p.fault(e.to_string()))?;
    let end = from + 4 * total;
    let asked = |k: usize| [p.number_or(end + k, f64::NAN), p.number_or(end + k + 1, f64::NAN)];
    let domain = surface.domain();
    let range = [within(domain[0], asked(0)), within(domain[1], asked(2))];
    Ok(Sheet { shape: Shape::Nurbs(surface), range })
}

/// 114: bicubic patches given by their coefficients.
fn cubic(p: &Parameters) -> Result<Sheet, Fault> {
    let (m, n) = (p.count(2)?, p.count(3)?);
    if m == 0 || n == 0 {
        return Err(p.fault("it has no patches"));
    }
    let breaks = [p.numbers(4, m + 1)?, p.numbers(5 + m, n + 1)?];
    let from = 6 + m + n;
    // Each row ends with a patch that means nothing, as does the last row.
    let count = [3 * m + 1, 3 * n + 1];
    if count[0].checked_mul(count[1]).is_none_or(|total| total > p.len()) {
        return Err(p.fault("it has fewer parameters than its patches need"));
    }
    let mut points = vec![DVec3::ZERO; count[0] * count[1]];
    for i in 0..m {
        for j in 0..n {
            let c = p.numbers(from + 48 * (i * (n + 1) + j), 48)?;
            let (h, k) = (breaks[0][i + 1] - breaks[0][i], breaks[1][j + 1] - breaks[1][j]);
            let coefficient = |a: usize, b: usize| {
                let at = 4 * b + a;
                DVec3::new(c[at], c[16 + at], c[32 + at])
            };
            let rows = [0, 1, 2, 3].map(|b| to_bezier([0, 1, 2, 3].map(|a| coefficient(a, b)), h));
            for a in 0..4 {
                let column = to_bezier([0, 1, 2, 3].map(|b: usize| rows[b][a]), k);
                for (b, &q) in column.iter().enumerate() {
                    points[(3 * i + a) * count[1] + 3 * j + b] = q;
                }
            }
        }
    }
    let knots = breaks.map(|t| {
        let inner = t.iter().flat_map(|&k| [k; 3]);
        let ends = [t[0], t[t.len() - 1]];
        std::iter::once(ends[0]).chain(inner).chain([ends[1]]).collect()
    });
    NurbsSurface::new([3, 3], knots, count, points, Vec::new())
        .map(Sheet::whole)
        .map_err(|e| p.fault(e.to_string()))
}
