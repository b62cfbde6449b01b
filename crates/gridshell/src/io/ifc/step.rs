//! STEP text as it grows: entities, one a line, and how their values are written.

use super::super::digest::{Digest, IfcId};
use crate::io::WRITING;
use crate::job::Job;
use glam::DVec3;
use std::fmt::{self, Arguments, Display, Formatter, Write};

/// The file as it grows.
pub(super) struct Step<'a> {
    /// Once it is over nothing more is put; the caller is to check.
    job: &'a Job,
    pub out: String,
    /// Number of the latest entity.
    pub last: usize,
    /// What global identifiers are made of, besides a name.
    own: Digest,
}

impl<'a> Step<'a> {
    /// A file that begins so; its identifiers are its own by this text.
    pub fn new(out: String, own: &str, job: &'a Job) -> Step<'a> {
        Step { job, out, last: 0, own: Digest::default().with(own.as_bytes()).with(b" | ") }
    }

    /// Put an entity behind the others; gives its number.
    pub fn put(&mut self, entity: Arguments) -> usize {
        self.last += 1;
        if !self.job.is_over(WRITING) {
            let _ = writeln!(self.out, "#{}={entity};", self.last);
        }
        self.last
    }

    /// An entity of three numbers.
    pub fn triple(&mut self, kind: &str, p: DVec3) -> usize {
        self.put(format_args!("{kind}({})", Triple(p)))
    }

    /// A global identifier for this name in this file.
    pub fn id(&self, name: impl Display) -> IfcId {
        let mut digest = self.own;
        let _ = write!(digest, "{name}");
        IfcId(digest.0)
    }
}

/// Three numbers in brackets.
pub(super) struct Triple(pub DVec3);

impl Display for Triple {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let DVec3 { x, y, z } = self.0;
        write!(f, "({},{},{})", Real(x), Real(y), Real(z))
    }
}

/// A number as STEP wants it: with a point, and no exponent.
#[derive(Clone, Copy)]
pub(super) struct Real(pub f64);

impl Display for Real {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let point = if self.0.fract() == 0.0 { "." } else { "" };
        write!(f, "{}{point}", self.0)
    }
}

pub(super) fn references(numbers: impl Iterator<Item = usize>) -> String {
    let mut text = String::new();
    for n in numbers {
        let comma = if text.is_empty() { "" } else { "," };
        let _ = write!(text, "{comma}#{n}");
    }
    text
}

/// A text as it stands between quotes (ISO 10303-21, 6.4.3): signs of its own doubled, letters beyond ASCII by their
/// numbers.
pub(super) fn encoded(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        let _ = match c {
            '\'' | '\\' => write!(out, "{c}{c}"),
            c if c.is_control() => write!(out, " "),
            c if c.is_ascii() => write!(out, "{c}"),
            c if c as u32 <= 0xffff => write!(out, "\\X2\\{:04X}\\X0\\", c as u32),
            c => write!(out, "\\X4\\{:08X}\\X0\\", c as u32),
        };
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_of_all_tongues_survive_and_numbers_have_points() {
        assert_eq!(encoded("Fu\u{df}'s\\"), "Fu\\X2\\00DF\\X0\\''s\\\\");
        assert_eq!(encoded("\u{1f600}\n"), "\\X4\\0001F600\\X0\\ ");
        assert_eq!(Triple(DVec3::new(2.0, -1e-7, -0.0)).to_string(), "(2.,-0.0000001,-0.)");
    }
}
