//! Whether a grid may leave: the soundest of the finalists, repaired where none is valid, and what is said of one that
//! stays invalid.

use super::contest::Winner;
use super::repair;
use crate::error::{Error, Result};
use crate::grid::Grid;
use crate::job::Job;
use crate::recipe::Recipe;
use crate::stages::measure::{Quality, measure};
use crate::surface::{Origin, Surface};
use crate::validity::{Validity, metres, told};
use glam::DVec3;

/// Finalists that are repaired where the best is not valid. Each costs about what relaxing it does.
const MOST_REPAIRED: usize = 4;
/// An anchor or guide within this distance of a fault, over l0, is named as its likely cause.
const CAUSE: f64 = 2.0;
/// A number of nodes that is off the one asked for by more than this share, and by more than [`FEW`], is told.
const KEPT: f64 = 0.15;
/// What a stop is told as that leaves no valid grid.
const SEARCHING: &str = "searching for a valid grid";
/// See [`KEPT`]: small grids have little choice.
const FEW: usize = 5;

/// The grid that was chosen.
pub struct Verdict {
    /// The finalist, on the exact surface.
    pub winner: Winner,
    /// Its measures.
    pub quality: Quality,
    /// What is wrong with it.
    pub validity: Validity,
    /// What repairing did.
    pub repaired: Option<String>,
}

/// The first valid one of the finalists, which come best first; where there is none the first that can be repaired, or
/// else the one with the fewest faults. `None` without any.
pub fn soundest(
    surface: &Surface,
    finalists: Vec<Winner>,
    length: f64,
    recipe: &Recipe,
    job: &Job,
) -> Option<Verdict> {
    let judge = |grid: &mut Grid| {
        grid.settle_exactly(surface);
        let quality = measure(grid, surface, length, &recipe.measure);
        let validity = Validity::of(grid, surface, length, &quality);
        (quality, validity)
    };
    let mut best: Option<Verdict> = None;
    for mut winner in finalists.into_iter().take(MOST_REPAIRED) {
        let (quality, validity) = judge(&mut winner.grid);
        let mut verdict = Verdict { winner, quality, validity, repaired: None };
        if !verdict.validity.is_valid() {
            let mut grid = verdict.winner.grid.clone();
            let report = repair::repair(surface, &mut grid, length, recipe, job);
            let (quality, validity) = judge(&mut grid);
            if validity.faults.len() < verdict.validity.faults.len() {
                let (winner, repaired) =
                    (Winner { grid, ..verdict.winner }, Some(report.to_string()));
                verdict = Verdict { winner, quality, validity, repaired };
            }
        }
        let fewer = |b: &Verdict| verdict.validity.faults.len() < b.validity.faults.len();
        if best.as_ref().is_none_or(fewer) {
            best = Some(verdict);
        }
        if best.as_ref().is_some_and(|b| b.validity.is_valid()) || job.stopped() {
            break;
        }
    }
    best
}

/// Refuse a grid that is not valid, unless the recipe wants it all the same, whose places are in coordinates of this
/// origin.
///
/// # Errors
/// [`Error::Invalid`] with all places and what to do; [`Error::Stopped`] or [`Error::Memory`] where the job was stopped
/// before the grid was done.
pub fn check(
    validity: &Validity,
    recipe: &Recipe,
    origin: Origin,
    length: f64,
    job: &Job,
) -> Result<()> {
    if validity.is_valid() || recipe.keep_invalid {
        return Ok(());
    }
    // With more time it may have become one.
    if job.stopped() {
        return Err(job.reason(SEARCHING));
    }
    Err(Error::Invalid {
        message: validity.summary(),
        advice: advice(validity, recipe, origin, length),
        places: validity.faults.iter().map(|f| f.at).collect(),
    })
}

/// What the designer may change.
fn advice(validity: &Validity, recipe: &Recipe, origin: Origin, length: f64) -> String {
    let shorter = format!("an edge length of about {} may work", metres(0.5 * length));
    let spots = validity.faults.iter().filter(|f| !f.nodes.is_empty()).map(|f| DVec3::from(f.at));
    let spots: Vec<DVec3> = spots.collect();
    let cause = cause(&spots, recipe, origin, CAUSE * length);
    let cause = cause.map(|what| format!("{what} is near: move it or leave it out, or "));
    let keep = "; --keep-invalid (keep_invalid in a recipe) gives the grid as it is, marked";
    cause.unwrap_or_default() + &shorter + keep
}

/// The anchor or guide that most of these places are near to, within `reach` metres.
fn cause(spots: &[DVec3], recipe: &Recipe, origin: Origin, reach: f64) -> Option<String> {
    let world = |p: [f64; 3]| origin.world(p.into());
    let near =
        |distance: &dyn Fn(DVec3) -> f64| spots.iter().filter(|&&p| distance(p) <= reach).count();
    let anchors = recipe.anchors.iter().enumerate().map(|(i, &at)| {
        let count = near(&|p| p.distance(world(at)));
        (count, format!("anchor {} at {}", i + 1, told(world(at).to_array())))
    });
    let guides = recipe.guides.iter().enumerate().map(|(i, points)| {
        let count =
            near(&|p| points.iter().map(|&q| p.distance(world(q))).fold(f64::MAX, f64::min));
        (count, format!("guide {}", i + 1))
    });
    let first_of_most = |best: (usize, String), next: (usize, String)| {
        if next.0 > best.0 { next } else { best }
    };
    anchors.chain(guides).reduce(first_of_most).filter(|c| c.0 > 0).map(|c| c.1)
}

/// A word on a number of nodes that is far from the one asked for.
pub fn node_count(recipe: &Recipe, nodes: usize) -> Option<String> {
    let wanted = recipe.nodes.filter(|_| recipe.edge_length.is_none())?;
    let off = nodes.abs_diff(wanted);
    (off > FEW && off as f64 > KEPT * wanted as f64).then(|| {
        format!(
            "{wanted} nodes were asked for and {nodes} came: corners, creases, narrow places and what is fixed need \
             nodes of their own; give an edge length to say what members are to be like"
        )
    })
}
