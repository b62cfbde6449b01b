//! A flattening of the carrier with little distortion, on which a lattice can be laid.
//!
//! The start is the projection along the mean normal where that folds nothing over, otherwise Tutte's
//! embedding (the longest loop on a circle, a hub in every other loop), which never folds. Then local/global
//! steps make every triangle as rigid as possible with a free boundary (Liu et al., *A local/global approach
//! to mesh parameterization*, 2008). Only for one connected piece of genus 0 with a boundary; a chart may
//! still overlap itself (a spiral does), which a lattice does not mind.

use crate::error::Result;
use crate::job::{Job, Picture};
use crate::math::conjugate::{conjugate_gradients, product};
use crate::math::frame::tangents;
use crate::math::multigrid::Multigrid;
use crate::math::sparse::{Row, Sparse};
use crate::math::trig::{atan2, cos, sin};
use crate::surface::carrier::NONE;
use crate::surface::{Carrier, Chain, ChainPoint, Surface, SurfacePoint};
use glam::{DMat2, DVec2, DVec3};

/// What a stop in here is told as.
const FLATTENING: &str = "flattening the surface";
/// Local/global steps from a projection, and from Tutte's embedding, which is farther off.
const STEPS: [usize; 2] = [16, 60];
/// Conjugate-gradient steps in each at most, from where the last one ended; a dozen is usual.
const SOLVER_STEPS: usize = 80;
/// What a step leaves of its first residual: the next one turns the triangles anyway.
const ACCURACY: f64 = 1e-2;
/// Rigid enough when a step begins with a residual below this share of the right side.
const SETTLED: f64 = 1e-6;
/// A triangle that is seen at a flatter angle than this, as its sine, is seen edge-on.
const LEAST_SEEN: f64 = 1e-6;
/// Smallest cotangent weight; obtuse pairs would make the system indefinite.
const LEAST_WEIGHT: f64 = 0.02;

/// Plane coordinates of every carrier vertex, metres.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Indexed as `Carrier::points`.
    pub uv: Vec<DVec2>,
    /// Whether no triangle is turned over (it may still overlap itself as a whole).
    pub upright: bool,
}

impl Chart {
    /// Flatten a surface, as its scale shrinks and stretches it where lengths are to vary; None where that makes no
    /// sense: closed, not connected, or with handles.
    pub fn flatten(surface: &Surface, job: &Job) -> Result<Option<Chart>> {
        let (carrier, loops) = (&surface.carrier, &surface.loops);
        // chi = 2 - 2 genus - loops for one piece.
        if loops.is_empty()
            || surface.euler_characteristic() != 2 - loops.len() as i64
            || !is_connected(carrier)
        {
            return Ok(None);
        }
        let (uv, steps) = match projection(carrier) {
            Some(uv) if surface.scale.is_empty() => (uv, STEPS[0]),
            Some(uv) => (uv, STEPS[1]),
            None => (tutte(carrier, loops, job), STEPS[1]),
        };
        let mut chart = Chart { uv: as_rigid_as_possible(surface, uv, steps, job), upright: true };
        chart.upright = (0..carrier.triangles.len()).all(|t| {
            let [p, q, r] = chart.corners(carrier, t);
            (q - p).perp_dot(r - p) > 0.0
        });
        job.check(FLATTENING)?;
        Ok(Some(chart))
    }

    /// How much the chart stretches and shrinks: root mean square of (length in the chart / on the surface - 1).
    pub fn strain(&self, surface: &Surface) -> f64 {
        let carrier = &surface.carrier;
        let (mut sum, mut count) = (0.0, 0.0);
        for (t, corners) in carrier.triangles.iter().enumerate() {
            let scale = scale(surface, t);
            for k in 0..3 {
                let (a, b) = (corners[k] as usize, corners[(k + 1) % 3] as usize);
                let length = carrier.points[a].distance(carrier.points[b]) / scale;
                let strain = self.uv[a].distance(self.uv[b]) / length - 1.0;
                sum += strain * strain;
                count += 1.0;
            }
        }
        (sum / count).sqrt()
    }

    /// Direction of the border at this share (0 to 1) of its whole length, loop after loop, radians.
    pub fn border_direction(&self, loops: &[Chain], share: f64) -> f64 {
        let mut at = share * loops.iter().map(Chain::length).sum::<f64>();
        for chain in loops {
            if at < chain.length() {
                let (k, _) = chain.locate(at);
                let next = chain.vertices[(k + 1) % chain.vertices.len()];
                let d = self.uv[next as usize] - self.uv[chain.vertices[k] as usize];
                return atan2(d.y, d.x);
            }
            at -= chain.length();
        }
        0.0
    }

    /// Corners of carrier triangle `t` in the plane.
    pub fn corners(&self, carrier: &Carrier, t: usize) -> [DVec2; 3] {
        carrier.triangles[t].map(|v| self.uv[v as usize])
    }

