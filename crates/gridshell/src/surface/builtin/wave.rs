//! A free-form roof with the outline of an L, of straight and of curved sides: one bicubic patch, trimmed. The
//! patch parameters are x and y, so the outline is drawn in plan.

use super::known;
use super::sketch::{Sketch, along};
use super::spline::{clamped, clamped_knots, greville};
use crate::math::trig::exp;
use crate::surface::{Brep, Curve, Shape};
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// Control points along x and y.
const COUNT: [usize; 2] = [13, 9];
/// Half the size of the untrimmed patch, metres.
const HALF: [f64; 2] = [32.0, 20.0];

/// The sides, counter-clockwise: straight ones have two points, the others are splines.
const SIDES: [&[[f64; 2]]; 6] = [
    &[[-26.0, -13.0], [17.0, -16.0]],
    &[[17.0, -16.0], [21.0, -12.0], [28.5, -6.0], [27.0, 3.0], [21.0, 8.0], [19.0, 15.0]],
    &[[19.0, 15.0], [3.0, 13.0]],
    &[[3.0, 13.0], [2.5, 4.0]],
    &[[2.5, 4.0], [-4.0, 4.0], [-11.0, 1.0], [-18.0, 3.0], [-28.0, 7.0]],
    &[[-28.0, 7.0], [-26.0, -13.0]],
];

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("wave");
    let patch = Arc::new(patch());
    let ids = SIDES.map(|side| sketch.vertex(patch.point(DVec2::from(side[0]))));
    let mut outline = Vec::new();
    for (k, side) in SIDES.iter().enumerate() {
        let curve = match side {
            [a, b] => Curve::UvLine { shape: Arc::clone(&patch), ends: [*a, *b].map(DVec2::from) },
            points => Curve::OnShape(Arc::clone(&patch), clamped(points)),
        };
        outline.push(along(sketch.edge(curve, [0.0, 1.0], [ids[k], ids[(k + 1) % 6]])));
    }
    sketch.face(patch.as_ref().clone(), vec![outline]);
    sketch.finish()
}

fn patch() -> Shape {
    let knots = [0, 1].map(|k| clamped_knots(COUNT[k], -HALF[k], HALF[k]));
    let (xs, ys) = (greville(&knots[0]), greville(&knots[1]));
    let points =
        xs.iter().flat_map(|&x| ys.iter().map(move |&y| DVec3::new(x, y, height(x, y)))).collect();
    Shape::Nurbs(known::surface([3, 3], knots, COUNT, points, Vec::new()))
}

/// Height of the control net: a crest in each arm of the L, and a valley between them.
fn height(x: f64, y: f64) -> f64 {
    let hill = |cx: f64, cy: f64, wx: f64, wy: f64| {
        let (p, q) = ((x - cx) / wx, (y - cy) / wy);
        exp(-p * p - q * q)
    };
    4.0 + 6.5 * hill(13.0, 4.0, 11.0, 10.0) + 4.5 * hill(-17.0, -5.0, 10.0, 9.0)
        - 2.5 * hill(-2.0, -15.0, 9.0, 8.0)
}
