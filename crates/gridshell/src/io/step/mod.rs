//! STEP files (ISO 10303-21; AP203, AP214, AP242): trimmed faces with shared edges.
//!
//! The parser is `step-io`; nothing of it leaves this folder. Analytic surfaces and curves come as exact
//! rational B-splines, offsets as exact offsets of them. Assemblies are placed, by occurrences and by mapped
//! items. What the parser does not know is put into words that it does before it sees them (`mend` has the order).
//! What cannot be read is left out and noted. Triangles are read where there is nothing exact.

mod axes;
mod dropped;
mod envelope;
mod facets;
mod mend;
mod meshes;
mod numbers;
mod operators;
mod owners;
mod place;
mod reading;
mod sets;
mod shape;
mod swept;
#[cfg(test)]
mod tests;
mod text;
mod trimmed;
mod units;

use super::mesh::soup::Soup;
use super::{Opening, READING, file, mesh};
use crate::error::{Error, Result};
use crate::job::Job;
use crate::surface::{Brep, Model, PolygonMesh, Source, Unit};
use reading::Reading;
use std::path::Path;
use step_io::StepModel;

/// Larger files are refused, bytes.
const MOST_BYTES: u64 = 512 << 20;
/// Notes of one kind beyond this many are only counted.
const MOST_NOTES: usize = 20;

/// What a file holds: exact faces, or where it has none triangles.
enum Found {
    Faces(Brep),
    Triangles(Soup, Source),
}

/// Read the faces of a STEP file.
///
/// # Errors
/// [`Error::Io`] where the file cannot be opened, [`Error::Parse`] where it is not a STEP file, too large, or
/// holds no face that can be used; [`Error::Surface`] where it holds triangles only, and they are no surface.
pub fn read(path: &Path, job: &Job) -> Result<Model> {
    let bytes = file::read_at_most(path, MOST_BYTES, job)?;
    let name = path.file_stem().and_then(|s| s.to_str()).unwrap_or("surface").to_owned();
    match job
        .apart(READING, move || parse(bytes))?
        .map_err(|(place, what)| fault(path, &place, &what))?
    {
        Found::Faces(brep) => Ok(Model::Brep(Brep { name, ..brep })),
        Found::Triangles(soup, source) => {
            let mesh = mesh::weld(path, soup, &Opening::default(), job)?;
            let losses = source.losses.into_iter().chain(mesh.source.losses).collect();
            Ok(Model::Mesh(PolygonMesh { source: Source { losses, ..source }, ..mesh }))
        }
    }
}

fn fault(path: &Path, place: &str, what: &str) -> Error {
    Error::Parse { path: path.to_path_buf(), place: place.into(), message: what.into() }
}

/// Read what the text of a STEP file holds; place and sentence on failure.
fn parse(bytes: Vec<u8>) -> std::result::Result<Found, (String, String)> {
    let mend::Mended { text, operators, notes } = mend::mended(bytes);
    let (model, report) =
        step_io::read(text.bytes.as_slice()).map_err(|e| told(&e, &text.bytes))?;
    let scene = model.scene();
    let unit = scene.units().length.map(|u| u.to_si).filter(|m| m.is_finite() && *m > 0.0);
    let mut reading = Reading::new(&model, operators, unit.unwrap_or(0.001));
    reading.name_faces(&text, &report);
    reading.find_owners(&text, &report);
    reading.brep.notes = notes;
    reading.brep.source = source(&model);
    let precision = scene.units().precision.filter(|p| p.is_finite() && *p > 0.0);
    reading.brep.tolerance = precision.unwrap_or(0.0) * reading.brep.unit_in_metres;
    if unit.is_none() {
        reading.note("the file names no unit of length: taken as millimetres".into());
    }
    reading.everything(&scene)?;
    let mut brep = reading.brep;
    let (losses, note) = dropped::told(&text, &report.dropped, brep.unit_in_metres);
    brep.source.losses.extend(losses);
    brep.notes.extend(note);
    note_some(&mut brep.notes, report.parse_warnings.iter().map(ToString::to_string));
    note_some(&mut brep.notes, scene.warnings().iter().map(ToString::to_string));
    if !brep.faces.is_empty() {
        return Ok(Found::Faces(brep));
    }
    let soup = meshes::soup(&scene, brep.unit_in_metres);
    if !soup.faces.is_empty() {
        let notes = brep.notes.into_iter().chain(soup.notes).collect();
        return Ok(Found::Triangles(Soup { notes, ..soup }, brep.source));
    }
    let told = brep.source.losses.iter().map(ToString::to_string).chain(brep.notes);
    let why = told.take(3).collect::<Vec<_>>().join("; ");
    let why = if why.is_empty() { why } else { format!(" ({why})") };
    let what = if model.header().schema.to_string().starts_with("IFC") || text.has(&["IFCPROJECT"])
    {
        "it is an IFC file; export STEP, or a mesh".into()
    } else {
        format!("no face that can be used{why}; export surfaces, not curves or points alone")
    };
    Err(("data section".into(), what))
}

/// Where and why the text could not be parsed.
fn told(error: &step_io::Error, bytes: &[u8]) -> (String, String) {
    use step_io::Error as E;
    let (line, what) = match error {
        E::UnexpectedEof { .. } if bytes.trim_ascii().is_empty() => {
            return ("file".into(), "it is empty; export it again".into());
        }
        E::UnexpectedEof { .. } => {
            let last = bytes.trim_ascii_end().split(|b| *b == b'\n').count();
            (last as u32, "the file ends here, before its data do: it is cut off".into())
        }
        _ if bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"\x1f\x8b") => {
            return ("file".into(), "it is compressed; unpack it first".into());
        }
        E::UnexpectedToken { span, .. }
            if !bytes.trim_ascii_start().starts_with(b"ISO-10303-21") =>
        {
            return (
                format!("line {}", span.line),
                "not a STEP file: it does not begin with ISO-10303-21".into(),
            );
        }
        E::UnexpectedToken { expected, found, span } => {
            (span.line, format!("{found} where {expected} should be"))
        }
        E::DuplicateEntityId { id, line, first_line } => {
            (*line, format!("entity #{id} is there already, at line {first_line}"))
        }
        E::Lex(e) => (e.span.line, e.to_string()),
        other => return ("file".into(), other.to_string()),
    };
    (format!("line {line}"), format!("{what}; export it again"))
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
