//! Degrees and the residual that regularity is judged by (Section 5.1, Eq. 11 to 14).
//!
//! A boundary vertex is given a *virtual degree* from the angle that its panels fill, so that 6 is the
//! wanted *adjusted degree* of every vertex. The residual weighs the squared deviations from 6, interior
//! vertices by lambda and boundary ones by 1 - lambda (the paper's Eq. 14 leaves the weights of Eq. 13
//! out; its Eq. 15, 26 and 27 only make sense with them).

use crate::math::trig;
use crate::mesh::Mesh;
use glam::{DVec2, DVec3};
use std::f64::consts::{FRAC_PI_3, TAU};

/// The adjusted degree of a regular vertex.
pub const REGULAR: i32 = 6;

/// `alpha_1` to `alpha_4` of Eq. 12 in radians: 60 degrees times sqrt(k (k + 1)). Above `alpha_4` the virtual
/// degree is 0 whether or not `alpha_5` is passed.
const LIMITS: [f64; 4] = [
    FRAC_PI_3 * std::f64::consts::SQRT_2,
    FRAC_PI_3 * 2.449489742783178,
    FRAC_PI_3 * 3.4641016151377544,
    FRAC_PI_3 * 4.47213595499958,
];

/// The virtual degree of a boundary vertex whose panels fill `theta` radians (Eq. 12).
pub fn virtual_degree(theta: f64) -> i32 {
    LIMITS.iter().map(|&alpha| i32::from(theta <= alpha)).sum()
}

/// Sum of the panel angles at `v`, radians.
pub fn boundary_angle(mesh: &Mesh, xyz: &[DVec3], v: u32) -> f64 {
    let at = xyz[v as usize];
    // A needle turned by each angle in turn, none over pi: one arc tangent in the end instead of one for each.
    let (mut needle, mut turns) = (DVec2::X, 0);
    for (a, b) in mesh.fan(v) {
        let (a, b) = (xyz[a as usize] - at, xyz[b as usize] - at);
        let angle = DVec2::new(a.dot(b), a.cross(b).length());
        let turned = needle.rotate(angle.try_normalize().unwrap_or(DVec2::X));
        turns += i32::from(past_half(needle) && !past_half(turned));
        needle = turned;
    }
    let angle = trig::atan2(needle.y, needle.x);
    TAU * f64::from(turns) + if angle < 0.0 { angle + TAU } else { angle }
}

/// Whether a direction is half a turn or more from x.
fn past_half(needle: DVec2) -> bool {
    needle.y < 0.0 || needle.y == 0.0 && needle.x < 0.0
}

/// The degree of `v`, with the virtual degree added on the boundary (Eq. 11).
pub fn adjusted_degree(mesh: &Mesh, xyz: &[DVec3], v: u32) -> i32 {
    let degree = mesh.degree(v) as i32;
    if mesh.is_boundary(v) { degree + virtual_degree(boundary_angle(mesh, xyz, v)) } else { degree }
}

/// Weight gamma of a vertex in the residual (Eq. 13).
pub fn weight(mesh: &Mesh, v: u32, lambda: f64) -> f64 {
    if mesh.is_boundary(v) { 1.0 - lambda } else { lambda }
}

