//! Regularize (Section 5): change connectivity so that fewer nodes are irregular.

mod local;
mod paper;
mod polish;
mod search;
mod state;

use crate::grid::Grid;
use crate::job::Job;
use crate::recipe::{Recipe, RegularizeMethod};
use crate::surface::Surface;

pub(crate) use local::{Aim, Local};
pub(crate) use paper::path as drift_path;
pub(crate) use polish::heal;
pub(crate) use search::{Operation, estimate};
pub(crate) use state::{Few, State};

/// What regularizing did.
#[derive(Clone, Copy, Debug, Default)]
pub struct Report {
    /// Edges flipped.
    pub flips: usize,
    /// Edges collapsed.
    pub collapses: usize,
    /// Edges split.
    pub splits: usize,
    /// Pairs drifted.
    pub drifts: usize,
    /// Operations refused by topology, node range or panel shape, or found to be worse.
    pub refused: usize,
    /// No operation is left that the method would make.
    pub converged: bool,
}

impl Report {
    /// This and another report of the same grid, one after the other.
    #[must_use]
    pub fn and(&self, next: &Report) -> Report {
        Report {
            flips: self.flips + next.flips,
            collapses: self.collapses + next.collapses,
            splits: self.splits + next.splits,
            drifts: self.drifts + next.drifts,
            refused: self.refused + next.refused,
            converged: self.converged && next.converged,
        }
    }
}

impl std::fmt::Display for Report {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        write!(
            f,
            "{} flips, {} collapses, {} splits, {} drifts, {} refused",
            self.flips, self.collapses, self.splits, self.drifts, self.refused
        )
    }
}

/// Regularize a grid for members of `length` metres by the recipe's method.
pub fn regularize(
    surface: &Surface,
    grid: Grid,
    length: f64,
    recipe: &Recipe,
    seed: u64,
    job: &Job,
) -> (Grid, Report) {
    let mut state = State::new(surface, grid, length, recipe.measure.lambda);
    let report = match recipe.regularize.method {
        RegularizeMethod::Paper => paper::algorithm1(&mut state, &recipe.regularize, job),
        RegularizeMethod::Search => {
            search::anneal(&mut state, &recipe.regularize, recipe.pack.k_n, seed, job)
        }
    };
    (state.into_grid(), report)
}

/// Polish a regularized grid by its merit, in so many trials.
pub fn polish(
    surface: &Surface,
    grid: Grid,
    length: f64,
    recipe: &Recipe,
    trials: usize,
    seed: u64,
    job: &Job,
) -> (Grid, Report) {
    let mut state = State::new(surface, grid, length, recipe.measure.lambda);
    let report = polish::polish(&mut state, recipe, trials, seed, job);
    (state.into_grid(), report)
}
