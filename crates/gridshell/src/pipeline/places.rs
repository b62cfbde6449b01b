//! The places that a recipe names, in local coordinates.

use crate::recipe::{Direction, Recipe, Size};
use crate::surface::Origin;
use glam::DVec3;

/// The recipe for a surface whose coordinates have this origin: what it says in the file's is made local.
pub fn local(recipe: &Recipe, origin: Origin) -> Recipe {
    let mut recipe = recipe.clone();
    if origin.is_near() {
        return recipe;
    }
    let place = |xyz: &mut [f64]| {
        let p = origin.local(DVec3::from_slice(xyz));
        xyz[..3].copy_from_slice(&p.to_array());
    };
    recipe.guides.iter_mut().flatten().for_each(|p| place(p));
    recipe.anchors.iter_mut().for_each(|p| place(p));
    if let Size::Points { points } = &mut recipe.size {
        points.iter_mut().for_each(|p| place(p));
    }
    if let Direction::Points { points } = &mut recipe.direction {
        points.iter_mut().for_each(|p| place(p));
    }
    recipe
}
