//! A random start: points spread evenly by chance over the surface's area.

use crate::job::Job;
use crate::surface::{Surface, SurfacePoint};
use glam::DVec3;

/// Number of interior bubbles for an edge length, Eq. 1 with the boundary and the Euler characteristic
/// accounted for: n = k_n A / (2 A0) - n_b / 2 + chi (the perfect hexagon of 61 nodes asks for this); those
/// on features and at anchors are among them.
pub fn interior_count(surface: &Surface, boundary: usize, edge_length: f64, k_n: f64) -> usize {
    let triangle = 3f64.sqrt() / 4.0 * edge_length * edge_length;
    let chi = surface.euler_characteristic() as f64;
    let count = k_n * surface.room() / (2.0 * triangle) - boundary as f64 / 2.0 + chi;
    count.round().max(0.0) as usize
}

/// Draws of a point that keeps off the border, at most: a strip may have no such place.
const MOST_DRAWS: usize = 50;

/// `count` random points, spread evenly (for members of the lengths wanted) over the carrier's area but for those
/// that would fall within `clear` metres of a bubble that is `held`: pressed against the border, they would stay
/// there between two of its bubbles. Fewer where the job is over.
pub fn scatter(
    surface: &Surface,
    count: usize,
    held: &[DVec3],
    clear: f64,
    rng: &mut fastrand::Rng,
    job: &Job,
) -> Vec<SurfacePoint> {
    let carrier = &surface.carrier;
    let mut sums = Vec::with_capacity(carrier.triangles.len());
    let mut sum = 0.0;
    for t in 0..carrier.triangles.len() as u32 {
        let scale = surface.scale_at(&SurfacePoint { triangle: t, bary: [1.0 / 3.0; 3] });
        sum += carrier.triangle_area(t) / (scale * scale);
        sums.push(sum);
    }
    let mut draw = || {
        let at = rng.f64() * sum;
        let triangle = sums.partition_point(|&s| s <= at).min(sums.len() - 1) as u32;
        let (mut u, mut v) = (rng.f64(), rng.f64());
        if u + v > 1.0 {
            (u, v) = (1.0 - u, 1.0 - v);
        }
        SurfacePoint { triangle, bary: [1.0 - u - v, u, v] }
    };
    let near = |p: &SurfacePoint| {
        let xyz = carrier.xyz(p);
        let clear = clear * surface.scale_at(p);
        held.iter().any(|r| r.distance_squared(xyz) < clear * clear)
    };
    (0..count)
        .take_while(|_| !job.is_over("packing"))
        .map(|_| {
            let mut point = draw();
            for _ in 1..MOST_DRAWS {
                if !near(&point) {
                    break;
                }
                point = draw();
            }
            point
        })
        .collect()
}
