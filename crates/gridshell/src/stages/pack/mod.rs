//! Pack (Sections 4.1 and 4.2): spread bubbles over the surface.
//!
//! Boundary bubbles are placed first, at equal distances along each piece of a loop between two corners, and
//! stay. Interior bubbles start at random (Eq. 1) and settle by the paper's dynamics (Eq. 2 to 10).

pub mod boundary;
mod dynamics;
pub mod lattice;
mod random;
mod rim;
mod rows;

pub use dynamics::{Report, settle};
pub use random::{interior_count, scatter};
