//! A shell on three points, each drawn out to a sharp tip.

use super::conic::arc;
use super::sketch::{Sketch, along};
use crate::math::trig::{cos, sin};
use crate::surface::exact::nurbs::NurbsCurve;
use crate::surface::{Brep, Curve, Shape};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_3, TAU};
use std::sync::Arc;

/// From the middle to a tip in plan, metres.
const REACH: f64 = 16.0;
/// From the middle to where the tangents of a side meet in plan, metres.
const WAIST: f64 = 4.0;
/// Height of the middle over the tips, metres.
const RISE: f64 = 6.0;

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("tripod");
    let shape = Arc::new(Shape::Height(height));
    let tips = [0, 1, 2].map(|k| sketch.vertex(shape.point(tip(k).truncate())));
    let outline = [0, 1, 2].map(|k| {
        let curve = Curve::OnShape(Arc::clone(&shape), side(k));
        along(sketch.edge(curve, [0.0, 1.0], [tips[k], tips[(k + 1) % 3]]))
    });
    sketch.face(Shape::Height(height), vec![outline.to_vec()]);
    sketch.finish()
}

/// Side `k` in plan: a parabola that is drawn in towards the middle.
pub(super) fn side(k: usize) -> NurbsCurve {
    let middle = TAU / 3.0 * k as f64 + FRAC_PI_3;
    let apex = DVec3::new(cos(middle), sin(middle), 0.0) * WAIST;
    arc(tip(k), apex, tip((k + 1) % 3), 1.0)
}

fn tip(k: usize) -> DVec3 {
    let angle = TAU / 3.0 * k as f64;
    DVec3::new(cos(angle), sin(angle), 0.0) * REACH
}

/// A paraboloid of revolution.
pub(super) fn height(x: f64, y: f64) -> [f64; 3] {
    let k = RISE / (REACH * REACH);
    [RISE - k * (x * x + y * y), -2.0 * k * x, -2.0 * k * y]
}
