//! What holds for every run; each test of a surface begins with it.

use gridshell::grid::{Grid, Place};
use gridshell::job::Job;
use gridshell::recipe::Recipe;
use gridshell::run::Run;
use gridshell::surface::{Locator, Model, Sampling, Surface};
use gridshell::{DVec3, pipeline};

/// Nodes are this close to surface, boundary and corners, in units of l0.
const EXACT: f64 = 1e-6;

/// The default recipe for members of `edge_length` metres.
pub fn recipe(edge_length: f64) -> Recipe {
    Recipe { edge_length: Some(edge_length), ..Recipe::default() }
}

/// As [`recipe`], with fewer grids to choose from: what is promised holds for every one of them.
pub fn quick(edge_length: f64) -> Recipe {
    let mut recipe = recipe(edge_length);
    recipe.pack.draws = 16;
    recipe.candidates = Some(2);
    recipe.regularize.trials = 1000;
    recipe.regularize.most_trials = 20_000;
    recipe.regularize.heats = vec![[2, 20]];
    recipe.regularize.most_polish = 600;
    recipe
}

/// The paper's recipe for members of `edge_length` metres.
pub fn paper(edge_length: f64) -> Recipe {
    Recipe { edge_length: Some(edge_length), ..Recipe::named("paper").unwrap() }
}

/// A built-in surface.
pub fn model(name: &str) -> Model {
    gridshell::surface::builtin::model(name).unwrap()
}

/// The surface itself, sampled otherwise than a run samples it, so that it can bear witness against one.
pub fn surface(model: &Model, edge_length: f64) -> Surface {
    let sampling = Sampling {
        max_edge: 0.27 * edge_length,
        chord_error: 5e-4 * edge_length,
        corner_angle: Recipe::default().corner_angle_deg.to_radians(),
    };
    model.surface(&sampling, &Job::default()).unwrap()
}

/// A run to its end that keeps all promises, with no panel folded over.
pub fn kept(model: &Model, recipe: &Recipe) -> Run {
    let run = kept_where_sharp(model, recipe);
    assert_eq!(run.quality.folded_panels, 0);
    run
}

/// As [`kept`], on a surface that itself turns over within a member.
pub fn kept_where_sharp(model: &Model, recipe: &Recipe) -> Run {
    let run = pipeline::generate(model, recipe, &Job::default()).unwrap();
    assert!(!run.stopped);
    check(model, &run);
    run
}

/// Hold `run` against its surface.
pub fn check(model: &Model, run: &Run) {
    let surface = surface(model, run.edge_length);
    let names: Vec<_> = run.stages.iter().map(|s| s.name).collect();
    assert_eq!(names, ["pack", "triangulate", "regularize", "relax"]);
    for stage in &run.stages {
        let grid = stage.grid.as_ref().unwrap_or_else(|| panic!("{} keeps no grid", stage.name));
        assert!(stage.quality.is_some(), "{} is not measured", stage.name);
        check_grid(stage.name, grid, &surface, run.edge_length);
    }
    check_grid("run", &run.grid, &surface, run.edge_length);
    let last = run.stages.last().and_then(|s| s.grid.as_ref()).unwrap();
    assert_eq!(last.xyz, run.grid.xyz, "the last stage's grid is the run's");
    let quality = &run.quality;
    assert!(quality.area_ratio > 0.9, "area ratio {}", quality.area_ratio);
    assert_eq!(quality.bridging_members, 0);
}

/// A manifold with the surface's topology, exactly on it, a node at every corner.
fn check_grid(stage: &str, grid: &Grid, surface: &Surface, edge_length: f64) {
    grid.mesh.check().unwrap();
    assert_eq!(grid.mesh.euler_characteristic(), surface.euler_characteristic(), "{stage}");
    assert_eq!(grid.mesh.boundary_loops().len(), surface.loops.len(), "{stage}");
    assert_eq!((grid.xyz.len(), grid.places.len()), (grid.mesh.slots(), grid.mesh.slots()));
    let close = EXACT * edge_length;
    let locator = Locator::new(surface);
    for (v, &xyz) in grid.xyz.iter().enumerate() {
        let off = surface.deviation(&locator.nearest(xyz).unwrap(), xyz);
        assert!(off <= close, "{stage}: node {v} at {xyz} is {off:e} m off the surface");
        let inside = !matches!(grid.places[v], Place::Boundary(_) | Place::Corner(_));
        assert_eq!(grid.mesh.is_boundary(v as u32), !inside, "{stage}: node {v} at {xyz}");
        if !inside {
            let at = locator.nearest_on_loops(xyz).unwrap();
            let off = surface.loops[at.chain as usize].deviation(surface, at.s, xyz);
            assert!(off <= close, "{stage}: node {v} at {xyz} is {off:e} m off the boundary");
        }
    }
    for corner in corners(surface) {
        let nearest = grid.xyz.iter().map(|p| p.distance(corner)).fold(f64::MAX, f64::min);
        assert!(nearest <= close, "{stage}: no node at the corner {corner}: {nearest:e} m");
    }
}

/// Where the corners of all loops are.
fn corners(surface: &Surface) -> Vec<DVec3> {
    let of = |k: usize| {
        let chain = &surface.loops[k];
        chain.corners.iter().map(|&c| chain.exact(surface, chain.arc[c as usize]))
    };
    (0..surface.loops.len()).flat_map(of).collect()
}
