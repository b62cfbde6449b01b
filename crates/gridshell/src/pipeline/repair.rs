//! Repair of a grid that is not valid: nodes at one place are merged, folded and flat panels are unfolded by flipping,
//! collapsing and moving what is near them, and the neighbourhood is relaxed again.
//!
//! Each step must lower the *badness* of the panels that it touches: what their shapes, counted negative where they
//! face against the surface, lack to a sane one, and what their members are too short or too long. So it ends; and the
//! number of steps is bounded beside that.

use crate::grid::{Grid, Place};
use crate::job::Job;
use crate::merit;
use crate::mesh::{Mesh, Undo};
use crate::recipe::Recipe;
use crate::stages::measure::is_folded;
use crate::stages::relax;
use crate::surface::Surface;
use crate::validity::{FLAT, NEAREST, near_pairs};
use glam::DVec3;
use smallvec::SmallVec;
use std::fmt;

/// Rounds of mending and relaxing.
const ROUNDS: usize = 4;
/// Steps at one place in a round.
const STEPS: usize = 24;
/// Places mended in a round: these, and a share of the nodes. A grid with more is not worth its time.
const MOST_PLACES: usize = 400;
/// See [`MOST_PLACES`].
const SHARE: f64 = 0.1;
/// Panels of a lower signed shape count as bad: well above flat, so that mending does not stop at the brink.
const SANE: f64 = 0.2;
/// Members shorter than this, over the wanted length, count as bad ones.
const SHORT: f64 = 2.0 * NEAREST;
/// Members longer than this, over the wanted length, count as bad ones: no merging at any price.
const LONG: f64 = 2.0;
/// A panel folded over a neighbour is as bad as this beside its shape.
const FOLD: f64 = 0.5;
/// A step must gain this much.
const LEAST_GAIN: f64 = 1e-3;
/// Shares of the way to the middle of its neighbours that a node is tried at.
const WAYS: [f64; 3] = [1.0, 0.5, 0.25];
/// Rings of nodes round what was mended that are relaxed with it.
const RINGS: usize = 4;

/// What repairing did.
#[derive(Clone, Copy, Debug, Default)]
pub struct Report {
    /// Bad places before.
    pub before: usize,
    /// Bad places that are left.
    pub after: usize,
    /// Edges flipped and collapsed, and nodes moved.
    pub steps: usize,
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "repaired: {} of {} bad places are left", self.after, self.before)
    }
}

/// Mend `grid`; its nodes are numbered anew, in their order, and may be off the exact surface by the carrier's error.
pub fn repair(
    surface: &Surface,
    grid: &mut Grid,
    length: f64,
    recipe: &Recipe,
    job: &Job,
) -> Report {
    let mut bench = Bench { surface, grid: grid.clone(), length };
    let mut places = bench.places();
    let mut report = Report { before: places.len(), after: places.len(), steps: 0 };
    let most = MOST_PLACES + (SHARE * grid.xyz.len() as f64) as usize;
    if places.len() > most {
        return report;
    }
    for _ in 0..ROUNDS {
        if places.is_empty() || job.stopped() {
            break;
        }
        let mut touched: Vec<u32> = places.iter().flatten().copied().collect();
        for place in &places {
            report.steps += bench.mend(place, &mut touched);
        }
        bench.relax_round(touched, recipe, job);
        places = bench.places();
        if places.len() < report.after {
            report.after = places.len();
            *grid = compact(bench.grid.clone());
        }
    }
    report
}

/// The grid without its removed nodes.
fn compact(mut grid: Grid) -> Grid {
    let old = grid.mesh.compact();
    let (places, xyz) = (std::mem::take(&mut grid.places), std::mem::take(&mut grid.xyz));
    grid.places = old.iter().map(|&v| places[v as usize]).collect();
    grid.xyz = old.iter().map(|&v| xyz[v as usize]).collect();
    grid
}

/// A few nodes.
type Few = SmallVec<[u32; 24]>;

/// A grid being mended.
struct Bench<'a> {
    surface: &'a Surface,
    grid: Grid,
    length: f64,
}

