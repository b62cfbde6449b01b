//! How far the grid's lines are off a wanted direction.

use crate::grid::{Grid, Place};
use crate::math::trig;
use crate::surface::Surface;

/// Mean over the nodes inside of the angle between the direction there and the nearest member, degrees; None
/// without a wanted direction, or a node inside.
pub(super) fn deviation_deg(grid: &Grid, surface: &Surface) -> Option<f64> {
    let mesh = &grid.mesh;
    let (mut sum, mut count) = (0.0, 0.0);
    for v in mesh.vertices() {
        let Place::Interior(point) = &grid.places[v as usize] else { continue };
        let Some(wanted) = surface.direction_at(point) else { continue };
        let normal = surface.carrier.normal(point);
        let off = |&w: &u32| {
            let member = grid.xyz[w as usize] - grid.xyz[v as usize];
            let angle = trig::angle(member - normal * member.dot(normal), wanted);
            angle.min(std::f64::consts::PI - angle)
        };
        sum += mesh.ring(v).iter().map(off).fold(f64::INFINITY, f64::min);
        count += 1.0;
    }
    (count > 0.0).then(|| (sum / count).to_degrees())
}
