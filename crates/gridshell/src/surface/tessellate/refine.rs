//! Triangles of one face made good in space: flips towards Delaunay, splits of edges that are too long or too
//! far off the patch.
//!
//! (u, v) may be stretched against space, so triangles that are Delaunay there need not be well shaped; and
//! thinned points leave some edges longer than asked for. Edges of the polygons are never touched, so faces
//! go on fitting together.

use super::edges::LEAST_SHARE;
use super::trim::{NEW, Node};
use crate::job::Job;
use crate::surface::carrier::{NONE, adjacency};
use crate::surface::{PREPARING, Sampling, Shape};
use glam::{DVec2, DVec3};

/// Rounds of flips and splits; each halves what is too long.
const MAX_ROUNDS: usize = 12;
/// Two angles that face each other sum to more than half a turn when their cotangents sum to less than
/// this; a little below 0 so that the diagonals of squares stay as they are, however their corners were rounded.
const COTANGENT_SUM: f64 = -1e-6;
/// The middle of an edge may lie this share of its length beside the edge, within the patch.
const BESIDE: f64 = 0.15;
/// An edge counts as too long from this share above the bound.
const TOLERANCE: f64 = 1e-6;

/// The triangulation of one face while it is worked on.
pub(super) struct Web<'a> {
    shape: &'a Shape,
    pub nodes: Vec<Node>,
    pub triangles: Vec<[u32; 3]>,
    neighbors: Vec<[u32; 3]>,
    /// Edges that must stay: polygon edges with the face on both sides.
    fixed: Vec<[bool; 3]>,
}

