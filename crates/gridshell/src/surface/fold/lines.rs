//! Where a patch folds: lines of constant u or v at knots as frequent as the degree, where its normal jumps.

use crate::math::trig;
use crate::surface::Shape;
use crate::surface::exact::nurbs::NurbsSurface;
use glam::DVec2;

/// The normal jumps where it turns by more than this, radians: less is rounding of knots and points.
const JUMP: f64 = 1e-3;
/// Of more folds than this in one direction, those below [`FACET`] are facets of a smooth shape, which needs no
/// edges there: they would only make its carrier narrower than its panels.
const MANY: usize = 24;
/// Radians.
const FACET: f64 = 0.1;
/// The step beside a fold to where the normal is looked at, over the knot span there.
const BESIDE: f64 = 1e-6;
/// A line does not reach farther than this share of the way to the next knot.
const REACH: f64 = 0.02;

/// The folds of one patch, in u and in v, within its domain.
pub(super) struct Lines {
    folds: [Vec<f64>; 2],
    /// Whether the patch folds where it closes.
    seam: [bool; 2],
}

/// A line along which loops are cut.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    /// The parameter that is constant: 0 for u, 1 for v.
    pub fixed: usize,
    /// Its value; past the domain where the patch closes.
    pub value: f64,
    /// Places up to this far from it, in that parameter and in the other one, lie on it or on each other.
    pub near: [f64; 2],
}

impl Lines {
    /// The folds of `patch`; None where it has none.
    pub fn of(shape: &Shape) -> Option<Lines> {
        let Shape::Nurbs(patch) = shape else { return None };
        let mut lines = Lines { folds: [Vec::new(), Vec::new()], seam: [false; 2] };
        for k in 0..2 {
            let domain = patch.domain()[k];
            let mut folds = Vec::new();
            for value in joints(patch, k) {
                let turn = turn(shape, patch, k, [value, value]);
                if turn > JUMP && meets(patch, k, value) {
                    folds.push((value, turn));
                }
            }
            if folds.len() > MANY {
                folds.retain(|f| f.1 > FACET);
            }
            lines.folds[k] = folds.into_iter().map(|f| f.0).collect();
            lines.seam[k] =
                patch.closed()[k] && turn(shape, patch, k, [domain[1], domain[0]]) > JUMP;
        }
        let any = (0..2).any(|k| lines.seam[k] || !lines.folds[k].is_empty());
        any.then_some(lines)
    }

    /// The lines strictly between two corners of (u, v), in u and in v, ascending. A patch that closes, and is cut
    /// anywhere, is cut where its domain ends too. `snap` is how near is on a line, metres.
    pub fn within(&self, shape: &Shape, lo: DVec2, hi: DVec2, snap: f64) -> [Vec<Line>; 2] {
        let cut = !self.folds[0].is_empty() || !self.folds[1].is_empty();
        [0, 1].map(|k| {
            let ([first, last], closed) = (shape.domain()[k], shape.closed()[k]);
            let period = last - first;
            let mut base = self.folds[k].clone();
            if closed && (cut || self.seam[k]) {
                base.insert(0, first);
            }
            let (from, to) = if closed {
                let turns = |t: f64| ((t - first) / period).floor();
                (turns(lo[k]), turns(hi[k]))
            } else {
                (0.0, 0.0)
            };
            let mut all = Vec::new();
            let mut turn = from;
            while turn <= to {
                let values = base.iter().map(|b| (b, b + turn * period));
                let lines = values.filter(|(_, value)| *value > lo[k] && *value < hi[k]);
                all.extend(lines.map(|(b, value)| line(shape, k, *b, value, snap)));
                turn += 1.0;
            }
            all
        })
    }

    /// The piece of `patch` between the cuts about `uv`, which may lie past the domain.
    pub fn piece(&self, patch: &NurbsSurface, uv: DVec2) -> Option<NurbsSurface> {
        let mut sides = [[None; 2]; 2];
        for k in 0..2 {
            let ([first, last], closed) = (patch.domain()[k], patch.closed()[k]);
            let mut t = uv[k];
            if closed {
                t -= ((t - first) / (last - first)).floor() * (last - first);
            }
            let at = self.folds[k].partition_point(|&l| l <= t);
            sides[k] = [at.checked_sub(1), Some(at)].map(|i| self.folds[k].get(i?).copied());
        }
        patch.between(sides)
    }
}

