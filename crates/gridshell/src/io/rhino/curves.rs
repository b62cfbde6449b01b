//! The decoder's curves as exact splines in metres.

use super::convert::{METRES, Read, point, reached, vector};
use crate::io::bezier::{self, Piece};
use crate::math::trig;
use crate::surface::Curve;
use crate::surface::nurbs::NurbsCurve;
use cadmpeg_ir::document::Model as Arenas;
use cadmpeg_ir::geometry::analytic::CircleCurve;
use cadmpeg_ir::geometry::nurbs as theirs;
use cadmpeg_ir::geometry::pcurve::PcurveGeometry;
use cadmpeg_ir::geometry::{
    CompoundCurveConstruction, CurveGeometry, ProceduralCurveDefinition, SolvedCurveGeometry,
};
use cadmpeg_ir::math::Vector3;
use cadmpeg_ir::units::{FinitePoint2, OrthonormalFrame3};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Shorter edges than this share of a metre mark poles.
const NOTHING: f64 = 1e-12;
/// Curves of curves nested deeper than this contain themselves.
const MOST_LEVELS: usize = 32;
/// Pieces of one curve beyond this are nobody's work.
const MOST_PIECES: usize = 100_000;

/// A spline and the part of it that is meant.
type Part = (NurbsCurve, [f64; 2]);

/// A curve over its range; None where it has no length.
pub(super) fn curve(
    arenas: &Arenas,
    geometry: &CurveGeometry,
    range: Option<[f64; 2]>,
) -> Read<Option<(Curve, [f64; 2])>> {
    let Some((curve, range)) = part(arenas, geometry, range, 0)? else { return Ok(None) };
    let size = curve.points.iter().map(|p| p.distance(curve.points[0])).fold(0.0, f64::max);
    let nothing = size < NOTHING || range[0] >= range[1];
    Ok((!nothing).then_some((Curve::Nurbs(curve), range)))
}

fn part(
    arenas: &Arenas,
    geometry: &CurveGeometry,
    range: Option<[f64; 2]>,
    level: usize,
) -> Read<Option<Part>> {
    if level > MOST_LEVELS {
        return Err("its curve contains itself".into());
    }
    if let Some(id) = geometry.procedural_construction() {
        let known = arenas.procedural_curves.binary_search_by(|c| c.id.as_str().cmp(id.as_str()));
        let definition = known.ok().map(|k| arenas.procedural_curves[k].definition());
        if let Some(ProceduralCurveDefinition::Compound(compound)) = definition {
            return joined(arenas, compound, range, level).map(Some);
        }
    }
    let solved = match geometry {
        CurveGeometry::Solved(solved) | CurveGeometry::Procedural { cache: Some(solved), .. } => {
            solved
        }
        CurveGeometry::Procedural { .. } => return Err("its curve could not be worked out".into()),
    };
    match solved {
        SolvedCurveGeometry::Degenerate(_) => Ok(None),
        SolvedCurveGeometry::Nurbs(c) => {
            let curve = spline(c)?;
            let domain = curve.domain();
            let [a, b] = range.unwrap_or(domain);
            Ok(Some((curve, [a.max(domain[0]), b.min(domain[1])])))
        }
        SolvedCurveGeometry::Circle(c) => circle(c, range.unwrap_or([0.0, TAU])).map(Some),
        SolvedCurveGeometry::Ellipse(c) => {
            let radii = [c.major_radius(), c.minor_radius()].map(|r| r.get() * METRES);
            arc(point(c.center().get()), axes(c.frame()), radii, range.unwrap_or([0.0, TAU]))
                .map(Some)
        }
        SolvedCurveGeometry::Line(l) => {
            let [a, b] = range.ok_or("its edge is a line without end")?;
            let at = |t: f64| point(*l.origin()) + vector(l.direction().as_raw()) * (t * METRES);
            let line = NurbsCurve::line(reached(at(a))?, reached(at(b))?);
            Ok(Some((line, [0.0, 1.0])))
        }
        SolvedCurveGeometry::Polyline(c) => {
            polyline(c.points().map(|p| point(p.get())).collect()).map(Some)
        }
        SolvedCurveGeometry::Transformed(placed) => {
            let basis = CurveGeometry::Solved(placed.basis().clone());
            let Some((curve, range)) = part(arenas, &basis, range, level + 1)? else {
                return Ok(None);
            };
            let rows = placed.transform().rows();
            let place = |p: &DVec3| {
                let [x, y, z, _] =
                    rows.map(|[a, b, c, d]| a * p.x + b * p.y + c * p.z + d * METRES);
                DVec3::new(x, y, z)
            };
            let points = curve.points.iter().map(place).collect();
            NurbsCurve::new(curve.degree, curve.knots, points, curve.weights)
                .map(|curve| Some((curve, range)))
                .map_err(|e| e.to_string())
        }
        _ => Err("its kind of curve is not known here".into()),
    }
}

