//! A flattening of the carrier with little distortion, on which a lattice can be laid.
//!
//! The start is a discrete exponential map: vertices are laid out in order of their distance from the
//! innermost one, each where the triangles already laid say on average. Then local/global steps make every
//! triangle as rigid as possible with a free boundary (Liu et al., *A local/global approach to mesh
//! parameterization*, 2008). Only for one connected piece of genus 0 with a boundary; a chart may still
//! overlap itself (a spiral does), which a lattice does not mind.

use super::{Carrier, carrier::NONE};
use glam::{DMat2, DVec2};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Local/global steps: the distortion hardly falls after these.
const STEPS: usize = 16;
/// Conjugate-gradient steps in each, from where the last one ended.
const SOLVER_STEPS: usize = 80;
/// Smallest cotangent weight; obtuse pairs would make the system indefinite.
const LEAST_WEIGHT: f64 = 0.02;

/// Plane coordinates of every carrier vertex, metres.
#[derive(Clone, Debug)]
pub struct Chart {
    /// Indexed as `Carrier::points`.
    pub uv: Vec<DVec2>,
}

impl Chart {
    /// Flatten a carrier; None where that makes no sense: closed, not connected, or with handles.
    pub fn flatten(carrier: &Carrier, euler_characteristic: i64, loops: usize) -> Option<Chart> {
        // Genus from chi = 2 - 2g - b; a carrier in pieces fails here or leaves vertices unplaced.
        if loops == 0 || euler_characteristic != 2 - loops as i64 {
            return None;
        }
        let uv = exponential_map(carrier)?;
        Some(Chart { uv: as_rigid_as_possible(carrier, uv) })
    }

    /// Corners of carrier triangle `t` in the plane.
    pub fn corners(&self, carrier: &Carrier, t: usize) -> [DVec2; 3] {
        carrier.triangles[t].map(|v| self.uv[v as usize])
    }
}

