//! The whole method: the only place that knows the order of the stages.
//!
//! Several starts (lattices drawn at random and judged in a quick run, or bubble packings) go through
//! triangulate and regularize side by side; the best grid by [`crate::merit`] is relaxed and put on the exact surface.
//! Every choice is seeded by the recipe and the place in its list, so the grid is the same for any number of
//! threads. A job that is stopped still ends with the best grid so far.

mod contest;
mod effort;
mod missing;
mod narrow;
mod parts;
mod places;
mod repair;
mod smoothing;
mod starts;
mod symmetry;
mod taken;
mod verdict;
mod wishes;

use crate::error::{Error, Result};
use crate::grid::Grid;
use crate::job::Job;
use crate::math::digits::three;
use crate::recipe::{Recipe, Symmetry};
use crate::run::{CandidateReport, Run, SCHEMA, StageReport, SurfaceSummary};
use crate::schedule::{Schedule, Tolerances};
use crate::stages::measure::{Quality, irregular_nodes, measure};
use crate::stages::triangulate;
use crate::surface::{Chain, Model, Ruler, Sampling, Surface, builtin};
use crate::validity::Validity;
pub use missing::check_whole;
use places::local;
use rayon::prelude::*;
pub use smoothing::smoothed;
use starts::{Start, Starts};
use std::sync::Arc;
use std::time::Instant;
pub use taken::take;
use verdict::Verdict;

/// Chord error of the carrier over l0. Nodes end on the exact surface; until then they may be this far off.
const CARRIER_CHORD: f64 = 2e-3;
/// Memory that a run takes for each node, bytes: less than what was seen, so that nothing is refused that would go.
const BYTES_A_NODE: f64 = 1500.0;
/// Of a run that was stopped, larger grids of the stages before the last are not measured: it is to end within a second.
const MOST_MEASURED_LATE: usize = 20_000;
/// Nodes of a grid whose edge length nobody gave.
const SENSIBLE_NODES: usize = 1000;

/// Lay a grid on `model`.
///
/// # Errors
/// [`Error::Option`] for a recipe that makes no sense, [`Error::Surface`] for a model that is not a surface or has
/// several parts of which the recipe chooses none or of which too much could not be read, [`Error::NoGrid`] and
/// [`Error::Invalid`] where no valid grid of this edge length exists or was found.
pub fn generate(model: &Model, recipe: &Recipe, job: &Job) -> Result<Run> {
    Ok(generate_on(model, recipe, job)?.0)
}

/// As [`generate`]; the surface that the grid was laid on is given too.
///
/// # Errors
/// As [`generate`].
pub fn generate_on(model: &Model, recipe: &Recipe, job: &Job) -> Result<(Run, Surface)> {
    recipe.validate()?;
    check_whole(model, recipe, job)?;
    let (run, surface) =
        parts::generate(&*smoothed(model, recipe, job)?, &local(recipe, model.origin()), job)?;
    // As it was given, but for what turned out on the way.
    let skip_parts = run.recipe.skip_parts.clone();
    Ok((Run { recipe: Recipe { skip_parts, ..recipe.clone() }, ..run }, surface))
}

/// Lay a grid on a model of one part; the surface that it was laid on is given too.
fn single(model: &Model, recipe: &Recipe, job: &Job) -> Result<(Run, Surface)> {
    let Scale { length, nodes } = scale(model, recipe, job)?;
    job.reserve(nodes * BYTES_A_NODE, &format!("a grid of about {nodes:.0} nodes"))?;
    let make = |l: f64| model.surface(&sampling(l, nodes, recipe), job);
    let (surface, mut fixed) = wishes::surface(recipe, length, make, job)?;
    narrow::check(&surface, length)?;
    let size = Scale { length, nodes };
    if let Some(found) = symmetry::group(&surface, model, recipe, length, job)? {
        let told = fixed.clone();
        match symmetry::generate(model, &surface, &found, recipe, &size, told, job) {
            // Nobody asked for this very symmetry.
            Err(why @ (Error::NoGrid { .. } | Error::Invalid { .. }))
                if recipe.symmetry == Symmetry::Auto =>
            {
                fixed
                    .push(format!("the grid has no symmetry, as one that has is not valid: {why}"));
            }
            run => return Ok((run?, surface)),
        }
    } else if recipe.symmetry != Symmetry::None {
        fixed.push("no symmetry was found: the grid has none".into());
    }
    let run = lay(model, &surface, recipe, &size, fixed, job)?;
    Ok((run, surface))
}

/// The surface that [`generate`] lays its grid on, and the wanted member length in metres.
///
/// # Errors
/// As [`generate`].
pub fn surface(model: &Model, recipe: &Recipe, job: &Job) -> Result<(Surface, f64)> {
    recipe.validate()?;
    parts::surface(&*smoothed(model, recipe, job)?, &local(recipe, model.origin()), job)
}

