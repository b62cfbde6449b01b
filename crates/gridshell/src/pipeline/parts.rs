//! Models of several separate parts: which of them a grid is laid on, and one grid of several pieces.
//!
//! Each part gets a grid of its own, of the same edge length, one after the other; then they stand side by side
//! on one surface and are measured as one. Symmetries and directions are each part's own.

use super::{Scale, rough, scale, scale_on, single, verdict, whole};
use crate::error::{Error, Result};
use crate::grid::{Grid, Place};
use crate::job::Job;
use crate::mesh::Mesh;
use crate::recipe::{Parts, Recipe, Size};
use crate::run::{PartFailure, PartReport, PartSummary, Run, StageReport, SurfaceSummary};
use crate::schedule::{Schedule, Tolerances};
use crate::stages::measure::{irregular_nodes, measure};
use crate::surface::parts::Offset;
use crate::surface::{ChainPoint, Locator, Model, Sampling, Surface};
use crate::validity::Validity;
use glam::DVec3;
use std::sync::Arc;

/// Parts beyond this many are only counted in messages.
const MOST_TOLD: usize = 20;
/// A grid on more parts than this is refused: they are no design surfaces.
const MOST_LAID: usize = 1000;

/// Lay a grid on the parts of `model` that the recipe asks for.
///
/// # Errors
/// [`Error::Surface`] listing the parts where there are several and the recipe chooses none, [`Error::Option`] for
/// a part that is not there; as [`super::generate`] for each part.
pub fn generate(model: &Model, recipe: &Recipe, job: &Job) -> Result<(Run, Surface)> {
    let parts = model.parts();
    match recipe.part {
        Parts::Number(n) => {
            let part = model.of_faces(numbered(&parts, n)?);
            let (mut run, surface) = single(&part, recipe, job)?;
            if parts.len() > 1 {
                run.warnings.push(format!("part {n} of {}; the others are left out", parts.len()));
            }
            Ok((run, surface))
        }
        Parts::All if parts.len() > MOST_LAID => Err(too_many(&parts)),
        Parts::All if parts.len() > 1 => all(model, &parts, recipe, job),
        Parts::One if parts.len() > 1 => Err(choice(model, &parts, job)),
        Parts::One | Parts::All => single(model, recipe, job),
    }
}

/// What to choose from.
fn choice(model: &Model, parts: &[Vec<u32>], job: &Job) -> Error {
    let rough = rough(model.size(), &Recipe::default());
    let mut text = format!(
        "there are {} separate parts: choose one (--part N), or all for one grid of several pieces (--part all)",
        parts.len()
    );
    for (number, faces) in (1..).zip(parts.iter().take(MOST_TOLD)) {
        let surface = model.of_faces(faces).surface(&rough, job);
        if let Err(stopped) = job.check("telling the parts") {
            return stopped;
        }
        let summary = PartSummary::new(number, faces, model, surface.as_ref());
        text += &format!("\n  part {}", summary.told());
    }
    if parts.len() > MOST_TOLD {
        text += &format!("\n  and {} more", parts.len() - MOST_TOLD);
    }
    Error::Surface(text)
}

/// The surface that [`generate`] lays its grid on, and the wanted member length in metres.
///
/// # Errors
/// As [`generate`].
pub fn surface(model: &Model, recipe: &Recipe, job: &Job) -> Result<(Surface, f64)> {
    let parts = model.parts();
    match recipe.part {
        Parts::Number(n) => whole(&model.of_faces(numbered(&parts, n)?), recipe, job),
        Parts::All if parts.len() > MOST_LAID => Err(too_many(&parts)),
        Parts::All if parts.len() > 1 => {
            let pieces = Pieces::new(model, &parts, recipe, job)?;
            let surfaces = pieces.each(|part, recipe| Ok(whole(part, recipe, job)?.0))?.results;
            Ok((Surface::side_by_side(surfaces).0, pieces.length))
        }
        Parts::One if parts.len() > 1 => Err(choice(model, &parts, job)),
        Parts::One | Parts::All => whole(model, recipe, job),
    }
}

/// The wanted member length, metres, on the parts that the recipe asks for.
///
/// # Errors
/// As [`generate`].
pub fn edge_length(model: &Model, recipe: &Recipe, job: &Job) -> Result<f64> {
    let parts = model.parts();
    match recipe.part {
        Parts::Number(n) => Ok(scale(&model.of_faces(numbered(&parts, n)?), recipe, job)?.length),
        Parts::All if parts.len() > MOST_LAID => Err(too_many(&parts)),
        Parts::All if parts.len() > 1 => Ok(Pieces::new(model, &parts, recipe, job)?.length),
        Parts::One if parts.len() > 1 => Err(choice(model, &parts, job)),
        Parts::One | Parts::All => Ok(scale(model, recipe, job)?.length),
    }
}

