//! Where a node comes to when it is moved towards a point: by tracing, so never on another sheet.

use crate::grid::{Grid, Place};
use crate::surface::{Chain, ChainPoint, Surface, SurfacePoint};
use glam::DVec3;

/// Tracings at most; each lands nearer to the foot of the target, a few suffice.
const TRACES: usize = 32;

/// The place nearest to `target` that node `v` can move to: along the surface, between features, or along its loop or
/// feature as far as the next nodes there leave room.
pub(super) fn toward(grid: &Grid, surface: &Surface, v: u32, target: DVec3) -> Place {
    let place = grid.places[v as usize];
    let room = grid.room_on_line(surface, v as usize);
    match (place, room) {
        (Place::Interior(p), _) => Place::Interior(trace_to(surface, p, target)),
        (Place::Boundary(at), Some(room)) => {
            Place::Boundary(slide_to(surface, &surface.loops[at.chain as usize], at, room, target))
        }
        (Place::Feature(at), Some(room)) => {
            let chain = &surface.features[at.chain as usize];
            Place::Feature(slide_to(surface, chain, at, room, target))
        }
        (fixed, _) => fixed,
    }
}

/// Trace along the surface until nothing of the way to `target` is left in the tangent plane.
fn trace_to(surface: &Surface, from: SurfacePoint, target: DVec3) -> SurfacePoint {
    let carrier = &surface.carrier;
    let mut p = from;
    for _ in 0..TRACES {
        let normal = carrier.face_normal(p.triangle);
        let off = target - carrier.xyz(&p);
        let next = carrier.trace_between_features(&p, off - normal * off.dot(normal));
        if next == p {
            break;
        }
        p = next;
    }
    p
}

/// The point of the chain nearest to `target`, from `room[0]` back to `room[1]` ahead of `at`.
fn slide_to(
    surface: &Surface,
    chain: &Chain,
    at: ChainPoint,
    [back, ahead]: [f64; 2],
    target: DVec3,
) -> ChainPoint {
    let start = at.s - back;
    let span = back + ahead;
    let mut stops: Vec<f64> = chain.arc.iter().map(|&s| chain.wrap(s - start)).collect();
    stops.retain(|&o| o > 0.0 && o < span);
    stops.extend([0.0, span]);
    stops.sort_by(f64::total_cmp);
    let xyz = |offset: f64| chain.xyz(&surface.carrier, chain.wrap(start + offset));
    let nearest_between = |w: &[f64]| {
        let (a, b) = (xyz(w[0]), xyz(w[1]));
        let along = b - a;
        let f = (target - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
        let f = f.clamp(0.0, 1.0);
        (w[0] + (w[1] - w[0]) * f, (a + along * f).distance_squared(target))
    };
    let best = stops.windows(2).map(nearest_between).min_by(|x, y| x.1.total_cmp(&y.1));
    ChainPoint { s: chain.wrap(start + best.map_or(back, |b| b.0)), ..at }
}
