//! Whole files, out: a reader sees the old contents or the new ones, and never a part, whatever comes between.
//!
//! New contents go to a new file beside the old one (a rename cannot cross file systems), are brought to the disk, and
//! then renamed over it. The new file has a name that nobody can guess or have made before, and is locked while it is
//! written: what a killed process leaves is not, and is cleared away by the next one that writes there.

use crate::error::{Error, Result};
use std::fs::{self, File, Metadata, TryLockError};
use std::io::Write;
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

/// How names of files that are being written begin and end.
const PREFIX: &str = ".gridshell-";
const SUFFIX: &str = ".part";
/// Letters drawn between them.
const DRAWN: usize = 10;
/// Tries to make a new file, where another process clears it away before it is locked.
const TRIES: usize = 8;

/// Write `bytes` to `path`. A link stays one: what it leads to is replaced. A file that is replaced keeps its mode, and
/// its owner where that is allowed; other hard links to it keep the old contents.
///
/// # Errors
/// [`Error::Option`] where `path` is, or leads to, what must not be replaced: a folder, a device, a pipe, a file that may
/// not be written. [`Error::Io`] from the system.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<()> {
    replace_all(&[(path.to_owned(), bytes)])
}

/// As [`replace`] for files that belong together: none is renamed before all are written.
///
/// # Errors
/// As [`replace`].
pub(super) fn replace_all(files: &[(PathBuf, &[u8])]) -> Result<()> {
    let written: Vec<Written> =
        files.iter().map(|(path, bytes)| Written::new(path, bytes)).collect::<Result<_>>()?;
    let mut folders: Vec<PathBuf> = Vec::new();
    for file in written {
        folders.push(file.target.folder.clone());
        file.put()?;
    }
    folders.sort();
    folders.dedup();
    for folder in folders {
        settle(&folder);
        clear(&folder);
    }
    Ok(())
}

/// Whether [`replace`] could write this file now: to be asked before long work.
///
/// # Errors
/// As [`replace`]; [`Error::Option`] where the folder is missing.
pub fn check_place(path: &Path) -> Result<()> {
    let target = Target::of(path)?;
    target.new_file().map(drop).map_err(|source| io(path, source))
}

fn io(path: &Path, source: std::io::Error) -> Error {
    Error::Io { path: path.to_owned(), source }
}

/// Where contents go.
struct Target {
    /// The file itself, links followed.
    file: PathBuf,
    folder: PathBuf,
    /// What is there now.
    old: Option<Metadata>,
}

impl Target {
    fn of(path: &Path) -> Result<Target> {
        let refuse = |why: &str| Err(Error::Option(format!("{}: {why}", path.display())));
        let file = if path.is_symlink() { path.canonicalize().ok() } else { Some(path.to_owned()) };
        let Some(file) = file else {
            return refuse("this link leads nowhere; remove it, or give another name");
        };
        let folder = file.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let folder = folder.to_owned();
        if !folder.is_dir() {
            return refuse(&format!("there is no folder {}", folder.display()));
        }
        let old = match fs::metadata(&file) {
            Ok(old) => Some(old),
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => None,
            Err(source) => return Err(io(path, source)),
        };
        match &old {
            Some(old) if old.is_dir() => {
                refuse("this is a folder; give the file a name of its own")
            }
            Some(old) if !old.is_file() => {
                refuse("this is a device or a pipe; only files are replaced")
            }
            // Who may write to anything is told by the mode, others by the system.
            Some(old) if old.permissions().readonly() || !may_write(&file) => refuse(
                "this file is read-only, and is left as it is; make it writable, or give another name",
            ),
            _ => Ok(Target { file, folder, old }),
        }
    }

    /// A new file beside it, locked.
    fn new_file(&self) -> std::io::Result<NamedTempFile> {
        let mut builder = Builder::new();
        builder.prefix(PREFIX).suffix(SUFFIX).rand_bytes(DRAWN);
        // As for any new file the user's mask takes from it.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        for _ in 1..TRIES {
            let file = builder.tempfile_in(&self.folder).map_err(|e| plain(&e))?;
            // Where files cannot be locked none is cleared away either.
            let _ = file.as_file().lock();
            if file.path().exists() {
                return Ok(file);
            }
        }
        builder.tempfile_in(&self.folder).map_err(|e| plain(&e))
    }
}

/// The same without the name that was drawn, which tells nobody anything.
fn plain(error: &std::io::Error) -> std::io::Error {
    error.kind().into()
}

fn may_write(file: &Path) -> bool {
    match File::options().append(true).open(file) {
        Err(e) => e.kind() != std::io::ErrorKind::PermissionDenied,
        Ok(_) => true,
    }
}

/// A file that has been written and is not yet in its place.
struct Written<'a> {
    path: &'a Path,
    target: Target,
    file: NamedTempFile,
}

impl<'a> Written<'a> {
    /// Written and brought to the disk; cleared away where that fails.
    fn new(path: &'a Path, bytes: &[u8]) -> Result<Written<'a>> {
        let target = Target::of(path)?;
        let write = || -> std::io::Result<NamedTempFile> {
            let mut file = target.new_file()?;
            file.as_file_mut().write_all(bytes)?;
            if let Some(old) = &target.old {
                keep(old, file.as_file())?;
            }
            file.as_file().sync_all()?;
            Ok(file)
        };
        let file = write().map_err(|source| io(path, source))?;
        Ok(Written { path, target, file })
    }

    fn put(self) -> Result<()> {
        let done = self.file.persist(&self.target.file);
        done.map(drop).map_err(|e| io(self.path, e.error))
    }
}

/// Give the new file the old one's owner, where that is allowed, and its mode.
fn keep(old: &Metadata, new: &File) -> std::io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, fchown};
        let now = new.metadata()?;
        if (now.uid(), now.gid()) != (old.uid(), old.gid()) {
            // One of the two may be allowed where both are not.
            let _ = fchown(new, Some(old.uid()), None);
            let _ = fchown(new, None, Some(old.gid()));
        }
    }
    new.set_permissions(old.permissions())
}

