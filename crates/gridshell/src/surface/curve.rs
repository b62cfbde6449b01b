//! Exact edge curves: a mapping from t to xyz.

use super::nurbs::NurbsCurve;
use super::shape::Shape;
use glam::DVec3;
use std::sync::Arc;

/// The exact geometry of one edge.
#[derive(Clone, Debug)]
pub enum Curve {
    /// A (rational) B-spline curve in space.
    Nurbs(NurbsCurve),
    /// A curve drawn in the parameters of a patch: the image of uv(t), which is a spline in the plane z = 0.
    OnShape(Arc<Shape>, NurbsCurve),
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
        }
    }
}
