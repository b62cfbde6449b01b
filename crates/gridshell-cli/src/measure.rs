//! `gridshell measure`: the measures of a grid from a file.

use crate::Outcome;
use crate::args::Measure;
use crate::failure::Failure;
use crate::{open, say, table};
use gridshell::run::SurfaceSummary;
use gridshell::schedule::{Figures, Schedule, Tolerances};
use gridshell::stages::measure::{IrregularNode, Quality, irregular_nodes, measure};
use serde::Serialize;

/// The document of `--json`.
#[derive(Serialize)]
struct Document {
    schema: &'static str,
    version: &'static str,
    units: &'static str,
    grid: String,
    surface: Option<SurfaceSummary>,
    /// What lengths and deviations are measured against: the run's wanted length, else the mean one, metres.
    edge_length: f64,
    quality: Quality,
    figures: Figures,
    irregular: Vec<IrregularNode>,
}

pub fn run(args: &Measure) -> Result<Outcome, Failure> {
    let opened = open::open(&args.grid)?;
    let (grid, surface) = (&opened.grid, &opened.surface);
    let options = &opened.recipe.measure;
    let quality = measure(grid, surface, opened.edge_length, options);
    let figures = Schedule::new(grid, surface, &Tolerances::from(options)).figures;
    if args.json {
        say::json(&Document {
            schema: "gridshell.measure/1",
            version: env!("CARGO_PKG_VERSION"),
            units: "m",
            grid: opened.document.name,
            surface: opened.summary,
            edge_length: opened.edge_length,
            irregular: irregular_nodes(grid),
            quality,
            figures,
        })?;
    } else {
        say::result(&table::grid(&opened.document.name, &quality, &figures))?;
    }
    opened.notes.iter().for_each(|n| say::note(&format!("note: {n}")));
    Ok(Outcome::Done)
}
