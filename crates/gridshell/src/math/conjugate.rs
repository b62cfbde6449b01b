//! Conjugate gradients for symmetric positive (semi-)definite systems given by what they do to a vector.

use std::ops::{Add, AddAssign, Div, Mul, SubAssign};

/// Improve `x` by at most `steps` steps on A x = b, preconditioned by the `diagonal` of A.
///
/// `apply` multiplies by A, `dot` is the product of two entries (entries may be vectors), `residual` is
/// b - A x at the start. Ends when the preconditioned residual has fallen to `enough`, which is told the first
/// one.
pub(crate) fn conjugate_gradients<V>(
    x: &mut [V],
    mut residual: Vec<V>,
    diagonal: &[f64],
    apply: impl Fn(&[V]) -> Vec<V>,
    dot: impl Fn(V, V) -> f64,
    enough: impl Fn(f64) -> f64,
    steps: usize,
) where
    V: Copy + Add<Output = V> + AddAssign + SubAssign + Mul<f64, Output = V> + Div<f64, Output = V>,
{
    let product = |a: &[V], b: &[V]| a.iter().zip(b).map(|(&p, &q)| dot(p, q)).sum::<f64>();
    let precondition =
        |r: &[V]| -> Vec<V> { r.iter().zip(diagonal).map(|(&v, &d)| v / d).collect() };
    let mut z = precondition(&residual);
    let mut p = z.clone();
    let mut rz = product(&residual, &z);
    let enough = enough(rz);
    for _ in 0..steps {
        if rz <= enough {
            break;
        }
        let ap = apply(&p);
        let alpha = rz / product(&p, &ap);
        for i in 0..x.len() {
            x[i] += p[i] * alpha;
            residual[i] -= ap[i] * alpha;
        }
        z = precondition(&residual);
        let next = product(&residual, &z);
        let beta = next / rz;
        rz = next;
        for i in 0..p.len() {
            p[i] = z[i] + p[i] * beta;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_system_is_solved_in_as_many_steps_as_it_has_unknowns() {
        // A = [[4, 1], [1, 3]], b = (1, 2): x = (1/11, 7/11).
        let apply = |v: &[f64]| vec![4.0 * v[0] + v[1], v[0] + 3.0 * v[1]];
        let mut x = [0.0, 0.0];
        conjugate_gradients(&mut x, vec![1.0, 2.0], &[4.0, 3.0], apply, |a, b| a * b, |_| 0.0, 2);
        assert!((x[0] - 1.0 / 11.0).abs() < 1e-14 && (x[1] - 7.0 / 11.0).abs() < 1e-14);
    }
}
