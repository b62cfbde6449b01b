//! Whole files, in and out: a limit on what is read, and no half-written file left behind.

use super::READING;
use crate::error::{Error, Result};
use crate::job::{Job, Picture};
use std::fs;
use std::path::{Path, PathBuf};

/// Larger files are refused: they are no design surface, and reading them would fill the memory.
const MAX_BYTES: u64 = 1 << 30;

/// The contents of a file.
///
/// # Errors
/// [`Error::Io`] from the system, [`Error::Parse`] for a file of more than a gigabyte.
pub(super) fn read(path: &Path, job: &Job) -> Result<Vec<u8>> {
    job.check(READING)?;
    job.progress("read", 0.0, Picture::None);
    let io = |source| Error::Io { path: path.to_owned(), source };
    let size = fs::metadata(path).map_err(io)?.len();
    if size > MAX_BYTES {
        return Err(Error::Parse {
            path: path.to_owned(),
            place: format!("{size} bytes"),
            message:
                "larger than the limit of 1 GiB; export a coarser mesh or only the surface wanted"
                    .into(),
        });
    }
    job.reserve(2.0 * size as f64, &format!("reading {}", path.display()))?;
    fs::read(path).map_err(io)
}

/// Write `bytes` to `path`: first to a new file beside it, then renamed over it, so that a reader sees the
/// old contents or the new ones and never a part.
///
/// # Errors
/// [`Error::Io`] from the system.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<()> {
    replace_all(&[(path.to_owned(), bytes)])
}

/// As [`replace`] for files that belong together: none is renamed before all are written.
///
/// # Errors
/// [`Error::Io`] from the system.
pub(super) fn replace_all(files: &[(PathBuf, &[u8])]) -> Result<()> {
    let write = |(path, bytes): &(PathBuf, &[u8])| of(path, fs::write(beside(path), bytes));
    let rename = |(path, _): &(PathBuf, &[u8])| of(path, fs::rename(beside(path), linked(path)));
    let done = files.iter().try_for_each(write).and_then(|()| files.iter().try_for_each(rename));
    if done.is_err() {
        for (path, _) in files {
            // Whether this succeeds or not, the first error is the one to tell.
            let _ = fs::remove_file(beside(path));
        }
    }
    done
}

/// Whether [`replace`] could write this file now: to be asked before long work.
///
/// # Errors
/// [`Error::Option`] where the folder is missing or the file is one, [`Error::Io`] where nothing may be written there.
pub fn check_place(path: &Path) -> Result<()> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let refuse = |why: String| Err(Error::Option(format!("{}: {why}", path.display())));
    if !folder.is_dir() {
        return refuse(format!("there is no folder {}", folder.display()));
    }
    if path.is_dir() {
        return refuse("this is a folder; give the file a name of its own".to_owned());
    }
    let beside = beside(path);
    of(path, fs::File::create(&beside).and_then(|_| fs::remove_file(&beside)))
}

fn of<T>(path: &Path, done: std::io::Result<T>) -> Result<()> {
    done.map(|_| ()).map_err(|source| Error::Io { path: path.to_owned(), source })
}

/// The file that a link stands for, so that the link stays one; else the path itself.
fn linked(path: &Path) -> PathBuf {
    if path.is_symlink() { path.canonicalize().unwrap_or(path.to_owned()) } else { path.to_owned() }
}

/// A hidden name in the same folder (a rename cannot cross file systems), told apart by process.
fn beside(path: &Path) -> PathBuf {
    let path = linked(path);
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".{name}.{}.part", std::process::id()))
}

/// File name without folder and extension.
pub(super) fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Run a test in an empty folder of its own.
    fn within(name: &str, test: impl Fn(&Path)) {
        let folder = std::env::temp_dir().join(format!("gridshell-{}-{name}", std::process::id()));
        fs::create_dir(&folder).expect("room in the temporary folder");
        test(&folder);
        fs::remove_dir_all(&folder).expect("it was just made");
    }

    #[test]
    fn files_that_belong_together_are_all_new_or_all_old() {
        within("together", |folder| {
            let [a, b] = ["a", "b"].map(|name| folder.join(name));
            replace_all(&[(a.clone(), b"1"), (b.clone(), b"1")]).expect("written");
            // The second cannot be written: where its new file would be is a folder.
            fs::create_dir(beside(&b)).expect("room");
            let said = replace_all(&[(a.clone(), b"2"), (b.clone(), b"2")]);
            assert!(matches!(said, Err(Error::Io { path, .. }) if path == b));
            assert_eq!([&a, &b].map(|p| fs::read(p).expect("readable")), [b"1", b"1"]);
            assert!(!beside(&a).exists(), "nothing is left over");
        });
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_one() {
        within("link", |folder| {
            let [file, link] = ["file", "link"].map(|name| folder.join(name));
            fs::write(&file, "old").expect("room");
            std::os::unix::fs::symlink(&file, &link).expect("room");
            replace(&link, b"new").expect("written");
            assert!(link.is_symlink() && fs::read(&file).expect("readable") == b"new");
        });
    }

    #[test]
    fn a_place_is_checked_and_nothing_is_left_there() {
        within("place", |folder| {
            check_place(&folder.join("a.obj")).expect("a good place");
            assert!(fs::read_dir(folder).expect("readable").next().is_none());
            assert!(check_place(folder).is_err(), "a folder");
            assert!(check_place(&folder.join("none/a.obj")).is_err(), "no folder");
        });
    }
}
