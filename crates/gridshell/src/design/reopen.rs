//! A grid from a file, on its surface again.

use super::{Design, Look};
use crate::edit::Editor;
use crate::error::{Error, Result};
use crate::grid::{Grid, Place};
use crate::io::{self, Document, Follow, Opening};
use crate::job::Job;
use crate::mesh::Mesh;
use crate::pipeline;
use crate::recipe::Recipe;
use crate::run::SurfaceSummary;
use crate::structure::{Structure, Supports};
use crate::surface::{Model, PolygonMesh, Sampling, Surface};
use glam::DVec3;
use std::path::Path;
use std::sync::Arc;

/// A node of a grid file stands at its place if it is no further off than this share of the edge length.
const AT_PLACE: f64 = 1e-6;

/// How a grid's file is to be opened.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reopening {
    /// Name or path of the surface it lies on; without it the one that a `.gridshell` file refers to, else none.
    pub surface: Option<String>,
    /// How far a `.gridshell` file is followed to its surface.
    pub follow: Follow,
    /// How the surface is read, or the grid where there is none.
    pub opening: Opening,
    /// Lengths that differ by no more count as alike, metres; without it what the recipe says.
    pub length_tolerance: Option<f64>,
    /// Angles at nodes that differ by no more count as alike, degrees; without it what the recipe says.
    pub angle_tolerance_deg: Option<f64>,
}

/// A grid that was read, and the surface it lies on.
pub(super) struct Opened {
    document: Document,
    grid: Grid,
    surface: Surface,
    summary: Option<SurfaceSummary>,
    edge_length: f64,
    recipe: Recipe,
    notes: Vec<String>,
    losses: Vec<String>,
}

impl Opened {
    /// As a design: measured, within what `how` counts as alike.
    pub(super) fn measured(self, how: &Reopening, job: &Job) -> Result<Design> {
        let Opened { mut document, grid, surface, summary, edge_length, mut recipe, notes, losses } =
            self;
        recipe.measure.count_alike(how.length_tolerance, how.angle_tolerance_deg);
        let Look { quality, schedule, validity } =
            Look::at(&grid, &surface, edge_length, &recipe, job)?;
        document.panels.clone_from(&schedule.panels.nodes);
        document.invalid = (!validity.is_valid()).then(|| validity.summary());
        Ok(Design {
            document,
            grid: Arc::new(grid),
            surface: Arc::new(surface),
            summary,
            recipe,
            edge_length,
            quality,
            schedule: Arc::new(schedule),
            warnings: validity.warnings(),
            faults: validity.faults,
            structure: Structure::default(),
            run: None,
            notes,
            losses,
        })
    }
}

/// Open the grid in a file.
pub(super) fn open(path: &Path, how: &Reopening, job: &Job) -> Result<Opened> {
    match path.extension() {
        Some(e) if e.eq_ignore_ascii_case("gridshell") => open_document(path, how, job),
        _ if io::reads_mesh(path) => open_mesh(path, how, job),
        _ => Err(io::unknown(path, &format!("gridshell, {}", io::MESH_FORMATS))),
    }
}

fn open_mesh(
    path: &Path,
    Reopening { surface, opening, .. }: &Reopening,
    job: &Job,
) -> Result<Opened> {
    // Where both are given, the unit is the surface's: our grids state their own.
    let of_grid = if surface.is_some() { Opening::default() } else { opening.clone() };
    let mesh = io::read_mesh_with(path, &of_grid, job)?;
    let PolygonMesh { name, mut points, faces, mut notes, source, origin, .. } = mesh;
    let mut losses = source.told_losses();
    for p in &mut points {
        *p = origin.world(*p);
    }
    let panels = panels(path, &faces)?;
    let edge_length = mean_side(&points, &panels);
    let recipe = Recipe::default();
    let (grid, surface, summary, reference) = match surface {
        None => {
            let (grid, surface) = Grid::alone(&name, points, &panels)?;
            (grid, surface, None, None)
        }
        Some(wanted) => {
            let model = io::open_with(wanted, opening, job)?;
            let surface = sample(&model, edge_length, &recipe, job)?;
            let xyz = points.iter().map(|&p| surface.origin.local(p)).collect();
            let grid = Grid::from_panels(xyz, &panels, &surface)?;
            let summary = SurfaceSummary::new(&model, &surface);
            notes.extend_from_slice(model.notes());
            losses.extend(model.source().told_losses());
            (grid, surface, Some(summary), Some(io::reference(wanted, opening, job)?))
        }
    };
    let supports = Supports::Boundary.nodes(&grid, &surface)?;
    let document = Document {
        surface: reference,
        supports,
        ..Document::of_grid(&name, &grid, surface.origin)
    };
    Ok(Opened { document, grid, surface, summary, edge_length, recipe, notes, losses })
}