/// The faces of part `n`, counted from 1.
fn numbered(parts: &[Vec<u32>], n: usize) -> Result<&[u32]> {
    let faces = n.checked_sub(1).and_then(|k| parts.get(k));
    faces.map(Vec::as_slice).ok_or_else(|| {
        Error::Option(format!("there is no part {n}: the parts are 1 to {}", parts.len()))
    })
}

fn too_many(parts: &[Vec<u32>]) -> Error {
    Error::Surface(format!(
        "{} separate parts are too many for one grid; choose one with `part`",
        parts.len()
    ))
}

/// One grid with a piece on each part.
fn all(model: &Model, parts: &[Vec<u32>], recipe: &Recipe, job: &Job) -> Result<(Run, Surface)> {
    let pieces = Pieces::new(model, parts, recipe, job)?;
    let Done { numbers, results, failed } =
        pieces.each(|part, recipe| single(part, recipe, job))?;
    let (runs, surfaces) = results.into_iter().unzip();
    let (surface, offsets) = Surface::side_by_side(surfaces);
    let mut run = join(model, &surface, &offsets, &numbers, runs, recipe, pieces.length, job)?;
    let asked = recipe.skip_parts.iter();
    run.warnings.extend(asked.map(|n| format!("part {n} is left out, as the recipe says")));
    run.warnings.extend(failed.iter().map(PartFailure::told));
    let skipped = &mut run.recipe.skip_parts;
    skipped.extend(failed.iter().map(|f| f.number));
    skipped.sort_unstable();
    skipped.dedup();
    Ok((Run { failed, ..run }, surface))
}

/// The parts of a model with a recipe for each.
struct Pieces {
    /// Those that are surfaces, with their numbers.
    models: Vec<Model>,
    numbers: Vec<usize>,
    recipes: Vec<Recipe>,
    /// Wanted member length, metres.
    length: f64,
    /// Those that are none.
    failed: Vec<PartFailure>,
    /// Those that are to be left out.
    skipped: Vec<usize>,
}

/// What was done for the parts that it could be done for.
struct Done<T> {
    numbers: Vec<usize>,
    results: Vec<T>,
    failed: Vec<PartFailure>,
}

impl Pieces {
    fn new(model: &Model, parts: &[Vec<u32>], recipe: &Recipe, job: &Job) -> Result<Pieces> {
        let sampling = rough(model.size(), recipe);
        let (mut models, mut numbers, mut surfaces) = (Vec::new(), Vec::new(), Vec::new());
        let mut failed = Vec::new();
        for (number, faces) in (1..).zip(parts) {
            let part = model.of_faces(faces);
            match part.surface(&sampling, job) {
                Ok(surface) => surfaces.push(surface),
                Err(_) if recipe.skip_parts.contains(&number) => continue,
                Err(error) => {
                    failed.push(failure(number, error)?);
                    continue;
                }
            }
            models.push(part);
            numbers.push(number);
        }
        if surfaces.is_empty() {
            return Err(none(&failed));
        }
        let areas: Vec<f64> = surfaces.iter().map(|s| s.area).collect();
        let Scale { length, .. } = scale_on(Surface::side_by_side(surfaces).0, recipe)?;
        let mut part_recipe = Recipe { part: Parts::One, ..recipe.clone() };
        // Lengths at points in metres say the length of each part themselves.
        let given = recipe.edge_length.is_some() || recipe.nodes.is_some();
        if given || !matches!(recipe.size, Size::Points { .. }) {
            (part_recipe.edge_length, part_recipe.nodes) = (Some(length), None);
        }
        let owners = Owners::new(&models, recipe, length, job)?;
        let recipes = (0..models.len()).map(|k| owners.recipe(k, &part_recipe)).collect();
        let mut skipped = recipe.skip_parts.clone();
        if part_recipe.edge_length.is_some() {
            for (number, area) in numbers.iter().zip(areas) {
                if skipped.contains(number) {
                    continue;
                }
                // A scrap beside a roof must not keep the roof from its grid.
                if let Err(e) = Recipe::check_edge_length(length, area) {
                    failed.push(PartFailure { number: *number, why: e.to_string() });
                    skipped.push(*number);
                }
            }
        }
        Ok(Pieces { models, numbers, recipes, length, failed, skipped })
    }

