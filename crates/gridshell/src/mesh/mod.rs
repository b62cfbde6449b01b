//! Topology of the triangular grid: an ordered ring of neighbours per vertex.
//!
//! `ring(v)` lists the neighbours of `v` counter-clockwise seen from outside. The directed edge from `v`
//! to `ring(v)[i]` has the triangle `(v, ring[i], ring[i + 1])` on its left. The ring of an interior vertex
//! is cyclic; that of a boundary vertex is open and begins with the next vertex along the boundary (surface
//! to the left) and ends with the previous one, so `degree - 1` triangles surround it. Positions live
//! elsewhere. Edges may be marked as parts of features, which edits keep. Simplicial: two vertices share at most one edge.

mod check;
mod edit;
mod swap;
mod topology;

pub use edit::{Refusal, Undo};
pub use swap::Vertex;
pub use topology::{Along, Mesh, Ring};
