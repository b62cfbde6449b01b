//! The triangular grid on a surface: topology, and where each node sits.

use crate::error::{Error, Result};
use crate::mesh::Mesh;
use crate::surface::{ChainPoint, Locator, Surface, SurfacePoint};
use glam::DVec3;

/// Where a node sits on the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// Free to slide on the surface.
    Interior(SurfacePoint),
    /// Free to slide along a boundary loop.
    Boundary(ChainPoint),
    /// Fixed at a corner of a boundary loop: `chain` is the loop and `s` the corner's arc length.
    Corner(ChainPoint),
}

/// A triangular grid on a design surface. Node `i` is vertex `i` of the mesh; none is missing.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Topology.
    pub mesh: Mesh,
    /// Place of each node.
    pub places: Vec<Place>,
    /// Position of each node in metres.
    pub xyz: Vec<DVec3>,
}

impl Grid {
    /// The grid of these nodes and panels (counter-clockwise seen from outside), each node with the place
    /// of `surface` nearest to it; positions stay as they are.
    ///
    /// # Errors
    /// [`Error::Surface`] when the panels are not a manifold, or the grid has a boundary and the surface
    /// has none.
    pub fn from_panels(xyz: Vec<DVec3>, panels: &[[u32; 3]], surface: &Surface) -> Result<Grid> {
        let mesh = Mesh::from_triangles(xyz.len(), panels)?;
        let locator = Locator::new(surface);
        let place = |(v, &x): (usize, &DVec3)| {
            if mesh.is_boundary(v as u32) {
                locator.nearest_on_loops(x).map(Place::Boundary)
            } else {
                locator.nearest(x).map(Place::Interior)
            }
        };
        let places =
            xyz.iter().enumerate().map(place).collect::<Option<Vec<_>>>().ok_or_else(|| {
                Error::Surface(
                    "the grid has a boundary but the surface has none: is it the right surface?"
                        .into(),
                )
            })?;
        Ok(Grid { mesh, places, xyz })
    }

    /// A grid that is its own surface: what can be measured when the design surface is not known.
    ///
    /// # Errors
    /// [`Error::Surface`] when the panels are not a manifold.
    pub fn alone(name: &str, xyz: Vec<DVec3>, panels: &[[u32; 3]]) -> Result<(Grid, Surface)> {
        // Checked before the surface is made, which trusts its triangles.
        Mesh::from_triangles(xyz.len(), panels)?;
        let surface = Surface::from_facets(name, xyz.clone(), panels.to_vec());
        let grid = Grid::from_panels(xyz, panels, &surface)?;
        Ok((grid, surface))
    }
}

impl Place {
    /// Whether it lies on a boundary loop.
    pub fn is_boundary(&self) -> bool {
        !matches!(self, Place::Interior(_))
    }

    /// The carrier point of this place.
    pub fn surface_point(&self, surface: &Surface) -> SurfacePoint {
        match self {
            Place::Interior(p) => *p,
            Place::Boundary(c) | Place::Corner(c) => {
                surface.loops[c.chain as usize].surface_point(c.s)
            }
        }
    }

    /// The exact position on the design surface.
    pub fn exact(&self, surface: &Surface) -> DVec3 {
        match self {
            Place::Interior(p) => surface.exact(p),
            Place::Boundary(c) | Place::Corner(c) => {
                surface.loops[c.chain as usize].exact(surface, c.s)
            }
        }
    }

    /// The position on the carrier.
    pub fn xyz(&self, surface: &Surface) -> DVec3 {
        match self {
            Place::Interior(p) => surface.carrier.xyz(p),
            Place::Boundary(c) | Place::Corner(c) => {
                surface.loops[c.chain as usize].xyz(&surface.carrier, c.s)
            }
        }
    }
}
