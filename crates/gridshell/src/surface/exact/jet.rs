//! What is known of a patch at one place: the point and its first derivatives.

use glam::DVec3;

/// Derivatives in this proportion to each other are those of a pole.
const POLE_SLOPE: f64 = 1e-12;

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

impl Jet {
    /// Unit normal along du x dv; zero at a pole.
    pub fn normal(&self) -> DVec3 {
        let n = self.du.cross(self.dv);
        // At a pole rounding leaves a derivative of no meaning.
        let size = self.du.length_squared() + self.dv.length_squared();
        if n.length() > POLE_SLOPE * size { n.normalize_or_zero() } else { DVec3::ZERO }
    }
}
