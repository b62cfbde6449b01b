//! A grid from a file, as the arguments say.

use crate::args::GridArgs;
use crate::failure::Failure;
use crate::recipe;
use gridshell::job::Job;
use gridshell::reopen::{self, Opened};

/// The grid on its surface, with the tolerances that are given.
pub fn open(args: &GridArgs, job: &Job) -> Result<Opened, Failure> {
    let opening = args.reading.opening();
    let opened = reopen::open(&args.grid, args.surface.as_deref(), &opening, job);
    let mut opened = opened.map_err(Failure::of_input)?;
    recipe::tolerances(&mut opened.recipe, &args.alike);
    Ok(opened)
}
