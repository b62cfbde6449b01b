//! What the parser could not take into its model, told as the user knows it: faces one by one, with their area; of all else
//! the kinds. What only hangs on something dropped is not told again.

use super::text::{Record, Text, references};
use crate::surface::Loss;
use glam::DVec3;
use std::collections::BTreeMap;
use step_io::{DropKind, DropReason};

/// What is a face.
const FACES: [&[u8]; 3] = [b"ADVANCED_FACE", b"FACE_SURFACE", b"FACE"];
/// Kinds that are told by name.
const MOST_KINDS: usize = 5;

/// The faces that were dropped, and what else there is to be said. Lengths in the text are so many metres.
pub(super) fn told(
    text: &Text,
    dropped: &[(u64, DropReason)],
    metres: f64,
) -> (Vec<Loss>, Option<String>) {
    let is_face = |id: u64| text.get(id).is_some_and(|r| FACES.contains(&text.keyword(r)));
    let (faces, others): (Vec<_>, Vec<_>) = dropped.iter().partition(|(id, _)| is_face(*id));
    let losses = faces.iter().map(|(id, reason)| Loss {
        what: format!("face #{id}"),
        why: format!("{}; export it as a B-spline face", why(reason)),
        faces: 1,
        area: area(text, *id, metres),
        whole: false,
    });
    let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
    for (_, reason) in others.iter().filter(|(_, r)| r.kind == DropKind::Unimplemented) {
        *kinds.entry(&reason.detail).or_default() += 1;
    }
    let list = kinds.iter().take(MOST_KINDS).map(|(kind, n)| format!("{kind} ({n})"));
    let list = list.collect::<Vec<_>>().join(", ");
    let more = kinds.len().saturating_sub(MOST_KINDS);
    let more = if more > 0 { format!(" and {more} kinds more") } else { String::new() };
    let note =
        (!kinds.is_empty()).then(|| format!("entities of kinds that are not read: {list}{more}"));
    (losses.collect(), note)
}

/// The reason in a sentence.
fn why(reason: &DropReason) -> String {
    let detail = &reason.detail;
    match (&reason.kind, detail.strip_prefix("via-")) {
        (_, Some("dangling")) => "it refers to an entity that the file does not have".into(),
        (_, Some(kind)) => format!("it rests on {kind}, which cannot be read"),
        (DropKind::Unimplemented, _) => format!("{detail} is not read"),
        (DropKind::NonstandardValue, _) => {
            format!("a value in it is not as the standard wants: {detail}")
        }
        (DropKind::NonstandardReference, _) => {
            format!("a reference in it is not as the standard wants: {detail}")
        }
        _ => format!("it cannot be read: {detail}"),
    }
}

/// About the area of a face, square metres: that of the polygon through the vertices of its longest loop. None where a
/// loop has too few of them to tell.
pub(super) fn area(text: &Text, face: u64, metres: f64) -> Option<f64> {
    let bounds = references(text, text.list(text.get(face)?).get(1)?);
    let loops = bounds.into_iter().map(|bound| {
        let ring = text.target(text.get(bound)?, 1)?;
        let corners = references(text, text.list(ring).get(1)?);
        let corners: Option<Vec<DVec3>> =
            corners.into_iter().map(|e| start(text, text.get(e)?)).collect();
        let corners = corners.filter(|corners| corners.len() > 2)?;
        let pairs = corners.iter().zip(corners.iter().cycle().skip(1));
        let sum: DVec3 = pairs.map(|(p, q)| (*p - corners[0]).cross(*q - corners[0])).sum();
        Some(0.5 * sum.length() * metres * metres)
    });
    let areas: Option<Vec<f64>> = loops.collect();
    areas?.into_iter().reduce(f64::max).filter(|a| a.is_finite() && *a > 0.0)
}

/// Where an oriented edge begins.
fn start(text: &Text, oriented: &Record) -> Option<DVec3> {
    let forward = text.words(text.list(oriented).get(4)?) != b".F.";
    let edge = text.target(oriented, 3)?;
    let vertex = text.target(edge, if forward { 1 } else { 2 })?;
    Some(text.xyz(text.target(vertex, 1)?)?.into())
}
