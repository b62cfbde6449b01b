//! A closed torus of radii 10 and 4 m: four rational biquadratic patches, half a turn each way.

use super::conic::{CIRCLE_POINTS, CIRCLE_WEIGHTS};
use super::known;
use super::sketch::{Sketch, against, along};
use crate::surface::nurbs::NurbsCurve;
use crate::surface::{Brep, Shape};
use glam::DVec3;

/// From the axis to the middle of the tube, metres.
const MAJOR: f64 = 10.0;
/// Radius of the tube, metres.
const MINOR: f64 = 4.0;
/// Knots of half a circle of two quadratic quarters.
const HALF_KNOTS: [f64; 8] = [0.0, 0.0, 0.0, 0.5, 0.5, 1.0, 1.0, 1.0];

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("torus");
    // Vertices and edges are numbered by where they start: half turn i round the axis, j round the tube.
    let vertices = [0, 1].map(|i| [0, 1].map(|j| sketch.vertex(control(4 * i, 4 * j).0)));
    let round_axis = [0, 1].map(|i| {
        [0, 1].map(|j| {
            let curve = half_circle(|k| control(4 * i + k, 4 * j));
            sketch.whole(curve, [vertices[i][j], vertices[1 - i][j]])
        })
    });
    let round_tube = [0, 1].map(|i| {
        [0, 1].map(|j| {
            let curve = half_circle(|k| control(4 * i, 4 * j + k));
            sketch.whole(curve, [vertices[i][j], vertices[i][1 - j]])
        })
    });
    for i in 0..2 {
        for j in 0..2 {
            let outline = vec![
                along(round_axis[i][j]),
                along(round_tube[1 - i][j]),
                against(round_axis[i][1 - j]),
                against(round_tube[i][j]),
            ];
            sketch.face(patch(i, j), vec![outline]);
        }
    }
    sketch.finish()
}

/// Control point and weight of the whole torus: `a` round the axis, `b` round the tube, 0 to 8 each.
fn control(a: usize, b: usize) -> (DVec3, f64) {
    let [x, y] = CIRCLE_POINTS[a];
    let [out, up] = CIRCLE_POINTS[b];
    let rho = MAJOR + MINOR * out;
    (DVec3::new(rho * x, rho * y, MINOR * up), CIRCLE_WEIGHTS[a] * CIRCLE_WEIGHTS[b])
}

fn half_circle(control: impl Fn(usize) -> (DVec3, f64)) -> NurbsCurve {
    let (points, weights) = (0..5).map(control).unzip();
    known::curve(2, HALF_KNOTS.to_vec(), points, weights)
}

fn patch(i: usize, j: usize) -> Shape {
    let net = (0..5).flat_map(|a| (0..5).map(move |b| control(4 * i + a, 4 * j + b)));
    let (points, weights) = net.unzip();
    Shape::Nurbs(known::surface(
        [2, 2],
        [HALF_KNOTS.to_vec(), HALF_KNOTS.to_vec()],
        [5, 5],
        points,
        weights,
    ))
}
