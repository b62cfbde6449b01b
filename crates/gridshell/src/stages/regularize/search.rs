//! Annealed search over edge operations: pick an irregular vertex, try one flip, collapse or split near it,
//! relax its surroundings, keep it or take it back.
//!
//! The objective is E = sum over members (l / l0 - 1)^2 + w R: equal lengths and regular nodes at once. Irregular
//! nodes are charges; flips let a black and white pair glide, collapse and split let it climb, and at some
//! temperature they wander until they meet their opposites or leave through the boundary.

use super::Report;
use super::state::State;
use crate::job::Job;
use crate::math::trig::{exp, ln};
use crate::mesh::Refusal;
use crate::recipe::Regularize;

/// Rounds of the schedule, each ended by sweeps over all nodes.
const ROUNDS: usize = 4;
/// Panels below this shape index are refused.
const LEAST_SHAPE: f64 = 0.55;
/// What relaxing may at best win back of the lengths' energy after an operation that raises R.
const HOPE: f64 = 0.6;

/// Weight of the node count against its start, over n: keeps the mean length where it was.
const COUNT_WEIGHT: f64 = 30.0;

/// An operation on the edge (a, b).
#[derive(Clone, Copy)]
pub enum Operation {
    Flip,
    Collapse,
    Split,
}

impl Operation {
    /// Make it; gives a vertex in its middle.
    pub fn apply(self, state: &mut State, a: u32, b: u32) -> Result<u32, Refusal> {
        match self {
            Operation::Flip => state.flip(a, b).map(|_| a),
            Operation::Collapse => state.collapse(a, b),
            Operation::Split => state.split(a, b),
        }
    }
}

/// Anneal `state`, keeping to `k_n` times as many nodes as Eq. 1 asks for.
pub fn anneal(state: &mut State, options: &Regularize, k_n: f64, seed: u64, job: &Job) -> Report {
    let mut report = Report::default();
    let wanted = options.trials.saturating_mul(state.irregular().len().max(1));
    let trials = wanted.min(options.most_trials);
    let [hot, cold] = options.temperature;
    let mut search = Search::new(state, options, k_n, seed);
    for round in 0..ROUNDS {
        for k in 0..trials / ROUNDS {
            if search.state.irregular().is_empty() {
                report.converged = true;
                return report;
            }
            if k % 256 == 0 && job.stopped() {
                return report;
            }
            let done = (round as f64 + k as f64 / (trials / ROUNDS) as f64) / ROUNDS as f64;
            search.temperature = hot * exp(ln(cold / hot) * done);
            if k % 16 == 0 {
                job.progress("regularize", done, search.state.grid.picture());
            }
            search.trial(&mut report);
        }
        let all: Vec<u32> = search.state.grid.mesh.vertices().collect();
        search.state.relax(&all, 10);
        search.state.refresh_all();
        search.state.commit();
    }
    report.converged = true;
    report
}

/// The state of one annealing.
struct Search<'a, 'b> {
    state: &'a mut State<'b>,
    rng: fastrand::Rng,
    temperature: f64,
    /// Weight w of R.
    weight: f64,
    /// Nodes, those on the boundary by half: what the area decides. Now, and as wanted.
    count: f64,
    target: f64,
    range: std::ops::RangeInclusive<usize>,
}

/// Pick an irregular vertex, an interior one three times in four, and an operation near it.
pub fn draw(state: &State, rng: &mut fastrand::Rng) -> Option<(Operation, u32, u32)> {
    let irregular = state.irregular();
    let mut v = irregular[rng.usize(..irregular.len())];
    if state.grid.mesh.is_boundary(v) && rng.f64() < 0.6 {
        v = irregular[rng.usize(..irregular.len())];
    }
    draw_at(state, v, rng)
}

/// Pick an operation on an edge at `v` or opposite to it.
pub fn draw_at(state: &State, v: u32, rng: &mut fastrand::Rng) -> Option<(Operation, u32, u32)> {
    let mesh = &state.grid.mesh;
    let ring = mesh.ring(v);
    let i = rng.usize(..ring.len());
    let incident = (v, ring[i]);
    let link = (ring[i], ring[(i + 1) % ring.len()]);
    Some(match rng.u8(..20) {
        0..9 => (Operation::Flip, incident.0, incident.1),
        9..14 if mesh.adjacent(link.0, link.1) => (Operation::Flip, link.0, link.1),
        14..17 => (Operation::Collapse, incident.0, incident.1),
        17..20 => (Operation::Split, incident.0, incident.1),
        _ => return None,
    })
}

