//! A grid that is kept, laid here or opened from a file, as it is after edits.

use crate::editing;
use crate::message::RunSummary;
use crate::opened::Opened;
use gridshell::edit::Editor;
use gridshell::error::Result;
use gridshell::grid::Grid;
use gridshell::io::{Document, Reference};
use gridshell::job::Job;
use gridshell::recipe::Recipe;
use gridshell::reopen;
use gridshell::run::Run;
use gridshell::schedule::{Schedule, Tolerances};
use gridshell::stages::measure::{Quality, measure};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A grid that is kept.
pub struct Laid {
    /// Its number.
    pub number: u32,
    /// What it lies on.
    pub opened: Arc<Opened>,
    /// The run that made it; None for a grid from a file.
    pub run: Option<Run>,
    /// The grid as it was before it was edited here.
    pub document: Document,
    /// The run's recipe, else the default one.
    pub recipe: Recipe,
    /// Wanted member length, metres.
    pub edge_length: f64,
    /// What the user should know.
    pub notes: Vec<String>,
    /// Where it comes from, where no run ended with it: `from a file`.
    pub origin: Option<String>,
    now: Mutex<Now>,
}

/// A grid as it is now.
pub struct Now {
    /// The grid.
    pub grid: Arc<Grid>,
    /// Its measures.
    pub quality: Quality,
    /// Of a grid laid here, from the first edit on.
    pub editor: Option<Editor>,
}

/// A grid as it goes into files.
pub struct Finished {
    /// With its history.
    pub document: Document,
    /// The grid.
    pub grid: Grid,
    /// Its nodes, members and panels one by one.
    pub schedule: Schedule,
}

impl Laid {
    /// Keep what came of run `number`, supported at its boundary.
    pub fn of_run(number: u32, run: Run, opened: Arc<Opened>, origin: Option<String>) -> Laid {
        let mesh = &run.grid.mesh;
        let border = mesh.vertices().filter(|&v| mesh.is_boundary(v)).collect();
        let reference = opened.reference.clone();
        let own = Reference::Builtin(run.surface.name.clone());
        let document = Document {
            surface: reference.clone(),
            ..Document::of_run(&run, reference.unwrap_or(own), border)
        };
        let now =
            Now { grid: Arc::new(run.grid.clone()), quality: run.quality.clone(), editor: None };
        Laid {
            number,
            opened,
            document,
            recipe: run.recipe.clone(),
            edge_length: run.edge_length,
            notes: run.warnings.clone(),
            origin,
            run: Some(run),
            now: Mutex::new(now),
        }
    }

    /// Keep a grid that was read from a file under `number`.
    pub fn of_file(number: u32, read: reopen::Opened, opened: Arc<Opened>) -> Laid {
        let reopen::Opened { document, grid, surface, edge_length, recipe, notes, .. } = read;
        let editor = Editor::new(Arc::new(surface), grid, recipe.clone(), edge_length);
        let now = Now::of(editor, edge_length, &recipe);
        let now = Mutex::new(now);
        let origin = Some("from a file".to_owned());
        Laid { number, opened, run: None, document, recipe, edge_length, notes, origin, now }
    }

    /// What it is now.
    pub fn now(&self) -> MutexGuard<'_, Now> {
        self.now.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Its grid as it is now.
    pub fn grid(&self) -> Arc<Grid> {
        Arc::clone(&self.now().grid)
    }

    /// In one line.
    pub fn summary(&self) -> RunSummary {
        let now = self.now();
        let effort = format!("{:?}", self.recipe.effort).to_lowercase();
        let seed = self.document.seed.map(|seed| format!("{effort}, seed {seed}"));
        let by: Vec<String> = seed.into_iter().chain(self.origin.clone()).collect();
        let by = by.join(", ");
        let edits =
            self.document.edits.len() + now.editor.as_ref().map_or(0, |e| e.history().len());
        let edited = match edits {
            0 => String::new(),
            1 => ", 1 edit".into(),
            n => format!(", {n} edits"),
        };
        RunSummary {
            run: self.number,
            title: self.document.name.clone(),
            detail: format!("{:.3} m, {by}{edited}", self.edge_length),
            nodes: now.quality.nodes as u32,
            fluency: now.quality.fluency,
            irregular: (now.quality.irregular.interior + now.quality.irregular.boundary) as u32,
        }
    }

    /// Work with the editor, which is made when it is first asked for.
    pub fn edit<T>(&self, work: impl FnOnce(&mut Editor) -> Result<T>) -> Result<T> {
        let mut now = self.now();
        if let (None, Some(run)) = (&now.editor, &self.run) {
            let editor = editing::editor(&self.opened.model, run, &Job::default())?;
            *now = Now::of(editor, self.edge_length, &self.recipe);
        }
        let editor = now.editor.as_mut().expect("a grid from a file has one from the start");
        work(editor)
    }

    /// Change the grid.
    pub fn change(&self, work: impl FnOnce(&mut Editor) -> Result<()>) -> Result<()> {
        self.edit(work)?;
        let mut now = self.now();
        if let Some(editor) = now.editor.take() {
            *now = Now::of(editor, self.edge_length, &self.recipe);
        }
        Ok(())
    }

    /// The grid as it is, numbered without gaps.
    pub fn finished(&self) -> Finished {
        let now = self.now();
        match (&now.editor, &self.run) {
            (None, Some(run)) => Finished {
                document: self.document.clone(),
                grid: run.grid.clone(),
                schedule: run.schedule.clone(),
            },
            (None, None) => unreachable!("a grid from a file has an editor from the start"),
            (Some(editor), _) => {
                let tolerances = Tolerances::from(&self.recipe.measure);
                let grid = editor.finished();
                let schedule = Schedule::new(&grid, editor.surface(), &tolerances);
                let panels = schedule.panels.nodes.clone();
                let document = Document { panels, ..reopen::edited(&self.document, editor) };
                Finished { document, grid, schedule }
            }
        }
    }
}

impl Now {
    /// What an editor's grid is.
    fn of(editor: Editor, edge_length: f64, recipe: &Recipe) -> Now {
        let quality = measure(&editor.finished(), editor.surface(), edge_length, &recipe.measure);
        Now { grid: Arc::new(editor.grid().clone()), quality, editor: Some(editor) }
    }
}
