//! Exact patch geometry: a mapping from (u, v) to xyz with first derivatives.

use super::nurbs::NurbsSurface;
use glam::{DVec2, DVec3};

/// Value and first derivatives of a patch at one (u, v).
#[derive(Clone, Copy, Debug)]
pub struct Jet {
    /// Position, metres.
    pub point: DVec3,
    /// Derivative by u.
    pub du: DVec3,
    /// Derivative by v.
    pub dv: DVec3,
}

/// The exact geometry of one patch.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A (rational) B-spline surface.
    Nurbs(NurbsSurface),
    /// z as an analytic function of x = u and y = v: its value and its two derivatives.
    Height(fn(f64, f64) -> [f64; 3]),
}

impl Shape {
    /// Position at `uv`.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        self.jet(uv).point
    }

    /// Position and first derivatives at `uv`.
    pub fn jet(&self, uv: DVec2) -> Jet {
        match self {
            Shape::Nurbs(s) => s.jet(uv),
            Shape::Height(f) => {
                let [z, zx, zy] = f(uv.x, uv.y);
                Jet {
                    point: DVec3::new(uv.x, uv.y, z),
                    du: DVec3::new(1.0, 0.0, zx),
                    dv: DVec3::new(0.0, 1.0, zy),
                }
            }
        }
    }
}
