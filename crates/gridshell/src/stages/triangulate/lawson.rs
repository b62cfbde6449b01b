//! Flips to an intrinsic Delaunay triangulation (Lawson), such that they end.
//!
//! In exact arithmetic every flip of an edge that is not Delaunay lowers the sum of all cotangents, that is of
//! (a^2 + b^2 + c^2) / 4A over the triangles (Rippa 1990; Bobenko & Springborn, *A discrete Laplace-Beltrami
//! operator for simplicial surfaces*, 2007), so no triangulation comes twice. Rounded lengths need not obey.
//! Here an edge is flipped only where that sum, as it is computed from the lengths that are kept, goes down:
//! then it never comes back to where it was, however the lengths were rounded.

use super::PHASE;
use super::intrinsic::{Intrinsic, Quad, area, planar};
use crate::job::Job;
use glam::DVec2;

/// The sum must go down by this share of the two triangles' part: more than adding them up can hide.
const LOWER: f64 = 1e-12;

/// Sine of what two opposite angles may exceed half a turn by: the diagonals of squares stay as they are,
/// however their corners were rounded.
const COCIRCULAR: f64 = 1e-9;

impl Intrinsic {
    /// Flip until every edge is Delaunay, with at most so many looks.
    pub fn make_delaunay(&mut self, looks: usize, job: &Job) {
        self.suspects = self.mesh.edges().collect();
        self.settle(self.work.looks + looks, job);
    }

    /// Flip suspects until there are none left, or this many looks have been taken.
    pub(super) fn settle(&mut self, most: usize, job: &Job) {
        while let Some((a, b)) = self.suspects.pop() {
            if !self.mesh.adjacent(a, b) {
                continue;
            }
            if self.work.looks >= most || job.is_over(PHASE) {
                self.work.cut_short = true;
                self.suspects.clear();
                return;
            }
            self.work.looks += 1;
            if let Some(across) = self.better(a, b)
                && self.flip(a, b, across)
            {
                self.commit();
            }
        }
    }

    /// Flip the edge if topology allows; the new edge gets this length.
    pub(super) fn flip(&mut self, a: u32, b: u32, across: f64) -> bool {
        let Ok((p, q)) = self.mesh.try_flip(a, b, &mut self.undo) else { return false };
        self.forget_length(a, b);
        self.set_length(p, q, across);
        self.suspects.extend([(a, p), (p, b), (b, q), (q, a)]);
        self.work.flips += 1;
        true
    }

    /// Length of the edge that should stand in the place of this one; None where this one is Delaunay, or as good.
    fn better(&self, a: u32, b: u32) -> Option<f64> {
        if self.mesh.is_feature_edge(a, b) {
            return None;
        }
        let quad = self.quad(a, b)?;
        if is_delaunay(&quad) {
            return None;
        }
        let (c, d, across) = (quad.left, quad.right, quad.across());
        if !self.fits([c, d, a], across) || !self.fits([d, c, b], across) {
            return None;
        }
        let before = cotangents(self.sides(a, b, c)) + cotangents(self.sides(b, a, d));
        let with = |p: u32| cotangents(planar([across, self.length(d, p), self.length(p, c)]));
        (with(a) + with(b) < before * (1.0 - LOWER)).then_some(across)
    }
}

/// Whether the diagonal is Delaunay: its two opposite angles sum to at most half a turn.
fn is_delaunay(quad: &Quad) -> bool {
    let (b, c, d) = (DVec2::new(quad.length, 0.0), quad.above, quad.below);
    // The sine of the sum of the two angles is negative when they exceed half a turn.
    let (u, v) = ((-c, b - c), (b - d, -d));
    let sine = u.0.perp_dot(u.1) * v.0.dot(v.1) + u.0.dot(u.1) * v.0.perp_dot(v.1);
    let scale =
        u.0.length_squared() * u.1.length_squared() * v.0.length_squared() * v.1.length_squared();
    sine >= -COCIRCULAR * scale.sqrt()
}

/// Sum of the cotangents of a triangle's angles.
fn cotangents(sides: [f64; 3]) -> f64 {
    let [a, b, c] = sides;
    (a * a + b * b + c * c) / (4.0 * area(sides))
}
