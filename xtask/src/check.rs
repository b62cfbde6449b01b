//! What must hold before a change is shared.

use crate::build::cargo;

/// Format, clippy on all targets, rustdoc.
pub fn lint() -> Result<(), String> {
    cargo(&["fmt", "--all", "--check"], &[])?;
    cargo(&["clippy", "--workspace", "--all-targets", "--quiet", "--", "-D", "warnings"], &[])?;
    cargo(&["doc", "--workspace", "--no-deps", "--quiet"], &[("RUSTDOCFLAGS", "-D warnings")])
}

/// Every test of the workspace, and those in the documentation.
pub fn test() -> Result<(), String> {
    cargo(&["test", "--workspace", "--quiet"], &[])
}
