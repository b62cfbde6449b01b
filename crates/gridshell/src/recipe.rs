//! All options of all stages: one struct that every face of gridshell shares.
//!
//! A recipe is data: it is read from TOML, printed into every output, and together with the surface and
//! the program's version it determines the grid bit for bit.

use crate::error::{Error, Result};
use crate::math::digits::three;
use serde::{Deserialize, Serialize};

/// Everything that determines a grid on a given surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Recipe {
    /// Wanted member length l0 in metres; None takes it from `nodes`, or a sensible one.
    pub edge_length: Option<f64>,
    /// Wanted number of nodes; used when `edge_length` is None.
    pub nodes: Option<usize>,
    /// Which parts of a model of several separate ones.
    pub part: Parts,
    /// Of all parts, those that are left out, by their numbers; a run adds the ones that no grid could be laid on, so that
    /// it is repeated without them.
    pub skip_parts: Vec<usize>,
    /// Whether a grid is laid although a part of the file that counts could not be read
    /// ([`Source::losses`](crate::surface::Source::losses)).
    pub accept_losses: bool,
    /// How the wanted length varies over the surface.
    pub size: Size,
    /// Direction that one family of lines is to follow where the shape allows.
    pub direction: Direction,
    /// Symmetry of the surface that the grid is to have too.
    pub symmetry: Symmetry,
    /// Seed of every random choice.
    pub seed: u64,
    /// How much work to put in.
    pub effort: Effort,
    /// Grids made side by side, of which the one of highest merit is kept; None: as many as suit the effort and
    /// the number of nodes.
    pub candidates: Option<usize>,
    /// Boundary vertices where the boundary turns by more than this are corners (fixed nodes), degrees.
    pub corner_angle_deg: f64,
    /// Edges where the surface turns by more than this are creases that members follow, degrees; 180 finds none.
    pub feature_angle_deg: f64,
    /// Whether a mesh that is coarse for the grid gives way to a smooth surface through its vertices. Boundary and
    /// creases are smooth between their corners.
    pub smooth_input: bool,
    /// Polylines on the surface that members follow: their points, metres.
    pub guides: Vec<Vec<[f64; 3]>>,
    /// Points on the surface that are nodes, metres.
    pub anchors: Vec<[f64; 3]>,
    /// What the border is worth. From 0 on, panels and members at the border weigh more against the lines inside
    /// ([`Recipe::border_weight`]). Above 0.5 rows of members follow the borders that the lattice lies nearly
    /// parallel to ([`Recipe::row_angle`]), at 1 all borders.
    pub border: f64,
    /// Whether a grid that is not valid is given all the same, marked, instead of an error.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub keep_invalid: bool,
    /// Options of packing.
    pub pack: Pack,
    /// Options of regularizing.
    pub regularize: Regularize,
    /// Options of relaxing.
    pub relax: Relax,
    /// Options of measuring.
    pub measure: Measure,
}

/// How the wanted length varies over the surface. It changes by no more than about a quarter from a member to the
/// next one, whatever is asked for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub enum Size {
    /// One length everywhere.
    Uniform,
    /// Shorter where the surface bends more.
    Curvature {
        /// Shortest and longest length; 1 stands for the root mean square curvature.
        #[serde(default = "Size::default_range")]
        range: [f64; 2],
        /// The length goes as curvature to the power of minus half of this: at 1 panels are everywhere about as far
        /// off the surface, at 0 lengths are uniform.
        #[serde(default = "Size::default_strength")]
        strength: f64,
    },
    /// Blended smoothly from lengths at points. With an edge length or a number of nodes only their proportions
    /// count, without either they are metres.
    Points {
        /// x, y, z, length.
        points: Vec<[f64; 4]>,
    },
}

/// Direction that one family of lines is to follow.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub enum Direction {
    /// Any will do.
    Any,
    /// The same everywhere, laid into the surface.
    Vector {
        /// Its components.
        xyz: [f64; 3],
    },
    /// Blended smoothly from vectors at points.
    Points {
        /// x, y, z, and the vector's components.
        points: Vec<[f64; 6]>,
    },
    /// That of the longest stretch of the boundary between two corners.
    Boundary,
}