impl<'a> Web<'a> {
    /// A web of these triangles, counter-clockwise in (u, v). Nodes of one pole become one, and triangles
    /// that this leaves without area go. `rims` are the polygon edges.
    pub fn new(
        shape: &'a Shape,
        nodes: Vec<Node>,
        triangles: &[[u32; 3]],
        rims: &[[u32; 2]],
    ) -> Web<'a> {
        let mut same: Vec<u32> = (0..nodes.len() as u32).collect();
        let mut poles = std::collections::BTreeMap::new();
        for (i, node) in nodes.iter().enumerate() {
            if node.free.is_some() {
                same[i] = *poles.entry((node.vertex, node.free)).or_insert(i as u32);
            }
        }
        let triangles: Vec<[u32; 3]> = triangles
            .iter()
            .map(|t| t.map(|i| same[i as usize]))
            .filter(|t| t[0] != t[1] && t[1] != t[2] && t[2] != t[0])
            .collect();
        let mut rims: Vec<(u32, u32)> = rims
            .iter()
            .map(|r| r.map(|i| same[i as usize]))
            .map(|[a, b]| (a.min(b), a.max(b)))
            .collect();
        rims.sort_unstable();
        let fixed = triangles
            .iter()
            .map(|t| {
                [0, 1, 2].map(|k| {
                    let (a, b) = (t[k], t[(k + 1) % 3]);
                    rims.binary_search(&(a.min(b), a.max(b))).is_ok()
                })
            })
            .collect();
        let neighbors = adjacency(&triangles);
        Web { shape, nodes, triangles, neighbors, fixed }
    }

    /// Inner nodes where two edges lead to the same pole: seen in space the surface is pinched there.
    pub fn pinches(&self) -> Vec<u32> {
        let mut spokes: Vec<(u32, u32)> = Vec::new();
        for t in &self.triangles {
            for k in 0..3 {
                let (pole, a, b) = (t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
                if self.nodes[pole as usize].free.is_some() {
                    spokes.extend([(pole, a), (pole, b)]);
                }
            }
        }
        spokes.sort_unstable();
        let mut pinches = Vec::new();
        for group in spokes.chunk_by(|a, b| a == b) {
            if group.len() <= 2 {
                continue;
            }
            let (pole, outer) = group[0];
            if self.nodes[outer as usize].vertex == NEW {
                pinches.push(outer);
                continue;
            }
            // A node of the rim stays: what lies between it and the pole goes.
            for t in self.triangles.iter().filter(|t| t.contains(&pole) && t.contains(&outer)) {
                pinches.extend(t.iter().filter(|&&n| self.nodes[n as usize].vertex == NEW));
            }
        }
        pinches.sort_unstable();
        pinches.dedup();
        pinches
    }

    /// Flip and split until every inner edge keeps the sampling, or there are more than `most` nodes.
    pub fn refine(&mut self, sampling: &Sampling, most: usize, job: &Job) {
        for _ in 0..MAX_ROUNDS {
            self.flip_all(job);
            if !self.split_long(sampling, most, job) || self.nodes.len() > most {
                break;
            }
        }
        self.flip_all(job);
    }

    fn xyz(&self, i: u32) -> DVec3 {
        self.nodes[i as usize].xyz
    }

    /// Flip edges until all are Delaunay in space.
    fn flip_all(&mut self, job: &Job) {
        let mut open: Vec<(u32, u8)> =
            (0..self.triangles.len() as u32).flat_map(|t| [(t, 0), (t, 1), (t, 2)]).collect();
        // Every flip betters the least angle, so this ends; the bound guards against rounding.
        let mut left = 60 * self.triangles.len() + 1000;
        while let Some((t, k)) = open.pop() {
            if left == 0 || job.is_over(PREPARING) {
                break;
            }
            if let Some(other) = self.try_flip(t, k as usize) {
                left -= 1;
                open.extend([t, other].iter().flat_map(|&t| [(t, 0), (t, 1), (t, 2)]));
            }
        }
    }

    /// ```text
    ///       c                c
    ///     /   \            / | \
    ///   a --k-- b   ->   a   |   b      triangle t = (a, b, c) becomes (c, a, d),
    ///     \   /            \ | /        its neighbour (b, a, d) becomes (d, b, c)
    ///       d                d
    /// ```
    fn try_flip(&mut self, t: u32, k: usize) -> Option<u32> {
        let o = self.neighbors[t as usize][k];
        if o == NONE || self.fixed[t as usize][k] {
            return None;
        }
        let tri = self.triangles[t as usize];
        let (a, b, c) = (tri[k], tri[(k + 1) % 3], tri[(k + 2) % 3]);
        let m = self.edge_from(o, b)?;
        let d = self.triangles[o as usize][(m + 2) % 3];
        let [pa, pb, pc, pd] = [a, b, c, d].map(|i| self.xyz(i));
        if c == d || cotangent(pa - pc, pb - pc) + cotangent(pa - pd, pb - pd) >= COTANGENT_SUM {
            return None;
        }
        if self.joined(t, c, d) {
            return None;
        }
        // Both new triangles must look the same way as the old ones, in space and in (u, v).
        let up = (pb - pa).cross(pc - pa).normalize_or_zero()
            + (pa - pb).cross(pd - pb).normalize_or_zero();
        let faces = |p: DVec3, q: DVec3, r: DVec3| (q - p).cross(r - p).dot(up) > 0.0;
        if !faces(pc, pa, pd)
            || !faces(pd, pb, pc)
            || !self.upright([c, a, d])
            || !self.upright([d, b, c])
        {
            return None;
        }
        let (t, o) = (t as usize, o as usize);
        let (bc, ca) = ((k + 1) % 3, (k + 2) % 3);
        let (ad, db) = ((m + 1) % 3, (m + 2) % 3);
        let near = [
            (self.neighbors[t][bc], self.fixed[t][bc]),
            (self.neighbors[t][ca], self.fixed[t][ca]),
        ];
        let far = [
            (self.neighbors[o][ad], self.fixed[o][ad]),
            (self.neighbors[o][db], self.fixed[o][db]),
        ];
        self.triangles[t] = [c, a, d];
        self.neighbors[t] = [near[1].0, far[0].0, o as u32];
        self.fixed[t] = [near[1].1, far[0].1, false];
        self.triangles[o] = [d, b, c];
        self.neighbors[o] = [far[1].0, near[0].0, t as u32];
        self.fixed[o] = [far[1].1, near[0].1, false];
        self.relink(far[0].0, d, t as u32);
        self.relink(near[0].0, c, o as u32);
        Some(o as u32)
    }

    /// Whether an edge already joins `c`, a corner of triangle `t`, to `d`.
    fn joined(&self, t: u32, c: u32, d: u32) -> bool {
        // Round c one way, and from a boundary the other way.
        for way in [2, 0] {
            let mut here = t;
            while let Some(k) = self.edge_from(here, c) {
                let next = self.neighbors[here as usize][(k + way) % 3];
                if next == NONE {
                    break;
                }
                if self.triangles[next as usize].contains(&d) {
                    return true;
                }
                if next == t {
                    return false;
                }
                here = next;
            }
        }
        false
    }

    /// Which edge of triangle `t` begins at node `from`.
    fn edge_from(&self, t: u32, from: u32) -> Option<usize> {
        self.triangles[t as usize].iter().position(|&c| c == from)
    }

    /// Tell triangle `t` that `over` now lies across its edge from `from`.
    fn relink(&mut self, t: u32, from: u32, over: u32) {
        if t == NONE {
            return;
        }
        if let Some(k) = self.edge_from(t, from) {
            self.neighbors[t as usize][k] = over;
        }
    }

    /// Whether a triangle is counter-clockwise in (u, v). At a pole the direction that means nothing is
    /// taken from the other corners.
    fn upright(&self, triangle: [u32; 3]) -> bool {
        let n = triangle.map(|i| &self.nodes[i as usize]);
        let mut uv = n.map(|n| n.uv);
        for k in 0..3 {
            if let Some(free) = n[k].free {
                uv[k][free] = 0.5 * (n[(k + 1) % 3].uv[free] + n[(k + 2) % 3].uv[free]);
            }
        }
        (uv[1] - uv[0]).perp_dot(uv[2] - uv[0]) > 0.0
    }

    /// Parameters of the middle of the edge between two nodes.
    fn middle(&self, a: u32, b: u32) -> DVec2 {
        let (a, b) = (&self.nodes[a as usize], &self.nodes[b as usize]);
        let mut uv = 0.5 * (a.uv + b.uv);
        if let Some(k) = a.free {
            uv[k] = b.uv[k];
        }
        if let Some(k) = b.free {
            uv[k] = a.uv[k];
        }
        uv
    }

    /// Split inner edges that break the sampling, longest first, none next to another, until there are more than `most`
    /// nodes. Whether any was.
    fn split_long(&mut self, sampling: &Sampling, most: usize, job: &Job) -> bool {
        let mut long: Vec<(f64, u32, u8)> = Vec::new();
        for t in 0..self.triangles.len() as u32 {
            if job.is_over(PREPARING) {
                return false;
            }
            for k in 0..3 {
                let o = self.neighbors[t as usize][k];
                if o == NONE || o < t || self.fixed[t as usize][k] {
                    continue;
                }
                let (a, b) =
                    (self.triangles[t as usize][k], self.triangles[t as usize][(k + 1) % 3]);
                let length = self.xyz(a).distance(self.xyz(b));
                if length > sampling.max_edge * (1.0 + TOLERANCE)
                    || self.sags(a, b, length, sampling)
                {
                    long.push((length, t, k as u8));
                }
            }
        }
        long.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        let mut touched = vec![false; self.triangles.len()];
        for &(_, t, k) in &long {
            if self.nodes.len() > most {
                break;
            }
            let o = self.neighbors[t as usize][k as usize];
            // Triangles made in this round lie beyond the list.
            if touched[t as usize] || touched.get(o as usize).is_none_or(|&o| o) {
                continue;
            }
            touched[t as usize] = true;
            touched[o as usize] = true;
            self.split(t, k as usize);
        }
        !long.is_empty()
    }

    /// Whether the patch bulges away from the edge by more than the chord error, or the straight line in
    /// (u, v) runs far beside the edge (as it does round a pole).
    fn sags(&self, a: u32, b: u32, length: f64, sampling: &Sampling) -> bool {
        if length < 2.0 * LEAST_SHARE * sampling.max_edge {
            return false;
        }
        let (pa, pb) = (self.xyz(a), self.xyz(b));
        let jet = self.shape.jet(self.middle(a, b));
        let d = jet.point - 0.5 * (pa + pb);
        let along = (pb - pa) / length;
        let off = d - along * d.dot(along);
        let bulge = off.dot(jet.normal()).abs();
        bulge > sampling.chord_error || off.length() - bulge > BESIDE * length
    }

    /// ```text
    ///       c                c
    ///     /   \            / | \
    ///   a --k-- b   ->   a - x - b      new triangles (x, b, c) and (a, x, d) at the end
    ///     \   /            \ | /
    ///       d                d
    /// ```
    fn split(&mut self, t: u32, k: usize) {
        let o = self.neighbors[t as usize][k];
        let tri = self.triangles[t as usize];
        let (a, b, c) = (tri[k], tri[(k + 1) % 3], tri[(k + 2) % 3]);
        let Some(m) = self.edge_from(o, b) else { return };
        let d = self.triangles[o as usize][(m + 2) % 3];
        let uv = self.middle(a, b);
        let x = self.nodes.len() as u32;
        self.nodes.push(Node { uv, xyz: self.shape.point(uv), vertex: NEW, free: None });
        let (ti, oi) = (t as usize, o as usize);
        let (p, q) = (self.triangles.len() as u32, self.triangles.len() as u32 + 1);
        let (bc, ca) = ((k + 1) % 3, (k + 2) % 3);
        let (ad, db) = ((m + 1) % 3, (m + 2) % 3);
        let [(n_bc, f_bc), (n_ca, f_ca)] =
            [bc, ca].map(|e| (self.neighbors[ti][e], self.fixed[ti][e]));
        let [(n_ad, f_ad), (n_db, f_db)] =
            [ad, db].map(|e| (self.neighbors[oi][e], self.fixed[oi][e]));
        // t keeps a, o keeps b.
        self.triangles[ti] = [a, x, c];
        self.neighbors[ti] = [q, p, n_ca];
        self.fixed[ti] = [false, false, f_ca];
        self.triangles[oi] = [b, x, d];
        self.neighbors[oi] = [p, q, n_db];
        self.fixed[oi] = [false, false, f_db];
        self.triangles.push([x, b, c]);
        self.neighbors.push([o, n_bc, t]);
        self.fixed.push([false, f_bc, false]);
        self.triangles.push([x, a, d]);
        self.neighbors.push([t, n_ad, o]);
        self.fixed.push([false, f_ad, false]);
        self.relink(n_bc, c, p);
        self.relink(n_ad, d, q);
    }
}

/// Cotangent of the angle between two vectors.
fn cotangent(a: DVec3, b: DVec3) -> f64 {
    a.dot(b) / a.cross(b).length().max(1e-300)
}