fn open_document(
    path: &Path,
    Reopening { surface, opening, follow, .. }: &Reopening,
    job: &Job,
) -> Result<Opened> {
    let mut document = io::read_document(path, job)?;
    let mut notes = Vec::new();
    let model = match (surface, &document.surface) {
        (Some(wanted), _) => {
            document.surface = Some(io::reference(wanted, opening, job)?);
            Some(io::open_with(wanted, opening, job)?)
        }
        (None, Some(reference)) => match io::open_reference(reference, path, *follow, job) {
            Ok(model) => Some(model),
            Err(e @ (Error::Stopped { .. } | Error::Memory(_))) => return Err(e),
            Err(e) => {
                notes.push(format!("{e}; the grid is taken for its own surface"));
                None
            }
        },
        (None, None) => None,
    };
    let opened = restore(document, model.as_ref(), job)?;
    notes.extend(opened.notes);
    Ok(Opened { notes, ..opened })
}

/// The grid of a document on the surface made from `model`, which is the one that it was laid on; by itself without.
///
/// # Errors
/// [`Error::Surface`] where the panels are not a manifold or the surface cannot carry them.
pub(super) fn restore(document: Document, model: Option<&Model>, job: &Job) -> Result<Opened> {
    let xyz: Vec<DVec3> = document.nodes.iter().map(|&p| p.into()).collect();
    let recipe = document.recipe.clone().unwrap_or_default();
    let edge_length = document.edge_length.unwrap_or_else(|| mean_side(&xyz, &document.panels));
    let Some(model) = model else {
        let (grid, surface) = Grid::alone(&document.name, xyz, &document.panels)?;
        let grid = with_features(grid, &document)?;
        let (notes, losses) = (Vec::new(), Vec::new());
        let summary = None;
        return Ok(Opened { document, grid, surface, summary, edge_length, recipe, notes, losses });
    };
    let model = match &document.recipe {
        Some(recipe) => &*pipeline::smoothed(model, recipe, job)?,
        None => model,
    };
    let surface = match &document.recipe {
        Some(recipe) => pipeline::surface(model, recipe, job)?.0,
        None => sample(model, edge_length, &recipe, job)?,
    };
    let summary = Some(SurfaceSummary::new(model, &surface));
    let xyz: Vec<DVec3> = xyz.into_iter().map(|p| surface.origin.local(p)).collect();
    let grid = match at_places(&document, &xyz, &surface, edge_length) {
        Some(places) => {
            let mesh = Mesh::from_triangles(xyz.len(), &document.panels)?;
            // A node far from the origin has lost its last digits in the file; its place knows them.
            let there = |((&x, place), node): ((&DVec3, &Place), &[f64; 3])| {
                let exact = place.exact(&surface);
                if surface.origin.world(exact).to_array() == *node { exact } else { x }
            };
            let xyz = xyz.iter().zip(&places).zip(&document.nodes).map(there).collect();
            Grid { mesh, places, xyz }
        }
        None => Grid::from_panels(xyz, &document.panels, &surface)?,
    };
    let grid = with_features(grid, &document)?;
    let (notes, losses) = (model.notes().to_vec(), model.source().told_losses());
    Ok(Opened { document, grid, surface, summary, edge_length, recipe, notes, losses })
}

/// The file's places, if all of them are on this surface and the nodes stand there.
fn at_places(
    document: &Document,
    xyz: &[DVec3],
    surface: &Surface,
    edge_length: f64,
) -> Option<Vec<Place>> {
    if document.places.len() != xyz.len() {
        return None;
    }
    let stands = |(record, x): (&io::PlaceRecord, &DVec3)| {
        let place = Place::from(*record);
        let known = is_on(&place, surface);
        let near = || place.exact(surface).distance(*x) <= AT_PLACE * edge_length;
        (known && near()).then_some(place)
    };
    document.places.iter().zip(xyz).map(stands).collect()
}

