//! T-junctions: a vertex that lies on an edge of a face which does not have it, as meshers leave them between patches.
//! The face takes it in; without that the mesh would have a slit there.

use super::work::{Work, uses};
use glam::DVec3;
use rstar::primitives::GeomWithData;
use rstar::{AABB, RTree};
use std::collections::BTreeSet;

/// So many vertices are looked at in all; beyond, slits stay.
const MOST_LOOKS: usize = 50_000_000;

/// Have every edge of one face only take in the vertices of other such edges that lie on it, within `tolerance` metres.
pub(super) fn stitch(work: &mut Work, tolerance: f64) {
    let uses = uses(&work.faces);
    let naked: Vec<(u32, u32, u32)> = uses
        .chunk_by(|a, b| (a.0, a.1) == (b.0, b.1))
        .filter(|edge| edge.len() == 1)
        .map(|edge| (edge[0].0, edge[0].1, edge[0].2))
        .collect();
    let ends: BTreeSet<u32> = naked.iter().flat_map(|&(a, b, _)| [a, b]).collect();
    let leaf = |&v: &u32| GeomWithData::new(work.points[v as usize].to_array(), v);
    let tree = RTree::bulk_load(ends.iter().map(leaf).collect());
    let mut looks = 0;
    // Each with its face, the edge, and the place along it.
    let mut found: Vec<(u32, (u32, u32), f64, u32)> = Vec::new();
    for (a, b, face) in naked {
        let [p, q] = [a, b].map(|v| work.points[v as usize]);
        let (low, high) = (p.min(q) - tolerance, p.max(q) + tolerance);
        let around = AABB::from_corners(low.to_array(), high.to_array());
        for near in tree.locate_in_envelope(around) {
            looks += 1;
            let (x, v) = (DVec3::from(*near.geom()), near.data);
            let s = (x - p).dot(q - p) / (q - p).length_squared();
            let apart = x.distance(p).min(x.distance(q)) > tolerance && (0.0..1.0).contains(&s);
            let lies_on = apart && x.distance(p.lerp(q, s)) <= tolerance;
            if lies_on && !work.faces[face as usize].contains(&v) {
                found.push((face, (a, b), s, v));
            }
        }
        if looks > MOST_LOOKS {
            break;
        }
    }
    found.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2)).then(a.3.cmp(&b.3)));
    for on_edge in found.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let (face, (a, b), ..) = on_edge[0];
        let face = &mut work.faces[face as usize];
        let n = face.len();
        let at = (0..n).find(|&k| [(a, b), (b, a)].contains(&(face[k], face[(k + 1) % n])));
        let Some(at) = at else { continue };
        let mut taken: Vec<u32> = on_edge.iter().map(|f| f.3).collect();
        if face[at] == b {
            taken.reverse();
        }
        let rest = face.split_off(at + 1);
        face.extend(taken);
        face.extend(rest);
    }
    work.note_count(
        found.len(),
        "joined",
        [
            "vertex to the edge of another face that it lies on",
            "vertices to the edges of other faces that they lie on",
        ],
    );
}
