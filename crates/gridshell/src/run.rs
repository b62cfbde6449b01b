//! What a run gives: every stage's grid and quality, and the document that every face of gridshell prints.
//!
//! Serialised, a [`Run`] is the document `gridshell.run/1`; the grids themselves are left out of it.

use crate::error::Error;
use crate::grid::Grid;
use crate::math::digits::at_least;
use crate::recipe::{self, Recipe};
use crate::schedule::{Figures, Schedule};
use crate::stages::measure::{Border, IrregularNode, Quality};
use crate::surface::{Loss, Model, Origin, Sewing, Smoothing, Surface};
use crate::validity::{self, Fault};
use crate::words;
use glam::DVec3;
use serde::Serialize;
use std::sync::Arc;

/// Name and version of the run document.
pub const SCHEMA: &str = "gridshell.run/1";

/// All that came of one run. Metres.
#[derive(Clone, Debug, Serialize)]
pub struct Run {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// Version of this library.
    pub version: &'static str,
    /// Seed of every random choice.
    pub seed: u64,
    /// Unit of all lengths: `m`.
    pub units: &'static str,
    /// The design surface.
    pub surface: SurfaceSummary,
    /// Member length l0 that was aimed at, metres.
    pub edge_length: f64,
    /// The recipe, complete.
    pub recipe: Recipe,
    /// The symmetry that the grid has; None where none was asked for or found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub symmetry: Option<SymmetryReport>,
    /// The pieces of the grid, where it has one on each of several parts; else empty.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<PartReport>,
    /// The parts that have no grid because none could be laid there; else empty.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub failed: Vec<PartFailure>,
    /// The candidates, the one that was kept first and the others by how far they came.
    pub candidates: Vec<CandidateReport>,
    /// The stages in their order.
    pub stages: Vec<StageReport>,
    /// Measures of the final grid.
    pub quality: Quality,
    /// Figures beside them: lengths, areas, folds, angles, twist, kinds.
    pub figures: Figures,
    /// The irregular nodes that remain.
    pub irregular: Vec<IrregularNode>,
    /// Whether the grid keeps all that is promised of every grid.
    pub valid: bool,
    /// What is wrong with it: nothing, unless the recipe keeps grids that are not valid.
    pub faults: Vec<Fault>,
    /// What the user should know: faults, repaired input, stages that did not converge, limits that were met.
    pub warnings: Vec<String>,
    /// Whether a limit or a signal stopped it early; the grid is then the best so far.
    pub stopped: bool,
    /// Where the coordinates of all grids have their origin in those of the surface's file.
    #[serde(skip)]
    pub origin: Origin,
    /// The final grid.
    #[serde(skip)]
    pub grid: Arc<Grid>,
    /// Its nodes, members and panels one by one.
    #[serde(skip)]
    pub schedule: Arc<Schedule>,
}

impl Run {
    /// What is wrong with the grid, in one sentence; None if it is valid.
    pub fn invalid(&self) -> Option<String> {
        (!self.valid).then(|| validity::summary(&self.faults))
    }
}

/// One piece of a grid with a piece on each part of a model.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PartReport {
    /// The part, counted from 1.
    pub number: usize,
    /// Its nodes are those from this one on ...
    pub first_node: usize,
    /// ... so many.
    pub nodes: usize,
    /// Area of the part, square metres.
    pub area: f64,
    /// Fluency Q of its grid; None when it is infinite.
    pub fluency: Option<f64>,
    /// The symmetry that its grid has, if one was asked for and found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub symmetry: Option<SymmetryReport>,
}

/// A part of a model that no grid could be laid on, while others have one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PartFailure {
    /// The part, counted from 1.
    pub number: usize,
    /// What is wrong with it.
    pub why: String,
}

impl PartFailure {
    /// As a warning.
    pub fn told(&self) -> String {
        format!("part {} has no grid: {}", self.number, self.why)
    }
}

/// One part of a model: faces that hang together.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PartSummary {
    /// Counted from 1.
    pub number: usize,
    /// Number of patches, or of the mesh's faces.
    pub faces: usize,
    /// Area in square metres; 0 where it is not a surface.
    pub area: f64,
    /// Number of boundary loops.
    pub loops: usize,
    /// Least and largest coordinates, metres.
    #[serde(rename = "box")]
    pub bounds: Bounds,
    /// The file's objects that it is made of, where known.
    pub objects: Vec<String>,
    /// Why no surface could be made of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fault: Option<String>,
}

