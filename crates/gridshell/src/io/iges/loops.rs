//! Loops of faces: curves strung together, with vertices where they meet, turned to run round their face.

use super::curves::Arc;
use super::{Fault, File};
use crate::surface::brep::{Brep, BrepEdge, Coedge};
use crate::surface::exact::project::Seeds;
use crate::surface::{Curve, Shape};
use glam::{DVec2, DVec3};

/// Curves of a loop that end further apart than this share of its size are joined by a straight line.
const GAP_SHARE: f64 = 1e-4;
/// Curves shorter than this share of their loop are places, as they are at poles.
const POINT_SHARE: f64 = 1e-9;
/// Looks along each curve where the way a loop runs is found out.
const LOOKS: usize = 24;

/// A curve of a loop.
pub(super) struct Side {
    pub curve: Curve,
    pub range: [f64; 2],
}

impl Side {
    /// A curve in space.
    pub fn of(arc: Arc) -> Side {
        Side { curve: Curve::Nurbs(arc.curve), range: arc.range }
    }

    fn at(&self, share: f64) -> DVec3 {
        self.curve.point(self.range[0] + (self.range[1] - self.range[0]) * share)
    }

    /// Points along it, from its start to its end.
    pub fn points(&self) -> impl Iterator<Item = DVec3> + '_ {
        (0..=LOOKS).map(|i| self.at(i as f64 / LOOKS as f64))
    }

    fn length(&self) -> f64 {
        let p: Vec<DVec3> = self.points().collect();
        p.windows(2).map(|w| w[0].distance(w[1])).sum()
    }
}

/// Add a loop of these curves, which follow each other, to `brep`.
pub(super) fn close(
    brep: &mut Brep,
    file: &File,
    place: &str,
    sides: Vec<Side>,
) -> Result<Vec<Coedge>, Fault> {
    let lengths: Vec<f64> = sides.iter().map(Side::length).collect();
    let whole: f64 = lengths.iter().sum();
    let mut sides: Vec<Side> = sides
        .into_iter()
        .zip(lengths)
        .filter(|(_, l)| *l > POINT_SHARE * whole)
        .map(|(s, _)| s)
        .collect();
    if !(whole > 0.0 && whole.is_finite()) || sides.is_empty() {
        return Err(Fault::new(place, "a boundary has no length"));
    }
    let mut k = 0;
    while k < sides.len() {
        let (end, start) = (sides[k].at(1.0), sides[(k + 1) % sides.len()].at(0.0));
        let gap = end.distance(start);
        if gap > GAP_SHARE * whole {
            file.note(format!(
                "{place}: a boundary was open by {gap:.2e} of the file's units, and was closed"
            ));
            let line = crate::surface::nurbs::NurbsCurve::line(end, start);
            sides.insert(k + 1, Side { curve: Curve::Nurbs(line), range: [0.0, 1.0] });
            k += 1;
        }
        k += 1;
    }
    let first = brep.vertices.len() as u32;
    let count = sides.len() as u32;
    let mut coedges = Vec::with_capacity(sides.len());
    for (k, side) in sides.into_iter().enumerate() {
        let k = k as u32;
        brep.vertices.push(side.at(0.0));
        let ends = [first + k, first + (k + 1) % count];
        brep.edges.push(BrepEdge { curve: side.curve, range: side.range, ends });
        coedges.push(Coedge { edge: brep.edges.len() as u32 - 1, reversed: false });
    }
    Ok(coedges)
}

/// Run the other way.
pub(super) fn flip(coedges: &mut [Coedge]) {
    coedges.reverse();
    for c in coedges {
        c.reversed = !c.reversed;
    }
}

/// The area in (u, v) that a loop runs round, positive counter-clockwise; None where it runs round a closed surface.
pub(super) fn area(brep: &Brep, shape: &Shape, seeds: &Seeds, coedges: &[Coedge]) -> Option<f64> {
    let mut path: Vec<DVec2> = Vec::new();
    for c in coedges {
        let edge = &brep.edges[c.edge as usize];
        for i in 0..LOOKS {
            let share = (i as f64 + 0.5) / LOOKS as f64;
            let share = if c.reversed { 1.0 - share } else { share };
            let p = edge.curve.point(edge.range[0] + (edge.range[1] - edge.range[0]) * share);
            let (found, _) = seeds.project(shape, p);
            let period = shape.period();
            let mut uv = found;
            if let Some(last) = path.last() {
                for k in (0..2).filter(|&k| period[k] > 0.0) {
                    uv[k] += ((last[k] - uv[k]) / period[k]).round() * period[k];
                }
            }
            path.push(uv);
        }
    }
    let (first, last) = (*path.first()?, *path.last()?);
    let period = shape.period();
    let wound = (0..2).any(|k| period[k] > 0.0 && (last[k] - first[k]).abs() > 0.5 * period[k]);
    let n = path.len();
    let twice: f64 = (0..n).map(|i| (path[i] - first).perp_dot(path[(i + 1) % n] - first)).sum();
    (!wound).then_some(0.5 * twice)
}
