//! `gridshell compare`: grids side by side, for choosing between them.

use crate::Outcome;
use crate::args::Compare;
use crate::failure::Failure;
use crate::progress::Work;
use crate::{open, say};
use gridshell::design::Design;
use gridshell::schedule::Figures;
use gridshell::stages::measure::Quality;
use gridshell_report::{compare, page};
use serde::Serialize;
use std::path::Path;

/// The document of `--json`.
#[derive(Serialize)]
struct Document<'a> {
    schema: &'static str,
    version: &'static str,
    units: &'static str,
    grids: Vec<Entry<'a>>,
}

#[derive(Serialize)]
struct Entry<'a> {
    grid: &'a str,
    edge_length: f64,
    quality: &'a Quality,
    figures: &'a Figures,
}

impl<'a> Entry<'a> {
    fn new(name: &'a str, design: &'a Design) -> Entry<'a> {
        let Design { edge_length, quality, schedule, .. } = design;
        Entry { grid: name, edge_length: *edge_length, quality, figures: &schedule.figures }
    }
}

pub fn run(args: &Compare, work: &Work) -> Result<Outcome, Failure> {
    let job = &work.job;
    args.html.as_deref().map_or(Ok(()), page::check).map_err(Failure::of_output)?;
    let how = args.reopening.given();
    let mut grids = Vec::new();
    for path in &args.grids {
        let of = format!("{}: ", path.display());
        grids.push((label(path), open::one_of_several(path, &of, &how, job)?));
    }
    work.told();
    let mut reported = Ok(());
    if let Some(file) = &args.html {
        reported = page::write(file, &compare::page(&grids)).map_err(Failure::of_output);
        if reported.is_ok() {
            say::note(&format!("wrote {}", file.display()));
        }
    }
    if args.json {
        say::json(&Document {
            schema: "gridshell.compare/1",
            version: env!("CARGO_PKG_VERSION"),
            units: "m",
            grids: grids.iter().map(|(name, design)| Entry::new(name, design)).collect(),
        })?;
    } else {
        say::result(&compare::table(&grids))?;
    }
    reported.map(|()| Outcome::Done)
}

/// The file's name without its end.
fn label(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}
