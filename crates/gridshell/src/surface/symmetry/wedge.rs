//! The part of a surface between two vertical planes, as a surface of its own.
//!
//! The carrier is cut along the planes and what lies outside is left out. A place on a cut is the foot of a
//! straight line in the plane: where the plane mirrors the surface, that is the exact section.

use super::holds;
use super::motion::Motion;
use crate::error::{Error, Result};
use crate::job::Job;
use crate::surface::carrier::NONE;
use crate::surface::carrier::chain::boundary_loops;
use crate::surface::carrier::locate::nearest_in_triangle;
use crate::surface::carrier::track::{Track, Tracks};
use crate::surface::features::cut::{Cutter, SAME, Spot};
use crate::surface::{Carrier, Chain, Curve, Shape, Surface};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;
use std::sync::Arc;

/// What a stop in here is told as.
const PHASE: &str = "cutting at planes of symmetry";
/// A vertex this near to a plane, over its shortest edge, is moved onto it where it may.
const NEAR: f64 = 0.3;
/// Steps of bisection along a curve.
const BISECTIONS: usize = 60;
/// Steps of Newton's method to a section.
const NEWTON_STEPS: usize = 20;
/// Pairs of nodes may take carrier vertices this far, over l0, from where they are wanted.
const PAIR_SLACK: f64 = 0.02;

/// A vertical wedge from the first ray counter-clockwise to the second, at most half a turn.
#[derive(Clone, Copy, Debug)]
pub struct Wedge {
    /// A point on the axis, in plan.
    pub centre: DVec2,
    /// Directions of the rays in plan, of unit length.
    pub rays: [DVec2; 2],
    /// The turn that takes the first cut to the second, where grids are to fit together so.
    pub turn: Option<Motion>,
}

/// The part of a surface in a wedge.
pub struct Part {
    /// The part.
    pub surface: Surface,
    /// Whether each vertex of its carrier lies on the first and on the second cut. The cut at a single mirror
    /// plane counts as the first.
    pub on: Vec<[bool; 2]>,
}

/// A carrier being cut along planes.
struct Section<'a> {
    cutter: Cutter<'a>,
    wedge: Wedge,
    /// Unit normals of the planes, into the wedge.
    normals: Vec<DVec2>,
    /// Whether each vertex lies on each plane.
    on: Vec<[bool; 2]>,
    /// Vertices that are to be nodes.
    nodes: Vec<u32>,
    tolerance: f64,
}

impl Wedge {
    /// Whether it is a half space.
    fn is_straight(&self) -> bool {
        self.rays[0].dot(self.rays[1]) < -1.0 + 1e-9
    }
}

impl Surface {
    /// The part in a wedge, which is one of `shares` alike, for members of `length` metres.
    ///
    /// # Errors
    /// [`Error::Surface`] where nothing lies in the wedge.
    pub fn part(
        mut self,
        wedge: &Wedge,
        shares: usize,
        length: f64,
        corner_angle: f64,
        job: &Job,
    ) -> Result<Part> {
        let [a, b] = wedge.rays.map(DVec2::perp);
        let normals = if wedge.is_straight() { vec![a] } else { vec![a, -b] };
        let tolerance = SAME * length;
        let on = vec![[false; 2]; self.carrier.points.len()];
        let cutter = Cutter::new(&mut self, length);
        let (wedge, nodes) = (*wedge, Vec::new());
        let mut section = Section { cutter, wedge, normals, on, nodes, tolerance };
        job.check(PHASE)?;
        section.put_axis();
        for plane in 0..section.normals.len() {
            section.snap(plane);
            section.split(plane);
            job.check(PHASE)?;
        }
        if let Some(turn) = wedge.turn {
            section.tell_rays_apart();
            section.pair(&turn, length);
        }
        let Section { cutter, normals, on, nodes, .. } = section;
        cutter.finish();
        let inside = |v: u32, plane: usize| {
            let off = normals[plane].dot(self.carrier.points[v as usize].truncate() - wedge.centre);
            if normals.len() > 1 && on[v as usize][plane] { 0.0 } else { off }
        };
        let kept: Vec<u32> = (0..self.carrier.triangles.len() as u32)
            .filter(|&t| {
                let corners = self.carrier.triangles[t as usize];
                (0..normals.len())
                    .all(|plane| corners.iter().map(|&v| inside(v, plane)).sum::<f64>() > 0.0)
            })
            .collect();
        if kept.is_empty() {
            return Err(Error::Surface(
                "nothing of the surface lies between the planes of symmetry".into(),
            ));
        }
        Ok(self.extract(&kept, &on, &nodes, shares, corner_angle))
    }