impl Size {
    /// By curvature, as much as suits most shapes.
    pub fn curvature() -> Size {
        Size::Curvature { range: Size::default_range(), strength: Size::default_strength() }
    }

    fn default_range() -> [f64; 2] {
        [0.6, 1.6]
    }

    fn default_strength() -> f64 {
        1.0
    }

    fn validate(&self) -> Result<()> {
        match self {
            Size::Uniform => Ok(()),
            Size::Curvature { range, strength } => {
                within("size.range", range[0], 0.05, 1.0)?;
                within("size.range", range[1], 1.0, 20.0)?;
                within("size.strength", *strength, 0.0, 4.0)
            }
            Size::Points { points } => {
                within("the number of size.points", points.len() as f64, 1.0, MOST_POINTS)?;
                for p in points {
                    coordinates("size.points", p)?;
                    within("a length of size.points", p[3], 1e-9, 1e9)?;
                }
                Ok(())
            }
        }
    }
}

impl Direction {
    fn validate(&self) -> Result<()> {
        let nonzero = |v: &[f64]| {
            let length = v.iter().map(|x| x * x).sum::<f64>().sqrt();
            within("the length of a direction's vector", length, 1e-9, 1e12)
        };
        match self {
            Direction::Any | Direction::Boundary => Ok(()),
            Direction::Vector { xyz } => {
                coordinates("direction.xyz", xyz)?;
                nonzero(xyz)
            }
            Direction::Points { points } => {
                within("the number of direction.points", points.len() as f64, 1.0, MOST_POINTS)?;
                for p in points {
                    coordinates("direction.points", p)?;
                    nonzero(&p[3..])?;
                }
                Ok(())
            }
        }
    }
}

/// Lengths or directions given at more points than this are refused: blending takes their number cubed.
const MOST_POINTS: f64 = 2000.0;

fn coordinates(name: &str, values: &[f64]) -> Result<()> {
    values.iter().try_for_each(|&x| within(&format!("a number of {name}"), x, -1e12, 1e12))
}

/// A symmetry that a grid is to have; written `none`, `auto`, `x`, `y`, `xy`, or a number of turns. Axes and planes are
/// vertical and go through where the surface has them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "String")]
pub enum Symmetry {
    /// None.
    None,
    /// The largest that the surface has.
    Auto,
    /// The mirror plane perpendicular to x.
    X,
    /// The mirror plane perpendicular to y.
    Y,
    /// Both.
    Xy,
    /// The turn by a full turn over this number.
    Turns(u32),
}

/// A symmetry or a part as recipes have it.
#[derive(Deserialize)]
#[serde(untagged)]
enum Written {
    Number(u32),
    Name(String),
}

impl TryFrom<Written> for Symmetry {
    type Error = Error;

    fn try_from(written: Written) -> Result<Symmetry> {
        match written {
            Written::Number(n) => n.to_string().parse(),
            Written::Name(name) => name.parse(),
        }
    }
}

impl std::str::FromStr for Symmetry {
    type Err = Error;

    fn from_str(text: &str) -> Result<Symmetry> {
        match (text, text.parse()) {
            ("none", _) => Ok(Symmetry::None),
            ("auto", _) => Ok(Symmetry::Auto),
            ("x", _) => Ok(Symmetry::X),
            ("y", _) => Ok(Symmetry::Y),
            ("xy", _) => Ok(Symmetry::Xy),
            (_, Ok(n)) if (2..=MOST_TURNS).contains(&n) => Ok(Symmetry::Turns(n)),
            _ => Err(Error::Option(format!(
                "no symmetry {text:?}: it must be none, auto, x, y, xy, or a number of turns from 2 to {MOST_TURNS}"
            ))),
        }
    }
}

