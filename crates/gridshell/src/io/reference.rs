//! Where the design surface of a grid is, so that a run can be repeated: a name, or a file with what tells whether it is
//! still the same.

use super::{Opening, digest, file, load, open};
use crate::error::{Error, Result};
use crate::job::Job;
use crate::surface::{Model, builtin};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Where a design surface is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Reference {
    /// A built-in one, by its name.
    Builtin(String),
    /// A file.
    File {
        /// Its path as it was given; looked for beside the grid file first, then in the current folder.
        path: String,
        /// Its length.
        bytes: u64,
        /// FNV-1a of its contents (64 bits, hexadecimal): tells whether it is still the same.
        fnv1a: String,
        /// How it was opened.
        #[serde(default, skip_serializing_if = "is_usual")]
        opening: Opening,
    },
}

fn is_usual(opening: &Opening) -> bool {
    *opening == Opening::default()
}

/// The reference to the surface that this name or path stands for, opened in this way.
///
/// # Errors
/// What reading the file gives.
pub fn reference(name_or_path: &str, opening: &Opening, job: &Job) -> Result<Reference> {
    if builtin::model(name_or_path).is_some() {
        return Ok(Reference::Builtin(name_or_path.to_owned()));
    }
    let bytes = file::read(Path::new(name_or_path), job)?;
    Ok(Reference::File {
        path: name_or_path.to_owned(),
        bytes: bytes.len() as u64,
        fnv1a: format!("{:016x}", digest::fnv1a_64(&bytes)),
        opening: opening.clone(),
    })
}

/// The surface that a grid file refers to, for a grid file at `beside`.
///
/// # Errors
/// As [`open`]; [`Error::Surface`] where the file is no longer the one that the grid was laid on.
pub fn open_reference(reference: &Reference, beside: &Path, job: &Job) -> Result<Model> {
    match reference {
        Reference::Builtin(name) => open(name, job),
        Reference::File { path, bytes, fnv1a, opening } => {
            let near = beside.with_file_name("").join(path);
            let path = if near.exists() { near } else { path.into() };
            let now = file::read(&path, job)?;
            let same =
                now.len() as u64 == *bytes && format!("{:016x}", digest::fnv1a_64(&now)) == *fnv1a;
            if !same {
                return Err(Error::Surface(format!(
                    "{}: the surface has changed since the grid in {} was laid on it",
                    path.display(),
                    beside.display()
                )));
            }
            load(&path, opening, job)
        }
    }
}
