//! Storage and queries of the ring mesh; edits are in [`edit`](super::edit).

use crate::error::{Error, Result};
use smallvec::SmallVec;

/// Ordered neighbours of a vertex.
pub type Ring = SmallVec<[u32; 8]>;

/// The neighbours of a vertex along features, in no meaning order: two on a feature, none off it.
pub type Along = SmallVec<[u32; 2]>;

/// A manifold, oriented triangle mesh as rings of neighbours. See the [module](super) for the convention.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    pub(super) rings: Vec<Ring>,
    pub(super) boundary: Vec<bool>,
    /// Vertices that no edit may remove: corners and anchors.
    pub(super) pinned: Vec<bool>,
    /// Neighbours of each vertex along features.
    pub(super) features: Vec<Along>,
    /// Vertices not removed.
    pub(super) alive: usize,
    /// Removed vertices, for reuse.
    pub(super) free: Vec<u32>,
}

impl Mesh {
    /// The mesh of `n` vertices and these triangles (counter-clockwise seen from outside).
    ///
    /// # Errors
    /// [`Error::Surface`] naming the vertex where the triangles are not a manifold, or are not oriented
    /// consistently, or where a vertex belongs to no triangle.
    pub fn from_triangles(n: usize, triangles: &[[u32; 3]]) -> Result<Mesh> {
        // At each corner, the triangle leads from one neighbour to the next.
        let mut steps: Vec<SmallVec<[(u32, u32); 8]>> = vec![SmallVec::new(); n];
        for t in triangles {
            for k in 0..3 {
                steps[t[k] as usize].push((t[(k + 1) % 3], t[(k + 2) % 3]));
            }
        }
        let mut mesh = Mesh {
            boundary: vec![false; n],
            pinned: vec![false; n],
            features: vec![Along::new(); n],
            alive: n,
            ..Mesh::default()
        };
        for (v, steps) in steps.into_iter().enumerate() {
            let (ring, boundary) = chain_up(&steps).ok_or_else(|| {
                Error::Surface(format!("the triangles around vertex {v} do not form one fan"))
            })?;
            mesh.rings.push(ring);
            mesh.boundary[v] = boundary;
        }
        Ok(mesh)
    }

    /// Number of vertex slots, removed ones included: ids are below this.
    pub fn slots(&self) -> usize {
        self.rings.len()
    }

    /// Whether `v` is in use.
    pub fn is_alive(&self, v: u32) -> bool {
        !self.rings[v as usize].is_empty()
    }