    /// The part made of these triangles.
    fn extract(
        mut self,
        kept: &[u32],
        on: &[[bool; 2]],
        nodes: &[u32],
        shares: usize,
        corner_angle: f64,
    ) -> Part {
        let whole = std::mem::take(&mut self.carrier);
        let mut number = vec![NONE; whole.points.len()];
        let mut vertices = Vec::new();
        for &v in kept.iter().flat_map(|&t| &whole.triangles[t as usize]) {
            if number[v as usize] == NONE {
                number[v as usize] = vertices.len() as u32;
                vertices.push(v);
            }
        }
        let pick = |t: &u32| whole.triangles[*t as usize].map(|v| number[v as usize]);
        let uv = kept.iter().filter_map(|&t| whole.uv.get(t as usize).copied()).collect();
        let mut carrier = Carrier::new(
            vertices.iter().map(|&v| whole.points[v as usize]).collect(),
            kept.iter().map(pick).collect(),
            kept.iter().map(|&t| whole.patch[t as usize]).collect(),
            uv,
        );
        let on: Vec<[bool; 2]> = vertices.iter().map(|&v| on[v as usize]).collect();
        for (v, &old) in vertices.iter().enumerate() {
            // At a cut the surface goes on: its normal there is that of both sides.
            if on[v].contains(&true) {
                carrier.normals[v] = whole.normals[old as usize];
            }
        }
        let mut tracks = Tracks::new();
        for ((a, b), track) in self.tracks.iter() {
            let ends = [a, b].map(|v| number.get(v as usize).copied().unwrap_or(NONE));
            if !ends.contains(&NONE) {
                tracks.lay(ends[0], ends[1], track);
            }
        }
        self.lay_cuts(&carrier, &on, &mut tracks);
        let mut loops = boundary_loops(&carrier, PI, |a, b| tracks.curve_of(a, b));
        for chain in &mut loops {
            chain.find_corners(&carrier, &self.curves, corner_angle);
            let is_node = |v: u32| nodes.iter().any(|&n| number[n as usize] == v);
            force_corners(chain, &carrier, &on, is_node);
        }
        let surface = Surface {
            carrier,
            loops,
            tracks,
            area: self.area / shares as f64,
            features: Vec::new(),
            fixed: Vec::new(),
            scale: Vec::new(),
            direction: Vec::new(),
            ..self
        };
        Part { surface, on }
    }

    /// Lay the exact sections behind the edges on cuts.
    fn lay_cuts(&mut self, carrier: &Carrier, on: &[[bool; 2]], tracks: &mut Tracks) {
        if self.shapes.is_empty() {
            return;
        }
        let shapes: Vec<Arc<Shape>> = self.shapes.iter().cloned().map(Arc::new).collect();
        for (t, corners) in carrier.triangles.iter().enumerate() {
            for k in 0..3 {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                let cut = carrier.neighbors[t][k] == NONE && label(on, a, b).is_some();
                if !cut || tracks.get(a, b).is_some() {
                    continue;
                }
                let curve = Curve::Guide {
                    shape: Arc::clone(&shapes[carrier.patch[t] as usize]),
                    line: [a, b].map(|v| carrier.points[v as usize]),
                    near: [k, (k + 1) % 3].map(|k| carrier.uv[t][k]),
                };
                tracks.lay(a, b, Track::of_curve(self.curves.len() as u32, [0.0, 1.0]));
                self.curves.push(curve);
            }
        }
    }
}

/// The cut that the edge from `a` to `b` lies on.
fn label(on: &[[bool; 2]], a: u32, b: u32) -> Option<usize> {
    (0..2).find(|&i| on[a as usize][i] && on[b as usize][i])
}

