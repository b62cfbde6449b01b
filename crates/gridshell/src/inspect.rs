//! What a model is, told to a person before a grid is laid on it: where it comes from, its parts, loops, creases
//! and gaps, and the edge lengths that would suit it.
//!
//! Works on every model that has a part that is a surface: parts that are none are told with the reason.

use crate::error::{Error, Result};
use crate::job::Job;
use crate::pipeline;
use crate::recipe::Recipe;
use crate::run::{PartSummary, SurfaceSummary};
use crate::surface::parts::Offset;
use crate::surface::{Fixtures, Model, Sampling, Source, Surface};
use serde::Serialize;

/// Carrier edges over the size of a part: fine enough to count loops and corners.
const FINENESS: f64 = 1.0 / 80.0;
/// Distance between carrier and surface over the size of a part.
const CHORD_ERROR: f64 = 1e-4;
/// The same for pictures.
const SKETCH_FINENESS: f64 = 1.0 / 40.0;
const SKETCH_CHORD_ERROR: f64 = 1e-3;
/// Numbers of nodes that edge lengths are suggested for.
const SUGGESTED: [usize; 3] = [300, 1000, 3000];

/// What a model is. Metres.
#[derive(Clone, Debug, Serialize)]
pub struct Inspection {
    /// What the file says of itself.
    pub source: Source,
    /// All parts as one surface.
    pub surface: SurfaceSummary,
    /// The parts one by one.
    pub parts: Vec<PartSummary>,
    /// The creases that members would follow.
    pub creases: Vec<Crease>,
    /// Edge lengths for grids of about so many nodes.
    pub edge_lengths: Vec<Suggestion>,
}

/// A line along which the surface has a crease, between corners.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Crease {
    /// Length, metres.
    pub length: f64,
    /// Whether it leads back to where it began.
    pub closed: bool,
}

/// An edge length for a number of nodes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Suggestion {
    /// About so many nodes.
    pub nodes: usize,
    /// Member length, metres.
    pub edge_length: f64,
}

/// A coarse surface of all parts, for pictures.
pub struct Sketch {
    /// The parts side by side, their creases among the features.
    pub surface: Surface,
    /// Number of the part that each triangle of its carrier belongs to, counted from 0.
    pub part: Vec<usize>,
}

/// Tell what `model` is.
///
/// # Errors
/// [`Error::Surface`] where no part of it is a surface.
pub fn inspect(model: &Model, job: &Job) -> Result<Inspection> {
    let Pieces { mut surface, parts, .. } = pieces(model, FINENESS, CHORD_ERROR, job)?;
    let summary = SurfaceSummary::new(model, &surface);
    let suggest =
        |nodes: usize| Suggestion { nodes, edge_length: pipeline::length_for(&surface, nodes) };
    let edge_lengths = SUGGESTED.map(suggest).to_vec();
    crease(&mut surface, job)?;
    let creases = surface.features.iter();
    let creases = creases.map(|c| Crease { length: c.length(), closed: c.is_closed() }).collect();
    Ok(Inspection {
        source: model.source().clone(),
        surface: summary,
        parts,
        creases,
        edge_lengths,
    })
}

/// A coarse surface of `model` for pictures.
///
/// # Errors
/// As [`inspect`].
pub fn sketch(model: &Model, job: &Job) -> Result<Sketch> {
    let Pieces { mut surface, offsets, parts } =
        pieces(model, SKETCH_FINENESS, SKETCH_CHORD_ERROR, job)?;
    crease(&mut surface, job)?;
    let good: Vec<usize> =
        parts.iter().filter(|p| p.fault.is_none()).map(|p| p.number - 1).collect();
    let of = |t: usize| offsets.partition_point(|o| o.triangles as usize <= t) - 1;
    let part = (0..surface.carrier.triangles.len()).map(|t| good[of(t)]).collect();
    Ok(Sketch { surface, part })
}

/// All parts that are surfaces, side by side.
struct Pieces {
    surface: Surface,
    offsets: Vec<Offset>,
    parts: Vec<PartSummary>,
}

fn pieces(model: &Model, fineness: f64, chord_error: f64, job: &Job) -> Result<Pieces> {
    let corner_angle = Recipe::default().corner_angle_deg.to_radians();
    let (mut parts, mut surfaces) = (Vec::new(), Vec::new());
    for (number, faces) in (1..).zip(model.parts()) {
        let part = model.of_faces(&faces);
        let size = part.size();
        let sampling =
            Sampling { max_edge: size * fineness, chord_error: size * chord_error, corner_angle };
        let surface = part.surface(&sampling, job);
        job.check("inspecting")?;
        parts.push(PartSummary::new(number, &faces, model, surface.as_ref()));
        surfaces.extend(surface);
    }
    if surfaces.is_empty() {
        let faults: Vec<String> = parts.into_iter().filter_map(|p| p.fault).take(3).collect();
        return Err(Error::Surface(if faults.is_empty() {
            "there are no faces".into()
        } else {
            faults.join("; ")
        }));
    }
    let (surface, offsets) = Surface::side_by_side(surfaces);
    Ok(Pieces { surface, offsets, parts })
}

/// Find the creases that a grid of a thousand nodes would follow.
fn crease(surface: &mut Surface, job: &Job) -> Result<()> {
    let recipe = Recipe::default();
    let edge_length = pipeline::length_for(surface, SUGGESTED[1]);
    surface.fix(
        &Fixtures {
            crease_angle: Some(recipe.feature_angle_deg.to_radians()),
            guides: &[],
            anchors: &[],
            corner_angle: recipe.corner_angle_deg.to_radians(),
            edge_length,
        },
        job,
    )?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::{PolygonMesh, builtin};
    use glam::DVec3;

    #[test]
    fn a_roof_is_told_with_its_loops_and_lengths_that_give_so_many_nodes() {
        let told = inspect(&builtin::model("great-court").unwrap(), &Job::default()).unwrap();
        assert_eq!((told.parts.len(), told.surface.loops), (1, 2));
        assert!((told.parts[0].area / told.surface.area - 1.0).abs() < 1e-12);
        let lengths: Vec<f64> = told.edge_lengths.iter().map(|s| s.edge_length).collect();
        assert!(lengths.windows(2).all(|w| w[0] > w[1]), "{lengths:?}");
        // Equilateral panels of the length for 3,000 nodes: two to a node, a border less.
        let panels = told.surface.area / (0.433 * lengths[2].powi(2));
        assert!((5000.0..6000.0).contains(&panels), "{panels}");
    }

    #[test]
    fn triangles_of_a_sketch_know_their_part() {
        let xs = [0.0, 1.0, 4.0, 5.0];
        let points = xs.map(|x| [[x, 0.0, 0.0], [x, 1.0, 0.0]]).concat();
        let points: Vec<DVec3> = points.into_iter().map(DVec3::from).collect();
        let faces = vec![vec![0, 2, 3, 1], vec![4, 6, 7, 5]];
        let model = Model::Mesh(PolygonMesh { points, faces, ..PolygonMesh::default() });
        let told = inspect(&model, &Job::default()).unwrap();
        assert_eq!((told.parts.len(), told.surface.loops), (2, 2));
        let Sketch { surface, part } = sketch(&model, &Job::default()).unwrap();
        for (t, part) in part.iter().enumerate() {
            let x = surface.carrier.corners(t as u32).map(|p| p.x).iter().sum::<f64>() / 3.0;
            assert_eq!(*part, usize::from(x > 2.0));
        }
    }
}
