//! `gridshell convert`: a grid in other formats.

use crate::Outcome;
use crate::args::Convert;
use crate::failure::Failure;
use crate::progress::Work;
use crate::{handover, open, say};
use gridshell::io::{Document, GridFile};
use gridshell::schedule::{Schedule, Tolerances};
use gridshell::stages::measure::measure_within;
use gridshell::validity::Validity;

pub fn run(args: &Convert, work: &Work) -> Result<Outcome, Failure> {
    let job = &work.job;
    args.output.iter().try_for_each(|path| handover::check_output(path))?;
    let structure = handover::structure(&args.handover)?;
    let supports = handover::supports(&args.handover, job)?;
    let opened = open::open(&args.grid, job)?;
    let (grid, surface) = (&opened.grid, &opened.surface);
    let schedule = Schedule::within(grid, surface, &Tolerances::from(&opened.recipe.measure), job)?;
    let supports = match supports {
        Some(supports) => supports.nodes(grid, surface)?,
        None => opened.document.supports.clone(),
    };
    let panels = schedule.panels.nodes.clone();
    let options = &opened.recipe.measure;
    let quality = measure_within(grid, surface, opened.edge_length, options, job)?;
    let look = Validity::of(grid, surface, opened.edge_length, &quality);
    let invalid = (!look.is_valid()).then(|| look.summary());
    let document = Document { supports, panels, invalid, ..opened.document };
    let file = GridFile { document: &document, schedule: &schedule, structure: &structure };
    let wrote = handover::write_all(&args.output, &file, job)?;
    work.told();
    opened.notes.iter().chain(&look.warnings()).for_each(|n| say::note(&format!("note: {n}")));
    say::result(&(wrote + "\n"))?;
    Ok(Outcome::Done)
}
