//! Naked edges cut into pieces where ends of others lie on them, as they do at T-junctions.

use super::PHASE;
use super::naked::{Naked, Use};
use crate::job::Job;
use crate::surface::Brep;
use glam::DVec3;
use rstar::RTree;
use rstar::primitives::GeomWithData;

/// Vertices in one cell of this share of the tolerance are one heap.
const HEAP: f64 = 0.125;

/// A naked edge between two places where others end.
pub(super) struct Piece {
    /// Index of the edge.
    pub edge: u32,
    pub used: Use,
    /// Curve parameters of its ends.
    pub range: [f64; 2],
    /// Its ends: vertices of the model, and from there on up one number for each place where an edge is split.
    pub nodes: [u32; 2],
    /// The clusters its ends belong to.
    pub clusters: [u32; 2],
    /// Parameters and places along it, its ends included.
    pub t: Vec<f64>,
    pub points: Vec<DVec3>,
}

/// All pieces, edge by edge and along each edge.
pub(super) struct Pieces {
    pub all: Vec<Piece>,
    /// Where edges are split: the places of the nodes beyond the vertices.
    pub splits: Vec<DVec3>,
}

/// Sets that grow together.
pub(super) struct Union(Vec<u32>);

impl Union {
    pub fn new(count: usize) -> Union {
        Union((0..count as u32).collect())
    }

    /// The least member of the set of `i`.
    pub fn find(&mut self, mut i: u32) -> u32 {
        while self.0[i as usize] != i {
            let up = self.0[self.0[i as usize] as usize];
            self.0[i as usize] = up;
            i = up;
        }
        i
    }

    pub fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

/// Cut the naked edges.
pub(super) fn pieces(brep: &Brep, naked: &Naked, tolerance: f64, job: &Job) -> Pieces {
    let ends = naked.lines.iter().flat_map(|l| brep.edges[l.edge as usize].ends).collect();
    let (vertices, mut clusters) = clusters(brep, ends, tolerance);
    // Places where each edge is split, and a vertex that lies there.
    let mut cuts: Vec<Vec<(f64, DVec3, u32)>> = vec![Vec::new(); naked.lines.len()];
    for &v in &vertices {
        if job.is_over(PHASE) {
            break;
        }
        let p = brep.vertices[v as usize];
        for foot in naked.feet(brep, p, tolerance) {
            let edge = &brep.edges[naked.lines[foot.line as usize].edge as usize];
            let own = edge.ends.iter().any(|&w| clusters.find(w) == clusters.find(v));
            if own {
                continue;
            }
            let near = [0, 1].into_iter().find(|&i| {
                let end = brep.vertices[edge.ends[i] as usize];
                let at = edge.curve.point(edge.range[i]);
                foot.xyz.distance(end).min(foot.xyz.distance(at)) <= tolerance
            });
            match near {
                Some(i) => clusters.join(v, edge.ends[i]),
                None => cuts[foot.line as usize].push((foot.t, foot.xyz, v)),
            }
        }
    }
    let mut pieces = Pieces { all: Vec::new(), splits: Vec::new() };
    for (line, mut cuts) in naked.lines.iter().zip(cuts) {
        cuts.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
        cuts.dedup_by(|next, kept| {
            let same = next.1.distance(kept.1) <= tolerance;
            if same {
                clusters.join(next.2, kept.2);
            }
            same
        });
        let edge = &brep.edges[line.edge as usize];
        let mut start = (edge.range[0], edge.ends[0], edge.ends[0]);
        let count = cuts.len();
        for i in 0..=count {
            let end = if i < count {
                pieces.splits.push(cuts[i].1);
                let node = (brep.vertices.len() + pieces.splits.len() - 1) as u32;
                (cuts[i].0, node, cuts[i].2)
            } else {
                (edge.range[1], edge.ends[1], edge.ends[1])
            };
            let range = [start.0, end.0];
            let mut t = vec![range[0]];
            t.extend(line.t.iter().copied().filter(|&t| t > range[0] && t < range[1]));
            t.push(range[1]);
            let points = t.iter().map(|&t| edge.curve.point(t)).collect();
            pieces.all.push(Piece {
                edge: line.edge,
                used: line.used,
                range,
                nodes: [start.1, end.1],
                clusters: [start.2, end.2],
                t,
                points,
            });
            start = end;
        }
    }
    for piece in &mut pieces.all {
        piece.clusters = piece.clusters.map(|v| clusters.find(v));
    }
    pieces
}

/// Vertices that lie together, and one of each heap of them: copies of a part may lie on each other in thousands.
fn clusters(brep: &Brep, ends: Vec<u32>, tolerance: f64) -> (Vec<u32>, Union) {
    let cell = |v: u32| {
        (brep.vertices[v as usize] / (HEAP * tolerance)).floor().to_array().map(|x| x as i64)
    };
    let mut heaps: Vec<([i64; 3], u32)> = ends.into_iter().map(|v| (cell(v), v)).collect();
    heaps.sort_unstable();
    heaps.dedup();
    let mut union = Union::new(brep.vertices.len());
    let mut vertices = Vec::new();
    for heap in heaps.chunk_by(|a, b| a.0 == b.0) {
        vertices.push(heap[0].1);
        for (_, v) in &heap[1..] {
            union.join(heap[0].1, *v);
        }
    }
    vertices.sort_unstable();
    let place = |v: u32| GeomWithData::new(brep.vertices[v as usize].to_array(), v);
    let tree = RTree::bulk_load(vertices.iter().map(|&v| place(v)).collect());
    for &v in &vertices {
        let at = brep.vertices[v as usize].to_array();
        for other in tree.locate_within_distance(at, tolerance * tolerance) {
            union.join(v, other.data);
        }
    }
    (vertices, union)
}

impl Piece {
    /// Its length, roughly, in metres.
    pub fn length(&self) -> f64 {
        self.points.windows(2).map(|w| w[0].distance(w[1])).sum()
    }
}
