//! A row of members brought onto a new feature.

use super::Refusal;
use super::workbench::Workbench;
use crate::grid::Place;
use crate::surface::{ChainPoint, Surface};
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// Nodes farther from a feature than this, over l0, are not brought onto it.
const REACH: f64 = 2.0;
/// What being off the feature costs on the way along it: so much times the square of the distance over l0.
const OFF: f64 = 8.0;
/// Places nearer than this, over l0, are one.
const SAME: f64 = 1e-6;
/// Rings of nodes that give way.
const RINGS: usize = 4;
/// Sweeps by which they do.
const SWEEPS: usize = 30;

impl Workbench<'_> {
    /// Bring the row of nodes that is nearest to open feature `chain` onto it, and let the nodes round it give way;
    /// gives all that may have changed. `before` is the
    /// surface as it was: where its features are met, one of their nodes comes to stand.
    pub(super) fn lay_row(&mut self, chain: u32, before: &Surface) -> Result<Vec<u32>, Refusal> {
        let surface = &*self.editor.surface;
        let feature = &surface.features[chain as usize];
        let ends = [0.0, feature.length()].map(|s| feature.xyz(&surface.carrier, s));
        let [first, last] = [self.end_node(ends[0], before)?, self.end_node(ends[1], before)?];
        let row = self.row(chain, first, last).filter(|_| first != last).ok_or_else(|| {
            Refusal::new(
                "no row of free nodes runs along the guide",
                "draw it where members can follow it, farther from the boundary and from other lines",
            )
        })?;
        let state = &mut self.state;
        let mut along = vec![0.0];
        for w in row.windows(2) {
            along.push(along[along.len() - 1] + state.grid.length(w[0], w[1]));
        }
        let whole = along[along.len() - 1];
        for (&v, s) in row.iter().zip(&along).skip(1).take(row.len() - 2) {
            let place = Place::Feature(ChainPoint { chain, s: feature.length() * s / whole });
            state.grid.places[v as usize] = place;
            state.grid.xyz[v as usize] = place.xyz(surface);
        }
        for w in row.windows(2) {
            let marked = state.grid.mesh.mark_feature(w[0], w[1]);
            marked.expect("the nodes of a row are joined");
        }
        let region = self.state.region(&row, RINGS).into_vec();
        self.give_way(&region);
        Ok(self.relax(region))
    }

    /// The node that is or comes to stand at this end of a feature.
    fn end_node(&mut self, at: DVec3, before: &Surface) -> Result<u32, Refusal> {
        let surface = &*self.editor.surface;
        let same = SAME * self.editor.edge_length;
        let carrier = &surface.carrier;
        let inside = surface.fixed.iter().find(|p| carrier.xyz(p).distance(at) <= same);
        let corners = surface.loops.iter().enumerate().flat_map(|(c, l)| {
            let place = move |&k: &u32| ChainPoint { chain: c as u32, s: l.arc[k as usize] };
            l.corners.iter().map(place)
        });
        let corner =
            |c: &ChainPoint| surface.loops[c.chain as usize].xyz(carrier, c.s).distance(at) <= same;
        let place = match (inside, corners.into_iter().find(corner)) {
            (Some(p), _) => Place::Fixed(*p),
            (None, Some(c)) => Place::Corner(c),
            (None, None) => unreachable!("a feature ends at fixed nodes"),
        };
        let met = before.nearest_on_features(at).is_some_and(|(_, off)| off <= same);
        let grid = &mut self.state.grid;
        let fits = |v: &u32| match grid.places[*v as usize] {
            Place::Corner(_) | Place::Fixed(_) => grid.xyz[*v as usize].distance(at) <= same,
            Place::Boundary(_) => matches!(place, Place::Corner(_)) && !grid.mesh.is_pinned(*v),
            Place::Feature(_) => met && !grid.mesh.is_pinned(*v),
            Place::Interior(_) => {
                !met && matches!(place, Place::Fixed(_)) && !grid.mesh.is_pinned(*v)
            }
        };
        let apart = |v: &u32| grid.xyz[*v as usize].distance(at);
        let nearest =
            grid.mesh.vertices().filter(fits).min_by(|v, w| apart(v).total_cmp(&apart(w)));
        let Some(v) = nearest.filter(|v| apart(v) <= REACH * self.editor.edge_length) else {
            return Err(Refusal::new(
                format!("no free node is near the guide's end {}", surface.origin.told(at)),
                "end it at a free node, or at one that is fixed there",
            ));
        };
        grid.places[v as usize] = place;
        grid.xyz[v as usize] = place.exact(surface);
        grid.mesh.pin(v, true);
        Ok(v)
    }

    /// The way along members from `first` to `last` over free nodes that is shortest and nearest to the feature.
    fn row(&self, chain: u32, first: u32, last: u32) -> Option<Vec<u32>> {
        let (grid, surface) = (self.grid(), &*self.editor.surface);
        let feature = &surface.features[chain as usize];
        let length = self.editor.edge_length;
        let off = |x: DVec3| feature.nearest(&surface.carrier, x).1 / length;
        let free = |v: u32| {
            let place = grid.places[v as usize];
            v == last || matches!(place, Place::Interior(_)) && !grid.mesh.is_pinned(v)
        };
        // Cost and the node before, of the nodes reached; the front by cost, its bits in order as they are positive.
        let mut best: BTreeMap<u32, (f64, u32)> = BTreeMap::from([(first, (0.0, first))]);
        let mut front = BTreeSet::from([(0, first)]);
        while let Some((cost, v)) = front.pop_first() {
            if v == last {
                break;
            }
            let cost = f64::from_bits(cost);
            for &w in grid.mesh.ring(v).iter().filter(|&&w| free(w)) {
                let middle = 0.5 * (grid.xyz[v as usize] + grid.xyz[w as usize]);
                let (far, aside) = (off(grid.xyz[w as usize]), off(middle));
                if far > REACH {
                    continue;
                }
                let next = cost + grid.length(v, w) * (1.0 + OFF * (aside * aside + far * far));
                let known = best.get(&w).map_or(f64::INFINITY, |b| b.0);
                if next < known {
                    front.remove(&(known.to_bits(), w));
                    front.insert((next.to_bits(), w));
                    best.insert(w, (next, v));
                }
            }
        }
        let mut row = vec![last];
        while row[row.len() - 1] != first {
            row.push(best.get(&row[row.len() - 1])?.1);
        }
        row.reverse();
        // Where three nodes of a panel are on the way, the middle one is left out.
        let mut k = 0;
        while k + 2 < row.len() {
            if grid.mesh.adjacent(row[k], row[k + 2]) {
                row.remove(k + 1);
                k = k.saturating_sub(1);
            } else {
                k += 1;
            }
        }
        Some(row)
    }

    /// Sweep the free nodes inside to the middle of their neighbours, over whatever line lies between: a node may be
    /// on the wrong side of a feature that has just come.
    fn give_way(&mut self, region: &[u32]) {
        let surface = &*self.editor.surface;
        let grid = &mut self.state.grid;
        for _ in 0..SWEEPS {
            for &v in region {
                let Place::Interior(p) = grid.places[v as usize] else { continue };
                if grid.mesh.is_pinned(v) {
                    continue;
                }
                let ring = grid.mesh.ring(v);
                let middle: DVec3 = ring.iter().map(|&w| grid.xyz[w as usize]).sum();
                let step = middle / ring.len() as f64 - surface.carrier.xyz(&p);
                let place = Place::Interior(surface.carrier.trace(&p, step));
                grid.places[v as usize] = place;
                grid.xyz[v as usize] = place.xyz(surface);
            }
        }
    }
}
