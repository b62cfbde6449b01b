//! How far the grid's lines are off a wanted direction.

use crate::grid::Grid;
use crate::merit::off_direction;
use crate::surface::Surface;

/// Mean over the nodes inside of the angle between the direction there and the nearest member, degrees; None
/// without a wanted direction, or a node inside.
pub(super) fn deviation_deg(grid: &Grid, surface: &Surface) -> Option<f64> {
    let inside = grid.mesh.vertices().filter(|&v| !grid.mesh.is_boundary(v));
    let (sum, count) = inside
        .filter_map(|v| off_direction(grid, surface, v))
        .fold((0.0, 0.0), |(sum, count), off| (sum + off, count + 1.0));
    (count > 0.0).then(|| f64::to_degrees(sum / count))
}
