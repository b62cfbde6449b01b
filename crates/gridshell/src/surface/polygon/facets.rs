//! A surface that is a triangle mesh and nothing more: each triangle stays as it is.

use crate::surface::carrier::chain::boundary_loops;
use crate::surface::{Carrier, Surface};
use glam::DVec3;
use std::f64::consts::PI;

impl Surface {
    /// The surface made of these manifold, consistently oriented triangles; without corners.
    pub fn from_facets(name: &str, points: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Surface {
        let patch = vec![0; triangles.len()];
        let carrier = Carrier::new(points, triangles, patch, Vec::new());
        let area = (0..carrier.triangles.len() as u32).map(|t| carrier.triangle_area(t)).sum();
        // No boundary turns by more than a half turn.
        let loops = boundary_loops(&carrier, PI, |_, _| None);
        Surface::bare(name.to_owned(), carrier, loops, area)
    }
}
