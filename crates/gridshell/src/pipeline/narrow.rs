//! Places where the surface is narrower than a member: short loops, and members across a neck.

use crate::error::{Error, Result};
use crate::grid::Grid;
use crate::surface::{Chain, NEAREST, Ruler, Surface};
use crate::validity::metres;
use glam::DVec3;

/// Shorter than this share of l0, a member across is forced by the surface.
const SHORT: f64 = 0.7;
/// Places nearer to one another than this many l0 are told once.
const APART: f64 = 3.0;
/// More places than this are only counted.
const MOST: usize = 8;

/// Refuse a surface that is a strip so narrow, by its area and border, that all nodes across it would be at nearly one
/// place: as often as not one number in its file is wrong.
///
/// # Errors
/// [`Error::NoGrid`] with how wide it is.
pub fn check(surface: &Surface, length: f64) -> Result<()> {
    let border: f64 = surface.loops.iter().map(Chain::length).sum();
    let width = 2.0 * surface.area / border;
    // Where lengths vary, the shortest may still fit.
    let shortest = length * surface.scale.iter().copied().fold(1.0, f64::min);
    let Some(first) = surface.loops.first().filter(|_| width < NEAREST * shortest) else {
        return Ok(());
    };
    let at = surface.origin.world(first.exact(surface, 0.0)).to_array();
    let message = format!(
        "the surface is a strip about {} wide, far narrower than members of {}: check its unit and coordinates",
        metres(width),
        metres(length)
    );
    Err(Error::NoGrid { at, message, edge_length: width })
}

/// A warning for each place of `grid` where the surface has no room for members of `length` metres.
pub fn warnings(surface: &Surface, grid: &Grid, length: f64) -> Vec<String> {
    let places =
        thinned(short_loops(surface, length).chain(necks(surface, grid, length)), APART * length);
    let mut warnings: Vec<String> = places
        .iter()
        .take(MOST)
        .map(|p| {
            format!(
                "near {} the surface is narrower than a member: expect short ones there",
                surface.origin.told(*p)
            )
        })
        .collect();
    if places.len() > MOST {
        warnings.push(format!("and narrower than a member at {} more places", places.len() - MOST));
    }
    warnings
}

/// Loops that are too short for three members: where each begins.
fn short_loops(surface: &Surface, length: f64) -> impl Iterator<Item = DVec3> + '_ {
    let short =
        surface.loops.iter().filter(move |l| Ruler::new(surface, l).whole() < 3.0 * SHORT * length);
    short.map(|l| l.exact(surface, 0.0))
}

/// Short members from boundary to boundary through the inside: where the middle of each is.
fn necks<'a>(
    surface: &'a Surface,
    grid: &'a Grid,
    length: f64,
) -> impl Iterator<Item = DVec3> + 'a {
    let inside = |v: u32| !grid.mesh.is_boundary(v);
    let across = move |&(a, b): &(u32, u32)| {
        let through = !inside(a) && !inside(b) && !grid.mesh.is_boundary_edge(a, b);
        through && grid.length(a, b) < SHORT * length * grid.scale(surface, a, b)
    };
    let middle = |(a, b): (u32, u32)| grid.xyz[a as usize].midpoint(grid.xyz[b as usize]);
    grid.mesh.edges().filter(across).map(middle)
}

/// The points without those near an earlier one.
fn thinned(points: impl Iterator<Item = DVec3>, apart: f64) -> Vec<DVec3> {
    let mut kept: Vec<DVec3> = Vec::new();
    for p in points {
        if kept.iter().all(|q| q.distance(p) > apart) {
            kept.push(p);
        }
    }
    kept
}
