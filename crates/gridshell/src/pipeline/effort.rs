//! How much work a grid is worth: the recipe's counts are for grids of up to two thousand nodes, larger ones get
//! fewer draws, candidates and heats, so that the time per node never grows; small ones get more candidates.
//!
//! What many draws and candidates are for, hitting upon a lattice that fits all borders at once, pays less on
//! large grids: their borders are long, every lattice fits some of it, and the average over it hardly differs
//! from draw to draw. Their irregular nodes stand along the border, some tenths of the square root of the
//! count, each with room about it: a few hundred trials for each do what thousands do in a small grid.

use crate::recipe::{Effort, Recipe, RegularizeMethod};

/// Up to so many nodes the recipe's counts hold in full.
const FULL: f64 = 2000.0;
/// Below so many nodes there are more candidates, as the root of this number over theirs.
const SMALL: f64 = 1400.0;
/// Fewest draws and candidates of a large grid (or the recipe's, where it asks for fewer).
const LEAST_DRAWS: usize = 12;
const LEAST_CANDIDATES: usize = 4;
/// Fewest trials of polishing per irregular node, in the last heat.
const LEAST_POLISH: usize = 24;
/// Fewest steps of packing, where a search comes after it.
const LEAST_STEPS: usize = 300;
/// Fewest trials of the search per irregular node.
const LEAST_TRIALS: usize = 300;

/// Carrier edges over l0: fine enough for nodes to walk smoothly and boundaries to be followed.
const CARRIER_EDGE: f64 = 0.5;
/// The same in large grids, whose members are short against all that bends: what bends more sharply is sampled
/// more finely by its chord error anyway.
const COARSE_CARRIER_EDGE: f64 = 1.0;
/// Above so many nodes carriers coarsen.
const COARSENING: f64 = 5000.0;

/// The recipe with its counts cut down to what a grid of about `nodes` nodes is worth.
pub fn budgeted(recipe: &Recipe, nodes: f64) -> Recipe {
    let share = (FULL / nodes).min(1.0);
    let cut = |count: usize, share: f64, least: usize| {
        let cut = (count as f64 * share).round() as usize;
        cut.max(least.min(count))
    };
    let mut recipe = recipe.clone();
    recipe.pack.draws = cut(recipe.pack.draws, share, LEAST_DRAWS);
    if recipe.regularize.method == RegularizeMethod::Search {
        recipe.pack.max_steps = cut(recipe.pack.max_steps, share, LEAST_STEPS);
    }
    let regularize = &mut recipe.regularize;
    // Small grids are cheap, and each of their irregular nodes counts: more candidates.
    let share = share * (SMALL / nodes).sqrt().max(1.0);
    regularize.candidates = cut(regularize.candidates, share, LEAST_CANDIDATES);
    let last = regularize.heats.last().map_or(1, |h| h[1]).max(1);
    for [through, trials] in &mut regularize.heats {
        *through = cut(*through, share, 1);
        *trials = cut(*trials, (share * share).min(1.0), LEAST_POLISH * *trials / last);
    }
    // A heat that lets through as many as the next only polishes twice.
    let all = std::mem::take(&mut regularize.heats);
    let through = |k: usize| all.get(k).map(|h| h[0]);
    regularize.heats =
        (0..all.len()).filter(|&k| through(k) != through(k + 1)).map(|k| all[k]).collect();
    regularize.trials = cut(regularize.trials, (share * share).min(1.0), LEAST_TRIALS);
    // All trials of one grid may take twice as long as all trials of the smallest full one, and then as the
    // border grows.
    let most = regularize.most_trials as f64 * (nodes / (20.0 * FULL)).sqrt().max(1.0);
    regularize.most_trials = most as usize;
    match recipe.effort {
        Effort::Draft => draft(&mut recipe),
        Effort::Standard => {}
        Effort::Best => best(&mut recipe),
    }
    if let Some(candidates) = recipe.candidates {
        recipe.regularize.candidates = candidates;
        recipe.pack.draws = recipe.pack.draws.max(candidates);
        if let Some([through, _]) = recipe.regularize.heats.first_mut() {
            *through = candidates;
        }
    }
    recipe
}

/// No polish, and few of everything else.
fn draft(recipe: &mut Recipe) {
    recipe.pack.draws = recipe.pack.draws.min(4);
    recipe.regularize.candidates = recipe.regularize.candidates.min(2);
    recipe.regularize.trials = recipe.regularize.trials.min(150);
    recipe.regularize.heats.clear();
}

/// Twice the candidates, and three times the polish of each.
fn best(recipe: &mut Recipe) {
    recipe.pack.draws *= 2;
    let regularize = &mut recipe.regularize;
    regularize.candidates *= 2;
    regularize.most_polish *= 3;
    for [through, trials] in &mut regularize.heats {
        *through *= 2;
        *trials *= 3;
    }
}

/// Longest carrier edges over l0 for a grid of about `nodes` nodes.
pub fn carrier_edge(nodes: f64) -> f64 {
    (CARRIER_EDGE * (nodes / COARSENING).sqrt()).clamp(CARRIER_EDGE, COARSE_CARRIER_EDGE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_grids_get_all_that_the_recipe_says() {
        let recipe = Recipe::default();
        assert_eq!(budgeted(&recipe, SMALL), recipe);
        assert_eq!(budgeted(&recipe, FULL), recipe);
        assert!(budgeted(&recipe, 60.0).regularize.candidates > recipe.regularize.candidates);
        assert_eq!(carrier_edge(FULL), CARRIER_EDGE);
    }

    #[test]
    fn no_grid_gets_more_candidates_than_the_recipe_says() {
        let mut recipe = Recipe::default();
        recipe.pack.draws = 1;
        recipe.regularize.candidates = 1;
        recipe.regularize.heats.clear();
        recipe.regularize.trials = 0;
        let budget = budgeted(&recipe, 1e5);
        assert_eq!(budget.regularize.candidates, 1);
        assert_eq!(budget.pack.draws, 1);
        assert_eq!(budget.regularize.trials, 0);
    }

    #[test]
    fn method_as_printed_packs_until_it_settles() {
        let paper = Recipe::named("paper").unwrap();
        assert_eq!(budgeted(&paper, 1e5).pack.max_steps, paper.pack.max_steps);
    }

    #[test]
    fn as_many_candidates_run_as_are_asked_for() {
        for effort in [Effort::Draft, Effort::Standard, Effort::Best] {
            let recipe = Recipe { candidates: Some(7), effort, ..Recipe::default() };
            let budget = budgeted(&recipe, 1e4);
            assert_eq!(budget.regularize.candidates, 7);
            assert!(budget.pack.draws >= 7);
        }
    }

    #[test]
    fn work_per_node_never_grows() {
        let draws = |n: f64| budgeted(&Recipe::default(), n).pack.draws as f64;
        assert!(draws(2e3) >= draws(1e4) && draws(1e4) >= draws(1e5) && draws(1e5) >= 1.0);
    }
}
