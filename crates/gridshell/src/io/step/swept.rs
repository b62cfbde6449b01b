//! Swept curves that have no end, or meet the axis that they turn about in their middle, cut to what their faces need.
//!
//! Vaults are swept from parabolas and hyperbolas, domes turned from ellipses and parabolas. The parser sweeps pieces
//! of them only; how long a piece must be, the corners and control points of the faces tell.

use super::text::{Draft, Record, Text, list_of, mentions, number, real, references, triple};
use crate::math::trig;
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

/// What lies between a face and the points on its boundary.
const BETWEEN: [&str; 17] = [
    "FACE_BOUND",
    "FACE_OUTER_BOUND",
    "EDGE_LOOP",
    "VERTEX_LOOP",
    "ORIENTED_EDGE",
    "EDGE_CURVE",
    "VERTEX_POINT",
    "SURFACE_CURVE",
    "INTERSECTION_CURVE",
    "SEAM_CURVE",
    "BOUNDED_SURFACE_CURVE",
    "TRIMMED_CURVE",
    "B_SPLINE_CURVE_WITH_KNOTS",
    "BEZIER_CURVE",
    "QUASI_UNIFORM_CURVE",
    "POLYLINE",
    "",
];
/// A piece is longer than its face by this share at each end.
const MARGIN: f64 = 0.02;
/// A conic whose vertex is nearer to the axis than this share of its size has its own axis there.
const ON_AXIS: f64 = 1e-9;

/// The text with such curves trimmed; None where there are none.
pub(super) fn mended(text: &Text) -> Option<Vec<u8>> {
    if !text.has(&["SURFACE_OF_REVOLUTION", "SURFACE_OF_LINEAR_EXTRUSION"]) {
        return None;
    }
    let mut draft = Draft::of(text);
    let uses = Uses::of(text);
    for surface in &text.records {
        let turned = text.keyword(surface) == b"SURFACE_OF_REVOLUTION";
        if !turned && text.keyword(surface) != b"SURFACE_OF_LINEAR_EXTRUSION" {
            continue;
        }
        let Some((curve, conic, ends)) = piece(text, &uses, surface, turned) else { continue };
        let trimmed = if turned {
            let mut end = |t: f64| draft.add(&triple("CARTESIAN_POINT", conic.point(t).to_array()));
            let [a, b] = ends.map(&mut end);
            draft.add(&format!("TRIMMED_CURVE('',#{curve},(#{a}),(#{b}),.T.,.CARTESIAN.)"))
        } else {
            spline(&mut draft, &conic, ends)
        };
        draft.put(text.list(surface)[1].clone(), format!("#{trimmed}"));
    }
    draft.done()
}

/// A conic section in its plane.
struct Conic {
    kind: Kind,
    /// Half axes; of a parabola twice its focal length.
    half: [f64; 2],
    centre: DVec3,
    x: DVec3,
    y: DVec3,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Ellipse,
    Parabola,
    Hyperbola,
}

impl Conic {
    fn of(text: &Text, record: &Record) -> Option<Conic> {
        let list = text.list(record);
        let length = |k: usize| number(text.words(list.get(k)?)).filter(|&x| x > 0.0);
        let (kind, half) = match text.keyword(record) {
            b"CIRCLE" => (Kind::Ellipse, [length(2)?; 2]),
            b"ELLIPSE" => (Kind::Ellipse, [length(2)?, length(3)?]),
            b"PARABOLA" => (Kind::Parabola, [2.0 * length(2)?; 2]),
            b"HYPERBOLA" => (Kind::Hyperbola, [length(2)?, length(3)?]),
            _ => return None,
        };
        let place = text.target(record, 1)?;
        let way = |k: usize| Some(DVec3::from(text.xyz(text.target(place, k)?)?));
        let z = way(2).unwrap_or(DVec3::Z).try_normalize()?;
        let x = way(3).unwrap_or(DVec3::X).reject_from_normalized(z).try_normalize()?;
        Some(Conic { kind, half, centre: way(1)?, x, y: z.cross(x) })
    }

    fn flat(&self, p: DVec3) -> [f64; 2] {
        [(p - self.centre).dot(self.x), (p - self.centre).dot(self.y)]
    }

    /// The parameter of a point near to it: an angle, or what grows along y.
    fn parameter(&self, p: DVec3) -> f64 {
        let [x, y] = self.flat(p);
        match self.kind {
            Kind::Ellipse => trig::atan2(y / self.half[1], x / self.half[0]).rem_euclid(TAU),
            Kind::Parabola | Kind::Hyperbola => y / self.half[1],
        }
    }

