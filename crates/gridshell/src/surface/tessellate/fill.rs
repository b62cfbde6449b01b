//! Points for the inside of a face: candidates in close rows over (u, v), thinned by their distance in space.
//!
//! A candidate is taken when nothing taken before lies nearer than the spacing wanted there. Distances are
//! measured in space, so a pole or a stretched parameterisation does not crowd its triangles; sheets that
//! face apart do not see each other. The spacing follows the bending of the patch and grows gently away
//! from short boundary pieces.

use super::edges::{LEAST_SHARE, ROUNDING, piece_length};
use super::trim::{NEW, Node};
use crate::job::Job;
use crate::math::trig;
use crate::surface::{PREPARING, Sampling, Shape};
use glam::{DVec2, DVec3, IVec3};
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// Neighbours stay this share of the spacing apart. Triangles of a thinned set have edges of one to two
/// times that.
const APART: f64 = 0.72;
/// Candidates stand this many to a spacing, in both directions.
const CANDIDATES: f64 = 5.0;
/// How fast the spacing grows with the distance from a finer place.
const GROWTH: f64 = 0.5;
/// Candidate rows and candidates in a row at most: a guard for degenerate patches.
const MOST: usize = 20_000;
/// Points looked at, before a face counts as crowded: so many in any face (two seconds), for bends that are much sharper
/// in one place than in others, as at the tip of a vault or in waves; and so many for each node that it may have. Faces
/// without fault were seen to take up to 240 million; large even ones should take 570 (estimated) for each such node.
pub(super) const LOOKS: usize = 250_000_000;
pub(super) const LOOKS_TO_A_NODE: usize = 600;
/// What a candidate takes besides, most of it for its point and normal, in such looks.
const LOOKS_TO_A_CANDIDATE: usize = 50;
/// Rows stand at least this share of the face's extent apart.
const LEAST_STEP: f64 = 1e-5;
/// Probes of the bending at most in each direction.
const MOST_PROBES: f64 = 160.0;

/// Nodes for the inside of the polygons `loops`. None where there would be more than `most`, or where they crowd
/// so that finding them takes more than so many `looks` at points.
pub(super) fn inside(
    shape: &Shape,
    loops: &[Vec<Node>],
    sampling: &Sampling,
    most: usize,
    looks: usize,
    job: &Job,
) -> Option<Vec<Node>> {
    if job.is_over(PREPARING) {
        return None;
    }
    let sizes = Sizes::new(shape, loops, sampling);
    let mut taken = Taken::new(sampling.max_edge);
    for l in loops {
        for i in 0..l.len() {
            let (a, b) = (&l[i], &l[(i + 1) % l.len()]);
            let length = a.xyz.distance(b.xyz);
            if a.free.is_some() && a.vertex == b.vertex {
                taken.push(a.xyz, DVec3::ZERO, sizes.at(a.uv));
                continue;
            }
            let size =
                sizes.at(0.5 * (a.uv + b.uv)).min(length).max(sampling.max_edge * LEAST_SHARE);
            // A piece longer than the spacing beside it must keep points off between its ends too.
            let pieces = (length / size - ROUNDING).ceil().max(1.0);
            for k in 0..pieces as usize {
                let uv = a.uv.lerp(b.uv, k as f64 / pieces);
                let at = a.xyz.lerp(b.xyz, k as f64 / pieces);
                taken.push(at, shape.jet(uv).normal(), size);
            }
        }
    }
    let mut nodes = Vec::new();
    let [lo, hi] = bounds(loops);
    // A first row on the side itself would find it above or below by rounding.
    let mut v = lo.y + LEAST_STEP * (hi.y - lo.y);
    for _ in 0..MOST {
        let mut step = f64::INFINITY;
        for [u0, u1] in intervals(loops, v) {
            let mut u = u0;
            for _ in 0..MOST {
                if u >= u1 {
                    break;
                }
                if job.is_over(PREPARING) {
                    return None;
                }
                let uv = DVec2::new(u, v);
                let jet = shape.jet(uv);
                let wanted = sizes.at(uv);
                let (along, across) = (jet.du.length(), jet.dv.length());
                step = step.min(wanted / (CANDIDATES * across.max(1e-300)));
                let normal = jet.normal();
                if let Some(size) = taken.room(jet.point, normal, wanted) {
                    taken.push(jet.point, normal, size);
                    nodes.push(Node { uv, xyz: jet.point, vertex: NEW, free: None });
                }
                if nodes.len() > most || taken.looks > looks {
                    return None;
                }
                u += (wanted / (CANDIDATES * along.max(1e-300)))
                    .min(0.5 * (u1 - u0))
                    .max(1e-9 * (hi.x - lo.x));
            }
        }
        v += step.min((hi.y - lo.y) / 16.0).max(LEAST_STEP * (hi.y - lo.y));
        if v >= hi.y {
            break;
        }
    }
    Some(nodes)
}

/// Box of the polygons in (u, v).
fn bounds(loops: &[Vec<Node>]) -> [DVec2; 2] {
    let all = || loops.iter().flatten().map(|n| n.uv);
    [all().fold(DVec2::MAX, DVec2::min), all().fold(DVec2::MIN, DVec2::max)]
}

/// Stretches of the line at `v` that lie inside the polygons, by parity.
fn intervals(loops: &[Vec<Node>], v: f64) -> Vec<[f64; 2]> {
    let mut cuts = Vec::new();
    for l in loops {
        for i in 0..l.len() {
            let (a, b) = (l[i].uv, l[(i + 1) % l.len()].uv);
            if (a.y > v) != (b.y > v) {
                cuts.push(a.x + (b.x - a.x) * (v - a.y) / (b.y - a.y));
            }
        }
    }
    cuts.sort_by(f64::total_cmp);
    cuts.chunks_exact(2).map(|c| [c[0], c[1]]).collect()
}

