//! Wavefront OBJ: `v` and `f` are read, members are written as `l`. Written by hand because the libraries
//! at hand tell no line numbers.

use super::grid_file::GridFile;
use super::scan;
use super::{file, weld};
use crate::error::Result;
use crate::surface::PolygonMesh;
use glam::DVec3;
use std::fmt::Write;
use std::path::Path;

/// Read the faces of all objects and groups together. Lines, points, normals, textures and materials are
/// passed over; curved elements are skipped with a note.
///
/// # Errors
/// [`Error::Parse`](crate::Error::Parse) with the line; what [`weld`](super::weld) finds.
pub(super) fn read(path: &Path) -> Result<PolygonMesh> {
    let bytes = file::read(path)?;
    // Names and comments may be in any encoding; numbers are ASCII.
    let text = String::from_utf8_lossy(&bytes);
    let joined = if text.contains('\\') { join_continued(&text) } else { text.into_owned() };
    let mut mesh = PolygonMesh { name: file::stem(path), ..PolygonMesh::default() };
    let mut curved = 0_usize;
    for line in scan::lines(path, &joined) {
        let mut words = line.text.split_ascii_whitespace();
        match words.next() {
            Some("v") => mesh.points.push(line.point(&mut words)?),
            Some("f") => {
                let face: Result<Vec<u32>> =
                    words.map(|word| scan::vertex(&line, word, mesh.points.len())).collect();
                let face = face?;
                if face.len() < 3 {
                    return Err(line.error("a face needs three corners or more"));
                }
                mesh.faces.push(face);
            }
            Some("curv" | "curv2" | "surf") => curved += 1,
            _ => {}
        }
    }
    if curved > 0 {
        mesh.notes.push(format!("skipped {curved} curved elements: only faces are read from OBJ"));
    }
    weld::weld(path, mesh)
}

/// Join lines that end in a backslash with the next, keeping the count of lines.
fn join_continued(text: &str) -> String {
    let mut joined = String::with_capacity(text.len());
    let mut owed = 0;
    for line in text.lines() {
        if let Some(start) = line.strip_suffix('\\') {
            joined.push_str(start);
            joined.push(' ');
            owed += 1;
            continue;
        }
        joined.push_str(line);
        joined.extend(std::iter::repeat_n('\n', owed + 1));
        owed = 0;
    }
    joined
}

/// The grid as OBJ: nodes, panels, then members as lines, and as points the irregular nodes and the supports.
pub(super) fn encode(grid: &GridFile) -> Vec<u8> {
    let mut out = String::new();
    for line in grid.header() {
        let _ = writeln!(out, "# {line}");
    }
    for DVec3 { x, y, z } in &grid.schedule.nodes.xyz {
        let _ = writeln!(out, "v {x} {y} {z}");
    }
    out.push_str("g panels\n");
    for [a, b, c] in &grid.schedule.panels.nodes {
        let _ = writeln!(out, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    out.push_str("g members\n");
    for [a, b] in &grid.schedule.members.ends {
        let _ = writeln!(out, "l {} {}", a + 1, b + 1);
    }
    let nodes = &grid.schedule.nodes;
    let irregular = (0..nodes.xyz.len()).filter(|&v| nodes.is_irregular(v)).map(|v| v as u32);
    points(&mut out, "irregular", irregular);
    points(&mut out, "supports", grid.document.supports.iter().copied());
    out.into_bytes()
}

/// A group of point elements, where there are any.
fn points(out: &mut String, group: &str, nodes: impl Iterator<Item = u32>) {
    let mut nodes = nodes.peekable();
    if nodes.peek().is_none() {
        return;
    }
    let _ = writeln!(out, "g {group}");
    for v in nodes {
        let _ = writeln!(out, "p {}", v + 1);
    }
}
