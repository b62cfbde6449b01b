//! A saddle over a square of 30 m, with a round hole off its middle.

use super::conic::{arc, circle};
use super::sketch::{Sketch, against, along};
use crate::surface::{Brep, Curve, Shape};
use glam::DVec3;
use std::sync::Arc;

/// Half the side of the square, metres.
const HALF: f64 = 15.0;
/// The saddle is z = (x^2 - y^2) / STEEPNESS; metres.
const STEEPNESS: f64 = 60.0;
/// Centre of the hole in plan, metres.
const HOLE: DVec3 = DVec3::new(-4.0, 2.5, 0.0);
/// Radius of the hole in plan, metres.
const RADIUS: f64 = 4.5;

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("saddle");
    let corners = [[-HALF, -HALF], [HALF, -HALF], [HALF, HALF], [-HALF, HALF]];
    let ids = corners.map(|[x, y]| sketch.vertex(DVec3::new(x, y, height(x, y)[0])));
    let mut outline = Vec::new();
    for k in 0..4 {
        let [a, b] =
            [corners[k], corners[(k + 1) % 4]].map(|[x, y]| DVec3::new(x, y, height(x, y)[0]));
        // A parabola over each side: its end tangents meet over the middle.
        let sink = if k % 2 == 0 { -2.0 } else { 2.0 } * HALF * HALF / STEEPNESS;
        let apex = (a + b) / 2.0 + DVec3::Z * sink;
        outline.push(along(sketch.whole(arc(a, apex, b, 1.0), [ids[k], ids[(k + 1) % 4]])));
    }
    let shape = Arc::new(Shape::Height(height));
    let rim =
        Curve::OnShape(Arc::clone(&shape), circle(HOLE, DVec3::X * RADIUS, DVec3::Y * RADIUS));
    let hole = sketch.ring(rim, [0.0, 1.0]);
    sketch.face(Shape::Height(height), vec![outline, vec![against(hole)]]);
    sketch.finish()
}

fn height(x: f64, y: f64) -> [f64; 3] {
    [(x * x - y * y) / STEEPNESS, 2.0 * x / STEEPNESS, -2.0 * y / STEEPNESS]
}