    /// All vertices in use, ascending.
    pub fn vertices(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.rings.len() as u32).filter(|&v| self.is_alive(v))
    }

    /// Neighbours of `v`, counter-clockwise.
    pub fn ring(&self, v: u32) -> &[u32] {
        &self.rings[v as usize]
    }

    /// Number of edges at `v`.
    pub fn degree(&self, v: u32) -> usize {
        self.rings[v as usize].len()
    }

    /// Whether `v` lies on the boundary.
    pub fn is_boundary(&self, v: u32) -> bool {
        self.boundary[v as usize]
    }

    /// Whether `v` may not be removed.
    pub fn is_pinned(&self, v: u32) -> bool {
        self.pinned[v as usize]
    }

    /// Forbid (or allow again) the removal of `v`.
    pub fn pin(&mut self, v: u32, pinned: bool) {
        self.pinned[v as usize] = pinned;
    }

    /// Make the edge `a`, `b` part of a feature: no edit takes it away, but for splitting it and for collapsing
    /// it along the feature.
    ///
    /// # Errors
    /// [`Error::Surface`] when no edge joins the two.
    pub fn mark_feature(&mut self, a: u32, b: u32) -> Result<()> {
        if !self.adjacent(a, b) {
            return Err(Error::Surface(format!("no member joins nodes {a} and {b} of a feature")));
        }
        if !self.is_feature_edge(a, b) {
            self.features[a as usize].push(b);
            self.features[b as usize].push(a);
        }
        Ok(())
    }

    /// The edge `a`, `b` is part of no feature any more.
    pub fn unmark_feature(&mut self, a: u32, b: u32) {
        self.features[a as usize].retain(|v| *v != b);
        self.features[b as usize].retain(|v| *v != a);
    }

    /// Whether the edge `a`, `b` is part of a feature.
    pub fn is_feature_edge(&self, a: u32, b: u32) -> bool {
        self.features[a as usize].contains(&b)
    }

    /// The neighbours of `v` along features.
    pub fn along_features(&self, v: u32) -> &[u32] {
        &self.features[v as usize]
    }

    /// Place of `b` in the ring of `a`.
    pub fn position(&self, a: u32, b: u32) -> Option<usize> {
        self.rings[a as usize].iter().position(|&x| x == b)
    }

    /// Whether an edge joins `a` and `b`.
    pub fn adjacent(&self, a: u32, b: u32) -> bool {
        self.position(a, b).is_some()
    }

    /// Apex of the triangle on the left of the directed edge `a -> b`; None on the boundary.
    pub fn left(&self, a: u32, b: u32) -> Option<u32> {
        let ring = &self.rings[a as usize];
        let i = self.position(a, b)?;
        match ring.get(i + 1) {
            Some(&c) => Some(c),
            None if self.boundary[a as usize] => None,
            None => Some(ring[0]),
        }
    }

    /// Apex of the triangle on the right of the directed edge `a -> b`; None on the boundary.
    pub fn right(&self, a: u32, b: u32) -> Option<u32> {
        let ring = &self.rings[a as usize];
        match self.position(a, b)? {
            0 if self.boundary[a as usize] => None,
            0 => ring.last().copied(),
            i => Some(ring[i - 1]),
        }
    }

    /// Whether the edge `a`, `b` lies on the boundary.
    pub fn is_boundary_edge(&self, a: u32, b: u32) -> bool {
        self.boundary[a as usize]
            && self.boundary[b as usize]
            && (self.left(a, b).is_none() || self.right(a, b).is_none())
    }

    /// The next vertex along the boundary, surface to the left.
    pub fn next_on_boundary(&self, v: u32) -> Option<u32> {
        self.boundary[v as usize].then(|| self.rings[v as usize][0])
    }

    /// The previous vertex along the boundary.
    pub fn previous_on_boundary(&self, v: u32) -> Option<u32> {
        if self.boundary[v as usize] { self.rings[v as usize].last().copied() } else { None }
    }

    /// Number of triangles at `v`.
    pub fn face_degree(&self, v: u32) -> usize {
        self.degree(v) - usize::from(self.boundary[v as usize])
    }

    /// The triangles around `v`, as the pairs of neighbours opposite to it.
    pub fn fan(&self, v: u32) -> impl Iterator<Item = (u32, u32)> + '_ {
        let ring = &self.rings[v as usize];
        (0..self.face_degree(v)).map(move |i| (ring[i], ring[(i + 1) % ring.len()]))
    }

    /// Every edge once, as (lower id, higher id), in ascending order of the lower one.
    pub fn edges(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.vertices()
            .flat_map(|v| self.ring(v).iter().filter(move |&&w| v < w).map(move |&w| (v, w)))
    }

    /// Every triangle once, its lowest id first, in ascending order of that.
    pub fn triangles(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.vertices().flat_map(|v| {
            self.fan(v).filter(move |&(a, b)| v < a && v < b).map(move |(a, b)| [v, a, b])
        })
    }

    /// Number of vertices in use.
    pub fn vertex_count(&self) -> usize {
        self.alive
    }

    /// Number of boundary vertices.
    pub fn boundary_count(&self) -> usize {
        self.boundary.iter().filter(|&&b| b).count()
    }

    /// Number of edges.
    pub fn edge_count(&self) -> usize {
        self.rings.iter().map(Ring::len).sum::<usize>() / 2
    }

    /// Number of triangles.
    pub fn face_count(&self) -> usize {
        self.vertices().map(|v| self.face_degree(v)).sum::<usize>() / 3
    }

    /// V - E + F.
    pub fn euler_characteristic(&self) -> i64 {
        self.vertex_count() as i64 - self.edge_count() as i64 + self.face_count() as i64
    }

    /// The boundary loops, each from its lowest vertex, surface to the left; ascending by that vertex.
    pub fn boundary_loops(&self) -> Vec<Vec<u32>> {
        let mut seen = vec![false; self.slots()];
        let mut loops = Vec::new();
        for start in self.vertices().filter(|&v| self.is_boundary(v)) {
            if seen[start as usize] {
                continue;
            }
            let mut chain = Vec::new();
            let mut v = start;
            while !seen[v as usize] {
                seen[v as usize] = true;
                chain.push(v);
                v = self.rings[v as usize][0];
            }
            loops.push(chain);
        }
        loops
    }
}

