//! Whole files, in and out: a limit on what is read, and no half-written file left behind.

use crate::error::{Error, Result};
use std::fs;
use std::path::{Path, PathBuf};

/// Larger files are refused: they are no design surface, and reading them would fill the memory.
const MAX_BYTES: u64 = 1 << 30;

/// The contents of a file.
///
/// # Errors
/// [`Error::Io`] from the system, [`Error::Parse`] for a file of more than a gigabyte.
pub(super) fn read(path: &Path) -> Result<Vec<u8>> {
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
    fs::read(path).map_err(io)
}

/// Write `bytes` to `path`: first to a new file beside it, then renamed over it, so that a reader sees the
/// old contents or the new ones and never a part.
///
/// # Errors
/// [`Error::Io`] from the system.
pub fn replace(path: &Path, bytes: &[u8]) -> Result<()> {
    let io = |source| Error::Io { path: path.to_owned(), source };
    let beside = beside(path);
    let done = fs::write(&beside, bytes).and_then(|()| fs::rename(&beside, path));
    if done.is_err() {
        // Whether this succeeds or not, the first error is the one to tell.
        let _ = fs::remove_file(&beside);
    }
    done.map_err(io)
}

/// A hidden name in the same folder (a rename cannot cross file systems), told apart by process.
fn beside(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".{name}.{}.part", std::process::id()))
}

/// File name without folder and extension.
pub(super) fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}
