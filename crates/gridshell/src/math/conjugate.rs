//! Conjugate gradients for symmetric positive (semi-)definite systems over pairs of unknowns, given by what
//! they do to a vector.

use super::chunks::{sum, sweep};
use glam::DVec2;

/// A linear map: what it makes of the first vector is written to the second.
pub(crate) trait Map: Fn(&[DVec2], &mut [DVec2]) {}
impl<F: Fn(&[DVec2], &mut [DVec2])> Map for F {}

/// Improve `x` by at most `steps` steps on A x = b; gives the steps made.
///
/// `apply` multiplies by A, `precondition` by something near its inverse, `residual` is b - A x at the start.
/// Ends when r . M r has fallen to `enough`, which is told the first one, or where `go_on` says no.
pub(crate) fn conjugate_gradients(
    x: &mut [DVec2],
    mut residual: Vec<DVec2>,
    apply: impl Map,
    precondition: impl Map,
    enough: impl Fn(f64) -> f64,
    steps: usize,
    go_on: impl Fn() -> bool,
) -> usize {
    let n = x.len();
    let mut z = vec![DVec2::ZERO; n];
    precondition(&residual, &mut z);
    let mut p = z.clone();
    let mut ap = vec![DVec2::ZERO; n];
    let mut rz = product(&residual, &z);
    let enough = enough(rz);
    for step in 0..steps {
        if rz <= enough || !go_on() {
            return step;
        }
        apply(&p, &mut ap);
        let curvature = product(&p, &ap);
        // Rounding (or a direction that A leaves alone) can bring it to nothing.
        if curvature.is_nan() || curvature <= 0.0 {
            return step;
        }
        let alpha = rz / curvature;
        add(x, &p, alpha);
        add(&mut residual, &ap, -alpha);
        precondition(&residual, &mut z);
        let next = product(&residual, &z);
        let beta = next / rz;
        rz = next;
        sweep(&mut p, |first, piece| {
            for (p, z) in piece.iter_mut().zip(&z[first..]) {
                *p = *z + *p * beta;
            }
        });
    }
    steps
}

/// x += a d.
fn add(x: &mut [DVec2], d: &[DVec2], a: f64) {
    sweep(x, |first, piece| {
        for (x, d) in piece.iter_mut().zip(&d[first..]) {
            *x += *d * a;
        }
    });
}

/// The inner product.
pub(crate) fn product(a: &[DVec2], b: &[DVec2]) -> f64 {
    sum(a.len(), |r| {
        let both = a[r.clone()].iter().zip(&b[r]);
        let sum: DVec2 = both.map(|(p, q)| *p * *q).sum();
        sum.x + sum.y
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_system_is_solved_in_as_many_steps_as_it_has_unknowns() {
        // A = [[4, 1], [1, 3]] for each of two right sides: b = (1, 2) gives x = (1/11, 7/11).
        let apply = |v: &[DVec2], y: &mut [DVec2]| {
            y[0] = v[0] * 4.0 + v[1];
            y[1] = v[0] + v[1] * 3.0;
        };
        let precondition = |v: &[DVec2], y: &mut [DVec2]| {
            y[0] = v[0] / 4.0;
            y[1] = v[1] / 3.0;
        };
        let mut x = [DVec2::ZERO; 2];
        let right = vec![DVec2::splat(1.0), DVec2::splat(2.0)];
        conjugate_gradients(&mut x, right, apply, precondition, |_| 0.0, 2, || true);
        assert!((x[0] - 1.0 / 11.0).length() < 1e-14 && (x[1] - 7.0 / 11.0).length() < 1e-14);
    }
}
