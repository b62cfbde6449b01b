//! STEP files (ISO 10303-21; AP203, AP214, AP242): trimmed faces with shared edges.
//!
//! The parser is `step-io`; nothing of it leaves this file. Analytic surfaces and curves come as exact
//! rational B-splines. Assemblies are placed. What cannot be read is left out and noted.

use crate::error::{Error, Result};
use crate::surface::brep::{Brep, BrepEdge, BrepFace, Coedge};
use crate::surface::nurbs::{NurbsCurve, NurbsSurface};
use crate::surface::{Curve, Shape, Source, Unit};
use glam::{DMat4, DVec3};
use std::collections::{HashMap, HashSet};
use std::fs::File;
use std::io::Read;
use std::path::Path;
use step_io::scene::{Edge, Face, ProductDef, Vertex};
use step_io::{EntityKey, Orientation, StepModel};

/// Larger files are refused, bytes.
const MOST_BYTES: u64 = 512 << 20;
/// More faces, counted with every placed copy, are refused.
const MOST_FACES: usize = 100_000;
/// Assemblies nested deeper than this are cut off (some files contain themselves).
const MOST_LEVELS: usize = 32;
/// Notes of one kind beyond this many are only counted.
const MOST_NOTES: usize = 20;
/// A closed edge begins at its vertex when nearer to it than this share of its curve's size.
const AT_VERTEX: f64 = 1e-7;

/// Read the faces of a STEP file.
///
/// # Errors
/// [`Error::Io`] where the file cannot be opened, [`Error::Parse`] where it is no STEP file, too large, or
/// holds no face that can be used.
pub fn read(path: &Path) -> Result<Brep> {
    let io = |source| Error::Io { path: path.to_path_buf(), source };
    let file = File::open(path).map_err(io)?;
    if file.metadata().map_err(io)?.len() > MOST_BYTES {
        return Err(fault(path, "file", &format!("larger than {} MB", MOST_BYTES >> 20)));
    }
    let name = path.file_stem().and_then(|s| s.to_str()).unwrap_or("surface").to_owned();
    let mut brep =
        parse(file.take(MOST_BYTES)).map_err(|(place, what)| fault(path, &place, &what))?;
    brep.name = name;
    Ok(brep)
}

fn fault(path: &Path, place: &str, what: &str) -> Error {
    Error::Parse { path: path.to_path_buf(), place: place.into(), message: what.into() }
}

/// Read the faces from the text of a STEP file; place and sentence on failure.
fn parse(text: impl Read) -> std::result::Result<Brep, (String, String)> {
    let (model, report) = step_io::read(text).map_err(|e| ("file".to_owned(), e.to_string()))?;
    let scene = model.scene();
    let mut reading =
        Reading { brep: Brep { unit_in_metres: 0.001, ..Brep::default() }, ..Reading::default() };
    match scene.units().length {
        Some(unit) if unit.to_si.is_finite() && unit.to_si > 0.0 => {
            reading.brep.unit_in_metres = unit.to_si;
        }
        _ => {
            reading
                .brep
                .notes
                .push("the file names no unit of length: taken as millimetres".into());
        }
    }
    let precision = scene.units().precision.filter(|p| p.is_finite() && *p > 0.0);
    reading.brep.tolerance = precision.unwrap_or(0.0) * reading.brep.unit_in_metres;
    reading.brep.source = source(&model);
    let metres = DMat4::from_scale(DVec3::splat(reading.brep.unit_in_metres));
    for root in scene.root_definitions() {
        reading.definition(&root, metres, 0)?;
    }
    // Faces outside any product, as bare files have them.
    for face in scene.all_faces() {
        if !reading.seen.contains(&face.key()) {
            reading.face(&face, metres, 0)?;
        }
    }
    let mut brep = reading.brep;
    note_some(
        &mut brep.notes,
        report.dropped.iter().map(|(id, why)| format!("#{id} left out: {why}")),
    );
    note_some(&mut brep.notes, report.parse_warnings.iter().map(ToString::to_string));
    note_some(&mut brep.notes, scene.warnings().iter().map(ToString::to_string));
    if brep.faces.is_empty() {
        let why = brep.notes.iter().take(3).cloned().collect::<Vec<_>>().join("; ");
        let why = if why.is_empty() { why } else { format!(" ({why})") };
        return Err(("data section".into(), format!("no face that can be used{why}")));
    }
    Ok(brep)
}

