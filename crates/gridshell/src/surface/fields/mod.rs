//! Fields on the carrier: a flattening of it, wanted lengths and directions at its vertices, and where it bends more
//! sharply than members can follow.

pub mod bends;
pub mod chart;
pub mod direction;
pub mod grading;
