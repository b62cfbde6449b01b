//! Faces as a mesh file has them, before anything is known of them: what the mesh readers make and
//! [`weld`](super::weld()) turns into a surface.

use crate::io::LengthUnit;
use crate::surface::Loss;
use crate::words;
use glam::DVec3;

/// A soup of faces in the file's own unit.
#[derive(Debug, Default)]
pub(in crate::io) struct Soup {
    /// Vertex positions.
    pub points: Vec<DVec3>,
    /// Faces of three or more corners.
    pub faces: Vec<Vec<u32>>,
    /// What was skipped, for the user.
    pub notes: Vec<String>,
    /// What of the file's geometry is not among them.
    pub losses: Vec<Loss>,
    /// The unit that the file states.
    pub unit: Option<LengthUnit>,
    /// How exactly the file holds coordinates.
    pub digits: Digits,
    /// Number of the first vertex and face when they are told to the user.
    pub first: usize,
}

/// How exactly a file holds coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::io) enum Digits {
    /// As text or in double precision.
    #[default]
    Double,
    /// In single precision: equal places may differ by a rounding.
    Single,
}

impl Soup {
    /// Note what was passed over, if anything was.
    pub fn note_count(&mut self, count: usize, verb: &str, what: [&str; 2]) {
        if count > 0 {
            self.notes.push(format!("{verb} {}", words::one_or_more(count, what)));
        }
    }
}
