//! A free-form roof of 78 x 39 x 12 m: one bicubic patch, trimmed to a rounded outline with two voids and
//! an open notch. The patch parameters are x and y, so the trimming curves are drawn in plan.

use super::known;
use super::sketch::{Sketch, against, along};
use super::spline::{clamped, clamped_knots, closed, greville};
use crate::math::trig::exp;
use crate::surface::nurbs::NurbsCurve;
use crate::surface::{Brep, Curve, Shape};
use glam::DVec3;
use std::sync::Arc;

/// Control points along x and y.
const COUNT: [usize; 2] = [17, 11];
/// Half the size of the untrimmed patch, metres.
const HALF: [f64; 2] = [42.0, 22.0];

/// The outline from the notch's eastern corner round to its western one.
const OUTLINE: &[[f64; 2]] = &[
    [-1.5, -19.2],
    [6.0, -19.6],
    [16.0, -19.9],
    [29.0, -18.5],
    [38.6, -11.5],
    [40.4, -1.0],
    [38.4, 10.0],
    [28.5, 17.8],
    [14.0, 20.0],
    [0.0, 19.4],
    [-14.0, 18.6],
    [-28.0, 17.6],
    [-37.6, 11.0],
    [-40.6, 0.5],
    [-38.2, -10.5],
    [-29.5, -17.2],
    [-21.0, -18.5],
    [-15.0, -18.8],
];

/// The notch, from its western corner to its eastern one.
const NOTCH: &[[f64; 2]] = &[
    [-15.0, -18.8],
    [-13.6, -15.0],
    [-12.8, -9.0],
    [-8.0, -6.6],
    [-4.0, -9.4],
    [-3.2, -15.2],
    [-1.5, -19.2],
];

/// The void under the western crest.
const WEST: &[[f64; 2]] = &[
    [-15.5, 3.0],
    [-17.0, 7.6],
    [-22.0, 9.0],
    [-27.0, 6.4],
    [-28.4, 1.6],
    [-24.6, -2.2],
    [-19.0, -1.8],
];

/// The larger void between the two eastern crests.
const EAST: &[[f64; 2]] = &[
    [26.4, 0.5],
    [24.0, 5.6],
    [17.5, 8.0],
    [10.5, 5.6],
    [6.8, 0.2],
    [9.6, -4.6],
    [16.0, -6.4],
    [23.0, -4.6],
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
    for hole in [WEST, EAST] {
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

/// Height of the control net: crests over the two halls, a low waist between them, lips at the ends.
fn height(x: f64, y: f64) -> f64 {
    let hill = |cx: f64, cy: f64, wx: f64, wy: f64| {
        let (p, q) = ((x - cx) / wx, (y - cy) / wy);
        exp(-p * p - q * q)
    };
    13.0 * hill(17.0, 1.0, 17.0, 13.0)
        + 10.5 * hill(-23.0, 2.0, 14.0, 12.0)
        + 2.6 * hill(-4.0, 14.0, 9.0, 9.0)
        + 2.2 * hill(-42.0, 0.0, 9.0, 12.0)
        + 2.6 * hill(42.0, 0.0, 9.0, 12.0)
}
