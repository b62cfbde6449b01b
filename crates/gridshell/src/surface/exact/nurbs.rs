//! NURBS curves and surfaces: evaluation and first derivatives (Piegl & Tiller, *The NURBS Book*,
//! sections 2.3, 3.2 and 4.3).
//!
//! Parameters outside the domain are brought back: wrapped by the period where the curve or surface
//! closes on itself in that direction, clamped to the nearer end otherwise.

use super::jet::Jet;
use crate::error::{Error, Result};
use glam::{DVec2, DVec3};

/// Highest degree accepted; the scratch arrays of the evaluation hold this much.
pub const MAX_DEGREE: usize = 25;
/// Coordinates beyond this, metres, have lost the digits for a grid: they are faults of a file.
pub const FARTHEST: f64 = 1e9;
/// The same in a file's unit, which may be the millimetre.
pub const FARTHEST_IN_FILE: f64 = 1e12;
/// Two ends nearer than this share of the size are the same place: a curve or surface closes there.
const CLOSED_SHARE: f64 = 1e-6;

/// A (rational) B-spline curve in space.
#[derive(Clone, Debug)]
pub struct NurbsCurve {
    /// Polynomial degree.
    pub degree: usize,
    /// Full knot vector, `points.len() + degree + 1` long.
    pub knots: Vec<f64>,
    /// Control points, metres.
    pub points: Vec<DVec3>,
    /// Weights, one per control point; empty when all are 1.
    pub weights: Vec<f64>,
    closed: bool,
}

/// A (rational) B-spline surface.
#[derive(Clone, Debug)]
pub struct NurbsSurface {
    /// Polynomial degrees in u and v.
    pub degree: [usize; 2],
    /// Full knot vectors in u and v.
    pub knots: [Vec<f64>; 2],
    /// Number of control points in u and v.
    pub count: [usize; 2],
    /// Control points, metres; the point (i, j) stands at `i * count[1] + j`.
    pub points: Vec<DVec3>,
    /// Weights, one per control point; empty when all are 1.
    pub weights: Vec<f64>,
    closed: [bool; 2],
}

impl NurbsCurve {
    /// A curve from its parts; `weights` may be empty (all 1).
    ///
    /// # Errors
    /// [`Error::Surface`] saying which part is wrong: degree, knots, points or weights.
    pub fn new(
        degree: usize,
        knots: Vec<f64>,
        points: Vec<DVec3>,
        weights: Vec<f64>,
    ) -> Result<NurbsCurve> {
        check_knots(degree, &knots, points.len())?;
        check_points(&points, &weights)?;
        let mut curve = NurbsCurve { degree, knots, points, weights, closed: false };
        let [a, b] = curve.domain();
        curve.closed =
            curve.point(a).distance(curve.point(b)) <= CLOSED_SHARE * size(&curve.points);
        Ok(curve)
    }

    /// The straight line from `a` to `b` over [0, 1].
    pub fn line(a: DVec3, b: DVec3) -> NurbsCurve {
        NurbsCurve {
            degree: 1,
            knots: vec![0.0, 0.0, 1.0, 1.0],
            points: vec![a, b],
            weights: Vec::new(),
            closed: false,
        }
    }

    /// First and last parameter.
    pub fn domain(&self) -> [f64; 2] {
        [self.knots[self.degree], self.knots[self.points.len()]]
    }

    /// Whether both ends are the same place.
    pub fn closed(&self) -> bool {
        self.closed
    }

    /// The same curve with no more points than those that shape it over `range`, which must lie in its domain; None
    /// where it does not, or where that is all of them.
    pub(in crate::surface) fn part(&self, range: [f64; 2]) -> Option<NurbsCurve> {
        let [from, to] = self.domain();
        if range[0] < from || range[1] > to || range[0] >= range[1] {
            return None;
        }
        let p = self.degree;
        let first = self.knots[p..=self.points.len()].partition_point(|&k| k <= range[0]) - 1;
        let inside = &self.knots[p..=self.points.len()];
        let last = inside.partition_point(|&k| k < range[1]) - 1 + p;
        if last - first + 1 == self.points.len() {
            return None;
        }
        let weights = self.weights.get(first..=last).unwrap_or_default().to_vec();
        let knots = self.knots[first..=last + p + 1].to_vec();
        NurbsCurve::new(p, knots, self.points[first..=last].to_vec(), weights).ok()
    }

