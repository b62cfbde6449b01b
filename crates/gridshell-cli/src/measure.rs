//! `gridshell measure`: the measures of a grid from a file.

use crate::Outcome;
use crate::args::Measure;
use crate::failure::Failure;
use crate::progress::Work;
use crate::{open, say, table};
use gridshell::run::SurfaceSummary;
use gridshell::schedule::Figures;
use gridshell::stages::measure::{IrregularNode, Quality, irregular_nodes};
use gridshell::validity::Fault;
use gridshell_report::page;
use serde::Serialize;

/// The document of `--json`.
#[derive(Serialize)]
struct Document<'a> {
    schema: &'static str,
    version: &'static str,
    units: &'static str,
    grid: &'a str,
    surface: Option<&'a SurfaceSummary>,
    /// What lengths and deviations are measured against: the run's wanted length, else the mean one, metres.
    edge_length: f64,
    quality: &'a Quality,
    figures: &'a Figures,
    irregular: Vec<IrregularNode>,
    /// Whether it keeps all that is promised of every grid.
    valid: bool,
    faults: &'a [Fault],
    warnings: &'a [String],
}

pub fn run(args: &Measure, work: &Work) -> Result<Outcome, Failure> {
    let job = &work.job;
    args.report.as_deref().map_or(Ok(()), page::check).map_err(Failure::of_output)?;
    let design = open::open(&args.grid, job)?;
    let (quality, figures) = (&design.quality, &design.schedule.figures);
    work.told();
    let mut reported = Ok(());
    if let Some(path) = &args.report {
        reported = page::write(path, &page::of(&design)).map_err(Failure::of_output);
        if reported.is_ok() {
            say::note(&format!("wrote {}", path.display()));
        }
    }
    if args.json {
        say::json(&Document {
            schema: "gridshell.measure/1",
            version: env!("CARGO_PKG_VERSION"),
            units: "m",
            grid: design.name(),
            surface: design.summary.as_ref(),
            edge_length: design.edge_length,
            irregular: irregular_nodes(&design.grid, design.surface.origin),
            quality,
            figures,
            valid: design.faults.is_empty(),
            faults: &design.faults,
            warnings: &design.warnings,
        })?;
    } else {
        let warnings =
            design.warnings.iter().fold(String::new(), |all, w| all + &format!("warning: {w}\n"));
        say::result(&(table::grid(design.name(), quality, figures) + &warnings))?;
    }
    reported.map(|()| Outcome::Done)
}
