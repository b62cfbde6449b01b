//! Boundary representations: solids (186) and shells (514) of faces (510) whose loops (508) share edges (504) between
//! vertices (502).

use super::curves::Arc;
use super::directory::{Entry, Parameters};
use super::{Fault, File, VISIT};
use crate::surface::Curve;
use crate::surface::brep::{Brep, BrepEdge, BrepFace, Coedge};
use glam::DVec3;
use std::collections::HashMap;
use std::collections::hash_map::Entry as Known;

/// A curve's end within this share of its length of a vertex is there.
const AT_VERTEX: f64 = 1e-6;
/// Looks along a closed curve for the place nearest to its vertex.
const LOOKS: usize = 64;

/// Edges and vertices that were read: by list and place in it.
#[derive(Default)]
pub(super) struct Shared {
    edges: HashMap<(u32, usize), u32>,
    vertices: HashMap<(u32, usize), u32>,
    /// Parameters of lists, which many loops ask for.
    lists: HashMap<u32, Parameters>,
}

impl File<'_> {
    /// All shells of a 186.
    pub fn solid(&self, brep: &mut Brep, shared: &mut Shared, entry: &Entry) -> Result<(), Fault> {
        let p = self.directory.parameters(entry)?;
        for k in shells_of(&p)? {
            let shell = self.known(p.pointer(k)?.ok_or_else(|| p.fault("a shell is missing"))?)?;
            self.shell(brep, shared, &shell)?;
        }
        Ok(())
    }

    /// The faces of a 514; those that cannot be used are noted.
    pub fn shell(&self, brep: &mut Brep, shared: &mut Shared, entry: &Entry) -> Result<(), Fault> {
        let p = self.directory.parameters(entry)?;
        if entry.kind != 514 {
            return Err(p.fault("a shell is asked for here, which this is not"));
        }
        for k in 0..p.count(0)? {
            let number = p.pointer(1 + 2 * k)?.ok_or_else(|| p.fault("a face is missing"))?;
            let reversed = p.number_or(2 + 2 * k, 1.0) == 0.0;
            let added = self.known(number).and_then(|face| {
                self.spend(&face, VISIT)?;
                self.shell_face(brep, shared, &face, reversed)
            });
            self.or_note(added)?;
        }
        Ok(())
    }

    /// Note why something was left out; what is fatal stays an error.
    pub fn or_note(&self, result: Result<(), Fault>) -> Result<(), Fault> {
        match result {
            Err(fault) if !fault.fatal => {
                self.note(format!("{} left out: {}", fault.place, fault.what));
                Ok(())
            }
            other => other,
        }
    }

    /// One 510.
    pub fn shell_face(
        &self,
        brep: &mut Brep,
        shared: &mut Shared,
        entry: &Entry,
        reversed: bool,
    ) -> Result<(), Fault> {
        let p = self.directory.parameters(entry)?;
        if entry.kind != 510 {
            return Err(p.fault("a face is asked for here, which this is not"));
        }
        let surface = p.pointer(0)?.ok_or_else(|| p.fault("its surface is missing"))?;
        let mut loops = Vec::new();
        for k in 0..p.count(1)? {
            let number = p.pointer(3 + k)?.ok_or_else(|| p.fault("a loop is missing"))?;
            let mut coedges = self.ring(brep, shared, number)?;
            if reversed {
                super::loops::flip(&mut coedges);
            }
            // A loop of a vertex alone only marks a pole.
            if !coedges.is_empty() {
                loops.push(coedges);
            }
        }
        let along = |c: &Coedge| {
            let e = &brep.edges[c.edge as usize];
            let t = (0..=16).map(|i| e.range[0] + (e.range[1] - e.range[0]) * f64::from(i) / 16.0);
            t.map(|t| e.curve.point(t)).collect::<Vec<_>>()
        };
        let reach: Vec<DVec3> = loops.iter().flatten().flat_map(along).collect();
        let sheet = self.surface(surface, &reach)?;
        if loops.is_empty() && sheet.is_part() {
            return Err(p.fault("a face without loops on a part of its surface is not read"));
        }
        brep.faces.push(BrepFace { shape: sheet.shape, loops, reversed, label: entry.place() });
        Ok(())
    }

    /// One 508.
    fn ring(
        &self,
        brep: &mut Brep,
        shared: &mut Shared,
        number: u32,
    ) -> Result<Vec<Coedge>, Fault> {
        let entry = self.known(number)?;
        let p = self.directory.parameters(&entry)?;
        if entry.kind != 508 {
            return Err(p.fault("a loop is asked for here, which this is not"));
        }
        let mut coedges = Vec::new();
        let mut at = 1;
        for _ in 0..p.count(0)? {
            let is_vertex = p.flag(at);
            let list = p.pointer(at + 1)?.ok_or_else(|| p.fault("an edge is missing"))?;
            let place = p.number(at + 2)?;
            if !(1.0..1e9).contains(&place) {
                return Err(p.fault(format!("edge {place} of a list does not exist")));
            }
            let reversed = p.number_or(at + 3, 1.0) == 0.0;
            if !is_vertex {
                let edge = self.edge(brep, shared, list, place as usize)?;
                coedges.push(Coedge { edge, reversed });
            }
            at += 5 + 2 * p.count(at + 4)?;
        }
        Ok(coedges)
    }

    /// The parameters of a list of edges or vertices.
    fn list<'s>(
        &self,
        shared: &'s mut Shared,
        number: u32,
        kind: u32,
    ) -> Result<&'s Parameters, Fault> {
        let entry = self.known(number)?;
        if entry.kind != kind {
            return Err(
                entry.fault(format!("a list of type {kind} is asked for here, which this is not"))
            );
        }
        Ok(match shared.lists.entry(number) {
            Known::Occupied(list) => list.into_mut(),
            Known::Vacant(list) => list.insert(self.directory.parameters(&entry)?),
        })
    }

    /// Edge `place`, from 1, of a 504.
    fn edge(
        &self,
        brep: &mut Brep,
        shared: &mut Shared,
        list: u32,
        place: usize,
    ) -> Result<u32, Fault> {
        if let Some(&known) = shared.edges.get(&(list, place)) {
            return Ok(known);
        }
        let p = self.list(shared, list, 504)?;
        if place > p.count(0)? {
            return Err(p.fault(format!("it has no edge {place}")));
        }
        let at = 1 + 5 * (place - 1);
        let curve = p.pointer(at)?.ok_or_else(|| p.fault(format!("edge {place} has no curve")))?;
        let mut ends = [(0, 0); 2];
        for (k, end) in ends.iter_mut().enumerate() {
            let vertices = p.pointer(at + 1 + 2 * k)?;
            let vertices =
                vertices.ok_or_else(|| p.fault(format!("edge {place} has no vertex")))?;
            let index = p.number(at + 2 + 2 * k)?;
            if !(1.0..1e9).contains(&index) {
                return Err(p.fault(format!("edge {place} names vertex {index}")));
            }
            *end = (vertices, index as usize);
        }
        let mut vertex = |(list, place)| self.vertex(brep, shared, list, place);
        let ends = [vertex(ends[0])?, vertex(ends[1])?];
        let [a, b] = ends.map(|v| brep.vertices[v as usize]);
        let arc = fit(self.curve(curve)?, a, b, ends[0] == ends[1]);
        let (curve, range) = (Curve::Nurbs(arc.curve), arc.range);
        brep.edges.push(BrepEdge { curve, range, ends });
        let id = brep.edges.len() as u32 - 1;
        shared.edges.insert((list, place), id);
        Ok(id)
    }

    /// Vertex `place`, from 1, of a 502.
    fn vertex(
        &self,
        brep: &mut Brep,
        shared: &mut Shared,
        list: u32,
        place: usize,
    ) -> Result<u32, Fault> {
        if let Some(&known) = shared.vertices.get(&(list, place)) {
            return Ok(known);
        }
        let entry = self.known(list)?;
        let matrix = self.place(&entry)?;
        let p = self.list(shared, list, 502)?;
        if place > p.count(0)? {
            return Err(p.fault(format!("it has no vertex {place}")));
        }
        let n = p.numbers(1 + 3 * (place - 1), 3)?;
        brep.vertices.push(p.reached(matrix.transform_point3(DVec3::from_slice(&n)))?);
        let id = brep.vertices.len() as u32 - 1;
        shared.vertices.insert((list, place), id);
        Ok(id)
    }
}

