//! What is kept, as files.

use crate::laid::Laid;
use gridshell::design::Design;
use gridshell::error::{Error, Result};
use gridshell::job::Job;
use gridshell::stages::measure::irregular_nodes;
use gridshell_report::page;
use serde_json::{Value, json};
use std::fmt::Display;
use std::io::{Cursor, Write};
use std::path::PathBuf;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// A file to be taken away.
pub struct Exported {
    /// Its name.
    pub name: String,
    /// What it holds.
    pub bytes: Vec<u8>,
    /// The version of the grid.
    pub version: u32,
}

/// What a grid is in the format of this extension.
///
/// # Errors
/// [`Error::Option`] where it cannot be written.
pub fn file(laid: &Laid, extension: &str) -> Result<Exported> {
    let plain = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
    let name: String = laid.design.document.name.chars().map(plain).collect();
    let name = format!("{name}-{}.{extension}", laid.number);
    let unwritten = |e: &dyn Display| Error::Option(format!("{name}: {e}"));
    let (design, version) = laid.finished()?;
    let bytes = match extension {
        "run.json" => serde_json::to_vec_pretty(&run(&design)).map_err(|e| unwritten(&e))?,
        "edits.json" => laid.log().to_json().into_bytes(),
        "report.html" => page::of(&design).into_bytes(),
        _ => {
            let folder = tempfile::tempdir().map_err(|e| unwritten(&e))?;
            let path = folder.path().join(name.trim_end_matches(".zip"));
            design.write(&path, &Job::default())?;
            let files = std::fs::read_dir(folder.path()).map_err(|e| unwritten(&e))?;
            let mut files: Vec<_> = files.flatten().map(|f| f.path()).collect();
            files.sort();
            let packed = if extension == "csv.zip" { zip(&files) } else { std::fs::read(&path) };
            packed.map_err(|e| unwritten(&e))?
        }
    };
    Ok(Exported { name, bytes, version })
}

/// Several files as one.
fn zip(files: &[PathBuf]) -> std::io::Result<Vec<u8>> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for path in files {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        archive.start_file(name, SimpleFileOptions::default())?;
        archive.write_all(&std::fs::read(path)?)?;
    }
    Ok(archive.finish()?.into_inner())
}

/// The run document. Where the grid was edited, its measures are those of the grid as it is, and the edits are told;
/// stages and candidates stay the run's. A grid from a file has a document of its measures.
fn run(design: &Design) -> Value {
    let Design { document, quality, schedule, .. } = design;
    let mut told = match &design.run {
        Some(run) => json!(**run),
        None => json!({
            "schema": "gridshell.measure/1",
            "version": env!("CARGO_PKG_VERSION"),
            "units": "m",
            "grid": document.name,
            "edge_length": design.edge_length,
            "recipe": document.recipe,
        }),
    };
    if design.run.is_none() || !document.edits.is_empty() {
        told["quality"] = json!(quality);
        told["figures"] = json!(schedule.figures);
        told["irregular"] = json!(irregular_nodes(&design.grid, design.surface.origin));
        told["edits"] = json!(document.edits);
    }
    told
}