    /// Position at `t`.
    pub fn point(&self, t: f64) -> DVec3 {
        self.jet(t)[0]
    }

    /// Position and derivative at `t`.
    pub fn jet(&self, t: f64) -> [DVec3; 2] {
        let b = Basis::at(&self.knots, self.degree, self.points.len(), self.closed, t);
        let (mut p, mut d) = (DVec3::ZERO, DVec3::ZERO);
        let points = &self.points[b.first..=b.first + self.degree];
        if self.weights.is_empty() {
            for (i, &c) in points.iter().enumerate() {
                p += c * b.value[i];
                d += c * b.slope[i];
            }
            return [p, d];
        }
        let (mut w, mut wd) = (0.0, 0.0);
        for (i, (&c, &weight)) in points.iter().zip(&self.weights[b.first..]).enumerate() {
            let (n, dn) = (b.value[i] * weight, b.slope[i] * weight);
            p += c * n;
            d += c * dn;
            w += n;
            wd += dn;
        }
        let point = p / w;
        [point, (d - point * wd) / w]
    }
}

impl NurbsSurface {
    /// A surface from its parts; `weights` may be empty (all 1).
    ///
    /// # Errors
    /// [`Error::Surface`] saying which part is wrong: degree, knots, points or weights.
    pub fn new(
        degree: [usize; 2],
        knots: [Vec<f64>; 2],
        count: [usize; 2],
        points: Vec<DVec3>,
        weights: Vec<f64>,
    ) -> Result<NurbsSurface> {
        for k in 0..2 {
            check_knots(degree[k], &knots[k], count[k])?;
        }
        if count[0].checked_mul(count[1]) != Some(points.len()) {
            return Err(Error::Surface(format!(
                "a surface of {} x {} control points has {} of them",
                count[0],
                count[1],
                points.len()
            )));
        }
        check_points(&points, &weights)?;
        let mut surface =
            NurbsSurface { degree, knots, count, points, weights, closed: [false; 2] };
        surface.closed = [surface.closes(0), surface.closes(1)];
        Ok(surface)
    }

    /// First and last parameter in u and in v.
    pub fn domain(&self) -> [[f64; 2]; 2] {
        [0, 1].map(|k| [self.knots[k][self.degree[k]], self.knots[k][self.count[k]]])
    }

    /// Whether the surface closes on itself in u and in v.
    pub fn closed(&self) -> [bool; 2] {
        self.closed
    }

    /// The different knots of direction `k` inside its domain, its two ends included.
    pub fn breaks(&self, k: usize) -> Vec<f64> {
        let mut b = self.knots[k][self.degree[k]..=self.count[k]].to_vec();
        b.dedup();
        b
    }

    /// The curve on it where the parameter of direction `k` has this value; None where that is not a curve.
    pub(in crate::surface) fn iso(&self, k: usize, value: f64) -> Option<NurbsCurve> {
        let b = Basis::at(&self.knots[k], self.degree[k], self.count[k], self.closed[k], value);
        let (mut points, mut weights) = (Vec::new(), Vec::new());
        for j in 0..self.count[1 - k] {
            let (mut sum, mut weight) = (DVec3::ZERO, 0.0);
            for (i, share) in b.value[..=self.degree[k]].iter().enumerate() {
                let at = if k == 0 {
                    (b.first + i) * self.count[1] + j
                } else {
                    j * self.count[1] + b.first + i
                };
                let share = share * self.weights.get(at).copied().unwrap_or(1.0);
                sum += self.points[at] * share;
                weight += share;
            }
            points.push(sum / weight);
            weights.push(weight);
        }
        if self.weights.is_empty() {
            weights.clear();
        }
        NurbsCurve::new(self.degree[1 - k], self.knots[1 - k].clone(), points, weights).ok()
    }

