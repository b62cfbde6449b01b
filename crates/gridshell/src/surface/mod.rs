//! The design surface: what every input becomes.
//!
//! A *carrier* (fine, manifold, oriented triangle mesh, for walking) with the exact trimmed patches
//! behind it, where the input had them. Boundary loops are [`Chain`]s of carrier vertices with the
//! exact curves behind them. Metres throughout.

pub mod brep;
pub mod builtin;
pub mod carrier;
pub mod chain;
pub mod chart;
pub mod curve;
mod ear;
pub mod facets;
pub mod locate;
pub mod model;
pub mod nurbs;
mod polygon;
pub mod shape;
mod size;

pub use brep::Brep;
pub use carrier::{Carrier, SurfacePoint};
pub use chain::{Chain, ChainPoint};
pub use curve::Curve;
pub use locate::Locator;
pub use model::{Model, PolygonMesh, Sampling};
pub use shape::Shape;

use glam::DVec3;

/// A design surface, ready to carry a grid.
pub struct Surface {
    /// Built-in name or file stem.
    pub name: String,
    /// Fine triangulation for walking.
    pub carrier: Carrier,
    /// Boundary loops, closed, surface to their left seen from outside.
    pub loops: Vec<Chain>,
    /// Exact geometry of each patch, indexed by `carrier.patch`; empty where the input was a mesh.
    pub shapes: Vec<Shape>,
    /// Exact edge curves, indexed by the chains' segments; empty where the input was a mesh.
    pub curves: Vec<Curve>,
    /// Area in square metres, integrated over the exact patches.
    pub area: f64,
}

impl Surface {
    /// V - E + F of the carrier.
    pub fn euler_characteristic(&self) -> i64 {
        let faces = self.carrier.triangles.len();
        let open = self.carrier.neighbors.iter().flatten().filter(|&&n| n == carrier::NONE).count();
        self.carrier.points.len() as i64 - ((3 * faces + open) / 2) as i64 + faces as i64
    }

    /// The exact point of the design surface that the carrier point stands for: the patch evaluated at
    /// the interpolated parameters. On a mesh, the carrier point itself.
    pub fn exact(&self, point: &SurfacePoint) -> DVec3 {
        let t = point.triangle as usize;
        match self.shapes.get(self.carrier.patch[t] as usize) {
            Some(shape) => shape.point(self.carrier.uv_at(point)),
            None => self.carrier.xyz(point),
        }
    }
}
