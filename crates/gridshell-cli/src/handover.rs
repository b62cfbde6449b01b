//! What the arguments say of hand-over files, and writing them.

use crate::args::Handover;
use crate::failure::Failure;
use crate::say;
use gridshell::Error;
use gridshell::io::{self, GridFile};
use gridshell::job::Job;
use gridshell::structure::{Material, Structure, Supports};
use std::path::{Path, PathBuf};

/// Section, material, panes.
pub fn structure(args: &Handover) -> Result<Structure, Failure> {
    Ok(Structure {
        section: args.section.parse()?,
        material: Material::named(&args.material)?,
        pane_mm: args.pane,
        saf: args.saf.parse()?,
    })
}

/// The supports, where they are given.
pub fn supports(args: &Handover, job: &Job) -> Result<Option<Supports>, Failure> {
    Ok(match args.supports.as_deref() {
        None => None,
        Some("boundary") => Some(Supports::Boundary),
        Some("corners") => Some(Supports::Corners),
        Some("none") => Some(Supports::None),
        Some(file) => Some(Supports::Points(io::read_anchors(Path::new(file), job)?)),
    })
}

/// Refuse an output that cannot be written before the work is done, not after.
pub fn check_output(path: &Path) -> Result<(), Failure> {
    io::check_output(path).map_err(Failure::of_output)
}

/// Write all outputs; gives a line on each file. One that fails does not keep the others from being written.
pub fn write_all(outputs: &[PathBuf], file: &GridFile, job: &Job) -> Result<String, Failure> {
    let (mut wrote, mut failed) = (Vec::new(), Vec::new());
    for path in outputs {
        match io::write(path, file, job) {
            Ok(files) => wrote.extend(files.iter().map(|p| format!("wrote {}", p.display()))),
            Err(e @ (Error::Stopped { .. } | Error::Memory(_))) => return Err(e.into()),
            Err(e) => failed.push(e.to_string()),
        }
    }
    if failed.is_empty() {
        return Ok(wrote.join("\n"));
    }
    for line in wrote {
        say::note(&line);
    }
    Err(Failure::other(failed.join("; ")))
}
