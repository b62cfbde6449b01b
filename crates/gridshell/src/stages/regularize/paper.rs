//! Algorithm 1 of the paper (Section 5.2): effective flips by priority, then collapse, split or drift of one
//! featured edge at a time, until no featured edge is left that helps.
//!
//! Degrees depend on connectivity, and at the boundary on angles; so after every operation the nodes around
//! it are relaxed a little. An operation that would leave a sliver or a turned panel is refused.

use super::Report;
use super::state::State;
use crate::job::Job;
use crate::recipe::Regularize;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Panels below this shape index are refused.
const LEAST_SHAPE: f64 = 0.2;

/// An edge in the queue of flips; the smallest change of R first, ties by vertex ids.
#[derive(PartialEq)]
struct Candidate {
    change: f64,
    edge: (u32, u32),
}

impl Eq for Candidate {}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        other.change.total_cmp(&self.change).then_with(|| other.edge.cmp(&self.edge))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Run Algorithm 1 on `state`.
pub fn algorithm1(state: &mut State, options: &Regularize, job: &Job) -> Report {
    let start = state.grid.mesh.vertex_count() as f64;
    let range = (start * (1.0 - options.node_range)) as usize
        ..=(start * (1.0 + options.node_range)).ceil() as usize;
    let mut report = Report::default();
    // Featured edges whose operation was refused: not tried again.
    let mut spent: Vec<(u32, u32)> = Vec::new();
    for round in 0..options.max_rounds {
        if job.stopped() {
            return report;
        }
        report.flips += effective_flips(state);
        let Some((a, b)) = featured_edge(state, &spent) else {
            report.converged = true;
            return report;
        };
        if operate(state, a, b, &range, &mut report) {
            spent.retain(|&(p, q)| state.grid.mesh.adjacent(p, q) && p != a && q != b);
        } else {
            report.refused += 1;
        }
        spent.push((a, b));
        job.progress("regularize", round as f64 / options.max_rounds as f64, state.grid.picture());
    }
    report
}

/// Flip edges that lower R, the best first, until none is left; gives their number.
fn effective_flips(state: &mut State) -> usize {
    let mut queue = BinaryHeap::new();
    let irregular = state.irregular().to_vec();
    for v in irregular {
        enqueue_around(state, v, &mut queue);
    }
    let mut flips = 0;
    while let Some(Candidate { change, edge: (a, b) }) = queue.pop() {
        // An entry may be out of date: its edge gone, or its change another by now.
        if !state.grid.mesh.adjacent(a, b) || state.flip_change(a, b) != Some(change) {
            continue;
        }
        let Ok((c, d)) = state.flip(a, b) else { continue };
        if !finish(state, &[a, b, c, d]) {
            continue;
        }
        flips += 1;
        for v in [a, b, c, d] {
            enqueue_around(state, v, &mut queue);
        }
    }
    flips
}

/// Put the effective flips among the edges at `v` and at its neighbours into the queue.
fn enqueue_around(state: &State, v: u32, queue: &mut BinaryHeap<Candidate>) {
    let mesh = &state.grid.mesh;
    if !mesh.is_alive(v) {
        return;
    }
    let links = mesh.fan(v);
    for (a, b) in mesh.ring(v).iter().map(|&w| (v, w)).chain(links) {
        let edge = (a.min(b), a.max(b));
        if let Some(change) = state.flip_change(edge.0, edge.1).filter(|&c| c < -1e-9) {
            queue.push(Candidate { change, edge });
        }
    }
}

/// The featured edge (both ends irregular) with the largest R_j; of equals one with two of a kind.
fn featured_edge(state: &State, spent: &[(u32, u32)]) -> Option<(u32, u32)> {
    let mesh = &state.grid.mesh;
    let mut irregular = state.irregular().to_vec();
    irregular.sort_unstable();
    let dev = |v: u32| state.deviation[v as usize];
    let mut best: Option<((f64, bool), (u32, u32))> = None;
    for &a in &irregular {
        for &b in mesh.ring(a) {
            let drifting = dev(a).signum() != dev(b).signum();
            // "No featured edges except drifting boundary edges on the boundary" is where the paper stops.
            let at_rest = mesh.is_boundary(a) && mesh.is_boundary(b);
            if a > b || dev(b) == 0 || at_rest || spent.contains(&(a, b)) {
                continue;
            }
            let own = |v: u32| state.gamma(v) * f64::from(dev(v) * dev(v));
            let apexes = [mesh.left(a, b), mesh.right(a, b)];
            let key = (
                own(a) + own(b) + apexes.iter().flatten().map(|&v| own(v)).sum::<f64>(),
                !drifting,
            );
            if best.is_none_or(|(k, _)| key > k) {
                best = Some((key, (a, b)));
            }
        }
    }
    best.map(|(_, edge)| edge)
}

