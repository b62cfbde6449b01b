//! Triangular grids for free-form gridshells, after Wang et al., *A triangular grid generation and
//! optimization framework for the design of free-form gridshells*.
//!
//! A *surface* (trimmed patches or a mesh) and a *recipe* go in; a *grid* of nodes, members and panels comes
//! out, with every stage's grid and measures:
//!
//! ```
//! use gridshell::{design::Design, io, job::Job, recipe::Recipe};
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("hexagon.ifc");
//!
//! let job = Job::default();
//! let recipe = Recipe { edge_length: Some(1.0), ..Recipe::default() };
//! let design = Design::generate(&io::open("hexagon", &job)?, &recipe, &job)?;
//! println!("{} nodes, fluency {:?}", design.quality.nodes, design.quality.fluency);
//! design.write(&path, &job)?;
//! # assert!(std::fs::read_to_string(path)?.contains("IFCMEMBER"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! - [`io::open`] reads a file or takes a built-in surface by its name: a [`surface::Model`].
//! - [`recipe::Recipe`] holds all options; [`recipe::Recipe::named`] gives the method as printed.
//! - [`job::Job`] tells of progress, and stops a run from any thread or after a time.
//! - [`design::Design`] is the finished grid with all that is known of it: it opens, edits, measures and writes.
//! - [`run::Run`] tells how it was made; serialised, it is the document that the command prints.
//! - [`stages::measure::measure`] measures any grid; [`grid::Grid::from_panels`] takes one from elsewhere.
//!
//! The same surface, recipe and seed give the same grid, bit for bit, whatever the machine and the number of
//! threads. Lengths are metres, angles radians; measures give degrees where the paper does.

pub mod balance;
pub mod bubbles;
pub mod degree;
pub mod design;
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
pub mod run;
pub mod schedule;
pub mod stages;
pub mod structure;
pub mod surface;
pub mod validity;
pub mod words;

pub use error::{Error, Result};
pub use glam::{DVec2, DVec3};