/// A distance that orders in a heap.
#[derive(PartialEq, PartialOrd)]
struct Distance(f64);
impl Eq for Distance {}
impl Ord for Distance {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

/// Lengths of shortest paths along carrier edges from these vertices.
fn distances(carrier: &Carrier, around: &[Vec<u32>], from: &[u32]) -> Vec<f64> {
    let mut distance = vec![f64::INFINITY; carrier.points.len()];
    let mut heap = BinaryHeap::new();
    for &v in from {
        distance[v as usize] = 0.0;
        heap.push(Reverse((Distance(0.0), v)));
    }
    while let Some(Reverse((Distance(d), v))) = heap.pop() {
        if d > distance[v as usize] {
            continue;
        }
        for &t in &around[v as usize] {
            for w in carrier.triangles[t as usize] {
                let onward = d + carrier.points[v as usize].distance(carrier.points[w as usize]);
                if onward < distance[w as usize] {
                    distance[w as usize] = onward;
                    heap.push(Reverse((Distance(onward), w)));
                }
            }
        }
    }
    distance
}

fn exponential_map(carrier: &Carrier) -> Option<Vec<DVec2>> {
    let mut around = vec![Vec::new(); carrier.points.len()];
    for (t, corners) in carrier.triangles.iter().enumerate() {
        for &v in corners {
            around[v as usize].push(t as u32);
        }
    }
    let rim: Vec<u32> = carrier
        .neighbors
        .iter()
        .zip(&carrier.triangles)
        .flat_map(|(n, c)| (0..3).filter(move |&k| n[k] == NONE).map(move |k| c[k]))
        .collect();
    let depth = distances(carrier, &around, &rim);
    let (innermost, _) = depth.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
    let distance = distances(carrier, &around, &[innermost as u32]);

    let mut uv: Vec<Option<DVec2>> = vec![None; carrier.points.len()];
    let first = carrier.triangles[around[innermost][0] as usize];
    let k = first.iter().position(|&v| v as usize == innermost)?;
    let second = first[(k + 1) % 3] as usize;
    uv[innermost] = Some(DVec2::ZERO);
    uv[second] = Some(DVec2::new(carrier.points[innermost].distance(carrier.points[second]), 0.0));
    let mut heap: BinaryHeap<Reverse<(Distance, u32)>> = BinaryHeap::new();
    let mut ready = vec![innermost as u32, second as u32];
    loop {
        for v in ready.drain(..) {
            for &t in &around[v as usize] {
                let corners = carrier.triangles[t as usize];
                let missing: Vec<u32> =
                    corners.into_iter().filter(|&w| uv[w as usize].is_none()).collect();
                if let [w] = missing[..] {
                    heap.push(Reverse((Distance(distance[w as usize]), w)));
                }
            }
        }
        let Some(Reverse((_, v))) = heap.pop() else { break };
        if uv[v as usize].is_some() {
            continue;
        }
        let laid: Vec<DVec2> =
            around[v as usize].iter().filter_map(|&t| apex(carrier, t, v, &uv)).collect();
        uv[v as usize] = Some(laid.iter().sum::<DVec2>() / laid.len() as f64);
        ready.push(v);
    }
    uv.into_iter().collect()
}

/// Where triangle `t` puts its corner `v` in the plane, its other two corners being laid already.
fn apex(carrier: &Carrier, t: u32, v: u32, uv: &[Option<DVec2>]) -> Option<DVec2> {
    let corners = carrier.triangles[t as usize];
    let k = corners.iter().position(|&c| c == v)?;
    let (a, b) = (corners[(k + 1) % 3] as usize, corners[(k + 2) % 3] as usize);
    let (p, q) = (uv[a]?, uv[b]?);
    let edge = carrier.points[b] - carrier.points[a];
    let to = carrier.points[v as usize] - carrier.points[a];
    let x = to.dot(edge) / edge.length_squared();
    let y = edge.cross(to).length() / edge.length_squared();
    let along = q - p;
    Some(p + along * x + along.perp() * y)
}

/// The constant part of the local/global iteration: triangles laid flat, and the Laplacian's rows.
struct Rigid {
    /// Per triangle: edge vectors k -> k + 1 in its own plane, and their cotangent weights.
    edges: Vec<[(DVec2, f64); 3]>,
    rows: Vec<Vec<(u32, f64)>>,
    diagonal: Vec<f64>,
}

fn as_rigid_as_possible(carrier: &Carrier, mut uv: Vec<DVec2>) -> Vec<DVec2> {
    let rigid = Rigid::new(carrier);
    for _ in 0..STEPS {
        let mut right = vec![DVec2::ZERO; uv.len()];
        for (corners, edges) in carrier.triangles.iter().zip(&rigid.edges) {
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
        rigid.solve(&right, &mut uv);
    }
    uv
}

impl Rigid {
    fn new(carrier: &Carrier) -> Rigid {
        let n = carrier.points.len();
        let mut entries: Vec<(u32, u32, f64)> = Vec::with_capacity(carrier.triangles.len() * 6);
        let edges = (0..carrier.triangles.len())
            .map(|t| {
                let corners = carrier.triangles[t];
                let p = carrier.corners(t as u32);
                let x = (p[1] - p[0]).normalize_or_zero();
                let y = (p[1] - p[0]).cross(p[2] - p[0]).normalize_or_zero().cross(x);
                [0, 1, 2].map(|k| {
                    let (a, b, c) = (p[k], p[(k + 1) % 3], p[(k + 2) % 3]);
                    let cot =
                        (a - c).dot(b - c) / (a - c).cross(b - c).length().max(f64::MIN_POSITIVE);
                    let w = (0.5 * cot).clamp(LEAST_WEIGHT, 1.0 / LEAST_WEIGHT);
                    let (i, j) = (corners[k], corners[(k + 1) % 3]);
                    entries.extend([(i, j, w), (j, i, w)]);
                    (DVec2::new((b - a).dot(x), (b - a).dot(y)), w)
                })
            })
            .collect();
        entries.sort_by_key(|e| (e.0, e.1));
        let mut rows: Vec<Vec<(u32, f64)>> = vec![Vec::new(); n];
        let mut diagonal = vec![0.0; n];
        for (i, j, w) in entries {
            diagonal[i as usize] += w;
            match rows[i as usize].last_mut() {
                Some(last) if last.0 == j => last.1 += w,
                _ => rows[i as usize].push((j, w)),
            }
        }
        Rigid { edges, rows, diagonal }
    }

    fn apply(&self, x: &[DVec2]) -> Vec<DVec2> {
        let row = |i: usize| {
            let off: DVec2 = self.rows[i].iter().map(|&(j, w)| x[j as usize] * w).sum();
            x[i] * self.diagonal[i] - off
        };
        (0..x.len()).map(row).collect()
    }

    /// A few steps of conjugate gradients on L x = right, both coordinates at once, from `x`.
    fn solve(&self, right: &[DVec2], x: &mut [DVec2]) {
        let dot = |a: &[DVec2], b: &[DVec2]| a.iter().zip(b).map(|(p, q)| p.dot(*q)).sum::<f64>();
        let ax = self.apply(x);
        let mut r: Vec<DVec2> = right.iter().zip(&ax).map(|(b, a)| *b - *a).collect();
        let scaled = |r: &[DVec2]| -> Vec<DVec2> {
            r.iter().zip(&self.diagonal).map(|(v, d)| *v / *d).collect()
        };
        let mut z = scaled(&r);
        let mut p = z.clone();
        let mut rz = dot(&r, &z);
        let enough = rz * 1e-8;
        for _ in 0..SOLVER_STEPS {
            if rz <= enough || rz == 0.0 {
                break;
            }
            let ap = self.apply(&p);
            let alpha = rz / dot(&p, &ap);
            for i in 0..x.len() {
                x[i] += p[i] * alpha;
                r[i] -= ap[i] * alpha;
            }
            z = scaled(&r);
            let next = dot(&r, &z);
            let beta = next / rz;
            rz = next;
            for i in 0..p.len() {
                p[i] = z[i] + p[i] * beta;
            }
        }
    }
}
