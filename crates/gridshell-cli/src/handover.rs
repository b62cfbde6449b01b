//! What the arguments say of hand-over files, and writing them.

use crate::args::Handover;
use crate::failure::Failure;
use crate::say;
use gridshell::Error;
use gridshell::design::Design;
use gridshell::io;
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

/// Write all outputs; gives a line on each file that was written, and what failed. One that fails does not keep the
/// others from being written.
pub fn write_all(
    outputs: &[PathBuf],
    design: &Design,
    job: &Job,
) -> (Vec<String>, Result<(), Failure>) {
    let (mut wrote, mut failed) = (Vec::new(), Vec::new());
    for path in outputs {
        match design.write(path, job) {
            Ok(files) => wrote.extend(files.iter().map(|p| format!("wrote {}", p.display()))),
            Err(e @ (Error::Stopped { .. } | Error::Memory(_))) => {
                failed.push(Err(e.into()));
                break;
            }
            Err(e) => failed.push(Err(Failure::other(e))),
        }
    }
    (wrote, Failure::all(failed))
}

/// All that failed, where something did; then what was written is told here.
pub fn all_or_told(
    wrote: &[String],
    done: impl IntoIterator<Item = Result<(), Failure>>,
) -> Result<(), Failure> {
    Failure::all(done).inspect_err(|_| wrote.iter().for_each(|line| say::note(line)))
}
