//! Panels: shape q (Eq. 25), area, least angle, and panels that are turned over.

use super::Shape;
use crate::grid::Grid;
use crate::math::trig;
use crate::merit;
use glam::DVec3;

pub(super) struct Panels {
    pub count: usize,
    pub shape: Shape,
    pub border_shape_mean: f64,
    /// Square metres.
    pub area: f64,
    /// Radians.
    pub min_angle: f64,
    pub folded: usize,
}

/// `normals`: unit normal of the surface at each node.
pub(super) fn measure(grid: &Grid, normals: &[DVec3]) -> Panels {
    let mut panels = Panels {
        count: 0,
        shape: Shape { mean: 0.0, min: 1.0 },
        border_shape_mean: 0.0,
        area: 0.0,
        min_angle: std::f64::consts::PI,
        folded: 0,
    };
    let mut at_border = 0;
    for t in grid.mesh.triangles() {
        let p = t.map(|v| grid.xyz[v as usize]);
        let q = merit::shape(p);
        panels.count += 1;
        panels.area += 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).length();
        panels.shape.mean += q;
        panels.shape.min = panels.shape.min.min(q);
        for k in 0..3 {
            let angle = trig::angle(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            panels.min_angle = panels.min_angle.min(angle);
        }
        if t.iter().any(|&v| grid.mesh.is_boundary(v)) {
            at_border += 1;
            panels.border_shape_mean += q;
        }
        panels.folded += usize::from(is_folded(grid, |v| normals[v as usize], t));
    }
    panels.shape.mean /= panels.count.max(1) as f64;
    panels.border_shape_mean =
        if at_border > 0 { panels.border_shape_mean / f64::from(at_border) } else { 1.0 };
    panels
}

/// Whether the panel faces against the surface, or lies folded over a neighbour though the surface does
/// not. Of two such neighbours only the one that agrees less with the surface counts. `normal` gives the surface's unit normal at a node.
pub fn is_folded(grid: &Grid, normal: impl Fn(u32) -> DVec3, t: [u32; 3]) -> bool {
    let surface_normal = |t: [u32; 3]| t.map(&normal).iter().sum::<DVec3>().normalize_or_zero();
    let (panel, surface) = (panel_normal(grid, t), surface_normal(t));
    let agreement = panel.dot(surface);
    if agreement < 0.0 {
        return true;
    }
    (0..3).any(|k| {
        let (a, b) = (t[k], t[(k + 1) % 3]);
        let Some(c) = grid.mesh.right(a, b) else { return false };
        if grid.mesh.is_feature_edge(a, b) {
            // There the surface itself may turn as sharply as it likes.
            return false;
        }
        let other = panel_normal(grid, [b, a, c]);
        let other_surface = surface_normal([b, a, c]);
        // Away from the shared edge: that may run along a crease, where the surface turns as well.
        let turns = normal(t[(k + 2) % 3]).dot(normal(c)) <= 0.0;
        panel.dot(other) < 0.0 && !turns && agreement < other.dot(other_surface)
    })
}

fn panel_normal(grid: &Grid, t: [u32; 3]) -> DVec3 {
    let p = t.map(|v| grid.xyz[v as usize]);
    (p[1] - p[0]).cross(p[2] - p[0]).normalize_or_zero()
}
