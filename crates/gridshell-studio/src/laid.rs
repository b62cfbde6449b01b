//! A run that is kept, with its grid as it is after edits.

use crate::desk::Opened;
use crate::editing;
use crate::message::RunSummary;
use gridshell::edit::Editor;
use gridshell::error::{Error, Result};
use gridshell::grid::Grid;
use gridshell::io::{self, Document, GridFile};
use gridshell::reopen;
use gridshell::run::Run;
use gridshell::schedule::{Schedule, Tolerances};
use gridshell::stages::measure::{Quality, measure};
use gridshell::structure::{Structure, Supports};
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A run that is kept.
pub struct Laid {
    /// Its number.
    pub number: u32,
    /// What came out.
    pub run: Run,
    /// What it was laid on.
    pub opened: Arc<Opened>,
    now: Mutex<Now>,
}

/// A run's grid as it is now.
pub struct Now {
    /// The grid.
    pub grid: Arc<Grid>,
    /// Its measures.
    pub quality: Quality,
    /// From the first edit on.
    pub editor: Option<Editor>,
}

impl Laid {
    /// Keep what came of run `number`.
    pub fn new(number: u32, run: Run, opened: Arc<Opened>) -> Laid {
        let now =
            Now { grid: Arc::new(run.grid.clone()), quality: run.quality.clone(), editor: None };
        Laid { number, run, opened, now: Mutex::new(now) }
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
        let effort = format!("{:?}", self.run.recipe.effort).to_lowercase();
        let edits = now.editor.as_ref().map_or(0, |e| e.history().len());
        let edited = match edits {
            0 => String::new(),
            1 => ", 1 edit".into(),
            n => format!(", {n} edits"),
        };
        RunSummary {
            run: self.number,
            title: self.run.surface.name.clone(),
            detail: format!(
                "{:.3} m, {effort}, seed {}{edited}",
                self.run.edge_length, self.run.seed
            ),
            nodes: now.quality.nodes as u32,
            fluency: now.quality.fluency,
            irregular: (now.quality.irregular.interior + now.quality.irregular.boundary) as u32,
        }
    }

    /// Work with the editor, which is made when it is first asked for.
    pub fn edit<T>(&self, work: impl FnOnce(&mut Editor) -> Result<T>) -> Result<T> {
        let mut now = self.now();
        if now.editor.is_none() {
            now.editor = Some(editing::editor(&self.opened.model, &self.run)?);
            now.renew(&self.run);
        }
        let editor = now.editor.as_mut().expect("it was made just now");
        work(editor)
    }

    /// What it is in the format of this extension, with the name of the file.
    ///
    /// # Errors
    /// [`Error::Option`] where it cannot be written.
    pub fn file(&self, extension: &str) -> Result<(String, Vec<u8>)> {
        let plain = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
        let name: String = self.run.surface.name.chars().map(plain).collect();
        let name = format!("{name}-{}.{extension}", self.number);
        let unwritten = |e: &dyn std::fmt::Display| Error::Option(format!("{name}: {e}"));
        match extension {
            "run.json" => {
                let text = serde_json::to_vec_pretty(&self.run).map_err(|e| unwritten(&e))?;
                return Ok((name, text));
            }
            "edits.json" => {
                let text = self.edit(|editor| Ok(editor.log().to_json()))?;
                return Ok((name, text.into_bytes()));
            }
            _ => {}
        }
        let folder = tempfile::tempdir().map_err(|e| unwritten(&e))?;
        let path = folder.path().join(&name);
        self.write(&path)?;
        let bytes = std::fs::read(&path).map_err(|e| unwritten(&e))?;
        Ok((name, bytes))
    }

    fn write(&self, path: &Path) -> Result<()> {
        let run = &self.run;
        let supports = Supports::Boundary.nodes(&run.grid, &self.opened.sketch)?;
        let start = match self.opened.reference.clone() {
            Some(reference) => Document::of_run(run, reference, supports),
            // A file that came through the browser is at no place that others could find.
            None => Document {
                seed: Some(run.seed),
                edge_length: Some(run.edge_length),
                recipe: Some(run.recipe.clone()),
                supports,
                ..Document::of_grid(&run.surface.name, &run.grid)
            },
        };
        let structure = &Structure::default();
        let now = self.now();
        let Some(editor) = &now.editor else {
            let file = GridFile { document: &start, schedule: &run.schedule, structure };
            return io::write(path, &file).map(|_| ());
        };
        let tolerances = Tolerances::from(&run.recipe.measure);
        let schedule = &Schedule::new(&editor.finished(), editor.surface(), &tolerances);
        let mut document = reopen::edited(&start, editor);
        document.panels.clone_from(&schedule.panels.nodes);
        io::write(path, &GridFile { document: &document, schedule, structure }).map(|_| ())
    }

    /// Change the grid.
    pub fn change(&self, work: impl FnOnce(&mut Editor) -> Result<()>) -> Result<()> {
        self.edit(work)?;
        self.now().renew(&self.run);
        Ok(())
    }
}

impl Now {
    /// Take over the editor's grid.
    fn renew(&mut self, run: &Run) {
        let Some(editor) = &self.editor else { return };
        self.grid = Arc::new(editor.grid().clone());
        self.quality =
            measure(&editor.finished(), editor.surface(), run.edge_length, &run.recipe.measure);
    }
}
