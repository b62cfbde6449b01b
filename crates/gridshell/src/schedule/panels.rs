//! Panels: nodes, area, shape, angles.

use super::group::{groups_of, turned_to_least};
use super::members::Members;
use crate::grid::Grid;
use crate::math::trig;
use crate::merit;
use glam::DVec3;

/// The panels of a grid.
#[derive(Clone, Debug, Default)]
pub struct Panels {
    /// The three nodes, counter-clockwise seen from outside, the lowest first; ascending.
    pub nodes: Vec<[u32; 3]>,
    /// Area, square metres.
    pub area: Vec<f64>,
    /// Unit normal, outwards.
    pub normal: Vec<DVec3>,
    /// Shape q of Eq. 25: 1 is equilateral.
    pub shape: Vec<f64>,
    /// The angles at the three nodes, degrees.
    pub angles_deg: Vec<[f64; 3]>,
    /// Number of its group, as they appear: panels of one group have members of the same groups in the same turn.
    pub group: Vec<u32>,
}

impl Panels {
    /// The panels of `grid`, whose members have their groups.
    pub(super) fn new(grid: &Grid, members: &Members) -> Panels {
        let mut panels = Panels { nodes: grid.mesh.triangles().collect(), ..Panels::default() };
        panels.nodes.sort_unstable();
        for t in &panels.nodes {
            let p = t.map(|v| grid.xyz[v as usize]);
            let cross = (p[1] - p[0]).cross(p[2] - p[0]);
            panels.area.push(0.5 * cross.length());
            panels.normal.push(cross.normalize_or_zero());
            panels.shape.push(merit::shape(p));
            let angle = |k: usize| trig::angle(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            panels.angles_deg.push([0, 1, 2].map(|k| angle(k).to_degrees()));
        }
        let kind = |t: &[u32; 3]| {
            let side = |k: usize| members.between(t[k], t[(k + 1) % 3]).map(|m| members.group[m]);
            turned_to_least(&[side(0), side(1), side(2)])
        };
        panels.group = groups_of(panels.nodes.iter().map(kind));
        panels
    }
}
