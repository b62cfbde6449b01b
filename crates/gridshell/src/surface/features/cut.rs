//! Cutting a carrier: its triangles are split so that given points become vertices and given lines edges.
//!
//! On patches a vertex of the carrier that is nobody's may be moved to where one is needed, and new ones stand
//! on the exact surface. On a mesh nothing moves: the mesh is the surface.

use crate::error::{Error, Result};
use crate::math::digits::three;
use crate::surface::carrier::NONE;
use crate::surface::carrier::locate::nearest_in_triangle;
use crate::surface::carrier::track::{Track, Tracks};
use crate::surface::{Carrier, NEAREST, Shape, Surface, SurfacePoint};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// Points nearer than this, over l0, are one.
pub(in crate::surface) const SAME: f64 = 1e-6;
/// An anchor this near to a feature or the boundary, over l0, is meant to be on it.
const ON_LINE: f64 = NEAREST;
/// A point that takes more than this share of a triangle's corner moves that corner, where it may.
const AT_CORNER: f64 = 0.75;
/// A point that takes less than this share of a corner splits the edge opposite.
const AT_EDGE: f64 = 0.2;
/// As [`AT_EDGE`], on a mesh.
const ON_EDGE: f64 = 1e-9;
/// A triangle may turn by this much (cosine) when a corner moves.
const UPRIGHT: f64 = 0.5;

/// A carrier being cut. Its normals and gradients are stale until [`finish`](Cutter::finish).
pub(in crate::surface) struct Cutter<'a> {
    pub(in crate::surface) surface: &'a mut Surface,
    /// Wanted member length l0.
    pub(super) length: f64,
    /// One triangle at each vertex.
    at: Vec<u32>,
    /// Vertices on the boundary, model edges, guides and anchors: they stay.
    tied: Vec<bool>,
    shapes: Vec<Arc<Shape>>,
}

/// Where a vertex is to be: in this triangle, at these shares of its corners.
#[derive(Clone, Copy)]
pub(in crate::surface) struct Spot {
    pub(in crate::surface) triangle: u32,
    pub(in crate::surface) bary: [f64; 3],
    /// On the exact surface.
    pub(in crate::surface) xyz: DVec3,
    /// Parameters in the patch of the triangle, where it has one.
    pub(in crate::surface) uv: DVec2,
}

