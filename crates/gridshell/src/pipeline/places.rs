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
    for p in recipe.guides.iter_mut().flatten().chain(&mut recipe.anchors) {
        place(p);
    }
    if let Size::Points { points } = &mut recipe.size {
        for p in points {
            place(p);
        }
    }
    if let Direction::Points { points } = &mut recipe.direction {
        for p in points {
            place(p);
        }
    }
    recipe
}
