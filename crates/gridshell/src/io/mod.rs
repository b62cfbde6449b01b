//! Readers and writers, one file per format, and surfaces by name.

mod file;
mod grid_file;
pub mod iges;
mod lines;
mod obj;
mod off;
mod ply;
mod scan;
pub mod step;
mod stl;
mod values;
mod weld;

pub use grid_file::GridFile;
pub use lines::{read_anchors, read_guides};
pub use values::{read_directions, read_lengths};

use crate::error::{Error, Result};
use crate::surface::{Model, PolygonMesh, Source, builtin, sew};
use std::path::Path;

/// Extensions of the mesh formats.
const MESH_FORMATS: &str = "obj, ply, stl, off";
/// Extensions of all formats that hold a surface.
const SURFACE_FORMATS: &str = "step, stp, iges, igs, obj, ply, stl, off";

/// How a file is to be opened.
#[derive(Clone, Debug, Default)]
pub struct Opening {
    /// Edges of different faces that lie within this many metres of each other are one edge; without it, what the
    /// file or the size of the model suggests.
    pub sew: Option<f64>,
}

/// As [`open_with`], in the usual way.
///
/// # Errors
/// As [`open_with`].
pub fn open(name_or_path: &str) -> Result<Model> {
    open_with(name_or_path, &Opening::default())
}

/// A built-in surface by its name, else the file at this path.
///
/// # Errors
/// [`Error::Option`] listing the built-in names when there is neither; what [`load`] says of the file.
pub fn open_with(name_or_path: &str, opening: &Opening) -> Result<Model> {
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
    load(path, opening)
}

/// The surface in a file, by its extension. Faces that only touch are [sewn](crate::surface::sew()).
///
/// # Errors
/// [`Error::Io`], [`Error::Parse`] with line or entity, [`Error::Surface`] where the contents are no
/// manifold surface, [`Error::Option`] listing the known extensions for an unknown one, or where the sewing
/// tolerance is too large for the model.
pub fn load(path: &Path, opening: &Opening) -> Result<Model> {
    let mut model = read(path)?;
    if let Model::Brep(brep) = &mut model {
        sew(brep, opening.sew)?;
    }
    Ok(model)
}

fn read(path: &Path) -> Result<Model> {
    match extension(path).as_str() {
        "step" | "stp" => step::read(path).map(Model::Brep),
        "iges" | "igs" => iges::read(path).map(Model::Brep),
        "obj" | "ply" | "stl" | "off" => read_mesh(path).map(Model::Mesh),
        _ => Err(unknown(path, SURFACE_FORMATS)),
    }
}

/// The mesh in a file, by its extension: welded, oriented, without degenerate faces.
///
/// # Errors
/// As [`load`].
pub fn read_mesh(path: &Path) -> Result<PolygonMesh> {
    let mut mesh = match extension(path).as_str() {
        "obj" => obj::read(path),
        "ply" => ply::read(path),
        "stl" => stl::read(path),
        "off" => off::read(path),
        _ => Err(unknown(path, MESH_FORMATS)),
    }?;
    // Most of these formats say nothing more of themselves.
    if mesh.source.format.is_empty() {
        mesh.source.format = Source::of_format(&extension(path).to_uppercase()).format;
    }
    Ok(mesh)
}

/// Write a grid in the format of the path's extension. The file appears whole or not at all.
///
/// # Errors
/// [`Error::Io`], or [`Error::Option`] listing the known extensions for an unknown one.
pub fn write(path: &Path, grid: &GridFile) -> Result<()> {
    let encode = encoder(path)?;
    file::replace(path, &encode(grid))
}

/// Whether [`write()`] knows a format for this path: to be asked before long work.
///
/// # Errors
/// [`Error::Option`] listing the known extensions.
pub fn check_output(path: &Path) -> Result<()> {
    encoder(path).map(|_| ())
}

fn encoder(path: &Path) -> Result<fn(&GridFile) -> Vec<u8>> {
    match extension(path).as_str() {
        "obj" => Ok(obj::encode),
        "ply" => Ok(ply::encode),
        "stl" => Ok(stl::encode),
        "off" => Ok(off::encode),
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
