//! How far the facets of a mesh may lie off the smooth surface that they stand for.
//!
//! A mesh says nothing of what is between its vertices, but where neighbouring facets turn gently it stands for a smooth
//! surface, which bows away from each facet: from one of sides h, whose normals turn by a between its corners, by about
//! h a / 8. Where facets meet at a crease, or edges of the boundary at a corner, they are what they are.

use crate::math::trig;
use crate::surface::Surface;
use glam::DVec3;

/// Bows over side times turn: an eighth for an arc, a sixth for the middle of a triangle, a quarter where normals are
/// estimated on one side only or beside much smaller facets. Less would call even meshes uneven; more would see
/// symmetries that are none.
const SHARE: f64 = 0.25;

/// How far the smooth surface may be from each triangle and each segment of the loops, metres.
#[derive(Default)]
pub(super) struct Bows {
    triangles: Vec<f64>,
    loops: Vec<Vec<f64>>,
}

impl Bows {
    /// Those of a surface whose triangles are the facets; where they turn by more than `crease_angle`, and the boundary
    /// by more than `corner_angle`, there is none. No bow is told to be larger than `most`.
    pub fn of(surface: &Surface, crease_angle: f64, corner_angle: f64, most: f64) -> Bows {
        let carrier = &surface.carrier;
        let mut around = vec![Vec::new(); carrier.points.len()];
        for (t, corners) in carrier.triangles.iter().enumerate() {
            for &v in corners {
                around[v as usize].push(t as u32);
            }
        }
        let normals: Vec<DVec3> =
            (0..carrier.triangles.len() as u32).map(|t| carrier.face_normal(t)).collect();
        let bow = |t: u32| {
            let own = normals[t as usize];
            let corners = carrier.corners(t);
            // Of the facets round a corner, those that go on smoothly from this one.
            let normal = |v: u32| {
                let smooth = around[v as usize].iter().map(|&o| normals[o as usize]);
                smooth
                    .filter(|&n| trig::angle(n, own) <= crease_angle)
                    .sum::<DVec3>()
                    .normalize_or(own)
            };
            let at = carrier.triangles[t as usize].map(normal);
            let pairs = [[0, 1], [1, 2], [2, 0]];
            let side = pairs.map(|[a, b]| corners[a].distance(corners[b]));
            let turn = pairs.map(|[a, b]| trig::angle(at[a], at[b]));
            SHARE * largest(side) * largest(turn)
        };
        let triangles = (0..normals.len() as u32).map(|t| bow(t).min(most)).collect();
        let loops = surface.loops.iter().map(|chain| {
            let n = chain.vertices.len();
            let at = |k: usize| carrier.points[chain.vertices[k % n] as usize];
            let way = |k: usize| at(k + 1) - at(k);
            let turn = |k: usize| {
                let turn = trig::angle(way(k + n - 1), way(k));
                if turn <= corner_angle { turn } else { 0.0 }
            };
            let bow = |k: usize| SHARE * way(k).length() * turn(k).max(turn(k + 1));
            (0..n).map(|k| bow(k).min(most)).collect()
        });
        Bows { triangles, loops: loops.collect() }
    }

    /// That of a triangle.
    pub fn of_triangle(&self, t: u32) -> f64 {
        self.triangles.get(t as usize).copied().unwrap_or(0.0)
    }

    /// That of segment `k` of a loop.
    pub fn of_segment(&self, of: u32, k: usize) -> f64 {
        self.loops.get(of as usize).and_then(|l| l.get(k)).copied().unwrap_or(0.0)
    }

    /// The largest.
    pub fn largest(&self) -> f64 {
        self.triangles.iter().chain(self.loops.iter().flatten()).copied().fold(0.0, f64::max)
    }
}

fn largest(of: [f64; 3]) -> f64 {
    of.into_iter().fold(0.0, f64::max)
}