/// Curves one after the other as one, each over its stretch of the whole parameter.
fn joined(
    arenas: &Arenas,
    compound: &CompoundCurveConstruction,
    range: Option<[f64; 2]>,
    level: usize,
) -> Read<Part> {
    let knots: Vec<f64> = compound.parameters().iter().map(|t| t.get()).collect();
    let mut pieces: Vec<Piece> = Vec::new();
    for (k, child) in compound.components().iter().enumerate() {
        let id = child.component.as_str();
        let at = arenas.curves.binary_search_by(|c| c.id.as_str().cmp(id));
        let geometry = &arenas.curves[at.map_err(|_| "a piece of its curve is missing")?].geometry;
        let Some((curve, [a, b])) = part(arenas, geometry, None, level + 1)? else { continue };
        let stretch = knots.get(k).zip(knots.get(k + 1)).map(|(&from, &to)| [from, to]);
        let Some([from, to]) = stretch.filter(|[from, to]| from < to && a < b) else {
            return Err("the pieces of its curve are out of order".into());
        };
        // What is the same number has to stay the same.
        let place = |t: f64| {
            if t == a {
                from
            } else if t == b {
                to
            } else {
                from + (to - from) * ((t - a) / (b - a))
            }
        };
        for piece in bezier::pieces(&curve, [a, b]) {
            pieces.push(Piece { range: piece.range.map(place), points: piece.points });
        }
        if pieces.len() > MOST_PIECES {
            return Err("its curve has too many pieces".into());
        }
    }
    if pieces.is_empty() {
        return Err("its curve has no pieces".into());
    }
    let curve = bezier::joined(&pieces).map_err(|e| e.to_string())?;
    let domain = curve.domain();
    let [a, b] = range.unwrap_or(domain);
    Ok((curve, [a.max(domain[0]), b.min(domain[1])]))
}

fn spline(c: &theirs::NurbsCurve) -> Read<NurbsCurve> {
    let points = c.control_points().iter().map(|p| point(**p)).collect();
    let weights = c.weights().unwrap_or_default().iter().map(|w| w.get()).collect();
    NurbsCurve::new(c.degree() as usize, c.knots().to_vec(), points, weights)
        .map_err(|e| e.to_string())
}

/// A trim as it is drawn in the parameters of its face; None where it is not a spline.
pub(super) fn trim(geometry: &PcurveGeometry) -> Option<NurbsCurve> {
    let PcurveGeometry::Nurbs { nurbs } = geometry else { return None };
    let flat = |p: &FinitePoint2| DVec3::new(p.get().u, p.get().v, 0.0);
    let points = nurbs.control_points().iter().map(flat).collect();
    let weights = nurbs.weights().unwrap_or_default().iter().map(|w| w.get()).collect();
    NurbsCurve::new(nurbs.degree() as usize, nurbs.knots().to_vec(), points, weights).ok()
}

fn polyline(points: Vec<DVec3>) -> Read<Part> {
    let last = points.len().saturating_sub(1) as f64;
    let mut knots: Vec<f64> = (0..points.len()).map(|k| k as f64).collect();
    knots.insert(0, 0.0);
    knots.push(last);
    let curve = NurbsCurve::new(1, knots, points, Vec::new()).map_err(|e| e.to_string())?;
    Ok((curve, [0.0, last]))
}

fn axes(frame: &OrthonormalFrame3) -> [DVec3; 2] {
    let raw = |v: &Vector3| vector(v);
    let x = raw(frame.reference().as_raw());
    [x, raw(frame.axis().as_raw()).cross(x)]
}

fn circle(c: &CircleCurve, range: [f64; 2]) -> Read<Part> {
    arc(point(*c.center()), axes(c.frame()), [c.radius().get() * METRES; 2], range)
}

/// An arc between two angles, of an ellipse along two axes at right angles, as a rational spline of degree 2: a piece
/// for each quarter begun.
fn arc(centre: DVec3, [x, y]: [DVec3; 2], radii: [f64; 2], [from, to]: [f64; 2]) -> Read<Part> {
    let pieces = ((to - from) / FRAC_PI_2 - 1e-9).ceil().clamp(1.0, 64.0) as usize;
    let step = (to - from) / pieces as f64;
    let at = |angle: f64, r: f64| {
        centre + (x * (trig::cos(angle) * radii[0]) + y * (trig::sin(angle) * radii[1])) * r
    };
    let middle = trig::cos(0.5 * step);
    let (mut points, mut weights) = (vec![at(from, 1.0)], vec![1.0]);
    let mut knots = vec![0.0; 3];
    for k in 0..pieces {
        let start = from + step * k as f64;
        points.extend([at(start + 0.5 * step, 1.0 / middle), at(start + step, 1.0)]);
        weights.extend([middle, 1.0]);
        knots.extend([(k + 1) as f64; 2]);
    }
    knots.push(pieces as f64);
    let arc = NurbsCurve::new(2, knots, points, weights).map_err(|e| e.to_string())?;
    let range = arc.domain();
    Ok((arc, range))
}
