//! Candidates against one another: all are annealed, then polished in heats that fewer and fewer come through,
//! the last ones are relaxed to the end, and the one of highest merit wins.

use super::starts::Start;
use crate::balance::{self, balance};
use crate::grid::Grid;
use crate::job::Job;
use crate::merit::Sums;
use crate::recipe::{Recipe, RegularizeMethod, RelaxMethod};
use crate::run::CandidateReport;
use crate::stages::measure::{Border, bridging_members, is_folded};
use crate::stages::{regularize, relax, triangulate};
use crate::surface::Surface;
use crate::validity::NEAREST;
use glam::DVec3;
use rayon::prelude::*;

/// The first search's share of the time that regularizing takes; about, for progress only.
const SEARCH_SHARE: f64 = 0.3;

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
    /// How many heats it came through.
    pub heats: usize,
    sums: Sums,
    merit: f64,
}

/// A candidate that was relaxed to the end.
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
    /// How many members and panels it has that no valid grid has.
    pub flaws: usize,
    /// By what it is ranked among those.
    pub merit: f64,
}

/// Regularize every triangulated start. The best first; those of the search that came through all heats lead.
pub fn regularize(
    surface: &Surface,
    starts: &[Start],
    triangulated: &[(Grid, triangulate::Report)],
    length: f64,
    recipe: &Recipe,
    job: &Job,
) -> Vec<Candidate> {
    let searched = recipe.regularize.method == RegularizeMethod::Search;
    let spans = spans(recipe, triangulated.len());
    let mut candidates: Vec<Candidate> = triangulated
        .par_iter()
        .zip(starts)
        .enumerate()
        .map(|(start, ((grid, _), Start { seed, .. }))| {
            let job = job.of_candidate(start, spans[0]);
            let (mut grid, report) =
                regularize::regularize(surface, grid.clone(), length, recipe, *seed, &job);
            if searched {
                settle(surface, &mut grid, recipe, &job);
            }
            Candidate::new(surface, start, grid, report, length, recipe)
        })
        .collect();
    rank(&mut candidates);
    if !searched {
        return candidates;
    }
    for (heat, &[through, trials]) in recipe.regularize.heats.iter().enumerate() {
        if job.stopped() {
            break;
        }
        let through = through.clamp(1, candidates.len());
        candidates[..through].par_iter_mut().for_each(|c| {
            let seed = starts[c.start].seed.wrapping_add(heat as u64 + 1);
            let own = own_recipe(recipe, c.start);
            let job = job.of_candidate(c.start, spans[heat + 1]);
            let (grid, report) =
                regularize::polish(surface, c.grid.clone(), length, &own, trials, seed, &job);
            let polished =
                Candidate::new(surface, c.start, grid, c.report.and(&report), length, recipe);
            // Polishing gives back the best it met, up to the last balance.
            if polished.merit >= c.merit {
                *c = polished;
            }
            c.heats = heat + 1;
        });
        rank(&mut candidates);
        let best = &candidates[0];
        let job = job.of_candidate(best.start, spans[heat + 1]);
        job.progress("regularize", 1.0, best.grid.picture());
    }
    candidates
}

/// Where in the stage the first search and each of the heats begin and end, by the trials that they make.
fn spans(recipe: &Recipe, candidates: usize) -> Vec<[f64; 2]> {
    let heats = &recipe.regularize.heats;
    let polish = heats.iter().map(|&[through, trials]| (through.min(candidates) * trials) as f64);
    let polish: Vec<f64> = polish.collect();
    let all: f64 = polish.iter().sum();
    let search = if all > 0.0 { SEARCH_SHARE } else { 1.0 };
    let mut spans = vec![[0.0, search]];
    for trials in polish {
        let from = spans[spans.len() - 1][1];
        spans.push([from, from + (1.0 - SEARCH_SHARE) * trials / all.max(1.0)]);
    }
    spans
}

