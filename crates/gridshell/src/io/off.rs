//! Object File Format: `OFF`, three counts, vertices, faces. Colours, normals and texture are passed over.
//!
//! The format is a stream of words, wherever its lines break; only the colour of a face ends with its line. As
//! programs do not agree on what else they write, the file is read in the first way in which all of it makes sense:
//! word by word as its keyword says, one vertex or face a line, word by word with colours behind faces.

use super::grid_file::GridFile;
use super::mesh::soup::Soup;
use super::scan::{self, Line};
use super::{LengthUnit, file, text};
use crate::error::{Error, Result};
use crate::io::WRITING;
use crate::job::Job;
use glam::DVec3;
use std::fmt::Write;
use std::path::Path;

/// Read an OFF file in text, with or without colours (COFF), normals (NOFF), texture (STOFF) or a weight (4OFF).
///
/// # Errors
/// [`Error::Parse`] with the line.
pub(super) fn read(path: &Path, job: &Job) -> Result<Soup> {
    let bytes = file::read(path, job)?;
    let text = text::decode(&bytes);
    let comments = text.lines().filter_map(|line| line.split_once('#'));
    let unit = comments.map(|(_, comment)| comment).find_map(LengthUnit::stated);
    let (head, words) = Head::read(path, &text, job)?;
    let (points, faces) = body(&head, &words)?;
    Ok(Soup { points, faces, unit, ..Soup::default() })
}

/// Points, and faces of three or more corners.
type Body = (Vec<DVec3>, Vec<Vec<u32>>);

/// Read it in the first way in which it makes sense; else what is wrong in the likeliest.
fn body(head: &Head, words: &Words) -> Result<Body> {
    let plain = head.widths().map(|width| head.by_words(words.clone(), width, Rest::Nothing));
    let mut faults = Vec::new();
    for way in plain {
        match way {
            Ok(body) => return Ok(body),
            Err(fault) => faults.push(fault),
        }
    }
    let lines = words.below.clone().count();
    match head.by_lines(words) {
        Ok(body) => return Ok(body),
        // So many lines were meant as such.
        Err(fault) if lines as u64 == head.vertices.saturating_add(head.faces) => {
            return Err(fault);
        }
        Err(_) => {}
    }
    let mut coloured = head.widths().map(|w| head.by_words(words.clone(), w, Rest::ToLineEnd));
    match coloured.find_map(Result::ok) {
        Some(body) => Ok(body),
        None => Err(faults.swap_remove(0)),
    }
}

/// What may stand behind the corners of a face.
#[derive(Clone, Copy, PartialEq)]
enum Rest {
    Nothing,
    /// A colour, to the end of the line.
    ToLineEnd,
}

/// The words of the file, each with its line.
#[derive(Clone)]
struct Words<'a> {
    path: &'a Path,
    /// The line that is being read, its words, and the lines below it.
    line: Option<Line<'a>>,
    rest: std::str::SplitAsciiWhitespace<'a>,
    below: scan::Lines<'a>,
    job: &'a Job,
    /// The one line that they are the words of, where they are those of one.
    only: Option<Line<'a>>,
}

