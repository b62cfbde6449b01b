//! The bubbles that candidates start from.

use crate::balance::{self, balance};
use crate::bubbles::Bubbles;
use crate::error::Result;
use crate::grid::Grid;
use crate::job::Job;
use crate::merit::Sums;
use crate::recipe::{self, Recipe};
use crate::stages::{pack, triangulate};
use crate::surface::{Surface, chart::Chart, fields::bends::sharp_bends};
use pack::lattice::Lattice;
use rayon::prelude::*;

/// One start.
pub struct Start {
    /// Where the bubbles are.
    pub bubbles: Bubbles,
    /// Seed for what follows.
    pub seed: u64,
    /// How they settled, where they did.
    pub report: Option<pack::Report>,
    /// Their grid, where they were judged by it, and what connecting them did.
    pub grid: Option<(Grid, triangulate::Report)>,
}

impl Start {
    /// Where the bubbles came from: only packings settle.
    pub fn kind(&self) -> recipe::Start {
        if self.report.is_some() { recipe::Start::Random } else { recipe::Start::Lattice }
    }
}

/// The starts of all candidates, and what is to be said about them.
pub struct Starts {
    /// At least one.
    pub starts: Vec<Start>,
    /// For the user.
    pub notes: Vec<String>,
}

/// The stage from its beginning to its end.
const WHOLE: [f64; 2] = [0.0, 1.0];

/// Draws of a lattice are judged after this many steps of balancing.
const TRIAL_STEPS: usize = 3;

/// Random bubbles start no nearer to a boundary bubble than this, over l0.
const CLEAR: f64 = 0.6;

/// A lattice that is to follow a direction is off it by at most this angle (one degree), radians.
const SWAY: f64 = std::f64::consts::PI / 180.0;

/// Mean strain of a chart beyond which lattices laid on it are poor starts.
const STRAINED: f64 = 0.03;

/// The starts that the recipe asks for; bubbles where a lattice is wanted but the surface has no chart.
pub fn starts(surface: &Surface, length: f64, recipe: &Recipe, job: &Job) -> Result<Starts> {
    if recipe.pack.start == recipe::Start::Lattice
        && let Some(chart) = Chart::flatten(surface, job)?
    {
        return lattices(surface, &chart, length, recipe, job);
    }
    let note = match recipe.pack.start {
        recipe::Start::Lattice => {
            "the surface is closed or has handles: bubbles instead of a lattice"
        }
        recipe::Start::Random => "random start",
    };
    let seeds: Vec<u64> = match recipe.regularize.method {
        recipe::RegularizeMethod::Paper => vec![recipe.seed],
        recipe::RegularizeMethod::Search => {
            (0..recipe.regularize.candidates as u64).map(|k| seed(recipe, k)).collect()
        }
    };
    let packed = |(k, seed)| packing(surface, length, recipe, seed, &job.of_candidate(k, WHOLE));
    let starts = seeds.into_par_iter().enumerate().map(packed).collect();
    Ok(Starts { starts, notes: vec![note.to_owned()] })
}

/// Random bubbles, settled.
fn packing(surface: &Surface, length: f64, recipe: &Recipe, seed: u64, job: &Job) -> Start {
    let mut rng = fastrand::Rng::with_seed(seed);
    let pieces = pack::boundary::pieces(surface);
    let counts: Vec<usize> =
        pieces.iter().map(|p| pack::boundary::member_count(p, length)).collect();
    let boundary = pack::boundary::place(surface, &pieces, &counts, 0.0);
    let pieces = pack::boundary::feature_pieces(surface);
    let counts: Vec<usize> =
        pieces.iter().map(|p| pack::boundary::member_count(p, length)).collect();
    let features = pack::boundary::place_on_features(surface, &pieces, &counts);
    let fixed = surface.fixed.clone();
    let mut bubbles = Bubbles { boundary, features, fixed, interior: Vec::new() };
    let (held, rim) = (bubbles.held() - bubbles.boundary.len(), bubbles.boundary.len());
    let count = pack::interior_count(surface, rim, length, recipe.pack.k_n);
    let (count, xyz) = (count.saturating_sub(held), bubbles.xyz(surface));
    bubbles.interior = pack::scatter(surface, count, &xyz, CLEAR * length, &mut rng, job);
    let report = pack::settle(surface, &mut bubbles, length, &recipe.pack, job);
    Start { bubbles, seed, report: Some(report), grid: None }
}

