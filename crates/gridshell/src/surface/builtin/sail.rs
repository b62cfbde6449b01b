//! A hypar sail between two high and two low points, with drawn-in edges and so four sharp tips.

use super::conic::arc;
use super::sketch::{Sketch, along};
use crate::surface::exact::nurbs::NurbsCurve;
use crate::surface::{Brep, Curve, Shape};
use glam::DVec3;
use std::sync::Arc;

/// Half the side of the square between the tips, metres.
const HALF: f64 = 12.0;
/// From the middle to where the tangents of an edge meet in plan, metres.
const WAIST: f64 = 5.0;
/// The sail is z = x y / STEEPNESS; metres.
const STEEPNESS: f64 = 24.0;

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("sail");
    let shape = Arc::new(Shape::Height(height));
    let tips = [0, 1, 2, 3].map(|k| sketch.vertex(shape.point(tip(k).truncate())));
    let outline = [0, 1, 2, 3].map(|k| {
        let curve = Curve::OnShape(Arc::clone(&shape), side(k));
        along(sketch.edge(curve, [0.0, 1.0], [tips[k], tips[(k + 1) % 4]]))
    });
    sketch.face(Shape::Height(height), vec![outline.to_vec()]);
    sketch.finish()
}

/// Edge `k` in plan: a parabola that is drawn in towards the middle.
pub(super) fn side(k: usize) -> NurbsCurve {
    let (a, b) = (tip(k), tip((k + 1) % 4));
    arc(a, (a + b) / 2.0 * (WAIST / HALF), b, 1.0)
}

fn tip(k: usize) -> DVec3 {
    let [x, y] = [[-HALF, -HALF], [HALF, -HALF], [HALF, HALF], [-HALF, HALF]][k];
    DVec3::new(x, y, 0.0)
}

/// A hyperbolic paraboloid.
pub(super) fn height(x: f64, y: f64) -> [f64; 3] {
    [x * y / STEEPNESS, y / STEEPNESS, x / STEEPNESS]
}
