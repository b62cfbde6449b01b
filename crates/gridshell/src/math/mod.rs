//! Small mathematics: transcendental functions that give the same bits on every machine.
//!
//! `+ - * / sqrt` are exact by IEEE 754; everything else goes through `libm` here, so that the same
//! seed gives the same grid everywhere.

pub(crate) mod blend;
pub(crate) mod chunks;
pub(crate) mod conjugate;
pub(crate) mod delaunay;
pub mod digits;
pub mod dual;
pub(crate) mod frame;
pub(crate) mod least;
pub(crate) mod multigrid;
pub(crate) mod sparse;
pub mod trig;
