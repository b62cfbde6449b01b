//! Autosave: every grid on the desk as a `.gridshell` file in a folder of its own for each studio, and what studios
//! that ended have left there.
//!
//! ```text
//! STATE/1763877600-4711/lock                     locked as long as that studio runs, however it ends
//!                       3.gridshell              run 3 as it is, edits and all
//!                       9f2c…/4.gridshell        run 4, which lies on a file
//!                       9f2c…/roof.step          that file, in a folder named by its digest
//! ```
//!
//! A grid that was saved by hand since it last changed is not kept here.

use crate::laid::{Finished, Laid};
use crate::message::Left;
use gridshell::error::{Error, Result};
use gridshell::io::{self, Document, GridFile, Reference};
use gridshell::job::Job;
use gridshell::structure::Structure;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// Changes are gathered for so long before they are written.
const GATHER: Duration = Duration::from_millis(200);
/// Sessions that are kept; the oldest go first.
const MOST_LEFT: usize = 10;

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
    /// Say when all before is done.
    Settle(Sender<()>),
}

impl Session {
    /// Begin a session in the folder `state`, which is made where it is missing.
    ///
    /// # Errors
    /// What the system says.
    pub fn begin(state: &Path, log: crate::Log) -> std::io::Result<Session> {
        let since = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        let folder = state.join(format!("{}-{}", since.as_millis(), std::process::id()));
        private(state)?;
        private(&folder)?;
        let lock = File::create(folder.join("lock"))?;
        lock.lock()?;
        let (wishes, waiting) = channel();
        let to = folder.clone();
        std::thread::spawn(move || write_all(&to, &waiting, &log));
        Ok(Session { folder, wishes, _lock: lock })
    }

    /// Keep a grid as it is; written soon, in another thread.
    pub fn save(&self, laid: &Arc<Laid>) {
        let _ = self.wishes.send(Wish::Save(Arc::clone(laid)));
    }

    /// Keep a grid no longer.
    pub fn forget(&self, number: u32) {
        let _ = self.wishes.send(Wish::Forget(number));
    }

    /// Wait until all is written.
    pub fn settle(&self) {
        let (done, wait) = channel();
        if self.wishes.send(Wish::Settle(done)).is_ok() {
            let _ = wait.recv();
        }
    }

    /// What sessions in `state` that ended have left, the newest first.
    pub fn left(&self, state: &Path) -> Vec<Ended> {
        let Ok(entries) = fs::read_dir(state) else { return Vec::new() };
        let folders = entries.flatten().map(|e| e.path()).filter(|p| *p != self.folder);
        let mut all: Vec<Ended> = folders.filter_map(Ended::find).collect();
        all.sort_by_key(|ended| Reverse(ended.when));
        all.drain(all.len().min(MOST_LEFT)..).for_each(Ended::discard);
        all
    }
}

/// A folder for this user only.
fn private(folder: &Path) -> std::io::Result<()> {
    let mut builder = fs::DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(folder)
}

fn write_all(folder: &Path, waiting: &Receiver<Wish>, log: &crate::Log) {
    while let Ok(first) = waiting.recv() {
        let mut grids = BTreeMap::new();
        let mut settled = Vec::new();
        let mut take = |wish| match wish {
            Wish::Save(laid) => drop(grids.insert(laid.number, Some(laid))),
            Wish::Forget(number) => drop(grids.insert(number, None)),
            Wish::Settle(done) => settled.push(done),
        };
        let hurry = matches!(first, Wish::Settle(_));
        take(first);
        if !hurry {
            std::thread::sleep(GATHER);
        }
        waiting.try_iter().for_each(take);
        for (number, laid) in grids {
            let done = match laid {
                Some(laid) => write(folder, &laid).map_err(|e| e.to_string()),
                None => remove(folder, number).map_err(|e| e.to_string()),
            };
            if let Err(message) = done {
                log(&format!("autosave of run {number}: {message}"));
            }
        }
        for done in settled {
            let _ = done.send(());
        }
    }
}

/// Write a grid, after the file of the surface that it lies on.
fn write(folder: &Path, laid: &Laid) -> Result<()> {
    let Finished { mut document, schedule, .. } = laid.finished();
    let mut folder = folder.to_owned();
    if let (Some(Reference::File { path, fnv1a, .. }), Some(bytes)) =
        (&mut document.surface, &laid.opened.file)
    {
        folder.push(&*fnv1a);
        let name = Path::new(path).file_name().unwrap_or_default().to_owned();
        let file = folder.join(&name);
        if !file.exists() {
            private(&folder).map_err(|source| Error::Io { path: folder.clone(), source })?;
            io::replace(&file, bytes)?;
        }
        *path = name.to_string_lossy().into_owned();
    }
    let structure = Structure::default();
    let file = GridFile { document: &document, schedule: &schedule, structure: &structure };
    io::write(&folder.join(format!("{}.gridshell", laid.number)), &file, &Job::default())
        .map(|_| ())
}

fn remove(folder: &Path, number: u32) -> std::io::Result<()> {
    for (known, path) in grids(folder)? {
        if known == number {
            fs::remove_file(path)?;
        }
    }
    Ok(())
}