/// Corners where a cut begins or ends, and at the nodes asked for.
fn force_corners(
    chain: &mut Chain,
    carrier: &Carrier,
    on: &[[bool; 2]],
    is_node: impl Fn(u32) -> bool,
) {
    let n = chain.vertices.len();
    let of = |k: usize| label(on, chain.vertices[k % n], chain.vertices[(k + 1) % n]);
    let forced = (0..n).filter(|&k| of(k + n - 1) != of(k) || is_node(chain.vertices[k]));
    let forced: Vec<u32> = forced.map(|k| k as u32).collect();
    chain.corners.extend(forced);
    chain.corners.sort_unstable();
    chain.corners.dedup();
    let Some(&first) = chain.corners.first() else { return };
    chain.vertices.rotate_left(first as usize);
    chain.segments.rotate_left(first as usize);
    for c in &mut chain.corners {
        *c -= first;
    }
    chain.measure(carrier);
}

impl Section<'_> {
    fn carrier(&self) -> &Carrier {
        &self.cutter.surface.carrier
    }

    /// Distance in front of a plane; 0 on it.
    fn off(&self, plane: usize, v: u32) -> f64 {
        if self.on.get(v as usize).is_some_and(|on| on[plane]) {
            return 0.0;
        }
        self.off_point(plane, self.cutter.xyz(v))
    }

    fn off_point(&self, plane: usize, p: DVec3) -> f64 {
        self.normals[plane].dot(p.truncate() - self.wedge.centre)
    }

    /// Put a vertex on all planes wherever the axis meets the surface.
    fn put_axis(&mut self) {
        let centre = self.wedge.centre;
        let needed = self.normals.len() > 1 || self.wedge.turn.is_some();
        let mut found: Vec<DVec3> = Vec::new();
        for t in 0..self.carrier().triangles.len() as u32 {
            let corners = self.carrier().corners(t);
            let Some(bary) = holds(corners, centre).filter(|_| needed) else { continue };
            let near = corners[0] * bary[0] + corners[1] * bary[1] + corners[2] * bary[2];
            let mut p = near;
            // The foot of a point on the axis leads back to the axis quickly: the axis crosses the surface.
            for _ in 0..NEWTON_STEPS {
                p = centre.extend(self.cutter.spot(t, bary, p).xyz.z);
            }
            if found.iter().all(|q| q.distance(p) > 100.0 * self.tolerance) {
                found.push(p);
            }
        }
        for p in found {
            let v = self.cutter.put(p);
            self.on.resize(self.carrier().points.len(), [false; 2]);
            self.on[v as usize] = [true; 2];
        }
    }

    /// Find the vertices on a plane and move those that nearly are onto it.
    fn snap(&mut self, plane: usize) {
        self.on.resize(self.carrier().points.len(), [false; 2]);
        for v in 0..self.on.len() as u32 {
            let off = self.off(plane, v);
            let on = off.abs() <= self.tolerance
                || !self.cutter.is_tied(v)
                    && self
                        .spot_on(plane, v, off)
                        .is_some_and(|spot| self.cutter.move_vertex(v, &spot));
            if on {
                self.on[v as usize][plane] = true;
                self.cutter.tie(v);
            }
        }
    }

    /// Where on the plane a vertex near it might be.
    fn spot_on(&self, plane: usize, v: u32, off: f64) -> Option<Spot> {
        let carrier = self.carrier();
        let x = self.cutter.xyz(v);
        let fan = self.cutter.fan(v);
        let edge = |&(t, k): &(u32, usize)| carrier.corners(t)[(k + 1) % 3].distance(x);
        let shortest = fan.iter().map(edge).fold(f64::MAX, f64::min);
        if off.abs() > NEAR * shortest {
            return None;
        }
        let (n, normal) = (self.normals[plane].extend(0.0), carrier.normals[v as usize]);
        let slope = n - normal * n.dot(normal);
        if slope.length_squared() < 0.1 {
            return None;
        }
        let p = x - slope * (off / slope.length_squared());
        let nearest = fan.iter().map(|&(t, _)| {
            let c = carrier.corners(t);
            let b = nearest_in_triangle(c, p);
            ((c[0] * b[0] + c[1] * b[1] + c[2] * b[2]).distance(p), t, b)
        });
        let (_, t, b) = nearest.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(self.section(plane, self.cutter.spot(t, b, p)))
    }

    /// The spot moved along the surface onto a plane.
    fn section(&self, plane: usize, mut spot: Spot) -> Spot {
        let Some(shape) = self.cutter.shape(spot.triangle) else { return spot };
        let n = self.normals[plane].extend(0.0);
        let start = spot;
        for _ in 0..NEWTON_STEPS {
            let jet = shape.jet(spot.uv);
            spot.xyz = jet.point;
            // Towards the plane, and not along it.
            let e = n.cross(jet.normal());
            let (r, s) = (-self.off_point(plane, jet.point), (start.xyz - jet.point).dot(e));
            let (a, b, c, d) = (jet.du.dot(n), jet.dv.dot(n), jet.du.dot(e), jet.dv.dot(e));
            let step = DVec2::new(r * d - s * b, a * s - c * r) / (a * d - b * c);
            if !step.is_finite() {
                return start;
            }
            if (jet.du * step.x).length() + (jet.dv * step.y).length()
                < 1e-13 * self.tolerance.max(1.0)
            {
                break;
            }
            spot.uv = shape.clamp(spot.uv + step);
        }
        let moved = spot.xyz.distance(start.xyz);
        if moved < 1e3 * self.tolerance || moved < 2.0 * self.off_point(plane, start.xyz).abs() {
            spot
        } else {
            start
        }
    }

    /// Split the edges that a plane crosses.
    fn split(&mut self, plane: usize) {
        let mut t = 0;
        while (t as usize) < self.carrier().triangles.len() {
            let corners = self.carrier().triangles[t as usize];
            let crossed = (0..3).find(|&k| {
                self.off(plane, corners[k]) * self.off(plane, corners[(k + 1) % 3]) < 0.0
            });
            match crossed {
                Some(k) => self.split_edge(plane, t, k),
                None => t += 1,
            }
        }
    }

    fn split_edge(&mut self, plane: usize, t: u32, k: usize) {
        let corners = self.carrier().triangles[t as usize];
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        let [x, y] = [a, b].map(|v| self.off(plane, v));
        let mut share = x / (x - y);
        let mut bary = [0.0; 3];
        bary[k] = 1.0 - share;
        bary[(k + 1) % 3] = share;
        let xyz = if let Some((curve, t0, t1)) = self.cutter.surface.tracks.curve_of(a, b) {
            let curve = &self.cutter.surface.curves[curve as usize];
            let (mut low, mut high) = (0.0, 1.0);
            for _ in 0..BISECTIONS {
                let middle = 0.5 * (low + high);
                let off = self.off_point(plane, curve.point(t0 + (t1 - t0) * middle));
                if off * x > 0.0 { low = middle } else { high = middle }
            }
            share = 0.5 * (low + high);
            curve.point(t0 + (t1 - t0) * share)
        } else {
            let p = self.cutter.xyz(a).lerp(self.cutter.xyz(b), share);
            self.section(plane, self.cutter.spot(t, bary, p)).xyz
        };
        let both = (0..2).map(|i| self.on[a as usize][i] && self.on[b as usize][i]);
        let mut on: [bool; 2] = [false; 2];
        for (on, both) in on.iter_mut().zip(both) {
            *on = both;
        }
        on[plane] = true;
        self.cutter.split_edge(t, k, share, xyz);
        self.on.push(on);
    }

    /// Of a straight wedge: the first cut is on the first ray, the second on the other.
    fn tell_rays_apart(&mut self) {
        if self.normals.len() > 1 {
            return;
        }
        for v in 0..self.on.len() {
            if self.on[v] == [true, false] {
                let along = self.cutter.xyz(v as u32).truncate() - self.wedge.centre;
                let first = along.dot(self.wedge.rays[0]) > 0.0;
                self.on[v] = [first, !first];
            }
        }
    }

    /// The edges on a ray: vertices, the first one nearer to the axis.
    fn edges_on(&self, ray: usize) -> Vec<(u32, u32)> {
        let mut edges = Vec::new();
        let kept = |v: u32| (0..self.normals.len()).all(|i| self.off(i, v) >= -self.tolerance);
        for corners in &self.carrier().triangles {
            for k in 0..3 {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                let on = [a, b].iter().all(|&v| self.on[v as usize][ray] && kept(v));
                if on {
                    edges.push((a.min(b), a.max(b)));
                }
            }
        }
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// Put vertices on both cuts that are images of one another, a member apart: nodes stand there.
    fn pair(&mut self, turn: &Motion, length: f64) {
        let wanted: Vec<DVec3> =
            self.stretches().iter().flat_map(|s| self.steps(s, length)).collect();
        for p in wanted {
            let v = self.vertex_on(0, p, PAIR_SLACK * length);
            let image = turn.image(self.cutter.xyz(v));
            let w = self.vertex_on(1, image, 100.0 * self.tolerance);
            self.nodes.extend([v, w]);
        }
    }

    /// The first cut as polylines.
    fn stretches(&self) -> Vec<Vec<u32>> {
        let mut edges = self.edges_on(0);
        let ends =
            |edges: &[(u32, u32)], v: u32| edges.iter().filter(|e| e.0 == v || e.1 == v).count();
        let mut stretches = Vec::new();
        while !edges.is_empty() {
            let alone = edges.iter().flat_map(|e| [e.0, e.1]).find(|&v| ends(&edges, v) == 1);
            let mut line = vec![alone.unwrap_or(edges[0].0)];
            while let Some(i) = edges.iter().position(|e| {
                let last = line[line.len() - 1];
                e.0 == last || e.1 == last
            }) {
                let (a, b) = edges.remove(i);
                let last = line[line.len() - 1];
                line.push(if a == last { b } else { a });
                if self.on[line[line.len() - 1] as usize] == [true; 2] {
                    break;
                }
            }
            stretches.push(line);
        }
        stretches
    }

    /// Places about `length` metres apart along a polyline, its ends left out.
    fn steps(&self, line: &[u32], length: f64) -> Vec<DVec3> {
        let points: Vec<DVec3> = line.iter().map(|&v| self.cutter.xyz(v)).collect();
        let whole: f64 = points.windows(2).map(|w| w[0].distance(w[1])).sum();
        let count = (whole / length).round().max(1.0);
        let step = whole / count;
        let (mut places, mut next, mut gone) = (Vec::new(), step, 0.0);
        for w in points.windows(2) {
            let edge = w[0].distance(w[1]);
            while next <= gone + edge && places.len() + 1 < count as usize {
                places.push(w[0].lerp(w[1], (next - gone) / edge));
                next += step;
            }
            gone += edge;
        }
        places
    }

    /// The vertex on a ray nearest to `p`, made where there is none within `slack` metres.
    fn vertex_on(&mut self, ray: usize, p: DVec3, slack: f64) -> u32 {
        let edges = self.edges_on(ray);
        let nearest = edges.iter().map(|&(a, b)| {
            let (x, y) = (self.cutter.xyz(a), self.cutter.xyz(b));
            let d = y - x;
            let f = ((p - x).dot(d) / d.length_squared()).clamp(0.0, 1.0);
            ((x + d * f).distance(p), a, b, f)
        });
        let (_, a, b, f) = nearest.min_by(|x, y| x.0.total_cmp(&y.0)).expect("a cut has edges");
        for v in [a, b] {
            if self.cutter.xyz(v).distance(p) <= slack {
                return v;
            }
        }
        let (t, k) = self
            .cutter
            .fan(a)
            .into_iter()
            .flat_map(|(t, k)| [(t, k, false), (t, (k + 2) % 3, true)])
            .find_map(|(t, k, back)| {
                let c = self.carrier().triangles[t as usize];
                let other = if back { c[k] } else { c[(k + 1) % 3] };
                (other == b).then_some((t, k))
            })
            .expect("the edge is one of the fan's");
        let first = self.carrier().triangles[t as usize][k] == a;
        let share = if first { f } else { 1.0 - f };
        let mut bary = [0.0; 3];
        bary[k] = 1.0 - share;
        bary[(k + 1) % 3] = share;
        let xyz = self.cutter.spot(t, bary, p).xyz;
        let v = self.cutter.split_edge(t, k, share, xyz);
        let on = (0..2).map(|i| self.on[a as usize][i] && self.on[b as usize][i]);
        let mut both = [false; 2];
        for (both, on) in both.iter_mut().zip(on) {
            *both = on;
        }
        self.on.push(both);
        v
    }
}
