//! A free-form roof of 78 x 39 x 12 m: one bicubic patch, trimmed to a rounded outline with two voids and
//! an open notch. The patch parameters are x and y, so the trimming curves are drawn in plan.

use super::known;
use super::sketch::{Sketch, against, along};
use super::spline::{clamped, clamped_knots, closed, greville};
use crate::math::trig::exp;
use crate::surface::exact::nurbs::NurbsCurve;
use crate::surface::{Brep, Curve, Shape};
use glam::DVec3;
use std::sync::Arc;

/// Control points along x and y.
const COUNT: [usize; 2] = [17, 11];
/// Half the size of the untrimmed patch, metres.
const HALF: [f64; 2] = [42.0, 22.0];

/// The outline from the notch's eastern corner round to its western one.
const OUTLINE: &[[f64; 2]] = &[
    [26.5, -17.2],
    [29.5, -16.9],
    [34.5, -13.5],
    [38.6, -7.0],
    [39.4, 1.5],
    [36.8, 11.0],
    [27.5, 17.6],
    [14.0, 19.6],
    [0.0, 20.0],
    [-14.0, 18.9],
    [-27.5, 16.6],
    [-36.8, 9.5],
    [-39.6, 0.0],
    [-36.2, -9.8],
    [-27.0, -16.4],
    [-13.0, -19.2],
    [0.0, -19.9],
    [9.5, -19.5],
    [14.0, -19.0],
];

/// The notch, from its western corner to its eastern one.
const NOTCH: &[[f64; 2]] = &[
    [14.0, -19.0],
    [16.2, -14.5],
    [17.4, -8.8],
    [22.6, -6.2],
    [25.2, -9.6],
    [25.4, -13.8],
    [26.5, -17.2],
];

/// The small void in the west.
const WEST: &[[f64; 2]] = &[
    [-21.6, 5.0],
    [-24.0, 9.2],
    [-28.6, 9.6],
    [-32.0, 6.0],
    [-31.2, 1.4],
    [-27.0, -0.6],
    [-22.8, 1.0],
];

/// The long void in the middle.
const MIDDLE: &[[f64; 2]] = &[
    [9.0, 3.6],
    [4.0, 6.4],
    [-4.0, 4.4],
    [-11.6, 0.6],
    [-15.4, -4.6],
    [-12.2, -8.0],
    [-4.4, -6.8],
    [4.0, -3.4],
    [8.8, 0.0],
];

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("roof");
    let patch = Arc::new(patch());
    let on_roof = |uv: NurbsCurve| Curve::OnShape(Arc::clone(&patch), uv);
    let [east_corner, west_corner] =
        [OUTLINE[0], NOTCH[0]].map(|[x, y]| sketch.vertex(patch.point(glam::DVec2::new(x, y))));
    let outline = sketch.edge(on_roof(clamped(OUTLINE)), [0.0, 1.0], [east_corner, west_corner]);
    let notch = sketch.edge(on_roof(clamped(NOTCH)), [0.0, 1.0], [west_corner, east_corner]);
    let mut loops = vec![vec![along(outline), along(notch)]];
    for hole in [WEST, MIDDLE] {
        let (curve, range) = closed(hole);
        loops.push(vec![against(sketch.ring(on_roof(curve), range))]);
    }
    sketch.face(patch.as_ref().clone(), loops);
    sketch.finish()
}

fn patch() -> Shape {
    let knots = [0, 1].map(|k| clamped_knots(COUNT[k], -HALF[k], HALF[k]));
    let (xs, ys) = (greville(&knots[0]), greville(&knots[1]));
    let points =
        xs.iter().flat_map(|&x| ys.iter().map(move |&y| DVec3::new(x, y, height(x, y)))).collect();
    Shape::Nurbs(known::surface([3, 3], knots, COUNT, points, Vec::new()))
}

/// Height of the control net: a high crest between the notch and the long void, a second one between the two
/// voids, low ends, and a rim that is lifted over the entrance in the north.
fn height(x: f64, y: f64) -> f64 {
    let hill = |cx: f64, cy: f64, wx: f64, wy: f64| {
        let (p, q) = ((x - cx) / wx, (y - cy) / wy);
        exp(-p * p - q * q)
    };
    0.3 + 14.2 * hill(17.5, 4.5, 13.5, 12.5)
        + 10.4 * hill(-17.5, 4.0, 12.0, 12.0)
        + 3.0 * hill(-38.0, -4.0, 9.0, 11.0)
        + 3.4 * hill(41.0, 0.0, 9.0, 12.0)
        + 4.2 * hill(-2.0, 21.0, 11.0, 9.0)
        + 2.6 * hill(-4.0, -22.0, 12.0, 8.0)
}
