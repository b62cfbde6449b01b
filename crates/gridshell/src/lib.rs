//! Triangular grids for free-form gridshells, after Wang et al., *A triangular grid generation and
//! optimization framework for the design of free-form gridshells*.
//!
//! A *surface* (trimmed patches or a mesh) and a *recipe* go in; a *grid* of nodes, members and panels comes
//! out, with every stage's grid and measures:
//!
//! ```
//! use gridshell::{io, job::Job, pipeline, recipe::Recipe};
//!
//! let job = Job::default();
//! let model = io::open("hexagon", &job)?;
//! let recipe = Recipe { edge_length: Some(1.0), ..Recipe::default() };
//! let run = pipeline::generate(&model, &recipe, &job)?;
//! println!("{} nodes, fluency {:?}", run.quality.nodes, run.quality.fluency);
//! # assert_eq!(run.quality.euler_characteristic, 1);
//! # Ok::<(), gridshell::Error>(())
//! ```
//!
//! - [`io::open`] reads a file or takes a built-in surface by its name: a [`surface::Model`].
//! - [`recipe::Recipe`] holds all options; [`recipe::Recipe::named`] gives the method as printed.
//! - [`job::Job`] tells of progress, and stops a run from any thread or after a time.
//! - [`run::Run`] is what comes out; serialised, it is the document that the command prints.
//! - [`stages::measure::measure`] measures any grid; [`grid::Grid::from_panels`] takes one from elsewhere.
//!
//! The same surface, recipe and seed give the same grid, bit for bit, whatever the machine and the number of
//! threads. Lengths are metres, angles radians; measures give degrees where the paper does.

pub mod balance;
pub mod bubbles;
pub mod degree;
pub mod edit;
pub mod error;
pub mod grid;
pub mod inspect;
pub mod io;
pub mod job;
pub mod math;
pub mod merit;
pub mod mesh;
pub mod pipeline;
pub mod recipe;
pub mod reopen;
pub mod run;
pub mod schedule;
pub mod stages;
pub mod structure;
pub mod surface;
pub mod validity;
pub mod words;

pub use error::{Error, Result};
pub use glam::{DVec2, DVec3};
