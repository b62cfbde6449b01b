//! What must hold before a change is shared.

use crate::build::{cargo, cargo_aloud};
use crate::{page, readers};

/// Format, clippy on all targets, rustdoc of private items too.
pub fn lint() -> Result<(), String> {
    cargo(&["fmt", "--all", "--check"], &[])?;
    cargo(&["clippy", "--workspace", "--all-targets", "--quiet", "--", "-D", "warnings"], &[])?;
    let doc = ["doc", "--workspace", "--no-deps", "--document-private-items", "--quiet"];
    cargo(&doc, &[("RUSTDOCFLAGS", "-D warnings")])
}

/// Every test of the workspace, those in the documentation, and the readers of others; the last line printed sums them up as cargo
/// does for each.
pub fn test() -> Result<(), String> {
    let mut sum = Tally::default();
    let result = cargo_aloud(&["test", "--workspace", "--no-fail-fast", "--quiet"], |line| {
        sum.add(line);
    });
    let pages = page::test(&mut |line| sum.add(line));
    let read = readers::run();
    if let Ok(read) = &read {
        sum.passed += read.passed;
        sum.failed += read.failed;
        sum.ignored += read.skipped;
    }
    let result = result.and(pages).and(read.and_then(all_passed));
    let word = if result.is_ok() { "ok" } else { "FAILED" };
    println!(
        "test result: {word}. {} passed; {} failed; {} ignored",
        sum.passed, sum.failed, sum.ignored
    );
    result
}

/// Only what the readers of others say.
pub fn readers() -> Result<(), String> {
    all_passed(readers::run()?)
}

fn all_passed(read: readers::Tally) -> Result<(), String> {
    match read.failed {
        0 => Ok(()),
        n => Err(format!("{n} of the readers' tests failed")),
    }
}

/// Numbers of tests.
#[derive(Debug, Default, PartialEq)]
struct Tally {
    passed: usize,
    failed: usize,
    ignored: usize,
}

impl Tally {
    /// Add what a line of cargo's says, if it is a result.
    fn add(&mut self, line: &str) {
        let Some(counts) = line.strip_prefix("test result: ") else { return };
        let counts = counts.split_once(". ").map_or(counts, |(_, counts)| counts);
        for count in counts.split("; ") {
            let Some((number, kind)) = count.split_once(' ') else { continue };
            let number: usize = number.parse().unwrap_or(0);
            match kind {
                "passed" => self.passed += number,
                "failed" => self.failed += number,
                "ignored" => self.ignored += number,
                _ => {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Tally;

    #[test]
    fn results_add_up_and_other_lines_do_not() {
        let mut sum = Tally::default();
        for line in [
            "running 3 tests",
            "test result: ok. 3 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.1s",
            "test result: FAILED. 7 passed; 2 failed; 0 ignored; 0 measured; 0 filtered out",
        ] {
            sum.add(line);
        }
        assert_eq!(sum, Tally { passed: 10, failed: 2, ignored: 1 });
    }
}
