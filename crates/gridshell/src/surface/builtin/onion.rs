//! An onion dome: five sixths of the height of a sphere on a neck that flares to its foot. It overhangs.

use super::conic::{Flat, arcs, quarters, turned};
use super::quilt::{Quilt, bezier};
use super::sketch::{Sketch, along};
use super::sphere::half;
use crate::surface::Brep;
use glam::DVec3;
use std::f64::consts::FRAC_PI_6;

/// Radius of the sphere, metres.
const BULB: f64 = 8.0;
/// Radius of the neck's section, metres.
const NECK: f64 = 4.0;

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("onion");
    let (round, section) = (quarters(), section());
    let quilt = Quilt {
        degree: [2, 2],
        knots: [bezier(2), bezier(2)],
        pieces: [4, 3],
        closed: [true, false],
        control: |a: usize, b: usize| turned(round[a], section[b]),
    };
    let parallels = quilt.sew(&mut sketch, |_, _| true);
    // Above its widest parallel the sphere is one patch, without a pole.
    let rim = parallels.iter().map(|column| along(column[3])).collect();
    sketch.face(half(DVec3::Z * height(), BULB, DVec3::Y, DVec3::Z), vec![rim]);
    sketch.finish()
}

/// Height of the sphere's centre over the foot, metres: the neck begins 30 degrees below the centre and ends
/// 60 degrees below its own waist.
fn height() -> f64 {
    let sin_60 = 0.75_f64.sqrt();
    f64::midpoint(BULB, NECK) + NECK * sin_60
}

/// From the foot round the neck to the widest parallel: distances from the axis and heights.
fn section() -> Vec<Flat> {
    let neck = arcs(&[8.0, 6.5, 5.0].map(|k| k * FRAC_PI_6));
    let center = [(BULB + NECK) * 0.75_f64.sqrt(), height() - f64::midpoint(BULB, NECK)];
    let neck = neck
        .into_iter()
        .map(|([x, z], weight)| ([center[0] + NECK * x, center[1] + NECK * z], weight));
    let bulb = arcs(&[-FRAC_PI_6, 0.0]);
    let bulb =
        bulb.into_iter().map(|([x, z], weight)| ([BULB * x, height() + BULB * z], weight)).skip(1);
    neck.chain(bulb).collect()
}
