//! Putting a B-rep together by hand: vertices, edges, faces.

use super::conic;
use crate::surface::brep::{BrepEdge, BrepFace, Coedge};
use crate::surface::exact::nurbs::NurbsCurve;
use crate::surface::{Brep, Curve, Shape};
use glam::DVec3;

/// A B-rep in the making. Metres.
pub(super) struct Sketch {
    brep: Brep,
}

impl Sketch {
    /// An empty sketch of the built-in surface `name`.
    pub(super) fn new(name: &str) -> Sketch {
        Sketch { brep: Brep { name: name.to_owned(), unit_in_metres: 1.0, ..Brep::default() } }
    }

    /// Add a vertex.
    pub(super) fn vertex(&mut self, xyz: DVec3) -> u32 {
        self.brep.vertices.push(xyz);
        self.brep.vertices.len() as u32 - 1
    }

    /// Add an edge along `curve` between two vertices.
    pub(super) fn edge(&mut self, curve: Curve, range: [f64; 2], ends: [u32; 2]) -> u32 {
        self.brep.edges.push(BrepEdge { curve, range, ends });
        self.brep.edges.len() as u32 - 1
    }

    /// Add an edge along the whole of a clamped curve between two vertices.
    pub(super) fn whole(&mut self, curve: NurbsCurve, ends: [u32; 2]) -> u32 {
        let range = [curve.knots[curve.degree], curve.knots[curve.points.len()]];
        self.edge(Curve::Nurbs(curve), range, ends)
    }

    /// Add a straight edge.
    pub(super) fn line(&mut self, from: u32, to: u32) -> u32 {
        let [a, b] = [from, to].map(|v| self.brep.vertices[v as usize]);
        self.whole(conic::line(a, b), [from, to])
    }

    /// Add a closed edge along the whole of a closed curve, with a vertex at its start.
    pub(super) fn ring(&mut self, curve: Curve, range: [f64; 2]) -> u32 {
        let v = self.vertex(curve.point(range[0]));
        self.edge(curve, range, [v, v])
    }

    /// Add straight edges round a closed polygon.
    pub(super) fn polygon(&mut self, corners: &[DVec3]) -> Vec<Coedge> {
        let ids: Vec<u32> = corners.iter().map(|&c| self.vertex(c)).collect();
        (0..ids.len()).map(|k| along(self.line(ids[k], ids[(k + 1) % ids.len()]))).collect()
    }

    /// Add a face whose outside is along `du x dv`.
    pub(super) fn face(&mut self, shape: Shape, loops: Vec<Vec<Coedge>>) {
        self.brep.faces.push(BrepFace { shape, loops, reversed: false, label: String::new() });
    }

    /// The B-rep.
    pub(super) fn finish(self) -> Brep {
        self.brep
    }
}

/// The edge run in its own direction.
pub(super) fn along(edge: u32) -> Coedge {
    Coedge { edge, reversed: false }
}

/// The edge run from its end to its start.
pub(super) fn against(edge: u32) -> Coedge {
    Coedge { edge, reversed: true }
}
