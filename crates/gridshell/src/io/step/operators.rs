//! Placements that mirror or scale, `CARTESIAN_TRANSFORMATION_OPERATOR_3D`, which the parser does not know.
//!
//! Each is put into words that it does know, a placement with a mark, and kept here beside it (ISO 10303-42: a
//! point P goes to A + S T P, where the axes are the columns of T).

use super::text::{Draft, Record, Text, number, reference, triple};
use glam::{DMat3, DMat4, DVec3};
use std::collections::BTreeMap;
use step_io::scene::{Placement, Transform};

const KEYWORD: &str = "CARTESIAN_TRANSFORMATION_OPERATOR_3D";
/// Length of the z axis of a marked placement, where others have 1; its x axis is as long as its number says.
const MARK: f64 = 73_400_320.5;
/// Axes shorter than this say no direction.
const NO_WAY: f64 = 1e-12;

/// What one operator does.
#[derive(Clone, Copy)]
struct Operator {
    /// As the target of a mapped item.
    mapped: DMat4,
    /// Between a part and the assembly that it is placed in.
    related: DMat4,
}

/// The operators of a file; or why one cannot be used.
#[derive(Default)]
pub(super) struct Operators(Vec<Result<Operator, String>>);

/// The text with marked placements for operators, and these; None where there are none.
pub(super) fn mended(text: &Text) -> Option<(Vec<u8>, Operators)> {
    let mut draft = Draft::of(text);
    let mut operators = Operators::default();
    let occ = written_by_occ(text);
    let mut marks: BTreeMap<u64, u64> = BTreeMap::new();
    for record in &text.records {
        let Some((keyword, list)) = attributes(text, record) else { continue };
        operators.0.push(of_attributes(text, &keyword, &list, occ));
        let origin = draft.add(&triple("CARTESIAN_POINT", [0.0; 3]));
        let axis = draft.add(&triple("DIRECTION", [0.0, 0.0, MARK]));
        let x = draft.add(&triple("DIRECTION", [operators.0.len() as f64, 0.0, 0.0]));
        let marked = format!("AXIS2_PLACEMENT_3D('',#{origin},#{axis},#{x})");
        draft.replace(record, &marked);
        let plain = format!("AXIS2_PLACEMENT_3D('',#{origin},$,$)");
        let plain = draft.add(&plain);
        let item = format!("ITEM_DEFINED_TRANSFORMATION('','',#{plain},#{})", record.id);
        marks.insert(record.id, draft.add(&item));
    }
    if operators.0.is_empty() {
        return None;
    }
    for record in &text.records {
        let part = "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION";
        let Some(list) = text.part(record, part) else { continue };
        let Some(place) = list.first() else { continue };
        let item = reference(text.words(place)).and_then(|id| marks.get(&id));
        if let Some(item) = item {
            draft.put(place.clone(), format!("#{item}"));
        }
    }
    Some((draft.done()?, operators))
}

impl Operators {
    /// Where a part goes in its assembly; None where no placement can be used.
    ///
    /// # Errors
    /// Why an operator is refused.
    pub fn of_part(&self, transform: Option<Transform>) -> Result<Option<DMat4>, &str> {
        let Some(transform) = transform else { return Ok(None) };
        // The two may stand the other way round, with the assembly first.
        if let Some(operator) = self.marked(&transform.to) {
            return operator.map(|o| Some(o.related));
        }
        if let Some(operator) = self.marked(&transform.from) {
            return operator.map(|o| Some(o.related.inverse()));
        }
        Ok(plain(&transform))
    }

    /// Where a mapped item goes; None where no placement can be used.
    ///
    /// # Errors
    /// Why an operator is refused.
    pub fn of_mapped(&self, transform: Option<Transform>) -> Result<Option<DMat4>, &str> {
        let Some(transform) = transform else { return Ok(None) };
        let Some(operator) = self.marked(&transform.to) else { return Ok(plain(&transform)) };
        let origin = plain(&Transform { from: transform.from, to: ORIGIN });
        operator.map(|o| origin.map(|origin| o.mapped * origin))
    }

