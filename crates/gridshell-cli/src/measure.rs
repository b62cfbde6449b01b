//! `gridshell measure`: the measures of a grid from a file.

use crate::Outcome;
use crate::args::Measure;
use crate::failure::Failure;
use crate::progress::Work;
use crate::subject::Measured;
use crate::{open, report, say, table};
use gridshell::run::SurfaceSummary;
use gridshell::schedule::Figures;
use gridshell::stages::measure::{IrregularNode, Quality, irregular_nodes};
use gridshell::validity::Fault;
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
    warnings: Vec<String>,
}

pub fn run(args: &Measure, work: &Work) -> Result<Outcome, Failure> {
    let job = &work.job;
    args.report.as_deref().map_or(Ok(()), report::check)?;
    let measured = Measured::new(open::open(&args.grid, job)?, job)?;
    let subject = measured.subject();
    let (name, quality, figures) = (subject.name(), subject.quality, &subject.schedule.figures);
    work.told();
    if let Some(path) = &args.report {
        report::write(path, &report::page(&subject, None))?;
        say::note(&format!("wrote {}", path.display()));
    }
    if args.json {
        say::json(&Document {
            schema: "gridshell.measure/1",
            version: env!("CARGO_PKG_VERSION"),
            units: "m",
            grid: name,
            surface: measured.summary(),
            edge_length: subject.edge_length,
            irregular: irregular_nodes(subject.grid),
            quality,
            figures,
            valid: measured.validity().is_valid(),
            faults: &measured.validity().faults,
            warnings: measured.validity().warnings(),
        })?;
    } else {
        let warnings = measured.validity().warnings();
        let warnings =
            warnings.iter().fold(String::new(), |all, w| all + &format!("warning: {w}\n"));
        say::result(&(table::grid(name, quality, figures) + &warnings))?;
    }
    measured.notes().iter().for_each(|n| say::note(&format!("note: {n}")));
    Ok(Outcome::Done)
}
