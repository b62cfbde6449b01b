//! Fuzzing: libFuzzer on the readers, through `cargo fuzz` and the nightly compiler.
//!
//! Inputs that did something new are kept in `fuzz/corpus`, which is not shared; finds in `fuzz/artifacts`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Minutes for each reader where none are given.
const MINUTES: u64 = 15;
/// Seconds that one file may take.
const SECONDS: u64 = 10;
/// Megabytes that one file may take.
const MEGABYTES: u64 = 1024;

/// What to fuzz, and for how long.
#[derive(Debug, PartialEq)]
pub struct Plan {
    /// Names of targets; all when empty.
    readers: Vec<String>,
    /// For each of them.
    minutes: u64,
}

impl Plan {
    /// From the words behind `fuzz`.
    pub fn parse(words: &[&str]) -> Result<Plan, String> {
        let mut plan = Plan { readers: Vec::new(), minutes: MINUTES };
        let mut words = words.iter();
        while let Some(&word) = words.next() {
            if word == "--minutes" {
                let minutes = words.next().and_then(|m| m.parse().ok()).filter(|&m| m > 0);
                plan.minutes = minutes.ok_or("--minutes needs a whole number above 0")?;
            } else {
                plan.readers.push(word.to_owned());
            }
        }
        Ok(plan)
    }
}

/// Run the targets one after the other; ends at the first find.
pub fn run(plan: &Plan) -> Result<(), String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz");
    let all = targets(&folder)?;
    if let Some(unknown) = plan.readers.iter().find(|r| !all.contains(r)) {
        return Err(format!("`{unknown}` is none of the readers: {}", all.join(", ")));
    }
    if !Command::new("cargo-fuzz").arg("--version").output().is_ok_and(|o| o.status.success()) {
        return Err("cargo-fuzz is not there: run `cargo install cargo-fuzz`".into());
    }
    let wanted = if plan.readers.is_empty() { &all } else { &plan.readers };
    wanted.iter().try_for_each(|target| fuzz(&folder, target, plan.minutes))
}

fn fuzz(folder: &Path, target: &str, minutes: u64) -> Result<(), String> {
    let corpus = folder.join("corpus").join(target);
    fs::create_dir_all(&corpus).map_err(|e| format!("{}: {e}", corpus.display()))?;
    let seeds: PathBuf = folder.join("seeds").join(target);
    let limits = [
        format!("-max_total_time={}", 60 * minutes),
        format!("-timeout={SECONDS}"),
        format!("-rss_limit_mb={MEGABYTES}"),
    ];
    let [folder, corpus, seeds] = [folder, &corpus, &seeds].map(|p| p.display().to_string());
    // There is no unsafe code of ours to watch, so no sanitizer: many times as many files are tried.
    let status = Command::new("cargo-fuzz")
        .args(["fuzz", "run", "--sanitizer", "none", "--fuzz-dir", &folder])
        .args([target, &corpus, &seeds, "--"])
        .args(limits)
        // The cargo that runs this is told in these variables, and is another one.
        .env("RUSTUP_TOOLCHAIN", "nightly")
        .env("CARGO", "cargo")
        .status()
        .map_err(|e| format!("cargo-fuzz does not start: {e}"))?;
    if status.success() { Ok(()) } else { Err(format!("{target}: see fuzz/artifacts/{target}")) }
}

/// The names of the targets, in alphabetical order.
fn targets(folder: &Path) -> Result<Vec<String>, String> {
    let folder = folder.join("fuzz_targets");
    let entries = fs::read_dir(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut names: Vec<String> = entries
        .filter_map(|e| Some(e.ok()?.path().file_stem()?.to_string_lossy().into_owned()))
        .collect();
    names.sort();
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn readers_and_minutes_are_understood_in_any_order() {
        let plan = Plan::parse(&["obj", "--minutes", "2", "ply"]).expect("a plan");
        assert_eq!(plan, Plan { readers: vec!["obj".into(), "ply".into()], minutes: 2 });
        assert!(Plan::parse(&["--minutes", "x"]).is_err());
        assert!(Plan::parse(&["--minutes"]).is_err());
    }

    #[test]
    fn every_target_has_seeds_and_a_place_in_the_manifest() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz");
        let manifest = fs::read_to_string(folder.join("Cargo.toml")).expect("it is there");
        for target in targets(&folder).expect("it can be listed") {
            assert!(manifest.contains(&format!("name = \"{target}\"")), "{target}");
            assert!(folder.join("seeds").join(&target).is_dir(), "{target}");
        }
    }
}
