//! Edges parted and added while faces are cut, and the model rebuilt with them.

use super::cut::Cell;
use super::ring::Piece;
use crate::surface::brep::{BrepEdge, BrepFace, Coedge};
use crate::surface::{Brep, Curve};
use glam::DVec3;

/// Edges and vertices, old and new, and where edges are parted.
pub(super) struct Draft {
    pub snap: f64,
    pub edges: Vec<BrepEdge>,
    pub vertices: Vec<DVec3>,
    /// For each edge the parameters where it is parted, and the vertices there.
    splits: Vec<Vec<(f64, u32)>>,
    /// Edges in the order in which they were parted.
    parted: Vec<u32>,
}

/// A state to go back to.
pub(super) struct Mark {
    edges: usize,
    vertices: usize,
    parted: usize,
}

impl Draft {
    pub fn new(brep: &Brep, snap: f64) -> Draft {
        Draft {
            snap,
            edges: brep.edges.clone(),
            vertices: brep.vertices.clone(),
            splits: vec![Vec::new(); brep.edges.len()],
            parted: Vec::new(),
        }
    }

    pub fn mark(&self) -> Mark {
        Mark { edges: self.edges.len(), vertices: self.vertices.len(), parted: self.parted.len() }
    }

    pub fn back_to(&mut self, mark: &Mark) {
        for edge in self.parted.drain(mark.parted..).rev() {
            self.splits[edge as usize].pop();
        }
        self.edges.truncate(mark.edges);
        self.splits.truncate(mark.edges);
        self.vertices.truncate(mark.vertices);
    }

    /// Part an edge at `t`, or where it is parted already no farther off than what counts as one place. The
    /// parameter and the vertex.
    pub fn split(&mut self, edge: u32, t: f64) -> (f64, u32) {
        let at = self.edges[edge as usize].curve.point(t);
        let splits = &mut self.splits[edge as usize];
        let same = |s: &&(f64, u32)| self.vertices[s.1 as usize].distance(at) <= self.snap;
        let near = splits.iter().filter(same);
        if let Some(&known) = near.min_by(|a, b| (a.0 - t).abs().total_cmp(&(b.0 - t).abs())) {
            return known;
        }
        self.vertices.push(at);
        let vertex = self.vertices.len() as u32 - 1;
        splits.push((t, vertex));
        self.parted.push(edge);
        (t, vertex)
    }

    /// A new edge.
    pub fn add(&mut self, edge: BrepEdge) -> u32 {
        self.edges.push(edge);
        self.splits.push(Vec::new());
        self.edges.len() as u32 - 1
    }

    /// Put the edges and vertices into `brep`, part those of all its loops, put the first part of each face in its
    /// place; the other parts.
    pub fn finish(mut self, brep: &mut Brep, parts: Vec<(usize, Vec<Cell>)>) -> Vec<BrepFace> {
        let mut pieces: Vec<Vec<(f64, u32)>> = Vec::with_capacity(self.edges.len());
        for edge in 0..self.edges.len() {
            let mut splits = std::mem::take(&mut self.splits[edge]);
            splits.sort_by(|a, b| a.0.total_cmp(&b.0));
            pieces.push(self.parted_edge(edge, &splits));
        }
        brep.vertices = self.vertices;
        let mut more = Vec::new();
        let mut is_part = vec![false; brep.faces.len()];
        for (i, cells) in parts {
            let BrepFace { reversed, label, .. } = brep.faces[i].clone();
            let object = brep.object_of.get(i).copied();
            is_part[i] = true;
            for (n, cell) in cells.into_iter().enumerate() {
                let of_ring = |ring: &Vec<Piece>| coedges(ring, &pieces, reversed);
                let loops = cell.rings.iter().map(of_ring).filter(|l| !l.is_empty()).collect();
                let label = label.clone();
                let face = BrepFace { shape: cell.shape, loops, reversed, label };
                if n == 0 {
                    brep.faces[i] = face;
                } else {
                    more.push(face);
                    brep.object_of.extend(object);
                }
            }
        }
        let others = brep.faces.iter_mut().zip(is_part).filter(|f| !f.1);
        for coedges in others.flat_map(|f| &mut f.0.loops) {
            let each = |c: &Coedge| {
                let all = pieces[c.edge as usize].iter();
                let mut run: Vec<Coedge> =
                    all.map(|&(_, edge)| Coedge { edge, reversed: c.reversed }).collect();
                if c.reversed {
                    run.reverse();
                }
                run
            };
            *coedges = coedges.iter().flat_map(each).collect();
        }
        brep.edges = self.edges;
        more
    }

    /// Part an edge; where each of its pieces ends, and the edge that it is.
    fn parted_edge(&mut self, edge: usize, splits: &[(f64, u32)]) -> Vec<(f64, u32)> {
        let whole = self.edges[edge].clone();
        let [from, to] = whole.range;
        if splits.is_empty() {
            return vec![(to, edge as u32)];
        }
        let mut pieces = Vec::new();
        let (mut start, mut first) = (from, whole.ends[0]);
        for &(t, vertex) in splits.iter().chain(&[(to, whole.ends[1])]) {
            let piece = BrepEdge {
                curve: piece(&whole.curve, [start, t]),
                range: [start, t],
                ends: [first, vertex],
            };
            let id = if pieces.is_empty() {
                self.edges[edge] = piece;
                edge as u32
            } else {
                self.edges.push(piece);
                self.edges.len() as u32 - 1
            };
            pieces.push((t, id));
            (start, first) = (t, vertex);
        }
        pieces
    }
}

/// The curve over part of its range, without points that have no part in it.
fn piece(curve: &Curve, range: [f64; 2]) -> Curve {
    match curve {
        Curve::Nurbs(c) => Curve::Nurbs(c.part(range).unwrap_or_else(|| c.clone())),
        other => other.clone(),
    }
}

/// The edges along a ring, seen from the outside of its face.
fn coedges(ring: &[Piece], pieces: &[Vec<(f64, u32)>], reversed: bool) -> Vec<Coedge> {
    let mut all = Vec::new();
    for piece in ring {
        let Some(edge) = piece.edge else { continue };
        let (start, end) = (piece.path[0].t, piece.path[piece.path.len() - 1].t);
        let (lo, hi) = (start.min(end), start.max(end));
        let of_edge = &pieces[edge as usize];
        let from = of_edge.partition_point(|&(to, _)| to <= lo);
        let to = of_edge.partition_point(|&(to, _)| to < hi);
        // In a damaged file a piece may lie beyond its edge: the loop is then open, and refused as such.
        let run = of_edge.get(from..=to.min(of_edge.len() - 1).max(from)).unwrap_or_default();
        let first = all.len();
        all.extend(run.iter().map(|&(_, edge)| Coedge { edge, reversed: start > end }));
        if start > end {
            all[first..].reverse();
        }
    }
    if reversed {
        all.reverse();
        for c in &mut all {
            c.reversed = !c.reversed;
        }
    }
    all
}
