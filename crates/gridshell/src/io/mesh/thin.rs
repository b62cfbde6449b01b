//! Faces without width: their corners lie on a line, but for rounding. They have no area, and yet they would count as
//! parts of their own, or as a third face on an edge.
//!
//! ```text
//!   a ------ m ------ b          a ------ m ------ b
//!    \  (thin face)  /            \               /
//!     \_____________/      =>      \             /     the face below takes m into its edge ab,
//!      \           /                \           /      where another face uses m
//!            c                            c
//! ```

use super::work::Work;
use glam::DVec3;
use std::collections::HashMap;

/// A face is thin below this share of its length: a tenth of a millimetre in a hundred metres. Larger, faces that can
/// be seen go; smaller, slivers stay that no triangulation likes.
const THIN: f64 = 1e-6;
/// What is no thinner than this for its length is not dropped, however wide the tolerance: it is a small face.
const SMALL: f64 = 1e-3;

/// The faces that use an edge, by its ends.
type Edges = HashMap<(u32, u32), Vec<u32>>;

/// Drop the faces narrower than a small share of their length, or than `tolerance` metres where they are long, and have
/// their neighbours take in the corners that lay between.
pub(super) fn drop_thin(work: &mut Work, tolerance: f64) {
    let mut thin: Vec<bool> =
        work.faces.iter().map(|face| is_thin(&work.points, face, tolerance)).collect();
    if !thin.contains(&true) {
        return;
    }
    let mut edges = Edges::new();
    let mut faces_of = vec![0_u32; work.points.len()];
    for (face, f) in work.faces.iter().zip(0..) {
        enter(&mut edges, face, f);
        for &v in face {
            faces_of[v as usize] += 1;
        }
    }
    for f in 0..work.faces.len() {
        if !thin[f] {
            continue;
        }
        let face = std::mem::take(&mut work.faces[f]);
        leave(&mut edges, &face, f as u32);
        for &v in &face {
            faces_of[v as usize] -= 1;
        }
        let kept: Vec<u32> = face.iter().copied().filter(|&v| faces_of[v as usize] > 0).collect();
        for k in 0..face.len() {
            let (a, b) = (face[k], face[(k + 1) % face.len()]);
            let between = between(&work.points, [a, b], &kept);
            if between.is_empty() {
                continue;
            }
            for g in edges.get(&key(a, b)).cloned().unwrap_or_default() {
                let old = work.faces[g as usize].clone();
                let Some(new) = with_corners(&old, [a, b], &between) else { continue };
                leave(&mut edges, &old, g);
                enter(&mut edges, &new, g);
                for &v in &between {
                    faces_of[v as usize] += 1;
                }
                thin[g as usize] |= g as usize > f && is_thin(&work.points, &new, tolerance);
                work.faces[g as usize] = new;
            }
        }
        work.faces[f] = face;
    }
    work.drop_noted(
        &thin,
        [
            "face without width (its corners lie on a line)",
            "faces without width (their corners lie on a line)",
        ],
    );
}

/// Whether the corners lie on a line.
fn is_thin(points: &[DVec3], face: &[u32], tolerance: f64) -> bool {
    let at = |v: u32| points[v as usize];
    let farthest = |from: DVec3| {
        let by =
            |p: &DVec3, q: &DVec3| p.distance_squared(from).total_cmp(&q.distance_squared(from));
        face.iter().map(|&v| at(v)).max_by(by).unwrap_or(from)
    };
    let from = farthest(at(face[0]));
    let along = farthest(from) - from;
    let length = along.length();
    let width = (THIN * length).max(tolerance.min(SMALL * length)) * length;
    face.iter().all(|&v| (at(v) - from).cross(along).length() <= width)
}

fn key(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

fn sides(face: &[u32]) -> impl Iterator<Item = (u32, u32)> {
    (0..face.len()).map(|k| key(face[k], face[(k + 1) % face.len()]))
}

fn enter(edges: &mut Edges, face: &[u32], f: u32) {
    for side in sides(face) {
        edges.entry(side).or_default().push(f);
    }
}

fn leave(edges: &mut Edges, face: &[u32], f: u32) {
    for side in sides(face) {
        if let Some(uses) = edges.get_mut(&side) {
            uses.retain(|&g| g != f);
        }
    }
}

/// Those of the corners that lie between the ends of an edge, from its first to its second.
fn between(points: &[DVec3], ends: [u32; 2], corners: &[u32]) -> Vec<u32> {
    let [a, b] = ends.map(|v| points[v as usize]);
    let along = (b - a) / (b - a).length_squared();
    let mut found: Vec<(f64, u32)> = corners
        .iter()
        .filter(|v| !ends.contains(v))
        .map(|&v| ((points[v as usize] - a).dot(along), v))
        .filter(|(s, _)| (0.0..1.0).contains(s) && *s > 0.0)
        .collect();
    found.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
    found.into_iter().map(|(_, v)| v).collect()
}

/// The face with these corners in its edge; None where it has not the edge, or has one of them already.
fn with_corners(face: &[u32], [a, b]: [u32; 2], corners: &[u32]) -> Option<Vec<u32>> {
    if corners.iter().any(|v| face.contains(v)) {
        return None;
    }
    let n = face.len();
    let at = (0..n).find(|&k| key(face[k], face[(k + 1) % n]) == key(a, b))?;
    let mut new = face[..=at].to_vec();
    if face[at] == a {
        new.extend(corners);
    } else {
        new.extend(corners.iter().rev());
    }
    new.extend(&face[at + 1..]);
    Some(new)
}
