//! What an edit changed, to go back and forth by: the nodes that differ, whole.

use crate::grid::{Grid, Place};
use crate::mesh::Vertex;
use crate::surface::SurfacePoint;
use glam::DVec3;

/// The nodes that differ between two states of a grid, as they are in the other one.
#[derive(Clone, Debug)]
pub(super) struct Change {
    slots: usize,
    nodes: Vec<(u32, Node)>,
}

#[derive(Clone, Debug, PartialEq)]
struct Node {
    vertex: Vertex,
    place: Place,
    xyz: DVec3,
}

impl Node {
    fn of(grid: &Grid, v: u32) -> Node {
        let i = v as usize;
        Node { vertex: grid.mesh.vertex(v), place: grid.places[i], xyz: grid.xyz[i] }
    }

    /// What stands in a slot that was never used.
    fn none() -> Node {
        let place = Place::Interior(SurfacePoint { triangle: 0, bary: [1.0, 0.0, 0.0] });
        Node { vertex: Vertex::default(), place, xyz: DVec3::ZERO }
    }
}

impl Change {
    /// What leads from `here` to `there`; `there` has all of `here`'s slots.
    pub(super) fn between(here: &Grid, there: &Grid) -> Change {
        let old = here.mesh.slots();
        let slots = there.mesh.slots();
        let differs = |v: &u32| *v as usize >= old || Node::of(here, *v) != Node::of(there, *v);
        let nodes = (0..slots as u32).filter(differs).map(|v| (v, Node::of(there, v))).collect();
        Change { slots, nodes }
    }

    /// Take `grid` to the other state; doing it again takes it back.
    pub(super) fn swap(&mut self, grid: &mut Grid) {
        let slots = grid.mesh.slots();
        resize(grid, slots.max(self.slots));
        for (v, node) in &mut self.nodes {
            let i = *v as usize;
            grid.mesh.swap_vertex(*v, &mut node.vertex);
            std::mem::swap(&mut grid.places[i], &mut node.place);
            std::mem::swap(&mut grid.xyz[i], &mut node.xyz);
        }
        resize(grid, self.slots);
        self.slots = slots;
    }
}

fn resize(grid: &mut Grid, slots: usize) {
    let Node { place, xyz, .. } = Node::none();
    grid.mesh.resize(slots);
    grid.places.resize(slots, place);
    grid.xyz.resize(slots, xyz);
}
