//! Multigrid by smoothed aggregation (Vanek, Mandel & Brezina, *Algebraic multigrid by smoothed aggregation*,
//! 1996) for Laplacians of weighted graphs, as a preconditioner of conjugate gradients: the number of steps
//! does not grow with the graph.
//!
//! Vertices are gathered in aggregates of a vertex and its neighbours; on the next level each is one vertex.
//! A cycle smooths by Gauss-Seidel forwards, corrects on the next level, and smooths backwards, so that it is
//! symmetric.

use super::sparse::{Row, Sparse};
use glam::DVec2;

/// Levels end below this many vertices: there the system is solved by elimination.
const SMALL: usize = 60;
/// Most levels; each has at most half the vertices of the last.
const MOST_LEVELS: usize = 30;
/// Two vertices belong together when their weight is at least this share of their mean diagonal.
const STRONG: f64 = 0.03;
/// Damping of the smoothed prolongation: 4/3 over the largest eigenvalue of D^-1 A, which is at most 2.
const DAMPING: f64 = 2.0 / 3.0;
/// A Laplacian alone leaves constants undetermined: this share of the diagonal holds them on the last level.
const HOLD: f64 = 1e-8;
/// A vertex in no aggregate: it is fixed, or stands alone.
const ALONE: u32 = u32::MAX;

/// A hierarchy for one matrix.
pub(crate) struct Multigrid {
    levels: Vec<Level>,
    /// Lower triangle of the last level's Cholesky factor, row by row.
    factor: Vec<Vec<f64>>,
}

struct Level {
    matrix: Sparse,
    /// Over the diagonal.
    inverse: Vec<f64>,
    /// From the next level to this one, and back; None on the last level.
    transfer: Option<[Sparse; 2]>,
}

impl Multigrid {
    /// The hierarchy of a symmetric matrix, all of whose rows have a positive diagonal. A row with nothing but
    /// its diagonal is a fixed vertex.
    pub fn new(matrix: Sparse) -> Multigrid {
        let mut levels = vec![Level::new(matrix)];
        while let Some(level) = levels.last_mut() {
            if level.matrix.rows() <= SMALL || levels.len() >= MOST_LEVELS {
                break;
            }
            let level = levels.last_mut().expect("begun with one");
            let (aggregate, count) = aggregates(&level.matrix);
            if count == 0 || 2 * count > level.matrix.rows() {
                break;
            }
            let prolong = level.prolongation(&aggregate, count);
            let restrict = prolong.transposed(count);
            let coarse = restrict.times(&level.matrix.times(&prolong, count), count);
            level.transfer = Some([prolong, restrict]);
            levels.push(Level::new(coarse));
        }
        let last = &levels[levels.len() - 1].matrix;
        let factor = if last.rows() <= SMALL { cholesky(last) } else { Vec::new() };
        Multigrid { levels, factor }
    }

    /// The matrix itself times `x`.
    pub fn apply(&self, x: &[DVec2], y: &mut [DVec2]) {
        let matrix = &self.levels[0].matrix;
        super::chunks::sweep(y, |first, piece| {
            for (k, y) in piece.iter_mut().enumerate() {
                *y = matrix.row_times(first + k, x);
            }
        });
    }

    /// One cycle for the residual `r`: about the inverse times it.
    pub fn cycle(&self, r: &[DVec2], x: &mut [DVec2]) {
        self.descend(0, r, x);
    }

    fn descend(&self, l: usize, r: &[DVec2], x: &mut [DVec2]) {
        x.fill(DVec2::ZERO);
        let level = &self.levels[l];
        let Some([prolong, restrict]) = &level.transfer else {
            if self.factor.is_empty() {
                level.smooth_forwards(r, x);
                level.smooth_backwards(r, x);
            } else {
                substitute(&self.factor, r, x);
            }
            return;
        };
        level.smooth_forwards(r, x);
        let left: Vec<DVec2> = (0..x.len()).map(|i| r[i] - level.matrix.row_times(i, x)).collect();
        let below: Vec<DVec2> =
            (0..restrict.rows()).map(|i| restrict.row_times(i, &left)).collect();
        let mut correction = vec![DVec2::ZERO; below.len()];
        self.descend(l + 1, &below, &mut correction);
        for (i, x) in x.iter_mut().enumerate() {
            *x += prolong.row_times(i, &correction);
        }
        level.smooth_backwards(r, x);
    }
}

