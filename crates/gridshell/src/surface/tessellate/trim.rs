//! Loops of a face brought to the patch's parameters: polygons in (u, v).
//!
//! Each edge's samples are projected one after the other, starting from the middle of the edge, so the
//! path in (u, v) is continuous and runs on past the domain where the patch closes on itself. The paths of
//! a loop are then shifted by whole periods to join. At a pole two paths meet in one point of space but at
//! two different (u, v): the polygon follows the degenerate side between them, and all its nodes there are
//! the same carrier vertex.

use crate::job::Job;
use crate::surface::brep::{BrepFace, Coedge};
use crate::surface::exact::project::Seeds;
use crate::surface::exact::shape::Pole;
use crate::surface::{Curve, Origin, PREPARING, Sampling, Shape};
use glam::{DVec2, DVec3};

/// Edge samples may lie this many `max_edge` off the patch; more is another patch's edge.
const OFF_PATCH: f64 = 0.2;
/// A sample nearer to a pole than this share of `max_edge` is the pole.
const AT_POLE: f64 = 1e-4;
/// Where, along the piece of edge next to a pole, the direction of arrival is looked up.
const NEAR_POLE: f64 = 1e-3;

/// One edge as a polyline.
pub(in crate::surface) struct Polyline {
    /// Curve parameters, ascending.
    pub t: Vec<f64>,
    /// Carrier vertices.
    pub vertices: Vec<u32>,
}

/// A corner of a face's mesh: a place in (u, v) and the carrier vertex it stands for.
#[derive(Clone, Copy, Debug)]
pub(in crate::surface) struct Node {
    pub uv: DVec2,
    pub xyz: DVec3,
    /// Carrier vertex; [`NEW`] for a node of the inside, which gets its own.
    pub vertex: u32,
    /// The direction (0 for u, 1 for v) that means nothing here because this is a pole.
    pub free: Option<usize>,
}

/// A node that has no carrier vertex yet.
pub(super) const NEW: u32 = u32::MAX;

/// The polygons of one face.
#[derive(Default)]
pub(in crate::surface) struct Trim {
    /// Closed polygons, the face to their left in (u, v).
    pub loops: Vec<Vec<Node>>,
    /// Area between the exact edges and the polygons' chords, m2; positive where the edges bulge out.
    pub sliver: f64,
}

/// Shared edge samples.
pub(in crate::surface) struct Edges<'a> {
    pub curves: &'a [Curve],
    pub polylines: &'a [Polyline],
    pub points: &'a [DVec3],
    pub origin: Origin,
}

/// One coedge in the patch's parameters, in the loop's direction.
struct Path {
    nodes: Vec<Node>,
    sliver: f64,
}

/// A loop in the patch's parameters, and how far it ends from where it began: whole periods.
pub(in crate::surface) struct Traced {
    pub nodes: Vec<Node>,
    pub winding: DVec2,
    sliver: f64,
}

impl Traced {
    /// Area in (u, v), positive where it runs counter-clockwise.
    pub fn area(&self) -> f64 {
        let n = self.nodes.len();
        let cross = |i: usize| self.nodes[i].uv.perp_dot(self.nodes[(i + 1) % n].uv);
        0.5 * (0..n).map(cross).sum::<f64>()
    }
}

/// Part of a loop in the patch's parameters, in the loop's direction: along an edge, or along a side that is a pole.
pub(in crate::surface) struct Run {
    /// The edge; None along a pole.
    pub edge: Option<u32>,
    pub nodes: Vec<Node>,
    /// The edge's parameters at the nodes.
    pub t: Vec<f64>,
}

/// What loops of one face are traced against.
pub(in crate::surface) struct Tracer<'a> {
    shape: &'a Shape,
    edges: &'a Edges<'a>,
    sampling: &'a Sampling,
    job: &'a Job,
    poles: Vec<Pole>,
    seeds: Seeds,
}

