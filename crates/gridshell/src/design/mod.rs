//! A finished grid with all that is known of it: made, opened, edited, measured and written, each in one call.

mod reopen;

pub use reopen::Reopening;

use crate::edit::Editor;
use crate::error::Result;
use crate::grid::Grid;
use crate::io::{self, Document, GridFile, Reference};
use crate::job::Job;
use crate::pipeline;
use crate::recipe::Recipe;
use crate::run::{Run, SurfaceSummary};
use crate::schedule::{Schedule, Tolerances};
use crate::stages::measure::{Quality, measure_within};
use crate::structure::{Structure, Supports};
use crate::surface::{Model, Surface};
use crate::validity::{self, Fault, Validity};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A grid with all that is known of it. Metres; coordinates from the surface's own origin, but for those of the
/// document, which are the file's.
#[derive(Clone)]
pub struct Design {
    /// The grid and its history, as grid files have them.
    pub document: Document,
    /// The grid, numbered like the document.
    pub grid: Arc<Grid>,
    /// The design surface; the grid itself where that is not known.
    pub surface: Arc<Surface>,
    /// Figures of the design surface, where it is known.
    pub summary: Option<SurfaceSummary>,
    /// The recipe it was made by, else the default one.
    pub recipe: Recipe,
    /// What lengths are measured against: the length that was wanted, else the mean one; metres.
    pub edge_length: f64,
    /// Its measures.
    pub quality: Quality,
    /// Its nodes, members and panels one by one.
    pub schedule: Arc<Schedule>,
    /// What is wrong with it: nothing, if it is valid.
    pub faults: Vec<Fault>,
    /// What the user should know of it: faults, limits that were met, what the surface demands.
    pub warnings: Vec<String>,
    /// Section, material and panes for engineering formats.
    pub structure: Structure,
    /// The run that made it, where it was made here; edits that came later are not in it.
    pub run: Option<Arc<Run>>,
    /// What was skipped or repaired while it was read.
    pub notes: Vec<String>,
    /// What of the design surface's file could not be read.
    pub losses: Vec<String>,
}

impl Design {
    /// Lay a grid on `model`, supported along its boundary.
    ///
    /// # Errors
    /// As [`pipeline::generate`].
    pub fn generate(model: &Model, recipe: &Recipe, job: &Job) -> Result<Design> {
        let (run, surface) = pipeline::generate_on(model, recipe, job)?;
        Ok(Design::of_run(run, Arc::new(surface)))
    }

    /// What came of a run on this surface, supported along its boundary.
    pub fn of_run(run: Run, surface: Arc<Surface>) -> Design {
        let mesh = &run.grid.mesh;
        let boundary = mesh.vertices().filter(|&v| mesh.is_boundary(v)).collect();
        Design {
            document: Document::of_run(&run, boundary),
            grid: Arc::clone(&run.grid),
            surface,
            summary: Some(run.surface.clone()),
            recipe: run.recipe.clone(),
            edge_length: run.edge_length,
            quality: run.quality.clone(),
            schedule: Arc::clone(&run.schedule),
            faults: run.faults.clone(),
            warnings: run.warnings.clone(),
            structure: Structure::default(),
            run: Some(Arc::new(run)),
            notes: Vec::new(),
            losses: Vec::new(),
        }
    }

    /// The same design, whose file says where its surface is.
    #[must_use]
    pub fn referring_to(mut self, reference: Option<Reference>) -> Design {
        self.document.surface = reference;
        self
    }

    /// As [`Design::open_with`], in the usual way.
    ///
    /// # Errors
    /// As [`Design::open_with`].
    pub fn open(path: &Path, job: &Job) -> Result<Design> {
        Design::open_with(path, &Reopening::default(), job)
    }

