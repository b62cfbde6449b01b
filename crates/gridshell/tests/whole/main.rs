//! The whole method on whole surfaces: what is promised of every run, whatever the surface, the recipe, the
//! threads or the moment at which it is stopped. Coarse grids, so that all of it takes a minute or two.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod builtin;
mod fixed;
mod formats;
mod hexagon;
mod moments;
mod narrow;
mod paper;
mod parts;
mod promise;
mod sheets;
mod stopping;
mod symmetry;
mod threads;
mod topology;
mod valid;
mod watching;
mod wishes;
