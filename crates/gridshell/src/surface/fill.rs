//! Points for the inside of a face: candidates in close rows over (u, v), thinned by their distance in space.
//!
//! A candidate is taken when nothing taken before lies nearer than the spacing wanted there. Distances are
//! measured in space, so a pole or a stretched parameterisation does not crowd its triangles; sheets that
//! face apart do not see each other. The spacing follows the bending of the patch and grows gently away
//! from short boundary pieces.

use super::PREPARING;
use super::model::Sampling;
use super::sample::{LEAST_SHARE, ROUNDING, piece_length};
use super::shape::Shape;
use super::trim::{NEW, Node};
use crate::job::Job;
use crate::math::trig;
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
/// Points looked at before a face counts as crumpled: so many in any face (two seconds), and so many for each node
/// that it may have. A crumpled face has sheets upon sheets in one place, or two directions that run nearly the same way.
pub(super) const LOOKS: usize = 250_000_000;
pub(super) const LOOKS_TO_A_NODE: usize = 600;
/// What a candidate takes besides, most of it for its point and normal, in such looks.
const LOOKS_TO_A_CANDIDATE: usize = 50;
/// Rows stand at least this share of the face's extent apart.
const LEAST_STEP: f64 = 1e-5;
/// Candidates in a row stand at least this share of it apart.
const LEAST_ADVANCE: f64 = 1e-9;
/// Probes of the bending at most in each direction.
const MOST_PROBES: f64 = 160.0;

/// A column of probes leaves out rows where those that it wants stand this many times as far apart: no ratio that a
/// drawing is likely to have, as rounding would decide then. Smaller: faces that bend a little more here than there
/// are sampled otherwise; larger: a sharp bend makes more of the face dear.
const SPARSE: f64 = 4.3;

/// Nodes for the inside of the polygons `loops`. None where there would be more than `most`, or where the patch is so
/// crumpled that finding them would take much longer than for as many elsewhere.
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
    let [lo, hi] = bounds(loops);
    let mut rows = Rows {
        shape,
        job,
        width: hi.x - lo.x,
        close: LEAST_STEP * (hi.y - lo.y),
        columns: vec![Column::default(); sizes.count[0]],
        taken: Taken::new(sampling.max_edge),
        nodes: Vec::new(),
        most,
        looks,
        sizes: &sizes,
    };
    for l in loops {
        for i in 0..l.len() {
            rows.take_rim(&l[i], &l[(i + 1) % l.len()], sampling);
        }
    }
    // A first row on the side itself would find it above or below by rounding.
    let mut v = lo.y + LEAST_STEP * (hi.y - lo.y);
    for _ in 0..MOST {
        for stretch in intervals(loops, v) {
            rows.walk(stretch, v)?;
        }
        v += rows.step(v).min((hi.y - lo.y) / 16.0).max(LEAST_STEP * (hi.y - lo.y));
        if v >= hi.y {
            break;
        }
    }
    Some(rows.nodes)
}

/// Candidates in rows over the patch. Where one place wants close rows, columns of probes that do not leave most of
/// them out: what a sharp bend costs is paid where it is, not across the whole face.
struct Rows<'a> {
    shape: &'a Shape,
    job: &'a Job,
    sizes: &'a Sizes,
    /// Extent of the face in u.
    width: f64,
    /// Rows are not nearer to each other in v: what is due within that is due now, as rounding would decide else.
    close: f64,
    columns: Vec<Column>,
    taken: Taken,
    nodes: Vec<Node>,
    /// Nodes and looks at most.
    most: usize,
    looks: usize,
}

/// What a column of probes wants of the rows.
#[derive(Clone, Copy)]
struct Column {
    /// The row that it waits for.
    due: f64,
    /// How far its next row may be from this one; infinite where the row did not cross it.
    step: f64,
}

impl Default for Column {
    fn default() -> Column {
        Column { due: f64::NEG_INFINITY, step: f64::INFINITY }
    }
}