/// Knots of direction `k` inside the domain that are as frequent as the degree.
fn joints(patch: &NurbsSurface, k: usize) -> Vec<f64> {
    let (degree, knots, [first, last]) = (patch.degree[k], &patch.knots[k], patch.domain()[k]);
    let often = knots.windows(degree).filter(|w| w[0] == w[degree - 1]).map(|w| w[0]);
    let mut joints: Vec<f64> = often.filter(|&t| t > first && t < last).collect();
    joints.dedup();
    joints
}

/// Whether both sides of a joint end in the same points.
fn meets(patch: &NurbsSurface, k: usize, value: f64) -> bool {
    let knots = &patch.knots[k];
    let often = knots.iter().filter(|&&t| t == value).count();
    // One more than the degree parts the patch, unless the points are there twice.
    if often <= patch.degree[k] {
        return true;
    }
    let last = knots.partition_point(|&t| t <= value) - 1 - patch.degree[k];
    let point = |i: usize, j: usize| {
        patch.points[if k == 0 { i * patch.count[1] + j } else { j * patch.count[1] + i }]
    };
    (0..patch.count[1 - k]).all(|j| point(last - 1, j) == point(last, j))
}

/// The largest turn of the normal along a line: from just before the first value to just after the second.
fn turn(shape: &Shape, patch: &NurbsSurface, k: usize, [before, after]: [f64; 2]) -> f64 {
    let breaks = patch.breaks(k);
    let i = breaks.partition_point(|&b| b < before);
    let j = breaks.partition_point(|&b| b <= after);
    let (Some(low), Some(high)) = (i.checked_sub(1).map(|i| breaks[i]), breaks.get(j)) else {
        return 0.0;
    };
    let sides = [before - BESIDE * (before - low), after + BESIDE * (high - after)];
    let normal = |side: f64, along: f64| {
        let uv = if k == 0 { DVec2::new(side, along) } else { DVec2::new(along, side) };
        shape.jet(uv).normal()
    };
    let lattice = shape.lattice(1 - k);
    // Not on knots, where lines of the other direction may fold, but beside them.
    let places = lattice.windows(2).map(|w| 0.5 * (w[0] + w[1]));
    let turns = places.map(|along| {
        let [m, n] = sides.map(|side| normal(side, along));
        if m.length() * n.length() > 0.0 { trig::angle(m, n) } else { 0.0 }
    });
    turns.fold(0.0, f64::max)
}

/// The line at `value`, which is `base` within the domain.
fn line(shape: &Shape, k: usize, base: f64, value: f64, snap: f64) -> Line {
    let breaks = shape.spline().map_or(Vec::new(), |patch| patch.breaks(k));
    let lattice = shape.lattice(1 - k);
    let mut speed = [0.0_f64; 2];
    for along in lattice.iter().step_by(lattice.len().div_ceil(64)) {
        let uv = if k == 0 { DVec2::new(base, *along) } else { DVec2::new(*along, base) };
        let jet = shape.jet(uv);
        let [across, down] = if k == 0 { [jet.du, jet.dv] } else { [jet.dv, jet.du] };
        speed = [speed[0].max(across.length()), speed[1].max(down.length())];
    }
    let i = breaks.partition_point(|&b| b < base);
    let room = |i: Option<usize>| i.and_then(|i| breaks.get(i)).map(|b| (b - base).abs());
    let next = [room(i.checked_sub(1)), room(Some(i + 1))];
    let next = next.into_iter().flatten().fold(f64::MAX, f64::min);
    let width = lattice[lattice.len() - 1] - lattice[0];
    let least = f64::MIN_POSITIVE;
    Line {
        fixed: k,
        value,
        near: [
            (snap / speed[0].max(least)).min(REACH * next),
            (snap / speed[1].max(least)).min(REACH * width),
        ],
    }
}
