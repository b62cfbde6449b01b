//! Object File Format: `OFF`, three counts, vertices, faces. Colours and normals are passed over.

use super::grid_file::GridFile;
use super::scan::{self, Line};
use super::soup::Soup;
use super::{LengthUnit, file, text};
use crate::error::Result;
use crate::job::Job;
use glam::DVec3;
use std::fmt::Write;
use std::path::Path;

/// Read an ASCII OFF file, with or without colours (COFF), normals (NOFF) or texture (STOFF).
///
/// # Errors
/// [`Error::Parse`](crate::Error::Parse) with the line.
pub(super) fn read(path: &Path, job: &Job) -> Result<Soup> {
    let bytes = file::read(path, job)?;
    let text = text::decode(&bytes);
    let mut lines = scan::lines(path, &text, job);
    let ends = || {
        scan::error(path, "end of file", "the file ends before all vertices and faces are given")
    };
    let [vertices, faces] = counts(&mut lines)?.ok_or_else(ends)?;
    let comments = text.lines().filter_map(|line| line.split_once('#'));
    let unit = comments.map(|(_, comment)| comment).find_map(LengthUnit::stated);
    let mut soup = Soup { unit, ..Soup::default() };
    // The counts are only believed line by line: nothing is set aside for them.
    for _ in 0..vertices {
        let line = lines.next().ok_or_else(ends)?;
        soup.points.push(line.point(&mut line.text.split_ascii_whitespace())?);
    }
    for _ in 0..faces {
        let line = lines.next().ok_or_else(ends)?;
        let corners = face(&line, soup.points.len())?;
        // Two corners or one draw a line or a point, which are no part of the surface.
        if corners.len() >= 3 {
            soup.faces.push(corners);
        }
    }
    Ok(soup)
}

/// Numbers of vertices and faces, behind the keyword in the first line or in a line of their own.
fn counts<'a>(lines: &mut impl Iterator<Item = Line<'a>>) -> Result<Option<[u64; 2]>> {
    let Some(mut line) = lines.next() else { return Ok(None) };
    let mut words = line.text.split_ascii_whitespace().peekable();
    if let Some(keyword) = words.next_if(|w| w.to_ascii_uppercase().ends_with("OFF")) {
        if keyword.contains(['4', 'n']) {
            return Err(line.error(format!("`{keyword}`: only three dimensions can be read")));
        }
        if words.peek() == Some(&"BINARY") {
            return Err(line.error("binary OFF cannot be read; save the file as text"));
        }
        if words.peek().is_none() {
            let Some(next) = lines.next() else { return Ok(None) };
            line = next;
            words = line.text.split_ascii_whitespace().peekable();
        }
    }
    let vertices = line.number(words.next(), "the number of vertices")?;
    let faces = line.number(words.next(), "the number of faces")?;
    Ok(Some([vertices, faces]))
}

fn face(line: &Line, count: usize) -> Result<Vec<u32>> {
    let mut words = line.text.split_ascii_whitespace();
    let corners: usize = line.number(words.next(), "the number of corners")?;
    let mut face = Vec::new();
    for _ in 0..corners {
        let v: usize = line.number(words.next(), "a vertex number")?;
        if v >= count {
            return Err(
                line.error(format!("the face uses vertex {v}, but there are only {count}, from 0"))
            );
        }
        face.push(v as u32);
    }
    Ok(face)
}

/// The grid as OFF; the format has no place for members.
pub(super) fn encode(grid: &GridFile) -> Vec<u8> {
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
    for DVec3 { x, y, z } in &grid.schedule.nodes.xyz {
        let _ = writeln!(out, "{x} {y} {z}");
    }
    for [a, b, c] in &grid.schedule.panels.nodes {
        let _ = writeln!(out, "3 {a} {b} {c}");
    }
    out.into_bytes()
}
