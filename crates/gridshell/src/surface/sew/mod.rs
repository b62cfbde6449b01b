//! Sewing: faces that only touch are given the edges they share.
//!
//! An edge that a single loop uses is *naked*. Naked edges are split where ends of others lie on them
//! (`split`), pieces that run alongside each other are paired (`pair`), and each pair becomes one edge
//! (`join`). Only pairs join vertices, so faces that touch in a point stay apart. What stays naked though another
//! edge runs close by is told (`facing`). Nothing depends on how finely the model is sampled later.
//!
//! The shared edge keeps the curve of one of its two faces: the other face is as far from it as the gap was.

mod facing;
mod join;
mod naked;
mod pair;
mod split;

use super::Brep;
use super::Sewing;
use super::model::size;
use super::tessellate::seam;
use crate::error::{Error, Result};
use crate::job::{Job, Picture};
use crate::math::digits::three;
use crate::words;
use naked::Naked;

/// What a stop in here is told as. Once the job is over, what is found is of no use: [`sew`] checks.
const PHASE: &str = "sewing";
/// Without a tolerance from the file, gaps below this share of the model's size are sewn.
pub const SIZE_SHARE: f64 = 2e-5;
/// A file's own tolerance counts up to this share of the model's size.
const FILE_SHARE: f64 = 1e-3;
/// No tolerance above this share of the model's size is accepted.
const MOST_SHARE: f64 = 0.02;
/// Gaps below this share of the model's size are rounding, and none.
const ROUNDING: f64 = 1e-13;
/// Naked edges with another within so many usual tolerances are told.
const REACH: f64 = 32.0;

/// Sew `brep` in place: with `tolerance` metres, or with what its file or its size suggests. What was found is in
/// `brep.sewing` and, in words, among its notes.
///
/// # Errors
/// [`Error::Option`] where the tolerance asked for is not a length, or so large that it would close the model itself.
pub fn sew(brep: &mut Brep, tolerance: Option<f64>, job: &Job) -> Result<()> {
    let size = size::of_brep(brep);
    if let Some(given) = tolerance {
        check(given, size)?;
    }
    let finite = brep.vertices.iter().all(|v| v.is_finite());
    if !(size.is_finite() && size > 0.0 && finite) || brep.faces.is_empty() {
        return Ok(());
    }
    let usual = brep.tolerance.min(FILE_SHARE * size).max(SIZE_SHARE * size);
    let tolerance = tolerance.unwrap_or(usual);
    job.check(PHASE)?;
    job.progress("sew", 0.0, Picture::None);
    let mut bounded = brep.clone();
    seam::bound_all(&mut bounded);
    let naked = Naked::new(&bounded, job);
    let mut sewing = Sewing { tolerance, ..Sewing::default() };
    let pieces = split::pieces(&bounded, &naked, tolerance, job);
    job.check(PHASE)?;
    let pairs = pair::pairs(&bounded, &pieces, tolerance, job);
    job.check(PHASE)?;
    job.progress("sew", 0.5, Picture::None);
    let mut told = Vec::new();
    let any = !pairs.joints.is_empty() || !pairs.twins.is_empty();
    if any {
        sewing.joints = pairs.joints.len();
        let gap = pairs.joints.iter().map(|j| j.gap).fold(0.0, f64::max);
        sewing.largest_gap = below_rounding(gap, size);
        let lost = join::join(&mut bounded, &pieces, &pairs, tolerance);
        told.push(joined(&sewing, brep));
        told.extend(lost.told(&pairs, tolerance, brep.origin));
        bounded.source.losses.extend(lost.loss(tolerance));
    }
    facing::look(&bounded, (REACH * usual).max(2.0 * tolerance), &mut sewing, job);
    job.check(PHASE)?;
    if any {
        *brep = bounded;
    }
    if sewing.facing > 0 {
        told.push(left(&sewing));
    }
    brep.sewing = Some(sewing);
    brep.notes.extend(told);
    Ok(())
}

fn check(given: f64, size: f64) -> Result<()> {
    if !(given.is_finite() && given > 0.0) {
        return Err(Error::Option(
            "the sewing tolerance must be a positive length in metres".into(),
        ));
    }
    let most = MOST_SHARE * size;
    if given > most {
        return Err(Error::Option(format!(
            "a sewing tolerance of {given} m is too large for a model of {size:.4} m: it would close openings and \
             swallow faces that are meant; give at most {most:.4} m"
        )));
    }
    Ok(())
}

/// A gap, or none where it is no more than the rounding of a model of this size.
fn below_rounding(gap: f64, size: f64) -> f64 {
    if gap <= ROUNDING * size { 0.0 } else { gap }
}

fn joined(sewing: &Sewing, brep: &Brep) -> String {
    let from = if sewing.tolerance == brep.tolerance { " of the file" } else { "" };
    let joints = words::counted(sewing.joints, "joint");
    if sewing.largest_gap == 0.0 {
        return format!("sewn: {joints} between faces whose edges coincide");
    }
    format!(
        "sewn: {joints} between faces without common edges, the largest gap {} m, at the tolerance{from} of {} m",
        three(sewing.largest_gap),
        three(sewing.tolerance)
    )
}

fn left(sewing: &Sewing) -> String {
    format!(
        "not sewn: {} of {} m together still face{} another up to {} m away, further than the tolerance \
         of {} m; if they are to be joined, sew with {} m, but a tolerance also closes every slit and \
         swallows every edge and face narrower than itself",
        words::counted(sewing.facing, "edge"),
        three(sewing.facing_length),
        if sewing.facing == 1 { "s" } else { "" },
        three(sewing.facing_gap),
        three(sewing.tolerance),
        three(1.1 * sewing.facing_gap)
    )
}

#[cfg(test)]
mod tests;
