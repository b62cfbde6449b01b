//! A pyramid roof over a square of 16 m, 6 m high: four plane faces, four creases, an apex.

use super::known;
use super::quilt::bezier;
use super::sketch::{Sketch, against, along};
use crate::surface::{Brep, Shape};
use glam::DVec3;

/// Half the side of the square, metres.
const HALF: f64 = 8.0;
/// Height of the apex over the square, metres.
const HEIGHT: f64 = 6.0;

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("pyramid");
    let corners = [[-HALF, -HALF], [HALF, -HALF], [HALF, HALF], [-HALF, HALF]]
        .map(|[x, y]| DVec3::new(x, y, 0.0));
    let apex = DVec3::Z * HEIGHT;
    let ids = corners.map(|c| sketch.vertex(c));
    let top = sketch.vertex(apex);
    let eaves = [0, 1, 2, 3].map(|k| sketch.line(ids[k], ids[(k + 1) % 4]));
    let creases = ids.map(|id| sketch.line(id, top));
    for k in 0..4 {
        let outline = vec![along(eaves[k]), along(creases[(k + 1) % 4]), against(creases[k])];
        let (a, b) = (corners[k], corners[(k + 1) % 4]);
        let up = apex - (a + b) / 2.0;
        let plane = known::surface(
            [1, 1],
            [bezier(1), bezier(1)],
            [2, 2],
            vec![a, a + up, b, b + up],
            Vec::new(),
        );
        sketch.face(Shape::Nurbs(plane), vec![outline]);
    }
    sketch.finish()
}
