//! Where the design surface of a grid is, so that a run can be repeated: a name, or a file with what tells whether it is
//! still the same.

use super::{Opening, digest, file, load, open};
use crate::error::{Error, Result};
use crate::job::Job;
use crate::surface::{Model, builtin};
use serde::{Deserialize, Serialize};
use std::path::{Component, Path, PathBuf, absolute};

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

/// How far a grid file is believed when it says where its surface is. Who sent it may have written any path into it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Follow {
    /// To files in its own folder and below it, and to plain names below the current folder.
    #[default]
    Near,
    /// Wherever it says.
    Anywhere,
}

/// The surface that a grid file refers to, for a grid file at `beside`.
///
/// # Errors
/// As [`open`] and [`find_reference`].
pub fn open_reference(
    reference: &Reference,
    beside: &Path,
    follow: Follow,
    job: &Job,
) -> Result<Model> {
    match reference {
        Reference::Builtin(name) => open(name, job),
        Reference::File { path, opening, .. } => {
            let found = find_reference(reference, beside, follow, job)?;
            load(&found.unwrap_or_else(|| path.into()), opening, job)
        }
    }
}

/// The file that a grid file at `beside` refers to; None where it refers to a built-in surface.
///
/// # Errors
/// [`Error::Surface`] where it is too far away to be followed, or no longer the one that the grid was laid on; what
/// reading it gives.
pub fn find_reference(
    reference: &Reference,
    beside: &Path,
    follow: Follow,
    job: &Job,
) -> Result<Option<PathBuf>> {
    let Reference::File { path: told, bytes, fnv1a, .. } = reference else { return Ok(None) };
    let folder = beside.with_file_name("");
    let near = folder.join(told);
    // By the words alone: to ask the system for a place on another machine would mean to log in there.
    let inside = follow == Follow::Anywhere || is_below(&near, &folder);
    let path = match inside {
        true if near.exists() => near,
        _ if follow == Follow::Anywhere || is_plain(Path::new(told)) => PathBuf::from(told),
        true => near,
        false => {
            return Err(Error::Surface(format!(
                "{}: it refers to {}, outside its own folder; give that surface, or --follow to open what it refers to",
                beside.display(),
                told.chars().filter(|c| !c.is_control()).take(200).collect::<String>()
            )));
        }
    };
    // The length says first whether reading it is worth while.
    let same = file::length(&path)? == *bytes && {
        let now = file::read(&path, job)?;
        format!("{:016x}", digest::fnv1a_64(&now)) == *fnv1a
    };
    if same {
        return Ok(Some(path));
    }
    Err(Error::Surface(format!(
        "{}: the surface has changed since the grid in {} was laid on it",
        path.display(),
        beside.display()
    )))
}

/// Whether a path is of names only, from wherever one stands: no root, no drive or machine, no way up.
fn is_plain(path: &Path) -> bool {
    path.components().all(|c| matches!(c, Component::Normal(_) | Component::CurDir))
}

/// Whether `path` is in `folder` or below it, by its words.
fn is_below(path: &Path, folder: &Path) -> bool {
    let whole = |p: &Path| Some(without_ups(&absolute(p).ok()?));
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    matches!((whole(path), whole(folder)), (Some(p), Some(f)) if p.starts_with(&f))
}

/// An absolute path with each `..` taken together with the name before it.
fn without_ups(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => drop(out.pop()),
            part => out.push(part),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn referring(path: &str, contents: &[u8]) -> Reference {
        Reference::File {
            path: path.to_owned(),
            bytes: contents.len() as u64,
            fnv1a: format!("{:016x}", digest::fnv1a_64(contents)),
            opening: Opening::default(),
        }
    }

    #[test]
    fn what_lies_below_the_grid_file_is_followed_and_nothing_else_unasked() {
        let root = tempfile::tempdir().expect("a folder for the test");
        let at = |name: &str| root.path().join(name);
        std::fs::create_dir_all(at("grids/roofs")).expect("room");
        for name in ["grids/roof.obj", "grids/roofs/roof.obj", "secret.obj"] {
            std::fs::write(at(name), name).expect("room");
        }
        let find = |told: &str, name: &str, follow| {
            find_reference(
                &referring(told, name.as_bytes()),
                &at("grids/a.gridshell"),
                follow,
                &Job::default(),
            )
        };
        let whole = at("grids/roof.obj").display().to_string();
        let secret = at("secret.obj").display().to_string();
        for (told, name) in [
            ("roof.obj", "grids/roof.obj"),
            ("./roofs/../roof.obj", "grids/roof.obj"),
            ("roofs/roof.obj", "grids/roofs/roof.obj"),
            (&whole, "grids/roof.obj"),
        ] {
            let found = find(told, name, Follow::Near).expect(told).expect("a file");
            assert_eq!(std::fs::read(found).expect("there"), name.as_bytes(), "{told}");
        }
        for told in ["../secret.obj", "roofs/../../secret.obj", &secret, "/dev/zero"] {
            let error = find(told, "secret.obj", Follow::Near).expect_err(told);
            assert!(error.to_string().contains("--follow"), "{told}: {error}");
        }
        for told in ["../secret.obj", &secret] {
            find(told, "secret.obj", Follow::Anywhere).expect(told);
        }
        if cfg!(unix) {
            assert!(matches!(find("/dev/zero", "", Follow::Anywhere), Err(Error::Parse { .. })));
        }
    }

    #[test]
    fn another_length_or_other_bytes_are_another_surface() {
        let root = tempfile::tempdir().expect("a folder for the test");
        std::fs::write(root.path().join("roof.obj"), "v 0 0 0").expect("room");
        for contents in ["v 0 0 0 0", "v 0 0 1", ""] {
            let reference = referring("roof.obj", contents.as_bytes());
            let beside = root.path().join("a.gridshell");
            let error = find_reference(&reference, &beside, Follow::Near, &Job::default())
                .expect_err(contents);
            assert!(error.to_string().contains("has changed"), "{error}");
        }
    }
}
