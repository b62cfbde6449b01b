//! A grid from a file, as the arguments say.

use crate::args::{Alike, GridArgs};
use crate::failure::Failure;
use crate::say;
use gridshell::design::{Design, Reopening};
use gridshell::io::{Follow, Opening};
use gridshell::job::Job;
use std::path::Path;

/// The grid on its surface, measured within the tolerances that are given. What is to be known of its reading is told.
pub fn open(args: &GridArgs, job: &Job) -> Result<Design, Failure> {
    let how = reopening(
        args.surface.as_deref(),
        args.reading.opening(),
        args.following.follow(),
        &args.alike,
    );
    read(&args.grid, "", &how, job)
}

/// How a grid is to be opened.
pub fn reopening(
    surface: Option<&str>,
    opening: Opening,
    follow: Follow,
    alike: &Alike,
) -> Reopening {
    Reopening {
        surface: surface.map(str::to_owned),
        follow,
        opening,
        length_tolerance: alike.length_tolerance,
        angle_tolerance_deg: alike.angle_tolerance,
    }
}

/// The grid in one file; with several, `of` says which.
pub fn read(path: &Path, of: &str, how: &Reopening, job: &Job) -> Result<Design, Failure> {
    let design = Design::open_with(path, how, job).map_err(Failure::of_input)?;
    say::reading(of, &design.losses, &design.notes);
    Ok(design)
}
