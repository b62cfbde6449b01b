//! Polish by merit: a few edge operations near an irregular node, the surroundings brought into balance, kept if
//! the merit of the whole grid says so.
//!
//! One operation alone nearly always makes a grid worse; what helps is a short run of them: one to three drawn,
//! each beside the last, then every flip round them that lowers R. Such a plan is weighed by its change of R before
//! anything moves, and most plans end there.

use super::Report;
use super::local::{Aim, Local};
use super::search::{Operation, draw_at};
use super::state::{Few, State};
use crate::balance::{self, balance};
use crate::job::Job;
use crate::math::trig::{exp, ln};
use crate::merit::{self, Sums};
use crate::recipe::Recipe;
use smallvec::SmallVec;

/// Rings of nodes that move with an operation: first a few, to see whether it is worth more, then all.
const RINGS: [usize; 2] = [2, 3];
/// What all rings may at best win over the few, in units of what one more irregular node on the border costs.
const MORE: f64 = 0.5;
/// Steps of balancing round an operation.
const STEPS: usize = 2;
/// Panels below this shape are refused.
const LEAST_SHAPE: f64 = 0.55;
/// Rounds, each begun with the whole grid in balance.
const ROUNDS: usize = 6;
/// Temperatures, first and last, in units of what one more irregular node on the border costs in merit.
const TEMPERATURE: [f64; 2] = [0.4, 0.05];
/// Irregular nodes that trials are made for at least.
const LEAST_PLACES: usize = 40;
/// Trials of a healing at most: a second or two.
const MOST_HEALS: usize = 3000;
/// What operations may at best win by lengths and lines, in the same units.
const HOPE: f64 = 1.0;

/// Polish `state` by so many trials per irregular node.
pub fn polish(state: &mut State, recipe: &Recipe, trials: usize, seed: u64, job: &Job) -> Report {
    let mut report = Report::default();
    // Few irregular nodes are hard to lose: the border is where they go, so its size counts as well.
    let places =
        state.irregular().len().max(state.grid.mesh.boundary_count() / 2).max(LEAST_PLACES);
    let trials = trials.saturating_mul(places).min(recipe.regularize.most_polish);
    let mut polish = Polish::new(state, recipe, seed);
    for round in 0..ROUNDS {
        polish.balance_all(3, job);
        if round == 0 || polish.merit > polish.best.0 {
            polish.best = (polish.merit, polish.state.grid.clone());
        }
        let mut made = 0;
        for k in 0..20 * trials / ROUNDS {
            if polish.state.irregular().is_empty() || made >= trials / ROUNDS {
                break;
            }
            if k % 64 == 0 && job.stopped() {
                return report;
            }
            let done = (round as f64 + made as f64 * ROUNDS as f64 / trials as f64) / ROUNDS as f64;
            let [hot, cold] = TEMPERATURE;
            polish.temperature = hot * exp(ln(cold / hot) * done);
            job.progress("regularize", done, polish.state.grid.picture());
            made += usize::from(polish.trial(&mut report));
        }
    }
    polish.balance_all(6, job);
    let (merit, grid) = std::mem::replace(&mut polish.best, (0.0, polish.state.grid.clone()));
    if merit > polish.merit {
        polish.state.replace(grid);
    }
    report.converged = true;
    report
}

/// Heal the irregular nodes for which `inside` holds by so many trials each: operations only touch nodes for which it
/// holds, or new ones. The grid is left as it was where nothing better was found; gives whether it was.
pub fn heal(
    state: &mut State,
    recipe: &Recipe,
    inside: &dyn Fn(u32) -> bool,
    trials: usize,
    seed: u64,
    job: &Job,
) -> bool {
    let mut polish = Polish::new(state, recipe, seed);
    polish.inside = Some(inside);
    polish.count_all();
    let start = polish.merit;
    polish.best.0 = start;
    let trials = trials.saturating_mul(polish.places().len()).min(MOST_HEALS);
    let mut made = 0;
    for _ in 0..20 * trials {
        if made >= trials || polish.places().is_empty() || job.stopped() {
            break;
        }
        let [hot, cold] = TEMPERATURE;
        polish.temperature = hot * exp(ln(cold / hot) * made as f64 / trials as f64);
        made += usize::from(polish.trial(&mut Report::default()));
        if polish.merit > polish.best.0 {
            polish.best = (polish.merit, polish.state.grid.clone());
        }
    }
    let (merit, grid) = std::mem::replace(&mut polish.best, (0.0, polish.state.grid.clone()));
    polish.state.replace(grid);
    merit > start
}

