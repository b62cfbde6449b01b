//! Cargo and what it makes.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};

/// Run cargo itself, with these arguments and variables.
pub fn cargo(args: &[&str], variables: &[(&str, &str)]) -> Result<(), String> {
    let status = command_line(args)
        .envs(variables.iter().copied())
        .status()
        .map_err(|e| format!("cargo does not start: {e}"))?;
    ended(args, status)
}

/// Run cargo, pass on what it prints, and show `hear` every line of it.
pub fn cargo_aloud(args: &[&str], mut hear: impl FnMut(&str)) -> Result<(), String> {
    let mut child = command_line(args)
        .stdout(Stdio::piped())
        .spawn()
        .map_err(|e| format!("cargo does not start: {e}"))?;
    let stdout = child.stdout.take().ok_or("cargo has no output")?;
    for line in BufReader::new(stdout).lines().map_while(Result::ok) {
        println!("{line}");
        hear(&line);
    }
    let status = child.wait().map_err(|e| e.to_string())?;
    ended(args, status)
}

/// Run cargo, and take what it prints.
pub fn read_cargo(args: &[&str]) -> Result<String, String> {
    let output = command_line(args).stderr(Stdio::inherit()).output();
    let output = output.map_err(|e| format!("cargo does not start: {e}"))?;
    ended(args, output.status)?;
    String::from_utf8(output.stdout).map_err(|e| e.to_string())
}

fn command_line(args: &[&str]) -> Command {
    eprintln!("cargo {}", args.join(" "));
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(args);
    command
}

fn ended(args: &[&str], status: ExitStatus) -> Result<(), String> {
    if status.success() { Ok(()) } else { Err(format!("cargo {} failed", args[0])) }
}

/// The command `gridshell`, built for speed.
pub fn gridshell() -> Result<PathBuf, String> {
    cargo(&["build", "--release", "--quiet", "--package", "gridshell-cli"], &[])?;
    Ok(target().join(format!("release/gridshell{}", std::env::consts::EXE_SUFFIX)))
}

/// The command `gridshell` as the tests have it: whoever has run them waits for nothing.
pub fn tested() -> Result<PathBuf, String> {
    cargo(&["test", "--workspace", "--no-run", "--quiet"], &[])?;
    let command = target().join("debug/gridshell");
    command.canonicalize().map_err(|e| format!("{}: {e}", command.display()))
}

/// Where cargo puts what it builds.
pub fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../target"), PathBuf::from)
}