impl PartSummary {
    /// Part `number` of `model` in a few figures: these faces, and the surface made of them or why there is none.
    pub fn new(
        number: usize,
        faces: &[u32],
        model: &Model,
        surface: std::result::Result<&Surface, &Error>,
    ) -> PartSummary {
        PartSummary {
            number,
            faces: faces.len(),
            area: surface.map_or(0.0, |s| s.area),
            loops: surface.map_or(0, |s| s.loops.len()),
            bounds: surface.map_or(Bounds::of(&[]), Bounds::of_surface),
            objects: model.objects_of(faces),
            fault: surface.err().map(ToString::to_string),
        }
    }

    /// As a line of a list.
    pub fn told(&self) -> String {
        let [faces, loops] =
            [(self.faces, "face"), (self.loops, "loop")].map(|(n, s)| words::counted(n, s));
        let mut text = format!("{}: {faces}, ", self.number);
        if let Some(fault) = &self.fault {
            text += &format!("no surface: {fault}");
        } else {
            let [x, y, z] =
                [0, 1, 2].map(|k| f64::midpoint(self.bounds.min[k], self.bounds.max[k]));
            let area = at_least(3, self.area);
            text += &format!("{area} m2, {loops}, about ({x:.2}, {y:.2}, {z:.2})");
        }
        if !self.objects.is_empty() {
            text += &format!(", {}", self.objects.join(", "));
        }
        text
    }
}

/// The symmetry of a grid.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SymmetryReport {
    /// Horizontal unit normals x, y of its vertical mirror planes.
    pub mirrors: Vec<[f64; 2]>,
    /// Number of turns, the one by nothing included: 1 for mirrors only.
    pub rotations: u32,
    /// x, y of the vertical axis, or of a point on the mirror plane, metres.
    pub centre: [f64; 2],
    /// Nodes of the part that all others are images of.
    pub part_nodes: usize,
}

impl SymmetryReport {
    /// As people say it.
    pub fn told(&self) -> String {
        let turns = match self.rotations {
            1 => None,
            n => Some(format!("{n} turns")),
        };
        let mirrors = match self.mirrors.len() {
            0 => None,
            1 => Some("1 mirror plane".to_owned()),
            n => Some(format!("{n} mirror planes")),
        };
        // Not -0.000.
        let [x, y] = self.centre.map(|x| (x * 1e3).round() / 1e3 + 0.0);
        let parts: Vec<String> = turns.into_iter().chain(mirrors).collect();
        format!("{} at ({x:.3}, {y:.3})", parts.join(" and "))
    }
}

/// One of the candidates that a grid was chosen from, as it was when it was left behind (before relaxing).
#[derive(Clone, Debug, Serialize)]
pub struct CandidateReport {
    /// The part that it was for, where there are several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub part: Option<usize>,
    /// Its seed, derived from the run's.
    pub seed: u64,
    /// `lattice` or `random`.
    pub start: recipe::Start,
    /// Heats of polishing that it came through.
    pub heats: usize,
    /// What candidates are ranked by: fluency, held back by the guards of length spread, border and worst parts.
    pub merit: f64,
    /// Fluency Q; None when it is infinite.
    pub fluency: Option<f64>,
    /// Average nodal degree residual mu.
    pub mu: f64,
    /// Mean angle fluency index, degrees.
    pub delta_deg: f64,
    /// Length spread r.
    pub cv: f64,
    /// Mean member length over the wanted one.
    pub mean_length_ratio: f64,
    /// Mean shape of the panels at the border, and length spread of its members.
    pub border: Border,
    /// Its grid, on its part of the surface: of several parts that part, of a symmetric surface the one that the others
    /// are images of.
    #[serde(skip)]
    pub grid: Grid,
}

/// What one stage did.
#[derive(Clone, Debug, Serialize)]
pub struct StageReport {
    /// `pack`, `triangulate`, `regularize` or `relax`.
    pub name: &'static str,
    /// Time it took.
    pub seconds: f64,
    /// Whether it came to its own end rather than to a limit.
    pub converged: bool,
    /// Measures of its grid; None where there is none yet.
    pub quality: Option<Quality>,
    /// What it did, for the user.
    pub notes: Vec<String>,
    /// Its grid.
    #[serde(skip)]
    pub grid: Option<Grid>,
}

