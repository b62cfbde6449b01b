//! Members: ends, length, local axis, twist, fold.

use super::PHASE;
use super::nodes::Nodes;
use crate::grid::{Grid, Place};
use crate::job::Job;
use crate::math::trig;
use crate::surface::Surface;
use glam::DVec3;

/// The members of a grid.
#[derive(Clone, Debug, Default)]
pub struct Members {
    /// The two nodes, the lower one first; ascending.
    pub ends: Vec<[u32; 2]>,
    /// Length, metres.
    pub length: Vec<f64>,
    /// Unit vector perpendicular to the member along the surface's outward normal: its local z axis.
    pub normal: Vec<DVec3>,
    /// Twist of the nodes: the angle between the surface normals at its two ends, seen along it from the first to
    /// the second, right-handed; degrees.
    pub twist_deg: Vec<f64>,
    /// Angle between the panels beside it: 0 is flat, positive where the surface is convex seen from outside;
    /// degrees. None on the boundary.
    pub fold_deg: Vec<Option<f64>>,
    /// Mean of how much the lines bend at its ends (delta of Eq. 28 and 29); None where no end is regular and
    /// inside. Degrees.
    pub bend_deg: Vec<Option<f64>>,
    /// Whether it lies on the boundary.
    pub boundary: Vec<bool>,
    /// Whether it is part of a crease or a guide.
    pub feature: Vec<bool>,
    /// Number of its length group, from 0 for the shortest.
    pub group: Vec<u32>,
}

impl Members {
    /// The members of `grid`, without groups and bends; of no use where the job is over.
    pub(super) fn new(grid: &Grid, surface: &Surface, job: &Job) -> Members {
        let mesh = &grid.mesh;
        let mut ends: Vec<[u32; 2]> = mesh.edges().map(|(a, b)| [a, b]).collect();
        ends.sort_unstable();
        let normals: Vec<DVec3> = grid.places.iter().map(|p: &Place| p.normal(surface)).collect();
        let mut members = Members { ends, ..Members::default() };
        for &[a, b] in members.ends.iter().take_while(|_| !job.is_over(PHASE)) {
            let along = grid.xyz[b as usize] - grid.xyz[a as usize];
            let x = along.normalize_or_zero();
            let at_ends = [a, b].map(|v| square_to(x, normals[v as usize]));
            members.length.push(along.length());
            members.normal.push(local_z(x, at_ends[0] + at_ends[1]));
            members.twist_deg.push(twist(x, at_ends).to_degrees());
            members.fold_deg.push(fold(grid, a, b).map(f64::to_degrees));
            members.boundary.push(mesh.is_boundary_edge(a, b));
            members.feature.push(mesh.is_feature_edge(a, b));
        }
        members
    }

    /// Take the bends of the members from those of their ends.
    pub(super) fn take_bend(&mut self, nodes: &Nodes) {
        let bend = |ends: &[u32; 2]| {
            let known: Vec<f64> = ends.iter().filter_map(|&v| nodes.bend_deg[v as usize]).collect();
            (!known.is_empty()).then(|| known.iter().sum::<f64>() / known.len() as f64)
        };
        self.bend_deg = self.ends.iter().map(bend).collect();
    }

    /// Index of the member between nodes `a` and `b`.
    pub fn between(&self, a: u32, b: u32) -> Option<usize> {
        self.ends.binary_search(&[a.min(b), a.max(b)]).ok()
    }
}

/// The part of `n` perpendicular to the unit vector `x`, of unit length; zero where nothing is left.
fn square_to(x: DVec3, n: DVec3) -> DVec3 {
    (n - x * n.dot(x)).normalize_or_zero()
}

/// `sum` made a unit vector perpendicular to `x`; where it cancels, whatever upright direction there is.
fn local_z(x: DVec3, sum: DVec3) -> DVec3 {
    let candidates = [sum, DVec3::Z, DVec3::X];
    let found = candidates.into_iter().map(|n| square_to(x, n)).find(|n| *n != DVec3::ZERO);
    found.unwrap_or(DVec3::Z)
}

/// Angle from the first vector to the second about `x`; all perpendicular to it. Radians.
fn twist(x: DVec3, [from, to]: [DVec3; 2]) -> f64 {
    trig::atan2(from.cross(to).dot(x), from.dot(to))
}

/// Angle between the normals of the panels on both sides, radians; positive where convex from outside.
fn fold(grid: &Grid, a: u32, b: u32) -> Option<f64> {
    let (left, right) = (grid.mesh.left(a, b)?, grid.mesh.right(a, b)?);
    let [pa, pb, pl, pr] = [a, b, left, right].map(|v| grid.xyz[v as usize]);
    let along = (pb - pa).normalize_or_zero();
    let on_left = along.cross(pl - pa);
    let on_right = (pr - pa).cross(along);
    Some(trig::atan2(on_left.cross(on_right).dot(along), on_left.dot(on_right)))
}
