//! Readers and writers, one file per format, and surfaces by name.

mod bezier;
mod choice;
mod compas;
mod csv;
mod digest;
mod document;
mod dxf;
mod file;
mod format;
mod gltf;
mod grid_file;
mod ifc;
pub mod iges;
mod json;
mod lines;
mod mesh;
mod native;
mod obj;
mod off;
mod opensees;
mod ply;
mod reference;
mod replace;
#[cfg(feature = "3dm")]
mod rhino;
mod saf;
mod scan;
pub mod step;
mod stl;
mod text;
mod unit;
mod values;
mod vtu;
mod xlsx;

pub use choice::Choice;
pub use document::{Document, PlaceRecord, SCHEMA};
pub use file::{read, read_text};
pub use format::{Format, check_output, write};
pub use grid_file::GridFile;
pub use lines::{read_anchors, read_guides};
pub use native::read_document;
pub use reference::{Follow, Reference, find_reference, open_reference, reference};
pub use replace::{check_place, replace};
pub use unit::LengthUnit;
pub use values::{read_directions, read_lengths};

use crate::error::{Error, Result};
use crate::job::{Job, Picture};
use crate::math::digits::three;
use crate::surface::{Model, PolygonMesh, Source, builtin, sew, split_folds};
use mesh::soup::Soup;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// What a stop in here is told as.
pub(crate) const READING: &str = "reading";
const WRITING: &str = "writing";

/// Extensions of the mesh formats.
pub(crate) const MESH_FORMATS: &str = "obj, ply, stl, off, gltf, glb, json";
/// Extensions of all formats that hold a surface.
const SURFACE_FORMATS: &str = "step, stp, 3dm, iges, igs, obj, ply, stl, off, gltf, glb, json";

/// Roofs are between these sizes, metres.
const LEAST_SIZE: f64 = 0.5;
const MOST_SIZE: f64 = 1e4;

/// How a file is to be opened.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Opening {
    /// Edges of different faces that lie within this many metres of each other are one edge; without it, what the
    /// file or the size of the model suggests.
    pub sew: Option<f64>,
    /// Unit of the file's lengths, where it states none or the wrong one; without it what it states, else metres.
    pub unit: Option<LengthUnit>,
    /// Which objects are read, in a format that names them.
    pub choice: Choice,
}

/// As [`open_with`], in the usual way.
///
/// # Errors
/// As [`open_with`].
pub fn open(name_or_path: &str, job: &Job) -> Result<Model> {
    open_with(name_or_path, &Opening::default(), job)
}

/// A built-in surface by its name, else the file at this path.
///
/// # Errors
/// [`Error::Option`] listing the built-in names when there is neither; what [`load`] says of the file.
pub fn open_with(name_or_path: &str, opening: &Opening, job: &Job) -> Result<Model> {
    if let Some(model) = builtin::model(name_or_path) {
        return Ok(model);
    }
    let path = Path::new(name_or_path);
    if !path.exists() {
        let names: Vec<&str> = builtin::ALL.iter().map(|b| b.name).collect();
        return Err(Error::Option(format!(
            "`{name_or_path}` is neither a file nor a built-in surface; the built-in ones are {}",
            names.join(", ")
        )));
    }
    load(path, opening, job)
}

/// The surface in a file, by its extension. Faces that only touch are [sewn](crate::surface::sew()).
///
/// # Errors
/// [`Error::Io`], [`Error::Parse`] with line or entity, [`Error::Surface`] where the contents are no
/// manifold surface, [`Error::Option`] listing the known extensions for an unknown one, where the sewing tolerance is
/// too large for the model, or objects are chosen that are not there.
pub fn load(path: &Path, opening: &Opening, job: &Job) -> Result<Model> {
    if mesh_reader(path).is_some() {
        return read_mesh_with(path, opening, job).map(Model::Mesh);
    }
    job.progress("read", 0.0, Picture::None);
    let model = match extension(path).as_str() {
        "step" | "stp" => unnamed(path, opening).and_then(|()| step::read(path, job)),
        "iges" | "igs" => {
            unnamed(path, opening).and_then(|()| iges::read(path, job)).map(Model::Brep)
        }
        "3dm" => rhino(path, &opening.choice, job),
        _ => Err(unknown(path, SURFACE_FORMATS)),
    };
    job.check(READING)?;
    let mut model = model?;
    unit::take(&mut model, opening.unit)?;
    model.settle()?;
    let odd = odd_size(model.size());
    match &mut model {
        Model::Brep(brep) => {
            sew(brep, opening.sew, job)?;
            split_folds(brep, job)?;
            brep.notes.extend(odd);
        }
        Model::Mesh(mesh) => mesh.notes.extend(odd),
    }
    Ok(model)
}

