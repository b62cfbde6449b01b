//! Surfaces outside any shell, in sets (`GEOMETRIC_SET`), made faces of a shell: whole ones, and those between curves
//! (`CURVE_BOUNDED_SURFACE`), whose curves become edges.

use super::text::{Draft, Record, Text, list_of, mentions, number, references, triple};
use glam::DVec3;

/// Surfaces that end by themselves, or are told to have no end.
const SURFACES: [&str; 9] = [
    "B_SPLINE_SURFACE_WITH_KNOTS",
    "BEZIER_SURFACE",
    "QUASI_UNIFORM_SURFACE",
    "UNIFORM_SURFACE",
    "SPHERICAL_SURFACE",
    "TOROIDAL_SURFACE",
    "SURFACE_OF_REVOLUTION",
    "SURFACE_OF_LINEAR_EXTRUSION",
    "OFFSET_SURFACE",
];
/// Curves whose second parameter is the curve in space.
const ON_SURFACES: [&[u8]; 4] =
    [b"SURFACE_CURVE", b"INTERSECTION_CURVE", b"SEAM_CURVE", b"BOUNDED_SURFACE_CURVE"];
/// Curves whose third parameter is a list of control points.
const SPLINES: [&[u8]; 4] =
    [b"B_SPLINE_CURVE_WITH_KNOTS", b"BEZIER_CURVE", b"QUASI_UNIFORM_CURVE", b"UNIFORM_CURVE"];
/// Curves of curves are followed this far, and no further; nor are more of them, in one boundary.
const MOST_LEVELS: usize = 8;
const MOST_CURVES: usize = 10_000;

/// The text with such surfaces as faces; None where there are none.
pub(super) fn mended(text: &Text) -> Option<Vec<u8>> {
    let mut draft = Draft::of(text);
    for set in text.records.iter().filter(|r| text.keyword(r) == b"GEOMETRIC_SET") {
        let list = text.list(set);
        let Some(elements) = list.get(1) else { continue };
        let elements = references(text, elements);
        let faces: Vec<u64> = elements.into_iter().filter_map(|id| face(&mut draft, id)).collect();
        if !faces.is_empty() {
            let shell = draft.add(&format!("OPEN_SHELL('',{})", list_of(&faces)));
            draft.replace(set, format!("SHELL_BASED_SURFACE_MODEL('',(#{shell}))"));
        }
    }
    draft.done()
}

/// The face of a surface; None for what is none, or has curves that are not known here.
fn face(draft: &mut Draft, id: u64) -> Option<u64> {
    let text = draft.text;
    let record = text.get(id)?;
    let keyword = text.keyword(record);
    if keyword == b"CURVE_BOUNDED_SURFACE" {
        return bounded(draft, record);
    }
    let known = SURFACES.iter().any(|s| keyword == s.as_bytes());
    let spline = text.part(record, "B_SPLINE_SURFACE").is_some();
    (known || spline).then(|| draft.add(&format!("ADVANCED_FACE('',(),#{id},.T.)")))
}

/// The face of a surface between curves. Where its own sides count too, it may have no other.
fn bounded(draft: &mut Draft, record: &Record) -> Option<u64> {
    let text = draft.text;
    let list = text.list(record);
    let basis = text.target(record, 1)?.id;
    let curves = references(text, list.get(2)?);
    if text.words(list.get(3)?) == b".T." && !curves.is_empty() {
        return None;
    }
    let mut bounds = Vec::new();
    for curve in curves {
        let mut path = Path { pieces: Vec::new(), curves: 0 };
        path.add(text, text.get(curve)?, true, MOST_LEVELS)?;
        let edges = edges(draft, &path.pieces);
        let ring = draft.add(&format!("EDGE_LOOP('',{})", list_of(&edges)));
        bounds.push(draft.add(&format!("FACE_BOUND('',#{ring},.T.)")));
    }
    Some(draft.add(&format!("ADVANCED_FACE('',{},#{basis},.T.)", list_of(&bounds))))
}

/// A curve between its ends, and whether it is run from the first to the second.
struct Piece {
    curve: u64,
    ends: [DVec3; 2],
    forward: bool,
}

/// Pieces one after the other, and the curves that were looked at for them.
struct Path {
    pieces: Vec<Piece>,
    curves: usize,
}

