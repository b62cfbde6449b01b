//! Faces of the decoder's arenas as ours: trims to coedges, edges and vertices each once.

use super::convert::{self, Read};
use super::{Reading, curves};
use crate::surface::brep::{BrepEdge, BrepFace, Coedge};
use crate::surface::nurbs::NurbsCurve;
use crate::surface::{Curve, Shape};
use cadmpeg_ir::topology::{Coedge as Trim, Face, LoopBoundary, Sense};
use cadmpeg_ir::units::FiniteVector;
use glam::DVec3;
use std::sync::Arc;

/// Curves whose ends are farther apart than this share of their length are not the same edge.
const NEAR: f64 = 0.01;

impl Reading<'_> {
    /// A face with its loops.
    pub(super) fn trimmed(&mut self, face: &Face) -> Read<BrepFace> {
        let arenas = self.arenas;
        let reversed = face.sense == Sense::Reversed;
        let k = arenas.surfaces.binary_search_by(|s| s.id.as_str().cmp(face.surface.as_str()));
        let surface = &arenas.surfaces[k.map_err(|_| "its surface is missing".to_owned())?];
        // A plane is drawn on in other parameters than ours.
        let drawn_on = convert::whole(&surface.geometry)?.map(Arc::new);
        let mut loops = Vec::new();
        for id in &face.loops {
            let at = arenas.loops.binary_search_by(|l| l.id.cmp(id));
            let ring = at.map_err(|_| "a loop of it is missing".to_owned())?;
            let LoopBoundary::Ring(ring) = &arenas.loops[ring].boundary else { continue };
            let mut coedges = Vec::new();
            for id in ring.coedges() {
                let at = arenas.coedges.binary_search_by(|c| c.id.cmp(id));
                let trim = &arenas.coedges[at.map_err(|_| "a trim of it is missing".to_owned())?];
                // A trim without an edge of any length only marks a pole.
                coedges.extend(self.coedge(trim, drawn_on.as_ref())?);
            }
            // Trims run round the surface's own normal, whichever side the face has outside.
            if reversed {
                coedges.reverse();
                for c in &mut coedges {
                    c.reversed = !c.reversed;
                }
            }
            if !coedges.is_empty() {
                loops.push(coedges);
            }
        }
        let shape = if let Some(shape) = drawn_on {
            (*shape).clone()
        } else {
            let along = loops.iter().flatten().flat_map(|c| self.along(c.edge));
            convert::surface(&surface.geometry, &along.collect::<Vec<DVec3>>())?
        };
        Ok(BrepFace { shape, loops, reversed, label: String::new() })
    }

    /// The use of an edge by a trim. An edge of this face alone is taken as it is drawn on the surface, which is what
    /// Rhino trims by: its curve in space is only near to it.
    fn coedge(&mut self, trim: &Trim, drawn_on: Option<&Arc<Shape>>) -> Read<Option<Coedge>> {
        let reversed = trim.sense == Sense::Reversed;
        let Some(edge) = self.edge(trim.edge.as_str())? else { return Ok(None) };
        if let Some(shape) = drawn_on.filter(|_| trim.radial_next == trim.id)
            && let Some(drawn) = self.drawn(trim)
        {
            let BrepEdge { curve, range, ends } = &mut self.brep.edges[edge as usize];
            let size = NEAR * length(curve, *range);
            let [from, to] = if reversed { [range[1], range[0]] } else { *range };
            let domain = drawn.domain();
            let drawn = Curve::OnShape(shape.clone(), drawn);
            let meet = |t: f64, at: f64| drawn.point(t).distance(curve.point(at)) <= size;
            if meet(domain[0], from) && meet(domain[1], to) {
                if reversed {
                    ends.reverse();
                }
                let [a, b] = ends.map(|v| v as usize);
                self.brep.vertices[a] = drawn.point(domain[0]);
                self.brep.vertices[b] = drawn.point(domain[1]);
                (*curve, *range) = (drawn, domain);
                return Ok(Some(Coedge { edge, reversed: false }));
            }
        }
        Ok(Some(Coedge { edge, reversed }))
    }

    /// What a trim is drawn as, in the parameters of the face, where that is one whole spline.
    fn drawn(&self, trim: &Trim) -> Option<NurbsCurve> {
        let [only] = trim.pcurves.as_slice() else { return None };
        let k = self.arenas.pcurves.binary_search_by(|p| p.id.cmp(&only.pcurve)).ok()?;
        let curve = curves::trim(&self.arenas.pcurves[k].geometry)?;
        let whole = only.parameter_range.is_none_or(|range| range.endpoints() == curve.domain());
        whole.then_some(curve)
    }

    /// Points along an edge.
    fn along(&self, edge: u32) -> Vec<DVec3> {
        let BrepEdge { curve, range: [a, b], .. } = &self.brep.edges[edge as usize];
        (0..=16).map(|k| curve.point(a + (b - a) * f64::from(k) / 16.0)).collect()
    }

    /// The place of an edge; None where it has no length.
    fn edge(&mut self, id: &str) -> Read<Option<u32>> {
        if let Some(&known) = self.edges.get(id) {
            return Ok(known);
        }
        let arenas = self.arenas;
        let at = arenas.edges.binary_search_by(|e| e.id.as_str().cmp(id));
        let edge = &arenas.edges[at.map_err(|_| "an edge of it is missing".to_owned())?];
        let carrier = edge.curve().and_then(|id| {
            arenas.curves.binary_search_by(|c| c.id.cmp(id)).ok().map(|k| &arenas.curves[k])
        });
        let place = match carrier {
            None => None,
            Some(carrier) => {
                let range = edge.param_range().map(FiniteVector::get);
                let curve = curves::curve(arenas, &carrier.geometry, range)
                    .map_err(|why| format!("an edge of it could not be read: {why}"))?;
                match curve {
                    None => None,
                    Some((curve, range)) => {
                        let ends =
                            [self.vertex(edge.start.as_str())?, self.vertex(edge.end.as_str())?];
                        let ends = self.as_the_curve_runs(
                            &curve.point(range[0]),
                            &curve.point(range[1]),
                            ends,
                        );
                        self.brep.edges.push(BrepEdge { curve, range, ends });
                        Some(self.brep.edges.len() as u32 - 1)
                    }
                }
            }
        };
        self.edges.insert(id.to_owned(), place);
        Ok(place)
    }

    /// The two vertices in the order in which the curve meets them.
    fn as_the_curve_runs(&self, from: &DVec3, to: &DVec3, [a, b]: [u32; 2]) -> [u32; 2] {
        let at = |v: u32| self.brep.vertices[v as usize];
        let off = |a: u32, b: u32| at(a).distance(*from) + at(b).distance(*to);
        if off(a, b) <= off(b, a) { [a, b] } else { [b, a] }
    }

    fn vertex(&mut self, id: &str) -> Read<u32> {
        if let Some(&known) = self.vertices.get(id) {
            return Ok(known);
        }
        let arenas = self.arenas;
        let missing = |_| "a vertex of it is missing".to_owned();
        let vertex =
            arenas.vertices.binary_search_by(|v| v.id.as_str().cmp(id)).map_err(missing)?;
        let point = &arenas.vertices[vertex].point;
        let at = arenas.points.binary_search_by(|p| p.id.cmp(point)).map_err(missing)?;
        self.brep.vertices.push(convert::reached(convert::point(*arenas.points[at].position()))?);
        let number = self.brep.vertices.len() as u32 - 1;
        self.vertices.insert(id.to_owned(), number);
        Ok(number)
    }
}

/// Length of a curve over a range, by chords.
fn length(curve: &Curve, [a, b]: [f64; 2]) -> f64 {
    let at = |k: u32| curve.point(a + (b - a) * f64::from(k) / 16.0);
    (0..16).map(|k| at(k).distance(at(k + 1))).sum()
}
