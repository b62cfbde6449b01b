//! Triangles in a STEP file (AP242): what it is shown by, or all that there is.

use crate::io::LengthUnit;
use crate::io::mesh::soup::Soup;
use crate::surface::Loss;
use crate::surface::nurbs::{FARTHEST, reach};
use glam::DVec3;
use step_io::scene::Scene;

/// All triangles, in metres, where they are drawn; those of parts that an assembly places elsewhere too.
pub(super) fn soup(scene: &Scene, unit_in_metres: f64) -> Soup {
    let mut soup = Soup { unit: Some(LengthUnit::Metre), ..Soup::default() };
    let mut lost = 0;
    for mesh in scene.all_meshes() {
        let first = soup.points.len() as u32;
        let points = mesh.points().into_iter().map(|p| DVec3::from(p) * unit_in_metres);
        soup.points.extend(points);
        for triangle in mesh.triangles() {
            let near =
                triangle.iter().all(|&v| reach(soup.points[first as usize + v], FARTHEST).is_ok());
            if near {
                soup.faces.push(triangle.map(|v| first + v as u32).to_vec());
            } else {
                lost += 1;
            }
        }
    }
    if lost > 0 {
        soup.losses.push(Loss {
            what: "triangles".to_owned(),
            why: format!(
                "they reach farther than {FARTHEST:e} m; correct their points, or the unit"
            ),
            faces: lost,
            area: None,
            whole: false,
        });
    }
    if scene.all_product_definitions().any(|d| d.occurrences().next().is_some()) {
        soup.notes.push(
            "triangles are read where they are drawn, not where the assembly places them".into(),
        );
    }
    soup
}
