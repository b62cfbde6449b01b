//! Least squares in a few unknowns.

/// The unknowns for which the rows, numbers times unknowns, come nearest to their values; each unknown is held to zero
/// by its `rein`, as a share of what the rows weigh. Zero where the rows say nothing.
pub(crate) fn least_squares<const N: usize>(
    rows: impl Iterator<Item = ([f64; N], f64)>,
    rein: [f64; N],
) -> [f64; N] {
    let mut a = [[0.0; N]; N];
    let mut b = [0.0; N];
    for (row, value) in rows {
        for i in 0..N {
            for j in 0..N {
                a[i][j] += row[i] * row[j];
            }
            b[i] += row[i] * value;
        }
    }
    let weight: f64 = (0..N).map(|i| a[i][i]).sum();
    for i in 0..N {
        a[i][i] += rein[i] * weight;
    }
    eliminate(a, b)
}

/// Solve a symmetric, positive system.
fn eliminate<const N: usize>(mut a: [[f64; N]; N], mut b: [f64; N]) -> [f64; N] {
    for k in 0..N {
        for i in k + 1..N {
            let factor = if a[k][k] > 0.0 { a[i][k] / a[k][k] } else { 0.0 };
            for j in k..N {
                a[i][j] -= factor * a[k][j];
            }
            b[i] -= factor * b[k];
        }
    }
    for k in (0..N).rev() {
        let known: f64 = (k + 1..N).map(|j| a[k][j] * b[j]).sum();
        b[k] = if a[k][k] > 0.0 { (b[k] - known) / a[k][k] } else { 0.0 };
    }
    b
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_parabola_is_found_and_what_no_row_tells_is_zero() {
        let rows =
            [-1.0, 0.5, 2.0, 3.0].map(|x: f64| ([1.0, x, x * x, 0.0], 2.0 - x + 3.0 * x * x));
        let found = least_squares(rows.into_iter(), [0.0; 4]);
        for (got, wanted) in found.into_iter().zip([2.0, -1.0, 3.0, 0.0]) {
            assert!((got - wanted).abs() < 1e-12, "{found:?}");
        }
    }
}
