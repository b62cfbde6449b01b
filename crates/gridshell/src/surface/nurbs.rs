//! NURBS curves and surfaces: evaluation and first derivatives (Piegl & Tiller, *The NURBS Book*).

use super::shape::Jet;
use glam::{DVec2, DVec3};

/// A (rational) B-spline curve in space.
#[derive(Clone, Debug)]
pub struct NurbsCurve {
    /// Polynomial degree.
    pub degree: usize,
    /// Full knot vector, `points.len() + degree + 1` long.
    pub knots: Vec<f64>,
    /// Control points, metres.
    pub points: Vec<DVec3>,
    /// Weights, one per control point; empty when all are 1.
    pub weights: Vec<f64>,
}

/// A (rational) B-spline surface.
#[derive(Clone, Debug)]
pub struct NurbsSurface {
    /// Polynomial degrees in u and v.
    pub degree: [usize; 2],
    /// Full knot vectors in u and v.
    pub knots: [Vec<f64>; 2],
    /// Number of control points in u and v.
    pub count: [usize; 2],
    /// Control points, metres; the point (i, j) stands at `i * count[1] + j`.
    pub points: Vec<DVec3>,
    /// Weights, one per control point; empty when all are 1.
    pub weights: Vec<f64>,
}

impl NurbsCurve {
    /// Position and derivative at `t`.
    pub fn jet(&self, _t: f64) -> [DVec3; 2] {
        unimplemented!()
    }
}

impl NurbsSurface {
    /// Position and first derivatives at `uv`.
    pub fn jet(&self, _uv: DVec2) -> Jet {
        unimplemented!()
    }
}
