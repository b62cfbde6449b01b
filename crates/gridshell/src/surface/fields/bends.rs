//! Where the surface bends more sharply than members can follow, and along what.

use super::chart::Chart;
use crate::math::trig::{angle, atan2};
use crate::surface::Surface;
use crate::surface::carrier::NONE;
use glam::{DVec2, DVec3};

/// Turn of the surface over one member, radians, from which a bend is sharp.
const SHARP: f64 = 1.2;

/// A piece of a sharp bend in the chart.
#[derive(Clone, Copy, Debug)]
pub struct Bend {
    /// Its middle.
    pub at: DVec2,
    /// The direction that it runs in, radians.
    pub angle: f64,
    /// Its length times the square of its turn, and that of all before it.
    pub until: f64,
}

/// The carrier's edges across which `surface` turns too sharply for members of `length` metres.
pub fn sharp_bends(surface: &Surface, chart: &Chart, length: f64) -> Vec<Bend> {
    let carrier = &surface.carrier;
    let mut bends = Vec::new();
    let mut until = 0.0;
    let panel = |t: u32| {
        let [p, q, r] = carrier.corners(t);
        (q - p).cross(r - p)
    };
    for (t, corners) in carrier.triangles.iter().enumerate() {
        for k in 0..3 {
            let next = carrier.neighbors[t][k];
            if next == NONE || (next as usize) < t {
                continue;
            }
            let (a, b) = (corners[k] as usize, corners[(k + 1) % 3] as usize);
            let along = carrier.points[a].distance(carrier.points[b]);
            let [here, there]: [DVec3; 2] = [panel(t as u32), panel(next)];
            let turn = angle(here, there);
            // From centroid to centroid: a third of either height.
            let across = (here.length() + there.length()) / (3.0 * along);
            if turn * length > SHARP * across {
                until += along * turn * turn;
                let d = chart.uv[b] - chart.uv[a];
                let at = chart.uv[a].midpoint(chart.uv[b]);
                bends.push(Bend { at, angle: atan2(d.y, d.x), until });
            }
        }
    }
    bends
}