impl<'a> Tracer<'a> {
    pub fn new(
        shape: &'a Shape,
        edges: &'a Edges<'a>,
        sampling: &'a Sampling,
        job: &'a Job,
    ) -> Tracer<'a> {
        Tracer { shape, edges, sampling, job, poles: shape.poles(), seeds: Seeds::new(shape) }
    }

    pub fn poles(&self) -> &[Pole] {
        &self.poles
    }

    /// All polygons of `face`, or what is wrong with it.
    pub fn trim(&self, face: &BrepFace) -> Result<Trim, String> {
        let mut trim = Trim::default();
        for l in &face.loops {
            let traced = self.trace(l, face.reversed)?;
            if traced.winding != DVec2::ZERO {
                return Err("a loop runs round the closed patch without a seam".into());
            }
            trim.sliver += traced.sliver;
            if traced.nodes.len() >= 3 {
                trim.loops.push(traced.nodes);
            }
        }
        self.gather(&mut trim.loops);
        Ok(trim)
    }

    /// All loops edge by edge, each joined to the next, and holes brought into the largest loop.
    pub fn runs(&self, face: &BrepFace) -> Result<Vec<Vec<Run>>, String> {
        let mut all = Vec::with_capacity(face.loops.len());
        for l in &face.loops {
            all.push(self.loop_runs(l, face.reversed)?);
        }
        let flat = |runs: &Vec<Run>| -> Vec<Node> {
            runs.iter().flat_map(|r| &r.nodes).copied().collect()
        };
        let mut loops: Vec<Vec<Node>> = all.iter().map(flat).collect();
        self.gather(&mut loops);
        for (runs, gathered) in all.iter_mut().zip(loops) {
            let shift = gathered[0].uv - runs[0].nodes[0].uv;
            runs.iter_mut().flat_map(|r| &mut r.nodes).for_each(|n| n.uv += shift);
        }
        Ok(all)
    }

    fn loop_runs(&self, coedges: &[Coedge], reversed: bool) -> Result<Vec<Run>, String> {
        let mut runs: Vec<Run> = Vec::new();
        for c in in_uv(coedges, reversed) {
            let mut nodes = self.path(c)?.nodes;
            let mut t = self.edges.polylines[c.edge as usize].t.clone();
            if c.reversed {
                t.reverse();
            }
            if let Some(&end) = runs.last().and_then(|r| r.nodes.last()) {
                let shift = self.shift(&end, &nodes[0]);
                for n in &mut nodes {
                    n.uv += shift;
                }
                runs.extend(pole_run(end, nodes[0]));
            }
            runs.push(Run { edge: Some(c.edge), nodes, t });
        }
        let ends =
            runs.first().zip(runs.last()).map(|(a, b)| (a.nodes[0], b.nodes[b.nodes.len() - 1]));
        let (first, last) = ends.ok_or("a loop is empty")?;
        let again = Node { uv: first.uv + self.shift(&last, &first), ..first };
        if again.uv != first.uv {
            return Err("a loop runs round the closed patch without a seam".into());
        }
        runs.extend(pole_run(last, again));
        Ok(runs)
    }

    /// One loop, the face to its left in (u, v).
    pub fn trace(&self, coedges: &[Coedge], reversed: bool) -> Result<Traced, String> {
        let order = in_uv(coedges, reversed);
        let mut traced = Traced { nodes: Vec::new(), winding: DVec2::ZERO, sliver: 0.0 };
        for c in order {
            if self.job.is_over(PREPARING) {
                // The caller is to check: nobody reads this.
                return Err(PREPARING.into());
            }
            let mut path = self.path(c)?;
            traced.sliver += path.sliver;
            if let Some(&end) = traced.nodes.last() {
                let shift = self.shift(&end, &path.nodes[0]);
                for n in &mut path.nodes {
                    n.uv += shift;
                }
                self.join(&mut traced.nodes, &path.nodes[0])?;
            }
            traced.nodes.extend(path.nodes);
        }
        let (Some(&first), Some(&last)) = (traced.nodes.first(), traced.nodes.last()) else {
            return Err("a loop is empty".into());
        };
        let shift = self.shift(&last, &first);
        if first.free.is_some() {
            let again = Node { uv: first.uv + shift, ..first };
            self.join(&mut traced.nodes, &again)?;
            // The side of the pole has brought us round; only the place itself must be the same.
            let gap = again.uv - first.uv;
            if gap.abs().max_element() > 0.0 {
                traced.winding = gap;
            }
        } else {
            traced.winding = shift;
            let again = Node { uv: first.uv + shift, ..first };
            self.join(&mut traced.nodes, &again)?;
        }
        Ok(traced)
    }

    /// Whole periods that bring `start` to where `end` is; at a pole, to where the side of the pole leads.
    fn shift(&self, end: &Node, start: &Node) -> DVec2 {
        let period = self.shape.period();
        let mut shift = DVec2::ZERO;
        for k in 0..2 {
            if period[k] == 0.0 {
                continue;
            }
            let gap = end.uv[k] - start.uv[k];
            shift[k] = (gap / period[k]).round() * period[k];
            if start.free == Some(k) && end.free == Some(k) {
                let ahead = self.pole_side(start) * (start.uv[k] + shift[k] - end.uv[k]);
                // A loop that comes back at the same parameter has gone all the way round.
                if ahead < 1e-6 * period[k] {
                    shift[k] += self.pole_side(start) * period[k];
                }
            }
        }
        shift
    }

    /// Direction in which the domain's boundary, the inside to its left, runs along the pole of `node`.
    fn pole_side(&self, node: &Node) -> f64 {
        let pole = self
            .poles
            .iter()
            .find(|p| Some(1 - p.fixed) == node.free && p.value == node.uv[p.fixed]);
        match pole {
            Some(p) if (p.fixed == 1) == p.upper => -1.0,
            _ => 1.0,
        }
    }

    /// Prepare `nodes` for a path that begins at `start`: drop the node they share, or follow the side of
    /// the pole.
    fn join(&self, nodes: &mut Vec<Node>, start: &Node) -> Result<(), String> {
        let end = nodes[nodes.len() - 1];
        if end.vertex != start.vertex {
            let gap = end.xyz.distance(start.xyz);
            if gap <= self.sampling.chord_error {
                return Ok(());
            }
            let p = self.edges.origin.world(end.xyz);
            return Err(format!(
                "its loop has a gap of {gap:.4} m at ({:.4}, {:.4}, {:.4})",
                p.x, p.y, p.z
            ));
        }
        let gap = start.uv - end.uv;
        if start.free.is_none()
            || gap.abs().max_element() <= 1e-9 * (1.0 + start.uv.abs().max_element())
        {
            nodes.pop();
            return Ok(());
        }
        // Enough nodes that triangles near the pole see its side pass by.
        let pieces = 16;
        for i in 1..pieces {
            nodes.push(Node { uv: end.uv + gap * (f64::from(i) / f64::from(pieces)), ..end });
        }
        Ok(())
    }

    /// Project one coedge.
    fn path(&self, coedge: Coedge) -> Result<Path, String> {
        let curve = &self.edges.curves[coedge.edge as usize];
        let line = &self.edges.polylines[coedge.edge as usize];
        let n = line.t.len();
        let mid = n / 2;
        let start = curve.point(0.5 * (line.t[mid - 1] + line.t[mid]));
        let (start_uv, _) = self.seeds.project(self.shape, start);
        let mut nodes = Vec::with_capacity(n);
        let mut uv = start_uv;
        for i in (0..mid).rev() {
            let node = self.place(curve, line, i, i + 1, uv)?;
            uv = node.uv;
            nodes.push(node);
        }
        nodes.reverse();
        uv = start_uv;
        for i in mid..n {
            let node = self.place(curve, line, i, i - 1, uv)?;
            uv = node.uv;
            nodes.push(node);
        }
        let mut sliver = 0.0;
        for k in 1..n {
            let t = 0.5 * (line.t[k - 1] + line.t[k]);
            let (a, b) = (nodes[k - 1].uv, nodes[k].uv);
            let (m, _) = self.shape.project(0.5 * (a + b), curve.point(t));
            let jet = self.shape.jet((a + b + m) / 3.0);
            // Area under a parabola: 4/3 of the triangle on its ends and middle.
            sliver += 2.0 / 3.0 * (m - a).perp_dot(b - a) * jet.du.cross(jet.dv).length();
        }
        if coedge.reversed {
            nodes.reverse();
            sliver = -sliver;
        }
        Ok(Path { nodes, sliver })
    }

    /// Parameters of sample `i`, found from `near`; `from` is the sample next to it on the way there.
    fn place(
        &self,
        curve: &Curve,
        line: &Polyline,
        i: usize,
        from: usize,
        near: DVec2,
    ) -> Result<Node, String> {
        let vertex = line.vertices[i];
        let xyz = self.edges.points[vertex as usize];
        let at_pole = AT_POLE * self.sampling.max_edge;
        if let Some(pole) = self.poles.iter().find(|p| p.point.distance(xyz) <= at_pole) {
            let beside = curve.point(line.t[i] + (line.t[from] - line.t[i]) * NEAR_POLE);
            let (mut uv, _) = self.shape.project(near, beside);
            uv[pole.fixed] = pole.value;
            return Ok(Node { uv, xyz, vertex, free: Some(1 - pole.fixed) });
        }
        let (mut uv, mut foot) = self.shape.project(near, xyz);
        let limit = OFF_PATCH * self.sampling.max_edge;
        if foot.distance(xyz) > self.sampling.chord_error {
            // The search may have ended in a fold on the way: begin as far beyond it.
            let (beyond, beyond_foot) = self.shape.project(uv + (uv - near), xyz);
            if beyond_foot.distance(xyz) < 0.5 * foot.distance(xyz) {
                (uv, foot) = (beyond, beyond_foot);
            }
        }
        if foot.distance(xyz) > self.sampling.chord_error {
            let (other, other_foot) = self.seeds.project(self.shape, xyz);
            if other_foot.distance(xyz) < 0.5 * foot.distance(xyz) {
                let period = self.shape.period();
                let turns = (near - other) / period;
                for k in (0..2).filter(|&k| period[k] > 0.0) {
                    uv[k] = other[k] + turns[k].round() * period[k];
                }
                for k in (0..2).filter(|&k| period[k] == 0.0) {
                    uv[k] = other[k];
                }
                foot = other_foot;
            }
        }
        if foot.distance(xyz) > limit {
            let p = self.edges.origin.world(xyz);
            return Err(format!(
                "its edge at ({:.4}, {:.4}, {:.4}) lies {:.4} m off its surface",
                p.x,
                p.y,
                p.z,
                foot.distance(xyz)
            ));
        }
        Ok(Node { uv, xyz, vertex, free: None })
    }

    /// Shift each loop by whole periods into the largest one.
    fn gather(&self, loops: &mut [Vec<Node>]) {
        let period = self.shape.period();
        if period == DVec2::ZERO || loops.len() < 2 {
            return;
        }
        let outer = (0..loops.len())
            .max_by(|&a, &b| area(&loops[a]).total_cmp(&area(&loops[b])))
            .expect("there are two loops or more");
        let shell = loops[outer].clone();
        let middle = shell.iter().map(|n| n.uv).sum::<DVec2>() / shell.len() as f64;
        for (i, l) in loops.iter_mut().enumerate() {
            if i == outer {
                continue;
            }
            let turns = DVec2::new(
                if period.x > 0.0 { ((middle.x - l[0].uv.x) / period.x).round() } else { 0.0 },
                if period.y > 0.0 { ((middle.y - l[0].uv.y) / period.y).round() } else { 0.0 },
            );
            let shifts = [0.0, 1.0, -1.0]
                .into_iter()
                .flat_map(|a| [0.0, 1.0, -1.0].map(|b| (turns + DVec2::new(a, b)) * period));
            let inside = shifts.into_iter().find(|&s| holds(&shell, l[0].uv + s));
            if let Some(shift) = inside {
                for n in l.iter_mut() {
                    n.uv += shift;
                }
            }
        }
    }
}

