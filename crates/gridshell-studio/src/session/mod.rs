//! Autosave: every grid on the desk as a `.gridshell` file in a folder of its own for each studio, and what studios
//! that ended have left there.
//!
//! ```text
//! STATE/1763877600000-4711/lock                  locked as long as that studio runs, however it ends
//!                          3.gridshell           run 3 as it is, edits and all
//!                          9f2c…/4.gridshell     run 4, which lies on a file
//!                          9f2c…/roof.step       that file, in a folder named by its digest
//! ```
//!
//! A grid that the user has in a file of theirs, as it is, is not kept here. Nothing else is ever removed but what a
//! studio wrote and the user recovered or discarded: see [`own`].

mod ended;
mod own;

pub use ended::Ended;

use crate::laid::Laid;
use gridshell::error::{Error, Result};
use gridshell::io::{self, Reference};
use gridshell::job::Job;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// Changes are gathered for so long before they are written.
const GATHER: Duration = Duration::from_millis(200);
/// What could not be written is tried again after so long: soon enough to be of use, too seldom to be a burden.
const RETRY: Duration = Duration::from_secs(3);

/// Told why grids cannot be kept; None when they can again.
pub type Told = Arc<dyn Fn(Option<String>) + Send + Sync>;

/// Where this studio's grids are kept.
pub struct Session {
    folder: PathBuf,
    wishes: Sender<Wish>,
    /// Locked until the process ends.
    _lock: File,
}

enum Wish {
    Save(Arc<Laid>),
    Forget(u32),
    /// Say when all before is done, and which grids could not be written.
    Settle(Sender<Vec<u32>>),
}

impl Session {
    /// Begin a session in the folder `state`, which is made where it is missing.
    ///
    /// # Errors
    /// What the system says; a folder that others may write to.
    pub fn begin(state: &Path, told: Told) -> std::io::Result<Session> {
        let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        let folder = state.join(own::name(since));
        own::private(state, true)?;
        own::narrow(state)?;
        own::private(&folder, false)?;
        let mut lock = File::create_new(folder.join(own::LOCK))?;
        lock.lock()?;
        // After it is locked: who reads the mark and can lock the file knows that its studio has ended.
        lock.write_all(own::MARK.as_bytes())?;
        let (wishes, waiting) = channel();
        let writer = Writer { folder: folder.clone(), told, failed: BTreeMap::new(), fault: None };
        std::thread::spawn(move || writer.run(&waiting));
        Ok(Session { folder, wishes, _lock: lock })
    }

    /// Keep a grid as it is; written soon, in another thread.
    pub fn save(&self, laid: &Arc<Laid>) {
        // Where the writer broke off, it has told.
        let _ = self.wishes.send(Wish::Save(Arc::clone(laid)));
    }

    /// Keep a grid no longer.
    pub fn forget(&self, number: u32) {
        let _ = self.wishes.send(Wish::Forget(number));
    }

    /// Wait until all is written; whether these grids are.
    pub fn settle(&self, numbers: &[u32]) -> Vec<bool> {
        let (done, wait) = channel();
        let failed = self.wishes.send(Wish::Settle(done)).ok().and_then(|()| wait.recv().ok());
        let written = |n| failed.as_ref().is_some_and(|failed| !failed.contains(n));
        numbers.iter().map(written).collect()
    }

    /// What sessions in `state` that ended have left, the newest first, and how many more there are.
    pub fn left(&self, state: &Path) -> (Vec<Ended>, usize) {
        ended::all(state, &self.folder)
    }
}

/// Writes what is wished for, one after the other.
struct Writer {
    folder: PathBuf,
    told: Told,
    /// What could not be written.
    failed: BTreeMap<u32, Arc<Laid>>,
    /// What was told last.
    fault: Option<String>,
}

impl Writer {
    fn run(mut self, waiting: &Receiver<Wish>) {
        loop {
            let patience = if self.failed.is_empty() { Duration::MAX } else { RETRY };
            let first = match waiting.recv_timeout(patience) {
                Ok(wish) => Some(wish),
                Err(RecvTimeoutError::Timeout) => None,
                Err(RecvTimeoutError::Disconnected) => return,
            };
            if matches!(first, Some(Wish::Save(_) | Wish::Forget(_))) {
                std::thread::sleep(GATHER);
            }
            self.do_all(first.into_iter().chain(waiting.try_iter()));
        }
    }

    fn do_all(&mut self, wishes: impl Iterator<Item = Wish>) {
        let failed = std::mem::take(&mut self.failed);
        let mut grids: BTreeMap<u32, Option<Arc<Laid>>> =
            failed.into_iter().map(|(number, laid)| (number, Some(laid))).collect();
        let mut settled = Vec::new();
        for wish in wishes {
            match wish {
                Wish::Save(laid) => drop(grids.insert(laid.number, Some(laid))),
                Wish::Forget(number) => drop(grids.insert(number, None)),
                Wish::Settle(done) => settled.push(done),
            }
        }
        let mut fault = None;
        for (number, laid) in grids {
            let Some(laid) = laid else {
                own::remove(&self.folder, number);
                continue;
            };
            if let Err(error) = write(&self.folder, &laid) {
                fault = Some(format!("run {number}: {error}"));
                self.failed.insert(number, laid);
            }
        }
        if fault != self.fault {
            (self.told)(fault.clone());
            self.fault = fault;
        }
        for done in settled {
            let _ = done.send(self.failed.keys().copied().collect());
        }
    }
}

impl Drop for Writer {
    fn drop(&mut self) {
        if std::thread::panicking() {
            let message =
                "it broke off, a fault of gridshell: save what you need and start the studio again";
            (self.told)(Some(message.into()));
        }
    }
}

/// Write a grid, after the file of the surface that it lies on.
fn write(folder: &Path, laid: &Laid) -> Result<()> {
    let (mut design, _) = laid.finished()?;
    let mut folder = folder.to_owned();
    if let (Some(Reference::File { path, fnv1a, .. }), Some(bytes)) =
        (&mut design.document.surface, &laid.opened.file)
    {
        folder.push(&*fnv1a);
        let name = Path::new(path).file_name().unwrap_or_default().to_owned();
        let file = folder.join(&name);
        if !file.exists() {
            let unmade = |source| Error::Io { path: folder.clone(), source };
            own::private(&folder, true).map_err(unmade)?;
            io::replace(&file, bytes)?;
        }
        *path = name.to_string_lossy().into_owned();
    }
    design.write(&folder.join(own::grid_name(laid.number)), &Job::default()).map(|_| ())
}

#[cfg(test)]
mod tests;
