//! IGES files (version 5.3, fixed ASCII form): trimmed surfaces (144, 143), boundary representations (186, 514) and
//! surfaces that stand alone, as exact splines.
//!
//! `records` sorts the lines, `global` and `directory` read what their sections say, `tokens` splits
//! parameters; `curves` and `surfaces` make splines of entities; `loops`, `trimmed` and `shells` make faces
//! of them; `roots` says which entities stand for themselves. What cannot be read is left out and told by its
//! directory number ("D17") and line. Counts are held against what the file holds before anything is set aside, and
//! all work is counted, so a file that is wrong ends in an error, not in a hang.

mod arc;
mod curves;
mod directory;
mod global;
mod loops;
mod offset;
mod records;
mod roots;
mod shells;
mod surfaces;
mod tokens;
mod trimmed;

use super::{READING, bezier, file};
use crate::error::{Error, Result};
use crate::job::Job;
use crate::surface::brep::Brep;
use crate::surface::{Loss, Source, Unit};
use directory::{Directory, Entry};
use std::cell::{Cell, RefCell};
use std::path::Path;

/// Larger files are refused, bytes.
const MOST_BYTES: u64 = 256 << 20;
/// Entities nested deeper than this contain themselves, or are nobody's work.
const MOST_LEVELS: usize = 32;
/// Work that any file may ask for, and more for each of its entities and parameter records: one for a control point
/// that is made. A file that asks for more refers to itself in many ways.
const WORK: usize = 4_000_000;
const WORK_OF_ENTITY: usize = 100;
const WORK_OF_RECORD: usize = 10;
/// Work of visiting an entity, and of placing a subfigure.
const VISIT: usize = 10;
const PLACING: usize = 100;
/// More faces, counted with every placed copy, are refused.
const MOST_FACES: usize = 100_000;
/// Notes beyond this many are only counted.
const MOST_NOTES: usize = 20;

/// What is wrong, and where.
#[derive(Clone, Debug)]
struct Fault {
    /// Line or entity.
    place: String,
    what: String,
    /// Nothing of the file can be used.
    fatal: bool,
}

impl Fault {
    fn new(place: &str, what: impl Into<String>) -> Fault {
        Fault { place: place.to_owned(), what: what.into(), fatal: false }
    }
}

/// A file while it is read.
struct File<'a> {
    directory: Directory<'a>,
    /// Work done, and how much may be.
    spent: Cell<usize>,
    limit: usize,
    notes: RefCell<Vec<String>>,
    losses: RefCell<Vec<Loss>>,
}

impl File<'_> {
    /// The entity of this number.
    fn known(&self, number: u32) -> std::result::Result<Entry, Fault> {
        self.directory.entry(number).ok_or_else(|| {
            Fault::new(&format!("entity D{number}"), "the directory has no such entity")
        })
    }

    fn note(&self, note: String) {
        self.notes.borrow_mut().push(note);
    }

    /// Keep in mind that an entity of this kind and number could not be used; what is fatal stays an error.
    fn or_lose(
        &self,
        (kind, number): (u32, u32),
        result: std::result::Result<(), Fault>,
    ) -> std::result::Result<(), Fault> {
        match result {
            Err(fault) if !fault.fatal => {
                let what = match kind {
                    144 => "trimmed surface",
                    143 => "bounded surface",
                    186 => "solid",
                    514 => "shell",
                    510 => "face",
                    408 => "subfigure",
                    _ => "surface",
                };
                let whole = matches!(kind, 186 | 514 | 408);
                self.losses.borrow_mut().push(Loss {
                    what: format!("{what} D{number}"),
                    why: format!("{}: {}", fault.place, fault.what),
                    faces: usize::from(!whole),
                    area: None,
                    whole,
                });
                Ok(())
            }
            other => other,
        }
    }

    /// Count work, and refuse to do more than any sensible file asks for.
    fn spend(&self, entry: &Entry, work: usize) -> std::result::Result<(), Fault> {
        self.spent.set(self.spent.get().saturating_add(work));
        if self.spent.get() > self.limit {
            let what = "the entities refer to each other in too many ways, or are too large";
            return Err(Fault { fatal: true, ..entry.fault(what) });
        }
        Ok(())
    }
}

/// Read the faces of an IGES file.
///
/// # Errors
/// [`Error::Io`] where the file cannot be opened, [`Error::Parse`] with line or entity where it is not an IGES file, too
/// large, cut off, or holds no face that can be used.
pub fn read(path: &Path, job: &Job) -> Result<Brep> {
    let fault =
        |f: Fault| Error::Parse { path: path.to_path_buf(), place: f.place, message: f.what };
    let bytes = file::read_at_most(path, MOST_BYTES, job)?;
    let mut brep = job.apart(READING, move || parse(&bytes))?.map_err(fault)?;
    path.file_stem().and_then(|s| s.to_str()).unwrap_or("surface").clone_into(&mut brep.name);
    Ok(brep)
}

fn parse(bytes: &[u8]) -> std::result::Result<Brep, Fault> {
    let records = records::read(bytes)?;
    let global = global::read(&records)?;
    let directory = Directory::new(&records, global.marks)?;
    let limit =
        WORK + WORK_OF_ENTITY * directory.entries.len() + WORK_OF_RECORD * records.parameters.len();
    let (notes, losses) = (RefCell::default(), RefCell::default());
    let file = File { directory, spent: Cell::new(0), limit, notes, losses };
    if global.unit_guessed {
        file.note("the file names no unit of length: taken as millimetres".into());
    }
    if !records.ended {
        file.note("the file has no end section; all its entities are there".into());
    }
    let mut brep = file.model(global.metres)?;
    brep.unit_in_metres = global.metres;
    brep.tolerance = global.resolution * global.metres;
    let unit = (!global.unit_guessed).then(|| Unit::of_metres(global.metres));
    brep.source = Source { application: global.application, unit, ..Source::of_format("IGES") };
    let mut notes = file.notes.into_inner();
    brep.source.losses = file.losses.into_inner();
    if brep.faces.is_empty() {
        let lost = brep.source.losses.iter().map(ToString::to_string);
        let why: Vec<String> = lost.chain(notes.iter().cloned()).take(3).collect();
        let why = if why.is_empty() { String::new() } else { format!(" ({})", why.join("; ")) };
        return Err(Fault::new(
            "file",
            format!("it holds no face or surface that can be used{why}"),
        ));
    }
    let more = notes.len().saturating_sub(MOST_NOTES);
    notes.truncate(MOST_NOTES);
    if more > 0 {
        notes.push(format!("and {more} more notes"));
    }
    brep.notes = notes;
    Ok(brep)
}

#[cfg(test)]
mod tests;
