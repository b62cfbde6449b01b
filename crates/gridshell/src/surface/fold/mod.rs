//! Faces that fold, parted along their folds: a spline of degree 1, or one with a knot as often as its degree, may
//! turn sharply there. Parted, its creases, corners and carrier are those of several faces that meet.
//!
//! Each face's loops are brought to (u, v) (`ring`), cut along one fold after the other (`cut`), and what lies
//! between folds becomes a face on its own piece of the patch; the cuts are edges that two faces share, along the
//! exact line of constant u or v (`draft`). Faces next to it get the places where folds end as vertices. All of it
//! is done once, after reading and sewing, for every format alike.

mod cut;
mod draft;
mod lines;
mod ring;
#[cfg(test)]
mod tests;

use super::exact::nurbs::NurbsSurface;
use super::model::size;
use super::tessellate::trim::{Edges, Polyline, Tracer};
use super::tessellate::{edges, poles, seam};
use super::{Brep, Curve, PREPARING, Sampling, Shape};
use crate::error::Result;
use crate::job::Job;
use crate::words;
use cut::{Cell, Cutter};
use draft::Draft;
use glam::DVec3;
use lines::Lines;
use rayon::prelude::*;

/// Places nearer to a fold than this share of the model's size lie on it. Smaller, slivers would be left beside folds
/// that a file's rounding has moved; larger, what is there would be lost. As for sewing.
const SNAP: f64 = 2e-5;
/// Pieces of each edge when it is brought to (u, v), and how far they may bulge, over its length.
const PIECES: f64 = 24.0;
const BULGE: f64 = 1e-3;
/// How near the foot of a place on an edge must be, over [`BULGE`].
const FOUND: f64 = 1e-3;
/// Parts of one face at most; one with more stays whole.
const MOST_PARTS: usize = 50_000;

/// Part all faces that fold. A face that cannot be parted stays as it is, which is noted.
///
/// # Errors
/// [`Error::Stopped`](crate::Error::Stopped) where the job was stopped.
pub fn split_folds(brep: &mut Brep, job: &Job) -> Result<()> {
    let of_face = |i: usize| Some((i, Lines::of(&brep.faces[i].shape)?));
    let folded: Vec<(usize, Lines)> =
        (0..brep.faces.len()).into_par_iter().filter_map(of_face).collect();
    let snap = SNAP * size::of_brep(brep);
    if folded.is_empty() || !(snap.is_finite() && snap > 0.0) {
        return Ok(());
    }
    let mut parted = brep.clone();
    poles::part(&mut parted);
    let ready = bounded(&mut parted, &folded, job);
    let (points, polylines) = sampled(&parted, &folded);
    let curves: Vec<Curve> = parted.edges.iter().map(|e| e.curve.clone()).collect();
    let edges =
        Edges { curves: &curves, polylines: &polylines, points: &points, origin: brep.origin };
    let mut draft = Draft::new(&parted, snap);
    let (mut parts, mut whole) = (Vec::new(), Vec::new());
    for (i, lines) in &folded {
        job.check(PREPARING)?;
        let mark = draft.mark();
        let cells = ready.contains(i).then(|| part(&parted, *i, lines, &edges, &mut draft, job));
        match cells.flatten() {
            Some(cells) if cells.len() > 1 => {
                parts.push((*i, cells));
                continue;
            }
            Some(_) => {}
            None => whole.push(*i),
        }
        draft.back_to(&mark);
    }
    let left = left_whole(brep, &whole);
    if parts.is_empty() {
        brep.notes.extend(left);
        return Ok(());
    }
    let (before, after) = (parts.len(), parts.iter().map(|p| p.1.len()).sum::<usize>());
    let faces = draft.finish(&mut parted, parts);
    parted.faces.extend(faces);
    parted.notes.push(if before == 1 {
        format!("1 face that folds along lines inside it is taken as {after}, which meet in creases")
    } else {
        format!("{before} faces that fold along lines inside them are taken as {after}, which meet in creases")
    });
    parted.notes.extend(left);
    *brep = parted;
    Ok(())
}

/// A note on faces that could not be parted.
fn left_whole(brep: &Brep, faces: &[usize]) -> Option<String> {
    let &first = faces.first()?;
    let fold = words::one_or_more(faces.len(), ["face folds", "faces fold"]);
    Some(format!(
        "{fold} along lines that could not be split ({}{}): the creases there are not followed; split there in the program \
         that made the file",
        if faces.len() > 1 { "the first is " } else { "" },
        brep.faces[first].told(first)
    ))
}

