//! Exact area: |du x dv| integrated over triangles of (u, v).

use super::shape::Shape;
use glam::DVec2;

/// Gauss-Legendre places in [0, 1] and their weights, exact to degree 5.
const GAUSS: [(f64, f64); 3] = [
    (0.112_701_665_379_258_3, 5.0 / 18.0),
    (0.5, 4.0 / 9.0),
    (0.887_298_334_620_741_7, 5.0 / 18.0),
];

/// Area in m2 of the part of `shape` over a triangle of parameters. NaN marks the parameter that means
/// nothing at a pole: the triangle reaches over all values that its other corners have.
pub(in crate::surface) fn triangle(shape: &Shape, uv: [DVec2; 3]) -> f64 {
    // Collapsed square: rays from one corner to the edge across. A pole is that corner.
    let k = (0..3).find(|&k| !uv[k].is_finite()).unwrap_or(0);
    let (tip, a, b) = (uv[k], uv[(k + 1) % 3], uv[(k + 2) % 3]);
    if !a.is_finite() || !b.is_finite() {
        return 0.0;
    }
    let mut sum = 0.0;
    for (t, wt) in GAUSS {
        let far = a + (b - a) * t;
        let mut near = tip;
        let mut near_rate = DVec2::ZERO;
        for c in 0..2 {
            if tip[c].is_nan() {
                near[c] = far[c];
                near_rate[c] = b[c] - a[c];
            }
        }
        for (s, ws) in GAUSS {
            let jet = shape.jet(near + (far - near) * s);
            let by_t = near_rate * (1.0 - s) + (b - a) * s;
            sum += wt * ws * (far - near).perp_dot(by_t).abs() * jet.du.cross(jet.dv).length();
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paraboloid_over_a_triangle_agrees_with_fine_sums() {
        let shape = Shape::Height(|x, y| [0.1 * (x * x + y * y), 0.2 * x, 0.2 * y]);
        let whole = [DVec2::new(0.0, 0.0), DVec2::new(0.5, 0.1), DVec2::new(0.2, 0.6)];
        // Fine sums by the middles of 200 x 200 pieces of the same collapsed square.
        let n = 400;
        let mut sum = 0.0;
        for i in 0..n {
            for j in 0..n {
                let (s, t) =
                    ((f64::from(i) + 0.5) / f64::from(n), (f64::from(j) + 0.5) / f64::from(n));
                let p = (whole[1] * (1.0 - t) + whole[2] * t) * s;
                sum += s * (1.0 + 0.04 * p.length_squared()).sqrt();
            }
        }
        sum *= whole[1].perp_dot(whole[2]) / f64::from(n * n);
        assert!((triangle(&shape, whole) - sum).abs() < 1e-6 * sum);
    }
}