impl<'a> Cutter<'a> {
    pub(in crate::surface) fn new(surface: &'a mut Surface, length: f64) -> Cutter<'a> {
        let carrier = &surface.carrier;
        let mut at = vec![NONE; carrier.points.len()];
        let mut tied = vec![surface.shapes.is_empty(); carrier.points.len()];
        for (t, corners) in carrier.triangles.iter().enumerate() {
            for k in 0..3 {
                at[corners[k] as usize] = t as u32;
                let pole = carrier.uv.get(t).is_some_and(|uv| uv[k].is_nan());
                tied[corners[k] as usize] |= pole;
                if carrier.neighbors[t][k] == NONE {
                    tied[corners[k] as usize] = true;
                    tied[corners[(k + 1) % 3] as usize] = true;
                }
            }
        }
        for ((a, b), _) in surface.tracks.iter() {
            for v in [a, b] {
                // Vertices that no triangle uses have no number any more.
                if let Some(tied) = tied.get_mut(v as usize) {
                    *tied = true;
                }
            }
        }
        let shapes = surface.shapes.iter().map(|s| Arc::new(s.clone())).collect();
        Cutter { surface, length, at, tied, shapes }
    }

    /// Bring normals and gradients up to date.
    pub(in crate::surface) fn finish(self) {
        let Carrier { points, triangles, patch, uv, .. } =
            std::mem::take(&mut self.surface.carrier);
        self.surface.carrier = Carrier::new(points, triangles, patch, uv);
    }

    /// Make the point a fixed vertex: the vertex, and what is to be said of it.
    ///
    /// # Errors
    /// [`Error::Surface`] where it is farther than a member from the surface.
    pub(super) fn put_anchor(&mut self, i: usize, p: DVec3) -> Result<(u32, Option<String>)> {
        let origin = self.surface.origin;
        let told = || format!("anchor {} at {}", i + 1, origin.told(p));
        let vertex = self.put(p);
        let off = self.xyz(vertex).distance(p);
        if off.is_nan() || off > self.length {
            return Err(Error::Surface(format!(
                "{} is {off:.3} m off the surface, farther than a member is long: give a point on it",
                told()
            )));
        }
        let note = (off > SAME * self.length).then(|| {
            format!("{} is {} m off the surface and was moved onto it", told(), three(off))
        });
        Ok((vertex, note))
    }

    /// The vertex nearest to `p` on the surface, made where there is none; it stays from now on.
    pub(in crate::surface) fn put(&mut self, p: DVec3) -> u32 {
        let (t, bary) = self.locate(p);
        let corners = self.surface.carrier.triangles[t as usize];
        let near = |k: usize| self.xyz(corners[k]).distance(p) <= SAME * self.length;
        let vertex = if let Some(k) = (0..3).find(|&k| near(k)) {
            corners[k]
        } else if let Some(k) = self.line_near(t, p, ON_LINE) {
            self.put_on_line(t, k, p)
        } else {
            let spot = self.spot(t, bary, p);
            match self.surface.beyond(&SurfacePoint { triangle: t, bary }, spot.xyz) {
                // A patch goes on past its trims; the surface does not.
                Some(border) => self.put_on_line(border.triangle, border.edge, p),
                None => self.insert(&spot),
            }
        };
        self.tied[vertex as usize] = true;
        vertex
    }

    /// The edge of triangle `t` that is on the boundary or on a feature and nearest to `p`, if that is hardly
    /// farther from it, within this share of l0, than the surface.
    fn line_near(&self, t: u32, p: DVec3, share: f64) -> Option<usize> {
        let carrier = &self.surface.carrier;
        let is_line = |k: usize| {
            let corners = carrier.triangles[t as usize];
            let track = self.surface.tracks.get(corners[k], corners[(k + 1) % 3]);
            carrier.neighbors[t as usize][k] == NONE || track.is_some_and(|track| track.feature)
        };
        let distance = |k: usize| self.surface.foot_on_edge(t, k, p).1.distance(p);
        let lines = (0..3).filter(|&k| is_line(k)).map(|k| (distance(k), k));
        let (nearest, k) = lines.min_by(|x, y| x.0.total_cmp(&y.0))?;
        let bary = nearest_in_triangle(carrier.corners(t), p);
        let off = self.spot(t, bary, p).xyz.distance(p);
        (nearest <= off + share * self.length).then_some(k)
    }

    /// As [`insert`](Cutter::insert), but near a feature or the boundary the vertex is put on it.
    pub(super) fn insert_end(&mut self, spot: &Spot) -> u32 {
        match self.line_near(spot.triangle, spot.xyz, ON_LINE) {
            Some(k) => self.put_on_line(spot.triangle, k, spot.xyz),
            None => self.insert(spot),
        }
    }

    /// Split edge `k` of triangle `t` where it is nearest to `p`, or take its end.
    pub(super) fn put_on_line(&mut self, t: u32, k: usize, p: DVec3) -> u32 {
        let corners = self.surface.carrier.triangles[t as usize];
        let (f, xyz) = self.surface.foot_on_edge(t, k, p);
        for v in [corners[k], corners[(k + 1) % 3]] {
            if self.xyz(v).distance(xyz) <= SAME * self.length {
                return v;
            }
        }
        self.split_edge(t, k, f, xyz)
    }

    /// Nearest carrier point, by looking at every triangle.
    fn locate(&self, p: DVec3) -> (u32, [f64; 3]) {
        let carrier = &self.surface.carrier;
        let mut best = (f64::INFINITY, 0, [1.0, 0.0, 0.0]);
        for t in 0..carrier.triangles.len() as u32 {
            let c = carrier.corners(t);
            let (low, high) = (c[0].min(c[1]).min(c[2]), c[0].max(c[1]).max(c[2]));
            if p.clamp(low, high).distance_squared(p) >= best.0 {
                continue;
            }
            let b = nearest_in_triangle(c, p);
            let off = (c[0] * b[0] + c[1] * b[1] + c[2] * b[2]).distance_squared(p);
            if off < best.0 {
                best = (off, t, b);
            }
        }
        (best.1, best.2)
    }

    pub(in crate::surface) fn xyz(&self, v: u32) -> DVec3 {
        self.surface.carrier.points[v as usize]
    }

    pub(super) fn is_mesh(&self) -> bool {
        self.shapes.is_empty()
    }

    /// The patch of triangle `t`.
    pub(in crate::surface) fn shape(&self, t: u32) -> Option<&Arc<Shape>> {
        self.shapes.get(self.surface.carrier.patch[t as usize] as usize)
    }

    /// The place in triangle `t` at `bary`; on a patch the foot of `p` near it.
    pub(in crate::surface) fn spot(&self, t: u32, bary: [f64; 3], p: DVec3) -> Spot {
        let at = SurfacePoint { triangle: t, bary };
        let carrier = &self.surface.carrier;
        match self.shape(t) {
            Some(shape) => {
                let (uv, xyz) = shape.project(carrier.uv_at(&at), p);
                Spot { triangle: t, bary, xyz, uv }
            }
            None => Spot { triangle: t, bary, xyz: carrier.xyz(&at), uv: DVec2::ZERO },
        }
    }

    /// The triangles at `v`, counter-clockwise, each with the place of `v` in it.
    pub(in crate::surface) fn fan(&self, v: u32) -> Vec<(u32, usize)> {
        let carrier = &self.surface.carrier;
        let place = |t: u32| {
            let corners = carrier.triangles[t as usize];
            corners.iter().position(|&c| c == v).expect("a fan's triangles hold its vertex")
        };
        let mut start = self.at[v as usize];
        let first = start;
        // Clockwise to the boundary, or once round.
        loop {
            let before = carrier.neighbors[start as usize][place(start)];
            if before == NONE || before == first {
                break;
            }
            start = before;
        }
        let mut fan = Vec::new();
        let mut t = start;
        loop {
            let k = place(t);
            fan.push((t, k));
            t = carrier.neighbors[t as usize][(k + 2) % 3];
            if t == NONE || t == start {
                return fan;
            }
        }
    }

    /// A vertex at this spot: one that is there, one moved there, or a new one. Nothing tied moves.
    pub(super) fn insert(&mut self, spot: &Spot) -> u32 {
        let t = spot.triangle;
        let corners = self.surface.carrier.triangles[t as usize];
        if let Some(&v) =
            corners.iter().find(|&&v| self.xyz(v).distance(spot.xyz) <= SAME * self.length)
        {
            return v;
        }
        if let Some(k) = self.line_near(t, spot.xyz, SAME) {
            return self.put_on_line(t, k, spot.xyz);
        }
        let (largest, smallest) = extremes(spot.bary);
        if spot.bary[largest] > AT_CORNER && self.move_vertex(corners[largest], spot) {
            return corners[largest];
        }
        let k = (smallest + 1) % 3;
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        let on_edge = if self.is_mesh() { ON_EDGE } else { AT_EDGE };
        let open = self.surface.carrier.neighbors[t as usize][k] == NONE;
        let tracked = self.surface.tracks.get(a, b).is_some() || open;
        let share = spot.bary[(k + 1) % 3] / (spot.bary[k] + spot.bary[(k + 1) % 3]);
        if spot.bary[smallest] < on_edge && !tracked && self.edge_bends(t, k, spot.xyz) {
            return self.split_edge(t, k, share, spot.xyz);
        }
        self.split_triangle(spot)
    }

    /// Whether the triangles on both sides of edge `k` of `t` stay upright when it runs by way of `xyz`.
    fn edge_bends(&self, t: u32, k: usize, xyz: DVec3) -> bool {
        let carrier = &self.surface.carrier;
        if self.is_mesh() {
            return true;
        }
        let u = carrier.neighbors[t as usize][k];
        let corners = carrier.triangles[t as usize];
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        let over = carrier.triangles[u as usize];
        [(t, corners), (u, over)].into_iter().all(|(t, corners)| {
            let normal = carrier.face_normal(t);
            let apex = corners.into_iter().find(|&v| v != a && v != b).expect("a third corner");
            [(apex, a), (apex, b)].into_iter().all(|(p, q)| {
                // Which way round does not matter: compare with the same way round of the whole edge.
                let (p, q) = (self.xyz(p), self.xyz(q));
                let other = if q == self.xyz(a) { self.xyz(b) } else { self.xyz(a) };
                let whole = (q - p).cross(other - p).normalize_or_zero();
                let part = (q - p).cross(xyz - p).normalize_or_zero();
                whole.dot(normal).abs() > UPRIGHT && whole.dot(part) > UPRIGHT
            })
        })
    }

    /// Move a vertex to the spot, if it is nobody's and its triangles stay upright.
    pub(in crate::surface) fn move_vertex(&mut self, v: u32, spot: &Spot) -> bool {
        if self.tied[v as usize] {
            return false;
        }
        let fan = self.fan(v);
        let carrier = &self.surface.carrier;
        let patch = carrier.patch[spot.triangle as usize];
        let upright = fan.iter().all(|&(t, k)| {
            let c = carrier.corners(t);
            let (a, b) = (c[(k + 1) % 3], c[(k + 2) % 3]);
            let normal = (a - spot.xyz).cross(b - spot.xyz).normalize_or_zero();
            let size = (a - spot.xyz).cross(b - spot.xyz).length();
            let before = (a - c[k]).cross(b - c[k]).length();
            carrier.patch[t as usize] == patch
                && normal.dot(carrier.face_normal(t)) > UPRIGHT
                && size > 0.1 * before
        });
        if !upright {
            return false;
        }
        let carrier = &mut self.surface.carrier;
        carrier.points[v as usize] = spot.xyz;
        for (t, k) in fan {
            carrier.uv[t as usize][k] = spot.uv;
        }
        true
    }

    /// Whether `v` stays where it is.
    pub(in crate::surface) fn is_tied(&self, v: u32) -> bool {
        self.tied[v as usize]
    }

    /// `v` stays where it is from now on.
    pub(in crate::surface) fn tie(&mut self, v: u32) {
        self.tied[v as usize] = true;
    }

    fn new_vertex(&mut self, xyz: DVec3, t: u32) -> u32 {
        self.surface.carrier.points.push(xyz);
        self.at.push(t);
        self.tied.push(true);
        self.at.len() as u32 - 1
    }

    /// A new triangle in the patch of `t`, to be filled in.
    fn new_triangle(&mut self, t: u32) -> u32 {
        let carrier = &mut self.surface.carrier;
        carrier.triangles.push([0; 3]);
        carrier.neighbors.push([NONE; 3]);
        carrier.patch.push(carrier.patch[t as usize]);
        if !carrier.uv.is_empty() {
            carrier.uv.push([DVec2::ZERO; 3]);
        }
        carrier.triangles.len() as u32 - 1
    }

    fn set(&mut self, t: u32, corners: [Corner; 3], neighbors: [u32; 3]) {
        let carrier = &mut self.surface.carrier;
        carrier.triangles[t as usize] = corners.map(|c| c.vertex);
        carrier.neighbors[t as usize] = neighbors;
        if let Some(uv) = carrier.uv.get_mut(t as usize) {
            *uv = corners.map(|c| c.uv);
        }
        for c in corners {
            self.at[c.vertex as usize] = t;
        }
    }

    fn corner(&self, t: u32, k: usize) -> Corner {
        let carrier = &self.surface.carrier;
        let uv = carrier.uv.get(t as usize).map_or(DVec2::ZERO, |uv| uv[k]);
        Corner { vertex: carrier.triangles[t as usize][k], uv }
    }

    /// Tell the neighbour `n` that it now borders on `new` instead of `old`.
    fn rewire(&mut self, n: u32, old: u32, new: u32) {
        if n != NONE {
            for x in &mut self.surface.carrier.neighbors[n as usize] {
                if *x == old {
                    *x = new;
                }
            }
        }
    }

    /// Split a triangle into three at the spot.
    fn split_triangle(&mut self, spot: &Spot) -> u32 {
        let t = spot.triangle;
        let m = Corner { vertex: self.new_vertex(spot.xyz, t), uv: spot.uv };
        let [a, b, c] = [0, 1, 2].map(|k| self.corner(t, k));
        let [ab, bc, ca] = self.surface.carrier.neighbors[t as usize];
        let (second, third) = (self.new_triangle(t), self.new_triangle(t));
        self.set(t, [a, b, m], [ab, second, third]);
        self.set(second, [b, c, m], [bc, third, t]);
        self.set(third, [c, a, m], [ca, t, second]);
        self.rewire(bc, t, second);
        self.rewire(ca, t, third);
        m.vertex
    }

    /// Split edge `k` of triangle `t` at this share of it by a vertex at `xyz`; what lies on the edge is split
    /// with it.
    ///
    /// ```text
    ///      c             c
    ///     / \           /|\
    ///    a---b   ->    a-m-b
    ///     \ /           \|/
    ///      d             d
    /// ```
    pub(in crate::surface) fn split_edge(
        &mut self,
        t: u32,
        k: usize,
        share: f64,
        xyz: DVec3,
    ) -> u32 {
        let vertex = self.new_vertex(xyz, t);
        let [a, b, c] = [k, (k + 1) % 3, (k + 2) % 3].map(|k| self.corner(t, k));
        let u = self.surface.carrier.neighbors[t as usize][k];
        self.split_track(a.vertex, b.vertex, vertex, share, xyz);
        let m = Corner { vertex, uv: self.uv_on_edge(t, k, share, xyz) };
        let [_, bc, ca] =
            [k, (k + 1) % 3, (k + 2) % 3].map(|k| self.surface.carrier.neighbors[t as usize][k]);
        let second = self.new_triangle(t);
        if u == NONE {
            self.set(t, [a, m, c], [NONE, second, ca]);
            self.set(second, [m, b, c], [NONE, bc, t]);
            self.rewire(bc, t, second);
            return vertex;
        }
        let over = self.surface.carrier.triangles[u as usize];
        let k = over.iter().position(|&v| v == b.vertex).expect("neighbours share an edge");
        let [b2, a2, d] = [k, (k + 1) % 3, (k + 2) % 3].map(|k| self.corner(u, k));
        let n = Corner { vertex, uv: self.uv_on_edge(u, k, 1.0 - share, xyz) };
        let [_, ad, db] =
            [k, (k + 1) % 3, (k + 2) % 3].map(|k| self.surface.carrier.neighbors[u as usize][k]);
        let fourth = self.new_triangle(u);
        self.set(t, [a, m, c], [u, second, ca]);
        self.set(second, [m, b, c], [fourth, bc, t]);
        self.set(u, [n, a2, d], [t, ad, fourth]);
        self.set(fourth, [b2, n, d], [second, u, db]);
        self.rewire(bc, t, second);
        self.rewire(db, u, fourth);
        vertex
    }

    /// Parameters of a point on edge `k` of triangle `t`, in its patch.
    fn uv_on_edge(&self, t: u32, k: usize, share: f64, xyz: DVec3) -> DVec2 {
        let Some(shape) = self.shape(t) else { return DVec2::ZERO };
        let mut bary = [0.0; 3];
        bary[k] = 1.0 - share;
        bary[(k + 1) % 3] = share;
        let near = self.surface.carrier.uv_at(&SurfacePoint { triangle: t, bary });
        shape.project(near, xyz).0
    }

    fn split_track(&mut self, a: u32, b: u32, m: u32, share: f64, xyz: DVec3) {
        let curves = &self.surface.curves;
        let tracks: &mut Tracks = &mut self.surface.tracks;
        let Some(track) = tracks.get(a, b) else { return };
        let [t0, t1] = track.t;
        let mut middle = t0 + (t1 - t0) * share;
        if let Some(curve) = curves.get(track.curve as usize) {
            middle = curve.project(middle, [t0.min(t1), t0.max(t1)], xyz).0;
        }
        tracks.lift(a, b);
        tracks.lay(a, m, Track { t: [t0, middle], ..track });
        tracks.lay(m, b, Track { t: [middle, t1], ..track });
    }
}

/// A corner of a triangle with its parameters there.
#[derive(Clone, Copy)]
struct Corner {
    vertex: u32,
    uv: DVec2,
}

/// Places of the largest and the smallest share.
fn extremes(bary: [f64; 3]) -> (usize, usize) {
    let (mut largest, mut smallest) = (0, 0);
    for k in 1..3 {
        if bary[k] > bary[largest] {
            largest = k;
        }
        if bary[k] < bary[smallest] {
            smallest = k;
        }
    }
    (largest, smallest)
}
