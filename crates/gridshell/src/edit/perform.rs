//! Every operation, carried out on a workbench; each gives the nodes that may have changed.

use super::workbench::{Workbench, was_alive};
use super::{Edit, Refusal, line};
use crate::grid::Place;
use crate::stages::regularize::{drift_path, heal};
use crate::stages::relax::relax;

/// Trials of healing for each irregular node.
const TRIALS: usize = 400;
/// A region has at most so many rings.
const MOST_RINGS: u32 = 1000;
/// A step shorter than this share of l0 does not count as one.
const STEP: f64 = 1e-9;

impl Workbench<'_> {
    /// Carry out an edit, nodes round it balanced; gives the nodes that may have changed.
    pub(super) fn perform(&mut self, edit: &Edit) -> Result<Vec<u32>, Refusal> {
        match *edit {
            Edit::Flip { nodes } => self.flip(nodes),
            Edit::Split { nodes } => self.split(nodes),
            Edit::Collapse { nodes } => self.collapse(nodes),
            Edit::Drift { nodes, toward, steps } => self.drift(nodes, toward, steps),
            Edit::Move { node, to } => self.move_node(node, to),
            Edit::Pin { node } => self.pin(node),
            Edit::Unpin { node } => self.unpin(node),
            Edit::AddAnchor { at } => self.add_anchor(at),
            Edit::RemoveAnchor { node } => self.remove_anchor(node),
            Edit::AddGuide { .. } | Edit::RemoveGuide { .. } => {
                unreachable!("what changes the surface is not done on a workbench")
            }
            Edit::Heal { ref nodes, rings, seed } => self.heal(nodes, rings, seed),
            Edit::Relax { ref nodes, rings } => {
                let region = self.region(nodes, rings)?;
                Ok(self.relax(region))
            }
            Edit::RelaxAll {} => Ok(self.relax(self.grid().mesh.vertices().collect())),
        }
    }

    /// Both ends of a member exist and differ.
    fn check_member(&self, [a, b]: [u32; 2]) -> Result<(), Refusal> {
        self.check_node(a)?;
        self.check_node(b)?;
        if self.grid().mesh.adjacent(a, b) {
            return Ok(());
        }
        Err(Refusal::of_member(a, b, crate::mesh::Refusal::NoEdge))
    }

    pub(super) fn check_node(&self, v: u32) -> Result<(), Refusal> {
        if was_alive(self.grid(), v) { Ok(()) } else { Err(Refusal::no_node(v)) }
    }

    fn flip(&mut self, nodes: [u32; 2]) -> Result<Vec<u32>, Refusal> {
        self.check_member(nodes)?;
        let [a, b] = nodes;
        let done = self.state.flip(a, b);
        done.map_err(|why| Refusal::of_flip(self.grid(), a, b, why))?;
        Ok(self.balance_round(&self.touched()))
    }

    fn split(&mut self, nodes: [u32; 2]) -> Result<Vec<u32>, Refusal> {
        self.check_member(nodes)?;
        let [a, b] = nodes;
        self.state.split(a, b).map_err(|why| Refusal::of_member(a, b, why))?;
        Ok(self.balance_round(&self.touched()))
    }

    fn collapse(&mut self, nodes: [u32; 2]) -> Result<Vec<u32>, Refusal> {
        self.check_member(nodes)?;
        let [a, b] = nodes;
        let keep = self.state.collapse(a, b).map_err(|why| Refusal::of_collapse(a, b, why))?;
        let mut changed = self.balance_round(&self.touched());
        changed.push(if keep == a { b } else { a });
        Ok(changed)
    }

    fn drift(
        &mut self,
        nodes: [u32; 2],
        toward: Option<u32>,
        steps: Option<u32>,
    ) -> Result<Vec<u32>, Refusal> {
        self.check_member(nodes)?;
        let [a, b] = nodes;
        let [off_a, off_b] = nodes.map(|v| self.state.deviation[v as usize]);
        let (low, high) = if off_a < off_b { (a, b) } else { (b, a) };
        let mesh = &self.grid().mesh;
        if off_a.signum() * off_b.signum() >= 0 {
            return Err(Refusal::new(
                format!("nodes {a} and {b} have degrees {} and {}", off_a + 6, off_b + 6),
                "only an adjacent pair can drift: one node below degree six, one above",
            ));
        }
        if mesh.is_boundary(a) || mesh.is_boundary(b) {
            return Err(Refusal::new(
                format!("member {a}-{b} touches the boundary"),
                "collapse the boundary member beside where the low degree is on the boundary, else split it",
            ));
        }
        let sides = [mesh.left(low, high), mesh.right(low, high)];
        let wanted = match toward {
            Some(v) if sides.contains(&Some(v)) => [Some(v), None],
            Some(v) => {
                let reason = format!("node {v} is on neither side of member {a}-{b}");
                return Err(Refusal::new(reason, "give an apex of one of its two panels"));
            }
            None => sides,
        };
        let mut path = |side: u32| drift_path(&mut self.state, low, high, side);
        let paths = wanted.map(|side| side.and_then(&mut path));
        let Some(path) = paths.into_iter().flatten().min_by_key(Vec::len) else {
            return Err(Refusal::new(
                format!("the pair {a}-{b} cannot drift there"),
                "try the other side, or flip a member beside it",
            ));
        };
        let mut changed = Vec::new();
        for (p, q) in path.into_iter().take(steps.map_or(usize::MAX, |n| n as usize)) {
            let done = self.state.flip(p, q);
            let (c, d) = done.map_err(|why| Refusal::of_flip(self.grid(), p, q, why))?;
            changed.extend(self.balance_round(&[p, q, c, d]));
        }
        Ok(changed)
    }

    fn move_node(&mut self, v: u32, to: [f64; 3]) -> Result<Vec<u32>, Refusal> {
        self.check_node(v)?;
        let target = self.editor.surface.origin.local(to.into());
        let grid = self.grid();
        let at = grid.xyz[v as usize];
        if grid.places[v as usize].is_fixed() {
            return Err(self.fixed(v));
        }
        if grid.mesh.is_pinned(v) {
            return Err(Refusal::new(format!("node {v} is pinned"), "unpin it first"));
        }
        let around = grid.mesh.ring(v).iter().map(|&w| grid.length(v, w)).fold(0.0, f64::max);
        let far = at.distance(target);
        if !far.is_finite() || far > around {
            return Err(Refusal::new(
                format!("the target is {far:.3} m from node {v}, its longest member {around:.3} m"),
                "move it less far, and relax in between",
            ));
        }
        let place = line::toward(grid, &self.editor.surface, v, target);
        self.state.remember(&[v]);
        self.state.grid.places[v as usize] = place;
        self.state.grid.xyz[v as usize] = place.xyz(&self.editor.surface);
        if self.grid().xyz[v as usize].distance(at) <= STEP * self.editor.edge_length {
            return Err(Refusal::new(
                format!("node {v} stays where it is: it is as near to the target as it can be"),
                "choose a target along the surface, or along its line",
            ));
        }
        Ok(vec![v])
    }

    /// Why a fixed node does not move.
    pub(super) fn fixed(&self, v: u32) -> Refusal {
        match self.grid().places[v as usize] {
            Place::Corner(_) => Refusal::new(
                format!("node {v} is a corner of the boundary or an anchor on it"),
                "corners stay; an anchor can be removed",
            ),
            _ => Refusal::new(
                format!("node {v} is an anchor or the end of a crease or guide"),
                "remove the anchor or the guide first",
            ),
        }
    }

    fn pin(&mut self, v: u32) -> Result<Vec<u32>, Refusal> {
        self.check_node(v)?;
        if self.grid().mesh.is_pinned(v) {
            return Err(Refusal::new(
                format!("node {v} is fixed already"),
                "there is nothing to do",
            ));
        }
        self.state.grid.mesh.pin(v, true);
        Ok(vec![v])
    }

    fn unpin(&mut self, v: u32) -> Result<Vec<u32>, Refusal> {
        self.check_node(v)?;
        if self.grid().places[v as usize].is_fixed() {
            return Err(self.fixed(v));
        }
        if !self.grid().mesh.is_pinned(v) {
            return Err(Refusal::new(format!("node {v} is not pinned"), "there is nothing to do"));
        }
        self.state.grid.mesh.pin(v, false);
        Ok(vec![v])
    }

    /// The nodes within so many rings of these.
    fn region(&mut self, nodes: &[u32], rings: u32) -> Result<Vec<u32>, Refusal> {
        if nodes.is_empty() {
            return Err(Refusal::new("no node is given", "name the nodes in the middle"));
        }
        nodes.iter().try_for_each(|&v| self.check_node(v))?;
        let rings = rings.min(MOST_RINGS) as usize;
        Ok(self.state.region(nodes, rings).into_vec())
    }

    fn heal(&mut self, nodes: &[u32], rings: u32, seed: u64) -> Result<Vec<u32>, Refusal> {
        let region = self.region(nodes, rings)?;
        let slots = self.grid().mesh.slots();
        let mut inside = vec![false; slots];
        for &v in &region {
            inside[v as usize] = true;
        }
        let inside = |v: u32| inside.get(v as usize).copied().unwrap_or(true);
        if !region.iter().any(|&v| self.state.deviation[v as usize] != 0) {
            return Err(Refusal::new("all nodes there are regular", "there is nothing to heal"));
        }
        let recipe = &self.editor.recipe;
        if !heal(&mut self.state, recipe, &inside, TRIALS, seed, &self.editor.job) {
            return Err(Refusal::new(
                "nothing better was found there",
                "heal more rings, try another seed, or split or collapse a member by hand",
            ));
        }
        Ok(self.all())
    }

    /// Relax these nodes: the rest is pinned meanwhile.
    pub(super) fn relax(&mut self, region: Vec<u32>) -> Vec<u32> {
        let mut inside = vec![false; self.grid().mesh.slots()];
        for &v in &region {
            inside[v as usize] = true;
        }
        let mesh = &self.grid().mesh;
        let rest = mesh.vertices().filter(|&v| !inside[v as usize] && !mesh.is_pinned(v));
        let held: Vec<u32> = rest.collect();
        for &v in &held {
            self.state.grid.mesh.pin(v, true);
        }
        self.state.remember(&region);
        let editor = self.editor;
        relax(&editor.surface, &mut self.state.grid, &editor.recipe, &editor.job);
        for &v in &held {
            self.state.grid.mesh.pin(v, false);
        }
        region
    }
}
