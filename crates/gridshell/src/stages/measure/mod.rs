//! Measures of a grid (Section 7, Eq. 11 to 14 and 23 to 32), the floors of mu and delta, and what shows
//! a grid that looks fluent but is not the surface's: area, distances, bridging and folded parts.
//!
//! Lengths in metres, angles in degrees (as in the paper), deviations in units of the wanted edge length.
//! Everything here is one pass over nodes, members or panels.

mod bridging;
mod direction;
mod floors;
mod fluency;
mod members;
mod panels;
mod quality;

pub use bridging::count as bridging_members;
pub use panels::is_folded;
pub use quality::{Border, Degrees, EdgeLength, Irregular, IrregularNode, Lengths, Quality, Shape};

use crate::degree::{REGULAR, adjusted_degree, boundary_angle, virtual_degree, weight};
use crate::error::Result;
use crate::grid::{Grid, Place};
use crate::job::{Job, Picture};
use crate::recipe;
use crate::surface::Surface;
use glam::DVec3;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// What a stop in here is told as.
const PHASE: &str = "measuring";
/// Below this, the denominator of Q (Eq. 31) is rounding and the grid a perfect lattice.
const PERFECT: f64 = 1e-9;

/// Measure `grid` on `surface`, where members of `edge_length` metres were wanted.
pub fn measure(
    grid: &Grid,
    surface: &Surface,
    edge_length: f64,
    options: &recipe::Measure,
) -> Quality {
    looked_at(grid, surface, edge_length, options, &Job::default())
}

/// As [`measure`], as long as the job goes on.
///
/// # Errors
/// [`Error::Stopped`](crate::Error::Stopped) where it is over.
pub fn measure_within(
    grid: &Grid,
    surface: &Surface,
    edge_length: f64,
    options: &recipe::Measure,
    job: &Job,
) -> Result<Quality> {
    job.check(PHASE)?;
    job.progress("measure", 0.0, Picture::None);
    let quality = looked_at(grid, surface, edge_length, options, job);
    job.check(PHASE)?;
    Ok(quality)
}

/// The measures; of no use where the job is over.
fn looked_at(
    grid: &Grid,
    surface: &Surface,
    edge_length: f64,
    options: &recipe::Measure,
    job: &Job,
) -> Quality {
    let off = |distance: &(dyn Fn(&Place, DVec3) -> f64 + Sync)| {
        let places = grid.places.par_iter().zip(&grid.xyz);
        let places = places.take_any_while(|_| !job.is_over(PHASE));
        // The largest does not hang on the order.
        places.map(|(p, x)| distance(p, *x)).reduce(|| 0.0, f64::max) / edge_length
    };
    Quality {
        surface_deviation: off(&|place, xyz| place.off_surface(surface, xyz)),
        boundary_deviation: off(&|place, xyz| place.off_boundary(surface, xyz)),
        bridging_members: bridging::members(grid, surface, edge_length, job).len(),
        ..compare(grid, surface, edge_length, options)
    }
}

/// The members whose ends are further apart along the surface than straight by more than `edge_length`.
pub fn bridges(grid: &Grid, surface: &Surface, edge_length: f64) -> Vec<(u32, u32)> {
    bridging::members(grid, surface, edge_length, &Job::default())
}

