//! The formats that grids are written in, by the end of the path.

use super::{
    GridFile, compas, csv, dxf, extension, file, gltf, ifc, native, obj, off, opensees, ply, saf,
    stl, vtu,
};
use crate::error::{Error, Result};
use crate::io::WRITING;
use crate::job::{Job, Picture};
use std::path::{Path, PathBuf};

/// Ends of paths that can be written.
const WRITTEN: &str =
    "gridshell, obj, ply, stl, off, glb, dxf, csv, compas.json, vtu, saf.xlsx, ifc, tcl";

/// A format that grids are written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Gridshell's own.
    Native,
    /// Wavefront OBJ.
    Obj,
    /// Stanford PLY.
    Ply,
    /// STL, binary.
    Stl,
    /// Object File Format.
    Off,
    /// glTF 2.0, binary.
    Gltf,
    /// AutoCAD DXF 2000.
    Dxf,
    /// Schedules as tables, one file each.
    Csv,
    /// COMPAS mesh.
    Compas,
    /// VTK unstructured grid.
    Vtu,
    /// Structural Analysis Format.
    Saf,
    /// IFC4.
    Ifc,
    /// OpenSees input in Tcl.
    OpenSees,
}

impl Format {
    /// The format for this path, by its end.
    ///
    /// # Errors
    /// [`Error::Option`] listing the known ends.
    pub fn of(path: &Path) -> Result<Format> {
        match extension(path).as_str() {
            "gridshell" => Ok(Format::Native),
            "obj" => Ok(Format::Obj),
            "ply" => Ok(Format::Ply),
            "stl" => Ok(Format::Stl),
            "off" => Ok(Format::Off),
            "glb" => Ok(Format::Gltf),
            "dxf" => Ok(Format::Dxf),
            "csv" => Ok(Format::Csv),
            "json" => Ok(Format::Compas),
            "vtu" => Ok(Format::Vtu),
            "xlsx" => Ok(Format::Saf),
            "ifc" => Ok(Format::Ifc),
            "tcl" => Ok(Format::OpenSees),
            _ => Err(super::unknown(path, WRITTEN)),
        }
    }
}

/// Write a grid in the format of the path's end. Every file appears whole or not at all; gives the files written, which
/// are several for CSV.
///
/// # Errors
/// [`Error::Io`], or [`Error::Option`] listing the known ends for an unknown one, or where the format cannot hold so
/// large a grid.
pub fn write(path: &Path, grid: &GridFile, job: &Job) -> Result<Vec<PathBuf>> {
    job.check(WRITING)?;
    job.progress("write", 0.0, Picture::None);
    let bytes = match Format::of(path)? {
        Format::Csv => return write_tables(path, grid, job),
        Format::Native => native::encode(grid.document, job),
        Format::Obj => obj::encode(grid, job),
        Format::Ply => ply::encode(grid, job),
        Format::Stl => stl::encode(grid, job),
        Format::Off => off::encode(grid, job),
        Format::Gltf => gltf::write::encode(grid, job),
        Format::Dxf => dxf::encode(grid, job),
        Format::Compas => compas::write::encode(grid, job),
        Format::Vtu => vtu::encode(grid, job),
        Format::Saf => saf::encode(grid, job)
            .map_err(|message| Error::Option(format!("{}: {message}", path.display())))?,
        Format::Ifc => ifc::encode(grid, job),
        Format::OpenSees => opensees::encode(grid, job),
    };
    // What was broken off must not stand for the grid.
    job.check(WRITING)?;
    file::replace(path, &bytes)?;
    Ok(vec![path.to_owned()])
}

/// `a.csv` becomes `a.nodes.csv` and its sisters.
fn table(path: &Path, name: &str) -> PathBuf {
    path.with_extension(format!("{name}.csv"))
}

/// All tables, or none.
fn write_tables(path: &Path, grid: &GridFile, job: &Job) -> Result<Vec<PathBuf>> {
    let tables = csv::tables(grid, job);
    let files = tables.each_ref().map(|(name, text)| (table(path, name), text.as_bytes()));
    job.check(WRITING)?;
    file::replace_all(&files)?;
    Ok(files.map(|(path, _)| path).to_vec())
}

/// Whether [`write()`] knows a format for this path and may write there: to be asked before long work.
///
/// # Errors
/// [`Error::Option`] listing the known ends, or naming the folder that is missing or in the way; [`Error::Io`] where
/// nothing may be written.
pub fn check_output(path: &Path) -> Result<()> {
    match Format::of(path)? {
        Format::Csv => {
            csv::TABLES.iter().try_for_each(|name| file::check_place(&table(path, name)))
        }
        _ => file::check_place(path),
    }
}