    /// The part of it between two values of u and two of v, or the ends of its domain: knots as frequent as the
    /// degree, where it takes its points over as they are. None where they leave nothing.
    pub(in crate::surface) fn between(&self, sides: [[Option<f64>; 2]; 2]) -> Option<NurbsSurface> {
        let mut spans = [[0; 2]; 2];
        let mut knots = self.knots.clone();
        for k in 0..2 {
            let (all, p) = (&self.knots[k], self.degree[k]);
            let after = |t: f64| all.partition_point(|&x| x <= t).checked_sub(p + 1);
            let before = |t: f64| all.partition_point(|&x| x < t).checked_sub(1);
            let [low, high] = sides[k];
            let first = low.map_or(Some(0), after)?;
            let last = high.map_or(Some(self.count[k] - 1), before)?;
            let mut part = all.get(first..=last + p + 1)?.to_vec();
            let end = part.len() - 1;
            // The outermost knots shape nothing.
            part[0] = low.unwrap_or(part[0]);
            part[end] = high.unwrap_or(part[end]);
            (spans[k], knots[k]) = ([first, last], part);
        }
        let [[i0, i1], [j0, j1]] = spans;
        let rows = (i0..=i1).map(|i| i * self.count[1] + j0..=i * self.count[1] + j1);
        let points = rows.clone().flat_map(|r| &self.points[r]).copied().collect();
        let weights = if self.weights.is_empty() {
            Vec::new()
        } else {
            rows.flat_map(|r| &self.weights[r]).copied().collect()
        };
        let count = spans.map(|[a, b]| (b + 1).saturating_sub(a));
        NurbsSurface::new(self.degree, knots, count, points, weights).ok()
    }

    /// Position at `uv`.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        self.jet(uv).point
    }

    /// Position and first derivatives at `uv`.
    pub fn jet(&self, uv: DVec2) -> Jet {
        let [p, q] = self.degree;
        let bu = Basis::at(&self.knots[0], p, self.count[0], self.closed[0], uv.x);
        let bv = Basis::at(&self.knots[1], q, self.count[1], self.closed[1], uv.y);
        let (mut a, mut du, mut dv) = (DVec3::ZERO, DVec3::ZERO, DVec3::ZERO);
        let (mut w, mut wu, mut wv) = (0.0, 0.0, 0.0);
        for i in 0..=p {
            let start = (bu.first + i) * self.count[1] + bv.first;
            let points = &self.points[start..=start + q];
            let (mut row, mut row_v) = (DVec3::ZERO, DVec3::ZERO);
            if self.weights.is_empty() {
                for (j, &c) in points.iter().enumerate() {
                    row += c * bv.value[j];
                    row_v += c * bv.slope[j];
                }
            } else {
                let (mut row_w, mut row_wv) = (0.0, 0.0);
                for (j, (&c, &weight)) in points.iter().zip(&self.weights[start..]).enumerate() {
                    let (n, dn) = (bv.value[j] * weight, bv.slope[j] * weight);
                    row += c * n;
                    row_v += c * dn;
                    row_w += n;
                    row_wv += dn;
                }
                w += row_w * bu.value[i];
                wu += row_w * bu.slope[i];
                wv += row_wv * bu.value[i];
            }
            a += row * bu.value[i];
            du += row * bu.slope[i];
            dv += row_v * bu.value[i];
        }
        if self.weights.is_empty() {
            return Jet { point: a, du, dv };
        }
        let point = a / w;
        Jet { point, du: (du - point * wu) / w, dv: (dv - point * wv) / w }
    }

    /// Whether the two sides across direction `k` are the same curve.
    fn closes(&self, k: usize) -> bool {
        let domain = self.domain();
        let tolerance = CLOSED_SHARE * size(&self.points);
        let along = self.breaks(1 - k);
        along.windows(2).all(|w| {
            (0..=self.degree[1 - k]).all(|i| {
                let t = w[0] + (w[1] - w[0]) * i as f64 / self.degree[1 - k] as f64;
                let [a, b] = domain[k].map(|s| {
                    let uv = if k == 0 { DVec2::new(s, t) } else { DVec2::new(t, s) };
                    self.point(uv)
                });
                a.distance(b) <= tolerance
            })
        })
    }
}

