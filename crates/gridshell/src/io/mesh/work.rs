//! A mesh while it is put right, and what all steps ask of it.

use super::soup::Soup;
use crate::error::{Error, Result};
use crate::io::LengthUnit;
use crate::surface::Loss;
use crate::surface::nurbs::FARTHEST;
use crate::words;
use glam::DVec3;
use std::path::Path;

/// Faces with more corners are refused: nothing that was modelled has them.
const MOST_SIDES: usize = 10_000;

/// A face's corner, given by face and place, with the direction of its edge.
pub(super) type Use = (u32, u32, u32, bool);

/// A mesh while it is put right. Metres.
pub(super) struct Work {
    pub points: Vec<DVec3>,
    pub faces: Vec<Vec<u32>>,
    /// The place of each face in the file.
    pub origin: Vec<u32>,
    /// Number of the first face in the file.
    pub first: usize,
    pub notes: Vec<String>,
    pub losses: Vec<Loss>,
    /// Vertices that were merged into others.
    pub merged: usize,
}

impl Work {
    pub fn new(path: &Path, soup: Soup, wanted: Option<LengthUnit>) -> Result<Work> {
        let Soup { mut points, faces, mut notes, losses, unit, first, .. } = soup;
        notes.extend(unit_note(unit, wanted));
        let metres = wanted.or(unit).map_or(1.0, LengthUnit::metres);
        if metres != 1.0 {
            for p in &mut points {
                *p *= metres;
            }
        }
        let origin = (0..faces.len() as u32).collect();
        let work = Work { points, faces, origin, first, notes, losses, merged: 0 };
        work.check(path)?;
        Ok(work)
    }

    /// Refuse what is out of all bounds.
    fn check(&self, path: &Path) -> Result<()> {
        for (face, f) in self.faces.iter().zip(0..) {
            let outside = face.iter().find(|&&v| {
                let p = self.points[v as usize];
                !p.is_finite() || p.abs().max_element() > FARTHEST
            });
            if let Some(&v) = outside {
                let p = self.points[v as usize];
                return Err(Error::Surface(format!(
                    "{}: face {} uses vertex {} at ({:e}, {:e}, {:e}) m, more than {FARTHEST:e} m from the \
                     origin; correct it, or state the unit",
                    path.display(),
                    self.number(f),
                    v as usize + self.first,
                    p.x,
                    p.y,
                    p.z
                )));
            }
            if face.len() > MOST_SIDES {
                return Err(Error::Surface(format!(
                    "{}: face {} has {} corners, more than {MOST_SIDES}; split it",
                    path.display(),
                    self.number(f),
                    face.len()
                )));
            }
        }
        Ok(())
    }

    /// The number of a face in the file, as the format counts.
    pub fn number(&self, face: u32) -> String {
        (self.origin[face as usize] as usize + self.first).to_string()
    }

    /// Which vertices a face uses.
    pub fn used(&self) -> Vec<bool> {
        let mut used = vec![false; self.points.len()];
        for &v in self.faces.iter().flatten() {
            used[v as usize] = true;
        }
        used
    }

    /// Area of a face that is nearly plane.
    pub fn area(&self, face: &[u32]) -> f64 {
        let corner = |k: usize| self.points[face[k] as usize] - self.points[face[0] as usize];
        let sum: DVec3 = (2..face.len()).map(|k| corner(k - 1).cross(corner(k))).sum();
        sum.length() / 2.0
    }

    /// Drop the faces that are `gone`.
    pub fn drop_faces(&mut self, gone: &[bool]) {
        let mut f = 0;
        self.faces.retain(|_| {
            f += 1;
            !gone[f - 1]
        });
        f = 0;
        self.origin.retain(|_| {
            f += 1;
            !gone[f - 1]
        });
    }

    pub fn note_count(&mut self, count: usize, verb: &str, what: [&str; 2]) {
        if count > 0 {
            self.notes.push(format!("{verb} {}", words::one_or_more(count, what)));
        }
    }

    /// As [`Work::drop_faces`], with a note that tells the first.
    pub fn drop_noted(&mut self, gone: &[bool], what: [&str; 2]) {
        let Some(first) = gone.iter().position(|&g| g) else { return };
        let count = gone.iter().filter(|&&g| g).count();
        let number = self.number(first as u32);
        let first = if count == 1 { "" } else { "the first is " };
        let dropped = words::one_or_more(count, what);
        self.notes.push(format!("left out {dropped}: {first}face {number}"));
        self.drop_faces(gone);
    }
}

fn unit_note(stated: Option<LengthUnit>, wanted: Option<LengthUnit>) -> Option<String> {
    match (stated, wanted) {
        (None, None) => Some("the file states no unit: metres are assumed".into()),
        (Some(s), Some(w)) if s != w => {
            Some(format!("the file states {}, but {} was asked for", s.name(), w.name()))
        }
        _ => None,
    }
}

/// The edges of all faces, those of the same place one after the other.
pub(super) fn uses(faces: &[Vec<u32>]) -> Vec<Use> {
    let mut uses: Vec<Use> = Vec::with_capacity(faces.iter().map(Vec::len).sum());
    for (f, face) in faces.iter().enumerate() {
        for k in 0..face.len() {
            let (a, b) = (face[k], face[(k + 1) % face.len()]);
            uses.push((a.min(b), a.max(b), f as u32, a < b));
        }
    }
    uses.sort_unstable();
    uses
}

/// For each face, its neighbours, and whether the two run along their common edge the same way: then they
/// disagree on the outside.
pub(super) fn neighbors(faces: &[Vec<u32>]) -> Vec<Vec<(u32, bool)>> {
    let mut neighbors = vec![Vec::new(); faces.len()];
    for edge in uses(faces).chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        if let [(_, _, f, up), (_, _, g, other_up)] = *edge {
            neighbors[f as usize].push((g, up == other_up));
            neighbors[g as usize].push((f, up == other_up));
        }
    }
    neighbors
}

pub(super) fn place(p: DVec3) -> String {
    format!("({}, {}, {})", p.x, p.y, p.z)
}

/// Lowest and highest coordinates; zero when there are no points.
pub(in crate::io) fn bounds(mut points: impl Iterator<Item = DVec3>) -> (DVec3, DVec3) {
    let Some(first) = points.next() else { return (DVec3::ZERO, DVec3::ZERO) };
    points.fold((first, first), |(low, high), p| (low.min(p), high.max(p)))
}
