//! A surface that is a triangle mesh and nothing more: each triangle stays as it is.

use super::carrier::NONE;
use super::chain::Segment;
use super::{Carrier, Chain, Surface};
use glam::DVec3;
use std::collections::BTreeMap;

impl Surface {
    /// The surface made of these manifold, consistently oriented triangles; without corners.
    pub fn from_facets(name: &str, points: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Surface {
        let patch = vec![0; triangles.len()];
        let carrier = Carrier::new(points, triangles, patch, Vec::new());
        let area = (0..carrier.triangles.len() as u32).map(|t| carrier.triangle_area(t)).sum();
        let loops = trace_loops(&carrier);
        Surface {
            name: name.to_owned(),
            carrier,
            loops,
            shapes: Vec::new(),
            curves: Vec::new(),
            area,
        }
    }
}

/// The boundary loops, each from its lowest vertex, ascending by that.
fn trace_loops(carrier: &Carrier) -> Vec<Chain> {
    // The boundary edge that leaves each boundary vertex.
    let mut leaving = BTreeMap::new();
    for (t, neighbors) in carrier.neighbors.iter().enumerate() {
        for edge in (0..3).filter(|&k| neighbors[k] == NONE) {
            leaving.insert(carrier.triangles[t][edge], (t, edge));
        }
    }
    let mut loops = Vec::new();
    while let Some((&first, _)) = leaving.first_key_value() {
        let mut chain = Chain { arc: vec![0.0], ..Chain::default() };
        let mut at = first;
        let mut length = 0.0;
        while let Some((t, edge)) = leaving.remove(&at) {
            let next = carrier.triangles[t][(edge + 1) % 3];
            length += carrier.points[at as usize].distance(carrier.points[next as usize]);
            chain.vertices.push(at);
            chain.arc.push(length);
            let triangle = t as u32;
            chain.segments.push(Segment {
                curve: u32::MAX,
                t: [0.0, 1.0],
                triangle,
                edge: edge as u8,
            });
            at = next;
        }
        loops.push(chain);
    }
    loops
}