/// As [`measure`], without what needs walks and projections on the surface: the two deviations and the
/// bridging members are left at zero. For comparing many candidates.
pub fn compare(
    grid: &Grid,
    surface: &Surface,
    edge_length: f64,
    options: &recipe::Measure,
) -> Quality {
    let normals: Vec<_> =
        grid.places.iter().map(|p| surface.carrier.normal(&p.surface_point(surface))).collect();
    let lambda = options.lambda;
    let nodes = count_nodes(grid, lambda);
    let members = members::measure(grid, surface);
    let panels = panels::measure(grid, &normals);
    let delta = fluency::mean_delta(grid);
    let mu = (nodes.residual / nodes.weighted).sqrt();
    let rho = lambda * nodes.interior_regular as f64 / nodes.weighted;
    let disorder = mu + rho * delta / 60.0;
    Quality {
        nodes: nodes.interior + nodes.boundary,
        members: members.count,
        panels: panels.count,
        interior_nodes: nodes.interior,
        boundary_nodes: nodes.boundary,
        euler_characteristic: grid.mesh.euler_characteristic(),
        min_length_ratio: members.length.min / edge_length,
        max_length_ratio: members.length.max / edge_length,
        edge_length: members.length,
        shape: panels.shape,
        irregular: nodes.irregular,
        degrees: nodes.degrees,
        mu,
        mu_floor: floors::mu(&grid.mesh, nodes.virtual_excess, lambda, nodes.weighted),
        delta_deg: delta,
        delta_floor_deg: floors::delta_deg(grid, &normals),
        rho,
        fluency: (disorder > PERFECT).then(|| 1.0 / disorder),
        area_ratio: panels.area / surface.area,
        lengths: if surface.scale.is_empty() { Lengths::AsBuilt } else { Lengths::OverLocal },
        direction_deviation_deg: direction::deviation_deg(grid, surface),
        surface_deviation: 0.0,
        boundary_deviation: 0.0,
        min_angle_deg: panels.min_angle.to_degrees(),
        bridging_members: 0,
        folded_panels: panels.folded,
        border: Border { shape_mean: panels.border_shape_mean, edge_length_cv: members.border_cv },
    }
}

/// The irregular nodes that remain, for the designer, in ascending order.
pub fn irregular_nodes(grid: &Grid) -> Vec<IrregularNode> {
    let mesh = &grid.mesh;
    mesh.vertices()
        .map(|v| IrregularNode {
            node: v,
            xyz: grid.xyz[v as usize].to_array(),
            degree: mesh.degree(v),
            adjusted_degree: adjusted_degree(mesh, &grid.xyz, v),
            boundary: mesh.is_boundary(v),
        })
        .filter(|n| n.adjusted_degree != REGULAR)
        .collect()
}

/// What one pass over the nodes gives.
struct Nodes {
    interior: usize,
    boundary: usize,
    interior_regular: usize,
    irregular: Irregular,
    degrees: Degrees,
    /// R of Eq. 14.
    residual: f64,
    /// n* of Eq. 26.
    weighted: f64,
    /// Sum of (virtual degree - 2) over the boundary.
    virtual_excess: i64,
}

fn count_nodes(grid: &Grid, lambda: f64) -> Nodes {
    let mesh = &grid.mesh;
    let mut nodes = Nodes {
        interior: 0,
        boundary: 0,
        interior_regular: 0,
        irregular: Irregular { interior: 0, boundary: 0 },
        degrees: Degrees { interior: BTreeMap::new(), boundary: BTreeMap::new() },
        residual: 0.0,
        weighted: 0.0,
        virtual_excess: 0,
    };
    for v in mesh.vertices() {
        let mut degree = mesh.degree(v) as i32;
        let gamma = weight(mesh, v, lambda);
        if mesh.is_boundary(v) {
            let extra = virtual_degree(boundary_angle(mesh, &grid.xyz, v));
            degree += extra;
            nodes.virtual_excess += i64::from(extra - 2);
            nodes.boundary += 1;
            nodes.irregular.boundary += usize::from(degree != REGULAR);
            *nodes.degrees.boundary.entry(degree).or_default() += 1;
        } else {
            nodes.interior += 1;
            nodes.interior_regular += usize::from(degree == REGULAR);
            nodes.irregular.interior += usize::from(degree != REGULAR);
            *nodes.degrees.interior.entry(degree).or_default() += 1;
        }
        nodes.residual += gamma * f64::from((degree - REGULAR).pow(2));
        nodes.weighted += gamma;
    }
    // Only a grid without any node that counts (lambda 0 or 1) has none: its residual is 0 too.
    nodes.weighted = nodes.weighted.max(f64::MIN_POSITIVE);
    nodes
}

#[cfg(test)]
mod tests;
