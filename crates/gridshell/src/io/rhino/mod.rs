//! Rhino files (3DM, Rhino 1 to 8): breps, surfaces, extrusions and meshes.
//!
//! The decoder is `cadmpeg-codec-rhino`; nothing of it leaves this room. It hands everything on in millimetres.
//! Exact faces are taken before meshes; what the file hides is left out unless it is chosen.
//!
//! `objects` lists what there is, and holds it against the file's own `table`, as the decoder drops what it does not
//! understand; `faces`, `convert` and `curves` make faces; `meshes` adds meshes, also in the place of exact faces that
//! cannot be read; `blocks` puts what blocks are made of at their places; `source` tells what the file says of itself.

mod blocks;
mod convert;
mod curves;
mod faces;
mod meshes;
mod objects;
mod source;
mod table;

use super::mesh::soup::Soup;
use super::{Choice, Opening, READING, file, mesh};
use crate::error::{Error, Result};
use crate::job::Job;
use crate::surface::brep::{Brep, BrepFace};
use crate::surface::{Loss, Model, Object, PolygonMesh, Source};
use blocks::{Blocks, Place};
use cadmpeg_codec_rhino::RhinoCodec;
use cadmpeg_ir::document::Model as Arenas;
use cadmpeg_ir::report::Severity;
use cadmpeg_ir::report::loss::LossCategory as Category;
use cadmpeg_ir::{CadIr, Codec, DecodeOptions, SourceObjectAssociation as Owner};
use convert::{METRES, Read};
use glam::DVec3;
use meshes::Meshed;
use source::Layer;
use std::collections::BTreeMap;
use std::io::Cursor;
use std::path::Path;
use std::sync::Arc;
use table::{Kind, Row};

/// What the decoder may use, over the size of the file: enough for every sound file seen, and not more memory than
/// a small machine has.
const MOST_BYTES: u64 = 256 << 20;
const MOST_RETAINED: u64 = 768 << 20;

/// Read the chosen objects of a 3DM file.
///
/// # Errors
/// [`Error::Io`] where the file cannot be read, [`Error::Parse`] where it is no 3DM file or holds no surface,
/// [`Error::Option`] for a layer or an object that is not there.
pub(super) fn read(path: &Path, choice: &Choice, job: &Job) -> Result<Model> {
    let bytes = file::read(path, job)?;
    if bytes.len() as u64 > MOST_BYTES {
        let message = format!("larger than {} MB; save only the surface wanted", MOST_BYTES >> 20);
        return Err(fault(path, "file", message));
    }
    job.check(READING)?;
    let version = source::version(&bytes);
    let table = table::rows(&bytes);
    let bytes = Arc::new(bytes);
    let (mut ir, mut faults) = decoded(path, &bytes, job)?;
    let mut blocks = Blocks::default();
    if table.iter().any(|row| row.kind == Kind::Block) {
        blocks = Blocks::of(&ir);
        drop(ir);
        let bytes = Arc::unwrap_or_clone(bytes);
        (ir, _) = decoded(path, &Arc::new(table::without_blocks(bytes)), job)?;
        // It finds fault with every block now.
        faults = 0;
    }
    job.check(READING)?;
    let mut reading = Reading::new(&ir, table, blocks);
    reading.objects();
    choice.check(path, &reading.listed)?;
    reading.choose(choice);
    reading.lose_unread();
    reading.faces();
    reading.meshes();
    reading.place(choice);
    let exact = !reading.brep.faces.is_empty();
    if exact {
        reading.beside(path, choice, job);
    }
    reading.doubt(faults);
    reading.finish(path, version, job)
}

/// What the decoder makes of a file, and how many faults of geometry it tells.
fn decoded(path: &Path, bytes: &Arc<Vec<u8>>, job: &Job) -> Result<(CadIr, usize)> {
    let mut options = DecodeOptions::default();
    options.policy.limits.max_input_bytes = MOST_BYTES;
    options.policy.limits.max_retained_bytes = MOST_RETAINED;
    options.policy.limits.max_decompressed_bytes_total = MOST_RETAINED;
    let bytes = Arc::clone(bytes);
    let decode = move || RhinoCodec.decode(&mut Cursor::new(bytes.as_slice()), &options);
    let decoded = job.apart(READING, decode)?;
    let (ir, report, _) = decoded
        .map_err(|e| fault(path, "file", format!("{e}; open it in Rhino and save it again")))?
        .into_parts();
    let faults = report.losses.iter().filter(|loss| {
        let of_shape = matches!(loss.code.category(), Category::Geometry | Category::Topology);
        of_shape && loss.severity != Severity::Info
    });
    let count = faults.count();
    Ok((ir, count))
}

fn fault(path: &Path, place: &str, message: String) -> Error {
    Error::Parse { path: path.to_path_buf(), place: place.into(), message }
}