/// From the basis functions of degree `d - 1` over the span that begins at `span` to those of degree `d`.
pub(super) fn raise(
    value: &mut [f64; MAX_DEGREE + 1],
    knots: &[f64],
    span: usize,
    d: usize,
    t: f64,
) {
    let mut carried = 0.0;
    for r in 0..d {
        let (right, left) = (knots[span + r + 1], knots[span + 1 + r - d]);
        let share = value[r] / (right - left);
        value[r] = carried + (right - t) * share;
        carried = (t - left) * share;
    }
    value[d] = carried;
}

/// Derivatives of the basis functions of degree `d`, from those of degree `d - 1` or their own derivatives:
/// N' = p (N_(i, p-1) / (k_(i+p) - k_i) - N_(i+1, p-1) / (k_(i+p+1) - k_(i+1))).
pub(super) fn raised_slope(
    value: &[f64; MAX_DEGREE + 1],
    knots: &[f64],
    span: usize,
    d: usize,
) -> [f64; MAX_DEGREE + 1] {
    let mut slope = [0.0; MAX_DEGREE + 1];
    for r in 0..d {
        let share = d as f64 * value[r] / (knots[span + r + 1] - knots[span + 1 + r - d]);
        slope[r] -= share;
        slope[r + 1] += share;
    }
    slope
}

/// The basis functions that are not zero at one parameter, and their derivatives.
pub(super) struct Basis {
    /// Index of the first control point that counts.
    pub first: usize,
    pub value: [f64; MAX_DEGREE + 1],
    pub slope: [f64; MAX_DEGREE + 1],
}

impl Basis {
    pub fn at(knots: &[f64], degree: usize, count: usize, closed: bool, t: f64) -> Basis {
        let t = into_domain(knots[degree], knots[count], closed, t);
        // The last span that begins at or before t; at the very end the last one that has a length.
        let after = knots[degree..=count].partition_point(|&k| k <= t);
        let span = if after > count - degree {
            degree + knots[degree..count].partition_point(|&k| k < t) - 1
        } else {
            degree + after - 1
        };
        let mut value = [0.0; MAX_DEGREE + 1];
        let mut slope = [0.0; MAX_DEGREE + 1];
        value[0] = 1.0;
        for d in 1..=degree {
            if d == degree {
                slope = raised_slope(&value, knots, span, d);
            }
            raise(&mut value, knots, span, d, t);
        }
        Basis { first: span - degree, value, slope }
    }
}

/// `t` brought into [lo, hi]: by whole periods where closed, to the nearer end otherwise.
pub(super) fn into_domain(lo: f64, hi: f64, closed: bool, t: f64) -> f64 {
    if t >= lo && t <= hi {
        return t;
    }
    if !closed || !t.is_finite() {
        return if t > hi { hi } else { lo };
    }
    let period = hi - lo;
    (t - ((t - lo) / period).floor() * period).clamp(lo, hi)
}

/// Knots and weights are no larger than this, and weights and steps between knots no smaller than its inverse: far
/// beyond what a file means, and near enough that rates of change and their squares stay numbers.
const LARGEST: f64 = 1e30;