impl Rows<'_> {
    /// Keep points off a piece of the rim.
    fn take_rim(&mut self, a: &Node, b: &Node, sampling: &Sampling) {
        let length = a.xyz.distance(b.xyz);
        if a.free.is_some() && a.vertex == b.vertex {
            self.taken.push(a.xyz, DVec3::ZERO, self.sizes.at(a.uv));
            return;
        }
        let size = self.sizes.at(0.5 * (a.uv + b.uv)).min(length);
        let size = size.max(sampling.max_edge * LEAST_SHARE);
        // A piece longer than the spacing beside it must keep points off between its ends too.
        let pieces = (length / size - ROUNDING).ceil().max(1.0);
        for k in 0..pieces as usize {
            let uv = a.uv.lerp(b.uv, k as f64 / pieces);
            let at = a.xyz.lerp(b.xyz, k as f64 / pieces);
            self.taken.push(at, self.shape.jet(uv).normal(), size);
        }
    }

    /// Try candidates along a stretch of the row at `v`. None where there are too many.
    fn walk(&mut self, [from, to]: [f64; 2], v: f64) -> Option<()> {
        let mut u = from;
        for _ in 0..MOST {
            if u >= to {
                break;
            }
            if self.job.is_over(PREPARING) {
                return None;
            }
            let (column, end) = self.sizes.column(u);
            let here = &mut self.columns[column];
            if here.due > v + self.close {
                here.step = here.step.min(here.due - v);
                u = end.max(u + LEAST_ADVANCE * self.width);
                continue;
            }
            let uv = DVec2::new(u, v);
            let jet = self.shape.jet(uv);
            let wanted = self.sizes.at(uv);
            let (along, across) = (jet.du.length(), jet.dv.length());
            here.step = here.step.min(wanted / (CANDIDATES * across.max(1e-300)));
            let normal = jet.normal();
            if let Some(size) = self.taken.room(jet.point, normal, wanted) {
                self.taken.push(jet.point, normal, size);
                self.nodes.push(Node { uv, xyz: jet.point, vertex: NEW, free: None });
            }
            if self.nodes.len() > self.most || self.taken.looks > self.looks {
                return None;
            }
            u += (wanted / (CANDIDATES * along.max(1e-300)))
                .min(0.5 * (to - from))
                .max(LEAST_ADVANCE * self.width);
        }
        Some(())
    }

    /// How far the row after that at `v` is away. Columns that want sparser ones wait.
    fn step(&mut self, v: f64) -> f64 {
        let step = self.columns.iter().map(|c| c.step).fold(f64::INFINITY, f64::min);
        for c in &mut self.columns {
            if c.due <= v + self.close {
                let waits = c.step.is_finite() && c.step >= SPARSE * step;
                c.due = if waits { v + c.step } else { f64::NEG_INFINITY };
            }
            c.step = f64::INFINITY;
        }
        step
    }
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
        let mut sizes = Sizes { origin: lo, step, count, spacing };
        let points: Vec<DVec3> = jets.iter().map(|j| j.point).collect();
        sizes.grade(&points);
        sizes
    }

    /// Let the spacing grow gently away from where it is fine, over probes at these `points`.
    fn grade(&mut self, points: &[DVec3]) {
        let [rows, across] = self.count;
        let mut ease = |a: usize, b: usize| {
            let eased = self.spacing[b] + GROWTH * points[a].distance(points[b]);
            self.spacing[a] = self.spacing[a].min(eased);
        };
        // There and back: each probe learns from the two before it, then from the two behind.
        let before = |k: usize| {
            let above = (k >= across).then(|| k - across);
            above.into_iter().chain((!k.is_multiple_of(across)).then(|| k - 1))
        };
        for k in 0..rows * across {
            before(k).for_each(|j| ease(k, j));
        }
        for k in (0..rows * across).rev() {
            before(k).for_each(|j| ease(j, k));
        }
    }

    /// The column of probes that holds `u`, and where it ends.
    fn column(&self, u: f64) -> (usize, f64) {
        let at = ((u - self.origin.x) / self.step.x).max(0.0) as usize;
        let column = at.min(self.count[0] - 2);
        (column, self.origin.x + self.step.x * (column + 1) as f64)
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

/// Levels of cells, each half as wide as the one before: down to the finest spacing, 1 / 64.
const LEVELS: usize = 7;

/// The points taken so far, by cells of space: on each level those whose spacing is between half a cell and a whole one,
/// so that no cell holds many.
struct Taken {
    /// Width of the widest cells.
    cell: f64,
    levels: [Cells; LEVELS],
    /// Points that were looked at so far.
    looks: usize,
}

/// Points, normals and spacings by cell.
type Cells = HashMap<IVec3, Vec<(DVec3, DVec3, f64)>, BuildHasherDefault<Mix>>;

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
        Taken { cell, levels: Default::default(), looks: 0 }
    }

    fn push(&mut self, point: DVec3, normal: DVec3, size: f64) {
        let finer = |&l: &usize| size <= width(self.cell, l) * (1.0 + ROUNDING);
        let level = (1..LEVELS).take_while(finer).last().unwrap_or(0);
        let key = key(point, width(self.cell, level));
        self.levels[level].entry(key).or_default().push((point, normal, size));
    }

    /// The spacing a point here would have, if there is room for it.
    fn room(&mut self, p: DVec3, normal: DVec3, wanted: f64) -> Option<f64> {
        let mut size = wanted;
        let mut nearest = f64::INFINITY;
        let Taken { cell, levels, looks } = self;
        *looks += LOOKS_TO_A_CANDIDATE;
        for (level, cells) in levels.iter().enumerate() {
            if cells.is_empty() {
                continue;
            }
            // Points of finer spacing than wanted only matter close to them.
            let width = width(*cell, level);
            let reach = wanted.min(width);
            let (lo, hi) = (key(p - reach, width), key(p + reach, width));
            let cells = (lo.x..=hi.x).flat_map(|x| {
                (lo.y..=hi.y)
                    .flat_map(move |y| (lo.z..=hi.z).map(move |z| IVec3::new(x, y, z)))
                    .filter_map(|k| cells.get(&k))
            });
            for &(q, m, s) in cells.flatten() {
                *looks += 1;
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
        (nearest >= APART * size).then_some(size)
    }
}

/// Width of the cells of a level, where the widest have the width `cell`.
fn width(cell: f64, level: usize) -> f64 {
    cell / f64::from(1_u32 << level)
}

/// The cell of this width that holds `p`.
fn key(p: DVec3, width: f64) -> IVec3 {
    (p / width).floor().as_ivec3()
}