    /// Something done for each part in turn. What is wrong with one does not keep it from the others, unless what was
    /// asked for is at fault: then the error tells the part.
    fn each<T>(&self, deed: impl Fn(&Model, &Recipe) -> Result<T>) -> Result<Done<T>> {
        let (mut numbers, mut results, mut failed) = (Vec::new(), Vec::new(), self.failed.clone());
        for ((part, recipe), &number) in self.models.iter().zip(&self.recipes).zip(&self.numbers) {
            if self.skipped.contains(&number) {
                continue;
            }
            let fixed = !recipe.guides.is_empty() || !recipe.anchors.is_empty();
            match deed(part, recipe) {
                Ok(one) => {
                    numbers.push(number);
                    results.push(one);
                }
                Err(error) if fixed => return Err(of_part(number, error)),
                Err(error) => failed.push(failure(number, error)?),
            }
        }
        failed.sort_by_key(|f| f.number);
        if results.is_empty() { Err(none(&failed)) } else { Ok(Done { numbers, results, failed }) }
    }
}

/// What is wrong with a part, where the part itself is at fault.
fn failure(number: usize, error: Error) -> Result<PartFailure> {
    match error {
        Error::Surface(_) | Error::NoGrid { .. } | Error::Invalid { .. } => {
            Ok(PartFailure { number, why: error.to_string() })
        }
        error => Err(of_part(number, error)),
    }
}

fn none(failed: &[PartFailure]) -> Error {
    let told: Vec<String> = failed.iter().take(MOST_TOLD).map(PartFailure::told).collect();
    if told.is_empty() {
        return Error::Option("all parts are to be left out (skip_parts): leave one".into());
    }
    Error::Surface(told.join("; "))
}

/// The same error, telling the part.
fn of_part(number: usize, error: Error) -> Error {
    match error {
        Error::Surface(message) => Error::Surface(format!("part {number}: {message}")),
        Error::Option(message) => Error::Option(format!("part {number}: {message}")),
        Error::NoGrid { at, message, edge_length } => {
            Error::NoGrid { at, message: format!("part {number}: {message}"), edge_length }
        }
        Error::Invalid { message, advice, places } => {
            Error::Invalid { message: format!("part {number}: {message}"), advice, places }
        }
        other => other,
    }
}

/// The part that each guide and anchor is nearest to.
struct Owners {
    guides: Vec<usize>,
    anchors: Vec<usize>,
}

impl Owners {
    fn new(models: &[Model], recipe: &Recipe, length: f64, job: &Job) -> Result<Owners> {
        if recipe.guides.is_empty() && recipe.anchors.is_empty() {
            return Ok(Owners { guides: Vec::new(), anchors: Vec::new() });
        }
        let sampling = Sampling { max_edge: length, chord_error: 0.1 * length, corner_angle: 1.0 };
        let surfaces: Vec<Surface> =
            models.iter().map(|m| m.surface(&sampling, job)).collect::<Result<_>>()?;
        let locators: Vec<Locator> = surfaces.iter().map(Locator::new).collect();
        let nearest = |p: [f64; 3]| {
            let p = DVec3::from(p);
            let off = |k: usize| {
                let place = locators[k].nearest(p);
                place.map_or(f64::INFINITY, |at| surfaces[k].carrier.xyz(&at).distance(p))
            };
            (0..models.len()).min_by(|&a, &b| off(a).total_cmp(&off(b))).unwrap_or(0)
        };
        let middle = |guide: &Vec<[f64; 3]>| guide.get(guide.len() / 2).copied();
        let guide = |g| middle(g).map_or(0, nearest);
        Ok(Owners {
            guides: recipe.guides.iter().map(guide).collect(),
            anchors: recipe.anchors.iter().map(|&p| nearest(p)).collect(),
        })
    }

    /// The recipe with the guides and anchors of part `k` only.
    fn recipe(&self, k: usize, recipe: &Recipe) -> Recipe {
        let mut own = recipe.clone();
        let mut owners = self.guides.iter();
        own.guides.retain(|_| owners.next() == Some(&k));
        let mut owners = self.anchors.iter();
        own.anchors.retain(|_| owners.next() == Some(&k));
        own
    }
}

