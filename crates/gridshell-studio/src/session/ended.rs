//! What a studio that ended without its grids being saved by hand has left.

use super::own;
use crate::message::{Damaged, Left};
use gridshell::io::{self, Document};
use gridshell::job::Job;
use std::cmp::Reverse;
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::time::{SystemTime, UNIX_EPOCH};

/// Sessions that are read and offered at once. Older ones wait until these are dealt with.
const MOST: usize = 10;

/// A session that ended.
pub struct Ended {
    /// Its grids and the files that they are in, in the order of their numbers.
    pub grids: Vec<(PathBuf, Document)>,
    /// Grids that cannot be read. They stay where they are unless the user throws the session away.
    damaged: Vec<Damaged>,
    folder: PathBuf,
    when: SystemTime,
    /// So that no other studio offers it too.
    lock: File,
}

/// What the sessions in `state` but `own` have left, the newest first, and how many more there are. Empty ones are
/// cleared away.
pub fn all(state: &Path, own: &Path) -> (Vec<Ended>, usize) {
    let Ok(entries) = fs::read_dir(state) else { return (Vec::new(), 0) };
    let folders = entries.flatten().map(|e| e.path());
    let folders = folders.filter(|folder| folder != own && own::is_session(folder, own));
    let mut found: Vec<Found> = folders.filter_map(Found::at).collect();
    found.sort_by_key(|found| Reverse(found.when));
    let more = found.len().saturating_sub(MOST);
    (found.into_iter().take(MOST).map(Found::read).collect(), more)
}

/// A session with grids, not read yet.
struct Found {
    folder: PathBuf,
    numbered: Vec<(u32, PathBuf)>,
    when: SystemTime,
    lock: File,
}

impl Found {
    /// The session in this folder, if it has ended and left anything.
    fn at(folder: PathBuf) -> Option<Found> {
        let path = folder.join(own::LOCK);
        let mut lock = File::options().read(true).write(true).open(path).ok()?;
        lock.try_lock().ok()?;
        let mut mark = String::new();
        lock.by_ref().take(1024).read_to_string(&mut mark).ok()?;
        if !mark.is_empty() && mark != own::MARK {
            return None;
        }
        let numbered = own::grids(&folder).ok()?;
        if numbered.is_empty() {
            drop(lock);
            own::clear(&folder);
            return None;
        }
        let time = |p: &PathBuf| fs::metadata(p).and_then(|m| m.modified()).ok();
        let when = numbered.iter().filter_map(|n| time(&n.1)).max().unwrap_or(UNIX_EPOCH);
        Some(Found { folder, numbered, when, lock })
    }

    fn read(self) -> Ended {
        let Found { folder, numbered, when, lock } = self;
        let mut ended = Ended { grids: Vec::new(), damaged: Vec::new(), folder, when, lock };
        for (_, path) in numbered {
            match io::read_document(&path, &Job::default()) {
                Ok(document) => ended.grids.push((path, document)),
                Err(error) => ended.damage(&path, &error.to_string()),
            }
        }
        ended
    }
}

impl Ended {
    /// Its name in messages.
    pub fn name(&self) -> String {
        self.folder.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// A grid of it cannot be used, for this reason.
    pub fn damage(&mut self, path: &Path, reason: &str) {
        let file = path.strip_prefix(&self.folder).unwrap_or(path).display().to_string();
        let named = format!("{}: ", path.display());
        let reason = reason.strip_prefix(&named).unwrap_or(reason).to_owned();
        self.damaged.push(Damaged { file, reason });
    }

    /// Whether there is nothing more to tell of it.
    pub fn is_done(&self) -> bool {
        self.grids.is_empty() && self.damaged.is_empty()
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
            damaged: self.damaged.clone(),
            folder: self.folder.display().to_string(),
        }
    }

    /// Clear a grid away that is kept elsewhere now.
    pub fn remove(path: &Path) {
        // What cannot be removed is offered again.
        let _ = fs::remove_file(path);
    }

    /// Clear away what no grid needs.
    pub fn clear(&self) {
        if own::grids(&self.folder).is_ok_and(|left| left.is_empty()) {
            own::clear(&self.folder);
        }
    }

    /// Clear all its grids away, damaged ones too: the user has seen what they are.
    pub fn discard(self) {
        for (_, path) in own::grids(&self.folder).unwrap_or_default() {
            Ended::remove(&path);
        }
        let Ended { folder, lock, .. } = self;
        drop(lock);
        own::clear(&folder);
    }
}
