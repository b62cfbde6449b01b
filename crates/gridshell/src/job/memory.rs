//! How much memory the process holds and the machine has.

use crate::error::{Error, Result};
use std::sync::{Mutex, OnceLock, PoisonError};
use sysinfo::{Pid, ProcessRefreshKind, ProcessesToUpdate, System};

/// The share of the machine's memory that a run may take where no limit is given: more would have the machine swap for
/// the other programs that run on it, less would refuse what it could do.
const USUAL_SHARE: f64 = 0.75;

/// Bytes in a unit of `--memory-limit`, by its first letter.
const UNITS: [(char, u64); 4] = [('k', 1 << 10), ('m', 1 << 20), ('g', 1 << 30), ('t', 1 << 40)];

/// What the process holds in memory now, bytes; None where the system does not tell.
pub fn resident() -> Option<u64> {
    static SEEN: OnceLock<Option<(Pid, Mutex<System>)>> = OnceLock::new();
    let seen = SEEN.get_or_init(|| Some((sysinfo::get_current_pid().ok()?, Mutex::default())));
    let (pid, system) = seen.as_ref()?;
    let mut system = system.lock().unwrap_or_else(PoisonError::into_inner);
    let memory = ProcessRefreshKind::nothing().with_memory();
    system.refresh_processes_specifics(ProcessesToUpdate::Some(&[*pid]), false, memory);
    system.process(*pid).map(sysinfo::Process::memory)
}

/// The limit where none is given, bytes: a share of what the machine, or the container, has. None where the system does
/// not tell.
pub fn usual_limit() -> Option<u64> {
    let mut system = System::new();
    system.refresh_memory();
    let container = system.cgroup_limits().map_or(u64::MAX, |limits| limits.total_memory);
    let whole = system.total_memory().min(container);
    (whole > 0).then_some((whole as f64 * USUAL_SHARE) as u64)
}

/// Bytes from text: `500M`, `2G`, `1.5GiB`, or a plain number of bytes; units count by 1024.
///
/// # Errors
/// [`Error::Option`] for other text, and for nothing or less.
pub fn parse(text: &str) -> Result<u64> {
    let wrong = || {
        Error::Option(format!("`{text}` is not an amount of memory: give one such as 500M or 2G"))
    };
    let text = text.trim();
    let end = text.find(|c: char| c.is_alphabetic()).unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let unit = unit.to_ascii_lowercase();
    let factor = match unit.trim_end_matches("ib").trim_end_matches('b') {
        "" if unit != "ib" => 1,
        letter => {
            let known = UNITS.iter().find(|u| letter == u.0.to_string());
            known.ok_or_else(wrong)?.1
        }
    };
    let number: f64 = number.trim().parse().map_err(|_| wrong())?;
    let bytes = number * factor as f64;
    if bytes.is_finite() && bytes >= 1.0 { Ok(bytes as u64) } else { Err(wrong()) }
}

/// An amount as people read it.
pub fn told(bytes: u64) -> String {
    let unit = UNITS.iter().rev().find(|u| bytes >= u.1);
    match unit {
        Some(&(letter, size)) => {
            format!("{:.1} {}iB", bytes as f64 / size as f64, letter.to_ascii_uppercase())
        }
        None => format!("{bytes} bytes"),
    }
}
