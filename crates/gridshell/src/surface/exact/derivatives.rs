//! Second derivatives of NURBS surfaces (Piegl & Tiller, *The NURBS Book*, sections 2.3 and 4.4).

use super::jet::Jet;
use super::nurbs::{Basis, MAX_DEGREE, NurbsSurface, into_domain, raise, raised_slope};
use glam::{DVec2, DVec3};

/// Value and derivatives of a surface at one (u, v).
pub(super) struct Second {
    /// Value and first derivatives.
    pub jet: Jet,
    /// Twice by u, by u and v, twice by v.
    pub bends: [DVec3; 3],
}

/// Basis functions in one direction: index of the first, then values, first and second derivatives.
struct Row {
    first: usize,
    orders: [[f64; MAX_DEGREE + 1]; 3],
}

impl NurbsSurface {
    /// Value, first and second derivatives at `uv`.
    pub(super) fn second(&self, uv: DVec2) -> Second {
        let (u, v) = (self.row(0, uv.x), self.row(1, uv.y));
        // The homogeneous sums of each pair of orders: x, y, z times weight, and weight.
        let sum = |a: usize, b: usize| {
            let (mut point, mut weight) = (DVec3::ZERO, 0.0);
            for i in 0..=self.degree[0] {
                for j in 0..=self.degree[1] {
                    let at = (u.first + i) * self.count[1] + v.first + j;
                    let share = u.orders[a][i]
                        * v.orders[b][j]
                        * self.weights.get(at).copied().unwrap_or(1.0);
                    point += self.points[at] * share;
                    weight += share;
                }
            }
            (point, weight)
        };
        let (p, w) = sum(0, 0);
        let [(pu, wu), (pv, wv)] = [sum(1, 0), sum(0, 1)];
        let [(puu, wuu), (puv, wuv), (pvv, wvv)] = [sum(2, 0), sum(1, 1), sum(0, 2)];
        let point = p / w;
        let (du, dv) = ((pu - point * wu) / w, (pv - point * wv) / w);
        Second {
            jet: Jet { point, du, dv },
            bends: [
                (puu - du * (2.0 * wu) - point * wuu) / w,
                (puv - du * wv - dv * wu - point * wuv) / w,
                (pvv - dv * (2.0 * wv) - point * wvv) / w,
            ],
        }
    }

    fn row(&self, k: usize, t: f64) -> Row {
        let (knots, degree, count) = (&self.knots[k], self.degree[k], self.count[k]);
        let closed = self.closed()[k];
        let b = Basis::at(knots, degree, count, closed, t);
        let t = into_domain(knots[degree], knots[count], closed, t);
        let second = second(knots, degree, b.first + degree, t);
        Row { first: b.first, orders: [b.value, b.slope, second] }
    }
}

/// Second derivatives of the basis functions over the knot span that begins at `span`.
fn second(knots: &[f64], degree: usize, span: usize, t: f64) -> [f64; MAX_DEGREE + 1] {
    let mut value = [0.0; MAX_DEGREE + 1];
    if degree < 2 {
        return value;
    }
    value[0] = 1.0;
    for d in 1..=degree - 2 {
        raise(&mut value, knots, span, d, t);
    }
    for d in [degree - 1, degree] {
        value = raised_slope(&value, knots, span, d);
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn second_derivatives_are_those_of_the_first() {
        let points = (0..30).map(|k| {
            let (i, j) = (f64::from(k / 6), f64::from(k % 6));
            DVec3::new(i + 0.1 * j, j, (i * 1.3 + j * j * 0.2) % 1.7)
        });
        let weights = (0..30).map(|k| 1.0 + 0.1 * f64::from(k % 7)).collect();
        let knots = [
            vec![0., 0., 0., 0., 0.4, 1., 1., 1., 1.],
            vec![-1., -1., -1., 0., 0.5, 0.5, 2., 2., 2.],
        ];
        let s = NurbsSurface::new([3, 2], knots, [5, 6], points.collect(), weights).unwrap();
        let h = 1e-6;
        for uv in [DVec2::new(0.2, -0.4), DVec2::new(0.7, 0.2), DVec2::new(0.9, 1.4)] {
            let found = s.second(uv).bends;
            let by = |step: DVec2| {
                let (a, b) = (s.jet(uv + step), s.jet(uv - step));
                [(a.du - b.du) / (2.0 * h), (a.dv - b.dv) / (2.0 * h)]
            };
            let [uu, uv_] = by(DVec2::new(h, 0.0));
            let [vu, vv] = by(DVec2::new(0.0, h));
            for (a, b) in [(found[0], uu), (found[1], uv_), (found[1], vu), (found[2], vv)] {
                assert!(a.distance(b) < 1e-6 * (1.0 + a.length()), "{a} {b}");
            }
        }
    }
}
