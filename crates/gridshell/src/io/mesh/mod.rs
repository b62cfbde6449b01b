//! The door every mesh comes through: from a soup of faces to an oriented manifold in metres.
//!
//! In turn: check the coordinates, merge vertices at the same place, leave out small pieces far away, drop
//! degenerate, repeated and thin faces, join T-junctions, cut off slivers on edges with more than two faces and refuse
//! the others, turn neighbours to agree, choose the outside, part pieces that touch in one vertex, and drop unused
//! vertices. What was done is told in the notes.

mod far;
mod fins;
mod merge;
pub(super) mod soup;
mod spike;
mod stitch;
mod thin;
mod turn;
pub(super) mod work;

use super::{Opening, READING, file};
use crate::error::{Error, Result};
use crate::job::Job;
use crate::surface::{PolygonMesh, Source, polygon::triangulate};
use soup::Soup;
use std::collections::HashSet;
use std::path::Path;
use work::{Work, bounds, neighbors};

/// A surface has more area than this share of its length squared.
const NO_AREA: f64 = 1e-9;
/// Faces with more corners are told where nearly all others have up to four: they often stand for openings.
const MANY_SIDES: usize = 8;
/// A face that is cut open to a hole in it has this many corners or more: two triangles and the cut.
const LEAST_SLIT: usize = 6;
/// The soup as a manifold, its faces oriented alike. What the `opening` says of unit and tolerance goes
/// before what the file does.
///
/// # Errors
/// [`Error::Surface`] where there is no face, a coordinate out of bounds, an edge of more than two faces, or the
/// surface has one side only.
pub(super) fn weld(path: &Path, soup: Soup, opening: &Opening, job: &Job) -> Result<PolygonMesh> {
    let digits = soup.digits;
    if soup.faces.is_empty() {
        return Err(Error::Surface(no_faces(path, soup.points.len())));
    }
    let mut work = Work::new(path, soup, opening.unit)?;
    job.check(READING)?;
    merge::identical(&mut work);
    far::drop_far(&mut work);
    let tolerance = merge::tolerance(&work, digits, opening.sew)?;
    job.check(READING)?;
    merge::close(&mut work, tolerance);
    job.check(READING)?;
    let merged = work.merged;
    work.note_count(merged, "merged", ["duplicate vertex", "duplicate vertices"]);
    drop_degenerate(&mut work);
    if work.faces.is_empty() {
        return Err(Error::Surface(no_faces(path, work.points.len())));
    }
    check_area(path, &work)?;
    spike::check(&work)?;
    job.check(READING)?;
    let count = work.faces.len();
    thin::drop_thin(&mut work, tolerance);
    if work.faces.is_empty() {
        return Err(no_area(path, count));
    }
    stitch::stitch(&mut work, tolerance);
    job.check(READING)?;
    fins::cut(path, &mut work)?;
    let neighbors = neighbors(&work.faces);
    job.check(READING)?;
    turn::alike(path, &mut work, &neighbors)?;
    job.check(READING)?;
    part_at_vertices(&mut work);
    drop_unused(&mut work);
    note_many_sided(&mut work);
    let Work { points, faces, notes, losses, .. } = work;
    Ok(PolygonMesh {
        name: file::stem(path),
        points,
        faces,
        notes,
        source: Source { losses, ..Source::default() },
        ..PolygonMesh::default()
    })
}

fn no_faces(path: &Path, points: usize) -> String {
    let path = path.display();
    if points == 0 {
        return format!("{path}: the file holds no faces: it is empty, or not of this format");
    }
    format!("{path}: the file holds no faces, only {points} vertices; export the surface as a mesh")
}

/// Refuse faces that all together have no area to speak of.
fn check_area(path: &Path, work: &Work) -> Result<()> {
    let area: f64 = work.faces.iter().map(|face| work.area(face)).sum();
    let corners = work.faces.iter().flatten().map(|&v| work.points[v as usize]);
    let (low, high) = bounds(corners);
    if area > NO_AREA * (high - low).length_squared() {
        return Ok(());
    }
    Err(no_area(path, work.faces.len()))
}

fn no_area(path: &Path, count: usize) -> Error {
    let path = path.display();
    Error::Surface(format!("{path}: the {count} faces have no area: they lie on a line"))
}

