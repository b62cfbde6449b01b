//! Mirrorings at vertical planes and turns about a vertical axis.

use crate::math::trig;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// A rigid motion that keeps heights.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    /// What stays in place.
    centre: DVec2,
    /// Images of the two unit vectors.
    columns: [DVec2; 2],
}

impl Motion {
    /// The turn by `k` parts of `n` of a full turn about `centre`.
    pub fn turn(centre: DVec2, k: u32, n: u32) -> Motion {
        let x = unit(k, n);
        Motion { centre, columns: [x, x.perp()] }
    }

    /// The mirroring at the vertical plane through `centre` along the unit vector `along`.
    pub fn mirroring(centre: DVec2, along: DVec2) -> Motion {
        let image = |v: DVec2| along * (2.0 * v.dot(along)) - v;
        Motion { centre, columns: [image(DVec2::X), image(DVec2::Y)] }
    }

    /// This motion after `first`, which has the same centre.
    #[must_use]
    pub fn after(&self, first: &Motion) -> Motion {
        Motion { centre: self.centre, columns: first.columns.map(|c| self.linear(c)) }
    }

    /// The image of a point.
    pub fn image(&self, p: DVec3) -> DVec3 {
        (self.centre + self.linear(p.truncate() - self.centre)).extend(p.z)
    }

    /// The point whose image this is.
    pub fn preimage(&self, p: DVec3) -> DVec3 {
        let d = p.truncate() - self.centre;
        (self.centre + DVec2::new(self.columns[0].dot(d), self.columns[1].dot(d))).extend(p.z)
    }

    /// Whether it turns left into right.
    pub fn mirrors(&self) -> bool {
        self.columns[0].perp_dot(self.columns[1]) < 0.0
    }

    fn linear(&self, v: DVec2) -> DVec2 {
        self.columns[0] * v.x + self.columns[1] * v.y
    }
}

/// The unit vector at `k` parts of `n` of a full turn; exact on the axes.
pub(super) fn unit(k: u32, n: u32) -> DVec2 {
    match (4 * (k % n)).checked_div(n).filter(|q| q * n == 4 * (k % n)) {
        Some(0) => DVec2::X,
        Some(1) => DVec2::Y,
        Some(2) => -DVec2::X,
        Some(3) => -DVec2::Y,
        _ => {
            let angle = TAU * f64::from(k % n) / f64::from(n);
            DVec2::new(trig::cos(angle), trig::sin(angle))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_preimage_is_taken_back_by_the_motion() {
        let centre = DVec2::new(3.0, -2.0);
        let along = DVec2::new(0.6, 0.8);
        let p = DVec3::new(1.0, 5.0, 7.0);
        for m in [
            Motion::turn(centre, 2, 7),
            Motion::mirroring(centre, along),
            Motion::turn(centre, 1, 5).after(&Motion::mirroring(centre, along)),
        ] {
            assert!(m.image(m.preimage(p)).distance(p) < 1e-14);
        }
    }

    #[test]
    fn quarter_turns_are_exact() {
        let turned = Motion::turn(DVec2::ZERO, 3, 12).image(DVec3::new(2.0, 1.0, 4.0));
        assert_eq!(turned, DVec3::new(-1.0, 2.0, 4.0));
    }

    #[test]
    fn two_mirrorings_are_a_turn_by_twice_the_angle_between() {
        let [a, b] = [unit(0, 12), unit(1, 12)];
        let both = Motion::mirroring(DVec2::ZERO, b).after(&Motion::mirroring(DVec2::ZERO, a));
        let p = DVec3::new(2.0, 1.0, 0.0);
        assert!(both.image(p).distance(Motion::turn(DVec2::ZERO, 2, 12).image(p)) < 1e-14);
    }
}
