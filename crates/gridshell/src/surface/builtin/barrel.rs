//! A cylindrical vault: two straight and two curved edges.

use super::conic::arc;
use super::known;
use super::sketch::{Sketch, against, along};
use crate::surface::{Brep, Shape};
use glam::DVec3;

/// Half the length, along x, metres.
const HALF_LENGTH: f64 = 15.0;
/// Half the span, along y, metres.
const HALF_SPAN: f64 = 10.0;
/// Height of the crown over the springings, metres.
const RISE: f64 = 6.0;

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("barrel");
    let radius = (HALF_SPAN * HALF_SPAN + RISE * RISE) / (2.0 * RISE);
    // Cosine and tangent of half the opening angle.
    let cosine = (radius - RISE) / radius;
    let tangent = HALF_SPAN / (radius - RISE);
    let profile = |x: f64| {
        [
            DVec3::new(x, -HALF_SPAN, 0.0),
            DVec3::new(x, 0.0, HALF_SPAN * tangent),
            DVec3::new(x, HALF_SPAN, 0.0),
        ]
    };
    let (near, far) = (profile(-HALF_LENGTH), profile(HALF_LENGTH));
    let shape = known::surface(
        [1, 2],
        [vec![0.0, 0.0, 1.0, 1.0], vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0]],
        [2, 3],
        near.iter().chain(&far).copied().collect(),
        vec![1.0, cosine, 1.0, 1.0, cosine, 1.0],
    );
    let [a, b, c, d] = [near[0], far[0], far[2], near[2]].map(|p| sketch.vertex(p));
    let right = sketch.line(a, b);
    let end = sketch.whole(arc(far[0], far[1], far[2], cosine), [b, c]);
    let left = sketch.line(d, c);
    let front = sketch.whole(arc(near[0], near[1], near[2], cosine), [a, d]);
    sketch.face(
        Shape::Nurbs(shape),
        vec![vec![along(right), along(end), against(left), against(front)]],
    );
    sketch.finish()
}