    fn point(&self, t: f64) -> DVec3 {
        let [a, b] = self.half;
        let (x, y) = match self.kind {
            Kind::Ellipse => (a * trig::cos(t), b * trig::sin(t)),
            Kind::Parabola => (0.5 * a * t * t, a * t),
            Kind::Hyperbola => (a * (1.0 + t * t).sqrt(), b * t),
        };
        self.centre + self.x * x + self.y * y
    }

    /// Where its tangents at two parameters meet, and the weight of that place between two of weight 1.
    fn pull(&self, s: f64, t: f64) -> (DVec3, f64) {
        let [a, b] = self.half;
        let (x, y, weight) = match self.kind {
            Kind::Ellipse => {
                let (middle, half) = (0.5 * (s + t), trig::cos(0.5 * (t - s)));
                (a * trig::cos(middle) / half, b * trig::sin(middle) / half, half)
            }
            Kind::Parabola => (0.5 * a * s * t, 0.5 * a * (s + t), 1.0),
            // With s and t as sinh of the usual parameters: cosh of half their difference.
            Kind::Hyperbola => {
                let (p, q) = ((1.0 + s * s).sqrt(), (1.0 + t * t).sqrt());
                let weight = (0.5 * (1.0 + p * q - s * t)).sqrt();
                (
                    a * 0.5 * (p + q) / (weight * weight),
                    b * 0.5 * (s + t) / (weight * weight),
                    weight,
                )
            }
        };
        (self.centre + self.x * x + self.y * y, weight)
    }

    /// How far a point is from it, about.
    fn off(&self, p: DVec3) -> f64 {
        self.point(self.parameter(p)).distance(p)
    }
}

/// The curve that a surface sweeps, and the ends of the piece of it that is needed; None where all of it is.
fn piece(
    text: &Text,
    uses: &Uses,
    surface: &Record,
    turned: bool,
) -> Option<(u64, Conic, [f64; 2])> {
    let curve = text.target(surface, 1)?;
    let conic = Conic::of(text, curve)?;
    if conic.kind == Kind::Ellipse && !turned {
        // Only offsets of it want it in another form.
        let offset = uses.offsets.contains_key(&surface.id);
        return offset.then_some((curve.id, conic, [0.0, TAU]));
    }
    let sweep = text.target(surface, 2)?;
    let rim = uses.rim(text, surface.id);
    let way = |k: usize| Some(DVec3::from(text.xyz(text.target(sweep, k)?)?));
    let ends = if turned {
        let (at, axis) = (way(1)?, way(2).unwrap_or(DVec3::Z).try_normalize()?);
        turned_piece(&conic, at, axis, &rim)?
    } else {
        let (normal, way) = (conic.x.cross(conic.y), way(1)?.try_normalize()?);
        let steep = normal.dot(way);
        if steep.abs() < 1e-6 {
            return None;
        }
        let foot = |p: &DVec3| *p - way * ((*p - conic.centre).dot(normal) / steep);
        wide(rim.iter().map(|p| conic.parameter(foot(p))))?
    };
    Some((curve.id, conic, ends))
}

/// A piece of a conic as a rational spline of degree 2: a whole ellipse in quarters, the others in one piece.
fn spline(draft: &mut Draft, conic: &Conic, [s, t]: [f64; 2]) -> u64 {
    let pieces = if conic.kind == Kind::Ellipse { 4 } else { 1 };
    let (mut points, mut weights) = (vec![conic.point(s)], vec![1.0]);
    for k in 0..pieces {
        let at = |k: usize| s + (t - s) * k as f64 / pieces as f64;
        let (middle, weight) = conic.pull(at(k), at(k + 1));
        points.extend([middle, conic.point(at(k + 1))]);
        weights.extend([weight, 1.0]);
    }
    let ids: Vec<u64> =
        points.iter().map(|p| draft.add(&triple("CARTESIAN_POINT", p.to_array()))).collect();
    let join = |words: Vec<String>| words.join(",");
    let times =
        join((0..=pieces).map(|k| if k % pieces == 0 { "3" } else { "2" }.to_owned()).collect());
    let knots = join((0..=pieces).map(|k| format!("{k}.")).collect());
    let weights = join(weights.into_iter().map(real).collect());
    draft.add(&format!(
        "(BOUNDED_CURVE()B_SPLINE_CURVE(2,{},.UNSPECIFIED.,.F.,.F.)B_SPLINE_CURVE_WITH_KNOTS(({times}),({knots}),\
         .UNSPECIFIED.)CURVE()GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE(({weights}))\
         REPRESENTATION_ITEM(''))",
        list_of(&ids)
    ))
}

