//! All options of all stages: one struct that every face of gridshell shares.
//!
//! A recipe is data: it is read from TOML, printed into every output, and together with the surface and
//! the program's version it determines the grid bit for bit.

use crate::error::{Error, Result};
use serde::{Deserialize, Serialize};

/// Everything that determines a grid on a given surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Recipe {
    /// Wanted member length l0 in metres; None takes it from `nodes`, or a sensible one.
    pub edge_length: Option<f64>,
    /// Wanted number of nodes; used when `edge_length` is None.
    pub nodes: Option<usize>,
    /// Seed of every random choice.
    pub seed: u64,
    /// Boundary vertices where the boundary turns by more than this are corners (fixed nodes), degrees.
    pub corner_angle_deg: f64,
    /// Options of packing.
    pub pack: Pack,
    /// Options of regularizing.
    pub regularize: Regularize,
    /// Options of relaxing.
    pub relax: Relax,
    /// Options of measuring.
    pub measure: Measure,
}

/// How the bubbles start and settle (Sections 4.1 and 4.2).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Pack {
    /// Where the bubbles start.
    pub start: Start,
    /// Factor k_n on the number of bubbles, Eq. 1.
    pub k_n: f64,
    /// Bubble diameter over l0; the paper takes 1.2.
    pub diameter: f64,
    /// Spring constant k_b of the bubbles, Eq. 2.
    pub k_b: f64,
    /// Spring constant k_c of the surface, Eq. 4.
    pub k_c: f64,
    /// Damping k_f, Eq. 5.
    pub k_f: f64,
    /// Damping ratio xi, Eq. 10; gives the mass.
    pub xi: f64,
    /// Settled when the largest move in a step falls below this share of l0.
    pub settled: f64,
    /// Steps after which packing gives up and says so.
    pub max_steps: usize,
    /// Lattices drawn (directions, offsets, boundary counts) when the start is `lattice`.
    pub draws: usize,
}

/// Where bubbles start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Start {
    /// Random points, as the paper does.
    Random,
    /// A triangular lattice laid on a flattening of the surface, the best of several draws.
    Lattice,
}

/// How connectivity is regularized (Section 5).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Regularize {
    /// Which method.
    pub method: RegularizeMethod,
    /// Rounds of Algorithm 1.
    pub max_rounds: usize,
    /// The node count stays within this share of its start.
    pub node_range: f64,
    /// Trials of the search per irregular node.
    pub trials: usize,
    /// Grids searched side by side; the best is kept.
    pub candidates: usize,
}

/// The methods of regularizing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RegularizeMethod {
    /// Algorithm 1 of the paper.
    Paper,
    /// Algorithm 1, then annealed search over edge operations with local relaxation.
    Search,
}

/// How nodes are relaxed (Section 6).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Relax {
    /// Which method.
    pub method: RelaxMethod,
    /// Weight of line straightness against equal lengths (method `fluent`).
    pub straightness: f64,
    /// Settled when the largest move in a step falls below this share of l0.
    pub settled: f64,
    /// Steps after which relaxing gives up and says so.
    pub max_steps: usize,
}

/// The methods of relaxing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RelaxMethod {
    /// The net-like method, Eq. 18 to 22.
    Net,
    /// Equal lengths and straight lines by Gauss-Newton.
    Fluent,
}

/// How the grid is measured (Section 7).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Measure {
    /// Weight of interior nodes, Eq. 13.
    pub lambda: f64,
}

impl Default for Recipe {
    fn default() -> Self {
        Recipe {
            edge_length: None,
            nodes: None,
            seed: 1,
            corner_angle_deg: 30.0,
            pack: Pack::default(),
            regularize: Regularize::default(),
            relax: Relax::default(),
            measure: Measure::default(),
        }
    }
}

impl Default for Pack {
    fn default() -> Self {
        Pack {
            start: Start::Lattice,
            k_n: 1.0,
            diameter: 1.2,
            k_b: 10.0,
            k_c: 100.0,
            k_f: 1.0,
            xi: 0.7,
            settled: 1e-4,
            max_steps: 5000,
            draws: 96,
        }
    }
}

impl Default for Regularize {
    fn default() -> Self {
        Regularize {
            method: RegularizeMethod::Search,
            max_rounds: 200,
            node_range: 0.1,
            trials: 4000,
            candidates: 8,
        }
    }
}

impl Default for Relax {
    fn default() -> Self {
        Relax { method: RelaxMethod::Fluent, straightness: 0.3, settled: 1e-6, max_steps: 20_000 }
    }
}

impl Default for Measure {
    fn default() -> Self {
        Measure { lambda: 0.9 }
    }
}

impl Recipe {
    /// The names that [`Recipe::named`] knows, with a line on each.
    pub const METHODS: [(&'static str, &'static str); 2] = [
        ("default", "lattice start, annealed edge operations, fluent relaxation"),
        (
            "paper",
            "the method as Wang et al. print it: random bubbles, Algorithm 1, net-like relaxation",
        ),
    ];

    /// A recipe by its method name.
    ///
    /// # Errors
    /// [`Error::Option`] listing the names when there is no such method.
    pub fn named(method: &str) -> Result<Recipe> {
        let mut recipe = Recipe::default();
        match method {
            "default" => {}
            "paper" => {
                recipe.pack.start = Start::Random;
                recipe.regularize.method = RegularizeMethod::Paper;
                recipe.relax.method = RelaxMethod::Net;
            }
            _ => {
                let names: Vec<_> = Self::METHODS.iter().map(|m| m.0).collect();
                return Err(Error::Option(format!(
                    "no method {method:?}; there are: {}",
                    names.join(", ")
                )));
            }
        }
        Ok(recipe)
    }
}