impl std::fmt::Display for Symmetry {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Symmetry::None => f.write_str("none"),
            Symmetry::Auto => f.write_str("auto"),
            Symmetry::X => f.write_str("x"),
            Symmetry::Y => f.write_str("y"),
            Symmetry::Xy => f.write_str("xy"),
            Symmetry::Turns(n) => write!(f, "{n}"),
        }
    }
}

impl From<Symmetry> for String {
    fn from(symmetry: Symmetry) -> String {
        symmetry.to_string()
    }
}

/// Which parts of a model a grid is laid on; written `one`, `all`, or a part's number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "String")]
pub enum Parts {
    /// The only one; several are an error that lists them.
    One,
    /// All: one grid of several pieces.
    All,
    /// The part of this number, counted from 1.
    Number(usize),
}

impl TryFrom<Written> for Parts {
    type Error = Error;

    fn try_from(written: Written) -> Result<Parts> {
        match written {
            Written::Number(n) => n.to_string().parse(),
            Written::Name(name) => name.parse(),
        }
    }
}

impl std::str::FromStr for Parts {
    type Err = Error;

    fn from_str(text: &str) -> Result<Parts> {
        match (text, text.parse()) {
            ("one", _) => Ok(Parts::One),
            ("all", _) => Ok(Parts::All),
            (_, Ok(n)) if n > 0 => Ok(Parts::Number(n)),
            _ => Err(Error::Option(format!(
                "no part {text:?}: it must be all, or a number from 1 on as `inspect` lists them"
            ))),
        }
    }
}

impl From<Parts> for String {
    fn from(parts: Parts) -> String {
        match parts {
            Parts::One => "one".into(),
            Parts::All => "all".into(),
            Parts::Number(n) => n.to_string(),
        }
    }
}

/// A grid of more turns has too narrow parts.
const MOST_TURNS: u32 = 12;

/// How much work to put into a grid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Effort {
    /// Quick, to choose the rest by: few candidates, no polish.
    Draft,
    /// What a grid is usually worth.
    #[default]
    Standard,
    /// Twice the candidates and three times the polish.
    Best,
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
    /// Trials of the search of one grid at most: keeps large grids within seconds.
    pub most_trials: usize,
    /// Grids searched side by side; the best is kept.
    pub candidates: usize,
    /// Heats of polishing: how many candidates, the best, come through to it, and trials per irregular node.
    pub heats: Vec<[usize; 2]>,
    /// Trials of one grid in one heat at most.
    pub most_polish: usize,
    /// Weight w of the residual R in the search's energy, sum of (l / l0 - 1)^2 + w R.
    pub residual_weight: f64,
    /// First and last temperature of the search, in units of that energy.
    pub temperature: [f64; 2],
}

/// The methods of regularizing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum RegularizeMethod {
    /// Algorithm 1 of the paper.
    Paper,
    /// Annealed search over edge operations with local relaxation.
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
    /// Members of a group differ in length by at most this, metres; None takes a two hundredth of the mean length.
    pub length_tolerance: Option<f64>,
    /// Nodes of a group differ in their angles by at most this, degrees.
    pub angle_tolerance_deg: f64,
}

impl Measure {
    /// Take over the tolerances that are given: of lengths, metres, and of angles, degrees.
    pub fn count_alike(&mut self, length: Option<f64>, angle_deg: Option<f64>) {
        self.length_tolerance = length.or(self.length_tolerance);
        self.angle_tolerance_deg = angle_deg.unwrap_or(self.angle_tolerance_deg);
    }
}

impl std::str::FromStr for Effort {
    type Err = Error;

    fn from_str(name: &str) -> Result<Effort> {
        match name {
            "draft" => Ok(Effort::Draft),
            "standard" => Ok(Effort::Standard),
            "best" => Ok(Effort::Best),
            _ => {
                Err(Error::Option(format!("no effort {name:?}; there are: draft, standard, best")))
            }
        }
    }
}