impl Level {
    fn new(matrix: Sparse) -> Level {
        let diagonal = |i: usize| matrix.row(i).filter(|e| e.0 == i).map(|e| e.1).sum::<f64>();
        let inverse = (0..matrix.rows()).map(|i| 1.0 / diagonal(i)).collect();
        Level { matrix, inverse, transfer: None }
    }

    fn smooth(&self, i: usize, r: &[DVec2], x: &mut [DVec2]) {
        x[i] += (r[i] - self.matrix.row_times(i, x)) * self.inverse[i];
    }

    fn smooth_forwards(&self, r: &[DVec2], x: &mut [DVec2]) {
        (0..x.len()).for_each(|i| self.smooth(i, r, x));
    }

    fn smooth_backwards(&self, r: &[DVec2], x: &mut [DVec2]) {
        (0..x.len()).rev().for_each(|i| self.smooth(i, r, x));
    }

    /// (1 - w D^-1 A) times the map that gives every vertex its aggregate's value.
    fn prolongation(&self, aggregate: &[u32], count: usize) -> Sparse {
        let mut prolong = Sparse::new();
        let mut row = Row::new(count);
        for i in 0..aggregate.len() {
            if aggregate[i] != ALONE {
                row.add(&mut prolong, aggregate[i], 1.0);
                for (j, a) in self.matrix.row(i).filter(|e| aggregate[e.0] != ALONE) {
                    row.add(&mut prolong, aggregate[j], -DAMPING * a * self.inverse[i]);
                }
            }
            prolong.end_row();
        }
        prolong
    }
}

/// The aggregate of each vertex, and how many there are.
fn aggregates(matrix: &Sparse) -> (Vec<u32>, usize) {
    let n = matrix.rows();
    let diagonal: Vec<f64> =
        (0..n).map(|i| matrix.row(i).filter(|e| e.0 == i).map(|e| e.1).sum()).collect();
    let strong = |i: usize| {
        let diagonal = &diagonal;
        let is_strong = move |e: &(usize, f64)| {
            e.0 != i && -e.1 >= STRONG * (diagonal[i] * diagonal[e.0]).sqrt()
        };
        matrix.row(i).filter(is_strong).map(|e| e.0)
    };
    let mut aggregate = vec![ALONE; n];
    let mut count = 0;
    // A vertex all of whose neighbours are free begins an aggregate.
    for i in 0..n {
        let mut near = strong(i).peekable();
        if aggregate[i] != ALONE || near.peek().is_none() || near.any(|j| aggregate[j] != ALONE) {
            continue;
        }
        aggregate[i] = count;
        strong(i).for_each(|j| aggregate[j] = count);
        count += 1;
    }
    // The rest join a neighbour that was gathered then, or gather what is left.
    let first = aggregate.clone();
    for i in 0..n {
        if aggregate[i] == ALONE
            && let Some(j) = strong(i).find(|&j| first[j] != ALONE)
        {
            aggregate[i] = first[j];
        }
    }
    for i in 0..n {
        if aggregate[i] != ALONE || strong(i).next().is_none() {
            continue;
        }
        aggregate[i] = count;
        for j in strong(i) {
            if aggregate[j] == ALONE {
                aggregate[j] = count;
            }
        }
        count += 1;
    }
    (aggregate, count as usize)
}