/// A loop as it runs in (u, v). Seen against du x dv, the face lies to the right of its loops: run them backwards.
fn in_uv(coedges: &[Coedge], reversed: bool) -> Vec<Coedge> {
    let mut order: Vec<Coedge> = coedges.to_vec();
    if reversed {
        order.reverse();
        for c in &mut order {
            c.reversed = !c.reversed;
        }
    }
    order
}

/// The side of a pole between two runs that meet in it; None elsewhere.
fn pole_run(end: Node, start: Node) -> Option<Run> {
    let gap = (start.uv - end.uv).abs().max_element();
    let pole = end.vertex == start.vertex && start.free.is_some();
    (pole && gap > 1e-9 * (1.0 + start.uv.abs().max_element())).then(|| Run {
        edge: None,
        nodes: vec![end, start],
        t: vec![0.0, 1.0],
    })
}

/// Area of a polygon in (u, v), without its sign.
fn area(nodes: &[Node]) -> f64 {
    let n = nodes.len();
    (0..n).map(|i| nodes[i].uv.perp_dot(nodes[(i + 1) % n].uv)).sum::<f64>().abs()
}

/// Whether the polygon holds `p`.
fn holds(polygon: &[Node], p: DVec2) -> bool {
    let n = polygon.len();
    let mut inside = false;
    for i in 0..n {
        let (a, b) = (polygon[i].uv, polygon[(i + 1) % n].uv);
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y) {
            inside = !inside;
        }
    }
    inside
}
