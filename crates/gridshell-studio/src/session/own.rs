//! What in the state folder is the studio's own: nothing else is ever removed.
//!
//! A session's folder is named `MILLISECONDS-PROCESS`, belongs to this user, and holds a file `lock` with our mark. In
//! it our files are that lock, `N.gridshell`, and in folders named by a digest the same and the file of that digest.
//! Files go one by one and folders only when they are empty, so whatever else lies there stays.

use gridshell::io::{self, Opening, Reference};
use gridshell::job::Job;
use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The file that a running studio locks.
pub const LOCK: &str = "lock";
/// What it holds. Version 0.1.0 left it empty.
pub const MARK: &str = "gridshell studio: grids kept against crashes\n";
/// Hexadecimal digits of a surface's digest.
const DIGEST: usize = 16;

/// The name of a session that begins so long after 1970.
pub fn name(since: Duration) -> String {
    format!("{}-{}", since.as_millis(), std::process::id())
}

/// Whether a session may have this name.
pub fn is_name(name: &OsStr) -> bool {
    let digits = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let parts = name.to_str().and_then(|name| name.split_once('-'));
    parts.is_some_and(|(time, process)| digits(time) && digits(process))
}

/// Whether this is a folder of our making, by its name and owner; `like` is one that is.
pub fn is_session(folder: &Path, like: &Path) -> bool {
    let named = folder.file_name().is_some_and(is_name);
    named && is_folder(folder) && is_file(&folder.join(LOCK)) && same_owner(folder, like)
}

/// The file name of a grid.
pub fn grid_name(number: u32) -> String {
    format!("{number}.gridshell")
}

/// The grid files of a session by their numbers.
pub fn grids(folder: &Path) -> std::io::Result<Vec<(u32, PathBuf)>> {
    let mut found = Vec::new();
    for inner in std::iter::once(folder.to_owned()).chain(copies(folder)?) {
        for path in fs::read_dir(inner)?.flatten().map(|e| e.path()) {
            let number = path.file_stem().and_then(|s| s.to_str()?.parse().ok());
            let own = |n: &u32| path.file_name().is_some_and(|name| name == &*grid_name(*n));
            if let Some(number) = number.filter(own)
                && is_file(&path)
            {
                found.push((number, path));
            }
        }
    }
    found.sort();
    Ok(found)
}

/// The folders in it that hold copies of surfaces.
fn copies(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let digest = |name: &str| name.len() == DIGEST && name.bytes().all(|b| b.is_ascii_hexdigit());
    let is_copy =
        |p: &PathBuf| p.file_name().and_then(OsStr::to_str).is_some_and(digest) && is_folder(p);
    Ok(fs::read_dir(folder)?.flatten().map(|e| e.path()).filter(is_copy).collect())
}

/// Remove a grid of a session. What cannot be removed is offered again, so errors are no matter.
pub fn remove(folder: &Path, number: u32) {
    let all = grids(folder).unwrap_or_default();
    for (_, path) in all.into_iter().filter(|grid| grid.0 == number) {
        let _ = fs::remove_file(path);
    }
}

/// Remove what is left of a session without grids: copies of surfaces that no grid lies on any more, and the folder
/// with the lock, unless there is anything else in it.
pub fn clear(folder: &Path) {
    for copy in copies(folder).unwrap_or_default() {
        clear_copy(&copy);
    }
    let marked = fs::read_to_string(folder.join(LOCK)).is_ok_and(|text| text == MARK);
    let entries = fs::read_dir(folder).map(|all| all.flatten().count());
    if marked && entries.is_ok_and(|n| n == 1) {
        let _ = fs::remove_file(folder.join(LOCK));
        let _ = fs::remove_dir(folder);
    }
}

/// Remove the surface's file that a folder was named for, if no grid is left beside it.
fn clear_copy(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    let files: Vec<PathBuf> = entries.flatten().map(|e| e.path()).collect();
    if files.iter().any(|p| p.extension().is_some_and(|e| e == "gridshell")) {
        return;
    }
    for file in files.into_iter().filter(|f| is_file(f)) {
        let reference =
            io::reference(&file.to_string_lossy(), &Opening::default(), &Job::default());
        let is_copy = |r: &Reference| match r {
            Reference::File { fnv1a, .. } => folder.ends_with(fnv1a),
            Reference::Builtin(_) => false,
        };
        if reference.is_ok_and(|r| is_copy(&r)) {
            let _ = fs::remove_file(file);
        }
    }
    let _ = fs::remove_dir(folder);
}

/// Make a folder for this user only; `found` says whether it may be there already.
pub fn private(folder: &Path, found: bool) -> std::io::Result<()> {
    let mut builder = fs::DirBuilder::new();
    builder.recursive(found);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(folder)
}

/// Close the state folder to others if it holds nothing but ours. One that holds more is the user's to close: it is
/// refused where others may write to it, as they could put a folder of theirs in the place of one of ours.
#[cfg(unix)]
pub fn narrow(state: &Path) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    let mut modes = fs::metadata(state)?.permissions();
    let mode = modes.mode();
    let (open, written, sticky) = (mode & 0o077 != 0, mode & 0o022 != 0, mode & 0o1000 != 0);
    if !open {
        return Ok(());
    }
    let ours = fs::read_dir(state)?.flatten().all(|entry| is_name(&entry.file_name()));
    // A sticky folder is meant for many users.
    if ours && !sticky {
        modes.set_mode(0o700);
        return fs::set_permissions(state, modes);
    }
    if written {
        let message = format!(
            "others may write to this folder (mode {:o}): close it with `chmod go-w`, or name another with --state",
            mode & 0o7777
        );
        return Err(std::io::Error::other(message));
    }
    Ok(())
}

/// Elsewhere folders inherit who may use them.
#[cfg(not(unix))]
pub fn narrow(_: &Path) -> std::io::Result<()> {
    Ok(())
}

/// No link to one.
fn is_folder(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|m| m.is_dir())
}

/// No link to one, nor a device.
fn is_file(path: &Path) -> bool {
    fs::symlink_metadata(path).is_ok_and(|m| m.is_file())
}

#[cfg(unix)]
fn same_owner(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let owner = |path: &Path| fs::symlink_metadata(path).ok().map(|m| m.uid());
    owner(a).is_some() && owner(a) == owner(b)
}

#[cfg(not(unix))]
fn same_owner(_: &Path, _: &Path) -> bool {
    true
}
