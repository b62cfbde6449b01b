//! Polylines without the points that say nothing at the size of a member: scans and exports have them by the thousand,
//! and each would become a vertex of the carrier with slivers round it.
//!
//! The points that are left are points of the polyline. It stays as it is where its points stand farther apart than a
//! quarter of a member.

use glam::DVec3;

/// A polyline may stray this far from itself, over l0: a twentieth of what the carrier itself may be off.
const STRAY: f64 = 1e-4;
/// No line between two points gets longer than this over l0, so that the polyline keeps following the surface.
const LONGEST: f64 = 0.25;
/// More points than this for each member's length are a scan's noise ...
const MOST_PER_MEMBER: f64 = 100.0;
/// ... and those nearer to the last one than this over l0 are passed over. Smaller: nothing is won; larger: bends that
/// a member could follow are cut.
const NOISE: f64 = 0.01;
/// As many points are always cheap.
const FEW: usize = 1000;

/// The points that are left, and whether noise was cut off with the others. `length` is l0.
pub(super) fn thinned(points: &[DVec3], length: f64) -> (Vec<DVec3>, bool) {
    let kept = straightened(points, STRAY * length, LONGEST * length);
    let whole: f64 = kept.windows(2).map(|w| w[0].distance(w[1])).sum();
    if kept.len() <= FEW || kept.len() as f64 <= MOST_PER_MEMBER * whole / length {
        return (kept, false);
    }
    let mut smooth: Vec<DVec3> = Vec::new();
    for &p in &kept {
        if smooth.last().is_none_or(|last| last.distance(p) > NOISE * length) {
            smooth.push(p);
        }
    }
    let last = kept[kept.len() - 1];
    if smooth.last() != Some(&last) {
        smooth.push(last);
    }
    (smooth, true)
}

/// From each point kept on to the farthest one by which nothing between them strays. A span is looked for by doubling
/// and then halving, so each point is looked at some dozen times.
fn straightened(points: &[DVec3], stray: f64, longest: f64) -> Vec<DVec3> {
    let fits = |i: usize, j: usize| {
        points[i].distance(points[j]) <= longest
            && points[i + 1..j].iter().all(|p| off(*p, points[i], points[j]) <= stray)
    };
    let mut kept = Vec::new();
    let Some(last) = points.len().checked_sub(1) else { return kept };
    let mut i = 0;
    while i < last {
        kept.push(points[i]);
        let (mut good, mut step) = (i + 1, 2);
        while i + step <= last && fits(i, i + step) {
            good = i + step;
            step *= 2;
        }
        let mut bad = (i + step).min(last + 1);
        while bad - good > 1 {
            let middle = usize::midpoint(good, bad);
            if fits(i, middle) {
                good = middle;
            } else {
                bad = middle;
            }
        }
        i = good;
    }
    kept.push(points[last]);
    kept
}

/// Distance of `p` from the line between `a` and `b`.
fn off(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let d = b - a;
    let t = (p - a).dot(d) / d.length_squared();
    if t.is_finite() { p.distance(a + d * t.clamp(0.0, 1.0)) } else { p.distance(a) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::trig::{cos, sin};

    fn spiral(n: usize, noise: f64) -> Vec<DVec3> {
        let mut rng = fastrand::Rng::with_seed(3);
        let at = |k: usize| {
            let t = k as f64 / (n - 1) as f64;
            let (s, c) = (sin(12.0 * t), cos(12.0 * t));
            DVec3::new(c, s, 0.0) * (1.0 + 4.0 * t)
        };
        let mut shaken = || DVec3::new(rng.f64() - 0.5, rng.f64() - 0.5, 0.0) * noise;
        (0..n).map(|k| at(k) + shaken()).collect()
    }

    #[test]
    fn a_coarse_polyline_stays_as_it_is() {
        let line: Vec<DVec3> = (0..5).map(|k| DVec3::X * f64::from(k)).collect();
        assert_eq!(thinned(&line, 1.0), (line.clone(), false));
        assert_eq!(thinned(&line[..1], 1.0).0, line[..1]);
        assert!(thinned(&[], 1.0).0.is_empty());
    }

    #[test]
    fn however_many_points_there_are_as_many_are_left_and_none_strays() {
        for n in [5_000, 20_000, 100_000] {
            let all = spiral(n, 0.0);
            let (kept, noise) = thinned(&all, 0.5);
            assert!(!noise && kept.len() < 1200, "{n}: {}", kept.len());
            let strays = all.iter().step_by(97).any(|p| {
                let near = kept.windows(2).map(|w| off(*p, w[0], w[1]));
                near.fold(f64::INFINITY, f64::min) > STRAY * 0.5
            });
            assert!(!strays, "{n}");
            assert_eq!((kept[0], kept[kept.len() - 1]), (all[0], all[n - 1]));
        }
    }

    #[test]
    fn noise_of_a_scan_is_cut_off() {
        for n in [20_000, 100_000] {
            let (kept, noise) = thinned(&spiral(n, 0.004), 0.5);
            assert!(noise && kept.len() < 10_000, "{n}: {}", kept.len());
        }
    }
}