/// The surface of a model of one part, and the wanted member length in metres.
fn whole(model: &Model, recipe: &Recipe, job: &Job) -> Result<(Surface, f64)> {
    let Scale { length, nodes } = scale(model, recipe, job)?;
    let make = |l: f64| model.surface(&sampling(l, nodes, recipe), job);
    let (surface, _) = wishes::surface(recipe, length, make, job)?;
    Ok((surface, length))
}

/// Lay a grid on a surface that was made from `model`; `fixed` is what the user should know of what is fixed on it.
fn lay(
    model: &Model,
    surface: &Surface,
    recipe: &Recipe,
    &Scale { length, nodes }: &Scale,
    fixed: Vec<String>,
    job: &Job,
) -> Result<Run> {
    let budget = effort::budgeted(recipe, nodes);
    let mut stages = Vec::new();
    let judge = |grid: &Grid| measure(grid, surface, length, &recipe.measure);
    let judge_on_the_way = |grid: &Grid| {
        let skipped = job.stopped() && grid.xyz.len() > MOST_MEASURED_LATE;
        (!skipped).then(|| judge(grid))
    };

    let clock = Instant::now();
    let Starts { starts, notes } = starts::starts(surface, length, &budget, job)?;
    let packed = clock.elapsed().as_secs_f64();

    let clock = Instant::now();
    let triangulated: Vec<(Grid, triangulate::Report)> = starts
        .par_iter()
        .map(|start| match &start.grid {
            Some(connected) => Ok(connected.clone()),
            None => triangulate::triangulate(surface, &start.bubbles, job),
        })
        .collect::<Result<_>>()?;
    let triangulated_in = clock.elapsed().as_secs_f64();

    let clock = Instant::now();
    let candidates = contest::regularize(surface, &starts, &triangulated, length, &budget, job);
    let regularized_in = clock.elapsed().as_secs_f64();
    let clock = Instant::now();
    let relaxed = contest::relax(surface, &candidates, length, &budget, job);
    let Some(Verdict { winner, quality, validity, repaired }) =
        verdict::soundest(surface, relaxed, length, &budget, job)
    else {
        return Err(Error::Surface("the surface has no room for a single node".into()));
    };
    let table = contest::table(candidates, winner.start, &starts, recipe);
    let relaxed_in = clock.elapsed().as_secs_f64();

    let Start { report: settled, bubbles, .. } = &starts[winner.start];
    let (grid, report) = &triangulated[winner.start];
    let mut warnings = fixed;
    warnings.extend(self::warnings(surface, bubbles.len(), report));
    // Bubbles have no members yet: what is measured, as in the paper's Table 3, is their Delaunay grid.
    let packed_quality = judge_on_the_way(grid);
    stages.push(StageReport {
        name: "pack",
        seconds: packed,
        converged: settled.is_none_or(|r| r.converged),
        quality: packed_quality.clone(),
        notes,
        grid: Some(exact(grid.clone(), surface)),
    });
    stages.push(StageReport {
        name: "triangulate",
        seconds: triangulated_in,
        converged: !report.work.cut_short,
        quality: packed_quality,
        notes: report.work.note().into_iter().collect(),
        grid: Some(exact(grid.clone(), surface)),
    });
    stages.push(StageReport {
        name: "regularize",
        seconds: regularized_in,
        converged: winner.regularized.converged,
        quality: judge_on_the_way(&winner.before),
        notes: vec![winner.regularized.to_string()],
        grid: Some(exact(winner.before, surface)),
    });
    let grid = winner.grid;
    stages.push(StageReport {
        name: "relax",
        seconds: relaxed_in,
        converged: winner.relaxed.converged,
        quality: Some(quality.clone()),
        notes: std::iter::once(format!(
            "{} steps, last move {:.1e} l0",
            winner.relaxed.steps, winner.relaxed.last_move
        ))
        .chain(repaired)
        .collect(),
        grid: Some(grid.clone()),
    });
    warnings.extend(narrow::warnings(surface, &grid, length));
    finish(model, surface, recipe, length, table, stages, warnings, quality, validity, grid, job)
}

#[expect(clippy::too_many_arguments, reason = "the parts of a run, gathered once")]
fn finish(
    model: &Model,
    surface: &Surface,
    recipe: &Recipe,
    length: f64,
    candidates: Vec<CandidateReport>,
    stages: Vec<StageReport>,
    warnings: Vec<String>,
    quality: Quality,
    validity: Validity,
    grid: Grid,
    job: &Job,
) -> Result<Run> {
    verdict::check(&validity, recipe, surface.origin, length, job)?;
    let mut warnings = warnings;
    warnings.extend(validity.warnings());
    warnings.extend(verdict::node_count(recipe, quality.nodes));
    let schedule = Schedule::new(&grid, surface, &Tolerances::from(&recipe.measure));
    Ok(Run {
        schema: SCHEMA,
        version: env!("CARGO_PKG_VERSION"),
        seed: recipe.seed,
        units: "m",
        surface: SurfaceSummary::new(model, surface),
        edge_length: length,
        recipe: recipe.clone(),
        symmetry: None,
        parts: Vec::new(),
        failed: Vec::new(),
        candidates,
        stages,
        irregular: irregular_nodes(&grid, surface.origin),
        quality,
        figures: schedule.figures.clone(),
        valid: validity.is_valid(),
        faults: validity.faults,
        warnings,
        stopped: job.stopped(),
        origin: surface.origin,
        grid: Arc::new(grid),
        schedule: Arc::new(schedule),
    })
}