/// What the header says, and the unit.
fn source(model: &StepModel) -> Source {
    let header = model.header();
    let told = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let system = told(&header.originating_system);
    let processor = told(&header.preprocessor_version);
    let application = if system.is_empty() { processor } else { system };
    let unit = model.scene().units().length.map(|unit| unit.to_si);
    let unit = unit.filter(|m| m.is_finite() && *m > 0.0).map(Unit::of_metres);
    Source { version: header.schema.to_string(), application, unit, ..Source::of_format("STEP") }
}

/// Add the first notes of a kind and the number of the rest.
fn note_some(notes: &mut Vec<String>, more: impl Iterator<Item = String>) {
    let more: Vec<String> = more.collect();
    notes.extend(more.iter().take(MOST_NOTES).cloned());
    if more.len() > MOST_NOTES {
        notes.push(format!("and {} more like the last", more.len() - MOST_NOTES));
    }
}

/// A file while it is read.
#[derive(Default)]
struct Reading {
    brep: Brep,
    /// Faces that some product placed.
    seen: HashSet<EntityKey>,
    /// Edges and vertices of each placed copy.
    edges: HashMap<(usize, EntityKey), u32>,
    vertices: HashMap<(usize, EntityKey), u32>,
    /// Placed copies so far; 0 is for faces outside any product.
    copies: usize,
}

type Fatal = (String, String);

impl Reading {
    /// Everything in a product definition and the parts placed in it.
    fn definition(
        &mut self,
        part: &ProductDef,
        place: DMat4,
        level: usize,
    ) -> std::result::Result<(), Fatal> {
        if level > MOST_LEVELS {
            self.brep.notes.push("an assembly is nested too deep: the rest is left out".into());
            return Ok(());
        }
        self.copies += 1;
        let copy = self.copies;
        if copy > MOST_FACES {
            return Err(("assembly".into(), format!("places more than {MOST_FACES} parts")));
        }
        for solid in part.solids() {
            for face in solid.faces() {
                self.face(&face, place, copy)?;
            }
        }
        for sheet in part.surface_models() {
            for face in sheet.faces() {
                self.face(&face, place, copy)?;
            }
        }
        for o in part.occurrences() {
            let Some(child) = o.definition() else { continue };
            let local = o
                .transform()
                .and_then(|t| t.matrix())
                .map_or(DMat4::IDENTITY, |m| DMat4::from_cols_array_2d(&m).transpose());
            self.definition(&child, place * local, level + 1)?;
        }
        Ok(())
    }

    /// One face; left out with a note where it cannot be used.
    fn face(&mut self, face: &Face, place: DMat4, copy: usize) -> std::result::Result<(), Fatal> {
        self.seen.insert(face.key());
        if self.brep.faces.len() >= MOST_FACES {
            return Err(("data section".into(), format!("more than {MOST_FACES} faces")));
        }
        match self.try_face(face, place, copy) {
            Ok(face) => self.brep.faces.push(face),
            Err(why) => {
                let name = match face.name() {
                    "" => String::new(),
                    name => format!(" '{name}'"),
                };
                self.brep.notes.push(format!("{:?}{name} left out: {why}", face.key()));
            }
        }
        Ok(())
    }

    fn try_face(
        &mut self,
        face: &Face,
        place: DMat4,
        copy: usize,
    ) -> std::result::Result<BrepFace, String> {
        let surface = face.to_nurbs().ok_or("its surface has no exact form here")?;
        let count =
            [surface.control_points.len(), surface.control_points.first().map_or(0, Vec::len)];
        let points =
            surface.control_points.iter().flatten().map(|&p| place.transform_point3(p.into()));
        let shape = NurbsSurface::new(
            [surface.degree_u, surface.degree_v],
            [surface.knots_u, surface.knots_v],
            count,
            points.collect(),
            plain(surface.weights.into_iter().flatten().collect()),
        )
        .map_err(|e| e.to_string())?;
        let mut loops = Vec::new();
        for bound in face.bounds() {
            let mut coedges = Vec::new();
            for (edge, orientation) in bound.oriented_edges() {
                let reversed = orientation == Orientation::Reversed;
                coedges.push(Coedge { edge: self.edge(&edge, place, copy)?, reversed });
            }
            if bound.orientation() == Orientation::Reversed {
                coedges.reverse();
                for c in &mut coedges {
                    c.reversed = !c.reversed;
                }
            }
            // A loop of a single vertex only marks a pole.
            if !coedges.is_empty() {
                loops.push(coedges);
            } else if bound.vertex().is_none() {
                return Err("a boundary loop is missing".into());
            }
        }
        let reversed = face.orientation() == Orientation::Reversed;
        Ok(BrepFace { shape: Shape::Nurbs(shape), loops, reversed })
    }