impl<'a> Words<'a> {
    fn new(path: &'a Path, text: &'a str, job: &'a Job) -> Words<'a> {
        let below = scan::lines(path, text, job);
        Words { path, line: None, rest: "".split_ascii_whitespace(), below, only: None, job }
    }

    /// The words of one line only.
    fn of(path: &'a Path, line: Line<'a>, job: &'a Job) -> Words<'a> {
        let rest = line.text.split_ascii_whitespace();
        let below = scan::lines(path, "", job);
        Words { path, line: Some(line), rest, below, only: Some(line), job }
    }

    fn word(&mut self) -> Option<(Line<'a>, &'a str)> {
        loop {
            if let (Some(line), Some(word)) = (self.line, self.rest.next()) {
                return Some((line, word));
            }
            let line = self.below.next()?;
            (self.line, self.rest) = (Some(line), line.text.split_ascii_whitespace());
        }
    }

    /// The next word as a number; `what` names it for the user.
    fn number<T: std::str::FromStr>(&mut self, what: &str) -> Result<T> {
        match (self.word(), self.only) {
            (Some((line, word)), _) => line.number(Some(word), what),
            (None, Some(line)) => line.number(None, what),
            (None, None) => Err(self.ends()),
        }
    }

    fn ends(&self) -> Error {
        let message = "the file ends before all vertices and faces are given";
        scan::error(self.path, "end of file", message)
    }

    /// How many words are left in this line.
    fn left(&self) -> usize {
        self.rest.clone().count()
    }
}

/// What the file begins with.
struct Head {
    vertices: u64,
    faces: u64,
    /// Words of a vertex: coordinates, normal, texture.
    width: usize,
    /// The fourth coordinate divides the others.
    weighted: bool,
    coloured: bool,
}

impl Head {
    /// Keyword, dimension and counts; what follows are the vertices.
    fn read<'a>(path: &'a Path, text: &'a str, job: &'a Job) -> Result<(Head, Words<'a>)> {
        let mut words = Words::new(path, text, job);
        let mut head = Head { vertices: 0, faces: 0, width: 3, weighted: false, coloured: false };
        let mut ahead = words.clone();
        let Some((line, keyword)) = ahead.word() else { return Err(words.ends()) };
        if keyword.to_ascii_uppercase().ends_with("OFF") {
            words = ahead;
            head.keyword(line, keyword, &mut words)?;
        }
        head.vertices = words.number("the number of vertices")?;
        head.faces = words.number("the number of faces")?;
        // A number of edges, which means nothing, stands in the same line, or in a line of its own.
        let mut ahead = words.clone();
        let same_line = words.left() > 0;
        if ahead.word().is_some() && (same_line || ahead.left() == 0) {
            words = ahead;
        }
        Ok((head, words))
    }

    /// `OFF` behind what each vertex has besides: `ST` texture, `C` colour, `N` normal, `4` a weight, `n` a dimension.
    fn keyword(&mut self, line: Line, keyword: &str, words: &mut Words) -> Result<()> {
        let mut ahead = words.clone();
        let binary = |word: &str| word.eq_ignore_ascii_case("BINARY");
        if ahead.word().is_some_and(|(_, word)| binary(word)) {
            return Err(line.error("binary OFF cannot be read; save the file as text"));
        }
        // Some programs write it in small letters, where n means a normal too.
        let small = keyword.bytes().all(|b| !b.is_ascii_uppercase());
        let keyword = if small { keyword.to_ascii_uppercase() } else { keyword.to_owned() };
        let prefix = &keyword[..keyword.len() - "OFF".len()];
        let parts = prefix.replace("ST", "t");
        for part in parts.chars() {
            match part {
                't' => self.width += 2,
                'C' => self.coloured = true,
                'N' => self.width += 3,
                '4' => self.weighted = true,
                'n' => {
                    let dimension: usize = words.number("the dimension")?;
                    if dimension != 3 {
                        let message = format!("only three dimensions can be read, not {dimension}");
                        return Err(line.error(message));
                    }
                }
                _ => {
                    return Err(
                        line.error(format!("`{}` is not an OFF file", scan::clip(&keyword)))
                    );
                }
            }
        }
        self.width += usize::from(self.weighted);
        Ok(())
    }

    /// How many words a vertex may have: a colour has four, or three.
    fn widths(&self) -> impl Iterator<Item = usize> {
        let colours: &[usize] = if self.coloured { &[4, 3] } else { &[0] };
        colours.iter().map(|c| self.width + c)
    }

    /// All of the file, word by word, each vertex having `width` of them.
    fn by_words(&self, mut words: Words, width: usize, rest: Rest) -> Result<Body> {
        let mut body = Body::default();
        // The counts are only believed word by word: nothing is set aside for them.
        for _ in 0..self.vertices {
            body.0.push(self.vertex(&mut words)?);
            for _ in self.coordinates()..width {
                let _: f64 = words.number("a colour, normal or texture")?;
            }
        }
        for _ in 0..self.faces {
            let corners = face(&mut words, body.0.len())?;
            if rest == Rest::ToLineEnd {
                words.rest = "".split_ascii_whitespace();
            }
            // Two corners or one draw a line or a point, which are no part of the surface.
            if corners.len() >= 3 {
                body.1.push(corners);
            }
        }
        match words.word() {
            None => Ok(body),
            Some((line, word)) => Err(line.error(format!(
                "`{}` stands behind the last face; correct the numbers of vertices and faces at the top",
                scan::clip(word)
            ))),
        }
    }

    /// One vertex or face a line, whatever else stands in it, and below them.
    fn by_lines(&self, words: &Words) -> Result<Body> {
        let mut body = Body::default();
        let mut lines = words.below.clone().map(|line| Words::of(words.path, line, words.job));
        for _ in 0..self.vertices {
            let mut line = lines.next().ok_or_else(|| words.ends())?;
            body.0.push(self.vertex(&mut line)?);
        }
        for _ in 0..self.faces {
            let mut line = lines.next().ok_or_else(|| words.ends())?;
            let corners = face(&mut line, body.0.len())?;
            if corners.len() >= 3 {
                body.1.push(corners);
            }
        }
        Ok(body)
    }

    fn coordinates(&self) -> usize {
        3 + usize::from(self.weighted)
    }

    fn vertex(&self, words: &mut Words) -> Result<DVec3> {
        let mut p = [0.0, 0.0, 0.0, 1.0];
        let names = ["a coordinate (x)", "a coordinate (y)", "a coordinate (z)", "a weight"];
        for (c, name) in p.iter_mut().zip(names).take(self.coordinates()) {
            *c = words.number(name)?;
        }
        let [x, y, z, weight] = p;
        let p = DVec3::new(x, y, z) / weight;
        if p.is_finite() {
            return Ok(p);
        }
        let line = words.line.ok_or_else(|| words.ends())?;
        Err(line.error("a coordinate is not finite"))
    }
}

/// The corners of a face over so many vertices.
fn face(words: &mut Words, count: usize) -> Result<Vec<u32>> {
    let corners: usize = words.number("the number of corners")?;
    let mut face = Vec::new();
    for _ in 0..corners {
        let v: usize = words.number("a vertex number")?;
        if v >= count {
            let message = format!("the face uses vertex {v}, but there are only {count}, from 0");
            return Err(words.line.map_or_else(|| words.ends(), |line| line.error(message)));
        }
        face.push(v as u32);
    }
    Ok(face)
}

/// The grid as OFF; the format has no place for members.
pub(super) fn encode(grid: &GridFile, job: &Job) -> Vec<u8> {
    let mut out = String::from("OFF\n");
    for line in grid.header() {
        let _ = writeln!(out, "# {line}");
    }
    let _ = writeln!(
        out,
        "{} {} {}",
        grid.schedule.nodes.xyz.len(),
        grid.schedule.panels.nodes.len(),
        grid.schedule.members.ends.len()
    );
    for DVec3 { x, y, z } in grid.schedule.nodes.xyz.iter().take_while(|_| !job.is_over(WRITING)) {
        let _ = writeln!(out, "{x} {y} {z}");
    }
    for [a, b, c] in grid.schedule.panels.nodes.iter().take_while(|_| !job.is_over(WRITING)) {
        let _ = writeln!(out, "3 {a} {b} {c}");
    }
    out.into_bytes()
}
