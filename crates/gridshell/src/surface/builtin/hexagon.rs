//! A plane regular hexagon of side 4 m: the case whose answer is known, the perfect lattice of 61 nodes.

use super::sketch::Sketch;
use crate::surface::{Brep, Shape};
use glam::DVec3;

const SIDE: f64 = 4.0;

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("hexagon");
    // Half the height of an equilateral triangle over the side.
    let h = SIDE * 3.0_f64.sqrt() / 2.0;
    let half = SIDE / 2.0;
    let corners = [[SIDE, 0.0], [half, h], [-half, h], [-SIDE, 0.0], [-half, -h], [half, -h]];
    let outline = sketch.polygon(&corners.map(|[x, y]| DVec3::new(x, y, 0.0)));
    sketch.face(Shape::Height(|_, _| [0.0; 3]), vec![outline]);
    sketch.finish()
}
