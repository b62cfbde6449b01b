//! The figures of a run: where they stand in its document, and how they are shown.

use crate::laid::Laid;
use serde_json::Value;

/// One figure of a grid.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Figure {
    /// Number of nodes.
    Nodes,
    /// Q.
    Fluency,
    /// mu.
    Mu,
    /// r.
    Spread,
    /// Mean q.
    Shape,
    /// Least q.
    LeastShape,
    /// Irregular nodes inside.
    Irregular,
    /// Mean q of the panels at the border.
    BorderShape,
    /// r of the members at the border.
    BorderSpread,
    /// How far the mean length is from l0, over l0.
    OffLength,
    /// Shortest member over l0.
    Shortest,
    /// Longest member over l0.
    Longest,
    /// Area of the panels over that of the surface.
    AreaRatio,
    /// Members that leap between sheets.
    Bridging,
    /// Panels folded over.
    Folded,
    /// Largest distance of a node from the surface, over l0.
    OffSurface,
    /// Largest distance of a border node from the boundary, over l0.
    OffBoundary,
    /// Time from start to end.
    Seconds,
}

use Figure::{
    AreaRatio, BorderShape, BorderSpread, Bridging, Fluency, Folded, Irregular, LeastShape,
    Longest, Mu, Nodes, OffBoundary, OffLength, OffSurface, Seconds, Shape, Shortest, Spread,
};

impl Figure {
    /// All of them, as the table has them.
    pub const ALL: [Figure; 18] = [
        Nodes,
        Fluency,
        Mu,
        Spread,
        Shape,
        LeastShape,
        Irregular,
        BorderShape,
        BorderSpread,
        OffLength,
        Shortest,
        Longest,
        AreaRatio,
        Bridging,
        Folded,
        OffSurface,
        OffBoundary,
        Seconds,
    ];

    /// Its name in the table.
    pub fn title(self) -> &'static str {
        match self {
            Nodes => "nodes",
            Fluency => "Q",
            Mu => "mu",
            Spread => "r",
            Shape => "mean q",
            LeastShape => "least q",
            Irregular => "irregular inside",
            BorderShape => "mean q at the border",
            BorderSpread => "r at the border",
            OffLength => "mean length off l0, %",
            Shortest => "shortest / l0",
            Longest => "longest / l0",
            AreaRatio => "area ratio",
            Bridging => "bridging members",
            Folded => "folded panels",
            OffSurface => "off the surface / l0",
            OffBoundary => "off the boundary / l0",
            Seconds => "seconds",
        }
    }

    /// Whether more is better.
    pub fn more_is_better(self) -> bool {
        matches!(self, Fluency | Shape | LeastShape | BorderShape | Shortest | AreaRatio)
    }

    /// Its value in a run; NaN where the run has none.
    pub fn of(self, laid: &Laid) -> f64 {
        let q = &laid.document["quality"];
        let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
        match self {
            Nodes => number(&q["nodes"]),
            // Without a number it is infinite.
            Fluency => q["fluency"].as_f64().unwrap_or(f64::INFINITY),
            Mu => number(&q["mu"]),
            Spread => number(&q["edge_length"]["cv"]),
            Shape => number(&q["shape"]["mean"]),
            LeastShape => number(&q["shape"]["min"]),
            Irregular => number(&q["irregular"]["interior"]),
            BorderShape => number(&q["border"]["shape_mean"]),
            BorderSpread => number(&q["border"]["edge_length_cv"]),
            OffLength => {
                let wanted = number(&laid.document["edge_length"]);
                (number(&q["edge_length"]["mean"]) / wanted - 1.0).abs()
            }
            Shortest => number(&q["min_length_ratio"]),
            Longest => number(&q["max_length_ratio"]),
            AreaRatio => number(&q["area_ratio"]),
            Bridging => number(&q["bridging_members"]),
            Folded => number(&q["folded_panels"]),
            OffSurface => number(&q["surface_deviation"]),
            OffBoundary => number(&q["boundary_deviation"]),
            Seconds => laid.seconds,
        }
    }

    /// A value of it in the table.
    pub fn show(self, value: f64) -> String {
        match self {
            _ if value.is_nan() => "-".to_owned(),
            Nodes | Irregular | Bridging | Folded => format!("{value:.0}"),
            Fluency | LeastShape | Shortest | Longest => format!("{value:.2}"),
            Mu | Spread => format!("{value:.3}"),
            Shape | BorderShape | BorderSpread | AreaRatio => format!("{value:.4}"),
            OffLength => format!("{:.1}", 100.0 * value),
            OffSurface | OffBoundary if value == 0.0 => "0".to_owned(),
            OffSurface | OffBoundary => format!("{value:.0e}"),
            Seconds => format!("{value:.1}"),
        }
    }

    /// A limit on it in the table: as few digits as it was given with.
    pub fn show_limit(self, limit: f64) -> String {
        match self {
            OffLength | OffSurface | OffBoundary => self.show(limit),
            _ => limit.to_string(),
        }
    }

    /// Whether `value` reaches `limit`.
    pub fn reaches(self, value: f64, limit: f64) -> bool {
        if self.more_is_better() { value >= limit } else { value <= limit }
    }

    /// The middle one and the worst of values.
    pub fn median_and_worst(self, values: &[f64]) -> [f64; 2] {
        let mut sorted = values.to_vec();
        sorted.sort_by(f64::total_cmp);
        if sorted.is_empty() {
            return [f64::NAN; 2];
        }
        let worst = if self.more_is_better() { sorted[0] } else { sorted[sorted.len() - 1] };
        let (low, high) = (sorted[(sorted.len() - 1) / 2], sorted[sorted.len() / 2]);
        [f64::midpoint(low, high), worst]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_worst_is_the_least_where_more_is_better() {
        assert_eq!(Fluency.median_and_worst(&[3.0, 5.0, 4.0]), [4.0, 3.0]);
        assert_eq!(Mu.median_and_worst(&[0.3, 0.1]), [0.2, 0.3]);
        assert!(Mu.median_and_worst(&[])[0].is_nan());
    }

    #[test]
    fn a_figure_that_is_missing_reaches_no_bar() {
        for figure in Figure::ALL {
            assert!(!figure.reaches(f64::NAN, 0.0), "{}", figure.title());
        }
    }
}
