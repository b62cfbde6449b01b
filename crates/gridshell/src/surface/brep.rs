//! The trimmed model as CAD files have it: faces over exact shapes, bounded by shared edges.

use super::{Curve, Origin, Shape, Source};

use glam::DVec3;
use serde::Serialize;

/// A boundary representation in metres: what the CAD readers and the built-in surfaces make, and what
/// [`tessellate`](super::tessellate()) turns into a [`Surface`](super::Surface).
#[derive(Clone, Debug, Default)]
pub struct Brep {
    /// Built-in name or file stem.
    pub name: String,
    /// Length of the file's unit in metres (0.001 for millimetres).
    pub unit_in_metres: f64,
    /// How far apart the file says that edges which belong together may lie, metres; 0 where it says nothing.
    pub tolerance: f64,
    /// What sewing did; None before.
    pub sewing: Option<Sewing>,
    /// Where the coordinates have their origin in those of the file.
    pub origin: Origin,
    /// Vertex positions.
    pub vertices: Vec<DVec3>,
    /// Edges, each once, however many faces share it.
    pub edges: Vec<BrepEdge>,
    /// Trimmed faces.
    pub faces: Vec<BrepFace>,
    /// What the file says of itself.
    pub source: Source,
    /// For each face the place of its object in `source.objects`; empty where no objects are known. What drops
    /// or adds faces keeps it in step.
    pub object_of: Vec<u32>,
    /// What was skipped or repaired while reading, for the user.
    pub notes: Vec<String>,
}

/// One edge: a piece of a curve between two vertices (the same one twice when closed).
#[derive(Clone, Debug)]
pub struct BrepEdge {
    /// Exact geometry.
    pub curve: Curve,
    /// Parameters of the edge's start and end; start < end.
    pub range: [f64; 2],
    /// Start and end vertex.
    pub ends: [u32; 2],
}

/// One face: a shape trimmed by loops.
#[derive(Clone, Debug)]
pub struct BrepFace {
    /// Exact geometry.
    pub shape: Shape,
    /// Loops of edges; empty for a face that covers its whole shape. Seen from the face's outside, the
    /// surface lies to the left of every loop.
    pub loops: Vec<Vec<Coedge>>,
    /// The face's outside is against `du x dv`.
    pub reversed: bool,
    /// What the file calls it, for errors and notes: `#552`, `D13`; empty where it has no name of its own.
    pub label: String,
}

impl BrepFace {
    /// How errors name it, where it is the `i`th of its model, counted from 0.
    pub fn told(&self, i: usize) -> String {
        if self.label.is_empty() {
            return format!("face {}", i + 1);
        }
        format!("face {} ({})", i + 1, self.label)
    }
}

/// The use of an edge by a loop.
#[derive(Clone, Copy, Debug)]
pub struct Coedge {
    /// Index of the edge.
    pub edge: u32,
    /// Run from the edge's end to its start.
    pub reversed: bool,
}

/// What sewing found and did. Lengths in metres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Sewing {
    /// Gaps up to this were sewn.
    pub tolerance: f64,
    /// Pairs of edges that became one.
    pub joints: usize,
    /// Largest distance between two edges that became one.
    pub largest_gap: f64,
    /// Edges that are still naked although another naked one runs beside them.
    pub facing: usize,
    /// Their length together.
    pub facing_length: f64,
    /// How far the others are away, at most.
    pub facing_gap: f64,
}
