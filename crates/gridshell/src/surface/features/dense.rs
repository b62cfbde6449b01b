//! Corners so dense that members cannot honour them: the teeth of a fractal border, a guide that zigzags within a member.
//!
//! The rule: corners that follow one another within half a member are a run. A run of four or fewer is a notch or a
//! chamfer that the designer drew, and stays. Of a longer one, a corner stays where leaving it out would take the line
//! more than a quarter of a member off its course, the farthest first, as long as it is half a member from those that
//! stay already. Nowhere do two corners stay that count as one node. What is left out is told with how far it stands off.

use crate::math::trig;
use crate::surface::{Chain, NEAREST, Origin, Surface};
use glam::DVec3;

/// Corners within this distance along their line, over l0, are a run.
const RUN: f64 = 0.5;
/// Runs of no more corners are details that the designer drew.
const NOTCH: usize = 4;
/// A corner of a run stays if the line would else be farther off its course, over l0.
const OFF: f64 = 0.25;
/// Angles, and shares of distances, that differ by less are alike.
const ALIKE: f64 = 1e-6;

/// A corner of a line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// Where, metres.
    pub at: DVec3,
    /// Arc length there, metres.
    pub s: f64,
    /// By what angle the line turns there.
    pub turn: f64,
}

/// What is left of a line's corners.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Thinned {
    /// Places of those that stay in the list of all, ascending.
    pub kept: Vec<usize>,
    /// How far, metres, one that was left out is off the line through those that stay, at most.
    pub off: f64,
    /// Where that is.
    pub worst: DVec3,
}

/// Thin the corners of a line, which are in its order; `round` is the length of a closed one. `None` where all stay.
pub(super) fn thin(corners: &[Corner], round: Option<f64>, length: f64) -> Option<Thinned> {
    let n = corners.len();
    if n < 2 {
        return None;
    }
    let mut keep = vec![true; n];
    for run in runs(corners, round, RUN * length) {
        if run.len() > NOTCH + usize::from(run.first() == run.last()) {
            for &k in &run[1..run.len() - 1] {
                keep[k] = false;
            }
            keep_farthest(corners, &run, length, &mut keep);
        } else {
            part_nearest(corners, &run, length, &mut keep);
        }
    }
    if keep.iter().all(|&k| k) {
        return None;
    }
    let kept: Vec<usize> = (0..n).filter(|&k| keep[k]).collect();
    let (off, worst) = farthest_left_out(corners, &kept, round.is_some());
    Some(Thinned { kept, off, worst })
}

/// The runs of corners within `gap` of one another. One that goes all round ends with the corner that it begins with,
/// the farthest from the middle.
fn runs(corners: &[Corner], round: Option<f64>, gap: f64) -> Vec<Vec<usize>> {
    let n = corners.len();
    let joined = |k: usize| match (k + 1 < n, round) {
        (true, _) => corners[k + 1].s - corners[k].s < gap,
        (false, Some(round)) => corners[0].s + round - corners[k].s < gap,
        (false, None) => false,
    };
    // A run may go on past the line's first corner: begin behind a gap.
    let Some(first) = (0..n).find(|&k| !joined(k)) else {
        let middle = corners.iter().map(|c| c.at).sum::<DVec3>() / n as f64;
        let start = first_of_largest(n, |k| corners[k].at.distance(middle));
        return vec![(start..=start + n).map(|k| k % n).collect()];
    };
    let mut runs: Vec<Vec<usize>> = Vec::new();
    let mut run = Vec::new();
    for k in (first + 1..=first + n).map(|k| k % n) {
        run.push(k);
        if !joined(k) {
            runs.push(std::mem::take(&mut run));
        }
    }
    runs.retain(|run| run.len() > 1);
    runs
}

/// The first place of the largest value, with room for rounding.
fn first_of_largest(n: usize, value: impl Fn(usize) -> f64) -> usize {
    let mut best = (0, value(0));
    for k in 1..n {
        let x = value(k);
        if x > best.1 + ALIKE * best.1.abs() {
            best = (k, x);
        }
    }
    best.0
}

/// Of a dense run keep what the line's course needs: the farthest from the chord first, then on both its sides.
fn keep_farthest(corners: &[Corner], run: &[usize], length: f64, keep: &mut [bool]) {
    let at = |i: usize| corners[run[i]].at;
    let mut open = vec![(0, run.len() - 1)];
    while let Some((from, to)) = open.pop() {
        let (a, b) = (at(from), at(to));
        let far = |i: usize| {
            let spaced = at(i).distance(a).min(at(i).distance(b)) >= RUN * length;
            if spaced { off_chord(a, b, at(i)) } else { 0.0 }
        };
        if to - from < 2 {
            continue;
        }
        let farthest = from + 1 + first_of_largest(to - from - 1, |k| far(from + 1 + k));
        if far(farthest) > OFF * length {
            keep[run[farthest]] = true;
            open.extend([(from, farthest), (farthest, to)]);
        }
    }
}

