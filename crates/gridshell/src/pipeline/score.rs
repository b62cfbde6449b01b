//! How candidates are compared.

use crate::stages::measure::Quality;

/// The score of a grid: its fluency Q, less what is beyond the guards of length spread, worst panel, extreme
/// members, mean length and border. Higher is better; a perfect lattice scores `PERFECT`.
pub fn score(quality: &Quality) -> f64 {
    let over = |x: f64, limit: f64| (x - limit).max(0.0);
    let under = |x: f64, limit: f64| (limit - x).max(0.0);
    let fluency = quality.fluency.unwrap_or(PERFECT).min(PERFECT);
    let mean = quality.edge_length.mean / (quality.edge_length.max / quality.max_length_ratio);
    fluency
        - 25.0 * over(quality.edge_length.cv, 0.075)
        - 4.0 * under(quality.shape.min, 0.62)
        - 4.0 * under(quality.min_length_ratio, 0.62)
        - 4.0 * over(quality.max_length_ratio, 1.45)
        - 40.0 * over((mean - 1.0).abs(), 0.02)
        - 10.0 * under(quality.border.shape_mean, 0.955)
        - 5.0 * over(quality.border.edge_length_cv, 0.125)
        - 100.0 * under(quality.area_ratio, 0.985)
        - 10.0 * quality.folded_panels as f64
        - 10.0 * quality.bridging_members as f64
}

/// Stands for the infinite fluency of a perfect lattice.
pub const PERFECT: f64 = 1e3;
