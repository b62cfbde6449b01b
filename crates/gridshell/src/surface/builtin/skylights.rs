//! A shallow oval dome of 40 x 26 m with five round skylights, the smallest of them 2.4 m wide.

use super::conic::circle;
use super::sketch::{Sketch, against, along};
use crate::surface::{Brep, Curve, Shape};
use glam::DVec3;
use std::sync::Arc;

/// Half the axes of the oval, metres.
const HALF: [f64; 2] = [20.0, 13.0];
/// Height of the crown, metres.
const RISE: f64 = 5.0;
/// Centres and radii of the skylights in plan, metres.
pub(super) const LIGHTS: [[f64; 3]; 5] =
    [[-10.5, 2.0, 3.6], [-1.5, -5.5, 2.4], [1.0, 5.5, 1.8], [10.5, -1.0, 3.0], [5.5, 1.0, 1.2]];

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("skylights");
    let shape = Arc::new(Shape::Height(height));
    let oval = circle(DVec3::ZERO, DVec3::X * HALF[0], DVec3::Y * HALF[1]);
    let mut loops = vec![vec![along(sketch.ring(Curve::Nurbs(oval), [0.0, 1.0]))]];
    for [x, y, radius] in LIGHTS {
        let rim = circle(DVec3::new(x, y, 0.0), DVec3::X * radius, DVec3::Y * radius);
        let rim = sketch.ring(Curve::OnShape(Arc::clone(&shape), rim), [0.0, 1.0]);
        loops.push(vec![against(rim)]);
    }
    sketch.face(Shape::Height(height), loops);
    sketch.finish()
}

/// The elliptic paraboloid that is level on the oval.
pub(super) fn height(x: f64, y: f64) -> [f64; 3] {
    let [a, b] = HALF.map(|h| RISE / (h * h));
    [RISE - a * x * x - b * y * y, -2.0 * a * x, -2.0 * b * y]
}
