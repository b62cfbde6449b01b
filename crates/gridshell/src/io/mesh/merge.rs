//! Vertices at the same place become one.

use super::soup::Digits;
use super::work::{Work, bounds};
use crate::error::{Error, Result};
use glam::DVec3;
use std::collections::HashMap;

/// Vertices closer than this share of the model's box are the same.
const SAME: f64 = 1e-9;
/// And those within this many roundings of the file's coordinates,
const ROUNDINGS: f64 = 2.0;
/// but never beyond this share of the model's box.
const MOST: f64 = 1e-5;
/// No more than this share of the box may be wanted.
const MOST_WANTED: f64 = 0.01;

/// Replace every vertex by the first one at exactly its place.
pub(super) fn identical(work: &mut Work) {
    let mut first: HashMap<[u64; 3], u32> = HashMap::with_capacity(work.points.len());
    // -0 and 0 are one place.
    let key = |p: DVec3| (p + DVec3::ZERO).to_array().map(f64::to_bits);
    let keep: Vec<u32> =
        (work.points.iter().zip(0..)).map(|(&p, i)| *first.entry(key(p)).or_insert(i)).collect();
    replace(work, &keep);
}

/// Within what distance vertices are the same, metres: `wanted`, or what roundings make of one place.
///
/// # Errors
/// [`Error::Option`] where what is wanted would make the mesh collapse.
pub(super) fn tolerance(work: &Work, digits: Digits, wanted: Option<f64>) -> Result<f64> {
    let used = work.used();
    let (low, high) = bounds(work.points.iter().zip(&used).filter(|p| *p.1).map(|p| *p.0));
    let size = (high - low).length();
    let rounding = match digits {
        Digits::Double => f64::EPSILON,
        Digits::Single => f64::from(f32::EPSILON),
    };
    let rounding = low.abs().max(high.abs()).max_element() * rounding * ROUNDINGS;
    let usual = rounding.min(MOST * size).max(SAME * size);
    match wanted {
        Some(t) if !(0.0..=MOST_WANTED * size).contains(&t) => Err(Error::Option(format!(
            "the sewing tolerance {t} m does not suit a mesh {size:.3} m across: it must be from 0 to {:.3} m",
            MOST_WANTED * size
        ))),
        wanted => Ok(wanted.unwrap_or(usual)),
    }
}

/// Replace every vertex that a face uses by the first such one no further than `tolerance` metres.
pub(super) fn close(work: &mut Work, tolerance: f64) {
    let used = work.used();
    let (low, _) = bounds(work.points.iter().zip(&used).filter(|p| *p.1).map(|p| *p.0));
    // Cells are wider than the tolerance, so that most points touch one cell only, but hold few that differ.
    let cell = 16.0 * tolerance.max(f64::MIN_POSITIVE);
    let key = |p: DVec3| ((p - low) / cell).floor().to_array().map(|c| c as i64);
    let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    let mut keep: Vec<u32> = (0..work.points.len() as u32).collect();
    for (i, &p) in work.points.iter().enumerate().filter(|(i, _)| used[*i]) {
        let [from, to] = [key(p - tolerance), key(p + tolerance)];
        let mut same = None;
        for x in from[0]..=to[0] {
            for y in from[1]..=to[1] {
                for z in from[2]..=to[2] {
                    let near = cells.get(&[x, y, z]).into_iter().flatten().copied();
                    same = near
                        .filter(|&j| work.points[j as usize].distance(p) <= tolerance)
                        .chain(same)
                        .min();
                }
            }
        }
        match same {
            None => cells.entry(key(p)).or_default().push(i as u32),
            Some(j) => keep[i] = j,
        }
    }
    replace(work, &keep);
}

fn replace(work: &mut Work, keep: &[u32]) {
    work.merged += keep.iter().zip(0..).filter(|&(&k, i)| k != i).count();
    for v in work.faces.iter_mut().flatten() {
        *v = keep[*v as usize];
    }
}