/// Something that may mend a panel.
#[derive(Clone, Copy)]
enum Step {
    Flip(u32, u32),
    /// The first one stays.
    Collapse(u32, u32),
    /// So far towards the middle of its neighbours.
    Move(u32, f64),
}

/// What a step did.
enum Done {
    /// The mesh knows how to take it back.
    Rejoined,
    /// A node was here before.
    Moved(u32, Place, DVec3),
}

impl Bench<'_> {
    /// The nodes of folded and flat panels, and pairs of nodes at one place.
    fn places(&self) -> Vec<Few> {
        let grid = &self.grid;
        let normal = |v: u32| grid.places[v as usize].normal(self.surface);
        let bad = |t: &[u32; 3]| {
            merit::shape(t.map(|v| grid.xyz[v as usize])) < FLAT || is_folded(grid, normal, *t)
        };
        let panels = grid.mesh.triangles().filter(bad).map(|t| Few::from_slice(&t));
        let pairs = near_pairs(grid, self.surface, self.length);
        let joined = pairs.iter().filter(|p| grid.mesh.adjacent(p.nodes[0], p.nodes[1]));
        joined.map(|p| Few::from_slice(&p.nodes)).chain(panels).collect()
    }

    /// Take the best step near these nodes while there is one; gives the number of steps.
    fn mend(&mut self, place: &Few, touched: &mut Vec<u32>) -> usize {
        for step in 0..STEPS {
            let nodes: Few =
                place.iter().copied().filter(|&v| self.grid.mesh.is_alive(v)).collect();
            let mut best: Option<(f64, Step)> = None;
            for candidate in self.steps(&nodes) {
                let gain = self.gain(candidate);
                if gain > best.map_or(LEAST_GAIN, |b| b.0) {
                    best = Some((gain, candidate));
                }
            }
            let Some((_, step_taken)) = best else { return step };
            touched.extend(self.around(step_taken));
            let _ = self.take(step_taken, &mut Undo::default());
        }
        STEPS
    }

    /// What can be done at these nodes and their neighbours.
    fn steps(&self, nodes: &Few) -> Vec<Step> {
        let mesh = &self.grid.mesh;
        let mut steps = Vec::new();
        for &a in nodes {
            for &b in mesh.ring(a) {
                steps.extend([Step::Flip(a, b), Step::Collapse(a, b), Step::Collapse(b, a)]);
            }
            for (b, c) in mesh.fan(a) {
                steps.push(Step::Flip(b, c));
            }
            steps.extend(WAYS.map(|way| Step::Move(a, way)));
            for &b in mesh.ring(a) {
                steps.push(Step::Move(b, WAYS[0]));
            }
        }
        steps
    }

    /// The nodes whose panels a step changes.
    fn around(&self, step: Step) -> Few {
        let mesh = &self.grid.mesh;
        let mut around = Few::new();
        match step {
            Step::Move(v, _) => around.push(v),
            Step::Collapse(a, b) => around.extend([a, b]),
            Step::Flip(a, b) => {
                around.extend([a, b]);
                around.extend([mesh.left(a, b), mesh.right(a, b)].into_iter().flatten());
            }
        }
        around
    }

    /// How much a step lowers the badness of what it touches; the grid stays as it is.
    fn gain(&mut self, step: Step) -> f64 {
        let mut seeds = self.around(step);
        let near: Few = seeds.iter().flat_map(|&v| self.grid.mesh.ring(v)).copied().collect();
        seeds.extend(near);
        seeds.sort_unstable();
        seeds.dedup();
        let before = self.badness(&seeds);
        let mut undo = Undo::default();
        let Some(done) = self.take(step, &mut undo) else { return 0.0 };
        let after = self.badness(&seeds);
        self.grid.mesh.take_back(&mut undo);
        if let Done::Moved(v, place, xyz) = done {
            self.grid.places[v as usize] = place;
            self.grid.xyz[v as usize] = xyz;
        }
        before - after
    }

    /// Carry out a step; gives what it did. `None` where it is refused.
    fn take(&mut self, step: Step, undo: &mut Undo) -> Option<Done> {
        match step {
            Step::Flip(a, b) => self.grid.mesh.try_flip(a, b, undo).ok().map(|_| Done::Rejoined),
            Step::Collapse(a, b) => {
                self.grid.mesh.try_collapse(a, b, undo).ok().map(|()| Done::Rejoined)
            }
            Step::Move(v, way) => {
                let i = v as usize;
                let was = Done::Moved(v, self.grid.places[i], self.grid.xyz[i]);
                let step = (self.middle(v) - self.grid.xyz[i]) * way;
                let moved = self.grid.slide(self.surface, i, step);
                (moved > 0.0).then_some(was)
            }
        }
    }

    /// The mean of the neighbours, on a loop or feature of those along it.
    fn middle(&self, v: u32) -> DVec3 {
        let mesh = &self.grid.mesh;
        let ends = [mesh.next_on_boundary(v), mesh.previous_on_boundary(v)];
        let along: Few = match mesh.along_features(v) {
            [] => ends.into_iter().flatten().collect(),
            along => Few::from_slice(along),
        };
        let around: &[u32] = if along.is_empty() { mesh.ring(v) } else { &along };
        let sum: DVec3 = around.iter().map(|&w| self.grid.xyz[w as usize]).sum();
        sum / around.len() as f64
    }

    /// The badness of all panels at these nodes (ascending).
    fn badness(&self, nodes: &Few) -> f64 {
        let mesh = &self.grid.mesh;
        let mut sum = 0.0;
        for &v in nodes.iter().filter(|&&v| mesh.is_alive(v)) {
            for (a, b) in mesh.fan(v) {
                let first = [a, b].iter().all(|w| *w > v || nodes.binary_search(w).is_err());
                if first {
                    sum += self.badness_of(mesh, [v, a, b]);
                }
            }
        }
        sum
    }

    fn badness_of(&self, mesh: &Mesh, t: [u32; 3]) -> f64 {
        let grid = &self.grid;
        let normal = |v: u32| grid.places[v as usize].normal(self.surface);
        let p = t.map(|v| grid.xyz[v as usize]);
        let panel = (p[1] - p[0]).cross(p[2] - p[0]);
        let upright = panel.dot(t.map(normal).iter().sum()) > 0.0;
        let shape = merit::shape(p);
        let mut sum = (SANE - if upright { shape } else { -shape }).max(0.0);
        for k in 0..3 {
            let (a, b, c) = (t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
            let share = grid.scaled_length(self.surface, a, b) / self.length;
            sum += (1.0 - share / SHORT).max(0.0) + (share - LONG).max(0.0);
            let Some(d) = mesh.right(a, b).filter(|_| !mesh.is_feature_edge(a, b)) else {
                continue;
            };
            let [q, r, s] = [b, a, d].map(|v| grid.xyz[v as usize]);
            let other = (r - q).cross(s - q);
            if panel.dot(other) < 0.0 && normal(c).dot(normal(d)) > 0.0 {
                sum += FOLD;
            }
        }
        sum
    }

    /// Relax the nodes some rings round these, if that leaves no more bad places.
    fn relax_round(&mut self, mut region: Vec<u32>, recipe: &Recipe, job: &Job) {
        let mesh = &self.grid.mesh;
        let mut inside = vec![false; mesh.slots()];
        region.retain(|&v| mesh.is_alive(v) && !std::mem::replace(&mut inside[v as usize], true));
        let mut from = 0;
        for _ in 0..RINGS {
            let to = region.len();
            for i in from..to {
                for &w in mesh.ring(region[i]) {
                    if !std::mem::replace(&mut inside[w as usize], true) {
                        region.push(w);
                    }
                }
            }
            from = to;
        }
        let held: Vec<u32> =
            mesh.vertices().filter(|&v| !inside[v as usize] && !mesh.is_pinned(v)).collect();
        let (places, xyz, bad) =
            (self.grid.places.clone(), self.grid.xyz.clone(), self.places().len());
        for &v in &held {
            self.grid.mesh.pin(v, true);
        }
        relax::relax(self.surface, &mut self.grid, recipe, job);
        for &v in &held {
            self.grid.mesh.pin(v, false);
        }
        if self.places().len() > bad {
            (self.grid.places, self.grid.xyz) = (places, xyz);
        }
    }
}
