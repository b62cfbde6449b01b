//! Whole files, in: regular ones only, read through a limit.
//!
//! A device, a pipe or a file that grows while it is read ends in words, never in memory that runs out or in a
//! process that waits for ever.

use super::READING;
use crate::error::{Error, Result};
use crate::job::{Job, Picture};
use std::fs::{self, File, Metadata};
use std::io::Read;
use std::path::Path;

/// Larger files are refused: they are no design surface, and reading them would fill the memory.
const MAX_BYTES: u64 = 1 << 30;

/// The contents of a file of at most a gigabyte.
///
/// # Errors
/// [`Error::Io`] from the system, [`Error::Parse`] for what is no regular file, or is larger.
pub fn read(path: &Path, job: &Job) -> Result<Vec<u8>> {
    read_at_most(path, MAX_BYTES, job)
}

/// The contents of a file of at most `most` bytes.
///
/// # Errors
/// As [`read`].
pub fn read_at_most(path: &Path, most: u64, job: &Job) -> Result<Vec<u8>> {
    job.check(READING)?;
    job.progress("read", 0.0, Picture::None);
    let size = length(path)?;
    if size > most {
        return Err(too_large(path, most));
    }
    job.reserve(2.0 * size as f64, &format!("reading {}", path.display()))?;
    let io = |source| Error::Io { path: path.to_owned(), source };
    let file = File::open(path).map_err(io)?;
    // It may have become another one meanwhile.
    refuse_special(path, &file.metadata().map_err(io)?)?;
    let mut bytes = Vec::with_capacity(size as usize);
    file.take(most + 1).read_to_end(&mut bytes).map_err(io)?;
    if bytes.len() as u64 > most {
        return Err(too_large(path, most));
    }
    Ok(bytes)
}

/// The text in a file of at most `most` bytes.
///
/// # Errors
/// As [`read`]; [`Error::Parse`] where it is not UTF-8.
pub fn read_text(path: &Path, most: u64, job: &Job) -> Result<String> {
    String::from_utf8(read_at_most(path, most, job)?).map_err(|e| {
        let text = &e.as_bytes()[..e.utf8_error().valid_up_to()];
        let line = text.split(|&b| b == b'\n').count();
        refusal(
            path,
            &format!("line {line}"),
            "this is not text in UTF-8; save it in that encoding".to_owned(),
        )
    })
}

/// Bytes of a file.
///
/// # Errors
/// [`Error::Io`] from the system, [`Error::Parse`] for what is no regular file.
pub(super) fn length(path: &Path) -> Result<u64> {
    let io = |source| Error::Io { path: path.to_owned(), source };
    let metadata = fs::metadata(path).map_err(io)?;
    refuse_special(path, &metadata)?;
    Ok(metadata.len())
}

fn refuse_special(path: &Path, metadata: &Metadata) -> Result<()> {
    if metadata.is_file() {
        return Ok(());
    }
    let message = if metadata.is_dir() {
        "this is a folder; give the file in it"
    } else {
        "this is a device or a pipe; save what comes out of it to a file, and give that"
    };
    Err(refusal(path, "file", message.to_owned()))
}

fn too_large(path: &Path, most: u64) -> Error {
    let limit =
        if most >= 1 << 20 { format!("{} MiB", most >> 20) } else { format!("{most} bytes") };
    refusal(
        path,
        "file",
        format!("larger than the limit of {limit}; export a coarser mesh, or only what is wanted"),
    )
}

fn refusal(path: &Path, place: &str, message: String) -> Error {
    Error::Parse { path: path.to_owned(), place: place.to_owned(), message }
}

/// File name without folder and extension.
pub(super) fn stem(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_read_up_to_its_limit_and_refused_beyond() {
        let file = std::env::temp_dir().join(format!("gridshell-{}-limit", std::process::id()));
        fs::write(&file, b"v 0 0\xff").expect("room");
        assert_eq!(read_at_most(&file, 6, &Job::default()).expect("it fits"), b"v 0 0\xff");
        assert!(
            read_at_most(&file, 5, &Job::default())
                .unwrap_err()
                .to_string()
                .contains("limit of 5 bytes")
        );
        assert!(
            read_text(&file, 6, &Job::default())
                .unwrap_err()
                .to_string()
                .contains("line 1: this is not text")
        );
        fs::remove_file(&file).expect("it was just made");
    }

    #[test]
    fn folders_and_devices_are_refused() {
        let mut special = vec![std::env::temp_dir()];
        if cfg!(unix) {
            special.extend(["/dev/zero", "/dev/null"].map(Into::into));
        }
        for path in special {
            assert!(
                matches!(read(&path, &Job::default()), Err(Error::Parse { .. })),
                "{}",
                path.display()
            );
        }
    }
}