/// Drop corners that repeat the one before, faces with fewer than three corners or a corner twice, and
/// faces over the same corners as an earlier one. Faces that are cut open to a hole in them, and so visit corners
/// twice, are split into triangles first.
fn drop_degenerate(work: &mut Work) {
    let mut split = Vec::new();
    for (f, face) in work.faces.iter_mut().enumerate() {
        face.dedup();
        while face.len() > 1 && face.first() == face.last() {
            face.pop();
        }
        if face.len() >= LEAST_SLIT && repeats(face) {
            let mut triangles = Vec::new();
            triangulate::split(&work.points, face, &mut triangles);
            triangles.retain(|t| !repeats(t));
            split.extend(triangles.into_iter().map(|t| (t.to_vec(), work.origin[f])));
            face.clear();
        }
    }
    let slit = work.faces.iter().filter(|f| f.is_empty() && !split.is_empty()).count();
    if !split.is_empty() {
        let gone: Vec<bool> = work.faces.iter().map(Vec::is_empty).collect();
        work.drop_faces(&gone);
        for (face, origin) in split {
            work.faces.push(face);
            work.origin.push(origin);
        }
        work.note_count(
            slit,
            "split",
            ["face that visits a corner twice", "faces that visit a corner twice"],
        );
    }
    let gone: Vec<bool> = work.faces.iter().map(|f| f.len() < 3 || repeats(f)).collect();
    work.drop_noted(&gone, ["degenerate face", "degenerate faces"]);
    let mut seen: HashSet<Vec<u32>> = HashSet::with_capacity(work.faces.len());
    let gone: Vec<bool> = (work.faces.iter())
        .map(|face| {
            let mut sorted = face.clone();
            sorted.sort_unstable();
            !seen.insert(sorted)
        })
        .collect();
    drop(seen);
    work.drop_noted(&gone, ["repeated face", "repeated faces"]);
}

/// Whether a corner comes twice.
fn repeats(face: &[u32]) -> bool {
    let mut sorted = face.to_vec();
    sorted.sort_unstable();
    sorted.windows(2).any(|w| w[0] == w[1])
}

/// Tell the faces with very many corners where they are few: in form diagrams they stand for openings.
fn note_many_sided(work: &mut Work) {
    let many: Vec<u32> = (work.faces.iter().zip(0..))
        .filter(|(face, _)| face.len() > MANY_SIDES)
        .map(|(_, f)| f)
        .collect();
    if many.is_empty() || many.len() * 10 > work.faces.len() {
        return;
    }
    let numbers: Vec<String> = many.iter().take(5).map(|&f| work.number(f)).collect();
    let dots = if many.len() > 5 { ", ..." } else { "" };
    work.notes.push(format!(
        "{} faces have more than {MANY_SIDES} corners ({}{dots}): if they stand for openings, delete them",
        many.len(),
        numbers.join(", ")
    ));
}

/// Give each fan of faces round a vertex its own vertex, so that no two touch in a vertex alone.
fn part_at_vertices(work: &mut Work) {
    // The steps round each vertex: in this face, from this next corner to that previous one.
    let mut steps: Vec<Vec<(u32, u32, u32)>> = vec![Vec::new(); work.points.len()];
    for (f, face) in work.faces.iter().enumerate() {
        let n = face.len();
        for k in 0..n {
            steps[face[k] as usize].push((f as u32, face[(k + 1) % n], face[(k + n - 1) % n]));
        }
    }
    let mut parted = 0;
    for (v, steps) in steps.into_iter().enumerate() {
        for fan in fans(&steps).into_iter().skip(1) {
            let twin = work.points.len() as u32;
            work.points.push(work.points[v]);
            for f in fan {
                for c in work.faces[f as usize].iter_mut().filter(|c| **c == v as u32) {
                    *c = twin;
                }
            }
            parted += 1;
        }
    }
    work.note_count(
        parted,
        "split",
        [
            "vertex at which the surface touched itself",
            "vertices at which the surface touched itself",
        ],
    );
}

/// The faces round a vertex in fans whose faces share edges: the next corner of one is the previous of another.
fn fans(steps: &[(u32, u32, u32)]) -> Vec<Vec<u32>> {
    let mut by_next: Vec<(u32, usize)> = steps.iter().enumerate().map(|(i, s)| (s.1, i)).collect();
    let mut by_previous: Vec<(u32, usize)> =
        steps.iter().enumerate().map(|(i, s)| (s.2, i)).collect();
    by_next.sort_unstable();
    by_previous.sort_unstable();
    let at = |list: &[(u32, usize)], v: u32| -> Vec<usize> {
        let from = list.partition_point(|e| e.0 < v);
        list[from..].iter().take_while(|e| e.0 == v).map(|e| e.1).collect()
    };
    let mut seen = vec![false; steps.len()];
    let mut fans = Vec::new();
    for first in 0..steps.len() {
        if seen[first] {
            continue;
        }
        seen[first] = true;
        let mut fan = Vec::new();
        let mut open = vec![first];
        while let Some(i) = open.pop() {
            fan.push(steps[i].0);
            for j in at(&by_next, steps[i].2).into_iter().chain(at(&by_previous, steps[i].1)) {
                if !seen[j] {
                    seen[j] = true;
                    open.push(j);
                }
            }
        }
        fans.push(fan);
    }
    fans
}

/// Keep the vertices that faces use, in their order.
fn drop_unused(work: &mut Work) {
    let used = work.used();
    let mut new = vec![0; work.points.len()];
    let mut kept = Vec::new();
    for v in (0..work.points.len()).filter(|&v| used[v]) {
        new[v] = kept.len() as u32;
        kept.push(work.points[v]);
    }
    work.points = kept;
    for v in work.faces.iter_mut().flatten() {
        *v = new[*v as usize];
    }
}
