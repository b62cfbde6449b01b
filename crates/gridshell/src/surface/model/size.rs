//! The size of a model before it is sampled: the yardstick for tolerances and first samplings.

use super::{Model, PolygonMesh};
use crate::surface::Brep;
use glam::DVec3;

/// Points looked at on each edge.
const LOOKS: usize = 9;

impl Model {
    /// Diagonal of a box about the model, metres: of its vertices and edges, and of the control points of
    /// faces without edges.
    pub fn size(&self) -> f64 {
        match self {
            Model::Brep(brep) => of_brep(brep),
            Model::Mesh(mesh) => mesh.size(),
        }
    }
}

impl PolygonMesh {
    /// Diagonal of the box of its vertices, metres.
    pub fn size(&self) -> f64 {
        diagonal(self.points.iter().copied())
    }
}

/// The same of a `Brep`.
pub(in crate::surface) fn of_brep(brep: &Brep) -> f64 {
    diagonal(brep_points(brep))
}

fn brep_points(brep: &Brep) -> impl Iterator<Item = DVec3> + '_ {
    let along =
        |[a, b]: [f64; 2]| (0..LOOKS).map(move |k| a + (b - a) * k as f64 / (LOOKS - 1) as f64);
    let edges = brep.edges.iter().flat_map(move |e| along(e.range).map(|t| e.curve.point(t)));
    let whole = brep.faces.iter().filter(|f| f.loops.is_empty()).flat_map(|f| {
        let spline = f.shape.spline();
        spline.map_or([].as_slice(), |s| s.points.as_slice())
    });
    brep.vertices.iter().copied().chain(edges).chain(whole.copied())
}

/// Least and largest coordinates of the same points; infinite the wrong way round where there are none.
pub(super) fn bounds(brep: &Brep) -> (DVec3, DVec3) {
    bounds_of(brep_points(brep))
}

fn bounds_of(points: impl Iterator<Item = DVec3>) -> (DVec3, DVec3) {
    let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    points.fold(start, |(min, max), p| (min.min(p), max.max(p)))
}

fn diagonal(points: impl Iterator<Item = DVec3>) -> f64 {
    let (min, max) = bounds_of(points);
    if min.x <= max.x { (max - min).length() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use crate::surface::{Model, PolygonMesh, builtin};
    use glam::DVec3;

    #[test]
    fn the_great_court_is_as_large_as_its_rectangle() {
        let size = builtin::model("great-court").expect("built in").size();
        // 73.25 x 97.15 in plan; the edges rise from 19.71 to 20.955.
        assert!(
            (size - (73.25f64.powi(2) + 97.15f64.powi(2) + 1.245f64.powi(2)).sqrt()).abs() < 1e-6
        );
    }

    #[test]
    fn a_closed_surface_without_edges_has_a_size() {
        let size = builtin::model("sphere").expect("built in").size();
        assert!((20.0..60.0).contains(&size), "{size}");
    }

    #[test]
    fn nothing_has_no_size() {
        assert_eq!(Model::Mesh(PolygonMesh::default()).size(), 0.0);
        let points = vec![DVec3::ZERO, DVec3::new(3.0, 4.0, 0.0)];
        assert_eq!(Model::Mesh(PolygonMesh { points, ..PolygonMesh::default() }).size(), 5.0);
    }
}
