//! What mu and delta cannot fall below on a given surface.
//!
//! **Topology.** Over a triangulation, the sum of (6 - d) inside plus the sum of (4 - d) on the boundary is
//! 6 chi. With the virtual degrees v, the adjusted degrees therefore miss 6 by 6 chi - sum (v - 2) in all.
//!
//! **Curvature.** A line along the surface turns by the normal curvature times the member length at every
//! node, however straight it runs within the surface.

use super::fluency::regular_interior;
use crate::grid::Grid;
use crate::mesh::Mesh;
use glam::DVec3;

/// Least mu: every unavoidable irregular node sits where it weighs least, on the boundary if there is one.
pub(super) fn mu(mesh: &Mesh, virtual_excess: i64, lambda: f64, weighted_nodes: f64) -> f64 {
    let open = mesh.vertices().any(|v| mesh.is_boundary(v));
    let weight = if open { lambda.min(1.0 - lambda) } else { lambda };
    let missing = (6 * mesh.euler_characteristic() - virtual_excess).abs();
    (weight * missing as f64 / weighted_nodes).sqrt()
}

/// Mean over the regular interior nodes of what their delta cannot fall below, degrees. `normals` of the
/// surface at each node.
pub(super) fn delta_deg(grid: &Grid, normals: &[DVec3]) -> f64 {
    let (mut sum, mut count) = (0.0, 0);
    for v in regular_interior(grid) {
        let ring = grid.mesh.ring(v);
        let squares: f64 = (0..3).map(|j| turn(grid, normals, ring[j], ring[j + 3]).powi(2)).sum();
        sum += (squares / 3.0).sqrt();
        count += 1;
    }
    if count == 0 { 0.0 } else { (sum / f64::from(count)).to_degrees() }
}

/// How much the surface turns, per member, along the line from node `j` over its neighbour to node `k`;
/// radians (their sine, which is never the larger).
fn turn(grid: &Grid, normals: &[DVec3], j: u32, k: u32) -> f64 {
    let along = (grid.xyz[j as usize] - grid.xyz[k as usize]).normalize_or_zero();
    (normals[j as usize] - normals[k as usize]).dot(along) / 2.0
}