/// The best of the lattices drawn.
fn lattices(
    surface: &Surface,
    chart: &Chart,
    length: f64,
    recipe: &Recipe,
    job: &Job,
) -> Result<Starts> {
    let pieces = pack::boundary::pieces(surface).len() + surface.features.len();
    let candidates = recipe.regularize.candidates.max(1);
    // Where the chart strains, a lattice does too: bubbles find better places for the irregular nodes.
    let packed = if chart.strain(surface) > STRAINED { candidates * 3 / 4 } else { 0 };
    let draws = recipe.pack.draws.max(1) * (candidates - packed) / candidates;
    let draws = draws.max(candidates - packed);
    let trial = balance::Options {
        straightness: recipe.relax.straightness,
        border: recipe.border_weight(),
        settled: 1e-3,
        max_steps: TRIAL_STEPS,
        accuracy: 0.1,
    };
    let wanted = chart.wanted_angle(surface);
    let bends = sharp_bends(surface, chart, length);
    let judged: Vec<Option<(f64, Start)>> = (0..draws as u64)
        .into_par_iter()
        .map(|k| {
            if k > 0 && job.stopped() {
                return Ok(None);
            }
            let seed = seed(recipe, k);
            let mut rng = fastrand::Rng::with_seed(seed);
            let mut lattice = Lattice::draw(pieces, &mut rng);
            // Every other draw runs with the border somewhere, the longer the stretch the likelier.
            if let Some(angle) = wanted {
                lattice.angle = angle + SWAY * (2.0 * rng.f64() - 1.0);
            } else if let Some(last) = bends.last().filter(|_| k % 2 == 1) {
                // A row of nodes along the bend: members do not cut it short, nor leap across.
                let at = rng.f64() * last.until;
                let bend = &bends[bends.partition_point(|b| b.until < at).min(bends.len() - 1)];
                lattice.angle = bend.angle;
                lattice.through = Some(bend.at);
            } else if k % 2 == 0 {
                lattice.angle = chart.border_direction(&surface.loops, rng.f64());
            }
            let bubbles =
                lattice.bubbles(surface, chart, length, recipe.pack.k_n, recipe.row_angle(), job);
            let start = connect(surface, chart, &bubbles, job)?;
            let mut grid = start.0.clone();
            let span = [k, k + 1].map(|k| k as f64 / draws as f64);
            balance(surface, &mut grid, &trial, &job.of_candidate(0, span).part_of("pack"));
            let lambda = recipe.measure.lambda;
            let points = Sums::whole(&grid, surface, length, lambda).merit(lambda);
            Ok(Some((points, Start { bubbles, seed, report: None, grid: Some(start) })))
        })
        .collect::<Result<_>>()?;
    let mut judged: Vec<(f64, Start)> = judged.into_iter().flatten().collect();
    // A stable sort: equals stay in the order of their draws.
    judged.sort_by(|a, b| b.0.total_cmp(&a.0));
    judged.truncate(candidates - packed);
    let notes = vec![format!(
        "lattice start: the best {} of {draws} draws, and {packed} packings",
        judged.len()
    )];
    let mut starts: Vec<Start> = judged.into_iter().map(|j| j.1).collect();
    starts.par_extend(
        (0..packed)
            .into_par_iter()
            .map(|k| (job.of_candidate(draws + k, WHOLE), seed(recipe, (draws + k) as u64)))
            .map(|(job, seed)| packing(surface, length, recipe, seed, &job)),
    );
    Ok(Starts { starts, notes })
}

/// Triangulate in the chart where that works, else on the carrier.
fn connect(
    surface: &Surface,
    chart: &Chart,
    bubbles: &Bubbles,
    job: &Job,
) -> Result<(Grid, triangulate::Report)> {
    let quick = if chart.upright {
        triangulate::triangulate_in_chart(surface, chart, bubbles, job)
    } else {
        None
    };
    match quick {
        Some(grid) => Ok((grid, triangulate::Report::default())),
        None => triangulate::triangulate(surface, bubbles, job),
    }
}

/// A seed of its own for each candidate.
fn seed(recipe: &Recipe, k: u64) -> u64 {
    recipe.seed.wrapping_mul(0x9E37_79B9_7F4A_7C15).wrapping_add(k)
}
