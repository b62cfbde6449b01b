//! `gridshell studio`: the server, and the browser that is opened at it.

use crate::Outcome;
use crate::args::{Limits, Studio};
use crate::failure::Failure;
use crate::progress::memory_limit;
use crate::say;
use gridshell_studio::{Error, Options, Redirect};
use std::env;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;

pub fn run(args: &Studio, limits: &Limits) -> Result<Outcome, Failure> {
    if limits.time_limit.is_some() {
        return Err(Failure::usage("the studio has no time limit: leave out `--time-limit`"));
    }
    let options = Options {
        memory_limit: memory_limit(limits),
        surface: args.surface.clone(),
        port: args.port,
        log: Arc::new(say::note),
        page: args.page.clone(),
        state: args.state.clone().or_else(state).filter(|_| !args.no_autosave),
    };
    let told = |address: &str| {
        // Who started it needs the address even where nothing reads standard output any more.
        let _ = say::result(&format!("the studio is at {address} (Ctrl-C ends it)\n"));
        if args.no_browser {
            return None;
        }
        let redirect = Redirect::to(address).ok()?;
        open(&redirect.path());
        Some(redirect)
    };
    gridshell_studio::run(options, told).map_err(|e| match e {
        Error::Surface(e) => Failure::of_input(e),
        Error::Io(e) => Failure::other(e),
    })?;
    Ok(Outcome::Done)
}

/// Where programs of this system keep what they were at; None where the user has no such folder.
fn state() -> Option<PathBuf> {
    let folder = |name| env::var_os(name).map(PathBuf::from).filter(|p| p.is_absolute());
    let root = if cfg!(target_os = "macos") {
        folder("HOME")?.join("Library/Application Support")
    } else if cfg!(windows) {
        folder("LOCALAPPDATA")?
    } else {
        folder("XDG_STATE_HOME").or_else(|| Some(folder("HOME")?.join(".local/state")))?
    };
    Some(root.join("gridshell/studio"))
}

/// Open the user's browser with this file; where that fails, the address has been printed.
fn open(page: &Path) {
    let program = if cfg!(target_os = "macos") {
        "open"
    } else if cfg!(windows) {
        "explorer"
    } else {
        "xdg-open"
    };
    let mut command = Command::new(program);
    command.arg(page).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let _ = command.spawn();
}
