//! Balance round an edit: Gauss-Newton on lengths and straight lines over a few nodes, all else held.
//!
//! The same problem as [`crate::balance`] solves for a whole grid, small enough for a dense factorization.

use super::state::State;
use crate::grid::Place;
use crate::math::frame::tangents;
use glam::DVec3;
use smallvec::SmallVec;

/// Damping of the normal equations, relative to a spring.
const DAMPING: f64 = 1e-4;
/// Largest move of a node in one step, over the wanted length.
const REACH: f64 = 0.25;

/// Buffers that outlive one balance.
#[derive(Clone, Default)]
pub struct Local {
    /// First unknown of each node of the region, and the directions in which it may move.
    nodes: Vec<(usize, SmallVec<[DVec3; 2]>)>,
    matrix: Vec<f64>,
    right: Vec<f64>,
}

/// What to balance for.
pub struct Aim {
    /// Wanted length, metres.
    pub mean: f64,
    /// Weight of straight lines.
    pub straightness: f64,
    /// Weight of the lengths of members that touch the border.
    pub border: f64,
}

/// A node in a residual: its place in the region (None outside) and its coefficient.
type Term = (Option<usize>, DVec3);

impl Local {
    /// Move the nodes of the region *last gathered* towards `aim` in `steps` steps. `rim` holds the region and
    /// one ring more.
    pub fn balance(
        &mut self,
        state: &mut State,
        region: &[u32],
        rim: &[u32],
        aim: &Aim,
        steps: usize,
    ) {
        self.lay_out(state, region);
        let n = self.right.len();
        for step in 0..steps {
            let factorize = step == 0;
            self.linearize(state, region, rim, aim, factorize);
            if factorize && !cholesky(&mut self.matrix, n) {
                return;
            }
            solve(&self.matrix, &mut self.right);
            let moves: Vec<DVec3> = self
                .nodes
                .iter()
                .map(|(at, axes)| {
                    axes.iter().enumerate().map(|(k, &t)| t * self.right[at + k]).sum()
                })
                .collect();
            let longest = moves.iter().map(|m: &DVec3| m.length()).fold(0.0, f64::max);
            let scale = (REACH * aim.mean / longest).min(1.0);
            for (&v, d) in region.iter().zip(&moves) {
                state.slide(v, *d * scale);
            }
        }
    }

    fn lay_out(&mut self, state: &State, region: &[u32]) {
        self.nodes.clear();
        let mut at = 0;
        for &v in region {
            let axes = axes(state, v);
            self.nodes.push((at, axes));
            at += self.nodes.last().map_or(0, |n| n.1.len());
        }
        self.right.clear();
        self.right.resize(at, 0.0);
    }

    fn linearize(
        &mut self,
        state: &State,
        region: &[u32],
        rim: &[u32],
        aim: &Aim,
        with_matrix: bool,
    ) {
        let n = self.right.len();
        self.right.fill(0.0);
        if with_matrix {
            self.matrix.clear();
            self.matrix.resize(n * n, 0.0);
            for i in 0..n {
                self.matrix[i * n + i] = DAMPING;
            }
        }
        let grid = &state.grid;
        let local = |v: u32| state.slot_in_region(v);
        for (i, &v) in region.iter().enumerate() {
            for &w in grid.mesh.ring(v) {
                let j = local(w);
                if j.is_some_and(|j| j < i) {
                    continue;
                }
                let (chord, length) = state.member(v, w);
                let u = chord.normalize_or_zero();
                let u = u / state.scale(v, w);
                let at_border = grid.mesh.is_boundary(v) || grid.mesh.is_boundary(w);
                let weight = if at_border { aim.border } else { 1.0 };
                self.add_length([(Some(i), -u), (j, u)], length - aim.mean, weight, with_matrix);
            }
        }
        for &v in rim {
            let mesh = &grid.mesh;
            if mesh.is_boundary(v) || mesh.degree(v) != 6 {
                continue;
            }
            let ring = mesh.ring(v);
            let at = grid.xyz[v as usize];
            let here = local(v);
            let normal = grid.places[v as usize].normal(state.surface);
            for k in 0..3 {
                let (a, b) = (ring[k], ring[k + 3]);
                let (la, lb) = (local(a), local(b));
                if here.is_none() && la.is_none() && lb.is_none()
                    || state.is_sharp(v, a)
                    || state.is_sharp(v, b)
                {
                    continue;
                }
                let [ra, rb] = [a, b].map(|w| 1.0 / state.scale(v, w));
                let bend = (grid.xyz[a as usize] - at) * ra + (grid.xyz[b as usize] - at) * rb;
                let bend = bend - normal * bend.dot(normal);
                self.add_bend(
                    [(here, -ra - rb), (la, ra), (lb, rb)],
                    bend,
                    normal,
                    aim.straightness,
                    with_matrix,
                );
            }
        }
    }

