//! What is given to others.

use crate::build::cargo;
use crate::page;
use std::process::Command;

/// The crates as they are published. The studio's has the built page inside, which cargo takes for a change that is
/// not committed: so changes are looked for here.
pub fn crates() -> Result<(), String> {
    let status = Command::new("git").args(["status", "--porcelain"]).output();
    let changed = status.map_err(|e| format!("git does not start: {e}"))?.stdout;
    if !changed.is_empty() {
        let changed = String::from_utf8_lossy(&changed);
        return Err(format!("packages are made of what is committed; changed are\n{changed}"));
    }
    page::build()?;
    cargo(&["package", "--workspace", "--exclude", "xtask", "--allow-dirty"], &[])
}
