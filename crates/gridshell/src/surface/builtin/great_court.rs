//! The roof of the Great Court of the British Museum: the analytic function of C. J. K. Williams (2001).
//!
//! A height field over a rectangle with a round hole: z = z1 + z2 + z3, level on the rectangle (19.71 m) and
//! on the circle (20.955 m). z1 is the step between the two, z2 the undulation, z3 lifts the slope at the
//! four corners. The symbols are those of the source; lengths in metres.

use super::conic::circle;
use super::sketch::{Sketch, against};
use crate::math::dual::Dual;
use crate::surface::{Brep, Curve, Shape};
use glam::DVec3;

/// Radius of the inner circle, the old Reading Room.
const A: f64 = 22.245;
/// Half the width of the rectangle, along x.
const B: f64 = 36.625;
/// From the circle's centre to the northern side, along +y.
const C: f64 = 46.025;
/// From the circle's centre to the southern side, along -y.
const D: f64 = 51.125;
const LAMBDA: f64 = 0.5;
const MU: f64 = 14.0;
/// Height of the inner circle.
const H_CENTRE: f64 = 20.955;
/// Height of the rectangle.
const H_EDGE: f64 = 19.71;

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("great-court");
    let outer = sketch.polygon(&[
        DVec3::new(-B, -D, H_EDGE),
        DVec3::new(B, -D, H_EDGE),
        DVec3::new(B, C, H_EDGE),
        DVec3::new(-B, C, H_EDGE),
    ]);
    let rim = circle(DVec3::new(0.0, 0.0, H_CENTRE), DVec3::X * A, DVec3::Y * A);
    let inner = sketch.ring(Curve::Nurbs(rim), [0.0, 1.0]);
    sketch.face(Shape::Height(height), vec![outer, vec![against(inner)]]);
    sketch.finish()
}

/// z and its derivatives at (x, y). Smooth on the whole roof but for the four corners, where the slope is
/// bounded but depends on the direction; there the slope along the two sides (zero) is given.
fn height(x: f64, y: f64) -> [f64; 3] {
    let (x, y) = (Dual::x(x), Dual::y(y));
    let r = (x * x + y * y).sqrt();
    let cos_2theta = (x * x - y * y) / (r * r);
    let sin_theta = y / r;
    let psi = sides(x, y);
    let inwards = A / r;
    let eta = psi / sides(x * inwards, y * inwards);
    let z1 = (H_CENTRE - H_EDGE) * eta + H_EDGE;
    (z1 + undulation(psi, r, cos_2theta, sin_theta) + corners(x, y, r, cos_2theta, sin_theta))
        .into()
}

/// (1 - x/b)(1 + x/b)(1 - y/c)(1 + y/d): one at the centre, zero on the rectangle.
fn sides(x: Dual, y: Dual) -> Dual {
    (1.0 - x / B) * (1.0 + x / B) * (1.0 - y / C) * (1.0 + y / D)
}

/// z2, with C = cos 2 theta and S = sin theta.
fn undulation(psi: Dual, r: Dual, c: Dual, s: Dual) -> Dual {
    let outwards = r / A - 1.0;
    let alpha = outwards * psi;
    let north = 0.5 * (1.0 - c) + s;
    let south = 0.5 * (1.0 - c) - s;
    let form = (17.5 + 5.0 * psi) * (1.0 + c) + 12.0 * north + (7.5 + 12.0 * psi) * south - 1.6;
    alpha
        * ((1.0 - LAMBDA) * form - 5.0 * (1.0 + c)
            + 10.0 * (0.5 * north).squared() * (1.0 - 3.0 * alpha)
            + 2.5 * (0.5 * south).squared() * outwards.squared())
}

/// z3, with C = cos 2 theta and S = sin theta.
fn corners(x: Dual, y: Dual, r: Dual, c: Dual, s: Dual) -> Dual {
    let ridge = |towards: Dual| (-MU * (1.0 - towards)).exp();
    let lift = LAMBDA * (1.75 * (1.0 + c) + 1.5 * (1.0 - c) + 0.3 * s)
        + 1.05 * (ridge(x / B) + ridge(-1.0 * x / B)) * (ridge(y / C) + ridge(-1.0 * y / D));
    (1.0 - A / r) * corner_mean(x, y) * lift
}

