//! A candidate that was not the best, taken all the same.

use super::verdict;
use crate::error::{Error, Result};
use crate::grid::Grid;
use crate::job::Job;
use crate::run::{Run, StageReport};
use crate::schedule::{Schedule, Tolerances};
use crate::stages::measure::{irregular_nodes, measure};
use crate::stages::relax::relax;
use crate::surface::{Origin, Surface};
use crate::validity::Validity;
use std::sync::Arc;
use std::time::Instant;

/// The run on `surface` as if candidate `index` had been the best: relaxed by the recipe, and put on the exact surface.
///
/// # Errors
/// [`Error::Option`] where there is no such candidate, or it is a part of a grid only; [`Error::Stopped`];
/// [`Error::Invalid`] where no valid grid comes of it.
pub fn take(run: &Run, surface: &Surface, index: usize, job: &Job) -> Result<Run> {
    let found = run.candidates.get(index);
    let found =
        found.ok_or_else(|| Error::Option(format!("there is no candidate {}", index + 1)))?;
    if !run.parts.is_empty() || run.symmetry.is_some() {
        let message =
            "candidates of symmetric grids and of several parts are pieces of a grid only";
        return Err(Error::Option(message.into()));
    }
    let mut grid = found.grid.clone();
    let options = &run.recipe.measure;
    let judge = |grid: &Grid| measure(grid, surface, run.edge_length, options);
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
    let report = relax(surface, &mut grid, &run.recipe, job);
    job.check("relaxing")?;
    grid.settle_exactly(surface);
    let relaxed = stage("relax", clock.elapsed().as_secs_f64(), report.converged, &grid);
    let quality = judge(&grid);
    let validity = Validity::of(&grid, surface, run.edge_length, &quality);
    // What the run's recipe fixes stands in the coordinates of its file.
    verdict::check(&validity, &run.recipe, Origin::default(), run.edge_length, job)?;
    let schedule = Schedule::new(&grid, surface, &Tolerances::from(options));
    let mut candidates = run.candidates.clone();
    candidates[..=index].rotate_right(1);
    Ok(Run {
        candidates,
        quality,
        valid: validity.is_valid(),
        faults: validity.faults,
        figures: schedule.figures.clone(),
        irregular: irregular_nodes(&grid, run.origin),
        stages: vec![regularized, relaxed],
        stopped: false,
        schedule: Arc::new(schedule),
        grid: Arc::new(grid),
        ..run.clone()
    })
}