struct Polish<'a, 'b> {
    state: &'a mut State<'b>,
    rng: fastrand::Rng,
    local: Local,
    straightness: f64,
    border: f64,
    total: Sums,
    merit: f64,
    /// Angle fluency index of the nodes as they are, NaN where it is not known.
    deltas: Vec<f64>,
    temperature: f64,
    unit: f64,
    best: (f64, crate::grid::Grid),
    /// Which nodes operations may touch; None: all.
    inside: Option<&'a dyn Fn(u32) -> bool>,
}

impl<'a, 'b> Polish<'a, 'b> {
    fn new(state: &'a mut State<'b>, recipe: &Recipe, seed: u64) -> Self {
        Polish {
            rng: fastrand::Rng::with_seed(seed),
            local: Local::default(),
            straightness: recipe.relax.straightness,
            border: recipe.border_weight(),
            total: Sums::default(),
            merit: 0.0,
            deltas: Vec::new(),
            temperature: 0.0,
            unit: 0.0,
            best: (f64::NEG_INFINITY, state.grid.clone()),
            inside: None,
            state,
        }
    }

    /// Bring the whole grid into balance and count everything anew.
    fn balance_all(&mut self, steps: usize, job: &Job) {
        let options = balance::Options {
            straightness: self.straightness,
            border: self.border,
            settled: 1e-4,
            max_steps: steps,
            accuracy: 0.02,
        };
        balance(self.state.surface, &mut self.state.grid, &options, &job.part_of("regularize"));
        self.count_all();
    }

    /// Count everything anew.
    fn count_all(&mut self) {
        self.state.refresh_all();
        let state = &*self.state;
        self.total = Sums::whole(&state.grid, state.surface, state.length, state.lambda);
        self.merit = self.total.merit(state.lambda);
        self.deltas.clear();
        let more = Sums { residual: self.total.residual + 1.0 - state.lambda, ..self.total };
        self.unit = self.merit - more.merit(state.lambda);
    }

    /// Try a few operations near an irregular node; whether they came as far as being balanced.
    fn trial(&mut self, report: &mut Report) -> bool {
        let bar = self.merit + self.unit * self.temperature * ln(self.rng.f64().max(1e-300));
        let Some(plan) = self.plan() else { return false };
        let hoped = Sums { residual: self.total.residual + plan.change, ..self.total };
        if hoped.merit(self.state.lambda) + self.unit * HOPE < bar {
            return false;
        }
        let [few, all] = RINGS;
        let kept = self
            .carry_out(&plan, few, bar - MORE * self.unit)
            .inspect(|_| self.state.roll_back())
            .and_then(|_| self.carry_out(&plan, all, bar));
        let Some((after, rim)) = kept else {
            self.state.roll_back();
            report.refused += 1;
            return true;
        };
        self.state.refresh(&plan.touched);
        self.state.refresh(&rim);
        self.state.commit();
        for &v in rim.iter().chain(&plan.touched) {
            if let Some(known) = self.deltas.get_mut(v as usize) {
                *known = f64::NAN;
            }
        }
        self.total = after;
        self.merit = after.merit(self.state.lambda);
        for step in &plan.steps {
            match step.0 {
                Operation::Flip => report.flips += 1,
                Operation::Collapse => report.collapses += 1,
                Operation::Split => report.splits += 1,
            }
        }
        true
    }

    /// Draw one to three operations, each near the last, followed by every flip round them that lowers R.
    fn plan(&mut self) -> Option<Plan> {
        let mut plan = Plan::default();
        let drawn = self.draw(&mut plan);
        plan.touched = self.state.touched();
        let idle = self.state.is_idle();
        self.state.roll_back();
        let within = plan.touched.iter().all(|&v| self.is_inside(v));
        drawn.filter(|()| !idle && within).map(|()| plan)
    }

    /// The irregular nodes that operations may begin at.
    fn places(&self) -> Few {
        self.state.irregular().iter().copied().filter(|&v| self.is_inside(v)).collect()
    }

    fn is_inside(&self, v: u32) -> bool {
        self.inside.is_none_or(|inside| inside(v))
    }

