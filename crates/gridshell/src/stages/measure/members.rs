//! Member lengths (Eq. 23 and 24; where lengths are to vary, over the scale wanted there), over all members and over those that touch the boundary.

use super::EdgeLength;
use crate::grid::Grid;
use crate::surface::Surface;

pub(super) struct Members {
    pub count: usize,
    pub length: EdgeLength,
    pub border_cv: f64,
}

pub(super) fn measure(grid: &Grid, surface: &Surface) -> Members {
    let mesh = &grid.mesh;
    let mut lengths = Vec::with_capacity(mesh.edge_count());
    let mut border = Vec::new();
    for (a, b) in mesh.edges() {
        let l = grid.scaled_length(surface, a, b);
        lengths.push(l);
        if mesh.is_boundary(a) || mesh.is_boundary(b) {
            border.push(l);
        }
    }
    Members {
        count: lengths.len(),
        length: statistics(&lengths),
        border_cv: statistics(&border).cv,
    }
}

fn statistics(lengths: &[f64]) -> EdgeLength {
    if lengths.is_empty() {
        return EdgeLength { mean: 0.0, min: 0.0, max: 0.0, variance: 0.0, cv: 0.0 };
    }
    let n = lengths.len() as f64;
    let mean = lengths.iter().sum::<f64>() / n;
    let squares: f64 = lengths.iter().map(|l| (l - mean) * (l - mean)).sum();
    let variance = squares / (n - 1.0).max(1.0);
    EdgeLength {
        mean,
        min: lengths.iter().copied().fold(f64::INFINITY, f64::min),
        max: lengths.iter().copied().fold(0.0, f64::max),
        variance,
        cv: if mean > 0.0 { variance.sqrt() / mean } else { 0.0 },
    }
}
