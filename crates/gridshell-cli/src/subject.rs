//! The grid that pictures, reports and comparisons tell of.

use gridshell::grid::Grid;
use gridshell::io::Document;
use gridshell::job::Job;
use gridshell::reopen::Opened;
use gridshell::run::{Run, SurfaceSummary};
use gridshell::schedule::{Schedule, Tolerances};
use gridshell::stages::measure::{Quality, measure_within};
use gridshell::validity::Validity;

/// A grid with all that is known of it. Metres.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    pub document: &'a Document,
    pub grid: &'a Grid,
    pub schedule: &'a Schedule,
    pub quality: &'a Quality,
    /// What lengths are measured against.
    pub edge_length: f64,
}

/// What has to be worked out of a grid that was read.
pub struct Measured {
    opened: Opened,
    schedule: Schedule,
    quality: Quality,
    validity: Validity,
}

impl Measured {
    pub fn new(opened: Opened, job: &Job) -> gridshell::Result<Measured> {
        let options = &opened.recipe.measure;
        let (grid, surface) = (&opened.grid, &opened.surface);
        let quality = measure_within(grid, surface, opened.edge_length, options, job)?;
        let schedule = Schedule::within(grid, surface, &Tolerances::from(options), job)?;
        let validity = Validity::of(grid, surface, opened.edge_length, &quality);
        Ok(Measured { opened, schedule, quality, validity })
    }

    pub fn subject(&self) -> Subject<'_> {
        Subject {
            document: &self.opened.document,
            grid: &self.opened.grid,
            schedule: &self.schedule,
            quality: &self.quality,
            edge_length: self.opened.edge_length,
        }
    }

    /// Figures of the design surface, where it is known.
    pub fn summary(&self) -> Option<&SurfaceSummary> {
        self.opened.summary.as_ref()
    }

    /// What is wrong with it.
    pub fn validity(&self) -> &Validity {
        &self.validity
    }

    /// What the user should know.
    pub fn notes(&self) -> &[String] {
        &self.opened.notes
    }
}

impl<'a> Subject<'a> {
    pub fn of_run(run: &'a Run, document: &'a Document) -> Subject<'a> {
        Subject {
            document,
            grid: &run.grid,
            schedule: &run.schedule,
            quality: &run.quality,
            edge_length: run.edge_length,
        }
    }

    /// As titles have it.
    pub fn name(&self) -> &'a str {
        &self.document.name
    }

    /// Seed and version, as feet of pages have it.
    pub fn origin(&self) -> String {
        let seed = self.document.seed.map_or(String::new(), |s| format!("seed {s}, "));
        format!("{seed}gridshell {}", self.document.version)
    }
}
