//! Triangular grids for free-form gridshells, after Wang et al., *A triangular grid generation and
//! optimization framework for the design of free-form gridshells*.

pub mod balance;
pub mod bubbles;
pub mod degree;
pub mod error;
pub mod grid;
pub mod io;
pub mod job;
pub mod math;
pub mod mesh;
pub mod recipe;
pub mod run;
pub mod stages;
pub mod surface;

pub use error::{Error, Result};
pub use glam::{DVec2, DVec3};
