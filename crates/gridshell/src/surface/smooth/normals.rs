//! Normals of the smooth surface at the vertices of the mesh.
//!
//! Inside, that of the paraboloid through the vertex that comes nearest to the vertices around it (Goldfeather and
//! Interrante 2004). On boundary and creases all that is known lies to one side; there the surface bends along each
//! edge to a neighbour as much as it does at that neighbour, whose normal is known.
//!
//! Each side of a line has a normal of its own. Where a line runs on smoothly, the normal is perpendicular to it.

use super::lines::Lines;
use super::net::Net;
use super::patch::square_to;
use crate::math::least::least_squares;
use crate::math::trig;
use crate::surface::carrier::NONE;
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};

/// Fewer vertices than this around one say too little of how the surface bends: the next ring is asked too.
const ENOUGH: usize = 6;
/// Rounds of fitting, each in the axes that the last one found.
const ROUNDS: usize = 3;
/// How much is held back that the vertices around say little of, as a share of what they say in all.
const REIN: f64 = 1e-5;

/// Normals at the corners of all triangles. Vertices inside that are no more than `near` metres apart share theirs: else
/// the needles between them would turn over.
pub(super) fn normals(net: &Net, lines: &Lines, near: f64) -> Vec<[DVec3; 3]> {
    let (inside, border): (Vec<Sector>, _) =
        sectors(net, lines).into_iter().partition(|s| s.closed);
    let (within, ends): (Vec<Sector>, _) =
        border.into_iter().partition(|s| lines.tangent(s.vertex).is_some());
    let mut known = vec![[DVec3::ZERO; 3]; net.triangles.len()];
    for sectors in [inside, within, ends] {
        let mut found: Vec<DVec3> = sectors.iter().map(|s| s.normal(net, lines, &known)).collect();
        share(net, &sectors, near, &mut found);
        for (sector, normal) in sectors.iter().zip(found) {
            sector.corners.iter().for_each(|&(t, k)| known[t as usize][k] = normal);
        }
    }
    known
}

/// Give each closed sector the normal of the first one whose vertex is no more than `near` metres from its own.
fn share(net: &Net, sectors: &[Sector], near: f64, normals: &mut [DVec3]) {
    let number: BTreeMap<u32, usize> =
        sectors.iter().enumerate().filter(|(_, s)| s.closed).map(|(i, s)| (s.vertex, i)).collect();
    let own = normals.to_vec();
    for &i in number.values() {
        let here = net.points[sectors[i].vertex as usize];
        let around = sectors[i].corners.iter().flat_map(|&(t, _)| net.triangles[t as usize]);
        let close = around.filter(|&v| net.points[v as usize].distance(here) <= near);
        if let Some(&first) = close.min().and_then(|v| number.get(&v)) {
            normals[i] = own[first];
        }
    }
}

/// The triangles around a vertex, or those between two lines that meet there.
struct Sector {
    vertex: u32,
    /// Each triangle with which of its corners the vertex is, counter-clockwise.
    corners: Vec<(u32, usize)>,
    /// Whether it goes all round.
    closed: bool,
}

/// All sectors of all vertices.
fn sectors(net: &Net, lines: &Lines) -> Vec<Sector> {
    let mut seen = vec![[false; 3]; net.triangles.len()];
    let mut sectors = Vec::with_capacity(net.points.len());
    for t in 0..net.triangles.len() {
        for k in 0..3 {
            if !seen[t][k] {
                let sector = Sector::around(net, lines, (t as u32, k));
                sector.corners.iter().for_each(|&(t, k)| seen[t as usize][k] = true);
                sectors.push(sector);
            }
        }
    }
    sectors
}

impl Sector {
    fn around(net: &Net, lines: &Lines, start: (u32, usize)) -> Sector {
        let vertex = net.triangles[start.0 as usize][start.1];
        let across = |t: u32, k: usize| {
            let u = net.neighbors[t as usize][k];
            let at = |u: u32| net.triangles[u as usize].iter().position(|&v| v == vertex);
            (u != NONE && !lines.edges[t as usize][k]).then(|| at(u).map(|k| (u, k))).flatten()
        };
        let left = |(t, k): (u32, usize)| across(t, (k + 2) % 3);
        let right = |(t, k): (u32, usize)| across(t, k);
        let mut first = start;
        while let Some(next) = right(first).filter(|&n| n != start) {
            first = next;
        }
        let closed = right(first).is_some();
        let mut corners = vec![first];
        let mut at = first;
        while let Some(next) = left(at).filter(|&n| n != first) {
            corners.push(next);
            at = next;
        }
        Sector { vertex, corners, closed }
    }

    /// The normal at its vertex; normals elsewhere are zero where they are not `known`.
    fn normal(&self, net: &Net, lines: &Lines, known: &[[DVec3; 3]]) -> DVec3 {
        let around = Around::of(self, net, lines);
        let here = net.points[self.vertex as usize];
        let tangent = lines.tangent(self.vertex).filter(|_| !self.closed);
        let square = |n: DVec3| tangent.map_or(n, |t| square_to(t, n));
        let first = square(self.mean(net));
        let offsets: Vec<DVec3> =
            around.vertices.iter().map(|&v| net.points[v as usize] - here).collect();
        let bends = self.bends(net, known);
        let mut normal = first;
        for _ in 0..ROUNDS {
            normal = square(fit(&offsets, normal, tangent));
        }
        for _ in 0..ROUNDS {
            normal = square(bend_alike(&bends, normal, tangent));
        }
        // No further off than the faces around are: what leaves that cone follows noise.
        let off = around.triangles.iter().map(|&t| trig::angle(first, net.normal(t)));
        within(first, normal, off.fold(0.0, f64::max))
    }