/// The curve of an edge from `a` to `b`: turned to run so, and cut off where it goes on past them.
fn fit(arc: Arc, a: DVec3, b: DVec3, closed: bool) -> Arc {
    let arc = if !closed
        && arc.start().distance(b) + arc.end().distance(a)
            < arc.start().distance(a) + arc.end().distance(b)
    {
        arc.reversed()
    } else {
        arc
    };
    let [from, to] = arc.range;
    let at = |i: usize| from + (to - from) * i as f64 / LOOKS as f64;
    let points: Vec<DVec3> = (0..=LOOKS).map(|i| arc.curve.point(at(i))).collect();
    let length: f64 = points.windows(2).map(|w| w[0].distance(w[1])).sum();
    let near = AT_VERTEX * length;
    let whole = Curve::Nurbs(arc.curve.clone());
    let foot = |p: DVec3| {
        let nearest = (0..=LOOKS).min_by(|&i, &j| {
            points[i].distance_squared(p).total_cmp(&points[j].distance_squared(p))
        });
        whole.project(at(nearest.unwrap_or(0)), [from, to], p)
    };
    if arc.start().distance(a) <= near && arc.end().distance(b) <= near {
        return arc;
    }
    let ((s, start), (t, end)) = (foot(a), foot(b));
    if closed {
        let is_whole = arc.curve.closed() && arc.range == arc.curve.domain();
        return if is_whole { Arc { range: [s, s + (to - from)], ..arc } } else { arc };
    }
    // Only where that brings the ends nearer.
    let off = |p: DVec3, q: DVec3| p.distance(a) + q.distance(b);
    if s < t && off(start, end) < 0.5 * off(arc.start(), arc.end()) {
        return Arc { range: [s, t], ..arc };
    }
    if arc.curve.closed() && arc.range == arc.curve.domain() && s > t {
        return Arc { range: [s, t + (to - from)], ..arc };
    }
    arc
}

/// Where a 186 names its shells.
pub(super) fn shells_of(p: &Parameters) -> Result<Vec<usize>, Fault> {
    let voids = p.count(2)?;
    Ok(std::iter::once(0).chain((0..voids).map(|k| 3 + 2 * k)).collect())
}

/// Where a 186, 514 or 510 names what it is made of.
pub(super) fn parts(kind: u32, p: &Parameters) -> Vec<usize> {
    match kind {
        186 => shells_of(p).unwrap_or_default(),
        514 => (0..p.count(0).unwrap_or(0)).map(|k| 1 + 2 * k).collect(),
        510 => vec![0],
        _ => Vec::new(),
    }
}
