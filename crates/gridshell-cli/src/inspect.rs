//! `gridshell inspect`: what a surface is.

use crate::Outcome;
use crate::args::Inspect;
use crate::failure::Failure;
use crate::progress::Work;
use crate::{picture, say, table};
use gridshell::inspect::{self, Inspection};
use gridshell::io;
use serde::Serialize;

/// The document of `--json`.
#[derive(Serialize)]
struct Document {
    schema: &'static str,
    version: &'static str,
    units: &'static str,
    #[serde(flatten)]
    inspection: Inspection,
}

pub fn run(args: &Inspect, work: &Work) -> Result<Outcome, Failure> {
    let job = &work.job;
    args.picture.iter().try_for_each(|file| picture::check(file))?;
    let opening = args.reading.opening();
    let model = io::open_with(&args.surface, &opening, job).map_err(Failure::of_input)?;
    let inspection = inspect::inspect(&model, job)?;
    if !args.picture.is_empty() {
        let sketch = inspect::sketch(&model, job)?;
        args.picture.iter().try_for_each(|file| picture::draw(&sketch, file))?;
    }
    work.told();
    if args.json {
        let version = env!("CARGO_PKG_VERSION");
        say::json(&Document { schema: "gridshell.inspect/1", version, units: "m", inspection })?;
    } else {
        say::result(&table::inspection(&inspection))?;
    }
    Ok(Outcome::Done)
}
