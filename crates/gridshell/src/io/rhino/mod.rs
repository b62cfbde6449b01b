//! Rhino files (3DM, Rhino 1 to 8): breps, surfaces, extrusions and meshes.
//!
//! The decoder is `cadmpeg-codec-rhino`; nothing of it leaves this room. It hands everything on in millimetres and
//! places what blocks contain. Exact faces are taken before meshes; what the file hides is left out unless it is chosen.

mod convert;

use super::soup::Soup;
use super::{Choice, LengthUnit, Opening, file, weld};
use crate::error::{Error, Result};
use crate::job::Job;
use crate::surface::brep::{Brep, BrepEdge, BrepFace, Coedge};
use crate::surface::nurbs::NurbsCurve;
use crate::surface::{Curve, Model, Object, PolygonMesh, Shape, Source, Unit};
use cadmpeg_codec_rhino::RhinoCodec;
use cadmpeg_ir::document::Model as Arenas;
use cadmpeg_ir::report::Severity;
use cadmpeg_ir::report::loss::LossCategory as Category;
use cadmpeg_ir::topology::{Coedge as Trim, Face, LoopBoundary, Sense};
use cadmpeg_ir::units::FiniteVector;
use cadmpeg_ir::{
    CadIr, Codec, DecodeOptions, SourceGeometryRole as Role, SourceObjectAssociation as Owner,
};
use convert::{METRES, Read};
use glam::DVec3;
use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;
use std::sync::Arc;

/// What the decoder may use, over the size of the file: enough for every sound file seen, and not more memory than
/// a small machine has.
const MOST_BYTES: u64 = 256 << 20;
const MOST_RETAINED: u64 = 768 << 20;
/// Curves whose ends are farther apart than this share of their length are not the same edge.
const NEAR: f64 = 0.01;
/// Notes of one kind beyond this many are only counted.
const MOST_NOTES: usize = 10;

/// Read the chosen objects of a 3DM file.
///
/// # Errors
/// [`Error::Io`] where the file cannot be read, [`Error::Parse`] where it is no 3DM file or holds no surface,
/// [`Error::Option`] for a layer or an object that is not there.
pub(super) fn read(path: &Path, choice: &Choice, job: &Job) -> Result<Model> {
    let bytes = file::read(path, job)?;
    let fault = |place: &str, message: String| Error::Parse {
        path: path.to_path_buf(),
        place: place.into(),
        message,
    };
    if bytes.len() as u64 > MOST_BYTES {
        let message = format!("larger than {} MB; save only the surface wanted", MOST_BYTES >> 20);
        return Err(fault("file", message));
    }
    let version = version(&bytes);
    let mut options = DecodeOptions::default();
    options.policy.limits.max_input_bytes = MOST_BYTES;
    options.policy.limits.max_retained_bytes = MOST_RETAINED;
    options.policy.limits.max_decompressed_bytes_total = MOST_RETAINED;
    let decoded = RhinoCodec.decode(&mut Cursor::new(bytes), &options);
    let (ir, report, _) = decoded
        .map_err(|e| fault("file", format!("{e}; open it in Rhino and save it again")))?
        .into_parts();
    let mut reading = Reading::new(&ir);
    reading.objects();
    choice.check(path, &reading.listed)?;
    reading.choose(choice);
    reading.faces();
    let lost = report.losses.iter().filter(|loss| {
        let of_shape = matches!(loss.code.category(), Category::Geometry | Category::Topology);
        of_shape && loss.severity != Severity::Info
    });
    reading.told(lost.map(|loss| loss.message.clone()));
    reading.finish(path, version, job)
}

/// A file while it is read.
struct Reading<'a> {
    ir: &'a CadIr,
    arenas: &'a Arenas,
    /// Layers by their identifier.
    layers: BTreeMap<String, Layer>,
    /// Place in `listed` of each of the file's objects, by identifier and place among nested blocks.
    number: BTreeMap<(Vec<String>, String), usize>,
    listed: Vec<Object>,
    /// Whether the file shows the object, and whether it is read.
    shown: Vec<bool>,
    taken: Vec<bool>,
    brep: Brep,
    mesh: Soup,
    /// Places of edges and vertices in the brep; None for an edge of no length.
    edges: BTreeMap<String, Option<u32>>,
    vertices: BTreeMap<String, u32>,
}