/// A file while it is read.
struct Reading<'a> {
    ir: &'a CadIr,
    arenas: &'a Arenas,
    /// The file's own list of objects.
    table: Vec<Row>,
    blocks: Blocks,
    /// Where the members of blocks are placed.
    places: Vec<Place>,
    /// Layers by their identifier.
    layers: BTreeMap<String, Layer>,
    /// Place in `listed` of each of the file's objects, by identifier and place among nested blocks.
    number: BTreeMap<(Vec<String>, String), usize>,
    listed: Vec<Object>,
    /// Whether the file shows the object, and whether it is read.
    shown: Vec<bool>,
    taken: Vec<bool>,
    /// Objects that the decoder made nothing of, and why.
    unread: BTreeMap<usize, String>,
    /// Faces that could not be read, with their identifiers and why, by object.
    failed: BTreeMap<usize, Vec<(String, String)>>,
    meshed: Vec<Meshed>,
    losses: Vec<Loss>,
    brep: Brep,
    /// Places of edges and vertices in the brep; None for an edge of no length.
    edges: BTreeMap<String, Option<u32>>,
    vertices: BTreeMap<String, u32>,
}

impl<'a> Reading<'a> {
    fn new(ir: &'a CadIr, table: Vec<Row>, blocks: Blocks) -> Reading<'a> {
        Reading {
            ir,
            arenas: &ir.model,
            places: blocks.places(&table),
            table,
            blocks,
            layers: source::layers(ir),
            number: BTreeMap::new(),
            listed: Vec::new(),
            shown: Vec::new(),
            taken: Vec::new(),
            unread: BTreeMap::new(),
            failed: BTreeMap::new(),
            meshed: Vec::new(),
            losses: Vec::new(),
            brep: Brep { unit_in_metres: 0.001, ..Brep::default() },
            edges: BTreeMap::new(),
            vertices: BTreeMap::new(),
        }
    }

    /// Read all taken faces and surfaces.
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
            let owner = surface.source_object.as_ref();
            let Some(owner) = objects::loose(owner, surface.id.as_str(), &used) else { continue };
            let object = self.object(owner, "surface");
            if self.taken[object] {
                let shape = match self.plane(owner) {
                    Some(corners) => convert::bounded(corners),
                    None => convert::surface(&surface.geometry, &[]),
                };
                let whole = shape.map(|shape| BrepFace {
                    shape,
                    loops: Vec::new(),
                    reversed: false,
                    label: String::new(),
                });
                self.keep(object, surface.id.as_str(), whole);
            }
        }
    }

    /// Corners of an object that is a plane surface, metres.
    fn plane(&self, owner: &Owner) -> Option<[DVec3; 4]> {
        let row = self.table.iter().find(|row| row.id == *owner.object_id.as_str())?;
        let unit = source::source(self.ir, Vec::new()).unit?;
        row.plane.map(|corners| corners.map(|p| p * unit.metres))
    }

    /// Enter a face, or why it is none.
    fn keep(&mut self, object: usize, id: &str, face: Read<BrepFace>) {
        match face {
            Ok(mut face) => {
                self.listed[object].faces += 1;
                face.label = self.listed[object].told();
                self.brep.object_of.push(object as u32);
                self.brep.faces.push(face);
            }
            Err(why) => self.failed.entry(object).or_default().push((id.to_owned(), why)),
        }
    }

    /// Tell that the decoder found faults of which nothing else is told.
    fn doubt(&mut self, faults: usize) {
        if faults > 0 && self.losses.is_empty() && self.brep.notes.is_empty() {
            self.brep.notes.push(format!(
                "{faults} parts of the file were not as expected: compare the area with Rhino's"
            ));
        }
    }

    fn finish(mut self, path: &Path, version: String, job: &Job) -> Result<Model> {
        let exact = !self.brep.faces.is_empty();
        let soup = if exact { Soup::default() } else { self.soup() };
        let notes = std::mem::take(&mut self.brep.notes);
        let losses = std::mem::take(&mut self.losses);
        let source = Source { version, losses, ..source::source(self.ir, self.listed) };
        if !exact && !soup.faces.is_empty() {
            let soup = Soup { notes, ..soup };
            let mesh = mesh::weld(path, soup, &Opening::default(), job)?;
            let losses = source.losses.into_iter().chain(mesh.source.losses).collect();
            return Ok(Model::Mesh(PolygonMesh { source: Source { losses, ..source }, ..mesh }));
        }
        if !exact {
            let why: Vec<String> = source.losses.iter().take(3).map(Loss::to_string).collect();
            let why = why.into_iter().chain(notes).take(3).collect::<Vec<_>>().join("; ");
            let why = if why.is_empty() { why } else { format!(" ({why})") };
            let message = if source.unit.is_none() {
                "the file states no unit of length; choose one in Rhino and save it again".into()
            } else {
                format!("no surface, brep, extrusion or mesh that can be used{why}")
            };
            return Err(fault(path, "objects", message));
        }
        self.brep.name = file::stem(path);
        self.brep.unit_in_metres = source.unit.as_ref().map_or(METRES, |unit| unit.metres);
        self.brep.source = source;
        self.brep.notes = notes;
        Ok(Model::Brep(self.brep))
    }
}