/// The folded faces that have, or could be given, loops that close in (u, v).
fn bounded(brep: &mut Brep, folded: &[(usize, Lines)], job: &Job) -> Vec<usize> {
    let mut ready = Vec::new();
    for &(i, _) in folded {
        if !brep.faces[i].loops.is_empty() || seam::bound(brep, i).is_ok() {
            ready.push(i);
        }
    }
    let closed = |i: &usize| brep.faces[*i].shape.closed() != [false; 2];
    let round: Vec<usize> = ready.iter().copied().filter(closed).collect();
    if round.is_empty() {
        return ready;
    }
    let (points, polylines) = sampled(brep, folded);
    let curves: Vec<Curve> = brep.edges.iter().map(|e| e.curve.clone()).collect();
    let edges =
        Edges { curves: &curves, polylines: &polylines, points: &points, origin: brep.origin };
    for i in round {
        let before = brep.faces[i].clone();
        if seam::close(brep, i, &edges, &sampling_of(&before.shape), job).is_err() {
            brep.faces[i] = before;
            ready.retain(|&r| r != i);
        }
    }
    ready
}

/// The parts of face `i`; None where it cannot be parted.
fn part(
    brep: &Brep,
    i: usize,
    lines: &Lines,
    edges: &Edges,
    draft: &mut Draft,
    job: &Job,
) -> Option<Vec<Cell>> {
    let face = &brep.faces[i];
    let Shape::Nurbs(patch) = &face.shape else { return None };
    let mut sampling = sampling_of(&face.shape);
    // On its way over a fold a search for a foot may end in it: what is no nearer than this is looked for afresh.
    sampling.chord_error *= FOUND;
    let tracer = Tracer::new(&face.shape, edges, &sampling, job);
    let rings = ring::of_face(&tracer, face).ok()?;
    let snap = draft.snap;
    let mut cutter = Cutter { patch, shape: &face.shape, edges, draft };
    let (lo, hi) = ring::reach(&rings);
    let all = lines.within(&face.shape, lo, hi, snap);
    if all.iter().map(|l| l.len() + 1).product::<usize>() > MOST_PARTS {
        return None;
    }
    cutter.part(rings, &all, lines)
}

/// How finely the edges of a patch are looked at.
fn sampling_of(shape: &Shape) -> Sampling {
    let points: &[DVec3] = shape.spline().map_or(&[], |s: &NurbsSurface| &s.points);
    let lo = points.iter().fold(DVec3::MAX, |a, &b| a.min(b));
    let hi = points.iter().fold(DVec3::MIN, |a, &b| a.max(b));
    let size = lo.distance(hi).max(f64::MIN_POSITIVE);
    Sampling { max_edge: size / PIECES, chord_error: size * BULGE, corner_angle: 0.5 }
}

/// The edges of these faces as polylines; those of others by their ends alone.
fn sampled(brep: &Brep, folded: &[(usize, Lines)]) -> (Vec<DVec3>, Vec<Polyline>) {
    let mut used = vec![false; brep.edges.len()];
    for c in folded.iter().flat_map(|(i, _)| brep.faces[*i].loops.iter().flatten()) {
        used[c.edge as usize] = true;
    }
    let mut points = brep.vertices.clone();
    let mut polylines = Vec::with_capacity(brep.edges.len());
    for (e, used) in brep.edges.iter().zip(used) {
        let [a, b] = e.range;
        let looks = (0..=16).map(|k| e.curve.point(a + (b - a) * f64::from(k) / 16.0));
        let looks: Vec<DVec3> = if used { looks.collect() } else { Vec::new() };
        let length: f64 = looks.windows(2).map(|w| w[0].distance(w[1])).sum();
        let fine =
            Sampling { max_edge: length / PIECES, chord_error: length * BULGE, corner_angle: 0.5 };
        let t = (length > 0.0).then(|| edges::parameters(e, &fine)).flatten();
        let t = t.unwrap_or(vec![a, b]);
        let mut vertices = vec![e.ends[0]];
        for &t in &t[1..t.len() - 1] {
            vertices.push(points.len() as u32);
            points.push(e.curve.point(t));
        }
        vertices.push(e.ends[1]);
        polylines.push(Polyline { t, vertices });
    }
    (points, polylines)
}
