//! `gridshell edit`: replay a log of edits on a grid.

use crate::Outcome;
use crate::args::Edit;
use crate::failure::Failure;
use crate::progress::Work;
use crate::{handover, open, say};
use gridshell::Error;
use gridshell::edit::{Figures, Log};
use gridshell::io;
use gridshell::job::Job;
use gridshell::validity::Fault;
use serde::Serialize;
use std::fmt::Write;
use std::path::Path;

/// A larger file is not read as a log: a million edits take less.
const LARGEST_LOG: u64 = 100_000_000;

/// The document of `--json`.
#[derive(Serialize)]
struct Document {
    schema: &'static str,
    version: &'static str,
    /// The figures before the first edit.
    before: Figures,
    /// Each edit, with the figures after it.
    edits: Vec<Step>,
    /// Suggested edits, the best first, with the figures after each.
    suggested: Vec<Step>,
}

#[derive(Serialize)]
struct Step {
    edit: gridshell::edit::Edit,
    after: Figures,
}

pub fn run(args: &Edit, work: &Work) -> Result<Outcome, Failure> {
    let job = &work.job;
    args.output.iter().try_for_each(|path| handover::check_output(path))?;
    let structure = handover::structure(&args.handover)?;
    let supports = handover::supports(&args.handover, job)?;
    let log = args.log.as_deref().map(|path| read_log(path, job)).transpose()?;
    let mut opened = open::open(&args.grid, job)?;
    opened.structure = structure;
    let mut editor = opened.edit();
    let before = editor.figures();
    if let (Some(log), Some(path)) = (log, &args.log) {
        editor.replay(&log, job).map_err(|e| match e {
            Error::Stopped { .. } => Failure::from(e),
            e => Failure::input(path, e),
        })?;
    }
    let steps = |edits: Vec<(gridshell::edit::Edit, Figures)>| -> Vec<Step> {
        edits.into_iter().map(|(edit, after)| Step { edit, after }).collect()
    };
    let edits = steps(editor.history().map(|(e, f)| (e.clone(), f.after)).collect());
    let suggested =
        steps(editor.suggest(args.suggest, job).into_iter().map(|(e, f)| (e, f.after)).collect());
    // What was done is there: what remains is to write it.
    let job = &job.after();
    let mut design = opened.edited(&editor, job)?;
    supports.iter().try_for_each(|s| design.support(s))?;
    let worse = design.faults.iter().any(|f| is_new(f, &opened.faults));
    if let Some(what) = design.invalid().filter(|_| worse && !args.keep_invalid)
        && !args.output.is_empty()
    {
        return Err(Failure::invalid(format!(
            "the edits leave no valid grid: {what}; take the last ones out of the log, or write it all the same with \
             --keep-invalid"
        )));
    }
    let (wrote, written) = handover::write_all(&args.output, &design, job);
    handover::all_or_told(&wrote, [written])?;
    let wrote = wrote.join("\n");
    let (schema, version) = ("gridshell.edit/1", env!("CARGO_PKG_VERSION"));
    work.told();
    if args.json {
        say::json(&Document { schema, version, before, edits, suggested })?;
        wrote.lines().for_each(say::note);
    } else {
        say::result(&table(&before, &edits, &suggested, &wrote))?;
    }
    for n in &design.warnings {
        say::note(&format!("note: {n}"));
    }
    Ok(if work.job.stopped() { Outcome::Stopped } else { Outcome::Done })
}

/// Whether the grid did not have this fault before it was edited.
fn is_new(fault: &Fault, before: &[Fault]) -> bool {
    !before.iter().any(|f| f.kind == fault.kind && f.at == fault.at)
}

fn read_log(path: &Path, job: &Job) -> Result<Log, Failure> {
    let text = io::read_text(path, LARGEST_LOG, job)?;
    Log::from_json(&text).map_err(|e| Failure::input(path, e))
}

/// What was done and what is suggested, a line each.
fn table(before: &Figures, edits: &[Step], suggested: &[Step], wrote: &str) -> String {
    let mut text =
        format!("{:44} {:>9} {:>8} {:>8} {:>8} {:>9}\n", "", "R", "mu", "Q", "merit", "irregular");
    let mut line = |what: &str, f: &Figures| {
        let q = f.fluency.map_or("inf".to_owned(), |q| format!("{q:.3}"));
        let Figures { residual: r, mu, merit, irregular, .. } = f;
        let _ = writeln!(text, "{what:44} {r:9.2} {mu:8.4} {q:>8} {merit:8.3} {irregular:9}");
    };
    line("before", before);
    for (k, step) in edits.iter().enumerate() {
        line(&format!("{}. {}", k + 1, step.edit), &step.after);
    }
    for step in suggested {
        line(&format!("suggested: {}", step.edit), &step.after);
    }
    if !wrote.is_empty() {
        let _ = writeln!(text, "{wrote}");
    }
    text
}
