//! Vertices taken out and put in whole: what going back and forth between two states of a mesh is made of.

use super::{Along, Mesh, Ring};

/// All that a mesh knows of one vertex; the default is that of a removed one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Vertex {
    ring: Ring,
    boundary: bool,
    pinned: bool,
    features: Along,
}

impl Mesh {
    /// What is known of `v`.
    pub fn vertex(&self, v: u32) -> Vertex {
        let i = v as usize;
        Vertex {
            ring: self.rings[i].clone(),
            boundary: self.boundary[i],
            pinned: self.pinned[i],
            features: self.features[i].clone(),
        }
    }

    /// Exchange what is known of `v`. The mesh is whole again when all vertices that changed together are exchanged.
    pub fn swap_vertex(&mut self, v: u32, vertex: &mut Vertex) {
        let i = v as usize;
        self.alive += usize::from(!vertex.ring.is_empty());
        self.alive -= usize::from(!self.rings[i].is_empty());
        std::mem::swap(&mut self.rings[i], &mut vertex.ring);
        std::mem::swap(&mut self.boundary[i], &mut vertex.boundary);
        std::mem::swap(&mut self.pinned[i], &mut vertex.pinned);
        std::mem::swap(&mut self.features[i], &mut vertex.features);
    }

    /// Have so many slots: new ones are unused, those beyond are forgotten and must be unused.
    pub fn resize(&mut self, slots: usize) {
        debug_assert!((slots..self.slots()).all(|i| self.rings[i].is_empty()));
        self.rings.resize(slots, Ring::new());
        self.boundary.resize(slots, false);
        self.pinned.resize(slots, false);
        self.features.resize(slots, Along::new());
        self.free.retain(|&v| (v as usize) < slots);
    }

    /// Never give the ids of vertices removed so far to new ones.
    pub fn retire_removed(&mut self) {
        self.free.clear();
    }
}
