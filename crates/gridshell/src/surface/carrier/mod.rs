//! What nodes walk on: the carrier, chains of its edges and lengths along them, the model edges and features that its
//! edges lie on, and where a point in space has its place on all this, beyond its border or in its box.
//!
//! The carrier: a fine manifold triangle mesh on which nodes walk.
//!
//! A point on the surface is a triangle and barycentric coordinates. Moving a point *traces* a straight
//! line over the triangles, unfolding each into the plane of the last, so a point never jumps to another
//! sheet however near it lies. Nearest points are only asked for where nothing is known yet.

mod beyond;
pub mod chain;
mod extent;
pub mod locate;
pub mod ruler;
pub(in crate::surface) mod track;

pub use chain::{Chain, ChainPoint};
pub use locate::Locator;
pub use ruler::Ruler;

use glam::{DVec2, DVec3};

/// No neighbour: the triangle's edge lies on the boundary.
pub const NONE: u32 = u32::MAX;

/// Share of a triangle's height below which a point is at its edge.
const AT_BOUNDARY: f64 = 0.05;

/// A fine, manifold, consistently oriented triangle mesh. Metres.
#[derive(Clone, Debug, Default)]
pub struct Carrier {
    /// Vertex positions; on the exact surface where there is one.
    pub points: Vec<DVec3>,
    /// Corners of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Triangle across the edge from corner k to corner k + 1, or [`NONE`].
    pub neighbors: Vec<[u32; 3]>,
    /// Unit normal of the surface at each vertex, outwards.
    pub normals: Vec<DVec3>,
    /// Patch of each triangle.
    pub patch: Vec<u32>,
    /// Patch parameters at the three corners of each triangle; empty where the input was a mesh. At a pole
    /// of the patch one parameter means nothing: it is NaN, and the other corners' count (see
    /// [`uv_at`](Carrier::uv_at)).
    pub uv: Vec<[DVec2; 3]>,
    /// Whether the edge from corner k to corner k + 1 of each triangle is part of a feature; empty without any.
    pub(super) walls: Vec<[bool; 3]>,
    /// Gradients of the three barycentric coordinates over each triangle, 1/m.
    gradients: Vec<[DVec3; 3]>,
}

/// A point on the carrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// Triangle index.
    pub triangle: u32,
    /// Barycentric coordinates, sum 1, each in [0, 1].
    pub bary: [f64; 3],
}

