//! The studio's page: built for packages, and its tests: types and format, then a person's steps in Chromium.

use crate::build::tested;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Build it where the package of the studio takes it from.
pub fn build() -> Result<(), String> {
    let page = folder();
    npm(&page, &INSTALL)?;
    npm(&page, &["run", "build"])
}

/// The licences of the packages inside the page, once it is built.
pub fn licences() -> PathBuf {
    folder().join("dist/licences.md")
}

/// Run all tests; `hear` is told the result in a line like cargo's.
pub fn test(hear: &mut dyn FnMut(&str)) -> Result<(), String> {
    let page = folder();
    let chromium = chromium()?;
    npm(&page, &INSTALL)?;
    npm(&page, &["run", "check"])?;
    let command = tested()?;
    eprintln!("node --test");
    let output = Command::new("node")
        .args(["--test", "--test-concurrency=1", "--test-reporter=tap", "tests/"])
        .current_dir(&page)
        .env("GRIDSHELL", command)
        .env("CHROMIUM", chromium)
        .stderr(Stdio::inherit())
        .output()
        .map_err(|_| NODE.to_owned())?;
    let told = String::from_utf8_lossy(&output.stdout);
    println!("{told}");
    let count = |kind: &str| {
        told.lines().find_map(|l| l.strip_prefix(kind)?.trim().parse().ok()).unwrap_or(0_usize)
    };
    let [passed, failed, ignored] = ["# pass ", "# fail ", "# skipped "].map(count);
    let word = if output.status.success() { "ok" } else { "FAILED" };
    let line = format!("test result: {word}. {passed} passed; {failed} failed; {ignored} ignored");
    println!("{line}");
    hear(&line);
    if output.status.success() { Ok(()) } else { Err("the page's tests failed".into()) }
}

const NODE: &str = "the page wants Node 20.19 or newer with npm: install it";
const INSTALL: [&str; 4] = ["ci", "--prefer-offline", "--no-audit", "--no-fund"];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/gridshell-studio/page")
}

fn npm(folder: &Path, arguments: &[&str]) -> Result<(), String> {
    eprintln!("npm {}", arguments.join(" "));
    let status = Command::new("npm").args(arguments).current_dir(folder).status();
    match status.map_err(|_| NODE.to_owned())? {
        status if status.success() => Ok(()),
        _ => Err(format!("npm {} failed", arguments.join(" "))),
    }
}

/// The browser that CHROMIUM names, or Debian's, installed now if it is missing.
fn chromium() -> Result<PathBuf, String> {
    let named = std::env::var_os("CHROMIUM").map(PathBuf::from);
    let path = named.clone().unwrap_or_else(|| "/usr/bin/chromium".into());
    if named.is_none() && !path.exists() {
        let apt = |arguments: &[&str]| {
            eprintln!("apt-get {}", arguments.join(" "));
            let status = Command::new("apt-get").args(arguments).stdout(Stdio::null()).status();
            status.is_ok_and(|s| s.success())
        };
        let install = || apt(&["install", "--yes", "chromium"]);
        // The list of packages may be missing on a new machine.
        let _ = install() || (apt(&["update"]) && install());
    }
    if path.exists() {
        return Ok(path);
    }
    Err(format!(
        "there is no Chromium at {}: apt-get install chromium, or set CHROMIUM",
        path.display()
    ))
}
