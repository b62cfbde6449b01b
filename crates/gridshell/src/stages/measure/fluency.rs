//! The angle fluency index of regular interior nodes (Eq. 28 to 30). Angles between members in space.

use crate::degree::REGULAR;
use crate::grid::Grid;
use crate::merit::delta;

/// Mean index over the regular interior nodes, degrees; 0 when there are none.
pub(super) fn mean_delta(grid: &Grid) -> f64 {
    let (mut sum, mut count) = (0.0, 0);
    for v in regular_interior(grid) {
        sum += delta(grid, v);
        count += 1;
    }
    if count == 0 { 0.0 } else { (sum / f64::from(count)).to_degrees() }
}

/// The interior nodes of degree 6.
pub(super) fn regular_interior(grid: &Grid) -> impl Iterator<Item = u32> + '_ {
    let mesh = &grid.mesh;
    mesh.vertices().filter(|&v| !mesh.is_boundary(v) && mesh.degree(v) == REGULAR as usize)
}
