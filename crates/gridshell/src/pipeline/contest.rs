//! Candidates against one another: all are regularized, the best are relaxed to the end, one wins.

use super::score;
use super::starts::Start;
use crate::balance::{self, balance};
use crate::grid::Grid;
use crate::job::Job;
use crate::recipe::{Recipe, RegularizeMethod};
use crate::stages::measure::compare;
use crate::stages::{regularize, relax, triangulate};
use crate::surface::Surface;
use rayon::prelude::*;

/// Steps of balancing before candidates are compared.
const TRIAL_STEPS: usize = 4;

/// One candidate.
pub struct Candidate {
    /// Place of its start in the list.
    pub start: usize,
    /// Its grid, regularized.
    pub grid: Grid,
    /// What regularizing did.
    pub report: regularize::Report,
    points: f64,
}

/// The candidate that won.
pub struct Winner {
    /// Place of its start in the list.
    pub start: usize,
    /// Its grid before relaxing.
    pub before: Grid,
    /// What regularizing did.
    pub regularized: regularize::Report,
    /// Its grid, relaxed.
    pub grid: Grid,
    /// What relaxing did.
    pub relaxed: relax::Report,
    points: f64,
}

/// Regularize every triangulated start; of a search, give only the finalists. The best first.
pub fn regularize(
    surface: &Surface,
    starts: &[Start],
    triangulated: &[(Grid, triangulate::Report)],
    length: f64,
    recipe: &Recipe,
    job: &Job,
) -> Vec<Candidate> {
    let points = |grid: &Grid| score(&compare(grid, surface, length, &recipe.measure));
    let mut candidates: Vec<Candidate> = triangulated
        .par_iter()
        .zip(starts)
        .enumerate()
        .map(|(start, ((grid, _), Start { seed, .. }))| {
            let (grid, report) =
                regularize::regularize(surface, grid.clone(), length, recipe, *seed, job);
            let mut balanced = grid.clone();
            settle(surface, &mut balanced, recipe);
            let points = points(&balanced);
            let searched = recipe.regularize.method == RegularizeMethod::Search;
            let grid = if searched { balanced } else { grid };
            Candidate { start, grid, report, points }
        })
        .collect();
    // A stable sort: equals stay in the order of their starts.
    candidates.sort_by(|a, b| b.points.total_cmp(&a.points));
    if recipe.regularize.method == RegularizeMethod::Paper {
        return candidates;
    }
    candidates.truncate(recipe.regularize.finalists.max(1));
    candidates
}

/// Relax the candidates; the best wins.
pub fn relax(
    surface: &Surface,
    candidates: Vec<Candidate>,
    length: f64,
    recipe: &Recipe,
    job: &Job,
) -> Option<Winner> {
    let relaxed: Vec<Winner> = candidates
        .into_par_iter()
        .map(|Candidate { start, grid: before, report: regularized, .. }| {
            let trials: usize = std::env::var("POLISH").ok().and_then(|s| s.parse().ok()).unwrap_or(0);
            let merit = |g: &Grid| crate::merit::Sums::whole(g, surface, length, recipe.measure.lambda);
            let m0 = merit(&before);
            let clock = std::time::Instant::now();
            let (mut grid, rep) = regularize::polish(surface, before.clone(), length, recipe, trials, start as u64, job);
            let m1 = merit(&grid);
            eprintln!("{start} merit {:.3} Q {:.3} mu {:.3} -> {:.3} Q {:.3} mu {:.3} r {:.4} {rep} {:.2}s", m0.merit(0.9), m0.fluency(0.9).unwrap_or(0.), m0.mu(), m1.merit(0.9), m1.fluency(0.9).unwrap_or(0.), m1.mu(), m1.members.cv(), clock.elapsed().as_secs_f64());
            let relaxed = relax::relax(surface, &mut grid, &recipe.relax, job);
            let points = score(&compare(&grid, surface, length, &recipe.measure));
            Winner { start, before, regularized, grid, relaxed, points }
        })
        .collect();
    // The first of equals: candidates come best first.
    relaxed.into_iter().rev().max_by(|a, b| a.points.total_cmp(&b.points))
}

fn settle(surface: &Surface, grid: &mut Grid, recipe: &Recipe) {
    let options = balance::Options {
        straightness: recipe.relax.straightness,
        settled: 1e-3,
        max_steps: TRIAL_STEPS,
        accuracy: 0.05,
    };
    balance(surface, grid, &options, &Job::default());
}