/// Of two neighbours at one place keep the sharper, or else the first.
fn part_nearest(corners: &[Corner], run: &[usize], length: f64, keep: &mut [bool]) {
    let mut last = run[0];
    for &k in &run[1..] {
        if k == last || corners[k].at.distance(corners[last].at) >= NEAREST * length {
            last = k;
        } else if corners[k].turn > corners[last].turn + ALIKE {
            keep[last] = false;
            last = k;
        } else {
            keep[k] = false;
        }
    }
}

fn farthest_left_out(corners: &[Corner], kept: &[usize], closed: bool) -> (f64, DVec3) {
    let (n, mut worst) = (corners.len(), (0.0, corners[0].at));
    for (i, &from) in kept.iter().enumerate() {
        let to = match kept.get(i + 1) {
            Some(&to) => to,
            None if closed => kept[0] + n,
            None => break,
        };
        for k in from + 1..to {
            let p = corners[k % n].at;
            let off = off_chord(corners[from].at, corners[to % n].at, p);
            if off > worst.0 {
                worst = (off, p);
            }
        }
    }
    worst
}

/// Distance of `p` from the stretch from `a` to `b`.
fn off_chord(a: DVec3, b: DVec3, p: DVec3) -> f64 {
    let along = b - a;
    let f = (p - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
    (a + along * f.clamp(0.0, 1.0)).distance(p)
}

impl Surface {
    /// Thin the corners of all loops for members of `length` metres; gives what is to be told.
    pub(super) fn thin_corners(&mut self, length: f64) -> Option<String> {
        let (mut left_out, mut worst) = (0, (0.0, DVec3::ZERO));
        for l in 0..self.loops.len() {
            let corners = self.corners_of(l);
            let chain = &mut self.loops[l];
            let Some(thinned) = thin(&corners, Some(chain.length()), length) else { continue };
            left_out += corners.len() - thinned.kept.len();
            if thinned.off >= worst.0 {
                worst = (thinned.off, thinned.worst);
            }
            chain.corners = thinned.kept.iter().map(|&k| chain.corners[k]).collect();
            chain.begin_at_corner();
            chain.measure(&self.carrier);
        }
        let (off, p) = (worst.0, self.origin.world(worst.1));
        (left_out > 0).then(|| {
            format!(
                "corners of the border are nearer to one another than members allow: {left_out} are no nodes, and the \
                 grid may leave the border by up to {off:.3} m between its nodes, near ({:.3}, {:.3}, {:.3})",
                p.x, p.y, p.z
            )
        })
    }

    fn corners_of(&self, l: usize) -> Vec<Corner> {
        let chain = &self.loops[l];
        let n = chain.segments.len();
        let tangents = |k: usize| chain.end_tangents(&self.carrier, &self.curves, k);
        let corner = |&k: &u32| {
            let k = k as usize;
            Corner {
                at: self.carrier.points[chain.vertices[k] as usize],
                s: chain.arc[k],
                turn: trig::angle(tangents((k + n - 1) % n)[1], tangents(k)[0]),
            }
        };
        chain.corners.iter().map(corner).collect()
    }
}

impl Chain {
    /// Turn a closed chain so that it begins at its first corner. Arc lengths are to be measured again.
    pub(in crate::surface) fn begin_at_corner(&mut self) {
        let Some(&first) = self.corners.first() else { return };
        self.vertices.rotate_left(first as usize);
        self.segments.rotate_left(first as usize);
        for c in &mut self.corners {
            *c -= first;
        }
    }
}

/// A guide without the turns that are too dense for members of `length` metres, and what is to be told.
pub(super) fn thin_guide(
    i: usize,
    points: &[DVec3],
    corner_angle: f64,
    length: f64,
    origin: Origin,
) -> Option<(Vec<DVec3>, String)> {
    let mut s = 0.0;
    let mut corners = Vec::new();
    for k in 0..points.len() {
        let into = points[k] - points[k.saturating_sub(1)];
        let out = points[(k + 1).min(points.len() - 1)] - points[k];
        s += into.length();
        let is_end = k == 0 || k + 1 == points.len();
        let turn = if is_end { f64::INFINITY } else { trig::angle(into, out) };
        if turn > corner_angle {
            corners.push((k, Corner { at: points[k], s, turn }));
        }
    }
    let all: Vec<Corner> = corners.iter().map(|c| c.1).collect();
    let thinned = thin(&all, None, length)?;
    let mut stays = vec![true; points.len()];
    for w in thinned.kept.windows(2).filter(|w| w[1] > w[0] + 1) {
        // The whole course between two that stay goes with the turns that do not.
        let [from, to] = [w[0], w[1]].map(|k| corners[k].0);
        stays[from + 1..to].fill(false);
    }
    let left: Vec<DVec3> = points.iter().zip(&stays).filter(|p| *p.1).map(|p| *p.0).collect();
    let (count, p) = (points.len() - left.len(), origin.world(thinned.worst));
    let note = format!(
        "guide {} turns more often than members can: {count} of its points are left out, and members leave it by up to \
         {:.3} m, near ({:.3}, {:.3}, {:.3})",
        i + 1,
        thinned.off,
        p.x,
        p.y,
        p.z
    );
    Some((left, note))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners at these places of a polyline, all turning alike.
    fn line(points: &[[f64; 2]]) -> Vec<Corner> {
        let mut s = 0.0;
        let mut last = None;
        let corner = |&[x, y]: &[f64; 2]| {
            let at = DVec3::new(x, y, 0.0);
            s += last.replace(at).map_or(0.0, |p: DVec3| p.distance(at));
            Corner { at, s, turn: 1.0 }
        };
        points.iter().map(corner).collect()
    }

    /// Teeth of this width and height along a stretch, from tip to tip.
    fn teeth(count: usize, width: f64, height: f64) -> Vec<[f64; 2]> {
        let x = |k: usize| k as f64 * 0.5 * width;
        (0..=2 * count).map(|k| [x(k), if k % 2 == 1 { height } else { 0.0 }]).collect()
    }

    #[test]
    fn what_a_designer_draws_stays() {
        let notch = [[0.0, 0.0], [3.0, 0.0], [3.0, 0.3], [3.3, 0.3], [3.3, 0.0], [9.0, 0.0]];
        let chamfer = [[0.0, 0.0], [4.9, 0.0], [5.0, 0.1], [5.0, 5.0]];
        for points in [&notch[..], &chamfer[..], &teeth(9, 2.0, 1.0)[..]] {
            assert_eq!(thin(&line(points), None, 1.0), None);
        }
    }

    #[test]
    fn fine_teeth_go_whatever_their_number_and_coarse_waves_stay() {
        for count in [5, 40, 300] {
            let thinned = thin(&line(&teeth(count, 0.1, 0.08)), None, 1.0).expect("they are dense");
            assert_eq!(thinned.kept, [0, 2 * count], "only the ends stay");
            assert!((thinned.off - 0.08).abs() < 1e-12, "{}", thinned.off);
            // The same, every length ten times as long.
            let scaled: Vec<[f64; 2]> = teeth(count, 1.0, 0.8);
            assert_eq!(thin(&line(&scaled), None, 10.0).expect("dense").kept, thinned.kept);
            // Teeth on a bend: its apex stays.
            let half = 0.05 * count as f64;
            let bent = |[x, y]: [f64; 2]| [x, y + half - (x - half).abs()];
            let bent: Vec<_> = teeth(count, 0.1, 0.08).into_iter().map(bent).collect();
            let stay = thin(&line(&bent), None, 1.0).expect("dense").kept.len();
            assert!(stay >= 3 || half < 0.5, "{stay} of {count}");
        }
    }

    #[test]
    fn of_two_corners_at_one_place_the_sharper_stays() {
        for (first, second, kept) in
            [(1.0, 1.5, [0, 2, 3]), (1.5, 1.0, [0, 1, 3]), (1.0, 1.0, [0, 1, 3])]
        {
            let mut corners = line(&[[0.0, 0.0], [5.0, 0.0], [5.0, 0.01], [5.0, 6.0]]);
            (corners[1].turn, corners[2].turn) = (first, second);
            assert_eq!(thin(&corners, None, 1.0).expect("one goes").kept, kept);
        }
    }

    #[test]
    fn a_run_that_goes_all_round_keeps_its_shape() {
        for n in [60, 600, 3000] {
            let star: Vec<[f64; 2]> = (0..n)
                .map(|k| {
                    let (a, r) =
                        (std::f64::consts::TAU * k as f64 / n as f64, 5.0 + 0.02 * (k % 2) as f64);
                    [r * trig::cos(a), r * trig::sin(a)]
                })
                .collect();
            let corners = line(&star);
            let round = corners[n - 1].s + corners[0].at.distance(corners[n - 1].at);
            let thinned = thin(&corners, Some(round), 2.0 * round / n as f64 + 1.0).expect("dense");
            assert!(thinned.kept.len() >= 3 && thinned.kept.len() < 40, "{}", thinned.kept.len());
            assert!(thinned.off < 1.5, "{}", thinned.off);
        }
    }
}
