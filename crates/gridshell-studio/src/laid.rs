//! A grid that is kept, laid here or opened from a file, as it is after edits.
//!
//! ```text
//! editor   locked by whoever changes the grid, for as long as that takes
//! now      what it is between two changes: swapped when one is done, locked for that moment only
//! ```
//!
//! So whatever looks, picks, weighs, writes or greets works with a picture that stays as it is, and waits for no edit.

use crate::editing;
use crate::message::{Event, RunSummary};
use crate::opened::Opened;
use gridshell::design::Design;
use gridshell::edit::{Editor, Log};
use gridshell::error::Result;
use gridshell::grid::Grid;
use gridshell::job::Job;
use gridshell::recipe::Effort;
use gridshell::stages::measure::{Quality, measure};
use gridshell::surface::Surface;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

/// A grid that is kept.
pub struct Laid {
    /// Its number.
    pub number: u32,
    /// What it lies on.
    pub opened: Arc<Opened>,
    /// The design as it was before it was edited here.
    pub design: Design,
    /// Where it comes from, where no run ended with it: `from a file`.
    pub origin: Option<String>,
    editor: Mutex<Option<Editor>>,
    now: Mutex<Arc<Now>>,
    /// The version that is on a disk of the user's, or can be made again from what is.
    safe: Mutex<Option<u32>>,
    changing: AtomicBool,
    used: AtomicU64,
}

/// A grid between two changes.
pub struct Now {
    /// Counts changes by hand.
    pub version: u32,
    /// The grid.
    pub grid: Arc<Grid>,
    /// Its measures.
    pub quality: Quality,
    /// What was done and undone, as the page is told.
    pub history: Event,
    /// The edits of this session as they stand in logs; None before the first.
    log: Option<Log>,
    /// What it lies on: edits of guides change that.
    pub surface: Arc<Surface>,
    /// An editor of its own, to weigh edits on.
    trial: OnceLock<Arc<Editor>>,
}

impl Laid {
    /// Keep what came of run `number`.
    pub fn of_run(
        number: u32,
        design: Design,
        opened: Arc<Opened>,
        origin: Option<String>,
    ) -> Laid {
        let now = Now {
            version: 0,
            grid: Arc::clone(&design.grid),
            quality: design.quality.clone(),
            history: editing::history(number, &design.document.edits, None),
            log: None,
            surface: Arc::clone(&design.surface),
            trial: OnceLock::new(),
        };
        // What a person chose among candidates is not made again by a run.
        let safe = origin.is_none().then_some(0);
        let design = design.referring_to(opened.reference.clone());
        Laid {
            number,
            opened,
            design,
            origin,
            editor: Mutex::default(),
            now: Mutex::new(Arc::new(now)),
            safe: Mutex::new(safe),
            changing: AtomicBool::default(),
            used: AtomicU64::default(),
        }
    }

    /// Keep a grid that was read from a file of the user's under `number`.
    pub fn of_file(number: u32, design: Design, opened: Arc<Opened>) -> Laid {
        let editor = design.edit();
        let now = Now::of(0, number, &design, &editor);
        Laid {
            number,
            opened,
            design,
            origin: Some("from a file".to_owned()),
            editor: Mutex::new(Some(editor)),
            now: Mutex::new(Arc::new(now)),
            safe: Mutex::new(Some(0)),
            changing: AtomicBool::default(),
            used: AtomicU64::default(),
        }
    }

    /// The same grid, which lies on no disk but among what an ended studio left.
    #[must_use]
    pub fn recovered(self) -> Laid {
        Laid { origin: Some("recovered".to_owned()), safe: Mutex::default(), ..self }
    }

    /// What it is now.
    pub fn now(&self) -> Arc<Now> {
        Arc::clone(&held(&self.now))
    }

    /// Its grid as it is now.
    pub fn grid(&self) -> Arc<Grid> {
        Arc::clone(&self.now().grid)
    }

    /// Whether something in it would be lost with it: changes, or a choice, that are in no file of the user's.
    pub fn unsaved(&self) -> bool {
        self.changing.load(Ordering::Acquire) || *held(&self.safe) != Some(self.now().version)
    }

    /// The user has this version in a file; whether that is the grid as it is.
    pub fn saved(&self, version: u32) -> bool {
        let is_now = self.now().version == version;
        if is_now {
            *held(&self.safe) = Some(version);
        }
        is_now
    }

    /// Whether it is a draft.
    pub fn is_draft(&self) -> bool {
        self.design.run.is_some() && self.design.recipe.effort == Effort::Draft
    }

