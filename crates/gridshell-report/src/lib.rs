//! What people see of a grid: pictures of surfaces, sheets to scale, pages that tell of one grid or compare several.
//!
//! [`picture`] draws, [`page`] tells of a [`Design`](gridshell::design::Design) in one file that needs no network,
//! [`compare`] sets several side by side. [`measures`] is the one table of measures, [`colourings`] that of
//! what grids are coloured by.

pub mod colourings;
pub mod compare;
pub mod measures;
pub mod page;
pub mod picture;
