//! Which nodes are supported.

use crate::error::{Error, Result};
use crate::grid::{Grid, Place};
use crate::surface::{Origin, Surface};
use glam::DVec3;

/// A support given by its point is the nearest node, if that is within this share of the mean member length.
const NEAR: f64 = 0.5;

/// Where a grid is held: all three displacements, no rotation.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Supports {
    /// At all nodes of the boundary.
    #[default]
    Boundary,
    /// At the corners of the boundary.
    Corners,
    /// At the nodes nearest to these points, metres in the surface's file.
    Points(Vec<DVec3>),
    /// Nowhere.
    None,
}

impl Supports {
    /// The supported nodes, ascending.
    ///
    /// # Errors
    /// [`Error::Option`] where corners are asked for and there are none, or no node is near a point.
    pub fn nodes(&self, grid: &Grid, surface: &Surface) -> Result<Vec<u32>> {
        let origin = surface.origin;
        let mut nodes = match self {
            Supports::None => Vec::new(),
            Supports::Boundary => {
                grid.mesh.vertices().filter(|&v| grid.mesh.is_boundary(v)).collect()
            }
            Supports::Corners => corners(grid, surface)?,
            Supports::Points(points) => points
                .iter()
                .map(|&p| nearest(grid, origin.local(p), origin))
                .collect::<Result<_>>()?,
        };
        nodes.sort_unstable();
        nodes.dedup();
        Ok(nodes)
    }
}

/// The nodes at corners; where places do not tell, those nearest to the corners of the surface's loops.
fn corners(grid: &Grid, surface: &Surface) -> Result<Vec<u32>> {
    let at_corner = |v: &u32| matches!(grid.places[*v as usize], Place::Corner(_));
    let known: Vec<u32> = grid.mesh.vertices().filter(at_corner).collect();
    if !known.is_empty() {
        return Ok(known);
    }
    let points = surface.loops.iter().flat_map(|l| {
        l.corners.iter().map(|&k| surface.carrier.points[l.vertices[k as usize] as usize])
    });
    let found: Vec<u32> =
        points.map(|p| nearest(grid, p, surface.origin)).collect::<Result<_>>()?;
    if found.is_empty() {
        return Err(Error::Option(
            "supports at corners: the boundary has no corner; give points in a file, or `boundary`"
                .into(),
        ));
    }
    Ok(found)
}

fn nearest(grid: &Grid, p: DVec3, origin: Origin) -> Result<u32> {
    let count = grid.mesh.edge_count().max(1) as f64;
    let mean = grid.mesh.edges().map(|(a, b)| grid.length(a, b)).sum::<f64>() / count;
    let apart = |v: &u32| grid.xyz[*v as usize].distance(p);
    let found = grid.mesh.vertices().min_by(|a, b| apart(a).total_cmp(&apart(b)));
    found.filter(|v| apart(v) <= NEAR * mean).ok_or_else(|| {
        Error::Option(format!(
            "no node is within half a member of the support at {}",
            origin.told(p)
        ))
    })
}
