//! A wanted direction of members: a field of unit vectors on the carrier's vertices, in its tangent planes.

use super::chart::Chart;
use crate::math::blend::Blend;
use crate::math::trig::{atan2, cos, sin};
use crate::surface::{Carrier, Surface, SurfacePoint};
use glam::{DVec2, DVec3};

/// Places along a boundary stretch from which its direction spreads inwards.
const LOOKS: usize = 48;
/// A direction whose part along the surface is shorter than this share says nothing there.
const LEAST_SHARE: f64 = 1e-3;

/// Loop, arc length where it starts, length, distance of its ends.
type Stretch = (usize, f64, f64, f64);

impl Surface {
    /// Wanted direction at a point, of unit length; None where there is none.
    pub fn direction_at(&self, p: &SurfacePoint) -> Option<DVec3> {
        if self.direction.is_empty() {
            return None;
        }
        let corners = self.carrier.triangles[p.triangle as usize];
        let sum: DVec3 = (0..3).map(|k| self.direction[corners[k] as usize] * p.bary[k]).sum();
        sum.try_normalize()
    }

    /// Want members along these vectors, as far as they lie along the surface; one for each carrier vertex.
    pub fn direct(&mut self, along: impl Fn(DVec3) -> DVec3) {
        let carrier = &self.carrier;
        let tangential = |(&p, &n): (&DVec3, &DVec3)| {
            let v = along(p);
            let t = v - n * v.dot(n);
            if t.length() > LEAST_SHARE * v.length() { t.normalize_or_zero() } else { DVec3::ZERO }
        };
        self.direction = carrier.points.iter().zip(&carrier.normals).map(tangential).collect();
    }

    /// Want members along the longest stretch of the boundary between two corners, by the distance of its ends: a
    /// round hole leads nowhere. Without corners, along the longest loop; does nothing on a closed surface.
    pub fn direct_along_boundary(&mut self) {
        let mut stretches = Vec::new();
        for (c, chain) in self.loops.iter().enumerate() {
            let cuts: Vec<f64> = chain.corners.iter().map(|&k| chain.arc[k as usize]).collect();
            let first = cuts.first().copied().unwrap_or(0.0);
            for i in 0..cuts.len().max(1) {
                let start = cuts.get(i).copied().unwrap_or(0.0);
                let end = cuts.get(i + 1).copied().unwrap_or(first + chain.length());
                let ends = [start, end].map(|s| chain.xyz(&self.carrier, s));
                stretches.push((c, start, end - start, ends[0].distance(ends[1])));
            }
        }
        // Of equals the first.
        let longer = |a: &Stretch, b: &Stretch| a.3.total_cmp(&b.3).then(a.2.total_cmp(&b.2));
        let Some((c, start, length, _)) = stretches.into_iter().rev().max_by(longer) else {
            return;
        };
        let chain = &self.loops[c];
        let look = |k: usize| {
            let s = chain.wrap(start + length * (k as f64 + 0.5) / LOOKS as f64);
            (chain.xyz(&self.carrier, s), chain.tangent(&self.carrier, s))
        };
        let blend = Blend::through(&(0..LOOKS).map(look).collect::<Vec<_>>());
        self.direct(|p| blend.at(p));
    }

    /// Want members along a blend of vectors at points (x, y, z, dx, dy, dz).
    pub fn direct_by_points(&mut self, points: &[[f64; 6]]) {
        let mut given: Vec<(DVec3, DVec3)> = Vec::with_capacity(points.len());
        for &[x, y, z, dx, dy, dz] in points {
            let (p, mut d) = (DVec3::new(x, y, z), DVec3::new(dx, dy, dz).normalize_or_zero());
            // A line has no sense: take the one that agrees with the nearest point before.
            let near = given
                .iter()
                .min_by(|a, b| a.0.distance_squared(p).total_cmp(&b.0.distance_squared(p)));
            if near.is_some_and(|n| n.1.dot(d) < 0.0) {
                d = -d;
            }
            given.push((p, d));
        }
        let blend = Blend::through(&given);
        self.direct(|p| blend.at(p));
    }
}

impl Chart {
    /// Angle in the plane of the lattice that agrees best with the surface's wanted direction, by area; None where
    /// none is wanted, or it turns so much that no lattice agrees better than another.
    pub fn wanted_angle(&self, surface: &Surface) -> Option<f64> {
        if surface.direction.is_empty() {
            return None;
        }
        let carrier = &surface.carrier;
        let (mut sum, mut whole) = (DVec2::ZERO, 0.0);
        for t in 0..carrier.triangles.len() {
            let area = carrier.triangle_area(t as u32);
            whole += area;
            let middle = SurfacePoint { triangle: t as u32, bary: [1.0 / 3.0; 3] };
            let Some(d) = surface.direction_at(&middle) else { continue };
            let d = self.carry(carrier, t, d);
            let angle = 6.0 * atan2(d.y, d.x);
            sum += DVec2::new(cos(angle), sin(angle)) * area;
        }
        (sum.length() > 1e-6 * whole).then(|| atan2(sum.y, sum.x) / 6.0)
    }

    /// A vector along triangle `t` as it lies in the plane.
    fn carry(&self, carrier: &Carrier, t: usize, d: DVec3) -> DVec2 {
        let [p, q, r] = carrier.corners(t as u32);
        let (u, v) = (q - p, r - p);
        // d = a u + b v in the triangle's plane.
        let (uu, uv, vv) = (u.dot(u), u.dot(v), v.dot(v));
        let (du, dv) = (d.dot(u), d.dot(v));
        let whole = uu * vv - uv * uv;
        let (a, b) = ((du * vv - dv * uv) / whole, (dv * uu - du * uv) / whole);
        let [p, q, r] = self.corners(carrier, t);
        let carried = (q - p) * a + (r - p) * b;
        if carried.is_finite() { carried } else { DVec2::ZERO }
    }
}
