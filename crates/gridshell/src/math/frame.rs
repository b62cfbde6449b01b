//! Directions perpendicular to a given one.

use glam::DVec3;

/// Normals that look along x by this share or more have a pair from y: an odd number, so that no wall, slope or mean
/// normal of a symmetric roof lies just at it, on one side in millimetres and on the other in metres.
const ALONG: f64 = 0.876_54;

/// Two unit directions perpendicular to the unit vector `normal` and to one another, right-handed with it: x and y themselves
/// where it looks up.
pub(crate) fn tangents(normal: DVec3) -> [DVec3; 2] {
    let axis = if normal.x.abs() < ALONG { DVec3::X } else { DVec3::Y };
    let x = (axis - normal * axis.dot(normal)).normalize();
    [x, normal.cross(x)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_that_leans_in_or_out_by_rounding_has_one_pair() {
        // Millimetres and metres of one facade round its normal to either side of level.
        for n in [DVec3::X, -DVec3::X, DVec3::Y, DVec3::new(0.6, -0.8, 0.0), DVec3::Z, -DVec3::Z] {
            let [a, b] = [-1e-16, 1e-16].map(|z| tangents((n + DVec3::Z * z).normalize()));
            assert!(a[0].distance(b[0]) < 1e-12 && a[1].distance(b[1]) < 1e-12);
            assert!(a[0].cross(a[1]).distance(n) < 1e-12);
        }
    }

    #[test]
    fn seen_from_above_the_pair_is_x_and_y() {
        assert_eq!(tangents(DVec3::Z), [DVec3::X, DVec3::Y]);
    }
}