impl<'a> Reading<'a> {
    fn new(ir: &'a CadIr) -> Reading<'a> {
        Reading {
            ir,
            arenas: &ir.model,
            layers: layers(ir),
            number: BTreeMap::new(),
            listed: Vec::new(),
            shown: Vec::new(),
            taken: Vec::new(),
            brep: Brep { unit_in_metres: 0.001, ..Brep::default() },
            mesh: Soup::default(),
            edges: BTreeMap::new(),
            vertices: BTreeMap::new(),
        }
    }

    /// List all objects that hold faces.
    fn objects(&mut self) {
        let arenas = self.arenas;
        let mut used: Vec<&str> = Vec::new();
        for face in &arenas.faces {
            used.push(face.surface.as_str());
            if let Some(owner) = self.owner(face) {
                self.object(owner, "brep");
            }
        }
        used.sort_unstable();
        for surface in &arenas.surfaces {
            if let Some(owner) = loose(surface.source_object.as_ref(), surface.id.as_str(), &used) {
                let kind =
                    if surface.id.as_str().contains(".lateral-") { "extrusion" } else { "surface" };
                self.object(owner, kind);
            }
        }
        for mesh in &arenas.tessellations {
            // What an exact object is shown by is no object of its own.
            if let Some(owner) = &mesh.source_object {
                self.object(owner, "mesh");
            }
        }
    }

    /// The number of an object, listed now if it is not yet.
    fn object(&mut self, owner: &Owner, kind: &str) -> usize {
        let key = (owner.instance_path.clone(), owner.object_id.to_string());
        if let Some(&known) = self.number.get(&key) {
            return known;
        }
        let id = owner.layer.clone().unwrap_or_default();
        let known = self.layers.get(&id);
        let shown = owner.visible != Some(false) && known.is_none_or(|layer| layer.shown);
        let layer = known.map_or(id.clone(), |layer| layer.path.clone());
        let name = owner.name.clone().unwrap_or_default();
        self.listed.push(Object { name, layer, kind: kind.to_owned(), faces: 0 });
        self.shown.push(shown);
        self.number.insert(key, self.listed.len() - 1);
        self.listed.len() - 1
    }

    fn owner(&self, face: &Face) -> Option<&'a Owner> {
        let surfaces = &self.arenas.surfaces;
        // Arenas are sorted by identifier.
        let k = surfaces.binary_search_by(|s| s.id.as_str().cmp(face.surface.as_str())).ok()?;
        surfaces[k].source_object.as_ref()
    }

    fn choose(&mut self, choice: &Choice) {
        let objects = self.listed.iter().zip(&self.shown);
        self.taken = objects.map(|(object, &shown)| choice.takes(object, shown)).collect();
        let hidden = self.taken.iter().zip(&self.shown).filter(|&(t, s)| !t && !s).count();
        if hidden > 0 && choice.is_all() {
            self.brep.notes.push(format!(
                "{hidden} hidden objects left out; choose them by layer or name to read them"
            ));
        }
    }

    /// Read all taken faces, surfaces and meshes.
    fn faces(&mut self) {
        let arenas = self.arenas;
        let mut used: Vec<&str> = arenas.faces.iter().map(|f| f.surface.as_str()).collect();
        used.sort_unstable();
        for face in &arenas.faces {
            let Some(owner) = self.owner(face) else { continue };
            let object = self.object(owner, "brep");
            if self.taken[object] {
                let read = self.trimmed(face);
                self.keep(object, face.id.as_str(), read);
            }
        }
        for surface in &arenas.surfaces {
            let Some(owner) = loose(surface.source_object.as_ref(), surface.id.as_str(), &used)
            else {
                continue;
            };
            let object = self.object(owner, "surface");
            if self.taken[object] {
                let whole = convert::surface(&surface.geometry, &[]).map(|shape| BrepFace {
                    shape,
                    loops: Vec::new(),
                    reversed: false,
                });
                self.keep(object, surface.id.as_str(), whole);
            }
        }
        for mesh in &arenas.tessellations {
            let Some(owner) = &mesh.source_object else { continue };
            let object = self.object(owner, "mesh");
            if self.taken[object] && self.listed[object].kind == "mesh" {
                let first = self.mesh.points.len() as u32;
                self.mesh.points.extend(mesh.vertices().iter().map(|p| convert::point(**p)));
                let faces = mesh.triangles();
                self.listed[object].faces += faces.len();
                self.mesh.faces.extend(faces.iter().map(|t| t.map(|v| v + first).to_vec()));
            }
        }
    }

