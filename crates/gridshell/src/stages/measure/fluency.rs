//! The angle fluency index of regular interior nodes (Eq. 28 to 30). Angles between members in space.

use crate::degree::REGULAR;
use crate::grid::Grid;
use crate::math::trig;
use std::f64::consts::PI;

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

/// `delta_i` of one regular interior node, radians.
pub(super) fn delta(grid: &Grid, v: u32) -> f64 {
    let at = grid.xyz[v as usize];
    let ring = grid.mesh.ring(v);
    let member = |j: usize| grid.xyz[ring[j % 6] as usize] - at;
    let beta = |j: usize| trig::angle(member(j), member(j + 1));
    let mut squares = 0.0;
    for j in 0..3 {
        let bend = trig::angle(member(j), member(j + 3)) - PI;
        let skew = beta(j) - beta(j + 3);
        squares += bend * bend + skew * skew;
    }
    (squares / 3.0).sqrt()
}
