//! A lattice tower: a hyperboloid of one sheet, 12 m wide at its waist and 22 m high.

use super::conic::{Flat, quarters, turned};
use super::quilt::{Quilt, bezier};
use super::sketch::Sketch;
use crate::surface::Brep;

/// Radius at the waist, metres.
const WAIST: f64 = 6.0;
/// Radius at the foot, metres.
const FOOT: f64 = 9.0;
/// Height of the waist over the foot, metres.
const BELOW: f64 = 14.0;
/// Height of the top over the waist, metres.
const ABOVE: f64 = 8.0;

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("tower");
    let (round, section) = (quarters(), section());
    let quilt = Quilt {
        degree: [2, 2],
        knots: [bezier(2), bezier(2)],
        pieces: [4, 2],
        closed: [true, false],
        control: |a: usize, b: usize| turned(round[a], section[b]),
    };
    quilt.sew(&mut sketch, |_, _| true);
    sketch.finish()
}

/// The hyperbola rho^2 = WAIST^2 + k h^2, h being the height over the waist, from foot to top by way of the
/// waist.
fn section() -> [Flat; 5] {
    let k = (FOOT * FOOT - WAIST * WAIST) / (BELOW * BELOW);
    let end = |h: f64| ([(WAIST * WAIST + k * h * h).sqrt(), BELOW + h], 1.0);
    // Where the tangent at the end meets the one at the waist, and the weight that makes it this hyperbola:
    // the hyperbolic cosine of half its angle.
    let apex = |h: f64| {
        let rho = (WAIST * WAIST + k * h * h).sqrt();
        let back = (rho - WAIST) * rho / (k * h);
        ([WAIST, BELOW + h - back], f64::midpoint(rho / WAIST, 1.0).sqrt())
    };
    [end(-BELOW), apex(-BELOW), ([WAIST, BELOW], 1.0), apex(ABOVE), end(ABOVE)]
}
