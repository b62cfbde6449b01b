//! A copy of the editor's grid on which edits are carried out.

use super::{Edit, Editor, Effect, Figures, Refusal, irregular};
use crate::grid::Grid;
use crate::merit::{self, Sums};
use crate::stages::measure::is_folded;
use crate::stages::regularize::{Aim, Few, Local, State};
use crate::surface::Surface;

/// Rings of nodes round an operation that are balanced with it, and one more.
const RINGS: usize = 3;
/// Steps of balancing them.
const STEPS: usize = 3;
/// No edit makes a panel of a lower shape than this.
const LEAST_SHAPE: f64 = 0.2;

/// A copy of an editor's grid.
pub(super) struct Workbench<'a> {
    pub editor: &'a Editor,
    pub state: State<'a>,
    local: Local,
}

impl<'a> Workbench<'a> {
    pub fn new(editor: &'a Editor) -> Workbench<'a> {
        let (grid, length) = (editor.grid.clone(), editor.edge_length);
        let state = State::new(&editor.surface, grid, length, editor.lambda());
        Workbench { editor, state, local: Local::default() }
    }

    /// The grid as it is now.
    pub fn grid(&self) -> &Grid {
        &self.state.grid
    }

    /// The grid as it is now, to be kept.
    pub fn into_grid(self) -> Grid {
        self.state.grid
    }

    /// Carry out an edit; gives its effect.
    pub fn carry_out(&mut self, edit: &Edit) -> Result<Effect, Refusal> {
        let changed = self.perform(edit)?;
        self.conclude(changed)
    }

    /// Put what may have changed on the exact surface and look at its panels; gives the effect.
    pub fn conclude(&mut self, changed: Vec<u32>) -> Result<Effect, Refusal> {
        self.settle(&changed);
        let near = self.near(changed);
        self.look_at_panels(&near)?;
        Ok(self.effect(&near))
    }

    /// Take back what was carried out, or was begun and refused; not after `Heal`, pins and anchors.
    pub fn take_back(&mut self) {
        self.state.roll_back();
    }

    /// Balance the nodes round these; gives all that changed.
    pub fn balance_round(&mut self, seeds: &[u32]) -> Vec<u32> {
        let rim = self.state.region(seeds, RINGS);
        let region = self.state.region(seeds, RINGS - 1);
        self.state.remember(&region);
        let recipe = &self.editor.recipe;
        let aim = Aim {
            mean: self.editor.sums.members.mean() * self.editor.edge_length,
            straightness: recipe.relax.straightness,
            border: recipe.border_weight(),
        };
        self.local.balance(&mut self.state, &region, &rim, &aim, STEPS);
        seeds.iter().chain(&region).copied().collect()
    }

    /// Put the nodes that moved on the exact surface; those that did not are where they were.
    fn settle(&mut self, changed: &[u32]) {
        let before = &self.editor.grid;
        let grid = &mut self.state.grid;
        for &v in changed.iter().filter(|&&v| grid.mesh.is_alive(v)) {
            let i = v as usize;
            let stayed = was_alive(before, v) && before.places[i] == grid.places[i];
            grid.xyz[i] =
                if stayed { before.xyz[i] } else { grid.places[i].exact(&self.editor.surface) };
        }
    }

    /// These nodes and all that were or are joined to them, ascending: whatever is measured differently is measured at
    /// one of them.
    fn near(&self, mut nodes: Vec<u32>) -> Vec<u32> {
        let (before, after) = (&self.editor.grid.mesh, &self.state.grid.mesh);
        for i in 0..nodes.len() {
            let v = nodes[i];
            if was_alive(&self.editor.grid, v) {
                nodes.extend(before.ring(v));
            }
            nodes.extend(after.ring(v));
        }
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    fn look_at_panels(&self, near: &[u32]) -> Result<(), Refusal> {
        let surface = &*self.editor.surface;
        let before = bad_panels(&self.editor.grid, surface, near);
        let after = bad_panels(&self.state.grid, surface, near);
        match after.into_iter().find(|t| !before.contains(t)) {
            None => Ok(()),
            Some([a, b, c]) => Err(Refusal::new(
                format!("panel {a}-{b}-{c} would be folded over or a sliver"),
                "relax here first, or edit a member beside",
            )),
        }
    }

    fn effect(&self, near: &[u32]) -> Effect {
        let editor = self.editor;
        let lambda = editor.lambda();
        let sums = |grid: &Grid| {
            let nodes: Vec<u32> = near.iter().copied().filter(|&v| was_alive(grid, v)).collect();
            let inside = |v: u32| near.binary_search(&v).is_ok();
            let delta = |v| merit::delta(grid, v);
            let surface = &*editor.surface;
            let length = editor.edge_length;
            let sums = Sums::over(grid, surface, length, lambda, &nodes, inside, delta);
            (sums, irregular(grid, &nodes))
        };
        let (before, after) = (sums(&editor.grid), sums(&self.state.grid));
        Effect {
            before: editor.figures(),
            after: Figures::new(
                &(editor.sums - before.0 + after.0),
                editor.irregular + after.1 - before.1,
                self.state.grid.mesh.vertex_count(),
                lambda,
            ),
        }
    }

    /// All nodes in use now or before.
    pub fn all(&self) -> Vec<u32> {
        (0..self.state.grid.mesh.slots() as u32).collect()
    }

    /// The nodes whose rings the operation changed.
    pub fn touched(&self) -> Few {
        let mesh = &self.state.grid.mesh;
        let mut touched = self.state.touched();
        touched.retain(|v| mesh.is_alive(*v));
        touched
    }
}

/// Whether there is such a node.
pub(super) fn was_alive(grid: &Grid, v: u32) -> bool {
    (v as usize) < grid.mesh.slots() && grid.mesh.is_alive(v)
}

/// The panels at these nodes (ascending) that are folded over or slivers, their nodes ascending.
fn bad_panels(grid: &Grid, surface: &Surface, near: &[u32]) -> Vec<[u32; 3]> {
    let normal = |v: u32| grid.places[v as usize].normal(surface);
    let is_bad = |t: [u32; 3]| {
        merit::shape(t.map(|v| grid.xyz[v as usize])) < LEAST_SHAPE
            || merit::is_turned(grid, surface, t)
            || is_folded(grid, normal, t)
    };
    let mut bad = Vec::new();
    for &v in near.iter().filter(|&&v| was_alive(grid, v)) {
        for (a, b) in grid.mesh.fan(v) {
            let first = [a, b].iter().all(|w| *w > v || near.binary_search(w).is_err());
            if first && is_bad([v, a, b]) {
                let mut t = [v, a, b];
                t.sort_unstable();
                bad.push(t);
            }
        }
    }
    bad
}