    fn edge(&mut self, edge: &Edge, place: DMat4, copy: usize) -> std::result::Result<u32, String> {
        let key = (copy, edge.key());
        if let Some(&known) = self.edges.get(&key) {
            return Ok(known);
        }
        let mut end =
            |v: Option<Vertex>| self.vertex(v, place, copy).ok_or("an edge has no vertex");
        let ends = [end(edge.start())?, end(edge.end())?];
        let curve = edge.to_nurbs().ok_or("an edge has no exact form here")?;
        let points = curve.control_points.iter().map(|&p| place.transform_point3(p.into()));
        let curve =
            NurbsCurve::new(curve.degree, curve.knots, points.collect(), plain(curve.weights))
                .map_err(|e| format!("an edge: {e}"))?;
        let at = self.brep.vertices[ends[0] as usize];
        let closed = ends[0] == ends[1];
        // The parser hands on whole closed curves as they stand, whichever way the edge runs.
        let curve = if closed && !edge.same_sense() { backwards(&curve) } else { curve };
        let range = if closed { range_from(&curve, at) } else { curve.domain() };
        self.brep.edges.push(BrepEdge { curve: Curve::Nurbs(curve), range, ends });
        let id = self.brep.edges.len() as u32 - 1;
        self.edges.insert(key, id);
        Ok(id)
    }

    fn vertex(&mut self, vertex: Option<Vertex>, place: DMat4, copy: usize) -> Option<u32> {
        let vertex = vertex?;
        let key = (copy, vertex.key());
        if let Some(&known) = self.vertices.get(&key) {
            return Some(known);
        }
        let at = place.transform_point3(vertex.point()?.xyz().into());
        if !at.is_finite() {
            return None;
        }
        self.brep.vertices.push(at);
        let id = self.brep.vertices.len() as u32 - 1;
        self.vertices.insert(key, id);
        Some(id)
    }
}

/// Weights, or none where all are 1.
fn plain(weights: Vec<f64>) -> Vec<f64> {
    if weights.iter().all(|&w| w == 1.0) { Vec::new() } else { weights }
}

/// The same curve run from its end to its start.
fn backwards(curve: &NurbsCurve) -> NurbsCurve {
    let mut back = curve.clone();
    back.points.reverse();
    back.weights.reverse();
    back.knots = curve.knots.iter().rev().map(|k| -k).collect();
    back
}

