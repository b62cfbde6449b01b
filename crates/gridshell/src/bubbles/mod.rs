//! Bubbles on a surface: the points from which a grid is made.

pub mod neighbors;

use crate::surface::{ChainPoint, Surface, SurfacePoint};
use glam::DVec3;

/// Bubble centres: those on the loops (fixed while packing) and those inside.
#[derive(Clone, Debug, Default)]
pub struct Bubbles {
    /// Boundary bubbles, loop by loop, ascending along each; corners among them.
    pub boundary: Vec<ChainPoint>,
    /// Interior bubbles.
    pub interior: Vec<SurfacePoint>,
}

impl Bubbles {
    /// Number of bubbles.
    pub fn len(&self) -> usize {
        self.boundary.len() + self.interior.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Carrier points of all bubbles, boundary first.
    pub fn surface_points(&self, surface: &Surface) -> Vec<SurfacePoint> {
        let on_loops =
            self.boundary.iter().map(|c| surface.loops[c.chain as usize].surface_point(c.s));
        on_loops.chain(self.interior.iter().copied()).collect()
    }

    /// Centres of all bubbles on the carrier, metres, boundary first.
    pub fn xyz(&self, surface: &Surface) -> Vec<DVec3> {
        self.surface_points(surface).iter().map(|p| surface.carrier.xyz(p)).collect()
    }
}
