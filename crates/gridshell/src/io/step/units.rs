//! Files whose parts are drawn in different units: each length is brought to that of the first.
//!
//! Programs that put an assembly together from files of others leave each part in its own unit; the parser knows one
//! for all.

use super::text::{Draft, Record, Text, mentions, number, real, reference, references};
use std::collections::BTreeMap;

/// Which parameters of which entities are lengths, or lists of them.
const LENGTHS: [(&str, &[usize]); 13] = [
    ("CARTESIAN_POINT", &[1]),
    ("VECTOR", &[2]),
    ("CIRCLE", &[2]),
    ("ELLIPSE", &[2, 3]),
    ("PARABOLA", &[2]),
    ("HYPERBOLA", &[2, 3]),
    ("CYLINDRICAL_SURFACE", &[2]),
    ("CONICAL_SURFACE", &[2]),
    ("SPHERICAL_SURFACE", &[2]),
    ("TOROIDAL_SURFACE", &[2, 3]),
    ("DEGENERATE_TOROIDAL_SURFACE", &[2, 3]),
    ("OFFSET_SURFACE", &[2]),
    ("COORDINATES_LIST", &[2]),
];
const MOST_LEVELS: usize = 8;

/// The text in one unit; None where it is.
pub(super) fn mended(text: &Text) -> Option<Vec<u8>> {
    // Contexts with a unit of length, the one that the parser takes for all first.
    let mut contexts: Vec<(u64, f64)> = Vec::new();
    for record in &text.records {
        let Some(units) = text.part(record, "GLOBAL_UNIT_ASSIGNED_CONTEXT") else { continue };
        let units = units.first().map(|u| references(text, u)).unwrap_or_default();
        let metres = units.into_iter().find_map(|id| metres(text, text.get(id)?, MOST_LEVELS));
        contexts.extend(metres.map(|m| (record.id, m)));
    }
    let first = contexts.first()?.1;
    if contexts.iter().all(|c| (c.1 / first - 1.0).abs() < 1e-12) {
        return None;
    }
    let scales: BTreeMap<u64, f64> = contexts.iter().map(|&(id, m)| (id, m / first)).collect();
    let mut scale_of: BTreeMap<u64, f64> = BTreeMap::new();
    for record in text.records.iter().filter(|r| text.keyword(r).ends_with(b"REPRESENTATION")) {
        let list = text.list(record);
        let context = list.get(2).and_then(|c| reference(text.words(c)));
        let Some(&scale) = context.and_then(|c| scales.get(&c)) else { continue };
        let mut next: Vec<u64> = list.get(1).map(|i| references(text, i)).unwrap_or_default();
        while let Some(id) = next.pop() {
            let Some(item) = text.get(id).filter(|_| !scale_of.contains_key(&id)) else { continue };
            // What a map places has a context of its own, and what is drawn on a surface no unit.
            let apart = [b"MAPPED_ITEM".as_slice(), b"PCURVE"].contains(&text.keyword(item));
            scale_of.insert(id, scale);
            if text.keyword(item) == b"MAPPED_ITEM" {
                next.extend(text.target(item, 2).map(|r| r.id));
            } else if !apart {
                next.extend(mentions(text.words(&item.list)));
            }
        }
    }
    let mut draft = Draft::of(text);
    for record in &text.records {
        let scale = scale_of.get(&record.id).copied().unwrap_or(1.0);
        if (scale - 1.0).abs() > 1e-12 {
            scaled(&mut draft, record, scale);
        }
    }
    draft.done()
}

/// A unit of length in metres; None for other units.
fn metres(text: &Text, unit: &Record, levels: usize) -> Option<f64> {
    let levels = levels.checked_sub(1)?;
    let converted = text.part(unit, "CONVERSION_BASED_UNIT");
    if let Some(converted) = converted {
        let measure = text.get(reference(text.words(converted.get(1)?))?)?;
        let list = text.list(measure);
        let value = text.words(list.first()?);
        let open = value.iter().position(|&b| b == b'(')? + 1;
        let value = number(value[open..].strip_suffix(b")")?.trim_ascii())?;
        return Some(value * metres(text, text.target(measure, 1)?, levels)?);
    }
    let si = text.part(unit, "SI_UNIT")?;
    if text.words(si.get(1)?) != b".METRE." {
        return None;
    }
    Some(match text.words(&si[0]) {
        b".KILO." => 1e3,
        b".DECI." => 1e-1,
        b".CENTI." => 1e-2,
        b".MILLI." => 1e-3,
        b".MICRO." => 1e-6,
        b"$" => 1.0,
        _ => return None,
    })
}

fn scaled(draft: &mut Draft, record: &Record, scale: f64) {
    let text = draft.text;
    let known = LENGTHS.iter().find(|(keyword, _)| text.keyword(record) == keyword.as_bytes());
    let Some((_, places)) = known else { return };
    let list = text.list(record);
    for range in places.iter().filter_map(|&k| list.get(k)) {
        let words = String::from_utf8_lossy(text.words(range)).into_owned();
        let mut out = String::new();
        // Numbers between brackets, commas and blanks.
        for piece in words.split_inclusive(|c: char| "(), \r\n\t".contains(c)) {
            let cut =
                piece.len() - usize::from(piece.ends_with(|c: char| "(), \r\n\t".contains(c)));
            match number(&piece.as_bytes()[..cut]) {
                Some(x) => out.push_str(&real(x * scale)),
                None => out.push_str(&piece[..cut]),
            }
            out.push_str(&piece[cut..]);
        }
        draft.put(range.clone(), out);
    }
}
