//! A smooth blend of values given at scattered points: the sum of a constant and a multiple of the distance to
//! each point, as flat as the values allow (the biharmonic spline of space; on a line, piecewise linear).

use glam::DVec3;

/// Points nearer to an earlier one than this share of the largest distance count as the same.
const SAME: f64 = 1e-9;

/// A blend of vectors.
pub(crate) struct Blend {
    /// Points and their weights.
    centres: Vec<(DVec3, DVec3)>,
    constant: DVec3,
}

impl Blend {
    /// The blend that takes these values at these points; of points at one place the first one counts.
    pub(crate) fn through(given: &[(DVec3, DVec3)]) -> Blend {
        let reach = given.iter().map(|g| g.0.distance(given[0].0)).fold(0.0, f64::max);
        let mut centres: Vec<(DVec3, DVec3)> = Vec::with_capacity(given.len());
        for g in given {
            if centres.iter().all(|c| c.0.distance(g.0) > SAME * reach) {
                centres.push(*g);
            }
        }
        let n = centres.len();
        // [distances 1; 1 0] [weights; constant] = [values; 0]
        let mut rows: Vec<(Vec<f64>, DVec3)> = centres
            .iter()
            .map(|(p, value)| {
                let distances = centres.iter().map(|(q, _)| p.distance(*q));
                (distances.chain([1.0]).collect(), *value)
            })
            .collect();
        rows.push(((0..=n).map(|k| if k < n { 1.0 } else { 0.0 }).collect(), DVec3::ZERO));
        let solution = eliminate(rows);
        for (centre, weight) in centres.iter_mut().zip(&solution) {
            centre.1 = *weight;
        }
        Blend { centres, constant: solution.last().copied().unwrap_or_default() }
    }

    /// Its value at `p`.
    pub(crate) fn at(&self, p: DVec3) -> DVec3 {
        self.centres.iter().fold(self.constant, |sum, (c, weight)| sum + *weight * c.distance(p))
    }
}

/// Gaussian elimination with the largest pivot of each column.
fn eliminate(mut rows: Vec<(Vec<f64>, DVec3)>) -> Vec<DVec3> {
    let n = rows.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| rows[i].0[k].abs().total_cmp(&rows[j].0[k].abs()));
        rows.swap(k, pivot.unwrap_or(k));
        let (above, below) = rows.split_at_mut(k + 1);
        let (row, value) = &above[k];
        for (other, other_value) in below {
            let factor = other[k] / row[k];
            if factor != 0.0 {
                for (x, y) in other[k..].iter_mut().zip(&row[k..]) {
                    *x -= factor * y;
                }
                *other_value -= *value * factor;
            }
        }
    }
    let mut solution = vec![DVec3::ZERO; n];
    for k in (0..n).rev() {
        let (row, value) = &rows[k];
        let known: DVec3 = (k + 1..n).map(|j| solution[j] * row[j]).sum();
        solution[k] = (*value - known) / row[k];
    }
    solution
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_points_blend_linearly_between_them() {
        let blend = Blend::through(&[(DVec3::ZERO, DVec3::X), (DVec3::X * 4.0, DVec3::X * 3.0)]);
        for (x, value) in [(0.0, 1.0), (1.0, 1.5), (2.0, 2.0), (4.0, 3.0)] {
            assert!((blend.at(DVec3::X * x).x - value).abs() < 1e-12, "{x}");
        }
    }

    #[test]
    fn values_are_met_and_doubled_points_do_no_harm() {
        let p = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 0.3), DVec3::X];
        let given: Vec<_> =
            p.iter().enumerate().map(|(k, &p)| (p, DVec3::splat(k as f64 % 4.0))).collect();
        let blend = Blend::through(&given);
        for (p, value) in &given[..4] {
            assert!(blend.at(*p).distance(*value) < 1e-12);
        }
        let alone = Blend::through(&given[2..3]);
        assert!(alone.at(DVec3::splat(7.0)).distance(DVec3::splat(2.0)) < 1e-12);
    }
}