/// Lower triangular factor of a small matrix, held a little where it is singular.
fn cholesky(matrix: &Sparse) -> Vec<Vec<f64>> {
    let n = matrix.rows();
    let mut full = vec![vec![0.0; n]; n];
    for (i, row) in full.iter_mut().enumerate() {
        for (j, a) in matrix.row(i) {
            row[j] += if i == j { a * (1.0 + HOLD) } else { a };
        }
    }
    let mut factor: Vec<Vec<f64>> = Vec::with_capacity(n);
    for i in 0..n {
        let mut row = vec![0.0; i + 1];
        for j in 0..=i {
            let done: f64 =
                (0..j).map(|k| row[k] * if i == j { row[k] } else { factor[j][k] }).sum();
            let rest = full[i][j] - done;
            // Rounding may eat what holds the last one.
            row[j] = if i == j {
                rest.max(HOLD * full[i][i]).max(f64::MIN_POSITIVE).sqrt()
            } else {
                rest / factor[j][j]
            };
        }
        factor.push(row);
    }
    factor
}

/// Solve by the factor and its transpose.
fn substitute(factor: &[Vec<f64>], r: &[DVec2], x: &mut [DVec2]) {
    for i in 0..x.len() {
        let done: DVec2 = (0..i).map(|k| x[k] * factor[i][k]).sum();
        x[i] = (r[i] - done) / factor[i][i];
    }
    for i in (0..x.len()).rev() {
        let done: DVec2 = (i + 1..x.len()).map(|k| x[k] * factor[k][i]).sum();
        x[i] = (x[i] - done) / factor[i][i];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::conjugate::conjugate_gradients;

    /// The Laplacian of a square of `side` by `side` vertices; the first one fixed where asked for.
    fn square(side: usize) -> Sparse {
        let mut matrix = Sparse::new();
        let mut row = Row::new(side * side);
        for i in 0..side * side {
            let (x, y) = (i % side, i / side);
            row.add(&mut matrix, i as u32, 0.0);
            let mut join = |there: bool, j: usize| {
                if there {
                    row.add(&mut matrix, i as u32, 1.0);
                    row.add(&mut matrix, j as u32, -1.0);
                }
            };
            join(x > 0, i.wrapping_sub(1));
            join(x + 1 < side, i + 1);
            join(y > 0, i.wrapping_sub(side));
            join(y + 1 < side, i + side);
            matrix.end_row();
        }
        matrix
    }

    #[test]
    fn number_of_steps_does_not_grow_with_the_graph() {
        for side in [20, 150] {
            let n = side * side;
            let multigrid = Multigrid::new(square(side));
            let mut rng = fastrand::Rng::with_seed(1);
            let mut truth: Vec<DVec2> = (0..n).map(|_| DVec2::new(rng.f64(), rng.f64())).collect();
            let mean = truth.iter().sum::<DVec2>() / n as f64;
            for v in &mut truth {
                *v -= mean;
            }
            let mut right = vec![DVec2::ZERO; n];
            multigrid.apply(&truth, &mut right);
            let mut x = vec![DVec2::ZERO; n];
            let apply = |v: &[DVec2], y: &mut [DVec2]| multigrid.apply(v, y);
            let cycle = |v: &[DVec2], y: &mut [DVec2]| multigrid.cycle(v, y);
            let steps = conjugate_gradients(
                &mut x,
                right,
                apply,
                cycle,
                |first| 1e-16 * first,
                40,
                || true,
            );
            assert!(steps < 25, "{steps} steps for {n}");
            let mean = x.iter().sum::<DVec2>() / n as f64;
            let off = x.iter().zip(&truth).map(|(a, b)| (*a - mean - *b).length());
            let off = off.fold(0.0, f64::max);
            assert!(off < 1e-5, "{off}");
        }
    }

    #[test]
    fn a_cycle_is_symmetric() {
        let multigrid = Multigrid::new(square(30));
        let mut rng = fastrand::Rng::with_seed(2);
        let mut any =
            || -> Vec<DVec2> { (0..900).map(|_| DVec2::new(rng.f64() - 0.5, 0.0)).collect() };
        let (a, b) = (any(), any());
        let (mut ma, mut mb) = (any(), any());
        multigrid.cycle(&a, &mut ma);
        multigrid.cycle(&b, &mut mb);
        let dot = |p: &[DVec2], q: &[DVec2]| p.iter().zip(q).map(|(p, q)| p.dot(*q)).sum::<f64>();
        assert!((dot(&a, &mb) - dot(&b, &ma)).abs() < 1e-6 * dot(&a, &ma).abs());
    }
}
