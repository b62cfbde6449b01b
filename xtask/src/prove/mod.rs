//! The promise on files that nobody has seen: surfaces and damage drawn at random go through the command, and each run
//! must end with a valid grid, or a refusal in words, within the limits.
//!
//! Grids are checked from their OBJ files alone, by code that shares nothing with the library. What fails is kept in a
//! folder below the target folder under the number it was drawn with, so that `prove --seed N --cases 1` draws it again.

mod check;
mod damage;
mod draw;
mod patch;

use crate::build::{self, target};
use crate::watched::{self, Watched};
use check::Known;
use draw::{Drawn, draw};
use std::fs;
use std::path::Path;
use std::process::Command;

/// Cases where no number is given.
const CASES: u64 = 1000;
/// Processor seconds and megabytes that one may take.
const SECONDS: f64 = 10.0;
const MEGABYTES: f64 = 500.0;
/// Nodes asked for.
const NODES: &str = "400";
/// What is said of nodes at nearly one place, where the surface is to blame.
const NARROW: [&str; 3] =
    ["as the surface is that narrow", "as two borders are that near", "as two borders touch there"];
/// Exit codes of a refusal: input that cannot be used, no valid grid.
const REFUSALS: [i32; 2] = [3, 4];
/// A grid's area over its surface's, and the other way round: beyond, members leap over what they should follow.
const AREA: [f64; 2] = [0.5, 1.15];

/// How many cases, from which seed on, and whether their files are damaged.
#[derive(Debug, PartialEq)]
pub struct Plan {
    cases: u64,
    seed: u64,
    damaged: bool,
}

impl Plan {
    /// From the words behind `prove`.
    ///
    /// # Errors
    /// The word that makes no sense.
    pub fn parse(words: &[&str]) -> Result<Plan, String> {
        let mut plan = Plan { cases: CASES, seed: 1, damaged: false };
        let mut words = words.iter();
        while let Some(&word) = words.next() {
            let mut number = || {
                let next = words.next().and_then(|w| w.parse().ok());
                next.ok_or_else(|| format!("{word} needs a whole number"))
            };
            match word {
                "--cases" => plan.cases = number()?,
                "--seed" => plan.seed = number()?,
                "--damaged" => plan.damaged = true,
                _ => return Err(format!("`{word}` is none of --cases N, --seed N, --damaged")),
            }
        }
        Ok(plan)
    }
}

/// Run the plan; what fails is listed and kept.
///
/// # Errors
/// How many failed.
pub fn run(plan: &Plan) -> Result<(), String> {
    let gridshell = build::gridshell()?;
    let folder = target().join("prove");
    fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let (mut laid, mut refused, mut failed) = (0, 0, 0);
    for seed in plan.seed..plan.seed + plan.cases {
        let drawn = draw(seed);
        let path = folder.join(format!("{seed}.{}", drawn.extension));
        let bytes = if plan.damaged {
            damage::damaged(drawn.text.as_bytes(), seed)
        } else {
            drawn.text.clone().into_bytes()
        };
        fs::write(&path, bytes).map_err(|e| format!("{}: {e}", path.display()))?;
        let grid = folder.join(format!("{seed}.grid.obj"));
        let ran = watched::run(Command::new(&gridshell).arg("generate").arg(&path).args([
            "--nodes",
            NODES,
            "--effort",
            "draft",
            "-o",
            &grid.to_string_lossy(),
        ]))?;
        match verdict(&ran, &grid, (!plan.damaged).then_some(&drawn)) {
            Ok(true) => laid += 1,
            Ok(false) => refused += 1,
            Err(why) => {
                failed += 1;
                println!("{seed} {}: {why}", drawn.what);
                continue;
            }
        }
        for done in [path, grid] {
            // A refused case has no grid.
            let _ = fs::remove_file(done);
        }
    }
    println!("{laid} laid, {refused} refused in words, {failed} failed");
    if failed == 0 {
        Ok(())
    } else {
        Err(format!("{failed} of {} failed: see {}", plan.cases, folder.display()))
    }
}

/// Whether a grid was laid (true) or refused (false) as promised; what is wrong otherwise.
fn verdict(ran: &Watched, grid: &Path, drawn: Option<&Drawn>) -> Result<bool, String> {
    if ran.processor > SECONDS {
        return Err(format!("{:.1} processor seconds", ran.processor));
    }
    if ran.megabytes > MEGABYTES {
        return Err(format!("{:.0} MB", ran.megabytes));
    }
    match ran.code {
        Some(0) => {
            let text = fs::read_to_string(grid).map_err(|e| format!("no grid: {e}"))?;
            let known = Known {
                euler: drawn.map(|d| d.euler),
                sharpest: drawn.map_or(-1.0, |d| d.sharpest),
                narrow: drawn.is_none() && NARROW.iter().any(|said| ran.stdout.contains(said)),
            };
            let area = check::valid(&text, known)?;
            let share = drawn.map_or(1.0, |d| area / d.area);
            if !(AREA[0]..=AREA[1]).contains(&share) {
                return Err(format!("area {share:.3} of the surface's"));
            }
            Ok(true)
        }
        Some(code) if REFUSALS.contains(&code) => {
            let told = ran.stderr.lines().any(|l| l.starts_with("gridshell: ") && l.len() > 30);
            if told { Ok(false) } else { Err(format!("exit {code} without words: {}", ran.stderr)) }
        }
        other => Err(format!("exit {other:?}: {}", ran.stderr.trim())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plan_names_the_word_that_makes_no_sense() {
        let plan = Plan::parse(&["--cases", "7", "--damaged"]).unwrap();
        assert_eq!(plan, Plan { cases: 7, seed: 1, damaged: true });
        assert!(Plan::parse(&["--seed", "x"]).unwrap_err().contains("--seed"));
        assert!(Plan::parse(&["--sead"]).unwrap_err().contains("--sead"));
    }
}