impl Carrier {
    /// A carrier from oriented triangles. `patch` and `uv` are per triangle; `uv` may be empty (a mesh).
    /// Adjacency, vertex normals (by angle) and gradients are worked out here.
    ///
    /// The triangles must be manifold and consistently oriented: readers see to that.
    pub fn new(
        points: Vec<DVec3>,
        triangles: Vec<[u32; 3]>,
        patch: Vec<u32>,
        uv: Vec<[DVec2; 3]>,
    ) -> Carrier {
        let neighbors = adjacency(&triangles);
        let gradients =
            triangles.iter().map(|t| gradients(t.map(|v| points[v as usize]))).collect();
        let mut normals = vec![DVec3::ZERO; points.len()];
        for t in &triangles {
            let p = t.map(|v| points[v as usize]);
            let n = (p[1] - p[0]).cross(p[2] - p[0]).normalize_or_zero();
            for k in 0..3 {
                let angle = crate::math::trig::angle(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
                normals[t[k] as usize] += n * angle;
            }
        }
        for n in &mut normals {
            *n = n.normalize_or_zero();
        }
        let walls = Vec::new();
        Carrier { points, triangles, neighbors, normals, patch, uv, walls, gradients }
    }

    /// Position of `p` on the carrier.
    pub fn xyz(&self, p: &SurfacePoint) -> DVec3 {
        let c = self.corners(p.triangle);
        c[0] * p.bary[0] + c[1] * p.bary[1] + c[2] * p.bary[2]
    }

    /// Patch parameters at `p`. Only where the input had patches.
    pub fn uv_at(&self, p: &SurfacePoint) -> DVec2 {
        let c = &self.uv[p.triangle as usize];
        let uv = c[0] * p.bary[0] + c[1] * p.bary[1] + c[2] * p.bary[2];
        if uv.is_finite() {
            return uv;
        }
        DVec2::new(
            mean_beside_pole(c.map(|c| c.x), p.bary),
            mean_beside_pole(c.map(|c| c.y), p.bary),
        )
    }

    /// Unit normal at `p`, interpolated from the vertices: continuous over the carrier.
    pub fn normal(&self, p: &SurfacePoint) -> DVec3 {
        let t = self.triangles[p.triangle as usize].map(|v| self.normals[v as usize]);
        (t[0] * p.bary[0] + t[1] * p.bary[1] + t[2] * p.bary[2]).normalize_or_zero()
    }

    /// Unit normal of triangle `t`.
    pub fn face_normal(&self, t: u32) -> DVec3 {
        let c = self.corners(t);
        (c[1] - c[0]).cross(c[2] - c[0]).normalize_or_zero()
    }

    /// Corner positions of triangle `t`.
    pub fn corners(&self, t: u32) -> [DVec3; 3] {
        self.triangles[t as usize].map(|v| self.points[v as usize])
    }

    /// Area of triangle `t` in square metres.
    pub fn triangle_area(&self, t: u32) -> f64 {
        let c = self.corners(t);
        0.5 * (c[1] - c[0]).cross(c[2] - c[0]).length()
    }

    /// Trace a straight line of `step`'s length from `from` over the surface, starting in the direction
    /// of `step` laid into the first triangle (its part along the normal counts for nothing). Stops at
    /// the boundary.
    pub fn trace(&self, from: &SurfacePoint, step: DVec3) -> SurfacePoint {
        self.walk(from, step, &[])
    }

    /// As [`trace`](Carrier::trace), but features are not crossed: they stop the line as the boundary does.
    pub fn trace_between_features(&self, from: &SurfacePoint, step: DVec3) -> SurfacePoint {
        self.walk(from, step, &self.walls)
    }

    fn walk(&self, from: &SurfacePoint, step: DVec3, walls: &[[bool; 3]]) -> SurfacePoint {
        let mut p = *from;
        let mut v = step;
        let mut entered: Option<usize> = None;
        // Far more crossings than any sensible step makes; only a guard against endless turning.
        for _ in 0..10_000 {
            let g = &self.gradients[p.triangle as usize];
            let rate = [g[0].dot(v), g[1].dot(v), g[2].dot(v)];
            // The corner whose coordinate first falls to zero: we leave across the edge opposite to it.
            let mut exit: Option<(f64, usize)> = None;
            for k in 0..3 {
                if Some(k) == entered || rate[k] >= 0.0 {
                    continue;
                }
                let time = p.bary[k] / -rate[k];
                if exit.is_none_or(|(best, _)| time < best) {
                    exit = Some((time, k));
                }
            }
            let Some((time, k)) = exit.filter(|&(time, _)| time < 1.0) else {
                for i in 0..3 {
                    p.bary[i] = (p.bary[i] + rate[i]).max(0.0);
                }
                return p.normalized();
            };
            for i in 0..3 {
                p.bary[i] = (p.bary[i] + rate[i] * time).max(0.0);
            }
            p.bary[k] = 0.0;
            v *= 1.0 - time;
            let p_n = p.normalized();
            let edge = (k + 1) % 3;
            if walls.get(p_n.triangle as usize).is_some_and(|walls| walls[edge]) {
                return p_n;
            }
            let Some((next, into, turned)) = self.cross(p_n.triangle, edge, v) else {
                return p_n;
            };
            // The edge runs the other way in the neighbour.
            let mut bary = [0.0; 3];
            bary[into] = p_n.bary[(edge + 1) % 3];
            bary[(into + 1) % 3] = p_n.bary[edge];
            p = SurfacePoint { triangle: next, bary };
            entered = Some((into + 2) % 3);
            v = turned;
        }
        p.normalized()
    }

    /// Whether `p` is at the boundary: in a triangle beside it, nearer than a twentieth of the triangle's height.
    pub fn is_at_boundary(&self, p: &SurfacePoint) -> bool {
        let t = p.triangle as usize;
        (0..3).any(|k| self.neighbors[t][k] == NONE && p.bary[(k + 2) % 3] < AT_BOUNDARY)
    }

    /// Cross `edge` of triangle `t`: the neighbour, its own number for that edge, and `v` unfolded into
    /// its plane. None on the boundary.
    fn cross(&self, t: u32, edge: usize, v: DVec3) -> Option<(u32, usize, DVec3)> {
        let next = self.neighbors[t as usize][edge];
        if next == NONE {
            return None;
        }
        let tri = &self.triangles[t as usize];
        let end = tri[(edge + 1) % 3];
        let into = self.triangles[next as usize].iter().position(|&c| c == end)?;
        let a = self.points[tri[edge] as usize];
        let along = (self.points[end as usize] - a).normalize_or_zero();
        // The gradient of the corner opposite an edge points inwards, perpendicular to the edge.
        let out = -self.gradients[t as usize][(edge + 2) % 3].normalize_or_zero();
        let inn = self.gradients[next as usize][(into + 2) % 3].normalize_or_zero();
        Some((next, into, along * v.dot(along) + inn * v.dot(out)))
    }

    /// Walk from `from` towards the foot of `target` on the surface nearby: repeated tracing along the
    /// tangential part of the difference. Never leaves the sheet. Used to follow a moving point; the
    /// difference should be small against the radius of curvature.
    pub fn follow(&self, from: &SurfacePoint, target: DVec3) -> SurfacePoint {
        let mut p = *from;
        for _ in 0..8 {
            let n = self.face_normal(p.triangle);
            let d = target - self.xyz(&p);
            let step = d - n * d.dot(n);
            let q = self.trace(&p, step);
            let done = q.triangle == p.triangle;
            p = q;
            if done {
                break;
            }
        }
        p
    }
}

impl SurfacePoint {
    fn normalized(mut self) -> Self {
        let sum = self.bary[0] + self.bary[1] + self.bary[2];
        for b in &mut self.bary {
            *b /= sum;
        }
        self
    }
}

/// Mean of the corners that have a value, weighted by their coordinates: along a ray from a pole the
/// parameter stays the same, so neighbouring triangles agree on their common edge.
fn mean_beside_pole(value: [f64; 3], bary: [f64; 3]) -> f64 {
    let (mut sum, mut weight) = (0.0, 0.0);
    for k in 0..3 {
        if !value[k].is_nan() {
            // At the pole itself any value will do.
            let b = bary[k].max(1e-300);
            sum += value[k] * b;
            weight += b;
        }
    }
    sum / weight
}

/// Gradients of the barycentric coordinates of a triangle; zero where it has no area.
fn gradients(p: [DVec3; 3]) -> [DVec3; 3] {
    let n = (p[1] - p[0]).cross(p[2] - p[0]);
    let nn = n.length_squared();
    if nn == 0.0 {
        return [DVec3::ZERO; 3];
    }
    [0, 1, 2].map(|k| n.cross(p[(k + 2) % 3] - p[(k + 1) % 3]) / nn)
}

/// Triangle across each edge, by sorting the edges.
pub(super) fn adjacency(triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut edges: Vec<(u32, u32, u32, u8)> = Vec::with_capacity(triangles.len() * 3);
    for (t, c) in triangles.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (c[k], c[(k + 1) % 3]);
            edges.push((a.min(b), a.max(b), t as u32, k as u8));
        }
    }
    edges.sort_unstable();
    let mut neighbors = vec![[NONE; 3]; triangles.len()];
    for w in edges.windows(2) {
        if (w[0].0, w[0].1) == (w[1].0, w[1].1) {
            neighbors[w[0].2 as usize][w[0].3 as usize] = w[1].2;
            neighbors[w[1].2 as usize][w[1].3 as usize] = w[0].2;
        }
    }
    neighbors
}
