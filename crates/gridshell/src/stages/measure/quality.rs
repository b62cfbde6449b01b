//! What measuring a grid gives: plain data, printed into every run document.

use serde::Serialize;
use std::collections::BTreeMap;

/// All measures of one grid. Lengths in metres; deviations in units of the wanted edge length.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Quality {
    /// Number of nodes.
    pub nodes: usize,
    /// Number of members.
    pub members: usize,
    /// Number of panels.
    pub panels: usize,
    /// Nodes inside.
    pub interior_nodes: usize,
    /// Nodes on the boundary.
    pub boundary_nodes: usize,
    /// Nodes - members + panels.
    pub euler_characteristic: i64,
    /// Member lengths.
    pub edge_length: EdgeLength,
    /// What they and the two ratios below stand for.
    pub lengths: Lengths,
    /// Panel shapes, q of Eq. 25: 1 is equilateral, 0 degenerate.
    pub shape: Shape,
    /// Nodes whose adjusted degree is not 6.
    pub irregular: Irregular,
    /// How many nodes have each degree.
    pub degrees: Degrees,
    /// Average nodal degree residual, Eq. 27.
    pub mu: f64,
    /// What mu cannot fall below, by topology and the boundary's angles.
    pub mu_floor: f64,
    /// Mean angle fluency index of the regular interior nodes, Eq. 30, degrees.
    pub delta_deg: f64,
    /// What the mean angle fluency index cannot fall below, by the surface's curvature, degrees.
    pub delta_floor_deg: f64,
    /// Weighted share of regular interior nodes, Eq. 32.
    pub rho: f64,
    /// Fluency Q, Eq. 31; None when it is infinite (a perfect lattice).
    pub fluency: Option<f64>,
    /// Area of the panels over that of the surface.
    pub area_ratio: f64,
    /// Largest distance of a node to the exact surface, over the wanted edge length.
    pub surface_deviation: f64,
    /// Largest distance of a boundary node to the exact boundary, over the wanted edge length.
    pub boundary_deviation: f64,
    /// Least panel angle, degrees.
    pub min_angle_deg: f64,
    /// Least member length over the wanted one.
    pub min_length_ratio: f64,
    /// Largest member length over the wanted one.
    pub max_length_ratio: f64,
    /// Mean angle between the wanted direction and the nearest member at each node inside, degrees; None where no
    /// direction is wanted.
    pub direction_deviation_deg: Option<f64>,
    /// Members that leap from sheet to sheet: their ends are further apart along the surface than
    /// straight, by more than the wanted edge length.
    pub bridging_members: usize,
    /// Panels that face against the surface, or lie folded back on a neighbour.
    pub folded_panels: usize,
    /// The same measures at the border alone.
    pub border: Border,
}

/// Statistics of the member lengths, metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EdgeLength {
    /// Mean.
    pub mean: f64,
    /// Shortest.
    pub min: f64,
    /// Longest.
    pub max: f64,
    /// s squared of Eq. 23, square metres.
    pub variance: f64,
    /// Coefficient of variation r, Eq. 24.
    pub cv: f64,
}

/// What measured lengths stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Lengths {
    /// Members as they are.
    AsBuilt,
    /// Members over what is wanted where they are, times the mean wanted length l0: lengths are to vary.
    OverLocal,
}

/// Panel shape index q, Eq. 25.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Shape {
    /// Mean.
    pub mean: f64,
    /// Worst panel.
    pub min: f64,
}

/// Counts of irregular nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Irregular {
    /// Inside.
    pub interior: usize,
    /// On the boundary.
    pub boundary: usize,
}

/// How many nodes have each degree.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Degrees {
    /// Interior nodes by degree.
    pub interior: BTreeMap<i32, usize>,
    /// Boundary nodes by adjusted degree.
    pub boundary: BTreeMap<i32, usize>,
}

/// Measures over the panels and members that touch the boundary; on a closed surface over none: 1 and 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Border {
    /// Mean shape q.
    pub shape_mean: f64,
    /// Coefficient of variation of the member lengths.
    pub edge_length_cv: f64,
}

/// A node whose adjusted degree is not 6.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct IrregularNode {
    /// Index of the node.
    pub node: u32,
    /// Position, metres.
    pub xyz: [f64; 3],
    /// Number of members at it.
    pub degree: usize,
    /// Degree plus virtual degree, Eq. 11.
    pub adjusted_degree: i32,
    /// Whether it lies on the boundary.
    pub boundary: bool,
}
