//! An intrinsic triangulation: a mesh with edge lengths measured along the surface.

use super::PHASE;
use crate::job::Job;
use crate::mesh::{Mesh, Undo};
use glam::{DVec2, DVec3};
use smallvec::SmallVec;

/// A mesh and the lengths of its edges.
pub struct Intrinsic {
    pub mesh: Mesh,
    /// Per vertex: (neighbour with a higher id, length).
    lengths: Vec<SmallVec<[(u32, f64); 4]>>,
    /// Edges that may have ceased to be Delaunay.
    suspects: Vec<(u32, u32)>,
    undo: Undo,
}

/// More than a full turn is round a vertex where the surface is a saddle, so that its last four neighbours may
/// lie such that no edge can be flipped away from it. This much of an edge it may be on the wrong side of the
/// new one: the vertex goes next, and with it what was wrong.
const SADDLE: f64 = 0.1;

impl Intrinsic {
    /// The triangulation of a carrier, with straight edges.
    pub fn new(mesh: Mesh, xyz: &[DVec3]) -> Intrinsic {
        let lengths = vec![SmallVec::new(); mesh.slots()];
        let edges: Vec<(u32, u32)> = mesh.edges().collect();
        let mut this = Intrinsic { mesh, lengths, suspects: Vec::new(), undo: Undo::default() };
        for (a, b) in edges {
            this.set_length(a, b, xyz[a as usize].distance(xyz[b as usize]));
        }
        this
    }

    fn length(&self, a: u32, b: u32) -> f64 {
        let (a, b) = (a.min(b), a.max(b));
        self.lengths[a as usize].iter().find(|e| e.0 == b).expect("every edge has a length").1
    }

    fn set_length(&mut self, a: u32, b: u32, length: f64) {
        let (a, b) = (a.min(b), a.max(b));
        if self.lengths.len() < self.mesh.slots() {
            self.lengths.resize(self.mesh.slots(), SmallVec::new());
        }
        let list = &mut self.lengths[a as usize];
        match list.iter_mut().find(|e| e.0 == b) {
            Some(e) => e.1 = length,
            None => list.push((b, length)),
        }
    }

    fn forget_length(&mut self, a: u32, b: u32) {
        let (a, b) = (a.min(b), a.max(b));
        self.lengths[a as usize].retain(|e| e.0 != b);
    }

    /// Put a vertex into a triangle, at these distances from its corners.
    pub fn insert(&mut self, corners: [u32; 3], distances: [f64; 3]) -> u32 {
        let m = self.mesh.insert_in_triangle(corners);
        for k in 0..3 {
            self.set_length(corners[k], m, distances[k]);
        }
        m
    }

    /// Split the edge from `a` to `b`, on the boundary or on a feature, at `share` of its length.
    pub fn split(&mut self, a: u32, b: u32, share: f64) -> u32 {
        let whole = self.length(a, b);
        let c = self.mesh.left(a, b).expect("the surface lies to the left of its loops");
        let apex = self.apex(a, b, c);
        let across = self.mesh.right(a, b).map(|d| (d, self.apex(a, b, d)));
        let m = self.mesh.try_split(a, b, &mut self.undo).expect("the edge exists");
        self.undo.clear();
        if let Some((d, apex)) = across {
            self.set_length(m, d, apex.distance(DVec2::new(whole * share, 0.0)));
        }
        self.forget_length(a, b);
        self.set_length(a, m, whole * share);
        self.set_length(m, b, whole * (1.0 - share));
        self.set_length(m, c, apex.distance(DVec2::new(whole * share, 0.0)));
        m
    }

    /// Triangle (a, b, c) laid into the plane with a at the origin and b on the x axis: where c is, above.
    fn apex(&self, a: u32, b: u32, c: u32) -> DVec2 {
        let (ab, ac, bc) = (self.length(a, b), self.length(a, c), self.length(b, c));
        let x = (ab * ab + ac * ac - bc * bc) / (2.0 * ab);
        DVec2::new(x, (ac * ac - x * x).max(0.0).sqrt())
    }

    /// The two triangles at the edge laid into the plane: length of the edge, left apex (above), right apex
    /// (below). None on the boundary.
    fn quad(&self, a: u32, b: u32) -> Option<(f64, DVec2, DVec2)> {
        let (c, d) = (self.mesh.left(a, b)?, self.mesh.right(a, b)?);
        let below = self.apex(a, b, d);
        Some((self.length(a, b), self.apex(a, b, c), DVec2::new(below.x, -below.y)))
    }

    /// Whether the edge is Delaunay: its two opposite angles sum to at most pi.
    fn is_delaunay(&self, a: u32, b: u32) -> bool {
        let Some((l, c, d)) = self.quad(a, b) else { return true };
        let b = DVec2::new(l, 0.0);
        // The sine of the sum of the two angles is negative when they exceed pi.
        let (u, v) = ((-c, b - c), (b - d, -d));
        let sine = u.0.perp_dot(u.1) * v.0.dot(v.1) + u.0.dot(u.1) * v.0.perp_dot(v.1);
        let scale = u.0.length_squared()
            * u.1.length_squared()
            * v.0.length_squared()
            * v.1.length_squared();
        sine >= -1e-9 * scale.sqrt()
    }

    /// Flip the edge if topology allows; the new edge gets the length across.
    fn flip(&mut self, a: u32, b: u32) -> bool {
        let Some((_, c, d)) = self.quad(a, b) else { return false };
        let Ok((p, q)) = self.mesh.try_flip(a, b, &mut self.undo) else { return false };
        self.undo.clear();
        self.forget_length(a, b);
        self.set_length(p, q, c.distance(d));
        self.suspects.extend([(a, p), (p, b), (b, q), (q, a)]);
        true
    }

