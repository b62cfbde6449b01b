//! The box of the exact surface.
//!
//! The carrier's vertices lie on the surface, and its farthest point along an axis is near one of them: inside a
//! triangle that bends away from the vertex, or on a model edge between two. Only those triangles and edges are searched,
//! on the exact patch and curve. A smooth maximum is found to about 1e-12 of the surface's size, one inside a patch and
//! right beside a model edge to 1e-8.

use super::SurfacePoint;
use crate::surface::Surface;
use glam::DVec3;

/// Steps of the search shrink by half from half a triangle to below this share of it; a smooth maximum is then
/// missed by its square.
const LEAST_STEP: f64 = 1e-7;
/// But along an oblique ridge steps stay short: the search ends after so many rounds, where it has come to.
const MOST_ROUNDS: usize = 300;
/// A place in a triangle is on its edge below this barycentric coordinate. Were it smaller, points of the patch beyond
/// a curved edge would count; were it larger, tops beside an edge would be lost.
const ON_EDGE: f64 = 1e-3;
/// A bow between the ends of an edge is no higher than this many times what its middle is above theirs.
const BOW: f64 = 2.0;
/// What lies above the best by less than this share of the size is not looked for.
const SAME: f64 = 1e-13;
/// Inverse of the golden ratio, and the steps of a search by it that leave 1e-9 of a range.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
const GOLDEN_STEPS: usize = 44;

impl Surface {
    /// Least and largest coordinates of the exact surface, local; zero where it is empty.
    pub fn extent(&self) -> [DVec3; 2] {
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let points = self.carrier.points.iter();
        let (low, high) = points.fold(start, |(low, high), &p| (low.min(p), high.max(p)));
        if !low.is_finite() {
            return [DVec3::ZERO; 2];
        }
        if self.shapes.is_empty() {
            return [low, high];
        }
        let same = SAME * (high - low).length();
        let reach: Vec<f64> = (0..self.carrier.triangles.len()).map(|t| self.reach(t)).collect();
        let farthest = |axis: DVec3, from: f64| self.farthest(axis, from, &reach, same);
        let axes = DVec3::AXES;
        [
            DVec3::from([0, 1, 2].map(|k| -farthest(-axes[k], -low[k]))),
            DVec3::from([0, 1, 2].map(|k| farthest(axes[k], high[k]))),
        ]
    }

    /// How far the exact patch may rise above the corners of a triangle: its longest side, turned by as much as the
    /// normals differ.
    fn reach(&self, t: usize) -> f64 {
        let corners = self.carrier.corners(t as u32);
        let normals = self.carrier.triangles[t].map(|v| self.carrier.normals[v as usize]);
        let most = |p: [DVec3; 3]| {
            [0, 1, 2].map(|k| p[k].distance(p[(k + 1) % 3])).into_iter().fold(0.0, f64::max)
        };
        most(corners) * most(normals)
    }

    /// How far the surface goes along `axis`, of which the carrier's vertices reach `best`.
    fn farthest(&self, axis: DVec3, mut best: f64, reach: &[f64], same: f64) -> f64 {
        let height = |v: u32| axis.dot(self.carrier.points[v as usize]);
        for ((a, b), track) in self.tracks.iter() {
            let Some(curve) = self.curves.get(track.curve as usize) else { continue };
            let at =
                |share: f64| axis.dot(curve.point(track.t[0] + (track.t[1] - track.t[0]) * share));
            let ends = [height(a), height(b)];
            let bow = (at(0.5) - 0.5 * (ends[0] + ends[1])).abs();
            if ends[0].max(ends[1]) + BOW * bow > best + same {
                best = best.max(top_of_edge(at));
            }
        }
        let top = |t: usize| {
            let corners = self.carrier.triangles[t].map(height);
            corners.into_iter().fold(f64::NEG_INFINITY, f64::max)
        };
        let mut open: Vec<(f64, usize)> = (reach.iter().enumerate())
            .map(|(t, reach)| (top(t) + reach, t))
            .filter(|o| o.0 > best + same)
            .collect();
        open.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (bound, t) in open {
            if bound <= best + same {
                break;
            }
            best = best.max(self.top_of_triangle(axis, t).unwrap_or(best));
        }
        best
    }

