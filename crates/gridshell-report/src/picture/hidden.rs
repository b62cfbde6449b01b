//! What is hidden behind panels.

use gridshell::design::Design;

/// Panels as the camera sees them, sorted into the squares of a raster.
pub struct Cover<'a> {
    seen: &'a [[f64; 3]],
    panels: &'a [[u32; 3]],
    low: [f64; 2],
    /// Side of a square, metres.
    side: f64,
    /// Squares across and down.
    count: [usize; 2],
    /// The panels that reach into each square.
    squares: Vec<Vec<u32>>,
    /// What lies less than this behind a panel lies on it, metres.
    near: f64,
}

/// A place on a panel, over the mean member length.
const NEAR: f64 = 0.1;
/// No more squares than this across or down.
const MOST: usize = 1000;

impl<'a> Cover<'a> {
    /// The panels of a grid whose nodes are seen at these places.
    pub fn new(design: &'a Design, seen: &'a [[f64; 3]]) -> Cover<'a> {
        let panels = &design.schedule.panels.nodes;
        let mean = design.schedule.figures.length.spread.mean;
        let least = |k: usize| seen.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
        let most = |k: usize| seen.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
        let low = [least(0), least(1)];
        let size = [most(0) - low[0], most(1) - low[1]];
        let side = mean.max(size[0].max(size[1]) / MOST as f64).max(f64::MIN_POSITIVE);
        let count = size.map(|s| (s / side) as usize + 1);
        let squares = vec![Vec::new(); count[0] * count[1]];
        let mut cover = Cover { seen, panels, low, side, count, squares, near: NEAR * mean };
        for (k, t) in panels.iter().enumerate() {
            let corners = t.map(|v| cover.square([seen[v as usize][0], seen[v as usize][1]]));
            let bound = |i: usize| {
                let [a, b, c] = corners.map(|s| s[i]);
                a.min(b).min(c)..=a.max(b).max(c)
            };
            for (x, y) in bound(1).flat_map(|y| bound(0).map(move |x| (x, y))) {
                cover.squares[y * cover.count[0] + x].push(k as u32);
            }
        }
        cover
    }

    fn square(&self, p: [f64; 2]) -> [usize; 2] {
        [0, 1].map(|k| (((p[k] - self.low[k]) / self.side) as usize).min(self.count[k] - 1))
    }

    /// Whether a panel lies before this place.
    pub fn hides(&self, [x, y, depth]: [f64; 3]) -> bool {
        let [column, row] = self.square([x, y]);
        let near = &self.squares[row * self.count[0] + column];
        near.iter().any(|&k| {
            let [a, b, c] = self.panels[k as usize].map(|v| self.seen[v as usize]);
            let cross = |p: [f64; 3], q: [f64; 3], r: [f64; 2]| {
                (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
            };
            let area = cross(a, b, [c[0], c[1]]);
            let share = [cross(b, c, [x, y]), cross(c, a, [x, y]), cross(a, b, [x, y])];
            let share = share.map(|s| s / area);
            // Not so for panels seen edge on, whose shares are no numbers.
            let inside = share.iter().all(|&s| s >= 0.0);
            inside && share[0] * a[2] + share[1] * b[2] + share[2] * c[2] < depth - self.near
        })
    }
}
