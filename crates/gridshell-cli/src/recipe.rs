//! The recipe of a run: a named method, then the file, then the flags.

use crate::args::Generate;
use crate::failure::Failure;
use gridshell::io;
use gridshell::job::Job;
use gridshell::recipe::{Direction, Recipe, Size};
use std::path::Path;
use toml::{Table, Value};

/// Larger files are no recipes.
const MAX_BYTES: u64 = 1 << 20;

/// The recipe that the arguments ask for, checked.
/// What they do not say is as in `again`, the recipe of a run to be repeated, if there is one and no method is named.
pub fn from_args(args: &Generate, again: Option<&Recipe>, job: &Job) -> Result<Recipe, Failure> {
    let mut recipe = match (&args.method, again) {
        (None, Some(recipe)) => recipe.clone(),
        (method, _) => Recipe::named(method.as_deref().unwrap_or("default"))?,
    };
    if let Some(path) = &args.recipe {
        recipe = overlay(&recipe, path, job)?;
    }
    if args.edge_length.is_some() || args.nodes.is_some() {
        recipe.edge_length = args.edge_length;
        recipe.nodes = args.nodes;
    }
    if let Some(seed) = args.seed {
        recipe.seed = seed;
    }
    if let Some(effort) = &args.effort {
        recipe.effort = effort.parse()?;
    }
    recipe.candidates = args.candidates.or(recipe.candidates);
    if let Some(angle) = args.feature_angle {
        recipe.feature_angle_deg = angle;
    }
    recipe.smooth_input |= args.smooth_input;
    recipe.accept_losses |= args.accept_losses;
    recipe.keep_invalid |= args.keep_invalid;
    if let Some(path) = &args.guides {
        let guides = io::read_guides(path, job)?;
        recipe.guides =
            guides.into_iter().map(|g| g.into_iter().map(|p| p.to_array()).collect()).collect();
    }
    if let Some(path) = &args.anchors {
        recipe.anchors = io::read_anchors(path, job)?.into_iter().map(|p| p.to_array()).collect();
    }
    recipe.anchors.extend(&args.anchor);
    if let Some(size) = &args.size {
        recipe.size = match size.as_str() {
            "uniform" => Size::Uniform,
            "curvature" => Size::curvature(),
            file => Size::Points { points: io::read_lengths(Path::new(file), job)? },
        };
    }
    if let Some(direction) = &args.direction {
        recipe.direction = match (direction.as_str(), vector(direction)) {
            ("boundary", _) => Direction::Boundary,
            (_, Some(xyz)) => Direction::Vector { xyz },
            (file, None) => {
                Direction::Points { points: io::read_directions(Path::new(file), job)? }
            }
        };
    }
    if let Some(symmetry) = &args.symmetry {
        recipe.symmetry = symmetry.parse()?;
    }
    if let Some(part) = &args.part {
        recipe.part = part.parse()?;
    }
    if let Some(border) = args.border {
        recipe.border = border;
    }
    recipe.measure.count_alike(args.alike.length_tolerance, args.alike.angle_tolerance);
    recipe.validate()?;
    Ok(recipe)
}

/// Three numbers separated by commas, if it is that.
fn vector(text: &str) -> Option<[f64; 3]> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|w| w.trim().parse().ok()).collect();
    numbers?.try_into().ok()
}

/// The recipe with what the file says laid over it.
fn overlay(recipe: &Recipe, path: &Path, job: &Job) -> Result<Recipe, Failure> {
    let text = io::read_text(path, MAX_BYTES, job)?;
    // What stands in a recipe is asked for, as flags are: a wrong type leaves as a wrong value does.
    let wrong = |e| Failure::usage(format!("{}: {e}", path.display()));
    let over: Table = toml::from_str(&text).map_err(wrong)?;
    // Read once on its own: errors then point to the line in the user's file.
    toml::from_str::<Recipe>(&text)
        .map_err(wrong)?
        .validate()
        .map_err(|e| wrong_value(path, &e))?;
    let mut table = Table::try_from(recipe).map_err(Failure::other)?;
    lay_over(&mut table, over);
    table.try_into().map_err(wrong)
}

fn wrong_value(path: &Path, error: &gridshell::Error) -> Failure {
    Failure::usage(format!("{}: {error}", path.display()))
}

fn lay_over(under: &mut Table, over: Table) {
    for (key, value) in over {
        match (under.get_mut(&key), value) {
            (Some(Value::Table(under)), Value::Table(over)) => lay_over(under, over),
            (_, value) => {
                under.insert(key, value);
            }
        }
    }
}
