//! Whether a model is whole enough to lay a grid on: what of its file could not be read must not be missing in silence.

use super::rough;
use crate::error::{Error, Result};
use crate::job::Job;
use crate::recipe::Recipe;
use crate::surface::Model;

/// Refuse a model of which a part that counts could not be read, unless the recipe accepts it.
///
/// # Errors
/// [`Error::Surface`] naming what is missing, why, and how to get it or go on without it.
pub fn check_whole(model: &Model, recipe: &Recipe, job: &Job) -> Result<()> {
    let source = model.source();
    if recipe.accept_losses || source.losses.is_empty() {
        return Ok(());
    }
    let area = area(model, recipe, job);
    job.check("preparing the surface")?;
    if !source.is_incomplete(area) {
        return Ok(());
    }
    let told = source.told_losses().join("\n  ");
    Err(Error::Surface(format!(
        "the surface is not whole, and no grid is laid on what is left of it:\n  {told}\nmend or export it as told \
         there; to lay a grid on what was read all the same, accept the losses (--accept-losses, or `accept_losses = \
         true` in a recipe)"
    )))
}

/// Area of all parts that are surfaces, square metres.
fn area(model: &Model, recipe: &Recipe, job: &Job) -> f64 {
    let of = |faces: &Vec<u32>| {
        let part = model.of_faces(faces);
        part.surface(&rough(part.size(), recipe), job).map_or(0.0, |surface| surface.area)
    };
    model.parts().iter().map(of).sum()
}
