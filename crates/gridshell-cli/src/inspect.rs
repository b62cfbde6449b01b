//! `gridshell inspect`: what a surface is.

use crate::Outcome;
use crate::args::Inspect;
use crate::failure::Failure;
use crate::progress::Work;
use crate::{say, table};
use gridshell::inspect::{self, Inspection};
use gridshell::io;
use gridshell_report::picture;
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
    args.picture.iter().try_for_each(|file| picture::check(file)).map_err(Failure::of_output)?;
    let opening = args.reading.opening();
    let model = io::open_with(&args.surface, &opening, job).map_err(Failure::of_input)?;
    // Notes are among the results.
    say::reading("", &model.source().told_losses(), &[]);
    let inspection = inspect::inspect(&model, job)?;
    let mut drawn = Ok(());
    if !args.picture.is_empty() {
        let sketch = inspect::sketch(&model, job)?;
        drawn = Failure::all(
            args.picture
                .iter()
                .map(|file| picture::draw(&sketch, file).map_err(Failure::of_output)),
        );
    }
    work.told();
    if args.json {
        let version = env!("CARGO_PKG_VERSION");
        say::json(&Document { schema: "gridshell.inspect/1", version, units: "m", inspection })?;
    } else {
        say::result(&table::inspection(&inspection))?;
    }
    drawn.map(|()| Outcome::Done)
}
