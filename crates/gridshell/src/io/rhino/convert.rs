//! The decoder's geometry as ours: millimetres become metres, analytic shapes exact rational splines.

use crate::math::trig;
use crate::surface::nurbs::{self, NurbsCurve, NurbsSurface};
use crate::surface::{Curve, Shape};
use cadmpeg_ir::geometry::analytic::{CircleCurve, PlaneSurface};
use cadmpeg_ir::geometry::nurbs as theirs;
use cadmpeg_ir::geometry::pcurve::PcurveGeometry;
use cadmpeg_ir::geometry::{
    CurveGeometry, SolvedCurveGeometry, SolvedSurfaceGeometry, SurfaceGeometry,
};
use cadmpeg_ir::math::{Point3, Vector3};
use cadmpeg_ir::units::FinitePoint2;
use glam::{DVec2, DVec3};
use std::f64::consts::FRAC_PI_2;

/// The decoder's unit, millimetres, in metres.
pub(super) const METRES: f64 = 0.001;
/// A plane reaches beyond the loops on it by this share of their size.
const MARGIN: f64 = 0.05;
/// Shorter edges than this share of a metre mark poles.
const NOTHING: f64 = 1e-12;

/// What was read, or why it could not be.
pub(super) type Read<T> = std::result::Result<T, String>;

/// A point in metres.
pub(super) fn point(p: Point3) -> DVec3 {
    DVec3::new(p.x, p.y, p.z) * METRES
}

/// A point that is not too far away.
pub(super) fn reached(p: DVec3) -> Read<DVec3> {
    nurbs::reach(p, nurbs::FARTHEST).map_err(|e| e.to_string())
}

fn vector(v: &Vector3) -> DVec3 {
    DVec3::new(v.x, v.y, v.z)
}

/// A surface that is a spline; None where it is another.
pub(super) fn whole(geometry: &SurfaceGeometry) -> Read<Option<Shape>> {
    match geometry.solved() {
        Some(SolvedSurfaceGeometry::Nurbs(s)) => spline(s).map(Some),
        _ => Ok(None),
    }
}

/// A surface; `rim` tells how far a plane reaches.
pub(super) fn surface(geometry: &SurfaceGeometry, rim: &[DVec3]) -> Read<Shape> {
    match geometry.solved() {
        Some(SolvedSurfaceGeometry::Nurbs(s)) => spline(s),
        Some(SolvedSurfaceGeometry::Plane(p)) => plane(p, rim),
        Some(_) => Err("its kind of surface is not known here".into()),
        None => Err("its surface could not be worked out".into()),
    }
}

fn spline(s: &theirs::NurbsSurface) -> Read<Shape> {
    let points = s.poles().iter().map(|p| point(**p)).collect();
    let weights = s.pole_weights().unwrap_or_default().iter().map(|w| w.get()).collect();
    let degree = [s.u_degree(), s.v_degree()].map(|d| d as usize);
    let knots = [s.u_knots().to_vec(), s.v_knots().to_vec()];
    let count = [s.u_count(), s.v_count()];
    NurbsSurface::new(degree, knots, count, points, weights)
        .map(Shape::Nurbs)
        .map_err(|e| e.to_string())
}

/// The part of a plane that holds `rim`.
fn plane(p: &PlaneSurface, rim: &[DVec3]) -> Read<Shape> {
    if rim.is_empty() {
        return Err("a plane without edges has no end".into());
    }
    let origin = point(*p.origin());
    let x = vector(p.frame().reference().as_raw());
    let y = vector(p.frame().axis().as_raw()).cross(x);
    let flat = |p: &DVec3| DVec2::new((*p - origin).dot(x), (*p - origin).dot(y));
    let low = rim.iter().map(flat).fold(DVec2::INFINITY, DVec2::min);
    let high = rim.iter().map(flat).fold(DVec2::NEG_INFINITY, DVec2::max);
    let beyond = DVec2::splat(MARGIN * (high - low).length());
    let (low, high) = (low - beyond, high + beyond);
    let at = |u: f64, v: f64| origin + x * u + y * v;
    let corners = vec![at(low.x, low.y), at(low.x, high.y), at(high.x, low.y), at(high.x, high.y)];
    let knots = [[low.x, high.x], [low.y, high.y]].map(|[a, b]| vec![a, a, b, b]);
    NurbsSurface::new([1, 1], knots, [2, 2], corners, Vec::new())
        .map(Shape::Nurbs)
        .map_err(|e| e.to_string())
}

