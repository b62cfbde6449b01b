//! Wavefront OBJ: `v` and `f` are read, members are written as `l`. Written by hand because the libraries
//! at hand tell no line numbers.

use super::grid_file::GridFile;
use super::mesh::soup::Soup;
use super::scan::{self, Line};
use super::{LengthUnit, file, text};
use crate::error::Result;
use crate::io::WRITING;
use crate::job::Job;
use crate::surface::Loss;
use crate::words;
use glam::DVec3;
use std::collections::HashSet;
use std::fmt::Write;
use std::path::Path;

/// Read the faces of all objects and groups together. Normals, textures and materials are passed over; lines that
/// are not edges of faces, points and curved elements are skipped with a note. A comment may state the unit.
///
/// # Errors
/// [`Error::Parse`](crate::Error::Parse) with the line.
pub(super) fn read(path: &Path, job: &Job) -> Result<Soup> {
    let bytes = file::read(path, job)?;
    let text = text::decode(&bytes);
    let joined = if text.contains('\\') { join_continued(&text) } else { text.into_owned() };
    let unit = joined
        .lines()
        .filter_map(|l| l.trim_start().strip_prefix('#'))
        .find_map(LengthUnit::stated);
    let mut soup = Soup { unit, first: 1, ..Soup::default() };
    let (mut curves, mut curved, mut lines, mut dots) = (0, 0, Vec::new(), Vec::new());
    // With the number of vertices above: those further down may be named as well.
    let mut drawn: Vec<(Line, usize)> = Vec::new();
    for line in scan::lines(path, &joined, job) {
        let mut words = line.text.split_ascii_whitespace();
        match words.next() {
            Some("v") => soup.points.push(line.point(&mut words)?),
            Some("f" | "fo" | "l" | "p") => drawn.push((line, soup.points.len())),
            Some("curv" | "curv2") => curves += 1,
            Some("surf") => curved += 1,
            _ => {}
        }
    }
    for (line, above) in drawn {
        let words = line.text.split_ascii_whitespace().skip(1);
        let corner = |word| scan::vertex(&line, word, [above, soup.points.len()]);
        let corners: Vec<u32> = words.map(corner).collect::<Result<_>>()?;
        if line.text.starts_with('l') {
            lines.push(corners);
        } else if line.text.starts_with('p') {
            dots.extend(corners);
        } else if corners.len() < 3 {
            return Err(line.error("a face needs three corners or more"));
        } else {
            soup.faces.push(corners);
        }
    }
    let stray = stray_lines(&soup.faces, &lines);
    let loose = loose_points(&soup.faces, dots);
    let lines = ["line that is not an edge of a face", "lines that are not edges of faces"];
    soup.note_count(stray, "skipped", lines);
    let points = ["point that is not a corner of a face", "points that are not corners of faces"];
    soup.note_count(loose, "skipped", points);
    soup.note_count(curves, "skipped", ["curve", "curves"]);
    if curved > 0 {
        soup.losses.push(Loss {
            what: words::counted(curved, "curved surface"),
            why: "only meshes are read from OBJ; export the surface as a mesh, or as STEP"
                .to_owned(),
            faces: curved,
            area: None,
            whole: true,
        });
    }
    Ok(soup)
}

/// How many of these polylines leave the edges of the faces: those are no members of a grid.
fn stray_lines(faces: &[Vec<u32>], lines: &[Vec<u32>]) -> usize {
    if lines.is_empty() {
        return 0;
    }
    let sorted = |a: u32, b: u32| (a.min(b), a.max(b));
    let around = |f: &Vec<u32>, k: usize| sorted(f[k], f[(k + 1) % f.len()]);
    let edges: HashSet<(u32, u32)> =
        faces.iter().flat_map(|f| (0..f.len()).map(move |k| around(f, k))).collect();
    let leaves = |l: &&Vec<u32>| l.windows(2).any(|w| !edges.contains(&sorted(w[0], w[1])));
    lines.iter().filter(leaves).count()
}

/// How many of these points are no corners of faces: those that mark nodes of a grid say nothing new.
fn loose_points(faces: &[Vec<u32>], mut dots: Vec<u32>) -> usize {
    if dots.is_empty() {
        return 0;
    }
    let corners: HashSet<u32> = faces.iter().flatten().copied().collect();
    dots.sort_unstable();
    dots.dedup();
    dots.iter().filter(|v| !corners.contains(v)).count()
}

/// Join lines that end in a backslash with the next, keeping the count of lines. A comment may end in a folder's name.
fn join_continued(text: &str) -> String {
    let mut joined = String::with_capacity(text.len());
    let mut owed = 0;
    for line in text.lines() {
        let comment = line.trim_start().starts_with('#');
        if let Some(start) = line.trim_end().strip_suffix('\\').filter(|_| !comment) {
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
pub(super) fn encode(grid: &GridFile, job: &Job) -> Vec<u8> {
    let mut out = String::new();
    for line in grid.header() {
        let _ = writeln!(out, "# {line}");
    }
    for DVec3 { x, y, z } in grid.schedule.nodes.xyz.iter().take_while(|_| !job.is_over(WRITING)) {
        let _ = writeln!(out, "v {x} {y} {z}");
    }
    out.push_str("g panels\n");
    for [a, b, c] in grid.schedule.panels.nodes.iter().take_while(|_| !job.is_over(WRITING)) {
        let _ = writeln!(out, "f {} {} {}", a + 1, b + 1, c + 1);
    }
    out.push_str("g members\n");
    for [a, b] in grid.schedule.members.ends.iter().take_while(|_| !job.is_over(WRITING)) {
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