/// The piece of a curve that is turned about an axis in its plane.
fn turned_piece(conic: &Conic, at: DVec3, axis: DVec3, rim: &[DVec3]) -> Option<[f64; 2]> {
    let out = conic.x.cross(conic.y).cross(axis).try_normalize()?;
    // Every point has two images in the plane of the curve, one on each side of the axis.
    let images = |p: &DVec3| {
        let along = (*p - at).dot(axis);
        let foot = at + axis * along;
        let rho = p.distance(foot);
        [foot + out * rho, foot - out * rho]
    };
    if conic.kind == Kind::Ellipse {
        let [s, t] = crossings(conic, at, axis)?;
        let near = |p: &DVec3| {
            let [a, b] = images(p);
            conic.parameter(if conic.off(a) <= conic.off(b) { a } else { b })
        };
        let inside = rim.iter().map(near).filter(|u| (s..=t).contains(u)).count();
        return Some(if 2 * inside >= rim.len() { [s, t] } else { [t, s + TAU] });
    }
    let size = conic.half[0] + conic.half[1];
    let own_axis = conic.x.cross(axis).length() < ON_AXIS
        && (conic.centre - at).reject_from_normalized(axis).length() < ON_AXIS * size;
    let side = |k: usize| rim.iter().map(|p| conic.off(images(p)[k])).sum::<f64>();
    let k = usize::from(side(1) < side(0));
    let [low, high] = wide(rim.iter().map(|p| conic.parameter(images(p)[k])))?;
    // From the vertex outwards: the other half turns to the same surface.
    Some(if own_axis { [0.0, low.abs().max(high.abs())] } else { [low, high] })
}

/// Where an axis in its plane meets an ellipse.
fn crossings(conic: &Conic, at: DVec3, axis: DVec3) -> Option<[f64; 2]> {
    let [a, b] = conic.half;
    let ([x, y], [dx, dy]) = (conic.flat(at), conic.flat(conic.centre + axis));
    let (x, y, dx, dy) = (x / a, y / b, dx / a, dy / b);
    let (p, q, r) = (dx * dx + dy * dy, x * dx + y * dy, x * x + y * y - 1.0);
    let root = q * q - p * r;
    if root <= ON_AXIS * p {
        return None;
    }
    let angle = |t: f64| trig::atan2(y + dy * t, x + dx * t).rem_euclid(TAU);
    let (s, t) = (angle((-q - root.sqrt()) / p), angle((-q + root.sqrt()) / p));
    Some([s.min(t), s.max(t)])
}

/// From the least to the most, and a little more.
fn wide(parameters: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let (low, high) =
        parameters.fold((f64::MAX, f64::MIN), |(low, high), t| (low.min(t), high.max(t)));
    let more = MARGIN * (high - low).max(0.01 * (low.abs() + high.abs()));
    (low <= high).then_some([low - more, high + more])
}

/// What lies on surfaces: offsets of them, and faces.
struct Uses {
    offsets: BTreeMap<u64, Vec<u64>>,
    faces: BTreeMap<u64, Vec<u64>>,
}

impl Uses {
    fn of(text: &Text) -> Uses {
        let mut uses = Uses { offsets: BTreeMap::new(), faces: BTreeMap::new() };
        for record in &text.records {
            let (on, k) = match text.keyword(record) {
                b"OFFSET_SURFACE" => (&mut uses.offsets, 1),
                b"ADVANCED_FACE" | b"FACE_SURFACE" => (&mut uses.faces, 2),
                _ => continue,
            };
            if let Some(surface) = text.target(record, k) {
                on.entry(surface.id).or_default().push(record.id);
            }
        }
        uses
    }

    /// Points on the boundary of all faces on a surface, or on offsets of it.
    fn rim(&self, text: &Text, surface: u64) -> Vec<DVec3> {
        let mut seen = BTreeSet::new();
        let (mut on, mut next) = (vec![surface], Vec::new());
        while let Some(id) = on.pop().filter(|id| seen.insert(*id)) {
            on.extend(self.offsets.get(&id).into_iter().flatten());
            for face in self.faces.get(&id).into_iter().flatten().filter_map(|f| text.get(*f)) {
                next.extend(text.list(face).get(1).into_iter().flat_map(|b| references(text, b)));
            }
        }
        let mut points = Vec::new();
        while let Some(id) = next.pop() {
            let Some(record) = text.get(id).filter(|_| seen.insert(id)) else { continue };
            let keyword = text.keyword(record);
            if keyword == b"CARTESIAN_POINT" {
                points.extend(text.xyz(record).map(DVec3::from));
            } else if BETWEEN.iter().any(|b| keyword == b.as_bytes()) {
                next.extend(mentions(text.words(&record.list)));
            }
        }
        points
    }
}
