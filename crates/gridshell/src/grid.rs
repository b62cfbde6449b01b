//! The triangular grid on a surface: topology, and where each node sits.

use crate::mesh::Mesh;
use crate::surface::{ChainPoint, Surface, SurfacePoint};
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

impl Place {
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
