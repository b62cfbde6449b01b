//! Sparse matrices by compressed rows.

use glam::DVec2;

/// A sparse matrix; entries of a row stand together.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sparse {
    /// Where each row begins, and the end.
    pub starts: Vec<usize>,
    /// Column of each entry.
    pub columns: Vec<u32>,
    /// Value of each entry.
    pub values: Vec<f64>,
}

/// Collects the entries of one row, adding up those of the same column.
pub(crate) struct Row {
    /// Where each column's entry stands in the matrix under construction, if past the row's beginning.
    at: Vec<usize>,
}

impl Row {
    /// For matrices of this many columns.
    pub fn new(columns: usize) -> Row {
        Row { at: vec![usize::MAX; columns] }
    }

    /// Add to an entry of the last, still open row of `to`.
    pub fn add(&mut self, to: &mut Sparse, column: u32, value: f64) {
        let begun = to.starts[to.starts.len() - 1];
        let at = self.at[column as usize];
        if at >= begun && at < to.columns.len() && to.columns[at] == column {
            to.values[at] += value;
            return;
        }
        self.at[column as usize] = to.columns.len();
        to.columns.push(column);
        to.values.push(value);
    }
}

impl Sparse {
    /// A matrix without rows: close rows with [`end_row`](Sparse::end_row).
    pub fn new() -> Sparse {
        Sparse { starts: vec![0], ..Sparse::default() }
    }

    /// The open row is complete.
    pub fn end_row(&mut self) {
        self.starts.push(self.columns.len());
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// The entries of row `i`.
    pub fn row(&self, i: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.starts[i]..self.starts[i + 1];
        let columns = self.columns[range.clone()].iter().map(|&j| j as usize);
        columns.zip(self.values[range].iter().copied())
    }

    /// Row `i` times `x`.
    pub fn row_times(&self, i: usize, x: &[DVec2]) -> DVec2 {
        let mut sum = DVec2::ZERO;
        for (j, a) in self.row(i) {
            sum += x[j] * a;
        }
        sum
    }

    /// The transpose, of `columns` rows.
    pub fn transposed(&self, columns: usize) -> Sparse {
        let mut starts = vec![0; columns + 1];
        for &j in &self.columns {
            starts[j as usize + 1] += 1;
        }
        for j in 0..columns {
            starts[j + 1] += starts[j];
        }
        let mut next = starts.clone();
        let (mut rows, mut values) = (vec![0; self.columns.len()], vec![0.0; self.columns.len()]);
        for i in 0..self.rows() {
            for (j, a) in self.row(i) {
                rows[next[j]] = i as u32;
                values[next[j]] = a;
                next[j] += 1;
            }
        }
        Sparse { starts, columns: rows, values }
    }

    /// This matrix times another of `columns` columns.
    pub fn times(&self, other: &Sparse, columns: usize) -> Sparse {
        let mut product = Sparse::new();
        let mut row = Row::new(columns);
        for i in 0..self.rows() {
            for (j, a) in self.row(i) {
                for (k, b) in other.row(j) {
                    row.add(&mut product, k as u32, a * b);
                }
            }
            product.end_row();
        }
        product
    }
}