fn check_knots(degree: usize, knots: &[f64], count: usize) -> Result<()> {
    let fail = |what: String| Err(Error::Surface(what));
    if !(1..=MAX_DEGREE).contains(&degree) {
        return fail(format!("degree {degree} is not from 1 to {MAX_DEGREE}"));
    }
    if count < degree + 1 {
        return fail(format!("{count} control points are too few for degree {degree}"));
    }
    if knots.len() != count + degree + 1 {
        return fail(format!("{} knots where {} are needed", knots.len(), count + degree + 1));
    }
    if knots.iter().any(|k| !k.is_finite()) || knots.windows(2).any(|w| w[0] > w[1]) {
        return fail("the knots do not ascend".into());
    }
    if let Some(k) = knots.iter().find(|k| k.abs() > LARGEST) {
        return fail(format!("its knot {k:e} is larger than {LARGEST:e}"));
    }
    for (&a, &b) in knots.iter().zip(&knots[1..]) {
        if a < b && b - a < 1.0 / LARGEST {
            return fail(format!("its knots {a:e} and {b:e} are neither equal nor apart"));
        }
    }
    if knots[degree] >= knots[count] {
        return fail("the knots leave no domain".into());
    }
    // More than degree + 1 equal knots would make basis functions of no width.
    if knots.windows(degree + 2).any(|w| w[0] == w[degree + 1]) {
        return fail(format!("a knot is repeated more than {} times", degree + 1));
    }
    Ok(())
}

/// A point that a model may have: no coordinate is beyond `farthest` or no number.
///
/// # Errors
/// [`Error::Surface`] telling the point.
pub fn reach(p: DVec3, farthest: f64) -> Result<DVec3> {
    if p.is_finite() && p.abs().max_element() <= farthest {
        return Ok(p);
    }
    Err(Error::Surface(format!(
        "a point at ({:e}, {:e}, {:e}) is out of reach ({farthest:e})",
        p.x, p.y, p.z
    )))
}

fn check_points(points: &[DVec3], weights: &[f64]) -> Result<()> {
    for &p in points {
        reach(p, FARTHEST_IN_FILE)?;
    }
    if !weights.is_empty() && weights.len() != points.len() {
        return Err(Error::Surface(format!(
            "{} weights for {} points",
            weights.len(),
            points.len()
        )));
    }
    if weights.iter().any(|&w| !(w.is_finite() && w > 0.0)) {
        return Err(Error::Surface("a weight is not positive".into()));
    }
    if let Some(w) = weights.iter().find(|&&w| !(1.0 / LARGEST..=LARGEST).contains(&w)) {
        return Err(Error::Surface(format!("its weight {w:e} is out of proportion")));
    }
    Ok(())
}

/// Diagonal of the box around the points.
fn size(points: &[DVec3]) -> f64 {
    let lo = points.iter().fold(DVec3::MAX, |a, &b| a.min(b));
    let hi = points.iter().fold(DVec3::MIN, |a, &b| a.max(b));
    lo.distance(hi)
}