/// A design surface in a few figures. Metres.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SurfaceSummary {
    /// Built-in name or file stem.
    pub name: String,
    /// Area in square metres.
    pub area: f64,
    /// Number of exact patches; 0 for a mesh.
    pub patches: usize,
    /// Number of boundary loops.
    pub loops: usize,
    /// Number of corners on all loops.
    pub corners: usize,
    /// The loops one by one.
    pub boundaries: Vec<Boundary>,
    /// Least and largest coordinates.
    #[serde(rename = "box")]
    pub bounds: Bounds,
    /// Length of the file's unit in metres.
    pub unit_in_metres: f64,
    /// Largest distance between an edge's end and its vertex; how well the file's patches join.
    pub gap: f64,
    /// Largest distance between the boundary's edge curves and the patches they bound.
    pub edge_gap: f64,
    /// What sewing found; null for built-in surfaces and meshes.
    pub sewing: Option<Sewing>,
    /// What smoothing did; null where the surface was taken as it is.
    pub smoothing: Option<Smoothing>,
    /// What was skipped or repaired while reading.
    pub notes: Vec<String>,
    /// What of the file's geometry could not be read.
    pub losses: Vec<Loss>,
}

/// One boundary loop.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Boundary {
    /// Length, metres.
    pub length: f64,
    /// Number of corners.
    pub corners: usize,
}

/// An axis-parallel box.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bounds {
    /// Least x, y, z.
    pub min: [f64; 3],
    /// Largest x, y, z.
    pub max: [f64; 3],
}

impl SurfaceSummary {
    /// The figures of `surface`, which was made from `model`.
    pub fn new(model: &Model, surface: &Surface) -> SurfaceSummary {
        let (unit_in_metres, gap, notes) = match model {
            Model::Brep(brep) => (brep.unit_in_metres, largest_gap(brep), &brep.notes),
            Model::Mesh(mesh) => (1.0, 0.0, &mesh.notes),
        };
        let (sewing, smoothing) = match model {
            Model::Brep(brep) => (brep.sewing, None),
            Model::Mesh(mesh) => (None, mesh.smoothing),
        };
        let boundaries: Vec<_> = surface
            .loops
            .iter()
            .map(|l| Boundary { length: l.length(), corners: l.corners.len() })
            .collect();
        SurfaceSummary {
            name: surface.name.clone(),
            area: surface.area,
            patches: surface.shapes.len(),
            loops: boundaries.len(),
            corners: boundaries.iter().map(|b| b.corners).sum(),
            boundaries,
            bounds: Bounds::of_surface(surface),
            unit_in_metres,
            gap,
            edge_gap: edge_gap(surface),
            sewing,
            smoothing,
            notes: notes.clone(),
            losses: model.source().losses.clone(),
        }
    }
}

impl Bounds {
    /// The box of the exact surface, in the coordinates of its file.
    pub fn of_surface(surface: &Surface) -> Bounds {
        let [min, max] = surface.extent().map(|p| surface.origin.world(p).to_array());
        Bounds { min, max }
    }

    /// The box of these points; zero without any.
    pub fn of(points: &[DVec3]) -> Bounds {
        let Some(&first) = points.first() else { return Bounds { min: [0.0; 3], max: [0.0; 3] } };
        let (min, max) = points.iter().fold((first, first), |(lo, hi), &p| (lo.min(p), hi.max(p)));
        Bounds { min: min.to_array(), max: max.to_array() }
    }
}

/// Over all vertices of the loops, which stand on the exact edge curves.
fn edge_gap(surface: &Surface) -> f64 {
    let off = surface.loops.iter().flat_map(|chain| {
        chain.vertices.iter().zip(&chain.arc).map(|(&v, &s)| {
            surface.deviation(&chain.surface_point(s), surface.carrier.points[v as usize])
        })
    });
    let size = surface.carrier.points.iter().fold(0.0_f64, |s, p| s.max(p.abs().max_element()));
    below_rounding(off.fold(0.0, f64::max), size)
}

fn largest_gap(brep: &crate::surface::Brep) -> f64 {
    let gaps = brep.edges.iter().flat_map(|e| {
        [0, 1].map(|i| e.curve.point(e.range[i]).distance(brep.vertices[e.ends[i] as usize]))
    });
    let size = brep.vertices.iter().fold(0.0_f64, |s, v| s.max(v.abs().max_element()));
    below_rounding(gaps.fold(0.0, f64::max), size)
}

/// A gap, or none where coordinates up to `size` cannot tell it from none.
fn below_rounding(gap: f64, size: f64) -> f64 {
    /// Steps of the last digit that evaluating a curve may add up to.
    const STEPS: f64 = 64.0;
    if gap <= STEPS * f64::EPSILON * size { 0.0 } else { gap }
}