/// Join the steps (neighbour, next neighbour) of the triangles round a vertex to one ring; whether it is
/// open. None when they do not form a single fan.
fn chain_up(steps: &[(u32, u32)]) -> Option<(Ring, bool)> {
    let first = steps.first()?;
    // Sorted, as hubs have thousands of neighbours.
    let mut onward: SmallVec<[(u32, u32); 8]> = steps.into();
    onward.sort_unstable();
    if onward.windows(2).any(|w| w[0].0 == w[1].0) {
        return None;
    }
    let mut reached: Ring = steps.iter().map(|s| s.1).collect();
    reached.sort_unstable();
    // An open fan begins with the neighbour that no triangle leads to.
    let mut starts = steps.iter().filter(|s| reached.binary_search(&s.0).is_err());
    let start = starts.next();
    if starts.next().is_some() {
        return None;
    }
    let open = start.is_some();
    let begin = start.unwrap_or(first).0;
    let mut ring = Ring::new();
    let mut at = begin;
    for _ in 0..steps.len() {
        ring.push(at);
        at = onward[onward.binary_search_by_key(&at, |s| s.0).ok()?].1;
    }
    if open {
        ring.push(at);
    } else if at != begin {
        return None;
    }
    let mut sorted = ring.clone();
    sorted.sort_unstable();
    sorted.dedup();
    (sorted.len() == ring.len()).then_some((ring, open))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hexagon_fan_has_one_interior_vertex() {
        let triangles: Vec<[u32; 3]> = (0..6).map(|k| [0, 1 + k, 1 + (k + 1) % 6]).collect();
        let mesh = Mesh::from_triangles(7, &triangles).expect("a disc");
        assert_eq!((mesh.vertex_count(), mesh.edge_count(), mesh.face_count()), (7, 12, 6));
        assert_eq!(mesh.euler_characteristic(), 1);
        assert!(!mesh.is_boundary(0) && mesh.degree(0) == 6);
        assert_eq!(mesh.next_on_boundary(1), Some(2));
        assert_eq!(mesh.previous_on_boundary(1), Some(6));
        assert_eq!(mesh.left(1, 2), Some(0));
        assert_eq!(mesh.right(1, 2), None);
        assert_eq!(mesh.boundary_loops(), vec![vec![1, 2, 3, 4, 5, 6]]);
        mesh.check().expect("valid");
    }

    #[test]
    fn two_fans_that_share_only_a_vertex_are_refused() {
        assert!(Mesh::from_triangles(5, &[[0, 1, 2], [0, 3, 4]]).is_err());
    }

    #[test]
    fn triangles_that_disagree_on_the_outside_are_refused() {
        assert!(Mesh::from_triangles(4, &[[0, 1, 2], [1, 2, 3]]).is_err());
    }
}
