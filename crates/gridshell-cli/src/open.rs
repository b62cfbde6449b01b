//! A grid from a file, as the arguments say.

use crate::args::GridArgs;
use crate::failure::Failure;
use crate::say;
use gridshell::design::{Design, Reopening};
use gridshell::job::Job;
use std::path::Path;

/// The grid on its surface, measured within the tolerances that are given. What is to be known of its reading is told.
pub fn open(args: &GridArgs, job: &Job) -> Result<Design, Failure> {
    one_of_several(&args.grid, "", &args.reopening.given(), job)
}

/// The same; `of` says which of several it is where something is told.
pub fn one_of_several(
    path: &Path,
    of: &str,
    how: &Reopening,
    job: &Job,
) -> Result<Design, Failure> {
    let design = Design::open_with(path, how, job).map_err(Failure::of_input)?;
    say::reading(of, &design.losses, &design.notes);
    Ok(design)
}
