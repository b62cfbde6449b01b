//! `gridshell surfaces`: the built-in ones.

use crate::Outcome;
use crate::failure::Failure;
use crate::say;
use gridshell::surface::builtin;
use std::fmt::Write;

pub fn run() -> Result<Outcome, Failure> {
    let mut text = format!("{:12} {:>13}\n", "name", "edge length m");
    for b in builtin::ALL {
        let _ = writeln!(text, "{:12} {:13}  {}", b.name, b.edge_length, b.description);
    }
    say::result(&text)?;
    Ok(Outcome::Done)
}
