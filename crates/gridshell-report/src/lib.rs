//! What people see of a grid: pictures of surfaces, sheets to scale, pages that tell of one grid or compare several.
//!
//! [`picture`] draws, [`page`] tells of a [`Design`](gridshell::design::Design) in one file that needs no network,
//! [`compare`] sets several side by side. The figures and their words stand in one place, `facts`, and what colours mean
//! in another, `picture/colour`.

pub mod compare;
mod facts;
pub mod page;
pub mod picture;