/// Relax the candidates that came furthest; the best first.
pub fn relax(
    surface: &Surface,
    candidates: &[Candidate],
    length: f64,
    recipe: &Recipe,
    job: &Job,
) -> Vec<Winner> {
    let Some(furthest) = candidates.first().map(|c| c.heats) else { return Vec::new() };
    // Of a job that was stopped nobody waits for the others.
    let many = if job.stopped() { 1 } else { FINALISTS };
    let finalists: Vec<&Candidate> =
        candidates.iter().take_while(|c| c.heats == furthest).take(many).collect();
    let mut relaxed: Vec<Winner> = finalists
        .into_par_iter()
        .flat_map_iter(|c| {
            let small = c.grid.mesh.vertex_count() <= MOST_WITH_ENDS;
            let several = recipe.relax.method == RelaxMethod::Fluent && c.heats > 0 && small;
            let several = several && !job.stopped();
            let ends = if several { &ENDS[..] } else { &ENDS[..1] };
            ends.iter().map(move |end| {
                let mut own = own_recipe(recipe, c.start);
                own.border *= end[0];
                own.relax.straightness *= end[1];
                let mut grid = c.grid.clone();
                let job = job.of_candidate(c.start, [0.0, 1.0]);
                let relaxed = relax::relax(surface, &mut grid, &own, &job);
                let sums = Sums::whole(&grid, surface, length, recipe.measure.lambda);
                Winner {
                    start: c.start,
                    before: c.grid.clone(),
                    regularized: c.report,
                    flaws: flaws(&grid, surface, length),
                    merit: sums.merit(recipe.measure.lambda),
                    grid,
                    relaxed,
                }
            })
        })
        .collect();
    // A stable sort: of equals the first, as candidates come best first.
    relaxed.sort_by(|a, b| a.flaws.cmp(&b.flaws).then(b.merit.total_cmp(&a.merit)));
    relaxed
}

/// Members and panels that no valid grid has.
fn flaws(grid: &Grid, surface: &Surface, length: f64) -> usize {
    let normals: Vec<DVec3> = grid.places.iter().map(|p| p.normal(surface)).collect();
    let folded = |t: &[u32; 3]| is_folded(grid, |v| normals[v as usize], *t);
    let short = |&(a, b): &(u32, u32)| grid.scaled_length(surface, a, b) < NEAREST * length;
    bridging_members(grid, surface, length)
        + grid.mesh.triangles().filter(folded).count()
        + grid.mesh.edges().filter(short).count()
}

/// Candidates that are relaxed to the end.
const FINALISTS: usize = 4;

/// What the weights of border and straightness are multiplied by for the relaxations that a finalist gets. What
/// suits one shape best is a little too much for another: merit decides.
const ENDS: [[f64; 2]; 4] = [[1.0, 1.0], [1.5, 1.0], [1.0, 0.6], [1.0, 1.6]];

/// Larger grids get the first end only: among ten thousand nodes the others won a hundredth of Q at most.
const MOST_WITH_ENDS: usize = 5000;

/// Every other candidate is polished with less weight on the border, which frees the lines inside.
const LESS_BORDER: f64 = 0.2;

fn own_recipe(recipe: &Recipe, start: usize) -> Recipe {
    let share = if start % 2 == 1 && recipe.border <= 0.5 { LESS_BORDER } else { 1.0 };
    Recipe { border: recipe.border * share, ..recipe.clone() }
}

/// The furthest first, and of those the best. A stable sort: equals stay in their order.
fn rank(candidates: &mut [Candidate]) {
    candidates.sort_by(|a, b| b.heats.cmp(&a.heats).then(b.merit.total_cmp(&a.merit)));
}

impl Candidate {
    fn new(
        surface: &Surface,
        start: usize,
        grid: Grid,
        report: regularize::Report,
        length: f64,
        recipe: &Recipe,
    ) -> Candidate {
        let sums = Sums::whole(&grid, surface, length, recipe.measure.lambda);
        let merit = sums.merit(recipe.measure.lambda);
        Candidate { start, grid, report, sums, heats: 0, merit }
    }
}

/// The table of all candidates, the winner's first.
pub fn table(
    candidates: Vec<Candidate>,
    winner: usize,
    starts: &[Start],
    recipe: &Recipe,
) -> Vec<CandidateReport> {
    let report = |c: Candidate| CandidateReport {
        part: None,
        seed: starts[c.start].seed,
        start: starts[c.start].kind(),
        heats: c.heats,
        merit: c.merit,
        fluency: c.sums.fluency(recipe.measure.lambda),
        mu: c.sums.mu(),
        delta_deg: c.sums.delta_deg(),
        cv: c.sums.members.cv(),
        mean_length_ratio: c.sums.members.mean(),
        border: Border {
            shape_mean: c.sums.border_shape_mean(),
            edge_length_cv: c.sums.border_members.cv(),
        },
        grid: c.grid,
    };
    let (kept, left): (Vec<_>, Vec<_>) = candidates.into_iter().partition(|c| c.start == winner);
    kept.into_iter().chain(left).map(report).collect()
}

fn settle(surface: &Surface, grid: &mut Grid, recipe: &Recipe, job: &Job) {
    let options = balance::Options {
        straightness: recipe.relax.straightness,
        border: recipe.border_weight(),
        settled: 1e-3,
        max_steps: TRIAL_STEPS,
        accuracy: 0.05,
    };
    balance(surface, grid, &options, &job.part_of("regularize"));
}