fn exact(mut grid: Grid, surface: &Surface) -> Grid {
    grid.settle_exactly(surface);
    grid
}

fn warnings(surface: &Surface, wanted: usize, report: &triangulate::Report) -> Vec<String> {
    let mut warnings: Vec<String> = report
        .added
        .iter()
        .map(|p| {
            format!(
                "a node was added near {}: the surface is narrower there than a member",
                surface.origin.told(*p)
            )
        })
        .collect();
    if report.work.cut_short {
        warnings.push(
            "the surface's own triangles are so thin that connecting nodes was cut short: repair or simplify it, or ask for longer members"
                .into(),
        );
    }
    if wanted < 4 * surface.loops.len() {
        warnings.push("the wanted length is large for this surface; expect a coarse grid".into());
    }
    warnings
}

/// The carrier that suits about `nodes` nodes with members of `length` metres.
fn sampling(length: f64, nodes: f64, recipe: &Recipe) -> Sampling {
    Sampling {
        max_edge: effort::carrier_edge(nodes) * length,
        chord_error: CARRIER_CHORD * length,
        corner_angle: recipe.corner_angle_deg.to_radians(),
    }
}

/// The wanted length in metres: as given, or from the number of nodes, or a sensible one.
///
/// # Errors
/// [`Error::Option`] as [`Recipe::check_edge_length`], [`Error::Surface`] as
/// [`Model::surface`].
pub fn edge_length(model: &Model, recipe: &Recipe, job: &Job) -> Result<f64> {
    Ok(scale(model, &local(recipe, model.origin()), job)?.length)
}

/// How large a grid is.
struct Scale {
    /// Wanted length, metres.
    length: f64,
    /// About how many nodes that makes.
    nodes: f64,
}

fn scale(model: &Model, recipe: &Recipe, job: &Job) -> Result<Scale> {
    scale_on(model.surface(&rough(model.size(), recipe), job)?, recipe)
}

/// The sampling that areas and lengths are estimated with, for a model of this size.
fn rough(size: f64, recipe: &Recipe) -> Sampling {
    Sampling {
        max_edge: 0.02 * size,
        chord_error: 1e-3 * size,
        corner_angle: recipe.corner_angle_deg.to_radians(),
    }
}

fn scale_on(mut surface: Surface, recipe: &Recipe) -> Result<Scale> {
    let mean = wishes::grade(&mut surface, recipe, recipe.edge_length);
    let length = match (mean.or(recipe.edge_length), recipe.nodes) {
        (Some(length), _) => length,
        (None, Some(nodes)) => length_for(&surface, nodes),
        (None, None) => builtin::ALL
            .iter()
            .find(|b| b.name == surface.name)
            .map_or_else(|| length_for(&surface, SENSIBLE_NODES), |b| b.edge_length),
    };
    let given = mean.or(recipe.edge_length).is_some();
    Recipe::check_edge_length(length, surface.area).map_err(|e| match recipe.nodes {
        Some(nodes) if !given => too_narrow(nodes, &surface),
        _ => e,
    })?;
    Ok(Scale { length, nodes: nodes_for(&surface, length) })
}

/// A surface whose boundary alone would take so many nodes.
fn too_narrow(nodes: usize, surface: &Surface) -> Error {
    let boundary: f64 = surface.loops.iter().map(Chain::length).sum();
    Error::Surface(format!(
        "no members make about {nodes} nodes on a surface of {} m2 whose boundary is {} m long: if these figures are \
         not what was drawn, repair the file in the program that made it; otherwise give an edge length",
        three(surface.area),
        three(boundary)
    ))
}

/// About how many nodes members of `length` metres make: n = A / (2 A0) + n_b / 2 + chi (Eq. 1 with the
/// boundary).
fn nodes_for(surface: &Surface, length: f64) -> f64 {
    let (area, rim) = room(surface);
    area / (length * length) + rim / length + surface.euler_characteristic() as f64
}

/// The edge length, metres, that makes about `nodes` nodes on `surface`.
pub fn length_for(surface: &Surface, nodes: usize) -> f64 {
    let (area, rim) = room(surface);
    let count = (nodes as f64 - surface.euler_characteristic() as f64).max(3.0);
    // count = area / l^2 + rim / l, solved for 1 / l.
    let inverse = ((rim * rim + 4.0 * area * count).sqrt() - rim) / (2.0 * area);
    1.0 / inverse
}

/// Twice the panels' share of the area, and half the boundary, in units of local lengths.
fn room(surface: &Surface) -> (f64, f64) {
    let rim = surface.loops.iter().map(|l| 0.5 * Ruler::new(surface, l).whole()).sum();
    (surface.room() * 2.0 / 3f64.sqrt(), rim)
}
