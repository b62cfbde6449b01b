//! Cargo and what it makes.

use std::path::{Path, PathBuf};
use std::process::Command;

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

/// The command `gridshell`, built for speed.
pub fn command() -> Result<PathBuf, String> {
    cargo(&["build", "--release", "--quiet", "--package", "gridshell-cli"], &[])?;
    Ok(target().join("release/gridshell"))
}

/// Where cargo puts what it builds.
pub fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../target"), PathBuf::from)
}
