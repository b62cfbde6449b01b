//! Gridshell's own grid file (`.gridshell`): a [`Document`] as JSON, one element a line, numbers with all their digits.

use super::document::{Document, SCHEMA};
use super::{file, scan};
use crate::error::{Error, Result};
use crate::io::WRITING;
use crate::job::Job;
use std::fmt::Write;
use std::path::Path;

/// Read a grid file.
///
/// # Errors
/// [`Error::Parse`] with the line of what is no such file, or the node or panel that is wrong.
pub fn read_document(path: &Path, job: &Job) -> Result<Document> {
    let bytes = file::read(path, job)?;
    let document: Document = match serde_json::from_slice(&bytes) {
        Ok(document) => document,
        Err(e) => return Err(refusal(path, &bytes, &e)),
    };
    if document.schema != SCHEMA {
        return Err(newer(path, &document.schema));
    }
    check(&document).map_err(|(place, message)| scan::error(path, place, message))?;
    Ok(document)
}

/// A file of another version may fail by a name it does not know: its version is the reason to tell.
fn refusal(path: &Path, bytes: &[u8], error: &serde_json::Error) -> Error {
    #[derive(serde::Deserialize)]
    struct Head {
        schema: String,
    }
    match serde_json::from_slice::<Head>(bytes) {
        Ok(head) if head.schema != SCHEMA => newer(path, &head.schema),
        _ => scan::error(path, format!("line {}", error.line()), told(error)),
    }
}

/// What is wrong with the text, without its place.
fn told(error: &serde_json::Error) -> String {
    if error.is_eof() {
        return "the file ends here, before the grid is whole: it is empty or was cut off"
            .to_owned();
    }
    let said = error.to_string();
    let said = said.split(" at line ").next().unwrap_or_default();
    format!("this is not a grid file of gridshell: {said}")
}

fn newer(path: &Path, schema: &str) -> Error {
    let schema = scan::clip(schema);
    let message = format!(
        "its schema is `{schema}`, and this version reads `{SCHEMA}`: use the version of gridshell that wrote it"
    );
    scan::error(path, "schema", message)
}

/// What the types do not say; the error is where and what.
fn check(document: &Document) -> std::result::Result<(), (String, String)> {
    let count = document.nodes.len();
    if document.units != "m" {
        let message = format!("lengths in `{}`: only `m` is known", scan::clip(&document.units));
        return Err(("units".into(), message));
    }
    if !document.places.is_empty() && document.places.len() != count {
        let message = format!("{} places for {count} nodes", document.places.len());
        return Err(("places".into(), message));
    }
    let known = |place: String, nodes: &[u32]| match nodes.iter().find(|&&v| v as usize >= count) {
        Some(v) => Err((place, format!("it uses node {v}, but there are only {count}, from 0"))),
        None => Ok(()),
    };
    for (k, panel) in document.panels.iter().enumerate() {
        known(format!("panel {k}"), panel)?;
    }
    for (k, member) in document.features.iter().enumerate() {
        known(format!("feature {k}"), member)?;
    }
    known("anchors".into(), &document.anchors)?;
    known("supports".into(), &document.supports)
}

/// The document as text: lists of elements take a line each.
pub(super) fn encode(document: &Document, job: &Job) -> Vec<u8> {
    let mut out = String::from("{");
    entry(&mut out, "schema", &document.schema);
    entry(&mut out, "version", &document.version);
    entry(&mut out, "units", &document.units);
    entry(&mut out, "name", &document.name);
    entry(&mut out, "surface", &document.surface);
    entry(&mut out, "seed", &document.seed);
    entry(&mut out, "edge_length", &document.edge_length);
    entry(&mut out, "recipe", &document.recipe);
    list(&mut out, "nodes", &document.nodes, job);
    list(&mut out, "places", &document.places, job);
    list(&mut out, "panels", &document.panels, job);
    list(&mut out, "features", &document.features, job);
    entry(&mut out, "anchors", &document.anchors);
    entry(&mut out, "supports", &document.supports);
    list(&mut out, "edits", &document.edits, job);
    if document.invalid.is_some() {
        entry(&mut out, "invalid", &document.invalid);
    }
    out.push_str("\n}\n");
    out.into_bytes()
}

fn begin(out: &mut String, name: &str) {
    let comma = if out.len() > 1 { "," } else { "" };
    let _ = write!(out, "{comma}\n\"{name}\": ");
}

fn text(value: &impl serde::Serialize) -> String {
    serde_json::to_string(value).expect("a document has string keys and finite numbers only")
}

fn entry(out: &mut String, name: &str, value: &impl serde::Serialize) {
    begin(out, name);
    out.push_str(&text(value));
}

fn list<T: serde::Serialize>(out: &mut String, name: &str, values: &[T], job: &Job) {
    begin(out, name);
    out.push('[');
    for (k, value) in values.iter().enumerate().take_while(|_| !job.is_over(WRITING)) {
        out.push_str(if k == 0 { "\n" } else { ",\n" });
        out.push_str(&text(value));
    }
    out.push(']');
}