/// Collapse, split or drift the featured edge; false when nothing was done.
fn operate(
    state: &mut State,
    a: u32,
    b: u32,
    range: &std::ops::RangeInclusive<usize>,
    report: &mut Report,
) -> bool {
    let count = state.grid.mesh.vertex_count();
    match (state.deviation[a as usize].signum(), state.deviation[b as usize].signum()) {
        (-1, -1) => {
            let done = range.contains(&(count - 1))
                && state.collapse(a, b).is_ok()
                && finish(state, &[a, b]);
            report.collapses += usize::from(done);
            done
        }
        (1, 1) => {
            let done = range.contains(&(count + 1))
                && state.split(a, b).is_ok_and(|m| finish(state, &[a, b, m]));
            report.splits += usize::from(done);
            done
        }
        (-1, _) => drift(state, a, b, range, report),
        _ => drift(state, b, a, range, report),
    }
}

/// Move a black and a white neighbour together through the regular grid by flips (Fig. 12 d), to the nearer
/// of the two sides, until they meet another irregular vertex or the boundary (Fig. 12 e, f).
fn drift(
    state: &mut State,
    black: u32,
    white: u32,
    range: &std::ops::RangeInclusive<usize>,
    report: &mut Report,
) -> bool {
    if state.grid.mesh.is_boundary(black) || state.grid.mesh.is_boundary(white) {
        return finish_at_boundary(state, black, white, range, report);
    }
    let sides = [state.grid.mesh.left(black, white), state.grid.mesh.right(black, white)];
    let paths = sides.map(|side| side.and_then(|s| path(state, black, white, s)));
    let shorter = match &paths {
        [Some(l), Some(r)] => usize::from(r.len() < l.len()),
        [Some(_), None] => 0,
        [None, Some(_)] => 1,
        [None, None] => return false,
    };
    let flips = paths.into_iter().nth(shorter).flatten().unwrap_or_default();
    let mut done = 0;
    for (p, q) in flips {
        let Ok((c, d)) = state.flip(p, q) else { break };
        if !finish(state, &[p, q, c, d]) {
            break;
        }
        done += 1;
    }
    report.drifts += usize::from(done > 0);
    done > 0
}

/// The flips that carry the pair to one side until its surroundings are no longer regular; None when it
/// cannot even start. Tried on the mesh and taken back.
pub fn path(state: &mut State, black: u32, white: u32, side: u32) -> Option<Vec<(u32, u32)>> {
    const LONGEST: usize = 200;
    let (mut white, mut side) = (white, side);
    let mut behind = black;
    let mut flips = Vec::new();
    while flips.len() < LONGEST {
        // Flipping (white, side) hands black to `side` and white to the vertex across.
        let mesh = &state.grid.mesh;
        let across = [mesh.left(white, side), mesh.right(white, side)]
            .into_iter()
            .flatten()
            .find(|&v| v != behind);
        let Some(across) = across else { break };
        if state.flip(white, side).is_err() {
            break;
        }
        flips.push((white, side));
        let ends_here = [side, across]
            .iter()
            .any(|&v| state.deviation[v as usize] != 0 || state.grid.mesh.is_boundary(v));
        if ends_here {
            break;
        }
        // Onwards past the new edge (behind, across): the common neighbour on the far side.
        let next = [state.grid.mesh.left(side, across), state.grid.mesh.right(side, across)];
        let Some(next) = next.into_iter().flatten().find(|&v| v != behind) else { break };
        behind = side;
        white = across;
        side = next;
    }
    state.roll_back();
    (!flips.is_empty()).then_some(flips)
}

/// Fig. 12 (e): a black boundary vertex beside a white interior one: collapse the boundary edge opposite to
/// the white one. (f): a white boundary vertex beside a black interior one: split that boundary edge.
fn finish_at_boundary(
    state: &mut State,
    black: u32,
    white: u32,
    range: &std::ops::RangeInclusive<usize>,
    report: &mut Report,
) -> bool {
    let mesh = &state.grid.mesh;
    let (on, inside) = if mesh.is_boundary(black) { (black, white) } else { (white, black) };
    if mesh.is_boundary(inside) {
        return false;
    }
    let ends = [mesh.next_on_boundary(on), mesh.previous_on_boundary(on)];
    let opposite = ends
        .into_iter()
        .flatten()
        .find(|&w| [mesh.left(on, w), mesh.right(on, w)].contains(&Some(inside)));
    let Some(end) = opposite else { return false };
    let count = mesh.vertex_count();
    if on == black {
        let done = range.contains(&(count - 1))
            && state.collapse(on, end).is_ok()
            && finish(state, &[on, end, inside]);
        report.collapses += usize::from(done);
        done
    } else {
        let done = range.contains(&(count + 1))
            && state.split(on, end).is_ok_and(|m| finish(state, &[on, end, inside, m]));
        report.splits += usize::from(done);
        done
    }
}

/// Relax round an operation and keep it, or take it back when panels went bad.
fn finish(state: &mut State, seeds: &[u32]) -> bool {
    let region = state.region(seeds, 2);
    state.relax(&region, 4);
    let near = state.region(seeds, 1);
    if state.has_bad_panel(&near, LEAST_SHAPE) {
        state.roll_back();
        return false;
    }
    let touched = state.touched();
    state.refresh(&touched);
    state.refresh(&region);
    state.commit();
    true
}
