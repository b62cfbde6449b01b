//! Writing to the terminal: results to stdout, everything else to stderr.

use crate::failure::Failure;
use serde::Serialize;
use std::io::{ErrorKind, Write, stdout};

/// Print a result. A reader that has gone away is not a failure.
pub fn result(text: &str) -> Result<(), Failure> {
    let mut out = stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => Err(Failure::other(format!("stdout: {e}"))),
        _ => Ok(()),
    }
}

/// Print a document.
pub fn json(document: &impl Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string(document).map_err(Failure::other)?;
    result(&(text + "\n"))
}

/// Tell what of a file could not be read, and what was done to it while reading. With several files `of` says which.
pub fn reading(of: &str, losses: &[String], notes: &[String]) {
    for line in losses {
        note(&format!("warning: {of}{line}"));
    }
    for line in notes {
        note(&format!("note: {of}{line}"));
    }
}

/// Tell the user something beside the result.
pub fn note(text: &str) {
    // Nobody to tell is not a failure.
    let _ = writeln!(std::io::stderr(), "{text}");
}
