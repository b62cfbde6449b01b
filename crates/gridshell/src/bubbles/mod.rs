//! Bubbles on a surface: the points from which a grid is made.

pub mod neighbors;

use crate::surface::{ChainPoint, Surface, SurfacePoint};
use glam::DVec3;

/// Bubble centres: those on the loops (fixed while packing) and those inside.
#[derive(Clone, Debug, Default)]
pub struct Bubbles {
    /// Boundary bubbles, loop by loop, ascending along each; corners among them.
    pub boundary: Vec<ChainPoint>,
    /// Bubbles on features between their ends (fixed while packing), feature by feature, ascending along each.
    pub features: Vec<ChainPoint>,
    /// Bubbles at the surface's fixed vertices inside.
    pub fixed: Vec<SurfacePoint>,
    /// Interior bubbles.
    pub interior: Vec<SurfacePoint>,
}

impl Bubbles {
    /// Number of bubbles.
    pub fn len(&self) -> usize {
        self.held() + self.interior.len()
    }

    /// Number of bubbles that stay: all but the interior ones.
    pub fn held(&self) -> usize {
        self.boundary.len() + self.features.len() + self.fixed.len()
    }

    /// The pairs of bubbles that follow one another along features, their ends included.
    pub fn along_features(&self, surface: &Surface) -> Vec<[u32; 2]> {
        let ends = self.at_fixed_vertices(surface);
        let end = |v: u32| ends.binary_search_by_key(&v, |e| e.0).ok().map(|i| ends[i].1);
        let mut pairs = Vec::new();
        for (c, chain) in surface.features.iter().enumerate() {
            let own = |p: &ChainPoint| p.chain.cmp(&(c as u32));
            let from = self.features.partition_point(|p| own(p).is_lt());
            let to = self.features.partition_point(|p| own(p).is_le());
            let inner = (from..to).map(|i| (self.boundary.len() + i) as u32);
            let line: Vec<u32> = if chain.is_closed() {
                inner.clone().chain(inner.clone().next()).collect()
            } else {
                let last = chain.vertices[chain.vertices.len() - 1];
                end(chain.vertices[0]).into_iter().chain(inner).chain(end(last)).collect()
            };
            pairs.extend(line.windows(2).map(|w| [w[0], w[1]]));
        }
        pairs
    }

    /// (carrier vertex, bubble) of the bubbles at fixed vertices, ascending by vertex.
    fn at_fixed_vertices(&self, surface: &Surface) -> Vec<(u32, u32)> {
        let mut found = Vec::new();
        for (i, p) in self.boundary.iter().enumerate() {
            let chain = &surface.loops[p.chain as usize];
            let (k, fraction) = chain.locate(p.s);
            if fraction == 0.0 {
                found.push((chain.vertices[k], i as u32));
            }
        }
        let first = self.boundary.len() + self.features.len();
        for (i, p) in self.fixed.iter().enumerate() {
            let corner = p.bary.iter().position(|&b| b == 1.0).unwrap_or(0);
            let vertex = surface.carrier.triangles[p.triangle as usize][corner];
            found.push((vertex, (first + i) as u32));
        }
        found.sort_unstable();
        found
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Carrier points of all bubbles: boundary, features, fixed, interior.
    pub fn surface_points(&self, surface: &Surface) -> Vec<SurfacePoint> {
        let on_loops =
            self.boundary.iter().map(|c| surface.loops[c.chain as usize].surface_point(c.s));
        let on_features =
            self.features.iter().map(|c| surface.features[c.chain as usize].surface_point(c.s));
        let inside = self.fixed.iter().chain(&self.interior).copied();
        on_loops.chain(on_features).chain(inside).collect()
    }

    /// Centres of all bubbles on the carrier, metres, in the same order.
    pub fn xyz(&self, surface: &Surface) -> Vec<DVec3> {
        self.surface_points(surface).iter().map(|p| surface.carrier.xyz(p)).collect()
    }
}