/// Bring the folder's new names to the disk. Where the system does not do that for folders, it does so by itself.
fn settle(folder: &Path) {
    if cfg!(unix) {
        let _ = File::open(folder).and_then(|folder| folder.sync_all());
    }
}

/// Clear away what killed processes left in a folder: files of ours that nobody holds.
fn clear(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let ours = name.len() == PREFIX.len() + DRAWN + SUFFIX.len()
            && name.starts_with(PREFIX)
            && name.ends_with(SUFFIX);
        if ours && entry.file_type().is_ok_and(|kind| kind.is_file()) {
            clear_one(&entry.path());
        }
    }
}

fn clear_one(path: &Path) {
    let Ok(file) = File::options().write(true).open(path) else { return };
    // Held until it is gone, so that who has just made it sees that.
    match file.try_lock() {
        Ok(()) => drop(fs::remove_file(path)),
        Err(TryLockError::WouldBlock | TryLockError::Error(_)) => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder() -> tempfile::TempDir {
        tempfile::tempdir().expect("a folder for the test")
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).expect("readable").flatten();
        let mut names: Vec<String> =
            entries.map(|e| e.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    #[test]
    fn files_that_belong_together_are_all_new_or_all_old() {
        let folder = folder();
        let [a, b] = ["a", "b"].map(|name| folder.path().join(name));
        replace_all(&[(a.clone(), b"1"), (b.clone(), b"1")]).expect("written");
        // The second cannot be written: a folder is in its place.
        let c = folder.path().join("c");
        fs::create_dir(&c).expect("room");
        assert!(replace_all(&[(a.clone(), b"2"), (c, b"2")]).is_err());
        assert_eq!([&a, &b].map(|p| fs::read(p).expect("readable")), [b"1", b"1"]);
        assert_eq!(names(folder.path()), ["a", "b", "c"], "nothing is left over");
    }

    #[cfg(unix)]
    #[test]
    fn a_link_to_a_file_stays_one_and_others_are_refused() {
        use std::os::unix::fs::symlink;
        let folder = folder();
        let [file, link] = ["file", "link"].map(|name| folder.path().join(name));
        fs::write(&file, "old").expect("room");
        symlink(&file, &link).expect("room");
        replace(&link, b"new").expect("written");
        assert!(link.is_symlink() && fs::read(&file).expect("readable") == b"new");
        for (name, to) in [("null", "/dev/null"), ("nowhere", "nowhere/file"), ("round", "round")] {
            let link = folder.path().join(name);
            symlink(to, &link).expect("room");
            for done in [replace(&link, b"new"), check_place(&link)] {
                assert!(matches!(done, Err(Error::Option(_))), "{name}: {done:?}");
            }
            assert!(link.is_symlink(), "{name}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_replaced_file_keeps_its_mode_and_a_read_only_one_stays() {
        use std::os::unix::fs::PermissionsExt;
        let folder = folder();
        let file = folder.path().join("file");
        let mode = || fs::metadata(&file).expect("there").permissions().mode() & 0o777;
        for wanted in [0o600, 0o640, 0o664, 0o755] {
            fs::write(&file, "old").expect("room");
            fs::set_permissions(&file, PermissionsExt::from_mode(wanted)).expect("own file");
            replace(&file, b"new").expect("written");
            assert_eq!((mode(), fs::read(&file).expect("readable")), (wanted, b"new".to_vec()));
        }
        fs::set_permissions(&file, PermissionsExt::from_mode(0o444)).expect("own file");
        assert!(replace(&file, b"newer").unwrap_err().to_string().contains("read-only"));
        assert_eq!((mode(), fs::read(&file).expect("readable")), (0o444, b"new".to_vec()));
    }

    #[test]
    fn the_longest_names_work_and_left_overs_that_nobody_holds_are_cleared() {
        let folder = folder();
        let at = |name: &str| folder.path().join(name);
        let held = Target::of(&at("x")).and_then(|t| t.new_file().map_err(|e| io(&at("x"), e)));
        let held = held.expect("made");
        let left = format!("{PREFIX}{}{SUFFIX}", "a".repeat(DRAWN));
        let other = format!("{PREFIX}notes{SUFFIX}");
        for name in [&left, &other] {
            fs::write(at(name), "half").expect("room");
        }
        let long = "g".repeat(251) + ".obj";
        replace(&at(&long), b"new").expect("written");
        let mut wanted = vec![other, long];
        wanted.push(held.path().file_name().expect("a name").to_string_lossy().into_owned());
        wanted.sort();
        assert_eq!(names(folder.path()), wanted);
    }

    #[test]
    fn a_place_is_checked_and_nothing_is_left_there() {
        let folder = folder();
        check_place(&folder.path().join("a.obj")).expect("a good place");
        assert!(names(folder.path()).is_empty());
        assert!(check_place(folder.path()).is_err(), "a folder");
        assert!(check_place(&folder.path().join("none/a.obj")).is_err(), "no folder");
    }
}
