//! What a file or a built-in name gives, before it is sampled for an edge length.

use super::{Brep, Smoothing, Source, Surface, tessellate};
use crate::error::Result;
use crate::job::Job;
use glam::DVec3;

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

/// How finely a model is sampled.
#[derive(Clone, Copy, Debug)]
pub struct Sampling {
    /// Carrier edges are at most this long, metres.
    pub max_edge: f64,
    /// Largest distance between the carrier and the exact surface, metres.
    pub chord_error: f64,
    /// Boundary vertices turning by more than this are corners, radians.
    pub corner_angle: f64,
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

    /// The surface with a carrier of this sampling.
    ///
    /// # Errors
    /// [`Error::Surface`](crate::Error::Surface) where the model is no manifold surface.
    pub fn surface(&self, sampling: &Sampling, job: &Job) -> Result<Surface> {
        match self {
            Model::Brep(brep) => tessellate(brep, sampling, job),
            Model::Mesh(mesh) => mesh.surface(sampling, job),
        }
    }
}