/// The range of a closed curve that begins and ends at `at`.
fn range_from(curve: &NurbsCurve, at: DVec3) -> [f64; 2] {
    let [a, b] = curve.domain();
    let whole = Curve::Nurbs(curve.clone());
    let probe = |i: i32| a + (b - a) * f64::from(i) / 64.0;
    let size = (0..64).map(|i| curve.point(probe(i)).distance(at)).fold(0.0, f64::max);
    if !curve.closed() || curve.point(a).distance(at) <= AT_VERTEX * size {
        return [a, b];
    }
    let near = (0..64)
        .map(probe)
        .min_by(|&s, &t| curve.point(s).distance(at).total_cmp(&curve.point(t).distance(at)))
        .unwrap_or(a);
    let (t, _) = whole.project(near, [a, b], at);
    [t, t + (b - a)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::{Sampling, tessellate};

    /// A plate of 4 x 2 (in the unit) in the plane z = 1 with a round hole of radius 0.5; the hole's circle
    /// is run backwards and begins a quarter past the circle's own start.
    fn plate(unit: &str, plane: &str) -> String {
        use std::fmt::Write;
        let corners = ["0.,0.,1.", "4.,0.,1.", "4.,2.,1.", "0.,2.,1."];
        let ways = ["1.,0.,0.", "0.,1.,0.", "-1.,0.,0.", "0.,-1.,0."];
        let mut data = String::new();
        for (i, (corner, way)) in corners.iter().zip(ways).enumerate() {
            let next = (i + 1) % 4;
            writeln!(
                data,
                "#1{i}=CARTESIAN_POINT('',({corner}));#2{i}=VERTEX_POINT('',#1{i});
#3{i}=DIRECTION('',({way}));#4{i}=VECTOR('',#3{i},1.);#5{i}=LINE('',#1{i},#4{i});
#6{i}=EDGE_CURVE('',#2{i},#2{next},#5{i},.T.);#7{i}=ORIENTED_EDGE('',*,*,#6{i},.T.);"
            )
            .unwrap();
        }
        format!(
            "ISO-10303-21;HEADER;FILE_DESCRIPTION((''),'2;1');
FILE_NAME('','',(''),(''),'','','');FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));ENDSEC;DATA;
#1=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT({unit},.METRE.));
#2=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));
#3=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());
#4=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#1,#2,#3))
REPRESENTATION_CONTEXT('',''));
{data}#80=EDGE_LOOP('',(#70,#71,#72,#73));#81=FACE_BOUND('',#80,.T.);
#90=CARTESIAN_POINT('',(2.,1.,1.));#91=DIRECTION('',(0.,0.,1.));#92=DIRECTION('',(1.,0.,0.));
#93=AXIS2_PLACEMENT_3D('',#90,#91,#92);#94=CIRCLE('',#93,0.5);
#95=CARTESIAN_POINT('',(2.,1.5,1.));#96=VERTEX_POINT('',#95);
#97=EDGE_CURVE('',#96,#96,#94,.F.);#98=ORIENTED_EDGE('',*,*,#97,.T.);
#99=EDGE_LOOP('',(#98));#100=FACE_BOUND('',#99,.T.);
#101={plane};
#102=ADVANCED_FACE('plate',(#81,#100),#101,.T.);
#103=OPEN_SHELL('',(#102));#104=SHELL_BASED_SURFACE_MODEL('',(#103));
#105=MANIFOLD_SURFACE_SHAPE_REPRESENTATION('',(#104),#4);
ENDSEC;END-ISO-10303-21;
"
        )
    }

    #[test]
    fn plate_with_a_hole_is_read_in_its_unit() {
        for (name, unit) in [("$", 1.0), (".MILLI.", 0.001)] {
            let brep = parse(plate(name, "PLANE('',#93)").as_bytes()).unwrap();
            assert_eq!((brep.faces.len(), brep.edges.len(), brep.vertices.len()), (1, 5, 5));
            assert_eq!(brep.unit_in_metres, unit);
            assert_eq!(brep.source.version, "AP214");
            assert_eq!(brep.source.unit.as_ref().unwrap().metres, unit);
            let sampling =
                Sampling { max_edge: 0.3 * unit, chord_error: 0.002 * unit, corner_angle: 0.5 };
            let surface = tessellate(&brep, &sampling).unwrap();
            assert_eq!(surface.loops.len(), 2);
            assert_eq!(surface.loops[0].corners.len(), 4);
            assert!(surface.loops[1].corners.is_empty());
            let exact = (8.0 - 0.25 * std::f64::consts::PI) * unit * unit;
            assert!((surface.area / exact - 1.0).abs() < 1e-5, "{}", surface.area);
        }
    }

    #[test]
    fn closed_edge_begins_at_its_vertex_and_runs_its_way() {
        let brep = parse(plate("$", "PLANE('',#93)").as_bytes()).unwrap();
        let hole = brep.edges.iter().find(|e| e.ends[0] == e.ends[1]).unwrap();
        let [a, b] = hole.range;
        assert!(hole.curve.point(a).distance(DVec3::new(2.0, 1.5, 1.0)) < 1e-9);
        assert!(hole.curve.point(b).distance(DVec3::new(2.0, 1.5, 1.0)) < 1e-9);
        // Against the circle's own direction: from the top of the hole to the right.
        assert!(hole.curve.point(a + 0.1 * (b - a)).x > 2.1);
    }

    #[test]
    fn unknown_surface_is_named_not_swallowed() {
        let (_, what) = parse(plate("$", "FANCY_SURFACE('',#93)").as_bytes()).unwrap_err();
        assert!(what.contains("no face") && what.contains("FANCY_SURFACE"), "{what}");
    }

    #[test]
    fn text_that_is_no_step_file_is_an_error() {
        for text in ["", "solid cube", "ISO-10303-21;HEADER;ENDSEC;DATA;#1=", "ISO-10303-21;"] {
            assert!(parse(text.as_bytes()).is_err());
        }
    }

    #[test]
    fn missing_file_is_named() {
        let e = read(Path::new("no/such/roof.step")).unwrap_err().to_string();
        assert!(e.contains("roof.step"), "{e}");
    }
}
