//! Files that come to the desk: surfaces, grids with their surfaces, what an earlier session left.

use super::{Desk, left, recipe, shown};
use crate::laid::Laid;
use crate::message::Event;
use crate::opened::{self, Opened};
use crate::session::{Ended, Session};
use axum::body::Bytes;
use gridshell::design::Design;
use gridshell::error::{Error, Result};
use gridshell::io::{self, Document, Opening, Reference};
use gridshell::job::Job;
use std::path::Path;
use std::sync::Arc;

impl Desk {
    /// Open a built-in surface or a file; a grid file with its surface.
    ///
    /// # Errors
    /// What [`Opened::named`] and [`io::read_document`] say.
    pub fn open(&self, name_or_path: &str) -> Result<()> {
        let path = Path::new(name_or_path);
        let job = &self.opening();
        if is_grid(path) {
            return self
                .put_grid(io::read_document(path, job)?, Some(path), |laid| laid)
                .map(|_| ());
        }
        self.put(&Arc::new(Opened::named(name_or_path, &Opening::default(), job)?));
        Ok(())
    }

    /// Open a file of these contents that was sent under `name`; messages tell of the name. What a grid file lies on
    /// is looked for on the desk only.
    ///
    /// # Errors
    /// As [`Desk::open`].
    pub fn open_sent(&self, name: &str, file: &Bytes) -> Result<()> {
        if is_grid(Path::new(name)) {
            let document =
                opened::in_folder(name, file, |path| io::read_document(path, &self.job()))?;
            return self.put_grid(document, None, |laid| laid).map(|_| ());
        }
        self.put(&Arc::new(Opened::sent(name, file, &Opening::default(), &self.opening())?));
        Ok(())
    }

    /// Keep grids in a session in this folder from now on, and offer what earlier ones left.
    ///
    /// # Errors
    /// What the system says.
    pub fn keep_in(self: &Arc<Self>, folder: &Path, log: crate::Log) -> std::io::Result<()> {
        let desk = Arc::downgrade(self);
        let told = move |fault: Option<String>| {
            match &fault {
                Some(fault) => log(&format!("autosave: {fault}")),
                None => log("autosave works again"),
            }
            if let Some(desk) = desk.upgrade() {
                desk.autosave(fault);
            }
        };
        let session = Session::begin(folder, Arc::new(told))?;
        let (left, more) = session.left(folder);
        let mut state = self.state();
        state.left = left;
        state.left_more = more as u32;
        state.session = Some(Arc::new(session));
        Ok(())
    }

    /// Grids cannot be kept against crashes, or can again: every tab is told.
    pub fn autosave(&self, fault: Option<String>) {
        let mut state = self.state();
        state.autosave.clone_from(&fault);
        self.tell(Event::Autosave { fault });
    }

    pub(super) fn put(&self, opened: &Arc<Opened>) {
        self.cancel();
        let mut state = self.state();
        state.opened = Some(Arc::clone(opened));
        state.recipe = None;
        for outgoing in shown(opened) {
            self.send(outgoing);
        }
    }

    /// Put a grid on the desk with the surface that it lies on; `path` says where its file is, if it may say what
    /// else is read, and `as_what` what it is beside a file of the user's.
    fn put_grid(
        &self,
        document: Document,
        path: Option<&Path>,
        as_what: impl FnOnce(Laid) -> Laid,
    ) -> Result<Arc<Laid>> {
        let job = &self.opening();
        let (opened, notes) = self.surface_of(&document, path, job)?;
        let model = opened.reference.is_some().then_some(&opened.model);
        let design = Design { notes, ..Design::restore(document, model, job)? };
        self.put(&opened);
        let number = self.number();
        let mut state = self.state();
        state.recipe = design.document.recipe.clone().map(|r| (number, r));
        if let Some(event) = recipe(&state) {
            self.tell(event);
        }
        drop(state);
        Ok(self.keep(as_what(Laid::of_file(number, design, opened))))
    }

    /// The surface that a grid lies on, else the grid itself, with a note on that.
    fn surface_of(
        &self,
        document: &Document,
        path: Option<&Path>,
        job: &Job,
    ) -> Result<(Arc<Opened>, Vec<String>)> {
        let Some(reference) = &document.surface else {
            return Ok((Arc::new(Opened::alone(document, job)?), Vec::new()));
        };
        let known = {
            let state = self.state();
            let all = state.opened.iter().chain(state.runs.iter().map(|r| &r.opened));
            let mut all = all.filter(|o| o.is(reference));
            all.next().cloned()
        };
        let found = match (known, reference, path) {
            (Some(opened), ..) => return Ok((opened, Vec::new())),
            (None, Reference::Builtin(name), _) => Opened::built_in(name, job),
            (None, Reference::File { .. }, Some(path)) => Opened::referred(reference, path, job),
            (None, Reference::File { path: to, .. }, None) => Err(Error::Option(format!(
                "the grid was laid on `{to}`: open that file first, or drop both together"
            ))),
        };
        match found {
            Ok(opened) => Ok((Arc::new(opened), Vec::new())),
            Err(e @ (Error::Stopped { .. } | Error::Memory(_))) => Err(e),
            Err(e) => {
                let note = format!("{e}; until then the grid is taken for its own surface");
                Ok((Arc::new(Opened::alone(document, job)?), vec![note]))
            }
        }
    }

    /// Put the grids of an earlier session on the desk. Each is cleared away there once it is kept in this one; those
    /// that cannot be put on the desk stay, and are told.
    pub(super) fn recover(&self, session: &str) -> Result<()> {
        let mut ended = self.take_left(session)?;
        let mut back = Vec::new();
        for (path, document) in std::mem::take(&mut ended.grids) {
            // A session's own copies only: the grid may have come from the page, with any path.
            let own = match &document.surface {
                Some(Reference::File { path: to, .. }) => {
                    !to.contains(['/', '\\']) && path.with_file_name(to).exists()
                }
                _ => true,
            };
            match self.put_grid(document, own.then_some(&path), Laid::recovered) {
                Ok(laid) => back.push((path, laid.number)),
                Err(error) => ended.damage(&path, &error.to_string()),
            }
        }
        // Not while the state is locked: writing may take long.
        let session = self.state().session.clone();
        if let Some(session) = session {
            let numbers: Vec<u32> = back.iter().map(|b| b.1).collect();
            let written = session.settle(&numbers);
            let kept = back.iter().zip(written).filter(|b| b.1);
            kept.for_each(|((path, _), _)| Ended::remove(path));
        }
        ended.clear();
        if !ended.is_done() {
            let mut state = self.state();
            state.left.push(ended);
            self.tell(left(&state));
        }
        Ok(())
    }

    /// Offer an earlier session no longer.
    pub(super) fn take_left(&self, session: &str) -> Result<Ended> {
        let mut state = self.state();
        let found = state.left.iter().position(|e| e.name() == session);
        let found =
            found.ok_or_else(|| Error::Option("that session is not offered any more".into()))?;
        let ended = state.left.remove(found);
        self.tell(left(&state));
        Ok(ended)
    }
}

fn is_grid(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("gridshell"))
}