    /// Open the grid in a file on its surface.
    ///
    /// # Errors
    /// [`Error::Io`], [`Error::Parse`] with line or element, [`Error::Surface`] where the panels are not a manifold or
    /// the surface cannot carry them, [`Error::Option`] for a surface or format that is not known.
    ///
    /// [`Error::Io`]: crate::Error::Io
    /// [`Error::Parse`]: crate::Error::Parse
    /// [`Error::Surface`]: crate::Error::Surface
    /// [`Error::Option`]: crate::Error::Option
    pub fn open_with(path: &Path, how: &Reopening, job: &Job) -> Result<Design> {
        reopen::open(path, how, job)?.measured(how, job)
    }

    /// The grid of a document on the surface made from `model`, which is the one that it was laid on; by itself without.
    ///
    /// # Errors
    /// [`Error::Surface`](crate::Error::Surface) where the panels are not a manifold or the surface cannot carry them.
    pub fn restore(document: Document, model: Option<&Model>, job: &Job) -> Result<Design> {
        reopen::restore(document, model, job)?.measured(&Reopening::default(), job)
    }

    /// Measure it anew, within what its recipe counts as alike.
    ///
    /// # Errors
    /// [`Error::Stopped`](crate::Error::Stopped).
    pub fn measure(&mut self, job: &Job) -> Result<()> {
        let Look { quality, schedule, validity } =
            Look::at(&self.grid, &self.surface, self.edge_length, &self.recipe, job)?;
        self.document.panels.clone_from(&schedule.panels.nodes);
        (self.quality, self.schedule) = (quality, Arc::new(schedule));
        self.warnings = validity.warnings();
        self.faults = validity.faults;
        self.document.invalid = self.invalid();
        Ok(())
    }

    /// What is wrong with it, in one sentence; None if it is valid.
    pub fn invalid(&self) -> Option<String> {
        (!self.faults.is_empty()).then(|| validity::summary(&self.faults))
    }

    /// Support it so.
    ///
    /// # Errors
    /// As [`Supports::nodes`].
    pub fn support(&mut self, supports: &Supports) -> Result<()> {
        self.document.supports = supports.nodes(&self.grid, &self.surface)?;
        Ok(())
    }

    /// An editor for it; [`Design::edited`] takes what came of it.
    pub fn edit(&self) -> Editor {
        let surface = Arc::clone(&self.surface);
        Editor::new(surface, (*self.grid).clone(), self.recipe.clone(), self.edge_length)
    }

    /// The design after editing: the grid as it is, numbered anew and measured, and the edits behind those it had.
    /// Supports and anchors follow their nodes; where the whole boundary was supported, it is again.
    ///
    /// # Errors
    /// [`Error::Stopped`](crate::Error::Stopped).
    pub fn edited(&self, editor: &Editor, job: &Job) -> Result<Design> {
        let grid = editor.finished();
        let document = reopen::edited(&self.document, editor, &grid);
        let (grid, surface) = (Arc::new(grid), Arc::clone(editor.surface()));
        let mut design = Design { document, grid, surface, ..self.clone() };
        design.measure(job)?;
        Ok(design)
    }

    /// Write it in the format of the path's end. Every file appears whole or not at all; gives the files written, which
    /// are several for CSV.
    ///
    /// # Errors
    /// As [`io::write()`].
    pub fn write(&self, path: &Path, job: &Job) -> Result<Vec<PathBuf>> {
        let Design { document, schedule, structure, .. } = self;
        io::write(path, &GridFile { document, schedule, structure }, job)
    }

    /// As titles have it.
    pub fn name(&self) -> &str {
        &self.document.name
    }
}

/// What has to be worked out of a grid.
struct Look {
    quality: Quality,
    schedule: Schedule,
    validity: Validity,
}

impl Look {
    fn at(
        grid: &Grid,
        surface: &Surface,
        edge_length: f64,
        recipe: &Recipe,
        job: &Job,
    ) -> Result<Look> {
        let options = &recipe.measure;
        let quality = measure_within(grid, surface, edge_length, options, job)?;
        let schedule = Schedule::within(grid, surface, &Tolerances::from(options), job)?;
        let validity = Validity::of(grid, surface, edge_length, &quality);
        Ok(Look { quality, schedule, validity })
    }
}