/// A word on a model that no one builds at its size: its file most likely states the wrong unit.
fn odd_size(size: f64) -> Option<String> {
    (!(LEAST_SIZE..=MOST_SIZE).contains(&size)).then(|| {
        format!(
            "the model is {} m across; if it should not be, say in which unit its lengths are (--units)",
            three(size)
        )
    })
}

#[cfg(feature = "3dm")]
fn rhino(path: &Path, choice: &Choice, job: &Job) -> Result<Model> {
    rhino::read(path, choice, job)
}

#[cfg(not(feature = "3dm"))]
fn rhino(path: &Path, _: &Choice, _: &Job) -> Result<Model> {
    Err(Error::Option(format!(
        "{}: this program was built without Rhino files; build it with `--features 3dm`, or export STEP from Rhino",
        path.display()
    )))
}

/// Refuse a choice among objects where none has a name.
fn unnamed(path: &Path, opening: &Opening) -> Result<()> {
    if opening.choice.is_all() {
        return Ok(());
    }
    Err(Error::Option(format!(
        "{}: layers and objects are chosen in 3DM files only; leave out `--layer` and `--object`",
        path.display()
    )))
}

/// As [`read_mesh_with`], in the usual way.
///
/// # Errors
/// As [`load`].
pub fn read_mesh(path: &Path, job: &Job) -> Result<PolygonMesh> {
    read_mesh_with(path, &Opening::default(), job)
}

/// The mesh in a file, by its extension: in metres, welded, oriented, without degenerate faces.
///
/// # Errors
/// As [`load`].
pub fn read_mesh_with(path: &Path, opening: &Opening, job: &Job) -> Result<PolygonMesh> {
    let read = mesh_reader(path).ok_or_else(|| unknown(path, MESH_FORMATS))?;
    unnamed(path, opening)?;
    job.progress("read", 0.0, Picture::None);
    let soup = read(path, job);
    // What was broken off tells nothing of the file.
    job.check(READING)?;
    job.progress("read", 0.5, Picture::None);
    let mesh = mesh::weld(path, soup?, opening, job);
    job.check(READING)?;
    let mut mesh = mesh?;
    let losses = std::mem::take(&mut mesh.source.losses);
    mesh.source = Source { losses, ..Source::of_format(&extension(path).to_uppercase()) };
    mesh.settle();
    mesh.notes.extend(odd_size(mesh.size()));
    Ok(mesh)
}

type MeshReader = fn(&Path, &Job) -> Result<Soup>;

fn mesh_reader(path: &Path) -> Option<MeshReader> {
    match extension(path).as_str() {
        "obj" => Some(obj::read),
        "ply" => Some(ply::read),
        "stl" => Some(stl::read),
        "off" => Some(off::read),
        "gltf" | "glb" => Some(gltf::read::read),
        "json" => Some(compas::read::read),
        _ => None,
    }
}

fn extension(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase()
}

/// Whether there is a reader of meshes for this extension.
pub(crate) fn reads_mesh(path: &Path) -> bool {
    mesh_reader(path).is_some()
}

pub(crate) fn unknown(path: &Path, known: &str) -> Error {
    Error::Option(format!(
        "{}: the extension `{}` is not one of {known}",
        path.display(),
        extension(path)
    ))
}

#[cfg(test)]
mod tests;
