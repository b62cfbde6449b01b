//! Relax (Section 6): move nodes along surface and boundary, without touching connectivity, towards equal
//! members and fluent lines. Corners stay. Two methods: the paper's net-like dynamics and a Gauss-Newton
//! solver that minimises the spread of lengths and the bending of lines.

mod net;

pub use crate::balance::Report;
use crate::balance::{self, balance};
use crate::grid::Grid;
use crate::job::Job;
use crate::recipe::{Recipe, RelaxMethod};
use crate::surface::Surface;

/// Gauss-Newton settles in some tens of steps or creeps.
const FLUENT_STEPS: usize = 60;

/// Relax `grid` by the recipe's method. Positions end on the carrier; [`Grid::settle_exactly`] puts them on
/// the exact surface.
pub fn relax(surface: &Surface, grid: &mut Grid, recipe: &Recipe, job: &Job) -> Report {
    let options = &recipe.relax;
    match options.method {
        RelaxMethod::Net => net::net(surface, grid, options, job),
        RelaxMethod::Fluent => {
            let max_steps = options.max_steps.min(FLUENT_STEPS);
            let options = balance::Options {
                straightness: options.straightness,
                border: recipe.border_weight(),
                settled: options.settled,
                max_steps,
                accuracy: 1e-3,
            };
            balance(surface, grid, &options, job)
        }
    }
}
