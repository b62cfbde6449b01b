//! The exact shape under a STEP face.
//!
//! `step-io` gives rational B-splines for everything that is one. Offsets of anything else are built from their
//! basis and distance; the basis of an offset of an extrusion has no end of its own, and is made as long as the
//! face's edges need.

use super::place::{placed, plain};
use crate::surface::nurbs::NurbsSurface;
use crate::surface::{OffsetSurface, Shape};
use glam::{DMat4, DVec3};
use step_io::StepModel;
use step_io::model::{
    CartesianPointRef, CurveRef, DirectionRef, PartialEntity, SurfaceOfLinearExtrusion, VectorRef,
};
use step_io::scene::{Face, Surface, SurfaceKind};

/// Offsets of offsets are followed this far.
const MOST_OFFSETS: usize = 8;

/// The shape of a face whose edges have the control points `points`, metres.
pub(super) fn of_face(
    model: &StepModel,
    face: &Face,
    place: DMat4,
    points: &[DVec3],
) -> Result<Shape, String> {
    if let Some(whole) = face.to_nurbs() {
        return spline(whole, place).map(Shape::Nurbs);
    }
    let mut surface = face.surface();
    let mut distance = 0.0;
    for _ in 0..MOST_OFFSETS {
        let (SurfaceKind::Offset(o), Some(basis)) = (surface.kind(), surface.basis_surface())
        else {
            break;
        };
        distance += o.distance;
        surface = basis;
    }
    if !matches!(face.surface().kind(), SurfaceKind::Offset(_)) {
        return Err(format!("its surface, {}, has no exact form here", kind(&surface)));
    }
    let basis = match (surface.to_nurbs(), surface.kind()) {
        (Some(whole), _) => spline(whole, place)?,
        (None, SurfaceKind::LinearExtrusion(s)) => extruded(model, s, place, points)?,
        _ => return Err(format!("an offset of {} has no exact form here", kind(&surface))),
    };
    // Placements scale the same along all axes; one that mirrors turns du x dv round.
    let distance = distance * place.x_axis.length() * place.determinant().signum();
    if !distance.is_finite() {
        return Err("its offset has no length".into());
    }
    Ok(Shape::Offset(Box::new(OffsetSurface::new(basis, distance))))
}

fn spline(s: step_io::scene::NurbsSurface, place: DMat4) -> Result<NurbsSurface, String> {
    let count = [s.control_points.len(), s.control_points.first().map_or(0, Vec::len)];
    NurbsSurface::new(
        [s.degree_u, s.degree_v],
        [s.knots_u, s.knots_v],
        count,
        placed(s.control_points.iter().flatten(), place)?,
        plain(s.weights.into_iter().flatten().collect()),
    )
    .map_err(|e| e.to_string())
}

/// What people call the surface.
fn kind(surface: &Surface) -> &'static str {
    match surface.kind() {
        SurfaceKind::Plane(_) => "a plane",
        SurfaceKind::Cylindrical(_) => "a cylinder",
        SurfaceKind::Conical(_) => "a cone",
        SurfaceKind::Spherical(_) => "a sphere",
        SurfaceKind::Toroidal(_) | SurfaceKind::DegenerateToroidal(_) => "a torus",
        SurfaceKind::Offset(_) => "an offset of many offsets",
        SurfaceKind::LinearExtrusion(_) => "an extrusion",
        SurfaceKind::Revolution(_) => "a surface of revolution",
        SurfaceKind::BSpline(_)
        | SurfaceKind::BSplineWithKnots(_)
        | SurfaceKind::QuasiUniform(_)
        | SurfaceKind::Uniform(_)
        | SurfaceKind::Bezier(_) => "a B-spline surface",
        SurfaceKind::Other(name) => name,
        _ => "of an unknown kind",
    }
}