    /// Note when it was looked at: `at` grows.
    pub fn use_at(&self, at: u64) {
        self.used.store(at, Ordering::Relaxed);
    }

    /// When it was looked at last.
    pub fn used(&self) -> u64 {
        self.used.load(Ordering::Relaxed)
    }

    /// In one line.
    pub fn summary(&self) -> RunSummary {
        let now = self.now();
        let effort = format!("{:?}", self.design.recipe.effort).to_lowercase();
        let seed = self.design.document.seed.map(|seed| format!("{effort}, seed {seed}"));
        let by: Vec<String> = seed.into_iter().chain(self.origin.clone()).collect();
        let by = by.join(", ");
        let edits =
            self.design.document.edits.len() + now.log.as_ref().map_or(0, |log| log.edits.len());
        let edited = match edits {
            0 => String::new(),
            1 => ", 1 edit".into(),
            n => format!(", {n} edits"),
        };
        RunSummary {
            run: self.number,
            title: self.design.document.name.clone(),
            detail: format!("{:.3} m, {by}{edited}", self.design.edge_length),
            nodes: now.quality.nodes as u32,
            fluency: now.quality.fluency,
            irregular: (now.quality.irregular.interior + now.quality.irregular.boundary) as u32,
            unsaved: self.unsaved(),
        }
    }

    /// An editor with the grid as it is, to weigh edits on: no change waits for it, nor it for one.
    pub fn trial(&self) -> Arc<Editor> {
        self.trial_of(&self.now())
    }

    fn trial_of(&self, now: &Now) -> Arc<Editor> {
        let trial = now.trial.get_or_init(|| {
            let (surface, grid) = (Arc::clone(&now.surface), (*now.grid).clone());
            let (recipe, length) = (self.design.recipe.clone(), self.design.edge_length);
            Arc::new(Editor::new(surface, grid, recipe, length))
        });
        Arc::clone(trial)
    }

    /// Change the grid; what it was is seen until that is done. `job` is that of `work`.
    ///
    /// # Errors
    /// What `work` says, with the grid as it was; where the job was stopped before.
    pub fn change(
        &self,
        job: &Job,
        work: impl FnOnce(&mut Editor, &Job) -> Result<()>,
    ) -> Result<()> {
        let mut editor = held(&self.editor);
        let _changing = Changing::begin(&self.changing);
        let editor = editor.get_or_insert_with(|| self.design.edit());
        work(editor, job)?;
        let (version, number) = (self.now().version + 1, self.number);
        let now = Now::of(version, number, &self.design, editor);
        *held(&self.now) = Arc::new(now);
        Ok(())
    }

    /// The log of this session's edits.
    pub fn log(&self) -> Log {
        let now = self.now();
        now.log.clone().unwrap_or_else(|| self.trial_of(&now).log())
    }

    /// What the user should know of it.
    pub fn notes(&self) -> Vec<String> {
        [&*self.design.notes, &self.design.warnings].concat()
    }

    /// The design as it is, numbered without gaps, and which change it is after.
    ///
    /// # Errors
    /// As [`Design::edited`].
    pub fn finished(&self) -> Result<(Design, u32)> {
        let now = self.now();
        let design = match &now.log {
            None => self.design.clone(),
            Some(log) => {
                let mut design = self.design.edited(&self.trial_of(&now), &Job::default())?;
                let done = log.edits.iter().map(|edit| serde_json::json!(edit));
                design.document.edits =
                    self.design.document.edits.iter().cloned().chain(done).collect();
                design
            }
        };
        Ok((design, now.version))
    }
}

/// A change goes on, until it is dropped.
struct Changing<'a>(&'a AtomicBool);

impl Changing<'_> {
    fn begin(flag: &AtomicBool) -> Changing<'_> {
        flag.store(true, Ordering::Release);
        Changing(flag)
    }
}

impl Drop for Changing<'_> {
    fn drop(&mut self) {
        self.0.store(false, Ordering::Release);
    }
}

impl Now {
    /// What the grid of an editor of this design is.
    fn of(version: u32, run: u32, design: &Design, editor: &Editor) -> Now {
        let (grid, surface) = (editor.finished(), editor.surface());
        let quality = measure(&grid, surface, design.edge_length, &design.recipe.measure);
        Now {
            version,
            grid: Arc::new(editor.grid().clone()),
            quality,
            history: editing::history(run, &design.document.edits, Some(editor)),
            log: Some(editor.log()),
            surface: Arc::clone(editor.surface()),
            trial: OnceLock::new(),
        }
    }
}