    /// Where a carrier point is in the plane.
    pub fn at(&self, carrier: &Carrier, p: &SurfacePoint) -> DVec2 {
        let corners = self.corners(carrier, p.triangle as usize);
        corners[0] * p.bary[0] + corners[1] * p.bary[1] + corners[2] * p.bary[2]
    }

    /// Where a point of a loop is in the plane.
    pub fn on_loop(&self, surface: &Surface, c: &ChainPoint) -> DVec2 {
        self.on_chain(&surface.loops, c)
    }

    /// Where a point of one of these chains is in the plane.
    pub fn on_chain(&self, chains: &[Chain], c: &ChainPoint) -> DVec2 {
        let chain = &chains[c.chain as usize];
        let (k, fraction) = chain.locate(c.s);
        let next = chain.vertices[(k + 1) % chain.vertices.len()];
        self.uv[chain.vertices[k] as usize].lerp(self.uv[next as usize], fraction)
    }
}

/// Scale of a triangle.
fn scale(surface: &Surface, t: usize) -> f64 {
    surface.scale_at(&SurfacePoint { triangle: t as u32, bary: [1.0 / 3.0; 3] })
}

fn is_connected(carrier: &Carrier) -> bool {
    let mut seen = vec![false; carrier.triangles.len()];
    let mut stack = vec![0u32];
    let mut count = 0;
    while let Some(t) = stack.pop() {
        if std::mem::replace(&mut seen[t as usize], true) {
            continue;
        }
        count += 1;
        stack.extend(carrier.neighbors[t as usize].iter().filter(|&&n| n != NONE));
    }
    count == seen.len()
}

/// The carrier seen along its mean normal; None where a triangle is seen from behind or edge-on.
fn projection(carrier: &Carrier) -> Option<Vec<DVec2>> {
    let area = |p: [DVec3; 3]| (p[1] - p[0]).cross(p[2] - p[0]);
    let mean: DVec3 = (0..carrier.triangles.len()).map(|t| area(carrier.corners(t as u32))).sum();
    let normal = mean.normalize_or_zero();
    let seen = |t: usize| {
        let area = area(carrier.corners(t as u32));
        area.dot(normal) > LEAST_SEEN * area.length()
    };
    if !(0..carrier.triangles.len()).all(seen) {
        return None;
    }
    // Right-handed with the normal towards the viewer.
    let [x, y] = tangents(normal);
    Some(carrier.points.iter().map(|p| DVec2::new(p.dot(x), p.dot(y))).collect())
}

/// Tutte's embedding: every inner vertex in the middle of its neighbours.
fn tutte(carrier: &Carrier, loops: &[Chain], job: &Job) -> Vec<DVec2> {
    let n = carrier.points.len();
    let hubs = loops.len() - 1;
    let outer = (0..loops.len())
        .max_by(|&a, &b| loops[a].length().total_cmp(&loops[b].length()))
        .unwrap_or(0);
    let mut entries: Vec<(u32, u32, f64)> = Vec::new();
    for corners in &carrier.triangles {
        for k in 0..3 {
            let (i, j) = (corners[k], corners[(k + 1) % 3]);
            entries.extend([(i, j, 0.5), (j, i, 0.5)]);
        }
    }
    for (h, chain) in
        loops.iter().enumerate().filter(|&(c, _)| c != outer).map(|(_, c)| c).enumerate()
    {
        let hub = (n + h) as u32;
        entries.extend(chain.vertices.iter().flat_map(|&v| [(v, hub, 1.0), (hub, v, 1.0)]));
    }
    let mut fixed = vec![false; n + hubs];
    let mut uv = vec![DVec2::ZERO; n + hubs];
    let chain = &loops[outer];
    let radius = chain.length() / std::f64::consts::TAU;
    for (&v, &s) in chain.vertices.iter().zip(&chain.arc) {
        let angle = s / radius;
        uv[v as usize] = DVec2::new(cos(angle), sin(angle)) * radius;
        fixed[v as usize] = true;
    }
    let mut right = vec![DVec2::ZERO; n + hubs];
    for &(i, j, w) in &entries {
        let known = if fixed[i as usize] { i } else { j };
        if fixed[known as usize] {
            right[i as usize] += uv[known as usize] * w;
        }
    }
    solve(&laplacian(n + hubs, &entries, &fixed), &right, &mut uv, 1e-7, job);
    uv.truncate(n);
    uv
}

/// A triangle laid flat: edge vectors k -> k + 1 in its own plane, and their cotangent weights.
type Flat = [(DVec2, f64); 3];