    /// Add a member that is too long by `value`, with the gradient of that by each node.
    fn add_length(&mut self, terms: [Term; 2], value: f64, weight: f64, with_matrix: bool) {
        let mut columns: SmallVec<[(usize, f64); 4]> = SmallVec::new();
        for (node, gradient) in terms {
            let Some(node) = node else { continue };
            let (at, axes) = &self.nodes[node];
            columns.extend(axes.iter().enumerate().map(|(k, t)| (at + k, t.dot(gradient))));
        }
        let n = self.right.len();
        for &(i, x) in &columns {
            self.right[i] -= weight * x * value;
            if with_matrix {
                for &(j, y) in &columns {
                    self.matrix[i * n + j] += weight * x * y;
                }
            }
        }
    }

    /// Add a line's bend in the plane across `normal`.
    fn add_bend(
        &mut self,
        terms: [(Option<usize>, f64); 3],
        bend: DVec3,
        normal: DVec3,
        straightness: f64,
        with_matrix: bool,
    ) {
        let mut columns: SmallVec<[(usize, DVec3); 6]> = SmallVec::new();
        for (node, coefficient) in terms {
            let Some(node) = node else { continue };
            let (at, axes) = &self.nodes[node];
            columns.extend(
                axes.iter()
                    .enumerate()
                    .map(|(k, &t)| (at + k, (t - normal * t.dot(normal)) * coefficient)),
            );
        }
        let n = self.right.len();
        for &(i, x) in &columns {
            self.right[i] -= straightness * x.dot(bend);
            if with_matrix {
                for &(j, y) in &columns {
                    self.matrix[i * n + j] += straightness * x.dot(y);
                }
            }
        }
    }
}

/// Unit directions in which a node may move.
fn axes(state: &State, v: u32) -> SmallVec<[DVec3; 2]> {
    if state.grid.mesh.is_pinned(v) {
        return SmallVec::new();
    }
    match &state.grid.places[v as usize] {
        Place::Interior(p) => SmallVec::from_buf(tangents(state.surface.carrier.normal(p))),
        Place::Boundary(c) => {
            let chain = &state.surface.loops[c.chain as usize];
            SmallVec::from_slice(&[chain.tangent(&state.surface.carrier, c.s)])
        }
        Place::Feature(c) => {
            let chain = &state.surface.features[c.chain as usize];
            SmallVec::from_slice(&[chain.tangent(&state.surface.carrier, c.s)])
        }
        Place::Corner(_) | Place::Fixed(_) => SmallVec::new(),
    }
}

/// Factorize a symmetric positive matrix in place: L in the lower triangle. False where it is not positive.
fn cholesky(a: &mut [f64], n: usize) -> bool {
    for i in 0..n {
        let (above, row) = a.split_at_mut(i * n);
        for j in 0..i {
            let other = &above[j * n..j * n + j];
            let sum: f64 = dot(&row[..j], other);
            row[j] = (row[j] - sum) / above[j * n + j];
        }
        let pivot = row[i] - dot(&row[..i], &row[..i]);
        if pivot <= 0.0 {
            return false;
        }
        row[i] = pivot.sqrt();
    }
    true
}

/// Solve with the factor of [`cholesky`], in place.
fn solve(l: &[f64], x: &mut [f64]) {
    let n = x.len();
    for i in 0..n {
        x[i] = (x[i] - dot(&l[i * n..i * n + i], &x[..i])) / l[i * n + i];
    }
    for i in (0..n).rev() {
        x[i] /= l[i * n + i];
        let (known, xi) = (&l[i * n..i * n + i], x[i]);
        for (y, lij) in x[..i].iter_mut().zip(known) {
            *y -= lij * xi;
        }
    }
}

/// Dot product in four running sums, which the compiler can keep side by side.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a4.remainder().iter().zip(b4.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a4.zip(b4) {
        for k in 0..4 {
            sums[k] += x[k] * y[k];
        }
    }
    rest + (sums[0] + sums[1]) + (sums[2] + sums[3])
}