/// The spacing wanted over the patch: `max_edge`, less where it bends.
struct Sizes {
    origin: DVec2,
    step: DVec2,
    count: [usize; 2],
    spacing: Vec<f64>,
}

impl Sizes {
    fn new(shape: &Shape, loops: &[Vec<Node>], sampling: &Sampling) -> Sizes {
        let [lo, hi] = bounds(loops);
        let count = [0, 1].map(|k| {
            let other = 0.5 * (lo[1 - k] + hi[1 - k]);
            let line = (0..=16).map(|i| {
                let t = lo[k] + (hi[k] - lo[k]) * f64::from(i) / 16.0;
                shape.point(if k == 0 { DVec2::new(t, other) } else { DVec2::new(other, t) })
            });
            let line: Vec<DVec3> = line.collect();
            let length: f64 = line.windows(2).map(|w| w[0].distance(w[1])).sum();
            let spans = shape.lattice(k).len() as f64;
            let probes = 2.0 * length / sampling.max_edge * (1.0 + ROUNDING);
            probes.max(spans).clamp(8.0, MOST_PROBES) as usize + 1
        });
        let step = (hi - lo) / DVec2::new((count[0] - 1) as f64, (count[1] - 1) as f64);
        let place = |i: usize, j: usize| lo + step * DVec2::new(i as f64, j as f64);
        let jets: Vec<_> = (0..count[0] * count[1])
            .map(|k| shape.jet(place(k / count[1], k % count[1])))
            .collect();
        let mut bends = vec![0.0_f64; jets.len()];
        let mut see = |a: usize, b: usize| {
            let (p, q) = (&jets[a], &jets[b]);
            let length = p.point.distance(q.point);
            let (n, m) = (p.normal(), q.normal());
            // A pole has no normal; its neighbours tell the bending.
            if length > 0.0 && n != DVec3::ZERO && m != DVec3::ZERO {
                let bend = trig::angle(n, m) / length;
                bends[a] = bends[a].max(bend);
                bends[b] = bends[b].max(bend);
            }
        };
        for k in 0..jets.len() {
            if k % count[1] + 1 < count[1] {
                see(k, k + 1);
            }
            if k / count[1] + 1 < count[0] {
                see(k, k + count[1]);
            }
        }
        let spacing = bends.iter().map(|&b| piece_length(sampling, b)).collect();
        Sizes { origin: lo, step, count, spacing }
    }

    /// The smallest spacing at the corners of the probes' cell that holds `uv`, or of both cells that meet there.
    fn at(&self, uv: DVec2) -> f64 {
        let [columns, rows] = [0, 1].map(|k| {
            let at = (uv[k] - self.origin[k]) / self.step[k];
            let cell = |at: f64| (at.max(0.0) as usize).min(self.count[k] - 2);
            cell(at - ROUNDING)..=cell(at + ROUNDING) + 1
        });
        let row = |i: usize| rows.clone().map(move |j| self.spacing[i * self.count[1] + j]);
        columns.flat_map(row).fold(f64::INFINITY, f64::min)
    }
}

/// The points taken so far, by cells of space.
struct Taken {
    cell: f64,
    cells: HashMap<IVec3, Vec<(DVec3, DVec3, f64)>, BuildHasherDefault<Mix>>,
    /// Points that were looked at so far.
    looks: usize,
}

/// Hashes the three numbers of a cell, quickly: nobody chooses them to collide.
#[derive(Default)]
struct Mix(u64);

impl Hasher for Mix {
    fn write(&mut self, bytes: &[u8]) {
        for &b in bytes {
            self.write_i32(i32::from(b));
        }
    }

    fn write_i32(&mut self, x: i32) {
        // An odd number with bits all over: 2^64 over the golden ratio.
        self.0 = (self.0.rotate_left(29) ^ u64::from(x as u32)).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    }

    fn finish(&self) -> u64 {
        self.0 ^ self.0 >> 32
    }
}

impl Taken {
    fn new(cell: f64) -> Taken {
        Taken { cell, cells: HashMap::default(), looks: 0 }
    }

    fn key(&self, p: DVec3) -> IVec3 {
        (p / self.cell).floor().as_ivec3()
    }

    fn push(&mut self, point: DVec3, normal: DVec3, size: f64) {
        self.cells.entry(self.key(point)).or_default().push((point, normal, size));
    }

    /// The spacing a point here would have, if there is room for it.
    fn room(&mut self, p: DVec3, normal: DVec3, wanted: f64) -> Option<f64> {
        let (lo, hi) = (self.key(p - wanted), self.key(p + wanted));
        let mut size = wanted;
        let mut nearest = f64::INFINITY;
        self.looks += LOOKS_TO_A_CANDIDATE;
        for x in lo.x..=hi.x {
            for y in lo.y..=hi.y {
                for z in lo.z..=hi.z {
                    for &(q, m, s) in self.cells.get(&IVec3::new(x, y, z)).into_iter().flatten() {
                        self.looks += 1;
                        let d = p.distance(q);
                        // A sheet that faces away lies on the other side of a fold.
                        if d >= wanted || m.dot(normal) < 0.0 {
                            continue;
                        }
                        nearest = nearest.min(d);
                        size = size.min(s + GROWTH * d);
                        if nearest < APART * size * 0.5 {
                            return None;
                        }
                    }
                }
            }
        }
        (nearest >= APART * size).then_some(size)
    }
}