impl Default for Recipe {
    fn default() -> Self {
        Recipe {
            edge_length: None,
            nodes: None,
            skip_parts: Vec::new(),
            accept_losses: false,
            size: Size::Uniform,
            direction: Direction::Any,
            symmetry: Symmetry::None,
            part: Parts::One,
            seed: 1,
            effort: Effort::Standard,
            candidates: None,
            corner_angle_deg: 30.0,
            feature_angle_deg: 40.0,
            smooth_input: false,
            guides: Vec::new(),
            anchors: Vec::new(),
            border: 0.25,
            keep_invalid: false,
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
            settled: 1e-3,
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
            trials: 2000,
            most_trials: 60_000,
            candidates: 16,
            heats: vec![[12, 30], [4, 120], [3, 320]],
            most_polish: 18_000,
            residual_weight: 0.6,
            temperature: [0.15, 0.03],
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
        Measure { lambda: 0.9, length_tolerance: None, angle_tolerance_deg: 1.0 }
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
                recipe.pack.settled = 1e-4;
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

impl Recipe {
    /// Weight of the lengths of members that touch the border against others: 1 to 5.
    pub fn border_weight(&self) -> f64 {
        1.0 + 4.0 * self.border
    }

    /// Rows follow the borders that the lattice is off by at most this angle, radians; None where there are no
    /// rows.
    pub fn row_angle(&self) -> Option<f64> {
        // A lattice has a line within thirty degrees of any direction.
        (self.border > 0.5).then_some((2.0 * self.border - 1.0) * std::f64::consts::FRAC_PI_6)
    }
}

/// More nodes than this are refused: time and memory would run out first.
const MAX_NODES: f64 = 2e6;

impl Recipe {
    /// Check every value at the door.
    ///
    /// # Errors
    /// [`Error::Option`] naming the first value out of range, and the range.
    pub fn validate(&self) -> Result<()> {
        let positive = |name: &str, value: f64| within(name, value, f64::MIN_POSITIVE, f64::MAX);
        if let Some(l0) = self.edge_length {
            positive("edge_length", l0)?;
        }
        if let Some(nodes) = self.nodes {
            within("nodes", nodes as f64, 3.0, MAX_NODES)?;
        }
        self.size.validate()?;
        self.direction.validate()?;
        self.validate_symmetry()?;
        within("corner_angle_deg", self.corner_angle_deg, 0.0, 180.0)?;
        within("feature_angle_deg", self.feature_angle_deg, 1.0, 180.0)?;
        let mut fixed = self.guides.iter().flatten().chain(&self.anchors).flatten();
        if let Some(x) = fixed.find(|x| !x.is_finite()) {
            let what = format!("guides and anchors hold the coordinate {x}: give finite ones");
            return Err(Error::Option(what));
        }
        if let Some(i) = self.guides.iter().position(|g| g.len() < 2) {
            return Err(Error::Option(format!("guide {} needs two points or more", i + 1)));
        }
        within("border", self.border, 0.0, 1.0)?;
        within("measure.lambda", self.measure.lambda, 0.0, 1.0)?;
        within("measure.length_tolerance", self.measure.length_tolerance.unwrap_or(0.0), 0.0, 1e9)?;
        within("measure.angle_tolerance_deg", self.measure.angle_tolerance_deg, 0.0, 180.0)?;

        let pack = &self.pack;
        within("pack.k_n", pack.k_n, 0.1, 10.0)?;
        within("pack.diameter", pack.diameter, 0.5, 3.0)?;
        positive("pack.k_b", pack.k_b)?;
        positive("pack.k_c", pack.k_c)?;
        positive("pack.k_f", pack.k_f)?;
        positive("pack.xi", pack.xi)?;
        positive("pack.settled", pack.settled)?;
        within("pack.draws", pack.draws as f64, 1.0, 1e6)?;

        if let Some(candidates) = self.candidates {
            within("candidates", candidates as f64, 1.0, 1e3)?;
        }
        within("regularize.node_range", self.regularize.node_range, 0.0, 1.0)?;
        within("regularize.residual_weight", self.regularize.residual_weight, 0.0, 1e3)?;
        let [hot, cold] = self.regularize.temperature;
        positive("regularize.temperature", hot)?;
        positive("regularize.temperature", cold)?;
        within("regularize.candidates", self.regularize.candidates as f64, 1.0, 1e4)?;
        within("relax.straightness", self.relax.straightness, 0.0, 100.0)?;
        positive("relax.settled", self.relax.settled)
    }

    /// Refuse what need not be symmetric beside a symmetry.
    fn validate_symmetry(&self) -> Result<()> {
        if let Symmetry::Turns(n) = self.symmetry {
            within("symmetry", f64::from(n), 2.0, f64::from(MOST_TURNS))?;
        }
        let given = [
            (!self.guides.is_empty(), "guides"),
            (!self.anchors.is_empty(), "anchors"),
            (self.direction != Direction::Any, "a direction"),
            (matches!(self.size, Size::Points { .. }), "lengths at points"),
        ];
        match given.iter().find(|g| g.0) {
            Some((_, what)) if self.symmetry != Symmetry::None => Err(Error::Option(format!(
                "{what} cannot be given together with a symmetry: leave out one of the two"
            ))),
            _ => Ok(()),
        }
    }

    /// Check that members of `edge_length` metres on a surface of `area` square metres make a grid of a
    /// size that can be worked with.
    ///
    /// # Errors
    /// [`Error::Option`] with the least and the largest edge length for this surface.
    pub fn check_edge_length(edge_length: f64, area: f64) -> Result<()> {
        // Every node of the lattice takes two panels' area.
        let per_node = 3f64.sqrt() / 2.0;
        let least = (area / (per_node * MAX_NODES)).sqrt();
        // A single panel.
        let largest = (2.0 * area / per_node).sqrt();
        if (least..=largest).contains(&edge_length) {
            return Ok(());
        }
        Err(Error::Option(format!(
            "an edge length of {edge_length} m does not suit a surface of {} m2: \
             choose one between {} and {} m",
            three(area),
            three(least),
            three(largest)
        )))
    }
}

/// Refuse a value outside `low..=high`; NaN is outside of everything.
fn within(name: &str, value: f64, low: f64, high: f64) -> Result<()> {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    let range = match (low == f64::MIN_POSITIVE, high == f64::MAX) {
        (true, true) => "positive and finite".to_owned(),
        _ => format!("between {low} and {high}"),
    };
    Err(Error::Option(format!("{name} is {value}: it must be {range}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_named_recipe_is_valid() {
        for (name, _) in Recipe::METHODS {
            Recipe::named(name).and_then(|r| r.validate()).expect(name);
        }
    }

    #[test]
    fn lengths_that_are_no_lengths_are_refused_by_name() {
        for edge_length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let error = Recipe { edge_length: Some(edge_length), ..Recipe::default() }.validate();
            assert!(
                error.is_err_and(|e| e.to_string().starts_with("edge_length is")),
                "{edge_length}"
            );
        }
    }

    #[test]
    fn counts_beyond_reason_are_refused() {
        for nodes in [0, 2, 2_000_001, usize::MAX] {
            assert!(
                Recipe { nodes: Some(nodes), ..Recipe::default() }.validate().is_err(),
                "{nodes}"
            );
        }
    }

    #[test]
    fn an_edge_length_must_suit_the_surface() {
        // 100 m2: 2 million nodes take 100 / (0.866 * 2e6), so members of 7.6 mm.
        assert!(Recipe::check_edge_length(0.0077, 100.0).is_ok());
        assert!(Recipe::check_edge_length(0.0075, 100.0).is_err());
        // One equilateral panel of 100 m2 has sides of 15.197 m.
        assert!(Recipe::check_edge_length(15.19, 100.0).is_ok());
        assert!(Recipe::check_edge_length(15.20, 100.0).is_err());
    }

    #[test]
    fn an_unknown_method_lists_the_known_ones() {
        let error = Recipe::named("magic").expect_err("no such method");
        assert!(error.to_string().contains("default, paper"));
    }
}