    /// Enter a face, or why it is none.
    fn keep(&mut self, object: usize, id: &str, face: Read<BrepFace>) {
        match face {
            Ok(face) => {
                self.listed[object].faces += 1;
                self.brep.object_of.push(object as u32);
                self.brep.faces.push(face);
            }
            Err(why) => {
                let told = self.listed[object].told();
                self.brep.notes.push(format!("{told}: {id} left out: {why}"));
            }
        }
    }

    /// A face with its loops.
    fn trimmed(&mut self, face: &Face) -> Read<BrepFace> {
        let arenas = self.arenas;
        let reversed = face.sense == Sense::Reversed;
        let k = arenas.surfaces.binary_search_by(|s| s.id.as_str().cmp(face.surface.as_str()));
        let surface = &arenas.surfaces[k.map_err(|_| "its surface is missing".to_owned())?];
        // A plane is drawn on in other parameters than ours.
        let drawn_on = convert::whole(&surface.geometry)?.map(Arc::new);
        let mut loops = Vec::new();
        for id in &face.loops {
            let at = arenas.loops.binary_search_by(|l| l.id.cmp(id));
            let ring = at.map_err(|_| format!("its loop {id} is missing"))?;
            let LoopBoundary::Ring(ring) = &arenas.loops[ring].boundary else { continue };
            let mut coedges = Vec::new();
            for id in ring.coedges() {
                let at = arenas.coedges.binary_search_by(|c| c.id.cmp(id));
                let trim = &arenas.coedges[at.map_err(|_| format!("its trim {id} is missing"))?];
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
        Ok(BrepFace { shape, loops, reversed })
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
        let curve = convert::trim(&self.arenas.pcurves[k].geometry)?;
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
        let edge = &arenas.edges[at.map_err(|_| format!("its edge {id} is missing"))?];
        let carrier = edge.curve().and_then(|id| {
            arenas.curves.binary_search_by(|c| c.id.cmp(id)).ok().map(|k| &arenas.curves[k])
        });
        let place = match carrier {
            None => None,
            Some(carrier) => {
                let range = edge.param_range().map(FiniteVector::get);
                let curve = convert::curve(&carrier.geometry, range)
                    .map_err(|why| format!("its edge {id}: {why}"))?;
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
        let missing = |_| format!("its vertex {id} is missing");
        let vertex =
            arenas.vertices.binary_search_by(|v| v.id.as_str().cmp(id)).map_err(missing)?;
        let point = &arenas.vertices[vertex].point;
        let at = arenas.points.binary_search_by(|p| p.id.cmp(point)).map_err(missing)?;
        self.brep.vertices.push(convert::reached(convert::point(*arenas.points[at].position()))?);
        let number = self.brep.vertices.len() as u32 - 1;
        self.vertices.insert(id.to_owned(), number);
        Ok(number)
    }

    /// Tell what was lost, the first ones in full.
    fn told(&mut self, lost: impl Iterator<Item = String>) {
        let lost: Vec<String> = lost.collect();
        self.brep.notes.extend(lost.iter().take(MOST_NOTES).cloned());
        if lost.len() > MOST_NOTES {
            self.brep.notes.push(format!("and {} more like the last", lost.len() - MOST_NOTES));
        }
    }

    fn finish(mut self, path: &Path, version: String, job: &Job) -> Result<Model> {
        let source = Source { version, ..source(self.ir, self.listed) };
        let notes = std::mem::take(&mut self.brep.notes);
        if self.brep.faces.is_empty() && !self.mesh.faces.is_empty() {
            // The decoder has brought it to metres.
            let soup = Soup { notes, unit: Some(LengthUnit::Metre), ..self.mesh };
            let mesh = weld::weld(path, soup, &Opening::default(), job)?;
            return Ok(Model::Mesh(PolygonMesh { source, ..mesh }));
        }
        if self.brep.faces.is_empty() {
            let why = notes.iter().take(3).cloned().collect::<Vec<_>>().join("; ");
            let why = if why.is_empty() { why } else { format!(" ({why})") };
            let message = if source.unit.is_none() {
                "the file states no unit of length; choose one in Rhino and save it again".into()
            } else {
                format!("no surface, brep, extrusion or mesh that can be used{why}")
            };
            return Err(Error::Parse {
                path: path.to_path_buf(),
                place: "objects".into(),
                message,
            });
        }
        self.brep.name = file::stem(path);
        self.brep.unit_in_metres = source.unit.as_ref().map_or(METRES, |unit| unit.metres);
        self.brep.source = source;
        self.brep.notes = notes;
        if !self.mesh.faces.is_empty() {
            self.brep.notes.push(format!(
                "meshes of {} faces left out beside exact surfaces; choose them by layer or name to read them",
                self.mesh.faces.len()
            ));
            for object in self.brep.source.objects.iter_mut().filter(|o| o.kind == "mesh") {
                object.faces = 0;
            }
        }
        Ok(Model::Brep(self.brep))
    }
}

/// Length of a curve over a range, by chords.
fn length(curve: &Curve, [a, b]: [f64; 2]) -> f64 {
    let at = |k: u32| curve.point(a + (b - a) * f64::from(k) / 16.0);
    (0..16).map(|k| at(k).distance(at(k + 1))).sum()
}

/// The object of a surface that belongs to no face and helps no other geometry.
fn loose<'a>(owner: Option<&'a Owner>, id: &str, used: &[&str]) -> Option<&'a Owner> {
    let owner = owner?;
    let helps = owner.geometry_role == Some(Role::Support);
    (!helps && used.binary_search(&id).is_err()).then_some(owner)
}

/// A layer.
struct Layer {
    /// Its name behind those of the layers that hold it: `Roof::Panels`.
    path: String,
    /// Neither it nor one that holds it is hidden.
    shown: bool,
}

/// All layers by their identifier.
fn layers(ir: &CadIr) -> BTreeMap<String, Layer> {
    let mut known: BTreeMap<String, (String, Option<String>, bool)> = BTreeMap::new();
    let records = ir.native.namespace("rhino").and_then(|n| n.arenas().get("layers"));
    for record in records.into_iter().flatten() {
        let text = |field: &str| record.field(field)?.as_str().map(str::to_owned);
        let shown = record.field("visible").and_then(|v| v.as_bool()) != Some(false);
        if let (Some(id), Some(name)) = (text("source_uuid"), text("name")) {
            known.insert(id, (name, text("parent_uuid"), shown));
        }
    }
    let layer = |id: &String| {
        let (mut path, mut parent, mut shown) = known[id].clone();
        // No deeper than there are layers: some files have cycles.
        for _ in 0..known.len() {
            let Some((name, above, on)) = parent.as_ref().and_then(|p| known.get(p)) else { break };
            path = format!("{name}::{path}");
            shown &= on;
            parent.clone_from(above);
        }
        Layer { path, shown }
    };
    known.keys().map(|id| (id.clone(), layer(id))).collect()
}

/// The version of Rhino by the file's first 32 bytes: a text and a number of eight digits, blanks before it.
fn version(bytes: &[u8]) -> String {
    let digits = bytes.get(24..32).map(String::from_utf8_lossy).unwrap_or_default();
    match digits.trim().parse::<u32>() {
        // From Rhino 5 on there is a digit for changes within a version.
        Ok(n) if n >= 50 => format!("Rhino {}", n / 10),
        Ok(n) => format!("Rhino {n}"),
        Err(_) => String::new(),
    }
}

/// What the file says of itself.
fn source(ir: &CadIr, objects: Vec<Object>) -> Source {
    let meta = ir.source.as_ref();
    let attribute = |name: &str| {
        let found = meta?.attributes.iter().find(|(key, _)| key.as_str() == name);
        found.map(|(_, value)| value.trim().to_owned()).filter(|value| !value.is_empty())
    };
    let unit = attribute("millimeters_per_unit").and_then(|mm| mm.parse::<f64>().ok());
    let unit = unit.filter(|mm| mm.is_finite() && *mm > 0.0).map(|mm| Unit::of_metres(mm * METRES));
    let name = attribute("application_name");
    let details = attribute("application_details");
    let application = [name, details].into_iter().flatten().collect::<Vec<_>>().join(", ");
    Source { application, unit, objects, ..Source::of_format("3DM") }
}
