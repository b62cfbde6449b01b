//! Reading text line by line: numbers, and errors that name the line.

use crate::error::{Error, Result};
use crate::job::Job;
use glam::DVec3;
use std::iter::Enumerate;
use std::path::Path;
use std::str::FromStr;

/// One line of a text file, for its words and for saying where something went wrong.
#[derive(Clone, Copy)]
pub(super) struct Line<'a> {
    path: &'a Path,
    /// From 1.
    number: usize,
    /// Without comment.
    pub(super) text: &'a str,
}

/// The lines of a text that are not blank once their comment is cut off at `#`.
/// They end early where the job is over, which the caller is to check.
pub(super) fn lines<'a>(path: &'a Path, text: &'a str, job: &'a Job) -> Lines<'a> {
    Lines { path, job, rest: text.lines().enumerate() }
}

/// What [`lines`] gives.
#[derive(Clone)]
pub(super) struct Lines<'a> {
    path: &'a Path,
    job: &'a Job,
    rest: Enumerate<std::str::Lines<'a>>,
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        loop {
            if self.job.is_over("reading") {
                return None;
            }
            let (k, line) = self.rest.next()?;
            let text = line.split('#').next().unwrap_or_default().trim();
            if !text.is_empty() {
                return Some(Line { path: self.path, number: k + 1, text });
            }
        }
    }
}

impl<'a> Line<'a> {
    /// Its number, from 1.
    pub(super) fn number_in_file(&self) -> usize {
        self.number
    }

    /// What is wrong in this line.
    pub(super) fn error(&self, message: impl Into<String>) -> Error {
        Error::Parse {
            path: self.path.to_owned(),
            place: format!("line {}", self.number),
            message: message.into(),
        }
    }

    /// A number from a word of this line; `what` names it for the user.
    pub(super) fn number<T: FromStr>(&self, word: Option<&str>, what: &str) -> Result<T> {
        let Some(word) = word else {
            return Err(self.error(format!("{what} is missing")));
        };
        let hint = if word.contains(',') { ": write numbers with a point" } else { "" };
        // Fortran writes the exponents of its longer numbers with D.
        let parsed = word.parse().or_else(|_| word.replace(['d', 'D'], "e").parse());
        parsed.map_err(|_: T::Err| self.error(format!("`{}` is not {what}{hint}", clip(word))))
    }

    /// Three coordinates from the next words.
    pub(super) fn point(&self, words: &mut impl Iterator<Item = &'a str>) -> Result<DVec3> {
        let mut p = [0.0; 3];
        for (c, name) in p.iter_mut().zip(["x", "y", "z"]) {
            *c = self.number(words.next(), &format!("a coordinate ({name})"))?;
        }
        let p = DVec3::from(p);
        if p.is_finite() { Ok(p) } else { Err(self.error("a coordinate is not finite")) }
    }
}

/// Index of the vertex that a word of a face or line in an OBJ file means (`v`, `v/vt`, `v//vn` or `v/vt/vn`);
/// counted from 1, or backwards from the latest above with -1. So many there are above, and in all.
pub(super) fn vertex(line: &Line, word: &str, [above, all]: [usize; 2]) -> Result<u32> {
    let index: i64 = line.number(word.split('/').next(), "a vertex number")?;
    let from_zero =
        if index < 0 { i64::try_from(above).unwrap_or(i64::MAX) + index } else { index - 1 };
    match usize::try_from(from_zero) {
        Ok(v) if v < all => Ok(v as u32),
        _ if index < 0 => {
            Err(line.error(format!("vertex {index} is used, but only {above} are given above")))
        }
        _ => Err(line.error(format!("vertex {index} is used, but only {all} are given"))),
    }
}

/// An error about the file as a whole, or a place in it that is not a line.
pub(super) fn error(path: &Path, place: impl Into<String>, message: impl Into<String>) -> Error {
    Error::Parse { path: path.to_owned(), place: place.into(), message: message.into() }
}

/// The beginning of a word, so that garbage does not flood the screen.
pub(super) fn clip(word: &str) -> String {
    word.chars().take(40).filter(|c| !c.is_control()).collect()
}