fn as_rigid_as_possible(
    surface: &Surface,
    mut uv: Vec<DVec2>,
    steps: usize,
    job: &Job,
) -> Vec<DVec2> {
    let carrier = &surface.carrier;
    let flat: Vec<Flat> = (0..carrier.triangles.len())
        .map(|t| lay_flat(carrier.corners(t as u32), scale(surface, t)))
        .collect();
    let entries = carrier.triangles.iter().zip(&flat).flat_map(|(corners, edges)| {
        (0..3).flat_map(move |k| {
            let (i, j, w) = (corners[k], corners[(k + 1) % 3], edges[k].1);
            [(i, j, w), (j, i, w)]
        })
    });
    let laplacian = laplacian(uv.len(), &entries.collect::<Vec<_>>(), &[]);
    let mut right = vec![DVec2::ZERO; uv.len()];
    for step in 0..steps {
        if job.is_over(FLATTENING) {
            break;
        }
        job.progress("flatten", step as f64 / steps as f64, Picture::None);
        right.fill(DVec2::ZERO);
        for (corners, edges) in carrier.triangles.iter().zip(&flat) {
            let mut sum = DMat2::ZERO;
            for k in 0..3 {
                let d = uv[corners[(k + 1) % 3] as usize] - uv[corners[k] as usize];
                let (e, w) = edges[k];
                sum += DMat2::from_cols(d * e.x, d * e.y) * w;
            }
            // The rotation nearest to the sum of d e^T.
            let turn = DVec2::new(sum.x_axis.x + sum.y_axis.y, sum.x_axis.y - sum.y_axis.x)
                .normalize_or(DVec2::X);
            for k in 0..3 {
                let (e, w) = edges[k];
                let f = turn.rotate(e) * w;
                right[corners[(k + 1) % 3] as usize] += f;
                right[corners[k] as usize] -= f;
            }
        }
        if solve(&laplacian, &right, &mut uv, ACCURACY, job) < SETTLED {
            break;
        }
    }
    // Where the whole is, a Laplacian leaves to rounding: a hundredth of a millimetre in a hall.
    let middle = uv.iter().sum::<DVec2>() / uv.len().max(1) as f64;
    for uv in &mut uv {
        *uv -= middle;
    }
    uv
}

fn lay_flat(p: [DVec3; 3], scale: f64) -> Flat {
    let x = (p[1] - p[0]).normalize_or_zero();
    let y = (p[1] - p[0]).cross(p[2] - p[0]).normalize_or_zero().cross(x);
    [0, 1, 2].map(|k| {
        let (a, b, c) = (p[k], p[(k + 1) % 3], p[(k + 2) % 3]);
        let cot = (a - c).dot(b - c) / (a - c).cross(b - c).length().max(f64::MIN_POSITIVE);
        let w = (0.5 * cot).clamp(LEAST_WEIGHT, 1.0 / LEAST_WEIGHT);
        (DVec2::new((b - a).dot(x), (b - a).dot(y)) / scale, w)
    })
}

/// The Laplacian of a weighted graph, given by (i, j, weight) both ways round; rows of `fixed` vertices stand
/// for themselves.
fn laplacian(n: usize, entries: &[(u32, u32, f64)], fixed: &[bool]) -> Multigrid {
    let is_fixed = |v: u32| fixed.get(v as usize).is_some_and(|&f| f);
    let mut starts = vec![0; n + 1];
    for &(i, ..) in entries {
        starts[i as usize + 1] += 1;
    }
    for i in 0..n {
        starts[i + 1] += starts[i];
    }
    let mut order = vec![0; entries.len()];
    let mut next = starts.clone();
    for (e, &(i, ..)) in entries.iter().enumerate() {
        order[next[i as usize]] = e;
        next[i as usize] += 1;
    }
    let mut matrix = Sparse::new();
    let mut row = Row::new(n);
    for i in 0..n {
        row.add(&mut matrix, i as u32, 0.0);
        for &e in &order[starts[i]..starts[i + 1]] {
            let (_, j, w) = entries[e];
            row.add(&mut matrix, i as u32, w);
            if !is_fixed(i as u32) && !is_fixed(j) {
                row.add(&mut matrix, j, -w);
            }
        }
        matrix.end_row();
    }
    Multigrid::new(matrix)
}

/// Improve `x` on L x = right until the residual has fallen to `accuracy` of its first norm; gives that first
/// norm over the norm of the right side.
fn solve(laplacian: &Multigrid, right: &[DVec2], x: &mut [DVec2], accuracy: f64, job: &Job) -> f64 {
    let mut residual = vec![DVec2::ZERO; x.len()];
    laplacian.apply(x, &mut residual);
    for (r, b) in residual.iter_mut().zip(right) {
        *r = *b - *r;
    }
    let share =
        (product(&residual, &residual) / product(right, right).max(f64::MIN_POSITIVE)).sqrt();
    let apply = |v: &[DVec2], y: &mut [DVec2]| laplacian.apply(v, y);
    let cycle = |v: &[DVec2], y: &mut [DVec2]| laplacian.cycle(v, y);
    let enough = |first: f64| first * accuracy * accuracy;
    let go_on = || !job.is_over(FLATTENING);
    conjugate_gradients(x, residual, apply, cycle, enough, SOLVER_STEPS, go_on);
    share
}
