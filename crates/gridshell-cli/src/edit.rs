//! `gridshell edit`: replay a log of edits on a grid.

use crate::Outcome;
use crate::args::Edit;
use crate::failure::Failure;
use crate::progress::Work;
use crate::{handover, recipe, say};
use gridshell::Error;
use gridshell::edit::{Editor, Figures, Log};
use gridshell::io::GridFile;
use gridshell::reopen::{self, Opened};
use gridshell::schedule::{Schedule, Tolerances};
use gridshell::validity::Fault;
use serde::Serialize;
use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::sync::Arc;

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
    let log = args.log.as_deref().map(read_log).transpose()?;
    let opening = args.reading.opening();
    let mut opened = reopen::open(&args.grid, args.surface.as_deref(), &opening, job)
        .map_err(Failure::of_input)?;
    recipe::tolerances(&mut opened.recipe, &args.alike);
    let Opened { document, grid, surface, edge_length, recipe, notes, .. } = opened;
    let tolerances = Tolerances::from(&recipe.measure);
    let mut editor = Editor::new(Arc::new(surface), grid, recipe, edge_length);
    let before = editor.figures();
    let faults = editor.validity(&editor.finished()).faults;
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
    let grid = editor.finished();
    let schedule = Schedule::within(&grid, editor.surface(), &tolerances, job)?;
    let mut document = reopen::edited(&document, &editor);
    if let Some(supports) = supports {
        document.supports = supports.nodes(&grid, editor.surface())?;
    }
    document.panels.clone_from(&schedule.panels.nodes);
    let look = editor.validity(&grid);
    document.invalid = (!look.is_valid()).then(|| look.summary());
    if !args.output.is_empty()
        && !args.keep_invalid
        && look.faults.iter().any(|f| is_new(f, &faults))
    {
        return Err(Failure::invalid(format!(
            "the edits leave no valid grid: {}; take the last ones out of the log, or write it all the same with \
             --keep-invalid",
            look.summary()
        )));
    }
    let file = GridFile { document: &document, schedule: &schedule, structure: &structure };
    let wrote = handover::write_all(&args.output, &file, job)?;
    let (schema, version) = ("gridshell.edit/1", env!("CARGO_PKG_VERSION"));
    work.told();
    if args.json {
        say::json(&Document { schema, version, before, edits, suggested })?;
        wrote.lines().for_each(say::note);
    } else {
        say::result(&table(&before, &edits, &suggested, &wrote))?;
    }
    for n in notes.iter().chain(&look.warnings()) {
        say::note(&format!("note: {n}"));
    }
    Ok(if work.job.stopped() { Outcome::Stopped } else { Outcome::Done })
}

/// Whether the grid did not have this fault before it was edited.
fn is_new(fault: &Fault, before: &[Fault]) -> bool {
    !before.iter().any(|f| f.kind == fault.kind && f.at == fault.at)
}

fn read_log(path: &Path) -> Result<Log, Failure> {
    let size = fs::metadata(path).map_err(|e| Failure::input(path, e))?.len();
    if size > LARGEST_LOG {
        return Err(Failure::input(path, format!("{size} bytes are no log of edits")));
    }
    let text = fs::read_to_string(path).map_err(|e| Failure::input(path, e))?;
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