/// Whether there is such a place on the surface.
fn is_on(place: &Place, surface: &Surface) -> bool {
    match place {
        Place::Interior(p) | Place::Fixed(p) => {
            (p.triangle as usize) < surface.carrier.triangles.len()
        }
        Place::Boundary(c) | Place::Corner(c) => {
            surface.loops.get(c.chain as usize).is_some_and(|l| (0.0..=l.length()).contains(&c.s))
        }
        Place::Feature(c) => {
            let chain = surface.features.get(c.chain as usize);
            chain.is_some_and(|f| (0.0..=f.length()).contains(&c.s))
        }
    }
}

/// The grid with its features marked and its fixed nodes pinned.
fn with_features(mut grid: Grid, document: &Document) -> Result<Grid> {
    for &[a, b] in &document.features {
        grid.mesh.mark_feature(a, b)?;
    }
    for (v, place) in grid.places.iter().enumerate() {
        if place.is_fixed() {
            grid.mesh.pin(v as u32, true);
        }
    }
    Ok(grid)
}

/// The document of a grid after editing: the editor's finished `grid`, and the edits behind those it had. Supports and
/// anchors follow their nodes; where the whole boundary was supported, it is again.
pub(super) fn edited(document: &Document, editor: &Editor, grid: &Grid) -> Document {
    let now: Vec<u32> = editor.grid().mesh.vertices().collect();
    let follow = |nodes: &[u32]| -> Vec<u32> {
        nodes.iter().filter_map(|v| now.binary_search(v).ok()).map(|v| v as u32).collect()
    };
    let border: Vec<u32> = grid.mesh.vertices().filter(|&v| grid.mesh.is_boundary(v)).collect();
    // A node that an edit made on a supported boundary stands on it too.
    let held = follow(&document.supports);
    let kept = border.iter().filter(|&&v| now[v as usize] < document.nodes.len() as u32);
    let whole = !held.is_empty() && kept.clone().all(|v| held.binary_search(v).is_ok());
    let supports = if whole { border } else { held };
    let done = editor.history().map(|(edit, _)| serde_json::json!(edit));
    let fresh = Document::of_grid(&document.name, grid, editor.surface().origin);
    Document {
        places: grid.places.iter().map(|&p| p.into()).collect(),
        edits: document.edits.iter().cloned().chain(done).collect(),
        anchors: follow(&document.anchors),
        supports,
        nodes: fresh.nodes,
        panels: fresh.panels,
        features: fresh.features,
        ..document.clone()
    }
}

/// Sampled as finely as for generating a grid of this edge length.
fn sample(model: &Model, edge_length: f64, recipe: &Recipe, job: &Job) -> Result<Surface> {
    let corner_angle = recipe.corner_angle_deg.to_radians();
    model.surface(
        &Sampling { max_edge: edge_length / 2.0, chord_error: edge_length * 2e-3, corner_angle },
        job,
    )
}

/// The faces as panels, if all are triangles.
fn panels(path: &Path, faces: &[Vec<u32>]) -> Result<Vec<[u32; 3]>> {
    let wrong =
        |place: String, message: String| Error::Parse { path: path.to_owned(), place, message };
    if faces.is_empty() {
        return Err(wrong("whole file".into(), "there are no panels in it".into()));
    }
    let panel = |(k, face): (usize, &Vec<u32>)| {
        <[u32; 3]>::try_from(face.as_slice()).map_err(|_| {
            let message =
                format!("it has {} corners: a grid has triangular panels only", face.len());
            wrong(format!("face {k}"), message)
        })
    };
    faces.iter().enumerate().map(panel).collect()
}

/// Mean length of the panels' sides, metres. Inner members count twice; good enough for a yardstick.
fn mean_side(points: &[DVec3], panels: &[[u32; 3]]) -> f64 {
    let side =
        |t: &[u32; 3], k: usize| points[t[k] as usize].distance(points[t[(k + 1) % 3] as usize]);
    let sum: f64 = panels.iter().map(|t| (0..3).map(|k| side(t, k)).sum::<f64>()).sum();
    sum / (3.0 * panels.len().max(1) as f64)
}