/// What is locked for a moment; a thread that panicked has left it whole.
fn held<T>(lock: &Mutex<T>) -> MutexGuard<'_, T> {
    lock.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use gridshell::edit::Edit;
    use gridshell::io::Document;
    use gridshell::recipe::Recipe;

    /// The grid of a square, as if from a file.
    pub fn square(number: u32) -> Laid {
        let (grid, surface) = crate::measures::tests::square();
        let document = Document::of_grid("square", &grid, surface.origin);
        let opened = Arc::new(Opened::alone(&document, &Job::default()).unwrap());
        let document = Document { edge_length: Some(1.0), ..document };
        let design = Design::restore(document, None, &Job::default()).unwrap();
        Laid::of_file(number, design, opened)
    }

    /// A coarse draft on the built-in hexagon, told to be of this effort.
    pub fn hexagon(number: u32, effort: Effort) -> Laid {
        let opened = Opened::built_in("hexagon", &Job::default()).unwrap();
        let recipe = Recipe { edge_length: Some(2.0), effort: Effort::Draft, ..Recipe::default() };
        let mut design = Design::generate(&opened.model, &recipe, &Job::default()).unwrap();
        design.recipe.effort = effort;
        Laid::of_run(number, design, Arc::new(opened), None)
    }

    /// Pin a node.
    pub fn pin(laid: &Laid, node: u32) {
        let pin = |editor: &mut Editor, _: &Job| {
            editor.apply(Edit::Pin { node }).unwrap();
            Ok(())
        };
        laid.change(&Job::default(), pin).unwrap();
    }

    /// A middle node of the square.
    pub const MIDDLE: u32 = 4;

    #[test]
    fn what_is_saved_is_a_version_and_not_the_grid() {
        let laid = square(1);
        assert!(!laid.unsaved(), "it is in the file that it came from");
        pin(&laid, MIDDLE);
        assert!(laid.unsaved());
        let version = laid.finished().unwrap().1;
        pin(&laid, MIDDLE + 1);
        assert!(!laid.saved(version), "the grid has changed since");
        assert!(laid.unsaved());
        assert!(laid.saved(version + 1) && !laid.unsaved());
        let undo = |editor: &mut Editor, _: &Job| {
            editor.undo().unwrap();
            Ok(())
        };
        laid.change(&Job::default(), undo).unwrap();
        assert!(laid.unsaved(), "what is undone since then is a change as well");
        assert!(square(2).recovered().unsaved());
    }

    #[test]
    fn while_a_grid_is_changed_what_it_was_is_seen_weighed_and_written() {
        let laid = square(1);
        let before = laid.finished().unwrap();
        laid.change(&Job::default(), |editor, _| {
            editor.apply(Edit::Pin { node: MIDDLE }).unwrap();
            // On this very thread: whatever waited for the change would never come.
            assert!(laid.unsaved(), "it is being changed");
            assert_eq!(laid.finished().unwrap().0.document.nodes, before.0.document.nodes);
            assert!(laid.log().edits.is_empty());
            assert!(laid.trial().history().next().is_none());
            assert!(!laid.summary().detail.contains("edit"));
            Ok(())
        })
        .unwrap();
        assert_eq!(laid.finished().unwrap().0.document.edits.len(), 1);
        assert!(laid.summary().detail.ends_with(", 1 edit"));
    }

    /// What is written from a picture of the grid is what its editor would have written.
    #[test]
    fn a_grid_is_written_as_its_editor_has_it() {
        let laid = hexagon(1, Effort::Draft);
        let members: Vec<(u32, u32)> = {
            let mesh = &laid.design.grid.mesh;
            mesh.edges().filter(|&(a, _)| !mesh.is_boundary(a)).take(3).collect()
        };
        for (a, b) in members {
            let mut told = None;
            let split = |editor: &mut Editor, _: &Job| {
                let _ = editor.apply(Edit::Split { nodes: [a, b] });
                let _ = editor.apply(Edit::Flip { nodes: [a, b] });
                told = Some((
                    laid.design.edited(editor, &Job::default()).unwrap().document,
                    editor.log(),
                ));
                Ok(())
            };
            laid.change(&Job::default(), split).unwrap();
            let (document, log) = told.unwrap();
            let finished = laid.finished().unwrap().0.document;
            assert_eq!(finished.edits, document.edits);
            assert_eq!(finished.nodes, document.nodes);
            assert_eq!(finished.supports, document.supports);
            assert_eq!(finished.features, document.features);
            assert_eq!(laid.log(), log);
        }
    }
}
