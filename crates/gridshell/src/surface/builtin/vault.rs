//! A groin vault over a square of 16 m: two crossing barrels. The creases along its diagonals are sharp at
//! the corners and fade towards the crown.

use super::conic::arc;
use super::known;
use super::quilt::bezier;
use super::sketch::{Sketch, against, along};
use crate::surface::{Brep, Shape};
use glam::DVec3;

/// Half the side of the square, metres.
const HALF: f64 = 8.0;
/// Height of the crown over the corners, metres.
const RISE: f64 = 4.0;
/// Radius of the barrels, metres.
const RADIUS: f64 = (HALF * HALF + RISE * RISE) / (2.0 * RISE);
/// The patches reach a little beyond the crown, so that it lies inside them.
const BEYOND: f64 = 1.0;

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("vault");
    // Cosine and tangent of half the barrels' opening angle, and of a quarter of it.
    let (cosine, tangent) = ((RADIUS - RISE) / RADIUS, HALF / (RADIUS - RISE));
    let half_cosine = f64::midpoint(1.0, cosine).sqrt();
    let half_tangent = HALF / (RADIUS + (RADIUS - RISE));
    let outwards = [DVec3::X, DVec3::Y, -DVec3::X, -DVec3::Y];
    let sideways = |k: usize| outwards[(k + 1) % 4];
    // Corner k stands at the right end of side k.
    let corners = [0, 1, 2, 3].map(|k| (outwards[k] - sideways(k)) * HALF);
    let crown = DVec3::Z * RISE;
    let ids = corners.map(|c| sketch.vertex(c));
    let top = sketch.vertex(crown);
    let arches = [0, 1, 2, 3].map(|k| {
        let apex = outwards[k] * HALF + DVec3::Z * (HALF * tangent);
        let (from, to) = (k, (k + 1) % 4);
        sketch.whole(arc(corners[from], apex, corners[to], cosine), [ids[from], ids[to]])
    });
    let groins = [0, 1, 2, 3].map(|k| {
        let apex = crown + corners[k] * (RADIUS * half_tangent / HALF);
        sketch.whole(arc(corners[k], apex, crown, half_cosine), [ids[k], top])
    });
    for k in 0..4 {
        let section = |out: f64| {
            let right = outwards[k] * out - sideways(k) * HALF;
            let left = outwards[k] * out + sideways(k) * HALF;
            [right, outwards[k] * out + DVec3::Z * (HALF * tangent), left]
        };
        let barrel = known::surface(
            [1, 2],
            [bezier(1), bezier(2)],
            [2, 3],
            [section(-BEYOND), section(HALF)].concat(),
            vec![1.0, cosine, 1.0, 1.0, cosine, 1.0],
        );
        let outline = vec![along(arches[k]), along(groins[(k + 1) % 4]), against(groins[k])];
        sketch.face(Shape::Nurbs(barrel), vec![outline]);
    }
    sketch.finish()
}