    /// Mean normal of the faces, exact for a closed fan on a sphere (Max 1999).
    fn mean(&self, net: &Net) -> DVec3 {
        let weighed = self.corners.iter().map(|&(t, k)| {
            let p = net.corners(t);
            let (a, b) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            let weight = (a.length_squared() * b.length_squared()).max(f64::MIN_POSITIVE);
            net.normal(t) * (a.cross(b).length() / weight)
        });
        let sum: DVec3 = weighed.sum();
        sum.try_normalize().unwrap_or_else(|| net.normal(self.corners[0].0))
    }

    /// The neighbours on this side whose normals are known: from here to there, and the normal. None inside, where the
    /// points all round say more.
    fn bends(&self, net: &Net, known: &[[DVec3; 3]]) -> Vec<(DVec3, DVec3)> {
        let mut seen = BTreeSet::new();
        let beside = self.corners.iter().flat_map(|&(t, k)| [(t, (k + 1) % 3), (t, (k + 2) % 3)]);
        let beside = beside.filter(|_| !self.closed).filter(|&(t, k)| {
            known[t as usize][k] != DVec3::ZERO && seen.insert(net.triangles[t as usize][k])
        });
        let here = net.points[self.vertex as usize];
        beside.map(|(t, k)| (net.corners(t)[k] - here, known[t as usize][k])).collect()
    }
}

/// What lies around a vertex, up to the lines: a ring of vertices, or two where one says too little.
struct Around {
    triangles: Vec<u32>,
    vertices: Vec<u32>,
}

impl Around {
    fn of(sector: &Sector, net: &Net, lines: &Lines) -> Around {
        let triangles = sector.corners.iter().map(|c| c.0).collect();
        let mut around = Around { triangles, vertices: Vec::new() };
        around.gather(sector.vertex, net);
        if !sector.closed || around.vertices.len() < ENOUGH {
            around.widen(net, lines);
            around.gather(sector.vertex, net);
        }
        around
    }

    /// All vertices of the faces, but the one in the middle.
    fn gather(&mut self, middle: u32, net: &Net) {
        let all = self.triangles.iter().flat_map(|&t| net.outline(t));
        self.vertices = all.copied().filter(|&v| v != middle).collect();
        self.vertices.sort_unstable();
        self.vertices.dedup();
    }

    /// Add the triangles that touch a vertex of these, reached without crossing a line.
    fn widen(&mut self, net: &Net, lines: &Lines) {
        let mut found: BTreeSet<u32> = self.triangles.iter().copied().collect();
        let mut k = 0;
        while k < self.triangles.len() {
            let t = self.triangles[k] as usize;
            for e in (0..3).filter(|&e| !lines.edges[t][e]) {
                let u = net.neighbors[t][e];
                let touches = |v: &u32| self.vertices.binary_search(v).is_ok();
                if u != NONE && net.triangles[u as usize].iter().any(touches) && found.insert(u) {
                    self.triangles.push(u);
                }
            }
            k += 1;
        }
    }
}

/// Normal at the origin of the paraboloid through it that comes nearest to these points; near points count more.
/// `normal` is where its axis is sought; a line with this tangent lies on it.
fn fit(points: &[DVec3], normal: DVec3, tangent: Option<DVec3>) -> DVec3 {
    let (x, y) = axes(normal, tangent);
    let size = points.iter().map(|p| p.length()).sum::<f64>() / points.len().max(1) as f64;
    let rows = points.iter().map(|p| p / size).filter(|p| p.length() > 0.0).map(|p| {
        let (u, v, far) = (p.dot(x), p.dot(y), p.length());
        // The slope along a tangent is none.
        let slope = if tangent.is_some() { 0.0 } else { u };
        ([slope, v, u * u, u * v, v * v].map(|c| c / far), p.dot(normal) / far)
    });
    let [u, v, ..] = least_squares(rows, [0.0, 0.0, REIN, REIN, REIN]);
    (normal - x * u - y * v).normalize_or(normal)
}

/// The normal near `normal` that leans from the chord to each neighbour as much as the normal there does to the other
/// side, as on a circle; near neighbours count more.
fn bend_alike(bends: &[(DVec3, DVec3)], normal: DVec3, tangent: Option<DVec3>) -> DVec3 {
    let (x, y) = axes(normal, tangent);
    let least = bends.iter().map(|b| b.0.length()).fold(f64::INFINITY, f64::min);
    let rows = bends.iter().map(|(chord, there)| {
        let weight = (least / chord.length()).sqrt();
        let along = chord.normalize_or_zero() * weight;
        let lean = if tangent.is_some() { 0.0 } else { x.dot(along) };
        ([lean, y.dot(along)], -(there.dot(along) + normal.dot(along)))
    });
    let [u, v] = least_squares(rows, [REIN, REIN]);
    (normal + x * u + y * v).normalize_or(normal)
}

/// Axes perpendicular to the normal, the first along the tangent where there is one.
fn axes(normal: DVec3, tangent: Option<DVec3>) -> (DVec3, DVec3) {
    let x = tangent.unwrap_or_else(|| normal.any_orthonormal_vector());
    (x, normal.cross(x))
}

/// The unit vector towards `wanted`, no further from `middle` than `angle`.
fn within(middle: DVec3, wanted: DVec3, angle: f64) -> DVec3 {
    if trig::angle(middle, wanted) <= angle {
        return wanted;
    }
    middle * trig::cos(angle) + square_to(middle, wanted) * trig::sin(angle)
}