    /// The highest point of the patch over a triangle, by steps that shrink; None on a model edge, where the curve
    /// decides.
    fn top_of_triangle(&self, axis: DVec3, t: usize) -> Option<f64> {
        let at = |bary: [f64; 3]| axis.dot(self.exact(&SurfacePoint { triangle: t as u32, bary }));
        let mut bary = [1.0 / 3.0; 3];
        let mut top = at(bary);
        let mut step = 0.5;
        for _ in 0..MOST_ROUNDS {
            if step < LEAST_STEP {
                break;
            }
            let mut moved = false;
            for (from, to) in [(0, 1), (1, 2), (2, 0), (1, 0), (2, 1), (0, 2)] {
                let by = step.min(bary[from]);
                let mut next = bary;
                next[from] -= by;
                next[to] += by;
                let height = at(next);
                if height > top {
                    (bary, top, moved) = (next, height, true);
                }
            }
            if !moved {
                step *= 0.5;
            }
        }
        let corners = self.carrier.triangles[t];
        let on_edge = (0..3).any(|k| {
            let [a, b] = [corners[(k + 1) % 3], corners[(k + 2) % 3]];
            bary[k] < ON_EDGE && self.tracks.get(a, b).is_some()
        });
        (!on_edge).then_some(top)
    }
}

/// The greatest value over [0, 1] of a function with one maximum, by golden section.
fn top_of_edge(at: impl Fn(f64) -> f64) -> f64 {
    let [mut low, mut high] = [0.0, 1.0];
    let mut inner = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let mut heights = inner.map(&at);
    for _ in 0..GOLDEN_STEPS {
        if heights[0] >= heights[1] {
            high = inner[1];
            inner = [high - GOLDEN * (high - low), inner[0]];
            heights = [at(inner[0]), heights[0]];
        } else {
            low = inner[0];
            inner = [inner[1], low + GOLDEN * (high - low)];
            heights = [heights[1], at(inner[1])];
        }
    }
    heights[0].max(heights[1])
}

#[cfg(test)]
mod tests {
    use crate::job::Job;
    use crate::surface::{Sampling, builtin};
    use glam::DVec3;

    fn extent(name: &str, max_edge: f64) -> [DVec3; 2] {
        let sampling = Sampling { max_edge, chord_error: 0.02 * max_edge, corner_angle: 0.5 };
        builtin::model(name).unwrap().surface(&sampling, &Job::default()).unwrap().extent()
    }

    /// Tops inside patches, at poles and seams, and on curved edges; however coarse the carrier is.
    #[test]
    fn the_box_is_that_of_the_exact_surface() {
        for max_edge in [1.7, 0.9] {
            let [low, high] = extent("sphere", 2.0 * max_edge);
            let r = high.z;
            assert!((high - DVec3::splat(r)).abs().max_element() < 1e-9 * r, "{high}");
            assert!((low + DVec3::splat(r)).abs().max_element() < 1e-9 * r, "{low}");
            let [low, high] = extent("dome", max_edge);
            let r = high.z;
            assert!((high - DVec3::splat(r)).abs().max_element() < 1e-9 * r, "{high}");
            assert!((low - DVec3::new(-r, -r, 0.0)).abs().max_element() < 1e-9 * r, "{low}");
            let [low, high] = extent("barrel", 2.0 * max_edge);
            assert!((high.z - low.z - 6.0).abs() < 1e-9, "{low} {high}");
            let [low, high] = extent("torus", max_edge);
            assert!((high.x + low.x).abs() < 1e-9 && (high.x - high.y).abs() < 1e-9, "{high}");
        }
    }
}