    /// Flip until every edge is Delaunay (Lawson).
    pub fn make_delaunay(&mut self, job: &Job) {
        self.suspects = self.mesh.edges().collect();
        self.settle(job);
    }

    fn settle(&mut self, job: &Job) {
        // Lawson's flips end by themselves; rounding and refused flips are what the limit guards against.
        let mut budget = 100 * self.suspects.len() + 10_000;
        while let Some((a, b)) = self.suspects.pop() {
            if budget == 0 || job.is_over(PHASE) {
                self.suspects.clear();
                return;
            }
            if self.mesh.adjacent(a, b) && !self.is_delaunay(a, b) {
                budget -= 1;
                self.flip(a, b);
            }
        }
    }

    /// Remove these vertices, keeping the rest Delaunay; gives those that cannot go without changing the
    /// surface's topology. Of no use where the job is over: the caller is to check.
    pub fn remove_all(&mut self, mut vertices: Vec<u32>, job: &Job) -> Vec<u32> {
        loop {
            let before = vertices.len();
            vertices.retain(|&v| {
                if job.is_over(PHASE) {
                    return false;
                }
                let gone = self.remove(v);
                self.settle(job);
                !gone
            });
            if vertices.is_empty() || vertices.len() == before {
                return vertices;
            }
        }
    }

    /// Flip edges away from `v` until it hangs by three (inside) or two or three (boundary), then take it.
    fn remove(&mut self, v: u32) -> bool {
        if let &[p, q] = self.mesh.along_features(v) {
            return self.remove_from_feature(v, p, q);
        }
        while self.mesh.degree(v) > 3 {
            let ring: SmallVec<[u32; 8]> = self.mesh.ring(v).into();
            let shortest = |reflex: f64| {
                let lengths =
                    ring.iter().filter_map(|&w| Some((self.flipped_length(v, w, reflex)?, w)));
                lengths.min_by(|x, y| x.0.total_cmp(&y.0))
            };
            match shortest(0.0).or_else(|| shortest(SADDLE)) {
                Some((_, w)) if self.flip(v, w) => {}
                _ => return false,
            }
        }
        let ring: SmallVec<[u32; 8]> = self.mesh.ring(v).into();
        let (first, last) = (ring[0], ring[ring.len() - 1]);
        let boundary = self.mesh.is_boundary(v);
        let along = self.length(v, first) + self.length(v, last);
        if self.mesh.try_collapse(last, v, &mut self.undo).is_err() {
            return false;
        }
        self.undo.clear();
        for &w in &ring {
            self.forget_length(v, w);
        }
        if boundary && ring.len() == 3 {
            // The boundary between two nodes is one member, however it bends.
            self.set_length(first, last, along);
        }
        for i in 0..ring.len() {
            self.suspects.push((ring[i], ring[(i + 1) % ring.len()]));
        }
        true
    }

    /// Flip edges away from `v`, which is on a feature between `p` and `q`, until it hangs by one on either side,
    /// then take it: the feature leads from `p` to `q`.
    fn remove_from_feature(&mut self, v: u32, p: u32, q: u32) -> bool {
        for (from, to) in [(p, q), (q, p)] {
            loop {
                let side = self.between(v, from, to);
                if side.len() <= 1 {
                    break;
                }
                let shortest = |reflex: f64| {
                    let lengths =
                        side.iter().filter_map(|&w| Some((self.flipped_length(v, w, reflex)?, w)));
                    lengths.min_by(|x, y| x.0.total_cmp(&y.0))
                };
                match shortest(0.0).or_else(|| shortest(SADDLE)) {
                    Some((_, w)) if self.flip(v, w) => {}
                    _ => return false,
                }
            }
        }
        let ring: SmallVec<[u32; 8]> = self.mesh.ring(v).into();
        let along = self.length(v, p) + self.length(v, q);
        if self.mesh.try_collapse(q, v, &mut self.undo).is_err() {
            return false;
        }
        self.undo.clear();
        for &w in &ring {
            self.forget_length(v, w);
        }
        // The feature between two nodes is one member, however it bends.
        self.set_length(p, q, along);
        for i in 0..ring.len() {
            self.suspects.push((ring[i], ring[(i + 1) % ring.len()]));
        }
        true
    }

    /// The neighbours of `v` counter-clockwise after `from` and before `to`.
    fn between(&self, v: u32, from: u32, to: u32) -> SmallVec<[u32; 8]> {
        let ring = self.mesh.ring(v);
        let at = self.mesh.position(v, from).expect("features join neighbours");
        let onward = (1..ring.len()).map(|i| ring[(at + i) % ring.len()]);
        onward.take_while(|&w| w != to).collect()
    }

    /// Length of the edge that flipping (v, w) would make; None unless the two triangles form a convex
    /// quadrilateral and the new edge does not exist yet. At v it may be reflex by a share of the edge.
    fn flipped_length(&self, v: u32, w: u32, reflex: f64) -> Option<f64> {
        let (l, c, d) = self.quad(v, w)?;
        if self.mesh.adjacent(self.mesh.left(v, w)?, self.mesh.right(v, w)?) {
            return None;
        }
        // Where the line from c to d crosses the axis of the edge.
        let x = c.x + (d.x - c.x) * c.y / (c.y - d.y).max(f64::MIN_POSITIVE);
        (x > -reflex * l && x < l * (1.0 - 1e-12)).then(|| c.distance(d))
    }
}
