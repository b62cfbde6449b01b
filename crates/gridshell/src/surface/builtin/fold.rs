//! Two parallel sheets of 10 x 12 m, 0.4 m apart, joined by a half-round bend: straight lines leap between
//! them, the surface does not.

use super::conic::arcs;
use super::quilt::{Control, Quilt, bezier};
use super::sketch::Sketch;
use crate::surface::Brep;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI};

/// From the bend to the far end of a sheet, metres.
const REACH: f64 = 10.0;
/// Along the bend, metres.
const WIDTH: f64 = 12.0;
/// Radius of the bend: half the gap, metres.
const RADIUS: f64 = 0.2;

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("fold");
    let section = section();
    let control = |a: usize, b: usize| -> Control {
        let (point, weight) = section[a];
        (point.with_y(WIDTH * b as f64), weight)
    };
    let quilt = Quilt {
        degree: [2, 1],
        knots: [bezier(2), bezier(1)],
        pieces: [4, 1],
        closed: [false, false],
        control,
    };
    quilt.sew(&mut sketch, |_, _| true);
    sketch.finish()
}

/// In along the lower sheet, round the bend in two quarters, out along the upper one.
fn section() -> Vec<Control> {
    let bend = arcs(&[3.0 * FRAC_PI_2, PI, FRAC_PI_2]);
    let bend = bend
        .iter()
        .map(|&([x, z], weight)| (DVec3::new(RADIUS * x, 0.0, RADIUS * (1.0 + z)), weight));
    let sheet = |x: f64, z: f64| (DVec3::new(x, 0.0, z), 1.0);
    let mut section = vec![sheet(REACH, 0.0), sheet(REACH / 2.0, 0.0)];
    section.extend(bend);
    section.extend([sheet(REACH / 2.0, 2.0 * RADIUS), sheet(REACH, 2.0 * RADIUS)]);
    section
}
