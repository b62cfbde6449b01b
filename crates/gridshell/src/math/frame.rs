//! Directions square to a given one.

use glam::DVec3;

/// Seen along this no normal of a roof or a wall looks from: a pair has to jump somewhere, and here it does.
const ASIDE: DVec3 = DVec3::new(0.412_37, -0.737_51, -0.534_79);
/// Nearer to it than this, as the square of a sine, any pair will do.
const TOO_NEAR: f64 = 1e-12;

/// Two unit directions square to the unit vector `normal` and to one another, right-handed with it. They change little
/// where the normal does, level and upright ones not excepted.
pub(crate) fn tangents(normal: DVec3) -> [DVec3; 2] {
    let x = normal.cross(ASIDE);
    if x.length_squared() < TOO_NEAR {
        return normal.any_orthonormal_pair().into();
    }
    let x = x.normalize();
    [x, normal.cross(x)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_that_leans_in_or_out_by_rounding_has_one_pair() {
        // Millimetres and metres of one facade round its normal to either side of level.
        for n in [DVec3::X, DVec3::Y, DVec3::new(0.6, -0.8, 0.0), DVec3::Z] {
            let [a, b] = [-1e-16, 1e-16].map(|z| tangents((n + DVec3::Z * z).normalize()));
            assert!(a[0].distance(b[0]) < 1e-12 && a[1].distance(b[1]) < 1e-12);
            assert!(a[0].cross(a[1]).distance(n) < 1e-12);
        }
    }

    #[test]
    fn where_the_pair_jumps_there_is_one_all_the_same() {
        let n = ASIDE.normalize();
        let [x, y] = tangents(n);
        assert!(x.dot(n).abs() < 1e-12 && y.dot(n).abs() < 1e-12 && x.dot(y).abs() < 1e-12);
    }
}
