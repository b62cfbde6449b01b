//! Trimmed (144) and bounded (143) surfaces, and surfaces that stand alone.

use super::curves::{Arc, in_line};
use super::directory::{Entry, Parameters};
use super::loops::{self, Side};
use super::{Fault, File};
use crate::surface::brep::{Brep, BrepEdge, BrepFace, Coedge};
use crate::surface::exact::project::Seeds;
use crate::surface::nurbs::NurbsSurface;
use crate::surface::{Curve, OffsetSurface, Shape, bound};
use glam::{DAffine3, DVec2, DVec3};
use std::sync::Arc as Shared;

/// A boundary as the file has it.
enum Path {
    /// Curves in space.
    Space(Vec<Arc>),
    /// Curves in the surface's parameters.
    Parameters(Vec<Arc>),
}

impl File<'_> {
    /// The face of a 144.
    pub fn trimmed(&self, brep: &mut Brep, entry: &Entry) -> Result<(), Fault> {
        let p = self.directory.parameters(entry)?;
        let surface = p.pointer(0)?.ok_or_else(|| p.fault("its surface is missing"))?;
        let bounded = p.flag(1);
        let holes = p.count(2)?;
        let mut paths = Vec::new();
        if bounded {
            let outer = p.pointer(3)?.ok_or_else(|| p.fault("its outer boundary is missing"))?;
            paths.push(self.on_surface(outer)?);
        }
        for k in 0..holes {
            let hole = p.pointer(4 + k)?.ok_or_else(|| p.fault("a boundary is missing"))?;
            paths.push(self.on_surface(hole)?);
        }
        let outer = bounded.then_some(0);
        self.face(brep, entry, surface, paths, outer)
    }

    /// The face of a 143: the longest way round is its outer boundary.
    pub fn bounded(&self, brep: &mut Brep, entry: &Entry) -> Result<(), Fault> {
        let p = self.directory.parameters(entry)?;
        let surface = p.pointer(1)?.ok_or_else(|| p.fault("its surface is missing"))?;
        let mut paths = Vec::new();
        for k in 0..p.count(2)? {
            let boundary = p.pointer(3 + k)?.ok_or_else(|| p.fault("a boundary is missing"))?;
            paths.push(self.boundary(boundary)?);
        }
        let outer = if paths.is_empty() { None } else { Some(usize::MAX) };
        self.face(brep, entry, surface, paths, outer)
    }

    /// The face that is a whole surface.
    pub fn alone(&self, brep: &mut Brep, entry: &Entry) -> Result<(), Fault> {
        // The surface places itself.
        let mut unplaced = *entry;
        unplaced.transform = 0;
        self.face(brep, &unplaced, entry.number, Vec::new(), None)
    }

    /// A curve on a surface (142): in space where it has that.
    fn on_surface(&self, number: u32) -> Result<Path, Fault> {
        let entry = self.known(number)?;
        let p = self.directory.parameters(&entry)?;
        if entry.kind != 142 {
            return Err(p.fault("a curve on a surface is asked for here, which this is not"));
        }
        match (p.pointer(3)?, p.pointer(2)?) {
            (Some(curve), _) => Ok(Path::Space(in_line(self.arcs(curve, 0)?))),
            (None, Some(curve)) => Ok(Path::Parameters(in_line(self.arcs(curve, 0)?))),
            (None, None) => Err(p.fault("it has no curve")),
        }
    }

    /// A boundary (141).
    fn boundary(&self, number: u32) -> Result<Path, Fault> {
        let entry = self.known(number)?;
        let p = self.directory.parameters(&entry)?;
        if entry.kind != 141 {
            return Err(p.fault("a boundary is asked for here, which this is not"));
        }
        let mut at = 4;
        let mut arcs = Vec::new();
        for _ in 0..p.count(3)? {
            let curve = p.pointer(at)?.ok_or_else(|| p.fault("a curve is missing"))?;
            let mut part = self.arcs(curve, 0)?;
            if p.number(at + 1)? == 2.0 {
                part.reverse();
                part = part.iter().map(Arc::reversed).collect();
            }
            arcs.extend(part);
            at += 3 + p.count(at + 2)?;
        }
        if arcs.is_empty() {
            return Err(p.fault("it has no curves"));
        }
        Ok(Path::Space(in_line(arcs)))
    }

    /// Add the face of a surface between these boundaries; `outer` is the place of the one round it, past the end
    /// where that is not known, and None where the surface's own sides are.
    fn face(
        &self,
        brep: &mut Brep,
        entry: &Entry,
        surface: u32,
        paths: Vec<Path>,
        outer: Option<usize>,
    ) -> Result<(), Fault> {
        let place = self.place(entry)?;
        let reach: Vec<DVec3> = paths.iter().flat_map(reach).collect();
        let sheet = self.surface(surface, &reach)?;
        let (part, range) = (sheet.is_part(), sheet.range);
        let kind = self.parametrized(surface)?;
        let shape = Shared::new(sheet.shape);
        let mut rings: Vec<Vec<Coedge>> = Vec::new();
        let mut scrap = Brep::default();
        for path in paths {
            let sides = sides(path, &shape, kind).ok_or_else(|| {
                entry.fault("a boundary is given in parameters alone, on a surface whose parameters are others here")
            })?;
            rings.push(loops::close(&mut scrap, self, &entry.place(), sides)?);
        }
        let seeds = Seeds::new(&shape);
        let areas: Vec<Option<f64>> =
            rings.iter().map(|r| loops::area(&scrap, &shape, &seeds, r)).collect();
        let size = |k: &usize| areas[*k].map_or(f64::INFINITY, f64::abs);
        let largest = (0..rings.len()).max_by(|a, b| size(a).total_cmp(&size(b)));
        let outer = outer.and_then(|o| if o < rings.len() { Some(o) } else { largest });
        for (k, ring) in rings.iter_mut().enumerate() {
            if areas[k].is_some_and(|a| (a > 0.0) != (Some(k) == outer)) {
                loops::flip(ring);
            }
        }
        if let (None, true) = (outer, part) {
            rings.push(frame(&mut scrap, &shape, range));
        }
        let shape = Shape::clone(&shape);
        let open = outer.is_none() && !part && !rings.is_empty();
        scrap.faces.push(BrepFace { shape, loops: rings, reversed: false, label: entry.place() });
        if open {
            bound(&mut scrap, 0).map_err(|e| entry.fault(e.to_string()))?;
        }
        append(brep, scrap, &place);
        Ok(())
    }
}