/// An eighth of the unit sphere; its pole is the whole side v = 1.
#[cfg(test)]
pub(super) fn octant() -> NurbsSurface {
    const HALF: f64 = std::f64::consts::FRAC_1_SQRT_2;
    let arc = [(1.0, 0.0, 1.0), (1.0, 1.0, HALF), (0.0, 1.0, 1.0)];
    let (mut points, mut weights) = (Vec::new(), Vec::new());
    for (x, y, wu) in arc {
        for (rho, z, wv) in arc {
            points.push(DVec3::new(x * rho, y * rho, z));
            weights.push(wu * wv);
        }
    }
    let knots = || vec![0., 0., 0., 1., 1., 1.];
    NurbsSurface::new([2, 2], [knots(), knots()], [3, 3], points, weights).expect("a patch")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_1_SQRT_2;

    fn circle() -> NurbsCurve {
        let w = FRAC_1_SQRT_2;
        let xy = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)];
        NurbsCurve::new(
            2,
            vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0],
            xy.iter().map(|&(x, y)| DVec3::new(f64::from(x), f64::from(y), 0.5)).collect(),
            vec![1.0, w, 1.0, w, 1.0, w, 1.0, w, 1.0],
        )
        .unwrap()
    }

    fn bumpy() -> NurbsSurface {
        let count = [5, 6];
        let points = (0..30).map(|k| {
            let (i, j) = (f64::from(k / 6), f64::from(k % 6));
            DVec3::new(i + 0.1 * j, j, (i * 1.3 + j * j * 0.2) % 1.7)
        });
        let weights = (0..30).map(|k| 1.0 + 0.1 * f64::from(k % 7)).collect();
        let knots = [
            vec![0., 0., 0., 0., 0.4, 1., 1., 1., 1.],
            vec![-1., -1., -1., 0., 0.5, 0.5, 2., 2., 2.],
        ];
        NurbsSurface::new([3, 2], knots, count, points.collect(), weights).unwrap()
    }

    /// A domain 5e-315 wide, in a damaged file, gave a face an area that was not a number.
    #[test]
    fn knots_and_weights_beyond_arithmetic_are_refused_and_close_ones_are_not() {
        let plane = |knots: [f64; 5], weight: f64| {
            let corners = (0..6).map(|k| DVec3::new(f64::from(k / 2), f64::from(k % 2), 0.0));
            let weights = vec![1.0, 1.0, weight, 1.0, 1.0, 1.0];
            let v = vec![0.0, 0.0, 1.0, 1.0];
            let u = knots.to_vec();
            NurbsSurface::new([1, 1], [u, v], [3, 2], corners.collect(), weights)
        };
        let refused = [
            ([0.0, 0.0, 2e-315, 5e-315, 5e-315], 1.0),
            ([0.0, 0.0, 1e-40, 3.0, 3.0], 1.0),
            ([-1e300, -1e300, 0.0, 1e300, 1e300], 1.0),
            ([0.0, 0.0, 1.0, 2.0, 2.0], 1e-310),
            ([0.0, 0.0, 1.0, 2.0, 2.0], 1e200),
        ];
        for (knots, weight) in refused {
            assert!(plane(knots, weight).is_err(), "{knots:?}, {weight:e}");
        }
        let taken = [[0.0, 0.0, 1e-17, 3.0, 3.0], [1e6, 1e6, 1e6 + 1e-9, 2e6, 2e6]];
        for knots in taken {
            let surface = plane(knots, 1.0).expect("an odd plane");
            for at in 0..=8 {
                let u = knots[0] + (knots[4] - knots[0]) * f64::from(at) / 8.0;
                let jet = surface.jet(DVec2::new(u, 0.5));
                assert!(jet.point.z == 0.0 && jet.du.cross(jet.dv).length().is_finite());
            }
        }
    }

    #[test]
    fn circle_is_round_and_its_derivative_is_tangent() {
        let c = circle();
        for i in 0..=40 {
            let [p, d] = c.jet(f64::from(i) * 0.1);
            assert!((p.truncate().length() - 1.0).abs() < 1e-15, "{p}");
            assert!(p.truncate().dot(d.truncate()).abs() < 1e-14, "{d}");
        }
    }

    #[test]
    fn closed_curve_wraps_past_its_end() {
        let c = circle();
        assert!(c.closed());
        assert!(c.point(4.3).distance(c.point(0.3)) < 1e-15);
        assert!(c.point(-0.7).distance(c.point(3.3)) < 1e-14);
        assert_eq!(c.point(4.0), c.points[8]);
    }

    #[test]
    fn open_curve_stops_at_its_end() {
        let c = NurbsCurve::line(DVec3::ZERO, DVec3::X);
        assert_eq!(c.point(1.5), DVec3::X);
        assert_eq!(c.point(-1.5), DVec3::ZERO);
    }

    #[test]
    fn cubic_bezier_agrees_with_its_polynomial() {
        let p =
            [DVec3::ZERO, DVec3::new(1., 2., 0.), DVec3::new(3., -1., 1.), DVec3::new(4., 0., 2.)];
        let c =
            NurbsCurve::new(3, vec![0., 0., 0., 0., 1., 1., 1., 1.], p.to_vec(), vec![]).unwrap();
        for i in 0..=10 {
            let t = f64::from(i) * 0.1;
            let s = 1.0 - t;
            let exact = p[0] * s * s * s
                + p[1] * 3.0 * t * s * s
                + p[2] * 3.0 * t * t * s
                + p[3] * t * t * t;
            assert!(c.point(t).distance(exact) < 1e-14);
        }
    }

    #[test]
    fn unclamped_periodic_curve_is_smooth_across_its_seam() {
        let ring = [(2., 0.), (0., 2.), (-2., 0.), (0., -2.)];
        let points: Vec<_> =
            (0..7).map(|i| DVec3::new(ring[i % 4].0, ring[i % 4].1, 0.0)).collect();
        let knots = (0..11).map(f64::from).collect();
        let c = NurbsCurve::new(3, knots, points, vec![]).unwrap();
        assert_eq!(c.domain(), [3.0, 7.0]);
        assert!(c.closed());
        let (a, b) = (c.jet(3.0), c.jet(7.0));
        assert!(a[0].distance(b[0]) < 1e-15 && a[1].distance(b[1]) < 1e-14);
        // Uniform cubic: (1, 4, 1) / 6 of three control points.
        assert!(a[0].distance(DVec3::new(0.0, 8.0 / 6.0, 0.0)) < 1e-14, "{}", a[0]);
    }

    #[test]
    fn surface_derivatives_agree_with_differences() {
        let s = bumpy();
        let h = 1e-6;
        for (u, v) in [(0.1, -0.5), (0.39, 0.2), (0.7, 1.2), (0.95, 1.99), (0.5, 0.1)] {
            let j = s.jet(DVec2::new(u, v));
            let du = (s.point(DVec2::new(u + h, v)) - s.point(DVec2::new(u - h, v))) / (2.0 * h);
            let dv = (s.point(DVec2::new(u, v + h)) - s.point(DVec2::new(u, v - h))) / (2.0 * h);
            assert!(du.distance(j.du) < 1e-7 && dv.distance(j.dv) < 1e-7, "{u} {v}");
        }
    }

    #[test]
    fn basis_sums_to_one_and_its_slopes_to_nothing() {
        let s = bumpy();
        for i in 0..=60 {
            let t = -1.0 + 0.05 * f64::from(i);
            let b = Basis::at(&s.knots[1], 2, 6, false, t);
            assert!((b.value.iter().sum::<f64>() - 1.0).abs() < 1e-14);
            assert!(b.slope.iter().sum::<f64>().abs() < 1e-13);
        }
    }

    #[test]
    fn corners_of_a_clamped_surface_are_its_corner_points() {
        let s = bumpy();
        let [[u0, u1], [v0, v1]] = s.domain();
        assert!(s.point(DVec2::new(u0, v0)).distance(s.points[0]) < 1e-14);
        assert!(s.point(DVec2::new(u1, v1)).distance(s.points[29]) < 1e-14);
        assert!(s.point(DVec2::new(u0, v1)).distance(s.points[5]) < 1e-14);
        assert_eq!(s.closed(), [false, false]);
    }

    #[test]
    fn broken_parts_are_refused_not_evaluated() {
        let p = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        let knots = || vec![0., 0., 0., 1., 1., 1.];
        assert!(NurbsCurve::new(2, knots(), p.clone(), vec![]).is_ok());
        assert!(NurbsCurve::new(3, knots(), p.clone(), vec![]).is_err());
        assert!(NurbsCurve::new(0, knots(), p.clone(), vec![]).is_err());
        assert!(NurbsCurve::new(usize::MAX, knots(), p.clone(), vec![]).is_err());
        assert!(NurbsCurve::new(2, knots(), p.clone(), vec![1.0, 0.0, 1.0]).is_err());
        assert!(NurbsCurve::new(2, vec![0., 0., 1., 0., 1., 1.], p.clone(), vec![]).is_err());
        assert!(NurbsCurve::new(2, vec![0.; 6], p.clone(), vec![]).is_err());
        assert!(NurbsCurve::new(2, knots(), vec![DVec3::NAN; 3], vec![]).is_err());
        let grid = NurbsSurface::new(
            [1, 1],
            [vec![0., 0., 1., 1.], vec![0., 0., 1., 1.]],
            [2, 2],
            p,
            vec![],
        );
        assert!(grid.is_err());
    }
}
