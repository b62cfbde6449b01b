//! What is kept, as files.

use crate::laid::{Finished, Laid};
use gridshell::error::{Error, Result};
use gridshell::grid::Grid;
use gridshell::io::{self, Document, GridFile};
use gridshell::job::Job;
use gridshell::run::Run;
use gridshell::schedule::Schedule;
use gridshell::stages::measure::{Quality, irregular_nodes};
use gridshell::structure::Structure;
use serde_json::{Value, json};
use std::fmt::Display;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// A grid that is reported on. Metres.
pub struct Reported<'a> {
    /// The grid and its history.
    pub document: &'a Document,
    /// The grid, numbered like the document.
    pub grid: &'a Grid,
    /// Its nodes, members and panels with their figures.
    pub schedule: &'a Schedule,
    /// Its measures.
    pub quality: &'a Quality,
    /// What lengths are measured against.
    pub edge_length: f64,
    /// The run that made it, where it is known; it tells of the grid before edits.
    pub run: Option<&'a Run>,
}

/// Makes one page of HTML on a grid.
pub type Report = fn(&Reported) -> String;

/// A file to be taken away.
pub struct Exported {
    /// Its name.
    pub name: String,
    /// What it holds.
    pub bytes: Vec<u8>,
    /// The version of the grid.
    pub version: u32,
}

/// What a grid is in the format of this extension; `report` makes its page.
///
/// # Errors
/// [`Error::Option`] where it cannot be written.
pub fn file(laid: &Laid, extension: &str, report: Option<Report>) -> Result<Exported> {
    let plain = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
    let name: String = laid.document.name.chars().map(plain).collect();
    let name = format!("{name}-{}.{extension}", laid.number);
    let unwritten = |e: &dyn Display| Error::Option(format!("{name}: {e}"));
    let finished = laid.finished()?;
    let version = finished.version;
    let bytes = match extension {
        "run.json" => serde_json::to_vec_pretty(&run(laid, finished)).map_err(|e| unwritten(&e))?,
        "edits.json" => laid.log()?.to_json().into_bytes(),
        "report.html" => {
            let report = report.ok_or_else(|| unwritten(&"this program makes no reports"))?;
            reported(laid, &finished, report).into_bytes()
        }
        _ => {
            let folder = tempfile::tempdir().map_err(|e| unwritten(&e))?;
            let path = folder.path().join(name.trim_end_matches(".zip"));
            grid(&finished, &path)?;
            let files = std::fs::read_dir(folder.path()).map_err(|e| unwritten(&e))?;
            let mut files: Vec<_> = files.flatten().map(|f| f.path()).collect();
            files.sort();
            let packed = if extension == "csv.zip" { zip(&files) } else { std::fs::read(&path) };
            packed.map_err(|e| unwritten(&e))?
        }
    };
    Ok(Exported { name, bytes, version })
}

/// Write the grid as it is.
fn grid(Finished { document, schedule, .. }: &Finished, path: &Path) -> Result<()> {
    let structure = Structure::default();
    let file = GridFile { document, schedule, structure: &structure };
    io::write(path, &file, &Job::default()).map(|_| ())
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

fn reported(laid: &Laid, finished: &Finished, report: Report) -> String {
    let Finished { document, grid, schedule, quality, .. } = finished;
    report(&Reported {
        document,
        grid,
        schedule,
        quality,
        edge_length: laid.edge_length,
        run: laid.run.as_ref(),
    })
}

/// The run document. Where the grid was edited, its measures are those of the grid as it is, and the edits are told;
/// stages and candidates stay the run's. A grid from a file has a document of its measures.
fn run(laid: &Laid, finished: Finished) -> Value {
    let Finished { document, grid, schedule, quality, .. } = finished;
    let mut told = match &laid.run {
        Some(run) => json!(run),
        None => json!({
            "schema": "gridshell.measure/1",
            "version": env!("CARGO_PKG_VERSION"),
            "units": "m",
            "grid": document.name,
            "edge_length": laid.edge_length,
            "recipe": document.recipe,
        }),
    };
    if laid.run.is_none() || !document.edits.is_empty() {
        told["quality"] = json!(quality);
        told["figures"] = json!(schedule.figures);
        told["irregular"] = json!(irregular_nodes(&grid, laid.opened.model.origin()));
        told["edits"] = json!(document.edits);
    }
    told
}