impl File<'_> {
    /// The type of the surface whose parameters a surface has: offsets have those of their basis.
    fn parametrized(&self, number: u32) -> Result<u32, Fault> {
        let mut entry = self.known(number)?;
        for level in 0.. {
            self.visit(&entry, level)?;
            let basis = self.directory.parameters(&entry)?;
            match basis.pointer(4) {
                Ok(Some(basis)) if entry.kind == 140 => entry = self.known(basis)?,
                _ => break,
            }
        }
        Ok(entry.kind)
    }
}

/// Points along a boundary in space.
fn reach(path: &Path) -> Vec<DVec3> {
    match path {
        Path::Space(arcs) => {
            arcs.iter().flat_map(|a| Side::of(a.clone()).points().collect::<Vec<_>>()).collect()
        }
        Path::Parameters(_) => Vec::new(),
    }
}

/// The curves of a boundary. None where they lie in parameters that are not those of `shape`.
fn sides(path: Path, shape: &Shared<Shape>, kind: u32) -> Option<Vec<Side>> {
    match path {
        Path::Space(arcs) => Some(arcs.into_iter().map(Side::of).collect()),
        Path::Parameters(arcs) => matches!(kind, 114 | 118 | 122 | 128).then(|| {
            let side =
                |a: Arc| Side { range: a.range, curve: Curve::OnShape(shape.clone(), a.curve) };
            arcs.into_iter().map(side).collect()
        }),
    }
}

/// The four sides of a part of a surface.
fn frame(brep: &mut Brep, shape: &Shared<Shape>, range: [[f64; 2]; 2]) -> Vec<Coedge> {
    let [[u0, u1], [v0, v1]] = range;
    let corners = [[u0, v0], [u1, v0], [u1, v1], [u0, v1]].map(DVec2::from);
    let first = brep.vertices.len() as u32;
    let mut coedges = Vec::with_capacity(4);
    for k in 0..4 {
        brep.vertices.push(shape.point(corners[k]));
        let ends = [corners[k], corners[(k + 1) % 4]];
        let curve = Curve::UvLine { shape: shape.clone(), ends };
        let ends = [first + k as u32, first + (k as u32 + 1) % 4];
        brep.edges.push(BrepEdge { curve, range: [0.0, 1.0], ends });
        coedges.push(Coedge { edge: brep.edges.len() as u32 - 1, reversed: false });
    }
    coedges
}

/// Add all of `part`, placed, to `brep`.
pub(super) fn append(brep: &mut Brep, part: Brep, place: &DAffine3) {
    let (vertices, edges) = (brep.vertices.len() as u32, brep.edges.len() as u32);
    brep.vertices.extend(part.vertices.into_iter().map(|v| place.transform_point3(v)));
    brep.edges.extend(part.edges.into_iter().map(|e| BrepEdge {
        curve: placed_curve(e.curve, place),
        range: e.range,
        ends: e.ends.map(|v| v + vertices),
    }));
    for mut face in part.faces {
        face.shape = placed(face.shape, place);
        for c in face.loops.iter_mut().flatten() {
            c.edge += edges;
        }
        brep.faces.push(face);
    }
}

/// A shape at its place.
pub(super) fn placed(shape: Shape, place: &DAffine3) -> Shape {
    let moved = |mut s: NurbsSurface| {
        for p in &mut s.points {
            *p = place.transform_point3(*p);
        }
        s
    };
    match shape {
        Shape::Nurbs(s) => Shape::Nurbs(moved(s)),
        Shape::Offset(s) => {
            // A mirrored surface has its normals on the other side.
            let scale = place.matrix3.determinant().cbrt();
            Shape::Offset(Box::new(OffsetSurface::new(
                moved(s.basis().clone()),
                s.distance() * scale,
            )))
        }
        height @ Shape::Height(_) => height,
    }
}

fn placed_curve(curve: Curve, place: &DAffine3) -> Curve {
    let move_shape = |shape: &Shared<Shape>| Shared::new(placed(Shape::clone(shape), place));
    match curve {
        Curve::Nurbs(mut c) => {
            for p in &mut c.points {
                *p = place.transform_point3(*p);
            }
            Curve::Nurbs(c)
        }
        Curve::OnShape(shape, uv) => Curve::OnShape(move_shape(&shape), uv),
        Curve::UvLine { shape, ends } => Curve::UvLine { shape: move_shape(&shape), ends },
        guide @ Curve::Guide { .. } => guide,
    }
}

/// The entities that a 140, 141, 142, 143 or 144 is made of, as far as they are surfaces or faces.
pub(super) fn parts(kind: u32, p: &Parameters) -> Vec<usize> {
    match kind {
        144 => vec![0],
        140 => vec![4],
        142 | 143 => vec![1],
        141 => vec![2],
        _ => Vec::new(),
    }
    .into_iter()
    .filter(|&k| k < p.len())
    .collect()
}
