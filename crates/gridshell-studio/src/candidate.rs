//! A candidate that was not the best, taken all the same.

use crate::laid::Laid;
use gridshell::error::{Error, Result};
use gridshell::grid::Grid;
use gridshell::job::Job;
use gridshell::pipeline;
use gridshell::run::{Run, StageReport};
use gridshell::schedule::{Schedule, Tolerances};
use gridshell::stages::measure::{irregular_nodes, measure};
use gridshell::stages::relax::relax;
use gridshell::validity::Validity;
use std::time::Instant;

/// Candidates that are shown.
const SHOWN: usize = 12;

/// The grids of a run's first candidates.
pub fn grids(laid: &Laid) -> impl Iterator<Item = &Grid> {
    laid.run.iter().flat_map(|run| &run.candidates).take(SHOWN).map(|c| &c.grid)
}

/// The grid of one of them.
///
/// # Errors
/// [`Error::Option`] where there is none.
pub fn grid(laid: &Laid, index: u32) -> Result<&Grid> {
    let found = grids(laid).nth(index as usize);
    found.ok_or_else(|| Error::Option(format!("there is no candidate {}", index + 1)))
}

/// The run as if candidate `index` had been the best: relaxed by the recipe, and put on the exact surface.
///
/// # Errors
/// [`Error::Option`] where the candidate is a part of a grid only, or the job was stopped.
pub fn taken(laid: &Laid, index: u32, job: &Job) -> Result<Run> {
    let mut grid = grid(laid, index)?.clone();
    let run = laid.run.as_ref().expect("it has candidates");
    if !run.parts.is_empty() || run.symmetry.is_some() {
        let message =
            "candidates of symmetric grids and of several parts are pieces of a grid only";
        return Err(Error::Option(message.into()));
    }
    let (surface, _) = pipeline::surface(&laid.opened.model, &run.recipe, job)?;
    let options = &run.recipe.measure;
    let judge = |grid: &Grid| measure(grid, &surface, run.edge_length, options);
    let stage = |name, seconds, converged, grid: &Grid| StageReport {
        name,
        seconds,
        converged,
        quality: Some(judge(grid)),
        notes: Vec::new(),
        grid: Some(grid.clone()),
    };
    let regularized = stage("regularize", 0.0, true, &grid);
    let clock = Instant::now();
    let report = relax(&surface, &mut grid, &run.recipe, job);
    if job.stopped() {
        return Err(Error::Option("it was stopped".into()));
    }
    grid.settle_exactly(&surface);
    let relaxed = stage("relax", clock.elapsed().as_secs_f64(), report.converged, &grid);
    let quality = judge(&grid);
    let validity = Validity::of(&grid, &surface, run.edge_length, &quality);
    let places = gridshell::surface::Origin::default();
    pipeline::refuse_invalid(&validity, &run.recipe, places, run.edge_length, &Job::default())?;
    let schedule = Schedule::new(&grid, &surface, &Tolerances::from(options));
    let mut candidates = run.candidates.clone();
    candidates[..=index as usize].rotate_right(1);
    Ok(Run {
        candidates,
        quality,
        valid: validity.is_valid(),
        faults: validity.faults,
        figures: schedule.figures.clone(),
        irregular: irregular_nodes(&grid, run.origin),
        stages: vec![regularized, relaxed],
        stopped: false,
        schedule,
        grid,
        ..run.clone()
    })
}
