//! Offset surfaces: a spline patch moved along its own normal, exactly.
//!
//! Its derivatives need the second ones of the basis: with n = du x dv and N = n / |n|, N' = (n' - N (N . n')) /
//! |n|. At a pole, where du x dv vanishes, the normal is taken a step inside.

use super::jet::Jet;
use super::nurbs::NurbsSurface;
use super::shape::Shape;
use glam::{DVec2, DVec3};

/// The step inside from a pole, over the width of the domain.
const INSIDE: f64 = 1e-6;
/// An offset closes where its basis does and its two sides are nearer than this share of its distance.
const CLOSED_SHARE: f64 = 1e-5;

/// A surface at a constant distance from another.
#[derive(Clone, Debug)]
pub struct OffsetSurface {
    basis: NurbsSurface,
    distance: f64,
    closed: [bool; 2],
}

impl OffsetSurface {
    /// The surface at `distance` (metres) from `basis` along its normal du x dv.
    pub fn new(basis: NurbsSurface, distance: f64) -> OffsetSurface {
        let mut surface = OffsetSurface { basis, distance, closed: [false; 2] };
        surface.closed = [surface.closes(0), surface.closes(1)];
        surface
    }

    /// What it is an offset of.
    pub fn basis(&self) -> &NurbsSurface {
        &self.basis
    }

    /// How far it is from its basis, along the normal du x dv.
    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// Whether it closes on itself in u and in v: its basis does, without a fold.
    pub fn closed(&self) -> [bool; 2] {
        self.closed
    }

    /// Position and first derivatives at `uv`.
    pub fn jet(&self, uv: DVec2) -> Jet {
        let here = self.basis.jet(uv);
        let mut at = self.basis.second(uv);
        if at.jet.normal() == DVec3::ZERO {
            at = self.basis.second(self.inside(uv));
        }
        let (du, dv) = (at.jet.du, at.jet.dv);
        let n = du.cross(dv);
        let length = n.length();
        if length == 0.0 {
            return here;
        }
        let normal = n / length;
        let [uu, uv_, vv] = at.bends;
        let turn = |slope: DVec3| (slope - normal * normal.dot(slope)) / length;
        let (nu, nv) = (turn(uu.cross(dv) + du.cross(uv_)), turn(uv_.cross(dv) + du.cross(vv)));
        Jet {
            point: here.point + normal * self.distance,
            du: here.du + nu * self.distance,
            dv: here.dv + nv * self.distance,
        }
    }

    /// A little towards the middle of the domain.
    fn inside(&self, uv: DVec2) -> DVec2 {
        let [[u0, u1], [v0, v1]] = self.basis.domain();
        let step = INSIDE * DVec2::new(u1 - u0, v1 - v0);
        uv.clamp(DVec2::new(u0, v0) + step, DVec2::new(u1, v1) - step)
    }

    fn closes(&self, k: usize) -> bool {
        if !self.basis.closed()[k] {
            return false;
        }
        let [a, b] = self.basis.domain()[k];
        let along = Shape::Nurbs(self.basis.clone()).lattice(1 - k);
        // Not at the ends themselves, where the parameter is wrapped.
        let h = 1e-9 * (b - a);
        along.iter().all(|&t| {
            let [p, q] = [a + h, b - h].map(|s| {
                let uv = if k == 0 { DVec2::new(s, t) } else { DVec2::new(t, s) };
                self.jet(uv).point
            });
            p.distance(q) <= CLOSED_SHARE * self.distance.abs()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::exact::nurbs::octant;

    #[test]
    fn offset_of_a_sphere_is_a_sphere_with_its_pole() {
        let s = OffsetSurface::new(octant(), 0.25);
        for (u, v) in [(0.0, 0.0), (0.3, 0.7), (1.0, 0.2), (0.4, 1.0), (1.0, 1.0)] {
            let j = s.jet(DVec2::new(u, v));
            assert!((j.point.length() - 1.25).abs() < 1e-12, "{u} {v} {}", j.point);
            assert!(j.point.dot(j.du).abs() < 1e-9 && j.point.dot(j.dv).abs() < 1e-9);
            let scaled = octant().jet(DVec2::new(u, v));
            // At the pole the normal turns as it does a step inside.
            let off = if v == 1.0 { 20.0 * INSIDE } else { 1e-9 };
            assert!(j.du.distance(scaled.du * 1.25) < off);
            assert!(j.dv.distance(scaled.dv * 1.25) < off, "{u} {v} {} {}", j.dv, scaled.dv * 1.25);
        }
        assert_eq!(Shape::Offset(Box::new(s)).poles().len(), 1);
    }

    #[test]
    fn inward_offset_turns_against_its_basis_past_the_centre() {
        let s = OffsetSurface::new(octant(), -1.5);
        let uv = DVec2::new(0.4, 0.3);
        assert!((s.jet(uv).point + octant().point(uv) * 0.5).length() < 1e-12);
        assert!(s.jet(uv).normal().dot(octant().jet(uv).normal()) > 0.0);
    }
}
