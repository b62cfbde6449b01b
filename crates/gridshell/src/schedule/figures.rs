//! What the schedules come to, in a few figures: printed into the documents of runs and of measuring.

use super::group::count;
use super::{Members, Nodes, Panels};
use serde::Serialize;

/// Bars of a histogram.
const BARS: usize = 20;

/// Figures of one grid beside the paper's measures. Lengths in metres.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Figures {
    /// Members of a group differ in length by at most this, metres.
    pub length_tolerance: f64,
    /// Nodes of a group differ in their angles by at most this, degrees.
    pub angle_tolerance_deg: f64,
    /// Lengths of the members as they are built.
    pub length: LengthFigures,
    /// The panels.
    pub panel: PanelFigures,
    /// Angles between neighbouring panels, without sign, degrees.
    pub fold_deg: Spread,
    /// Angles of the panels at the nodes, degrees.
    pub angle_deg: Spread,
    /// Twist of the nodes along the members, without sign, degrees.
    pub twist_deg: Spread,
    /// Number of nodes that differ within the angle tolerance.
    pub distinct_nodes: usize,
    /// Share of the lines' bending at regular nodes inside that the surface's curvature alone makes: the floor of
    /// delta over delta. None where nothing bends.
    pub curvature_share: Option<f64>,
    /// Gauss curvature: sum of the angle defects inside, degrees.
    pub gauss_curvature_deg: f64,
}

/// Member lengths.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct LengthFigures {
    /// All members together, metres.
    pub total: f64,
    /// Their spread, metres.
    #[serde(flatten)]
    pub spread: Spread,
    /// Number of groups within the length tolerance.
    pub groups: usize,
}

/// Panel areas.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PanelFigures {
    /// All panels together, square metres.
    pub total_area: f64,
    /// Spread of their areas, square metres.
    pub area: Spread,
    /// Spread of their shapes q.
    pub shape: Spread,
    /// Number of panels that differ within the length tolerance; a panel and its mirror image differ.
    pub distinct: usize,
}

/// How values spread.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// Least.
    pub min: f64,
    /// Greatest.
    pub max: f64,
    /// Standard deviation.
    pub deviation: f64,
    /// How many values lie where.
    pub histogram: Histogram,
}

/// Counts of values in bars of the same width from the least to the greatest value.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Histogram {
    /// Where the first bar begins.
    pub from: f64,
    /// Where the last bar ends.
    pub to: f64,
    /// Values in each bar.
    pub counts: Vec<usize>,
}

impl Figures {
    /// What these schedules come to.
    pub(super) fn new(
        nodes: &Nodes,
        members: &Members,
        panels: &Panels,
        length_tolerance: f64,
        angle_tolerance_deg: f64,
    ) -> Figures {
        let bend: f64 = nodes.bend_deg.iter().flatten().sum();
        let curvature: f64 = nodes.curvature_bend_deg.iter().flatten().sum();
        let inside = nodes.defect_deg.iter().zip(&nodes.boundary).filter(|(_, b)| !**b);
        Figures {
            length_tolerance,
            angle_tolerance_deg,
            length: LengthFigures {
                total: members.length.iter().sum(),
                spread: Spread::of(members.length.iter().copied()),
                groups: count(&members.group),
            },
            panel: PanelFigures {
                total_area: panels.area.iter().sum(),
                area: Spread::of(panels.area.iter().copied()),
                shape: Spread::of(panels.shape.iter().copied()),
                distinct: count(&panels.group),
            },
            fold_deg: Spread::of(members.fold_deg.iter().flatten().map(|f| f.abs())),
            angle_deg: Spread::of(panels.angles_deg.iter().flatten().copied()),
            twist_deg: Spread::of(members.twist_deg.iter().map(|t| t.abs())),
            distinct_nodes: count(&nodes.group),
            curvature_share: (bend > 1e-9).then(|| curvature / bend),
            gauss_curvature_deg: inside.map(|(defect, _)| defect).sum(),
        }
    }
}

impl Spread {
    /// The spread of these values; all zero without any.
    pub fn of(values: impl Iterator<Item = f64>) -> Spread {
        let values: Vec<f64> = values.collect();
        if values.is_empty() {
            return Spread::default();
        }
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares: f64 = values.iter().map(|x| (x - mean) * (x - mean)).sum();
        let min = values.iter().copied().fold(f64::INFINITY, f64::min);
        let max = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Spread {
            mean,
            min,
            max,
            deviation: (squares / (n - 1.0).max(1.0)).sqrt(),
            histogram: Histogram::of(&values, min, max),
        }
    }
}

impl Histogram {
    /// The values counted between `from` and `to`.
    pub fn of(values: &[f64], from: f64, to: f64) -> Histogram {
        let mut counts = vec![0; BARS];
        let width = (to - from) / BARS as f64;
        for x in values {
            let bar = if width > 0.0 { ((x - from) / width) as usize } else { 0 };
            counts[bar.min(BARS - 1)] += 1;
        }
        Histogram { from, to, counts }
    }
}
