//! Anchors put in and taken out by hand.

use super::workbench::Workbench;
use super::{Refusal, line};
use crate::grid::Place;
use glam::DVec3;

/// The nodes nearest to an anchor, of which the one that can come closest is taken.
const CANDIDATES: usize = 12;
/// An anchor is further off than this, over l0, than what nodes can come to: it is not on the surface.
const OFF: f64 = 0.5;
/// Places as near to the anchor as this to each other, over l0, are alike.
const ALIKE: f64 = 1e-6;

impl Workbench<'_> {
    /// Bring the nearest node to `at` (in the file's coordinates), fix it there, and balance the nodes round it.
    pub(super) fn add_anchor(&mut self, at: [f64; 3]) -> Result<Vec<u32>, Refusal> {
        let origin = self.editor.surface.origin;
        let at = origin.local(at.into());
        let length = self.editor.edge_length;
        let Some((v, place, off)) = self.nearest(at).filter(|n| n.2 <= OFF * length) else {
            return Err(Refusal::new(
                format!("no free node can come to {}", origin.told(at)),
                "give a point on the surface, with a node beside it that is neither fixed nor on a crease or guide",
            ));
        };
        debug_assert!(off.is_finite());
        let fixed = match place {
            Place::Boundary(at) => Place::Corner(at),
            other => Place::Fixed(other.surface_point(&self.editor.surface)),
        };
        self.state.grid.places[v as usize] = fixed;
        self.state.grid.xyz[v as usize] = fixed.xyz(&self.editor.surface);
        self.state.grid.mesh.pin(v, true);
        Ok(self.balance_round(&[v]))
    }

    /// The node that comes closest to `at`, the place that it comes to, and how far that is off; of several alike the
    /// one that is nearest.
    fn nearest(&self, at: DVec3) -> Option<(u32, Place, f64)> {
        let (grid, surface) = (self.grid(), &*self.editor.surface);
        let free = |v: &u32| {
            let on_feature = matches!(grid.places[*v as usize], Place::Feature(_));
            !grid.mesh.is_pinned(*v) && !on_feature
        };
        let apart = |v: &u32| grid.xyz[*v as usize].distance(at);
        let mut nodes: Vec<u32> = grid.mesh.vertices().filter(free).collect();
        nodes.sort_by(|v, w| apart(v).total_cmp(&apart(w)));
        let near = nodes.into_iter().take(CANDIDATES);
        let comes = near.map(|v| {
            let place = line::toward(grid, surface, v, at);
            (v, place, place.exact(surface).distance(at))
        });
        let alike = ALIKE * self.editor.edge_length;
        comes.reduce(|best, next| if next.2 < best.2 - alike { next } else { best })
    }

    /// Free an anchored node; it stays where it is until something moves it.
    pub(super) fn remove_anchor(&mut self, v: u32) -> Result<Vec<u32>, Refusal> {
        self.check_node(v)?;
        let surface = &self.editor.surface;
        let place = self.grid().places[v as usize];
        let at_corner = |chain: u32| {
            let chain = &surface.loops[chain as usize];
            let mut corners = chain.corners.iter().map(|&k| chain.vertices[k as usize]);
            let here = place.xyz(surface);
            let near = super::AT_CORNER * self.editor.edge_length;
            corners.any(|c| surface.carrier.points[c as usize].distance(here) <= near)
        };
        let on_line = !self.grid().mesh.along_features(v).is_empty();
        let free = match place {
            Place::Fixed(p) if !on_line => Place::Interior(p),
            Place::Corner(at) if !on_line && !at_corner(at.chain) => Place::Boundary(at),
            Place::Fixed(_) | Place::Corner(_) => {
                return Err(Refusal::new(
                    format!("node {v} is a corner of the boundary or the end of a crease or guide"),
                    "such nodes stay",
                ));
            }
            _ => {
                return Err(Refusal::new(
                    format!("node {v} is not an anchor"),
                    "where it is pinned, unpin it",
                ));
            }
        };
        self.state.grid.places[v as usize] = free;
        self.state.grid.mesh.pin(v, false);
        Ok(vec![v])
    }
}
