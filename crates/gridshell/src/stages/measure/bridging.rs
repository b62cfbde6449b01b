//! Members that leap from one sheet of the surface to another.
//!
//! A member is no bridge when walking the surface below its chord leads from one end to the other. Where
//! that walk strays (at a concave border it leaves the surface), the verdict is a flood over the carrier
//! from one end, within the ellipsoid of all points on paths of at most chord + l0: if the other end is not
//! reached, no path that short exists.

use super::PHASE;
use crate::grid::Grid;
use crate::job::Job;
use crate::surface::carrier::NONE;
use crate::surface::{Surface, SurfacePoint};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// The walk has arrived when it ends within this share of l0.
const ARRIVED: f64 = 0.1;

/// Number of bridging members.
pub fn count(grid: &Grid, surface: &Surface, edge_length: f64) -> usize {
    members(grid, surface, edge_length, &Job::default()).len()
}

/// The members whose ends are further apart along the surface than straight by more than `edge_length`; too few where
/// the job is over, which the caller is to check.
pub fn members(grid: &Grid, surface: &Surface, edge_length: f64, job: &Job) -> Vec<(u32, u32)> {
    let points: Vec<_> = grid.places.iter().map(|p| p.surface_point(surface)).collect();
    let bridges = |a: u32, b: u32| {
        let edge_length = edge_length * grid.scale(surface, a, b);
        let (a, b) = (&points[a as usize], &points[b as usize]);
        !walk_arrives(surface, a, b, edge_length) && !flood_arrives(surface, a, b, edge_length)
    };
    let edges: Vec<(u32, u32)> = grid.mesh.edges().collect();
    let bridges = |&(a, b): &(u32, u32)| !job.is_over(PHASE) && bridges(a, b);
    edges.into_par_iter().filter(bridges).collect()
}

/// Walk below the quarter points of the chord.
fn walk_arrives(surface: &Surface, a: &SurfacePoint, b: &SurfacePoint, edge_length: f64) -> bool {
    let carrier = &surface.carrier;
    let (from, to) = (carrier.xyz(a), carrier.xyz(b));
    let mut p = *a;
    for quarter in 1..=4 {
        p = carrier.follow(&p, from.lerp(to, f64::from(quarter) / 4.0));
    }
    carrier.xyz(&p).distance(to) <= ARRIVED * edge_length
}

/// Flood the triangles that reach into the ellipsoid about the two ends.
fn flood_arrives(surface: &Surface, a: &SurfacePoint, b: &SurfacePoint, edge_length: f64) -> bool {
    let carrier = &surface.carrier;
    let (from, to) = (carrier.xyz(a), carrier.xyz(b));
    let longest = from.distance(to) + edge_length;
    let inside =
        |t: u32| carrier.corners(t).iter().any(|c| c.distance(from) + c.distance(to) <= longest);
    let mut seen = BTreeSet::from([a.triangle]);
    let mut front = vec![a.triangle];
    while let Some(t) = front.pop() {
        if t == b.triangle {
            return true;
        }
        for &next in &carrier.neighbors[t as usize] {
            if next != NONE && (inside(next) || next == b.triangle) && seen.insert(next) {
                front.push(next);
            }
        }
    }
    false
}