/// A curve over its range; None where it has no length.
pub(super) fn curve(
    geometry: &CurveGeometry,
    range: Option<[f64; 2]>,
) -> Read<Option<(Curve, [f64; 2])>> {
    let solved = match geometry {
        CurveGeometry::Solved(solved) | CurveGeometry::Procedural { cache: Some(solved), .. } => {
            solved
        }
        CurveGeometry::Procedural { .. } => return Err("its curve could not be worked out".into()),
    };
    let curve = match (solved, range) {
        (SolvedCurveGeometry::Degenerate(_), _) => return Ok(None),
        (SolvedCurveGeometry::Nurbs(c), _) => spline_curve(c)?,
        (SolvedCurveGeometry::Circle(c), Some(range)) => return arc(c, range).map(Some),
        (SolvedCurveGeometry::Line(l), Some([a, b])) => {
            let at = |t: f64| point(*l.origin()) + vector(l.direction().as_raw()) * (t * METRES);
            let [a, b] = [reached(at(a))?, reached(at(b))?];
            return Ok(Some((Curve::Nurbs(NurbsCurve::line(a, b)), [0.0, 1.0])));
        }
        _ => return Err("its kind of curve is not known here".into()),
    };
    let domain = curve.domain();
    let [a, b] = range.unwrap_or(domain);
    let inside = [a.max(domain[0]), b.min(domain[1])];
    let size = curve.points.iter().map(|p| p.distance(curve.points[0])).fold(0.0, f64::max);
    if size < NOTHING || inside[0] >= inside[1] {
        return Ok(None);
    }
    Ok(Some((Curve::Nurbs(curve), inside)))
}

fn spline_curve(c: &theirs::NurbsCurve) -> Read<NurbsCurve> {
    let points = c.control_points().iter().map(|p| point(**p)).collect();
    let weights = c.weights().unwrap_or_default().iter().map(|w| w.get()).collect();
    NurbsCurve::new(c.degree() as usize, c.knots().to_vec(), points, weights)
        .map_err(|e| e.to_string())
}

/// A trim as it is drawn in the parameters of its face; None where it is no spline.
pub(super) fn trim(geometry: &PcurveGeometry) -> Option<NurbsCurve> {
    let PcurveGeometry::Nurbs { nurbs } = geometry else { return None };
    let flat = |p: &FinitePoint2| DVec3::new(p.get().u, p.get().v, 0.0);
    let points = nurbs.control_points().iter().map(flat).collect();
    let weights = nurbs.weights().unwrap_or_default().iter().map(|w| w.get()).collect();
    NurbsCurve::new(nurbs.degree() as usize, nurbs.knots().to_vec(), points, weights).ok()
}

/// An arc between two angles as a rational spline of degree 2, a piece for each quarter begun.
fn arc(c: &CircleCurve, [from, to]: [f64; 2]) -> Read<(Curve, [f64; 2])> {
    let (centre, radius) = (point(*c.center()), c.radius().get() * METRES);
    let x = vector(c.frame().reference().as_raw());
    let y = vector(c.frame().axis().as_raw()).cross(x);
    let pieces = ((to - from) / FRAC_PI_2 - 1e-9).ceil().clamp(1.0, 64.0) as usize;
    let step = (to - from) / pieces as f64;
    let at = |angle: f64, r: f64| centre + (x * trig::cos(angle) + y * trig::sin(angle)) * r;
    let middle = trig::cos(0.5 * step);
    let (mut points, mut weights) = (vec![at(from, radius)], vec![1.0]);
    let mut knots = vec![0.0; 3];
    for k in 0..pieces {
        let start = from + step * k as f64;
        points.extend([at(start + 0.5 * step, radius / middle), at(start + step, radius)]);
        weights.extend([middle, 1.0]);
        knots.extend([(k + 1) as f64; 2]);
    }
    knots.push(pieces as f64);
    let arc = NurbsCurve::new(2, knots, points, weights).map_err(|e| e.to_string())?;
    let range = arc.domain();
    Ok((Curve::Nurbs(arc), range))
}
