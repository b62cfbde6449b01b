//! A candidate that was not the best, taken all the same.

use crate::laid::Laid;
use gridshell::design::Design;
use gridshell::error::{Error, Result};
use gridshell::grid::Grid;
use gridshell::job::Job;
use gridshell::pipeline;
use std::sync::Arc;

/// Candidates that are shown.
const SHOWN: usize = 12;

/// The grids of a run's first candidates.
pub fn grids(laid: &Laid) -> impl Iterator<Item = &Grid> {
    laid.design.run.iter().flat_map(|run| &run.candidates).take(SHOWN).map(|c| &c.grid)
}

/// The grid of one of them.
///
/// # Errors
/// [`Error::Option`] where there is none.
pub fn grid(laid: &Laid, index: u32) -> Result<&Grid> {
    let found = grids(laid).nth(index as usize);
    found.ok_or_else(|| none(index))
}

/// The design as if candidate `index` had been the best.
///
/// # Errors
/// As [`pipeline::take`].
pub fn taken(laid: &Laid, index: u32, job: &Job) -> Result<Design> {
    let Design { run, surface, .. } = &laid.design;
    let run = run.as_ref().ok_or_else(|| none(index))?;
    let taken = pipeline::take(run, surface, index as usize, job)?;
    Ok(Design::of_run(taken, Arc::clone(surface)))
}

fn none(index: u32) -> Error {
    Error::Option(format!("there is no candidate {}", index + 1))
}
