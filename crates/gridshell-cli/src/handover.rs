//! What the arguments say of hand-over files, and writing them.

use crate::args::Handover;
use crate::failure::Failure;
use gridshell::io::{self, GridFile};
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
pub fn supports(args: &Handover) -> Result<Option<Supports>, Failure> {
    Ok(match args.supports.as_deref() {
        None => None,
        Some("boundary") => Some(Supports::Boundary),
        Some("corners") => Some(Supports::Corners),
        Some("none") => Some(Supports::None),
        Some(file) => Some(Supports::Points(io::read_anchors(Path::new(file))?)),
    })
}

/// Refuse an output that cannot be written before the work is done, not after.
pub fn check_output(path: &Path) -> Result<(), Failure> {
    io::check_output(path)?;
    check_folder(path)
}

/// Refuse a file in a folder that is not there.
pub fn check_folder(path: &Path) -> Result<(), Failure> {
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.is_dir() {
        return Err(Failure::usage(format!(
            "{}: there is no folder {}",
            path.display(),
            folder.display()
        )));
    }
    Ok(())
}

/// Write all outputs; gives a line on each file.
pub fn write_all(outputs: &[PathBuf], file: &GridFile) -> Result<String, Failure> {
    let mut wrote = Vec::new();
    for path in outputs {
        let files = io::write(path, file).map_err(Failure::other)?;
        wrote.extend(files.iter().map(|p| format!("wrote {}", p.display())));
    }
    Ok(wrote.join("\n"))
}
