//! `gridshell edit`: replay a log of edits on a grid.

use crate::Outcome;
use crate::args::Edit;
use crate::failure::Failure;
use crate::{measure, say};
use gridshell::edit::{Editor, Figures, Log};
use gridshell::io::{self, GridFile};
use gridshell::recipe::Recipe;
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

pub fn run(args: &Edit) -> Result<Outcome, Failure> {
    args.output.iter().try_for_each(|path| io::check_output(path))?;
    let log = args.log.as_deref().map(read_log).transpose()?;
    let opening = args.reading.opening();
    let opened = measure::open(&args.grid, args.surface.as_deref(), &opening)?;
    let recipe = Recipe::default();
    let surface = Arc::new(opened.surface);
    let mut editor = Editor::new(surface, opened.grid, recipe, opened.edge_length);
    let before = editor.figures();
    if let (Some(log), Some(path)) = (log, &args.log) {
        editor.replay(&log).map_err(|e| Failure::input(path, e))?;
    }
    let steps = |edits: Vec<(gridshell::edit::Edit, Figures)>| -> Vec<Step> {
        edits.into_iter().map(|(edit, after)| Step { edit, after }).collect()
    };
    let edits = steps(editor.history().map(|(e, f)| (e.clone(), f.after)).collect());
    let suggested =
        steps(editor.suggest(args.suggest).into_iter().map(|(e, f)| (e, f.after)).collect());
    let mut wrote = Vec::new();
    for path in &args.output {
        write(&editor, &opened.name, path).map_err(Failure::other)?;
        wrote.push(format!("wrote {}", path.display()));
    }
    let (schema, version) = ("gridshell.edit/1", env!("CARGO_PKG_VERSION"));
    if args.json {
        say::json(&Document { schema, version, before, edits, suggested })?;
        for w in &wrote {
            say::note(w);
        }
    } else {
        say::result(&table(&before, &edits, &suggested, &wrote))?;
    }
    opened.notes.iter().for_each(|n| say::note(&format!("note: {n}")));
    Ok(Outcome::Done)
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
fn table(before: &Figures, edits: &[Step], suggested: &[Step], wrote: &[String]) -> String {
    let mut text = format!("{:44} {:>9} {:>8} {:>8} {:>9}\n", "", "R", "mu", "Q", "irregular");
    let mut line = |what: &str, f: &Figures| {
        let q = f.fluency.map_or("inf".to_owned(), |q| format!("{q:.3}"));
        let (r, mu, irregular) = (f.residual, f.mu, f.irregular);
        let _ = writeln!(text, "{what:44} {r:9.2} {mu:8.4} {q:>8} {irregular:9}");
    };
    line("before", before);
    for (k, step) in edits.iter().enumerate() {
        line(&format!("{}. {}", k + 1, step.edit), &step.after);
    }
    for step in suggested {
        line(&format!("suggested: {}", step.edit), &step.after);
    }
    for w in wrote {
        text += w;
        text.push('\n');
    }
    text
}

fn write(editor: &Editor, name: &str, path: &Path) -> gridshell::Result<()> {
    let grid = editor.finished();
    let triangles: Vec<_> = grid.mesh.triangles().collect();
    let edges: Vec<_> = grid.mesh.edges().collect();
    let header = [
        format!(
            "gridshell {}: {} after {} edits",
            env!("CARGO_PKG_VERSION"),
            name.replace(char::is_control, " "),
            editor.history().len()
        ),
        "lengths in metres".to_owned(),
    ];
    let file = GridFile { xyz: &grid.xyz, triangles: &triangles, edges: &edges, header: &header };
    io::write(path, &file)
}