#[expect(clippy::too_many_arguments, reason = "the parts of a run, gathered once")]
fn join(
    model: &Model,
    surface: &Surface,
    offsets: &[Offset],
    numbers: &[usize],
    runs: Vec<Run>,
    recipe: &Recipe,
    length: f64,
    job: &Job,
) -> Result<Run> {
    let grids: Vec<&Grid> = runs.iter().map(|run| &*run.grid).collect();
    let grid = side_by_side(&grids, offsets)?;
    let quality = measure(&grid, surface, length, &recipe.measure);
    let validity = Validity::of(&grid, surface, length, &quality);
    verdict::check(&validity, recipe, surface.origin, length, job)?;
    let stages =
        (0..runs[0].stages.len()).map(|s| stage(s, numbers, &runs, surface, offsets, length));
    let stages = stages.collect::<Result<Vec<_>>>()?;
    let (mut parts, mut candidates, mut warnings) = (Vec::new(), Vec::new(), Vec::new());
    let mut first_node = 0;
    for (&number, run) in numbers.iter().zip(&runs) {
        let nodes = run.grid.xyz.len();
        parts.push(PartReport {
            number,
            first_node,
            nodes,
            area: run.surface.area,
            fluency: run.quality.fluency,
            symmetry: run.symmetry.clone(),
        });
        first_node += nodes;
        let of_this = |c: &crate::run::CandidateReport| crate::run::CandidateReport {
            part: Some(number),
            ..c.clone()
        };
        candidates.extend(run.candidates.iter().map(of_this));
        let tell = |w: &String| format!("part {number}: {w}");
        warnings.extend(run.warnings.iter().map(tell));
    }
    let schedule = Schedule::new(&grid, surface, &Tolerances::from(&recipe.measure));
    let first = runs.into_iter().next().expect("there are several parts");
    Ok(Run {
        surface: SurfaceSummary::new(model, surface),
        recipe: recipe.clone(),
        symmetry: None,
        edge_length: length,
        parts,
        candidates,
        stages,
        irregular: irregular_nodes(&grid, surface.origin),
        quality,
        figures: schedule.figures.clone(),
        schedule: Arc::new(schedule),
        valid: validity.is_valid(),
        faults: validity.faults,
        warnings,
        stopped: job.stopped(),
        grid: Arc::new(grid),
        ..first
    })
}

/// Stage `s` of all parts as one.
fn stage(
    s: usize,
    numbers: &[usize],
    runs: &[Run],
    surface: &Surface,
    offsets: &[Offset],
    length: f64,
) -> Result<StageReport> {
    let stages: Vec<&StageReport> = runs.iter().filter_map(|run| run.stages.get(s)).collect();
    let grids: Option<Vec<&Grid>> = stages.iter().map(|stage| stage.grid.as_ref()).collect();
    let grid = match grids.filter(|grids| grids.len() == runs.len()) {
        Some(grids) => Some(side_by_side(&grids, offsets)?),
        None => None,
    };
    let options = &runs[0].recipe.measure;
    let quality = grid.as_ref().map(|grid| measure(grid, surface, length, options));
    let notes = numbers.iter().zip(&stages).flat_map(|(number, stage)| {
        stage.notes.iter().map(move |note| format!("part {number}: {note}"))
    });
    Ok(StageReport {
        name: stages[0].name,
        seconds: stages.iter().map(|stage| stage.seconds).sum(),
        converged: stages.iter().all(|stage| stage.converged),
        quality,
        notes: notes.collect(),
        grid,
    })
}

/// Grids of parts as one grid, each with its place in the surface of all parts.
fn side_by_side(grids: &[&Grid], offsets: &[Offset]) -> Result<Grid> {
    let (mut places, mut xyz, mut panels) = (Vec::new(), Vec::new(), Vec::new());
    let (mut features, mut pinned) = (Vec::new(), Vec::new());
    for (grid, offset) in grids.iter().zip(offsets) {
        let first = xyz.len() as u32;
        let mesh = &grid.mesh;
        panels.extend(mesh.triangles().map(|t| t.map(|v| v + first)));
        features.extend(
            mesh.edges()
                .filter(|&(a, b)| mesh.is_feature_edge(a, b))
                .map(|(a, b)| (a + first, b + first)),
        );
        pinned.extend(mesh.vertices().filter(|&v| mesh.is_pinned(v)).map(|v| v + first));
        places.extend(grid.places.iter().map(|p| place(p, offset)));
        xyz.extend(&grid.xyz);
    }
    let mut mesh = Mesh::from_triangles(xyz.len(), &panels)?;
    for (a, b) in features {
        mesh.mark_feature(a, b)?;
    }
    for v in pinned {
        mesh.pin(v, true);
    }
    Ok(Grid { mesh, places, xyz })
}

fn place(place: &Place, offset: &Offset) -> Place {
    let on = |at: &ChainPoint, first: u32| ChainPoint { chain: at.chain + first, ..*at };
    match place {
        Place::Interior(p) => Place::Interior(offset.point(p)),
        Place::Fixed(p) => Place::Fixed(offset.point(p)),
        Place::Boundary(at) => Place::Boundary(on(at, offset.loops)),
        Place::Corner(at) => Place::Corner(on(at, offset.loops)),
        Place::Feature(at) => Place::Feature(on(at, offset.features)),
    }
}