impl Path {
    /// Add the pieces of a curve, those of composite ones one by one.
    fn add(&mut self, text: &Text, record: &Record, forward: bool, levels: usize) -> Option<()> {
        self.curves += 1;
        let levels = levels.checked_sub(1).filter(|_| self.curves <= MOST_CURVES)?;
        let list = text.list(record);
        let composite = text.keyword(record).starts_with(b"COMPOSITE_CURVE")
            || text.keyword(record).ends_with(b"BOUNDARY_CURVE");
        if !composite {
            let ends = ends(text, record, levels)?;
            self.pieces.push(Piece { curve: record.id, ends, forward });
            return Some(());
        }
        let mut segments = references(text, list.get(1)?);
        if !forward {
            segments.reverse();
        }
        for id in segments {
            let segment = text.get(id)?;
            let with = text.words(text.list(segment).get(1)?) != b".F.";
            self.add(text, text.target(segment, 2)?, forward == with, levels)?;
        }
        Some(())
    }
}

/// Edges along the pieces, with a vertex where one ends and the next begins.
fn edges(draft: &mut Draft, pieces: &[Piece]) -> Vec<u64> {
    let last = pieces.len().wrapping_sub(1);
    let vertices: Vec<u64> = pieces
        .iter()
        .map(|piece| {
            let end = piece.ends[usize::from(piece.forward)];
            let point = draft.add(&triple("CARTESIAN_POINT", end.to_array()));
            draft.add(&format!("VERTEX_POINT('',#{point})"))
        })
        .collect();
    let mut edges = Vec::new();
    for (k, piece) in pieces.iter().enumerate() {
        let (a, b) = (vertices[if k == 0 { last } else { k - 1 }], vertices[k]);
        let ([a, b], way) = if piece.forward { ([a, b], "T") } else { ([b, a], "F") };
        let edge = draft.add(&format!("EDGE_CURVE('',#{a},#{b},#{},.T.)", piece.curve));
        edges.push(draft.add(&format!("ORIENTED_EDGE('',*,*,#{edge},.{way}.)")));
    }
    edges
}

/// Where a curve begins and ends.
fn ends(text: &Text, record: &Record, levels: usize) -> Option<[DVec3; 2]> {
    let levels = levels.checked_sub(1)?;
    let list = text.list(record);
    let keyword = text.keyword(record);
    let of_points = |points: Vec<u64>| {
        let at = |id: &u64| text.xyz(text.get(*id)?).map(DVec3::from);
        Some([at(points.first()?)?, at(points.last()?)?])
    };
    if ON_SURFACES.contains(&keyword) {
        return ends(text, text.target(record, 1)?, levels);
    }
    match keyword {
        b"POLYLINE" => of_points(references(text, list.get(1)?)),
        b"TRIMMED_CURVE" => {
            let end = |k: usize| trim(text, text.target(record, 1)?, text.words(list.get(k)?));
            Some([end(2)?, end(3)?])
        }
        b"CIRCLE" | b"ELLIPSE" => {
            let place = text.target(record, 1)?;
            let way = |k: usize| Some(DVec3::from(text.xyz(text.target(place, k)?)?));
            let z = way(2).unwrap_or(DVec3::Z).normalize_or_zero();
            let x = way(3).unwrap_or(DVec3::X).reject_from_normalized(z).normalize_or_zero();
            let start = way(1)? + x * number(text.words(list.get(2)?))?;
            Some([start; 2])
        }
        _ if SPLINES.contains(&keyword) => of_points(references(text, list.get(2)?)),
        _ => of_points(references(text, text.part(record, "B_SPLINE_CURVE")?.get(1)?)),
    }
}

/// The end of a trimmed curve: a point, or a parameter of a line.
fn trim(text: &Text, basis: &Record, words: &[u8]) -> Option<DVec3> {
    let point = mentions(words).find_map(|id| text.xyz(text.get(id)?));
    if let Some(point) = point {
        return Some(point.into());
    }
    let from = words.iter().rposition(|&b| b == b'(')? + 1;
    let to = from + words[from..].iter().position(|&b| b == b')')?;
    let t = number(words[from..to].trim_ascii())?;
    let (start, vector) = (text.target(basis, 1)?, text.target(basis, 2)?);
    let length = number(text.words(text.list(vector).get(2)?))?;
    let way = DVec3::from(text.xyz(text.target(vector, 1)?)?);
    (text.keyword(basis) == b"LINE")
        .then(|| Some(DVec3::from(text.xyz(start)?) + way.normalize_or_zero() * (length * t)))?
}
