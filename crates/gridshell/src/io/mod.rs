//! Readers and writers, one file per format, and surfaces by name.

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
mod lines;
mod native;
mod obj;
mod off;
mod opensees;
mod ply;
mod saf;
mod scan;
pub mod step;
mod stl;
mod values;
mod vtu;
mod weld;

pub use document::{Document, PlaceRecord, Reference, SCHEMA};
pub use format::{Format, check_output, write};
pub use grid_file::GridFile;
pub use lines::{read_anchors, read_guides};
pub use native::{read_document, reference};
pub use values::{read_directions, read_lengths};

use crate::error::{Error, Result};
use crate::surface::{Model, PolygonMesh, builtin};
use std::path::Path;

/// Extensions of the mesh formats.
const MESH_FORMATS: &str = "obj, ply, stl, off";
/// Extensions of all formats that hold a surface.
const SURFACE_FORMATS: &str = "step, stp, obj, ply, stl, off";

/// A built-in surface by its name, else the file at this path.
///
/// # Errors
/// [`Error::Option`] listing the built-in names when there is neither; what [`load`] says of the file.
pub fn open(name_or_path: &str) -> Result<Model> {
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
    load(path)
}

/// The surface in a file, by its extension.
///
/// # Errors
/// [`Error::Io`], [`Error::Parse`] with line or entity, [`Error::Surface`] where the contents are no
/// manifold surface, [`Error::Option`] listing the known extensions for an unknown one.
pub fn load(path: &Path) -> Result<Model> {
    match extension(path).as_str() {
        "step" | "stp" => step::read(path).map(Model::Brep),
        "obj" | "ply" | "stl" | "off" => read_mesh(path).map(Model::Mesh),
        _ => Err(unknown(path, SURFACE_FORMATS)),
    }
}

/// The surface that a grid file refers to, for a grid file at `beside`.
///
/// # Errors
/// As [`open`]; [`Error::Surface`] where the file is no longer the one that the grid was laid on.
pub fn open_reference(reference: &Reference, beside: &Path) -> Result<Model> {
    match reference {
        Reference::Builtin(name) => open(name),
        Reference::File { path, bytes, fnv1a } => {
            let near = beside.with_file_name("").join(path);
            let path = if near.exists() { near } else { path.into() };
            let now = file::read(&path)?;
            let same =
                now.len() as u64 == *bytes && format!("{:016x}", digest::fnv1a_64(&now)) == *fnv1a;
            if !same {
                return Err(Error::Surface(format!(
                    "{}: the surface has changed since the grid in {} was laid on it",
                    path.display(),
                    beside.display()
                )));
            }
            load(&path)
        }
    }
}

/// The mesh in a file, by its extension: welded, oriented, without degenerate faces.
///
/// # Errors
/// As [`load`].
pub fn read_mesh(path: &Path) -> Result<PolygonMesh> {
    match extension(path).as_str() {
        "obj" => obj::read(path),
        "ply" => ply::read(path),
        "stl" => stl::read(path),
        "off" => off::read(path),
        _ => Err(unknown(path, MESH_FORMATS)),
    }
}

fn extension(path: &Path) -> String {
    path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase()
}

fn unknown(path: &Path, known: &str) -> Error {
    Error::Option(format!(
        "{}: the extension `{}` is not one of {known}",
        path.display(),
        extension(path)
    ))
}

#[cfg(test)]
mod tests;
