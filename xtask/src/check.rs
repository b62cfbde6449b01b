//! What must hold before a change is shared.

use std::process::Command;

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

/// Run cargo itself, with these arguments and variables.
pub fn cargo(args: &[&str], variables: &[(&str, &str)]) -> Result<(), String> {
    eprintln!("cargo {}", args.join(" "));
    let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let status = Command::new(program)
        .args(args)
        .envs(variables.iter().copied())
        .status()
        .map_err(|e| format!("cargo does not start: {e}"))?;
    if status.success() { Ok(()) } else { Err(format!("cargo {} failed", args[0])) }
}