    /// The operator that a placement stands for.
    fn marked(&self, placement: &Placement) -> Option<Result<&Operator, &str>> {
        let [k, y, z] = placement.ref_direction;
        let known = placement.axis == [0.0, 0.0, MARK] && [y, z] == [0.0; 2] && k >= 1.0;
        let operator = known.then(|| self.0.get(k as usize - 1))??;
        Some(operator.as_ref().map_err(String::as_str))
    }
}

const ORIGIN: Placement =
    Placement { origin: [0.0; 3], axis: [0.0, 0.0, 1.0], ref_direction: [1.0, 0.0, 0.0] };

fn plain(transform: &Transform) -> Option<DMat4> {
    transform.matrix().map(|m| DMat4::from_cols_array_2d(&m).transpose())
}

type Ranges = Vec<std::ops::Range<usize>>;

/// The keyword of an operator, and its axes 1 and 2, origin, scale and axis 3; None of what is none.
fn attributes(text: &Text, record: &Record) -> Option<(String, Ranges)> {
    let keyword = String::from_utf8_lossy(text.keyword(record)).into_owned();
    if keyword.starts_with(KEYWORD) {
        // After its names, of which there are one to three.
        let list = text.list(record);
        let from = list.len().checked_sub(5)?;
        return Some((keyword, list[from..].to_vec()));
    }
    let mut list = text.part(record, "CARTESIAN_TRANSFORMATION_OPERATOR")?;
    list.extend(text.part(record, KEYWORD)?);
    (list.len() == 5).then(|| (KEYWORD.to_owned(), list))
}

fn of_attributes(
    text: &Text,
    keyword: &str,
    list: &[std::ops::Range<usize>],
    occ: bool,
) -> Result<Operator, String> {
    if keyword != KEYWORD {
        return Err(
            "its placement scales it differently along its axes, which would bend arcs".into()
        );
    }
    let at = |k: usize| text.get(reference(text.words(&list[k]))?).and_then(|r| text.xyz(r));
    let way = |k: usize| at(k).map(DVec3::from).and_then(DVec3::try_normalize);
    let scale = match text.words(&list[3]) {
        b"$" => Some(1.0),
        words => number(words),
    };
    let scale = scale.filter(|s| s.abs() > NO_WAY).ok_or("its placement scales it to nothing")?;
    let origin = at(2).map(DVec3::from).ok_or("its placement has no origin")?;
    let turn = axes(way(0), way(1), way(4)).ok_or("the axes of its placement are one")?;
    let mapped = DMat4::from_mat3(turn * scale);
    let mapped = DMat4::from_translation(origin) * mapped;
    // OpenCascade writes the scale, and the origin by it, of the way back; only it writes a scale below 0.
    let related = if occ || scale < 0.0 {
        DMat4::from_translation(origin / scale) * DMat4::from_mat3(turn * scale.recip())
    } else {
        mapped
    };
    Ok(Operator { mapped, related })
}

/// The three axes as ISO 10303-42 derives them (`base_axis`); None where two of them are one.
fn axes(x: Option<DVec3>, y: Option<DVec3>, z: Option<DVec3>) -> Option<DMat3> {
    let beside = |v: DVec3, w: DVec3| v - w * v.dot(w);
    let unit = |v: DVec3| (v.length() > NO_WAY).then(|| v.normalize());
    let z = z.unwrap_or(DVec3::Z);
    let usual = if z.x.abs() < 1.0 { DVec3::X } else { DVec3::Y };
    let x = unit(beside(x.unwrap_or(usual), z))?;
    let y = unit(beside(beside(y.unwrap_or(DVec3::Y), z), x)).unwrap_or(z.cross(x));
    Some(DMat3::from_cols(x, y, z))
}

/// Whether the header says that OpenCascade wrote the file.
fn written_by_occ(text: &Text) -> bool {
    let header = text.bytes.windows(5).position(|w| w == b"DATA;").unwrap_or(0);
    text.bytes[..header].windows(12).any(|w| w.eq_ignore_ascii_case(b"Open CASCADE"))
}