/// The residual R of the whole grid (Eq. 14).
pub fn residual(mesh: &Mesh, xyz: &[DVec3], lambda: f64) -> f64 {
    mesh.vertices()
        .map(|v| {
            let off = adjusted_degree(mesh, xyz, v) - REGULAR;
            weight(mesh, v, lambda) * f64::from(off * off)
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn virtual_degree_takes_every_branch_of_equation_12() {
        let alpha = |k: f64| 60.0 * (k * (k + 1.0)).sqrt();
        for k in 0..5 {
            let (low, high) = (alpha(f64::from(k)), alpha(f64::from(k + 1)));
            assert_eq!(virtual_degree((low + 1e-9).to_radians()), 4 - k, "just above alpha_{k}");
            assert_eq!(
                virtual_degree((high - 1e-9).to_radians()),
                4 - k,
                "just below alpha_{}",
                k + 1
            );
        }
        assert_eq!(virtual_degree((alpha(5.0) + 1e-9).to_radians()), 0);
        assert_eq!(virtual_degree(360f64.to_radians()), 0);
    }

    #[test]
    fn the_limits_belong_to_the_branch_below() {
        assert_eq!(LIMITS.map(virtual_degree), [4, 3, 2, 1]);
        assert_eq!(
            LIMITS.map(|a| (a.to_degrees() * 100.0).round() / 100.0),
            [84.85, 146.97, 207.85, 268.33]
        );
    }

    /// `panels` isosceles panels round the boundary vertex 0, filling `theta` degrees.
    fn fan(panels: u32, theta: f64) -> (Mesh, Vec<DVec3>) {
        let triangles: Vec<[u32; 3]> = (1..=panels).map(|k| [0, k, k + 1]).collect();
        let mesh = Mesh::from_triangles(panels as usize + 2, &triangles).expect("a fan");
        let mut xyz = vec![DVec3::ZERO];
        for k in 0..=panels {
            let a = theta.to_radians() * f64::from(k) / f64::from(panels);
            xyz.push(DVec3::new(a.cos(), a.sin(), 0.0));
        }
        (mesh, xyz)
    }

    /// Two panels without area at a node whose members lie in one line.
    #[test]
    fn straight_angles_add_up() {
        let mesh = Mesh::from_triangles(4, &[[0, 1, 2], [0, 2, 3]]).expect("two panels");
        let xyz = [0.0, 1.0, -1.0, 2.0].map(|x| DVec3::new(x, 0.0, 0.0));
        assert_eq!(boundary_angle(&mesh, &xyz, 0), TAU);
    }

    /// A node where a wall turns back may have more than a full turn of panels.
    #[test]
    fn angles_add_up_beyond_a_full_turn() {
        for theta in [1.0, 179.0, 180.0, 181.0, 359.0, 361.0, 540.0, 700.0, 721.0] {
            let (mesh, xyz) = fan(7, theta);
            let sum = boundary_angle(&mesh, &xyz, 0).to_degrees();
            assert!((sum - theta).abs() < 1e-9, "{sum} for {theta}");
        }
    }

    #[test]
    fn table_1_of_the_paper() {
        // Degree and virtual degree of its boundary vertices 2 to 6; the angle of vertex 2 is printed
        // (221 degrees), the others lie in the middle of their branches.
        for (degree, theta, virtual_, adjusted) in [
            (5, 221.0, 1, 6),
            (3, 177.0, 2, 5),
            (4, 116.0, 3, 7),
            (2, 42.0, 4, 6),
            (6, 298.0, 0, 6),
        ] {
            let (mesh, xyz) = fan(degree - 1, theta);
            assert_eq!(mesh.degree(0), degree as usize);
            assert!((boundary_angle(&mesh, &xyz, 0).to_degrees() - theta).abs() < 1e-9);
            assert_eq!(virtual_degree(boundary_angle(&mesh, &xyz, 0)), virtual_);
            assert_eq!(adjusted_degree(&mesh, &xyz, 0), adjusted);
        }
        // Vertex 1 is interior: its degree stands.
        let triangles: Vec<[u32; 3]> = (0..6).map(|k| [0, 1 + k, 1 + (k + 1) % 6]).collect();
        let mesh = Mesh::from_triangles(7, &triangles).expect("a disc");
        let mut xyz = fan(6, 360.0).1;
        xyz.pop();
        assert_eq!(adjusted_degree(&mesh, &xyz, 0), 6);
    }

    #[test]
    fn residual_weighs_the_inside_by_lambda_and_the_border_by_the_rest() {
        // A regular pentagon with its centre: 5 inside (deviation 1); corners of 108 degrees have
        // degree 3 and virtual degree 3, so 6.
        let triangles: Vec<[u32; 3]> = (0..5).map(|k| [0, 1 + k, 1 + (k + 1) % 5]).collect();
        let mesh = Mesh::from_triangles(6, &triangles).expect("a disc");
        let mut xyz = fan(5, 360.0).1;
        xyz.pop();
        assert!((residual(&mesh, &xyz, 0.9) - 0.9).abs() < 1e-12);
        // One lone panel: three corners of 60 degrees, degree 2, virtual degree 4.
        let (mesh, xyz) = fan(1, 60.0);
        assert_eq!(residual(&mesh, &xyz, 0.9), 0.0);
        // A square cut by a diagonal: two corners have degree 3 and two degree 2, all virtual degree 3.
        let mesh = Mesh::from_triangles(4, &[[0, 1, 2], [0, 2, 3]]).expect("a disc");
        let xyz = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
        assert!((residual(&mesh, &xyz, 0.9) - 2.0 * 0.1).abs() < 1e-12);
    }
}
