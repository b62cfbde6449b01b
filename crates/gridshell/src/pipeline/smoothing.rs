//! A coarse mesh is smoothed before it is sampled, where the recipe wants it: what comes after sees a fine mesh.

use super::{CARRIER_CHORD, parts};
use crate::error::Result;
use crate::recipe::Recipe;
use crate::surface::{Model, PolygonMesh, Smooth};
use std::borrow::Cow;

/// Faces with an edge longer than this share of l0 would show.
const COARSE: f64 = 0.5;
/// The pieces of the smooth surface leave it by no more than half of what carriers of patches do: the grid lies on them.
const CHORD: f64 = 0.5;

/// The model that the grid is laid on, smooth where the recipe wants that and its mesh is coarse.
///
/// # Errors
/// [`Error::Surface`](crate::Error::Surface) as [`super::generate`], and where smoothing takes too many triangles.
pub fn smoothed<'a>(model: &'a Model, recipe: &Recipe) -> Result<Cow<'a, Model>> {
    if !recipe.smooth_input {
        return Ok(Cow::Borrowed(model));
    }
    let mesh = match model {
        Model::Brep(brep) => {
            let mut brep = brep.clone();
            brep.notes.push("nothing was smoothed: the surface is of patches, not a mesh".into());
            return Ok(Cow::Owned(Model::Brep(brep)));
        }
        Model::Mesh(mesh) => mesh,
    };
    let length = parts::edge_length(model, recipe)?;
    Ok(Cow::Owned(Model::Mesh(smooth(mesh, length, recipe)?)))
}

/// The mesh for members of `length` metres, with a note of what was done.
fn smooth(mesh: &PolygonMesh, length: f64, recipe: &Recipe) -> Result<PolygonMesh> {
    let (coarse, longest) = (COARSE * length, mesh.longest_edge());
    let mut smooth = mesh.clone();
    if longest <= coarse {
        smooth.notes.push(format!(
            "nothing was smoothed: no edge of the mesh is longer than {coarse:.3} m, half of a member"
        ));
        return Ok(smooth);
    }
    smooth = mesh.smoothed(&Smooth {
        coarse,
        chord_error: CHORD * CARRIER_CHORD * length,
        corner_angle: recipe.corner_angle_deg.to_radians(),
        crease_angle: recipe.feature_angle_deg.to_radians(),
    })?;
    let departure = smooth.smoothing.map_or(0.0, |s| s.departure);
    smooth.notes.push(format!(
        "smoothed the mesh, whose edges are up to {longest:.3} m long: the smooth surface goes through its vertices \
         and leaves its faces by up to {departure:.4} m"
    ));
    Ok(smooth)
}
