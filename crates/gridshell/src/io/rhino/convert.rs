//! The decoder's surfaces as ours: millimetres become metres.

use crate::surface::Shape;
use crate::surface::nurbs::{self, NurbsSurface};
use cadmpeg_ir::geometry::analytic::PlaneSurface;
use cadmpeg_ir::geometry::nurbs as theirs;
use cadmpeg_ir::geometry::{SolvedSurfaceGeometry, SurfaceGeometry};
use cadmpeg_ir::math::{Point3, Vector3};
use glam::{DVec2, DVec3};

/// The decoder's unit, millimetres, in metres.
pub(super) const METRES: f64 = 0.001;
/// A plane reaches beyond the loops on it by this share of their size.
const MARGIN: f64 = 0.05;

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

pub(super) fn vector(v: &Vector3) -> DVec3 {
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
    let corners = [at(low.x, low.y), at(low.x, high.y), at(high.x, low.y), at(high.x, high.y)];
    let knots = [[low.x, high.x], [low.y, high.y]].map(|[a, b]| vec![a, a, b, b]);
    bilinear(corners, knots)
}

/// A plane to its corners, as the table of objects gives them, in metres.
pub(super) fn bounded(corners: [DVec3; 4]) -> Read<Shape> {
    bilinear(corners, [(); 2].map(|()| vec![0.0, 0.0, 1.0, 1.0]))
}

fn bilinear(corners: [DVec3; 4], knots: [Vec<f64>; 2]) -> Read<Shape> {
    let corners = corners.to_vec();
    NurbsSurface::new([1, 1], knots, [2, 2], corners, Vec::new())
        .map(Shape::Nurbs)
        .map_err(|e| e.to_string())
}
