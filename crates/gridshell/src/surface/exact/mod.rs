//! Exact geometry: what is known of patches and curves at any parameter. Splines, offsets and functions of height are
//! told apart in here only; points, derivatives, closest points and areas come from all of them alike.

pub(in crate::surface) mod area;
pub mod curve;
mod derivatives;
pub mod jet;
pub mod nurbs;
pub mod offset;
pub mod project;
pub mod shape;

pub use curve::Curve;
pub use jet::Jet;
pub use offset::OffsetSurface;
pub use shape::{Pole, Shape};