/// 1 / sum over the corners of sqrt(p^2 + q^2) / (p q), p and q being the distances to the two sides.
/// Multiplied out by all four distances, so that it is zero, not 0/0, on the sides.
fn corner_mean(x: Dual, y: Dual) -> Dual {
    let p = [B - x, B + x];
    let q = [C - y, D + y];
    let mut sum = Dual::from(0.0);
    for i in 0..2 {
        for j in 0..2 {
            sum = sum + (p[i] * p[i] + q[j] * q[j]).sqrt() * p[1 - i] * q[1 - j];
        }
    }
    if sum.value == 0.0 {
        return Dual::from(0.0);
    }
    p[0] * p[1] * q[0] * q[1] / sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::trig::{cos, sin};
    use std::f64::consts::TAU;

    #[test]
    fn the_rectangle_and_the_circle_are_level() {
        for k in 0..=200 {
            let f = f64::from(k) / 200.0;
            let (x, y) = (B * (2.0 * f - 1.0), -D + (C + D) * f);
            for [u, v] in [[x, C], [x, -D], [B, y], [-B, y]] {
                let z = height(u, v);
                assert!((z[0] - H_EDGE).abs() < 1e-12, "{u} {v}: {z:?}");
                assert!(z.iter().all(|z| z.is_finite()), "{u} {v}: {z:?}");
            }
            let angle = TAU * f;
            let z = height(A * cos(angle), A * sin(angle))[0];
            assert!((z - H_CENTRE).abs() < 1e-12);
        }
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let h = 1e-5;
        for [x, y] in
            [[25.0, 3.0], [-30.0, 40.0], [10.0, -45.0], [36.6, 46.0], [-36.62, -51.12], [0.0, 23.0]]
        {
            let [_, zx, zy] = height(x, y);
            let dx = (height(x + h, y)[0] - height(x - h, y)[0]) / (2.0 * h);
            let dy = (height(x, y + h)[0] - height(x, y - h)[0]) / (2.0 * h);
            assert!(
                (zx - dx).abs() < 1e-5 && (zy - dy).abs() < 1e-5,
                "{x} {y}: {zx} {dx} {zy} {dy}"
            );
        }
    }

    #[test]
    fn the_slope_is_bounded_at_the_corners() {
        for [sx, sy] in [[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]] {
            let corner = [sx * B, if sy > 0.0 { C } else { -D }];
            for e in [1e-3, 1e-6, 1e-9, 1e-12, 0.0, -1e-15] {
                let [z, zx, zy] = height(corner[0] - sx * e, corner[1] - sy * e);
                assert!(
                    (z - H_EDGE).abs() < 2e-2 && zx.abs() < 2.0 && zy.abs() < 2.0,
                    "{e}: {z} {zx} {zy}"
                );
            }
        }
    }

    /// Area along rays from the circle to the rectangle, by the midpoint rule.
    #[test]
    fn area_and_top_are_those_of_the_real_roof() {
        let (rays, steps) = (1440, 400);
        let (mut area, mut top) = (0.0, 0.0_f64);
        for i in 0..rays {
            let angle = TAU * (f64::from(i) + 0.5) / f64::from(rays);
            let (c, s) = (cos(angle), sin(angle));
            let end = (B / c.abs()).min(if s > 0.0 { C / s } else { -D / s });
            let dr = (end - A) / f64::from(steps);
            for k in 0..steps {
                let r = A + dr * (f64::from(k) + 0.5);
                let [z, zx, zy] = height(r * c, r * s);
                area += r * dr * TAU / f64::from(rays) * (1.0 + zx * zx + zy * zy).sqrt();
                top = top.max(z);
            }
        }
        assert!((area / 6180.254 - 1.0).abs() < 1e-4, "{area}");
        assert!((top - 27.6).abs() < 0.1, "{top}");
    }
}
