//! Loops of a face as rings of pieces in (u, v), the face to their left.

use crate::surface::Shape;
use crate::surface::brep::BrepFace;
use crate::surface::tessellate::trim::{Run, Tracer};
use glam::DVec2;

/// A place farther than this from its foot, over the distance between the places beside it, is looked for again.
const SNAGGED: f64 = 1e-3;

/// A place on a piece: where on its edge, and its parameters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    pub t: f64,
    pub uv: DVec2,
}

/// Part of an edge in a ring, or of a side of the patch that is a pole.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// The edge; None at a pole.
    pub edge: Option<u32>,
    /// Vertices at its two ends, the way it is run.
    pub ends: [u32; 2],
    /// Two places or more, the way it is run.
    pub path: Vec<Spot>,
}

/// Pieces one after the other, round and back.
pub(super) type Ring = Vec<Piece>;

/// The rings of a face.
pub(super) fn of_face(tracer: &Tracer, face: &BrepFace) -> Result<Vec<Ring>, String> {
    let mut rings: Vec<Ring> = Vec::new();
    for runs in tracer.runs(face)? {
        let mut ring: Ring = runs.iter().map(|run| piece(run, &face.shape)).collect();
        // Neighbours agree on where they meet to the last digit.
        for i in 0..ring.len() {
            let end = ring[i].path[ring[i].path.len() - 1].uv;
            let next = (i + 1) % ring.len();
            ring[next].path[0].uv = end;
        }
        rings.push(ring);
    }
    let largest = rings.iter().map(|r| area(r)).max_by(|a, b| a.abs().total_cmp(&b.abs()));
    // A file that has the face the wrong way round.
    if largest.is_some_and(|a| a < 0.0) {
        for ring in &mut rings {
            turn(ring);
        }
    }
    Ok(rings)
}

fn piece(run: &Run, shape: &Shape) -> Piece {
    let (first, last) = (run.nodes[0], run.nodes[run.nodes.len() - 1]);
    let feet = feet(run, shape);
    let path = feet.into_iter().zip(&run.t).map(|(uv, &t)| Spot { t, uv }).collect();
    Piece { edge: run.edge, ends: [first.vertex, last.vertex], path }
}

/// The parameters of a run's places. A foot that was looked for across a fold may have ended in it: then the places
/// before and behind are nearer starts.
fn feet(run: &Run, shape: &Shape) -> Vec<DVec2> {
    let mut feet: Vec<DVec2> = run.nodes.iter().map(|n| n.uv).collect();
    for i in 1..feet.len().saturating_sub(1) {
        let target = run.nodes[i].xyz;
        let off = |uv: DVec2| shape.point(uv).distance(target);
        let step = run.nodes[i - 1].xyz.distance(run.nodes[i + 1].xyz);
        if off(feet[i]) <= SNAGGED * step {
            continue;
        }
        let again = [i - 1, i + 1].map(|k| shape.project(feet[k], target).0);
        for uv in again {
            if off(uv) < off(feet[i]) {
                feet[i] = uv;
            }
        }
    }
    feet
}

/// Run the other way.
fn turn(ring: &mut [Piece]) {
    ring.reverse();
    for piece in ring {
        piece.path.reverse();
        piece.ends.reverse();
    }
}

/// Area in (u, v), positive where the ring runs counter-clockwise.
pub(super) fn area(ring: &[Piece]) -> f64 {
    let from = ring[0].path[0].uv;
    let each = |piece: &Piece| -> f64 {
        piece.path.windows(2).map(|w| (w[0].uv - from).perp_dot(w[1].uv - from)).sum()
    };
    0.5 * ring.iter().map(each).sum::<f64>()
}

/// Corners of the box about rings in (u, v).
pub(super) fn reach(rings: &[Ring]) -> (DVec2, DVec2) {
    let all = || rings.iter().flatten().flat_map(|p| &p.path).map(|s| s.uv);
    (all().fold(DVec2::MAX, DVec2::min), all().fold(DVec2::MIN, DVec2::max))
}

/// Whether a ring holds a place.
pub(super) fn holds(ring: &[Piece], p: DVec2) -> bool {
    let mut inside = false;
    for w in ring.iter().flat_map(|piece| piece.path.windows(2)) {
        let (a, b) = (w[0].uv, w[1].uv);
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y) {
            inside = !inside;
        }
    }
    inside
}
