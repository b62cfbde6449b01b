//! `gridshell measure`: the measures of a grid from a file.

use crate::Outcome;
use crate::args::Measure;
use crate::failure::Failure;
use crate::{say, table};
use gridshell::grid::Grid;
use gridshell::io::Opening;
use gridshell::recipe::Recipe;
use gridshell::run::SurfaceSummary;
use gridshell::stages::measure::{IrregularNode, Quality, irregular_nodes, measure};
use gridshell::surface::{Model, PolygonMesh, Sampling, Surface};
use gridshell::{DVec3, io};
use serde::Serialize;
use std::path::Path;

/// The document of `--json`.
#[derive(Serialize)]
struct Document {
    schema: &'static str,
    version: &'static str,
    units: &'static str,
    grid: String,
    surface: Option<SurfaceSummary>,
    /// What lengths and deviations are measured against: the mean member length, metres.
    edge_length: f64,
    quality: Quality,
    irregular: Vec<IrregularNode>,
}

/// A grid from a file, on its surface.
pub struct Opened {
    pub name: String,
    pub grid: Grid,
    pub surface: Surface,
    /// Figures of the design surface, where it is known.
    pub summary: Option<SurfaceSummary>,
    /// Mean member length, metres.
    pub edge_length: f64,
    pub notes: Vec<String>,
}

/// Open a grid, on the surface of this name or path, or by itself.
pub fn open(path: &Path, surface: Option<&str>, opening: &Opening) -> Result<Opened, Failure> {
    // Where both are given, the unit is the surface's: our grids state their own.
    let of_grid = if surface.is_some() { Opening::default() } else { opening.clone() };
    let mesh = io::read_mesh_with(path, &of_grid).map_err(Failure::of_input)?;
    let panels = panels(&mesh).map_err(|m| Failure::input(path, m))?;
    let edge_length = mean_side(&mesh.points, &panels);
    let recipe = Recipe::default();
    let (grid, surface, summary) = match surface {
        None => {
            let (grid, surface) = Grid::alone(&mesh.name, mesh.points, &panels)?;
            (grid, surface, None)
        }
        Some(name) => {
            let model = io::open_with(name, opening).map_err(Failure::of_input)?;
            let surface = sample(&model, edge_length, &recipe)?;
            let grid = Grid::from_panels(mesh.points, &panels, &surface)?;
            let summary = SurfaceSummary::new(&model, &surface);
            (grid, surface, Some(summary))
        }
    };
    Ok(Opened { name: mesh.name, grid, surface, summary, edge_length, notes: mesh.notes })
}

pub fn run(args: &Measure) -> Result<Outcome, Failure> {
    let opening = args.reading.opening();
    let opened = open(&args.grid, args.surface.as_deref(), &opening)?;
    let Opened { name, grid, surface, summary, edge_length, notes } = opened;
    let quality = measure(&grid, &surface, edge_length, &Recipe::default().measure);
    if args.json {
        say::json(&Document {
            schema: "gridshell.measure/1",
            version: env!("CARGO_PKG_VERSION"),
            units: "m",
            grid: name,
            surface: summary,
            edge_length,
            irregular: irregular_nodes(&grid),
            quality,
        })?;
    } else {
        say::result(&table::grid(&name, &quality))?;
        for n in &notes {
            say::note(&format!("note: {n}"));
        }
    }
    Ok(Outcome::Done)
}

/// Sampled as finely as for generating a grid of this edge length.
fn sample(model: &Model, edge_length: f64, recipe: &Recipe) -> Result<Surface, Failure> {
    let corner_angle = recipe.corner_angle_deg.to_radians();
    let sampling =
        Sampling { max_edge: edge_length / 2.0, chord_error: edge_length * 2e-3, corner_angle };
    Ok(model.surface(&sampling)?)
}

/// The faces as panels, if all are triangles.
fn panels(mesh: &PolygonMesh) -> Result<Vec<[u32; 3]>, String> {
    if mesh.faces.is_empty() {
        return Err("there are no panels in it".to_owned());
    }
    let panel = |(k, face): (usize, &Vec<u32>)| {
        <[u32; 3]>::try_from(face.as_slice()).map_err(|_| {
            format!("face {k} has {} corners: a grid has triangular panels only", face.len())
        })
    };
    mesh.faces.iter().enumerate().map(panel).collect()
}

/// Mean length of the panels' sides, metres. Inner members count twice; good enough for a yardstick.
fn mean_side(points: &[DVec3], panels: &[[u32; 3]]) -> f64 {
    let side =
        |t: &[u32; 3], k: usize| points[t[k] as usize].distance(points[t[(k + 1) % 3] as usize]);
    let sum: f64 = panels.iter().map(|t| (0..3).map(|k| side(t, k)).sum::<f64>()).sum();
    sum / (3.0 * panels.len() as f64)
}