/// An extrusion of a B-spline as long as the points need.
fn extruded(
    model: &StepModel,
    s: &SurfaceOfLinearExtrusion,
    place: DMat4,
    points: &[DVec3],
) -> Result<NurbsSurface, String> {
    let profile = profile(model, &s.swept_curve, place)?;
    let VectorRef::Vector(id) = &s.extrusion_axis else {
        return Err("an extrusion has no direction".into());
    };
    let DirectionRef::Direction(id) = &model[*id].orientation else {
        return Err("an extrusion has no direction".into());
    };
    let way = model[*id].direction_ratios.iter().copied();
    let way: Vec<f64> = way.chain([0.0; 3]).take(3).collect();
    let way = place.transform_vector3(DVec3::new(way[0], way[1], way[2])).normalize_or_zero();
    let span = |points: &[DVec3]| {
        let along = points.iter().map(|p| p.dot(way));
        along.fold((f64::MAX, f64::MIN), |(lo, hi), t| (lo.min(t), hi.max(t)))
    };
    let ((lo, hi), (first, last)) = (span(points), span(&profile.points));
    let (lo, hi) = (lo - last, hi - first);
    if way == DVec3::ZERO || lo >= hi {
        return Err("an extrusion has no direction, or its face no boundary".into());
    }
    let ruled = profile.points.iter().flat_map(|&p| [p + way * lo, p + way * hi]);
    let weights = profile.weights.iter().flat_map(|&w| [w, w]).collect();
    NurbsSurface::new(
        [profile.degree, 1],
        [profile.knots, vec![lo, lo, hi, hi]],
        [profile.points.len(), 2],
        ruled.collect(),
        plain(weights),
    )
    .map_err(|e| e.to_string())
}

/// A B-spline curve as the file has it.
struct Profile {
    degree: usize,
    knots: Vec<f64>,
    points: Vec<DVec3>,
    weights: Vec<f64>,
}

/// The curve that an extrusion sweeps, where it is a B-spline with knots.
fn profile(model: &StepModel, curve: &CurveRef, place: DMat4) -> Result<Profile, String> {
    let other = "an offset of an extrusion of what is no B-spline has no exact form here";
    let mut weights = None;
    let (degree, points, knots, times) = match curve {
        CurveRef::BSplineCurveWithKnots(id) => {
            let c = &model[*id];
            (c.degree, &c.control_points_list, &c.knots, &c.knot_multiplicities)
        }
        CurveRef::Complex(id) => {
            let (mut spline, mut knotted) = (None, None);
            for part in &model[*id].parts {
                match part {
                    PartialEntity::BSplineCurve { degree, control_points_list, .. } => {
                        spline = Some((*degree, control_points_list));
                    }
                    PartialEntity::BSplineCurveWithKnots { knots, knot_multiplicities, .. } => {
                        knotted = Some((knots, knot_multiplicities));
                    }
                    PartialEntity::RationalBSplineCurve { weights_data } => {
                        weights = Some(weights_data.clone());
                    }
                    _ => {}
                }
            }
            let ((degree, points), (knots, times)) = spline.zip(knotted).ok_or(other)?;
            (degree, points, knots, times)
        }
        _ => return Err(other.into()),
    };
    let xyz = points.iter().map(|p| {
        let CartesianPointRef::CartesianPoint(id) = p else { return None };
        let c = model[*id].coordinates.iter().copied();
        let c: Vec<f64> = c.chain([0.0; 3]).take(3).collect();
        Some([c[0], c[1], c[2]])
    });
    let xyz: Vec<[f64; 3]> = xyz.collect::<Option<_>>().ok_or(other)?;
    let points = placed(xyz.iter(), place)?;
    let degree = usize::try_from(degree).map_err(|_| "a degree below 0".to_owned())?;
    let wanted = points.len().saturating_add(degree).saturating_add(1);
    let total = times.iter().try_fold(0_usize, |n, &m| n.checked_add(usize::try_from(m).ok()?));
    if total != Some(wanted) || times.len() != knots.len() {
        return Err("the knots of a B-spline do not fit its points".into());
    }
    let each = knots.iter().zip(times);
    let knots = each.flat_map(|(&k, &m)| std::iter::repeat_n(k, m as usize)).collect();
    let weights = weights.unwrap_or_else(|| vec![1.0; points.len()]);
    Ok(Profile { degree, knots, points, weights })
}
