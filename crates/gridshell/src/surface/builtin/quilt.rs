//! One net of control points cut into patches that share their edges exactly.

use super::known;
use super::sketch::{Sketch, against, along};
use crate::surface::Shape;
use crate::surface::exact::nurbs::NurbsCurve;
use glam::DVec3;

/// A control point and its weight.
pub(super) type Control = (DVec3, f64);

/// A tensor-product net in pieces, all of the same degrees and knots; neighbours share a row of control points.
pub(super) struct Quilt<F> {
    /// Degrees along u and v.
    pub degree: [usize; 2],
    /// Knots of one piece along u and v.
    pub knots: [Vec<f64>; 2],
    /// Number of pieces along u and v.
    pub pieces: [usize; 2],
    /// Whether the last piece joins the first one.
    pub closed: [bool; 2],
    /// Control points by their places along u and v; on a closed side the last place is the first one again.
    pub control: F,
}

/// Knots of one piece without inner ones, a Bézier piece.
pub(super) fn bezier(degree: usize) -> Vec<f64> {
    [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat()
}

impl<F: Fn(usize, usize) -> Control> Quilt<F> {
    /// Add the pieces `wanted`, of which no two neighbours may be missing, with their vertices and edges. Gives
    /// the edges along u that start at piece i and row j, by `[i][j]`.
    pub(super) fn sew(
        &self,
        sketch: &mut Sketch,
        wanted: impl Fn(usize, usize) -> bool,
    ) -> Vec<Vec<u32>> {
        let [m, n] = self.pieces;
        // Joints along u and v; on a closed side the last one is the first one.
        let [columns, rows] = [0, 1].map(|k| self.pieces[k] + usize::from(!self.closed[k]));
        let [du, dv] = [0, 1].map(|k| self.knots[k].len() - self.degree[k] - 2);
        let vertices: Vec<Vec<u32>> = (0..columns)
            .map(|i| (0..rows).map(|j| sketch.vertex((self.control)(i * du, j * dv).0)).collect())
            .collect();
        let vertex = |i: usize, j: usize| vertices[i % columns][j % rows];
        let along_u: Vec<Vec<u32>> = (0..m)
            .map(|i| {
                let edge = |j: usize| {
                    let curve = self.curve(0, |k| (self.control)(i * du + k, j * dv));
                    sketch.whole(curve, [vertex(i, j), vertex(i + 1, j)])
                };
                (0..rows).map(edge).collect()
            })
            .collect();
        let along_v: Vec<Vec<u32>> = (0..columns)
            .map(|i| {
                let edge = |j: usize| {
                    let curve = self.curve(1, |k| (self.control)(i * du, j * dv + k));
                    sketch.whole(curve, [vertex(i, j), vertex(i, j + 1)])
                };
                (0..n).map(edge).collect()
            })
            .collect();
        for (i, j) in (0..m).flat_map(|i| (0..n).map(move |j| (i, j))) {
            if !wanted(i, j) {
                continue;
            }
            let outline = vec![
                along(along_u[i][j]),
                along(along_v[(i + 1) % columns][j]),
                against(along_u[i][(j + 1) % rows]),
                against(along_v[i][j]),
            ];
            sketch.face(self.patch(i * du, j * dv), vec![outline]);
        }
        along_u
    }

    /// A curve along direction `k` through the net.
    fn curve(&self, k: usize, control: impl Fn(usize) -> Control) -> NurbsCurve {
        let count = self.knots[k].len() - self.degree[k] - 1;
        let (points, weights) = (0..count).map(control).unzip();
        known::curve(self.degree[k], self.knots[k].clone(), points, plain(weights))
    }

    /// The piece whose first control point stands at (`a`, `b`).
    fn patch(&self, a: usize, b: usize) -> Shape {
        let count = [0, 1].map(|k| self.knots[k].len() - self.degree[k] - 1);
        let net =
            (0..count[0]).flat_map(|i| (0..count[1]).map(move |j| (self.control)(a + i, b + j)));
        let (points, weights) = net.unzip();
        let knots = self.knots.clone();
        Shape::Nurbs(known::surface(self.degree, knots, count, points, plain(weights)))
    }
}

/// No weights where all are 1: a polynomial is evaluated faster than a quotient.
fn plain(weights: Vec<f64>) -> Vec<f64> {
    if weights.iter().all(|&w| w == 1.0) { Vec::new() } else { weights }
}