    fn draw(&mut self, plan: &mut Plan) -> Option<()> {
        let mut v = match self.inside {
            None => *self.rng.choice(self.state.irregular())?,
            Some(_) => *self.rng.choice(&self.places())?,
        };
        for _ in 0..[1, 1, 2, 2, 3][self.rng.usize(..5)] {
            let (operation, a, b) = draw_at(self.state, v, &mut self.rng)?;
            plan.make(self.state, operation, a, b)?;
            let touched = self.state.touched();
            let near = self.state.region(&touched, 1);
            let odd: Few =
                near.into_iter().filter(|&w| self.state.deviation[w as usize] != 0).collect();
            if odd.is_empty() {
                break;
            }
            v = odd[self.rng.usize(..odd.len())];
        }
        for _ in 0..MOST_FLIPS {
            let touched = self.state.touched();
            let near = self.state.region(&touched, 1);
            let state = &*self.state;
            let flips = near.iter().flat_map(|&v| state.flips_for(v));
            match flips.min_by(|x, y| x.0.total_cmp(&y.0)) {
                Some((change, a, b)) if change < -1e-9 => {
                    plan.make(self.state, Operation::Flip, a, b)?;
                }
                _ => break,
            }
        }
        Some(())
    }

    /// Make the planned operations and balance `rings` rings round them: the sums that they leave and the nodes
    /// round them, or None where a panel is bad or the merit is below `bar`.
    fn carry_out(&mut self, plan: &Plan, rings: usize, bar: f64) -> Option<(Sums, Few)> {
        let state = &mut *self.state;
        let mut around = state.region(&plan.touched, rings);
        plan.replay(state)?;
        around.extend(state.region(&plan.touched, rings));
        // Removed nodes count before, made ones after: what the sums cover is known only now.
        state.roll_back();
        around.extend_from_slice(&plan.touched);
        let near = state.region(&around, 0);
        self.deltas.resize(state.grid.mesh.slots(), f64::NAN);
        let before = sums(state, &near, |v| {
            let known = &mut self.deltas[v as usize];
            if known.is_nan() {
                *known = merit::delta(&state.grid, v);
            }
            *known
        });

        plan.replay(state)?;
        let rim = state.region(&plan.touched, rings);
        let region = state.region(&plan.touched, rings - 1);
        state.remember(&region);
        let mean = self.total.members.mean() * state.length;
        let aim = Aim { mean, straightness: self.straightness, border: self.border };
        self.local.balance(state, &region, &rim, &aim, STEPS);
        if state.has_bad_panel(&plan.touched_alive(state), LEAST_SHAPE) {
            return None;
        }
        let near = state.region(&around, 0);
        let after = self.total - before + sums(state, &near, |v| merit::delta(&state.grid, v));
        (after.merit(state.lambda) >= bar).then_some((after, near))
    }
}

/// Operations drawn, and what they do to R.
#[derive(Default)]
struct Plan {
    steps: SmallVec<[(Operation, u32, u32); 8]>,
    change: f64,
    touched: Few,
}

/// Flips by degree after the operations drawn, at most.
const MOST_FLIPS: usize = 8;

impl Plan {
    /// Make an operation and note its change of R.
    fn make(&mut self, state: &mut State, operation: Operation, a: u32, b: u32) -> Option<()> {
        // Only these get other edges, or other angles at the border.
        let mut changed = match operation {
            Operation::Collapse => state.region(&[a, b], 1),
            Operation::Flip | Operation::Split => {
                let mesh = &state.grid.mesh;
                [Some(a), Some(b), mesh.left(a, b), mesh.right(a, b)]
                    .into_iter()
                    .flatten()
                    .collect()
            }
        };
        let before = residual(state, &changed);
        let middle = operation.apply(state, a, b).ok()?;
        if !changed.contains(&middle) {
            changed.push(middle);
        }
        state.refresh(&changed);
        self.change += residual(state, &changed) - before;
        self.steps.push((operation, a, b));
        Some(())
    }

    /// Make the operations again, in the state that they were drawn in.
    fn replay(&self, state: &mut State) -> Option<()> {
        for &(operation, a, b) in &self.steps {
            operation.apply(state, a, b).ok()?;
        }
        Some(())
    }

    fn touched_alive(&self, state: &State) -> Few {
        self.touched.iter().copied().filter(|&v| state.grid.mesh.is_alive(v)).collect()
    }
}

/// Part of R (Eq. 14) of these; nothing of removed ones.
fn residual(state: &State, region: &[u32]) -> f64 {
    let one = |&v: &u32| state.gamma(v) * f64::from(state.deviation[v as usize].pow(2));
    region.iter().map(one).sum()
}

/// The sums over the region last gathered.
fn sums(state: &State, region: &[u32], delta: impl FnMut(u32) -> f64) -> Sums {
    let inside = |v| state.in_region(v);
    Sums::over(&state.grid, state.surface, state.length, state.lambda, region, inside, delta)
}
