//! What a file or a built-in name gives, before it is sampled for an edge length: its size, and how it is put elsewhere.

mod replace;
pub(in crate::surface) mod size;

use super::{Brep, Origin, Source};
use glam::DVec3;
use serde::Serialize;

/// A design surface as it was read: independent of the edge length.
#[derive(Clone, Debug)]
pub enum Model {
    /// Trimmed exact patches.
    Brep(Brep),
    /// A polygon mesh; the mesh is the surface.
    Mesh(PolygonMesh),
}

/// A mesh as files have it, vertices merged, faces oriented alike. Metres.
#[derive(Clone, Debug, Default)]
pub struct PolygonMesh {
    /// File stem.
    pub name: String,
    /// Where the coordinates have their origin in those of the file.
    pub origin: Origin,
    /// Vertex positions.
    pub points: Vec<DVec3>,
    /// Faces of three or more vertices, counter-clockwise seen from outside.
    pub faces: Vec<Vec<u32>>,
    /// What the file says of itself.
    pub source: Source,
    /// What was skipped or repaired while reading, for the user.
    pub notes: Vec<String>,
    /// What smoothing did; None before.
    pub smoothing: Option<Smoothing>,
}

/// What smoothing did. Metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Smoothing {
    /// Longest edge of the mesh as it was.
    pub longest_edge: f64,
    /// Largest distance of the smooth surface from the mesh.
    pub departure: f64,
}

impl Model {
    /// What the file says of itself.
    pub fn source(&self) -> &Source {
        match self {
            Model::Brep(brep) => &brep.source,
            Model::Mesh(mesh) => &mesh.source,
        }
    }

    /// What was skipped or repaired while reading.
    pub fn notes(&self) -> &[String] {
        match self {
            Model::Brep(brep) => &brep.notes,
            Model::Mesh(mesh) => &mesh.notes,
        }
    }

    /// Where its coordinates have their origin in those of its file.
    pub fn origin(&self) -> Origin {
        match self {
            Model::Brep(brep) => brep.origin,
            Model::Mesh(mesh) => mesh.origin,
        }
    }
}

impl PolygonMesh {
    /// All but points and faces.
    pub(super) fn without_faces(&self) -> PolygonMesh {
        let (points, faces) = (Vec::new(), Vec::new());
        let (name, source, notes) = (self.name.clone(), self.source.clone(), self.notes.clone());
        PolygonMesh {
            name,
            origin: self.origin,
            points,
            faces,
            source,
            notes,
            smoothing: self.smoothing,
        }
    }
}
