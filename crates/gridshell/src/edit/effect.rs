//! What an edit does to a grid, in figures.

use crate::merit::Sums;
use serde::Serialize;

/// Figures of a whole grid.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Figures {
    /// R of Eq. 14.
    pub residual: f64,
    /// mu of Eq. 27.
    pub mu: f64,
    /// Q of Eq. 31; None for a perfect lattice.
    pub fluency: Option<f64>,
    /// Nodes whose adjusted degree is not six.
    pub irregular: usize,
    /// All nodes.
    pub nodes: usize,
    /// Q, held back by what spoils a grid of a fine Q: see [`crate::merit`].
    pub merit: f64,
}

/// The figures before an edit and after it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Effect {
    /// Before.
    pub before: Figures,
    /// After.
    pub after: Figures,
}

impl Figures {
    pub(super) fn new(sums: &Sums, irregular: usize, nodes: usize, lambda: f64) -> Figures {
        Figures {
            residual: sums.residual,
            mu: sums.mu(),
            fluency: sums.fluency(lambda),
            irregular,
            nodes,
            merit: sums.merit(lambda),
        }
    }
}

impl Effect {
    /// Change of R; below zero is better.
    pub fn residual(&self) -> f64 {
        self.after.residual - self.before.residual
    }

    /// Change of mu; below zero is better.
    pub fn mu(&self) -> f64 {
        self.after.mu - self.before.mu
    }

    /// Change of Q; above zero is better. None where one of the two is a perfect lattice.
    pub fn fluency(&self) -> Option<f64> {
        Some(self.after.fluency? - self.before.fluency?)
    }

    /// Change of the number of irregular nodes.
    pub fn irregular(&self) -> i64 {
        self.after.irregular as i64 - self.before.irregular as i64
    }

    /// Change of the merit, by which edits are ranked; above zero is better.
    pub fn gain(&self) -> f64 {
        self.after.merit - self.before.merit
    }
}
