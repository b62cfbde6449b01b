//! Files that come to the desk: surfaces, grids with their surfaces, what an earlier session left.

use super::{Desk, left, recipe, shown};
use crate::laid::Laid;
use crate::opened::{self, Opened};
use crate::session::{Ended, Session};
use axum::body::Bytes;
use gridshell::error::{Error, Result};
use gridshell::io::{self, Document, Opening, Reference};
use gridshell::job::Job;
use gridshell::reopen;
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
            return self.put_grid(io::read_document(path, job)?, Some(path)).map(|_| ());
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
            return self.put_grid(document, None).map(|_| ());
        }
        self.put(&Arc::new(Opened::sent(name, file, &Opening::default(), &self.opening())?));
        Ok(())
    }

    /// Keep grids in a session in this folder from now on, and offer what earlier ones left.
    ///
    /// # Errors
    /// What the system says.
    pub fn keep_in(&self, folder: &Path, log: crate::Log) -> std::io::Result<()> {
        let session = Session::begin(folder, log)?;
        let mut state = self.state();
        state.left = session.left(folder);
        state.session = Some(session);
        Ok(())
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
    /// else is read. Gives its number.
    fn put_grid(&self, document: Document, path: Option<&Path>) -> Result<u32> {
        let job = &self.opening();
        let (opened, notes) = self.surface_of(&document, path, job)?;
        let model = opened.reference.is_some().then_some(&opened.model);
        let read = reopen::restore(document, model, job)?;
        let read = reopen::Opened { notes, ..read };
        self.put(&opened);
        let number = self.number();
        let mut state = self.state();
        state.recipe = read.document.recipe.clone().map(|r| (number, r));
        if let Some(event) = recipe(&state) {
            self.tell(event);
        }
        drop(state);
        self.keep(Laid::of_file(number, read, opened));
        Ok(number)
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

    /// Put the grids of an earlier session on the desk; it is cleared away when they are kept in this one.
    pub(super) fn recover(&self, session: &str) -> Result<()> {
        let mut ended = self.take_left(session)?;
        let grids = std::mem::take(&mut ended.grids);
        let mut laid = Vec::new();
        for (path, document) in grids {
            // A session's own copies only: the grid may have come from the page, with any path.
            let own = match &document.surface {
                Some(Reference::File { path: to, .. }) => {
                    !to.contains(['/', '\\']) && path.with_file_name(to).exists()
                }
                _ => true,
            };
            let number = self.put_grid(document, own.then_some(&path))?;
            laid.push(self.laid(number)?);
        }
        if let Some(session) = &self.state().session {
            for laid in &laid {
                session.save(laid);
            }
            session.settle();
            ended.discard();
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
