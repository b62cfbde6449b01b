//! A coarse mesh is smoothed before it is sampled, where the recipe wants it: what comes after sees a fine mesh.

use super::{CARRIER_CHORD, parts};
use crate::error::Result;
use crate::job::Job;
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
pub fn smoothed<'a>(model: &'a Model, recipe: &Recipe, job: &Job) -> Result<Cow<'a, Model>> {
    if !recipe.smooth_input {
        return Ok(Cow::Borrowed(model));
    }
    let mesh = match model {
        Model::Brep(brep) => {
            let mut brep = brep.clone();
            brep.notes.push("nothing was smoothed: the surface is of patches, not a mesh".into());
            return Ok(Cow::Owned(Model::Brep(brep)));
        }
        // It comes out of here.
        Model::Mesh(mesh) if mesh.smoothing.is_some() => return Ok(Cow::Borrowed(model)),
        Model::Mesh(mesh) => mesh,
    };
    let length = parts::edge_length(model, recipe, job)?;
    Ok(Cow::Owned(Model::Mesh(smooth(mesh, length, recipe, job)?)))
}

/// The mesh for members of `length` metres, with a note of what was done.
fn smooth(mesh: &PolygonMesh, length: f64, recipe: &Recipe, job: &Job) -> Result<PolygonMesh> {
    let (coarse, longest) = (COARSE * length, mesh.longest_edge());
    let mut smooth = mesh.clone();
    if longest <= coarse {
        smooth.notes.push(format!(
            "nothing was smoothed: no edge of the mesh is longer than {coarse:.3} m, half of a member"
        ));
        return Ok(smooth);
    }
    smooth = mesh.smoothed(
        &Smooth {
            coarse,
            chord_error: CHORD * CARRIER_CHORD * length,
            corner_angle: recipe.corner_angle_deg.to_radians(),
            crease_angle: recipe.feature_angle_deg.to_radians(),
        },
        job,
    )?;
    let departure = smooth.smoothing.map_or(0.0, |s| s.departure);
    smooth.notes.push(format!(
        "smoothed the mesh, whose edges are up to {longest:.3} m long: the smooth surface goes through its vertices \
         and leaves its faces by up to {departure:.4} m"
    ));
    Ok(smooth)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline;
    use crate::recipe::Effort;
    use crate::surface::builtin;
    use glam::DVec3;

    /// A shallow bowl of sixteen quads, four metres wide.
    fn bowl() -> Model {
        let at = |k: u32| f64::from(k) - 2.0;
        let vertices = (0..5).flat_map(|i| (0..5).map(move |j| (at(i), at(j))));
        let points = vertices.map(|(x, y)| DVec3::new(x, y, 0.1 * (x * x + y * y))).collect();
        let cells = (0..4).flat_map(|i| (0..4).map(move |j| 5 * i + j));
        let faces = cells.map(|a| vec![a, a + 5, a + 6, a + 1]).collect();
        Model::Mesh(PolygonMesh { points, faces, ..PolygonMesh::default() })
    }

    fn recipe(edge_length: f64) -> Recipe {
        let effort = Effort::Draft;
        Recipe { edge_length: Some(edge_length), smooth_input: true, effort, ..Recipe::default() }
    }

    #[test]
    fn a_grid_lies_on_the_smooth_surface_which_the_run_tells() {
        let run = pipeline::generate(&bowl(), &recipe(0.4), &Job::default()).unwrap();
        let smoothing = run.surface.smoothing.expect("it was smoothed");
        assert!((smoothing.longest_edge - 1.0446).abs() < 1e-3, "{smoothing:?}");
        assert!((0.02..0.06).contains(&smoothing.departure), "{smoothing:?}");
        let off = run.grid.xyz.iter().map(|p| (p.z - 0.1 * (p.x * p.x + p.y * p.y)).abs());
        assert!(off.fold(0.0, f64::max) < 0.006, "the faces leave it by 0.05");
        assert_eq!(run.quality.euler_characteristic, 1);
    }

    #[test]
    fn what_is_fine_or_of_patches_stays_and_is_told() {
        let bowl = bowl();
        let fine = smoothed(&bowl, &recipe(2.2), &Job::default()).unwrap();
        assert_eq!(fine.face_count(), 16);
        assert!(fine.notes()[0].contains("no edge of the mesh is longer than 1.100 m"));
        let smooth = smoothed(&bowl, &recipe(0.4), &Job::default()).unwrap();
        assert!(matches!(
            smoothed(&smooth, &recipe(0.4), &Job::default()).unwrap(),
            Cow::Borrowed(_)
        ));
        let patches = builtin::model("hexagon").unwrap();
        let same = smoothed(&patches, &recipe(1.0), &Job::default()).unwrap();
        assert!(same.notes().iter().any(|n| n.contains("of patches, not a mesh")));
        assert!(matches!(
            smoothed(&bowl, &Recipe::default(), &Job::default()).unwrap(),
            Cow::Borrowed(_)
        ));
    }
}