/// The grid files of a session by their numbers.
fn grids(folder: &Path) -> std::io::Result<Vec<(u32, PathBuf)>> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(inner) = folders.pop() {
        for path in fs::read_dir(inner)?.flatten().map(|e| e.path()) {
            let number = path.file_stem().and_then(|s| s.to_str()?.parse().ok());
            let is_grid = path.extension().is_some_and(|e| e == "gridshell");
            match number {
                Some(number) if is_grid => found.push((number, path)),
                _ if path.is_dir() => folders.push(path),
                _ => {}
            }
        }
    }
    found.sort();
    Ok(found)
}

/// A session that ended without its grids being saved by hand.
pub struct Ended {
    /// Its grids and the files that they are in, in the order of their numbers.
    pub grids: Vec<(PathBuf, Document)>,
    folder: PathBuf,
    when: SystemTime,
    /// So that no other studio offers it too.
    lock: File,
}

impl Ended {
    /// The session in this folder, if it has ended and left anything; an empty one is cleared away.
    fn find(folder: PathBuf) -> Option<Ended> {
        let lock = File::options().write(true).open(folder.join("lock")).ok()?;
        lock.try_lock().ok()?;
        let numbered = grids(&folder).ok()?;
        let time = |p: &PathBuf| fs::metadata(p).and_then(|m| m.modified()).ok();
        let when = numbered.iter().filter_map(|n| time(&n.1)).max();
        let read = |(_, path): (u32, PathBuf)| {
            Some((path.clone(), io::read_document(&path, &Job::default()).ok()?))
        };
        let empty = numbered.is_empty();
        let grids: Vec<_> = numbered.into_iter().filter_map(read).collect();
        let ended = Ended { grids, folder, when: when.unwrap_or(UNIX_EPOCH), lock };
        if empty {
            ended.discard();
            return None;
        }
        (!ended.grids.is_empty()).then_some(ended)
    }

    /// Its name in messages.
    pub fn name(&self) -> String {
        self.folder.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// As the page is told of it.
    pub fn told(&self) -> Left {
        let grid = |(_, d): &(PathBuf, Document)| {
            let edits = match d.edits.len() {
                0 => String::new(),
                1 => ", 1 edit".into(),
                n => format!(", {n} edits"),
            };
            format!("{}, {} nodes{edits}", d.name, d.nodes.len())
        };
        Left {
            session: self.name(),
            seconds: self.when.duration_since(UNIX_EPOCH).unwrap_or_default().as_secs_f64(),
            grids: self.grids.iter().map(grid).collect(),
        }
    }

    /// Clear it away.
    pub fn discard(self) {
        let Ended { folder, lock, .. } = self;
        drop(lock);
        // What cannot be removed is offered again.
        let _ = fs::remove_dir_all(folder);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gridshell::grid::Grid;

    fn grid_file(folder: &Path) {
        let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(|[x, y]| glam::dvec3(x, y, 0.0));
        let (grid, _) = Grid::alone("one", points.to_vec(), &[[0, 1, 2]]).unwrap();
        let document = Document::of_grid("one", &grid);
        let (_, surface) = Grid::alone("one", points.to_vec(), &[[0, 1, 2]]).unwrap();
        let schedule = gridshell::schedule::Schedule::new(
            &grid,
            &surface,
            &gridshell::schedule::Tolerances::default(),
        );
        let structure = Structure::default();
        let file = GridFile { document: &document, schedule: &schedule, structure: &structure };
        io::write(&folder.join("3.gridshell"), &file, &Job::default()).unwrap();
    }

    #[test]
    fn a_session_is_offered_once_it_has_ended_and_cleared_away_where_it_left_nothing() {
        let state = tempfile::tempdir().unwrap();
        let log: crate::Log = Arc::new(|_: &str| {});
        let own = Session::begin(state.path(), Arc::clone(&log)).unwrap();
        std::thread::sleep(Duration::from_millis(2));
        let running = Session::begin(state.path(), Arc::clone(&log)).unwrap();
        grid_file(&running.folder);
        assert!(own.left(state.path()).is_empty(), "another studio is at it");
        drop(running);
        std::thread::sleep(Duration::from_millis(2));
        let empty = Session::begin(state.path(), log).unwrap();
        let nothing = empty.folder.clone();
        drop(empty);
        let left = own.left(state.path());
        assert_eq!(left.len(), 1);
        assert_eq!(left[0].told().grids, ["one, 3 nodes"]);
        assert!(!nothing.exists());
        assert!(own.left(state.path()).is_empty(), "it is offered by one studio only");
        left.into_iter().for_each(Ended::discard);
        assert!(own.left(state.path()).is_empty());
    }

    #[test]
    fn a_damaged_file_is_left_where_it_is() {
        let state = tempfile::tempdir().unwrap();
        let folder = state.path().join("1-1");
        fs::create_dir(&folder).unwrap();
        fs::write(folder.join("lock"), "").unwrap();
        fs::write(folder.join("1.gridshell"), "{ half a gr").unwrap();
        let own = Session::begin(state.path(), Arc::new(|_: &str| {})).unwrap();
        assert!(own.left(state.path()).is_empty());
        assert!(folder.join("1.gridshell").exists());
    }
}
