//! Naked edges: those that a single loop uses, sampled and sorted into a tree.

use super::PHASE;
use crate::job::Job;
use crate::surface::brep::BrepEdge;
use crate::surface::{Brep, Curve};
use glam::DVec3;
use rstar::{AABB, RTree, RTreeObject};

/// Samples of an edge.
const SAMPLES: [usize; 2] = [16, 256];
/// Samples in each span of a curve.
const EACH: usize = 4;
/// The curve strays from its chords by so many times what is seen at their middles, at most.
const SAG: f64 = 1.5;

/// The use of an edge: by which face, in which loop, and where in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Use {
    pub face: u32,
    pub boundary: u32,
    pub place: u32,
}

/// One naked edge.
pub(super) struct Line {
    /// Index of the edge.
    pub edge: u32,
    pub used: Use,
    /// Curve parameters, ascending.
    pub t: Vec<f64>,
    pub points: Vec<DVec3>,
}

/// A stretch of a naked edge between two samples, with a box that holds it.
struct Stretch {
    line: u32,
    k: u32,
    bounds: AABB<[f64; 3]>,
}

/// All naked edges.
pub(super) struct Naked {
    pub lines: Vec<Line>,
    tree: RTree<Stretch>,
}

/// The place on a naked edge nearest to a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Foot {
    /// Index into [`Naked::lines`].
    pub line: u32,
    pub t: f64,
    pub xyz: DVec3,
    pub distance: f64,
}

impl Naked {
    /// The naked edges of `brep`.
    pub fn new(brep: &Brep, job: &Job) -> Naked {
        let mut lines = Vec::new();
        for (edge, used) in single_uses(brep) {
            if job.is_over(PHASE) {
                break;
            }
            let e = &brep.edges[edge as usize];
            let t = samples(e);
            let points: Vec<DVec3> = t.iter().map(|&t| e.curve.point(t)).collect();
            if points.iter().all(|p| p.is_finite()) {
                lines.push(Line { edge, used, t, points });
            }
        }
        let mut stretches = Vec::new();
        for (l, line) in lines.iter().enumerate() {
            let curve = &brep.edges[line.edge as usize].curve;
            for k in 0..line.t.len() - 1 {
                let (a, b) = (line.points[k], line.points[k + 1]);
                let middle = curve.point(0.5 * (line.t[k] + line.t[k + 1]));
                let sag = SAG * middle.distance(0.5 * (a + b));
                let bounds = AABB::from_corners(
                    (a.min(b).min(middle) - sag).to_array(),
                    (a.max(b).max(middle) + sag).to_array(),
                );
                stretches.push(Stretch { line: l as u32, k: k as u32, bounds });
            }
        }
        Naked { lines, tree: RTree::bulk_load(stretches) }
    }

    /// The nearest places on all naked edges within `reach` of `p`, one for each edge, by edge.
    pub fn feet(&self, brep: &Brep, p: DVec3, reach: f64) -> Vec<Foot> {
        let around = AABB::from_corners((p - reach).to_array(), (p + reach).to_array());
        let mut near: Vec<(u32, u32)> =
            self.tree.locate_in_envelope_intersecting(around).map(|s| (s.line, s.k)).collect();
        near.sort_unstable();
        let mut feet: Vec<Foot> = Vec::new();
        for (l, k) in near {
            let line = &self.lines[l as usize];
            let edge = &brep.edges[line.edge as usize];
            let [a, b] = [line.t[k as usize], line.t[k as usize + 1]];
            let (t, xyz) = edge.curve.project(0.5 * (a + b), [a, b], p);
            let foot = Foot { line: l, t, xyz, distance: xyz.distance(p) };
            if foot.distance > reach {
                continue;
            }
            match feet.last_mut() {
                Some(last) if last.line == l => {
                    if foot.distance < last.distance {
                        *last = foot;
                    }
                }
                _ => feet.push(foot),
            }
        }
        feet
    }
}

impl RTreeObject for Stretch {
    type Envelope = AABB<[f64; 3]>;

    fn envelope(&self) -> Self::Envelope {
        self.bounds
    }
}

/// Edges with exactly one use, ascending.
fn single_uses(brep: &Brep) -> Vec<(u32, Use)> {
    let mut uses: Vec<(u32, Use)> = Vec::new();
    for (f, face) in brep.faces.iter().enumerate() {
        for (l, coedges) in face.loops.iter().enumerate() {
            for (place, c) in coedges.iter().enumerate() {
                let used = Use { face: f as u32, boundary: l as u32, place: place as u32 };
                uses.push((c.edge, used));
            }
        }
    }
    uses.sort_by_key(|u| u.0);
    let known = |u: &&[(u32, Use)]| u.len() == 1 && (u[0].0 as usize) < brep.edges.len();
    uses.chunk_by(|a, b| a.0 == b.0).filter(known).map(|u| u[0]).collect()
}

/// Parameters along an edge, close enough together that each stretch bends one way.
fn samples(edge: &BrepEdge) -> Vec<f64> {
    let spans = match &edge.curve {
        Curve::Nurbs(c) => c.points.len() - c.degree,
        Curve::OnShape(shape, _) | Curve::UvLine { shape, .. } | Curve::Guide { shape, .. } => {
            (shape.lattice(0).len() + shape.lattice(1).len()) / EACH
        }
    };
    let count = (EACH * spans).clamp(SAMPLES[0], SAMPLES[1]);
    let [a, b] = edge.range;
    (0..=count)
        .map(|i| if i == count { b } else { a + (b - a) * i as f64 / count as f64 })
        .collect()
}
