//! Nodes: place, normal, degree, angles, kinds.

use super::PHASE;
use super::group::{groups_of, groups_within, turned_to_least};
use crate::degree::{REGULAR, adjusted_degree};
use crate::grid::{Grid, Place};
use crate::job::Job;
use crate::math::trig;
use crate::merit;
use crate::surface::Surface;
use glam::DVec3;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The nodes of a grid.
#[derive(Clone, Debug, Default)]
pub struct Nodes {
    /// Position, metres.
    pub xyz: Vec<DVec3>,
    /// Unit normal of the surface, outwards.
    pub normal: Vec<DVec3>,
    /// Number of members.
    pub degree: Vec<u32>,
    /// Degree plus virtual degree, Eq. 11: 6 is regular.
    pub adjusted_degree: Vec<i32>,
    /// Whether it lies on the boundary.
    pub boundary: Vec<bool>,
    /// Least and greatest angle between neighbouring members, degrees.
    pub angles_deg: Vec<[f64; 2]>,
    /// How much lines bend here, delta of Eq. 28 and 29, degrees; of regular nodes inside only.
    pub bend_deg: Vec<Option<f64>>,
    /// How much of that the surface's curvature alone makes, degrees.
    pub curvature_bend_deg: Vec<Option<f64>>,
    /// Angle defect: a full turn (half a turn on the boundary) less the angles of the panels, degrees. Inside it is
    /// the Gauss curvature gathered at the node.
    pub defect_deg: Vec<f64>,
    /// Distance to the exact surface, metres.
    pub off_surface: Vec<f64>,
    /// Number of its group, as they appear: nodes of one group have members in the same directions.
    pub group: Vec<u32>,
}

impl Nodes {
    /// The nodes of `grid`, alike where angles differ by at most `tolerance_deg`; of no use where the job is over.
    pub(super) fn new(grid: &Grid, surface: &Surface, tolerance_deg: f64, job: &Job) -> Nodes {
        let mesh = &grid.mesh;
        let normal: Vec<DVec3> = grid.places.iter().map(|p| p.normal(surface)).collect();
        let mut nodes = Nodes { xyz: grid.xyz.clone(), ..Nodes::default() };
        for v in 0..grid.xyz.len() as u32 {
            let boundary = mesh.is_boundary(v);
            let at = grid.xyz[v as usize];
            let angle = |(a, b): (u32, u32)| {
                trig::angle(grid.xyz[a as usize] - at, grid.xyz[b as usize] - at)
            };
            let angles: Vec<f64> = mesh.fan(v).map(angle).collect();
            let adjusted = adjusted_degree(mesh, &grid.xyz, v);
            let smooth = !boundary && mesh.degree(v) == REGULAR as usize;
            nodes.degree.push(mesh.degree(v) as u32);
            nodes.adjusted_degree.push(adjusted);
            nodes.boundary.push(boundary);
            nodes.angles_deg.push([
                angles.iter().copied().fold(PI, f64::min).to_degrees(),
                angles.iter().copied().fold(0.0, f64::max).to_degrees(),
            ]);
            nodes.bend_deg.push(smooth.then(|| merit::delta(grid, v).to_degrees()));
            nodes
                .curvature_bend_deg
                .push(smooth.then(|| curvature_bend(grid, &normal, v).to_degrees()));
            let whole = if boundary { PI } else { TAU };
            nodes.defect_deg.push((whole - angles.iter().sum::<f64>()).to_degrees());
        }
        nodes.normal = normal;
        let off = |(place, at): (&Place, &DVec3)| {
            if job.is_over(PHASE) { 0.0 } else { place.off_surface(surface, *at) }
        };
        nodes.off_surface = grid.places.par_iter().zip(&grid.xyz).map(off).collect();
        nodes.group = kinds(grid, &nodes.normal, tolerance_deg.to_radians());
        nodes
    }

    /// Whether the node's adjusted degree is not 6.
    pub fn is_irregular(&self, v: usize) -> bool {
        self.adjusted_degree[v] != REGULAR
    }
}

/// What delta cannot fall below at the regular node `v`, radians: how much the surface turns, per member, along each
/// of the three lines.
fn curvature_bend(grid: &Grid, normals: &[DVec3], v: u32) -> f64 {
    let ring = grid.mesh.ring(v);
    let turn = |j: u32, k: u32| {
        let along = (grid.xyz[j as usize] - grid.xyz[k as usize]).normalize_or_zero();
        (normals[j as usize] - normals[k as usize]).dot(along) / 2.0
    };
    let squares: f64 = (0..3).map(|j| turn(ring[j], ring[j + 3]).powi(2)).sum();
    (squares / 3.0).sqrt()
}

/// The groups of nodes whose members leave in the same directions: the angles from member to member seen along the
/// normal, and those between the members and the normal, are sorted into groups within `tolerance` each.
fn kinds(grid: &Grid, normals: &[DVec3], tolerance: f64) -> Vec<u32> {
    let mesh = &grid.mesh;
    let (mut turns, mut slopes) = (Vec::new(), Vec::new());
    for v in 0..grid.xyz.len() as u32 {
        let normal = normals[v as usize];
        let member = |w: u32| grid.xyz[w as usize] - grid.xyz[v as usize];
        let ring = mesh.ring(v);
        for (k, &w) in ring.iter().enumerate() {
            let next = member(ring[(k + 1) % ring.len()]);
            let flat = |m: DVec3| m - normal * m.dot(normal);
            let (from, to) = (flat(member(w)), flat(next));
            let turn = trig::atan2(from.cross(to).dot(normal), from.dot(to));
            turns.push(if turn < 0.0 { turn + TAU } else { turn });
            slopes.push(trig::angle(member(w), normal) - FRAC_PI_2);
        }
    }
    let (turns, slopes) = (groups_within(&turns, tolerance), groups_within(&slopes, tolerance));
    let mut from = 0;
    groups_of((0..grid.xyz.len() as u32).map(|v| {
        let to = from + mesh.degree(v);
        let pairs: Vec<(u32, u32)> = (from..to).map(|i| (turns[i], slopes[i])).collect();
        from = to;
        (mesh.is_boundary(v), turned_to_least(&pairs))
    }))
}