/// Estimated change of R by an operation, boundary angles taken as they are. None when topology forbids it.
pub fn estimate(state: &State, operation: Operation, a: u32, b: u32) -> Option<f64> {
    let mesh = &state.grid.mesh;
    let apexes = [mesh.left(a, b), mesh.right(a, b)];
    let at_apexes =
        |by: i32| apexes.iter().flatten().map(|&v| state.residual_change(v, by)).sum::<f64>();
    match operation {
        Operation::Flip => state.flip_change(a, b),
        Operation::Split => {
            // A new vertex: degree four inside, three on the boundary.
            let own = if apexes.contains(&None) { 1.0 - state.lambda } else { 4.0 * state.lambda };
            Some(own + at_apexes(1))
        }
        Operation::Collapse => {
            let (da, db) = (state.deviation[a as usize], state.deviation[b as usize]);
            let own = |v: u32, d: i32| state.gamma(v) * f64::from(d * d);
            let stays = if mesh.is_boundary(b) { b } else { a };
            // d_a + d_b - 4 inside; on a boundary edge the virtual degrees make it d_a* + d_b* - 6 + ... alike.
            let both_on_boundary = mesh.is_boundary(a) && mesh.is_boundary(b);
            let merged = da + db + if both_on_boundary { 1 } else { 2 };
            Some(own(stays, merged) - own(a, da) - own(b, db) + at_apexes(-1))
        }
    }
}

impl<'a, 'b> Search<'a, 'b> {
    fn new(state: &'a mut State<'b>, options: &Regularize, k_n: f64, seed: u64) -> Self {
        let mesh = &state.grid.mesh;
        let n = mesh.vertex_count() as f64;
        let count = n - 0.5 * mesh.boundary_count() as f64;
        let range = (n * (1.0 - options.node_range)) as usize
            ..=(n * (1.0 + options.node_range)).ceil() as usize;
        let rng = fastrand::Rng::with_seed(seed);
        // As many as members of the wanted length leave room for (Eq. 1).
        let surface = state.surface;
        let panel = 3f64.sqrt() / 4.0 * state.length * state.length;
        let target = k_n * surface.room() / (2.0 * panel) + surface.euler_characteristic() as f64;
        Search {
            state,
            rng,
            temperature: options.temperature[0],
            weight: options.residual_weight,
            count,
            target,
            range,
        }
    }

    /// Try one operation: keep it with the odds of the temperature.
    fn trial(&mut self, report: &mut Report) {
        let Some((operation, a, b)) = draw(self.state, &mut self.rng) else { return };
        let allowance = -self.temperature * ln(self.rng.f64().max(1e-300));
        let more = match operation {
            Operation::Flip => 0.0,
            Operation::Collapse => -count_weight(self.state, a, b),
            Operation::Split => count_weight(self.state, a, b),
        };
        if self.attempt(operation, a, b, more, allowance) {
            self.state.commit();
            self.count += more;
            match operation {
                Operation::Flip => report.flips += 1,
                Operation::Collapse => report.collapses += 1,
                Operation::Split => report.splits += 1,
            }
        } else {
            self.state.roll_back();
            report.refused += 1;
        }
    }

    /// Make the operation and relax round it; whether it is to be kept.
    fn attempt(&mut self, operation: Operation, a: u32, b: u32, more: f64, allowance: f64) -> bool {
        let state = &mut *self.state;
        let Some(change) = estimate(state, operation, a, b) else { return false };
        let off = self.count - self.target;
        let count_change = COUNT_WEIGHT * (2.0 * off + more) * more / self.target;
        let nodes = state.grid.mesh.vertex_count();
        let in_range = match operation {
            Operation::Flip => true,
            Operation::Collapse => self.range.contains(&(nodes - 1)),
            Operation::Split => self.range.contains(&(nodes + 1)),
        };
        if self.weight * change + count_change > allowance + HOPE || !in_range {
            return false;
        }
        let region = state.region(&[a, b], 2);
        let before = state.length_energy(&region) + self.weight * weighted_residual(state, &region);
        let Ok(center) = operation.apply(state, a, b) else { return false };
        let mut seeds = region;
        seeds.push(center);
        let region = state.region(&seeds, 0);
        state.relax(&region, 4);
        state.refresh(&region);
        let touched = state.touched();
        state.refresh(&touched);
        let after = state.length_energy(&region) + self.weight * weighted_residual(state, &region);
        count_change + after - before <= allowance && !state.has_bad_panel(&touched, LEAST_SHAPE)
    }
}

/// What one node on this edge counts for.
fn count_weight(state: &State, a: u32, b: u32) -> f64 {
    if state.grid.mesh.is_boundary_edge(a, b) { 0.5 } else { 1.0 }
}

fn weighted_residual(state: &State, region: &[u32]) -> f64 {
    region
        .iter()
        .map(|&v| {
            let d = state.deviation[v as usize];
            state.gamma(v) * f64::from(d * d)
        })
        .sum()
}
