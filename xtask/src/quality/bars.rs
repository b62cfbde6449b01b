//! What the grids are held against: the six cases with their bars and aims, the bars of every case, and the
//! further surfaces.

use super::figure::Figure::{
    self, AreaRatio, BorderShape, BorderSpread, Bridging, Fluency, Folded, Irregular, LeastShape,
    Longest, Mu, OffBoundary, OffLength, OffSurface, Seconds, Shape, Shortest, Spread,
};

/// A limit on a figure: whether at least or at most, the figure knows.
#[derive(Clone, Copy)]
pub struct Bar {
    /// The figure it is on.
    pub figure: Figure,
    /// What must be reached.
    pub limit: f64,
    /// Where we want to be.
    pub aim: Option<f64>,
}

/// A case with bars of its own.
pub struct Case {
    /// Name in the table; with `.step` that of the file.
    pub name: &'static str,
    /// The built-in surface like it.
    pub builtin: &'static str,
    /// Wanted length of the members, metres.
    pub edge_length: f64,
    /// Its own bars.
    pub bars: [Bar; 6],
}

const fn bar(figure: Figure, limit: f64) -> Bar {
    Bar { figure, limit, aim: None }
}

const fn aimed(figure: Figure, limit: f64, aim: f64) -> Bar {
    Bar { figure, limit, aim: Some(aim) }
}

/// Fluency and its aim, mu, r, mean q, least q, irregular nodes inside.
const fn bars(q: [f64; 2], mu: f64, r: f64, mean_q: f64, least_q: f64, irregular: f64) -> [Bar; 6] {
    [
        aimed(Fluency, q[0], q[1]),
        bar(Mu, mu),
        bar(Spread, r),
        bar(Shape, mean_q),
        bar(LeastShape, least_q),
        bar(Irregular, irregular),
    ]
}

/// The six cases, at seed 1.
pub const CASES: [Case; 6] = [
    Case {
        name: "great_court",
        builtin: "great-court",
        edge_length: 2.12,
        bars: bars([5.8, 7.0], 0.075, 0.072, 0.986, 0.60, 2.0),
    },
    Case {
        name: "roof2",
        builtin: "roof",
        edge_length: 3.1,
        bars: bars([4.4, 5.5], 0.11, 0.090, 0.976, 0.60, 0.0),
    },
    Case {
        name: "roof1",
        builtin: "facade",
        edge_length: 24.4,
        bars: bars([3.8, 4.8], 0.12, 0.095, 0.978, 0.65, 0.0),
    },
    Case {
        name: "dome",
        builtin: "dome",
        edge_length: 1.0,
        bars: bars([4.6, 5.2], 0.095, 0.058, 0.990, 0.60, 6.0),
    },
    Case {
        name: "saddle",
        builtin: "saddle",
        edge_length: 1.0,
        bars: bars([7.0, 9.0], 0.08, 0.072, 0.985, 0.65, 1.0),
    },
    Case {
        name: "fold",
        builtin: "fold",
        edge_length: 1.0,
        bars: bars([3.5, 5.0], 0.12, 0.100, 0.980, 0.60, 2.0),
    },
];

/// What every case is held against.
pub const EVERY: [Bar; 11] = [
    aimed(BorderShape, 0.95, 0.975),
    aimed(BorderSpread, 0.13, 0.09),
    bar(OffLength, 0.03),
    bar(Shortest, 0.6),
    bar(Longest, 1.5),
    bar(AreaRatio, 0.985),
    bar(Bridging, 0.0),
    bar(Folded, 0.0),
    bar(OffSurface, 1e-6),
    bar(OffBoundary, 1e-6),
    bar(Seconds, 20.0),
];

/// Further built-in surfaces, of every shape, at their own edge lengths: long, lying over itself, with many
/// holes, with sharp tips, with an irregular outline, with two loops, overhanging, with a handle, closed, creased.
pub const FURTHER: [&str; 12] = [
    "ribbon",
    "ramp",
    "skylights",
    "tripod",
    "sail",
    "wave",
    "tower",
    "onion",
    "ring",
    "torus",
    "pleats",
    "vault",
];
