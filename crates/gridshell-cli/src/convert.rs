//! `gridshell convert`: a grid in other formats.

use crate::Outcome;
use crate::args::Convert;
use crate::failure::Failure;
use crate::progress::Work;
use crate::{handover, open, say};

pub fn run(args: &Convert, work: &Work) -> Result<Outcome, Failure> {
    let job = &work.job;
    args.output.iter().try_for_each(|path| handover::check_output(path))?;
    let structure = handover::structure(&args.handover)?;
    let supports = handover::supports(&args.handover, job)?;
    let mut design = open::open(&args.grid, job)?;
    design.structure = structure;
    supports.iter().try_for_each(|s| design.support(s))?;
    let (wrote, written) = handover::write_all(&args.output, &design, job);
    work.told();
    handover::all_or_told(&wrote, [written])?;
    let wrote = wrote.join("\n");
    design.warnings.iter().for_each(|n| say::note(&format!("note: {n}")));
    say::result(&(wrote + "\n"))?;
    Ok(Outcome::Done)
}
