//! Exact edge curves: a mapping from t to xyz.

use super::nurbs::NurbsCurve;
use super::shape::Shape;
use glam::{DVec2, DVec3};
use std::sync::Arc;

/// The exact geometry of one edge.
#[derive(Clone, Debug)]
pub enum Curve {
    /// A (rational) B-spline curve in space.
    Nurbs(NurbsCurve),
    /// A curve drawn in the parameters of a patch: the image of uv(t), which is a spline in the plane z = 0.
    OnShape(Arc<Shape>, NurbsCurve),
    /// The image of the straight line from the first to the second (u, v) over [0, 1]: sides and seams.
    UvLine {
        /// The patch it lies on.
        shape: Arc<Shape>,
        /// Parameters at 0 and at 1.
        ends: [DVec2; 2],
    },
    /// The feet on a patch of the points of a straight line, over [0, 1]: a stretch of a guide.
    Guide {
        /// The patch it lies on.
        shape: Arc<Shape>,
        /// The line's points at 0 and at 1.
        line: [DVec3; 2],
        /// Parameters of their feet.
        near: [DVec2; 2],
    },
}

impl Curve {
    /// Position at `t`.
    pub fn point(&self, t: f64) -> DVec3 {
        self.jet(t)[0]
    }

    /// Position and derivative at `t`.
    pub fn jet(&self, t: f64) -> [DVec3; 2] {
        match self {
            Curve::Nurbs(c) => c.jet(t),
            Curve::OnShape(shape, uv) => {
                let [p, d] = uv.jet(t);
                let j = shape.jet(p.truncate());
                [j.point, j.du * d.x + j.dv * d.y]
            }
            Curve::UvLine { shape, ends } => {
                let d = ends[1] - ends[0];
                let j = shape.jet(ends[0] + d * t);
                [j.point, j.du * d.x + j.dv * d.y]
            }
            Curve::Guide { shape, line, near } => {
                let near = near.map(|uv| if uv.is_finite() { uv } else { near[0].max(near[1]) });
                let (uv, foot) = shape.project(near[0].lerp(near[1], t), line[0].lerp(line[1], t));
                let (n, d) = (shape.jet(uv).normal(), line[1] - line[0]);
                // As if the patch were plane: near enough to search along.
                [foot, d - n * d.dot(n)]
            }
        }
    }
}
