//! Edits of a grid that is kept: done, taken back, weighed beforehand.

use crate::message::{Event, Step};
use gridshell::edit::{Edit, Editor, Effect, Refusal};
use gridshell::error::{Error, Result};
use gridshell::job::Job;
use gridshell::surface::Origin;
use serde_json::Value;

/// Suggestions made.
const SUGGESTED: usize = 8;

/// A change of merit beyond this is one from or to a grid without irregularity and disfluency.
const BOUNDLESS: f64 = 1e6;

/// The edit that the page means, which draws a surface of this origin.
///
/// # Errors
/// [`Error::Option`] for what is none.
pub fn parse(edit: Value, origin: Origin) -> Result<Edit> {
    let edit: std::result::Result<Edit, _> = serde_json::from_value(edit);
    let edit = edit.map_err(|e| Error::Option(format!("not an edit: {e}")))?;
    Ok(edit.from_local(origin))
}

/// The history, to be told; `before` are the edits that the grid came with.
pub fn history(run: u32, before: &[Value], editor: Option<&Editor>) -> Event {
    let told = |edit: &Value| match serde_json::from_value::<Edit>(edit.clone()) {
        Ok(edit) => edit.to_string(),
        Err(_) => edit.to_string(),
    };
    let before = before.iter().map(told).collect();
    let Some(editor) = editor else {
        return Event::History { run, before, done: Vec::new(), undone: Vec::new() };
    };
    let told = |(edit, effect): (&Edit, &Effect)| step(editor, edit, &Ok(*effect));
    Event::History {
        run,
        before,
        done: editor.history().map(told).collect(),
        undone: editor.undone().map(told).collect(),
    }
}

/// What each operation on a member would do.
pub fn hover(run: u32, question: u32, editor: &Editor, [a, b]: [u32; 2]) -> Event {
    let ways = if editor.grid().mesh.is_alive(a) && editor.grid().mesh.adjacent(a, b) {
        editor.hover(a, b).iter().map(|(edit, effect)| step(editor, edit, effect)).collect()
    } else {
        Vec::new()
    };
    Event::Hovered { run, question, ways }
}

/// The edits that would better the grid most.
pub fn suggest(run: u32, editor: &Editor) -> Event {
    let steps = editor.suggest(SUGGESTED, &Job::default());
    let steps = steps.into_iter().map(|(edit, effect)| step(editor, &edit, &Ok(effect))).collect();
    Event::Suggested { run, steps }
}

fn step(editor: &Editor, edit: &Edit, effect: &std::result::Result<Effect, Refusal>) -> Step {
    let (told, refusal, better) = match effect {
        Ok(effect) => (told(effect), None, effect.gain() > 0.0),
        Err(refusal) => (String::new(), Some(refusal.to_string()), false),
    };
    Step {
        edit: serde_json::to_value(edit).unwrap_or_default(),
        label: edit.to_string(),
        effect: told,
        refusal,
        better,
        at: place(editor, edit),
    }
}

/// What an edit does to Q, R and mu; and to the merit, where that is not the change of Q.
fn told(effect: &Effect) -> String {
    let none = || "–".to_owned();
    let q = effect.fluency().map_or_else(none, |q| change(q, 2));
    // Beside a perfect lattice, whose fluency has no bound, a number would say nothing.
    let merit = Some(effect.gain()).filter(|gain| gain.abs() < BOUNDLESS);
    let merit = merit.map_or_else(none, |gain| change(gain, 2));
    let told =
        format!("Q {q}, R {}, \u{3bc} {}", change(effect.residual(), 1), change(effect.mu(), 4));
    if merit == q { told } else { format!("{told}, merit {merit}") }
}

/// A change with its sign; one that rounds to nothing has none.
fn change(by: f64, digits: usize) -> String {
    let told = format!("{by:+.digits$}");
    if told.contains(|c: char| c.is_ascii_digit() && c != '0') { told } else { "\u{b1}0".into() }
}

/// The middle of the nodes that an edit names.
fn place(editor: &Editor, edit: &Edit) -> Option<[f64; 3]> {
    let nodes = match edit {
        Edit::Flip { nodes }
        | Edit::Split { nodes }
        | Edit::Collapse { nodes }
        | Edit::Drift { nodes, .. } => nodes.to_vec(),
        Edit::Move { node, .. } | Edit::Pin { node } | Edit::Unpin { node } => vec![*node],
        _ => return None,
    };
    let xyz: Option<Vec<glam::DVec3>> =
        nodes.iter().map(|&v| editor.grid().xyz.get(v as usize).copied()).collect();
    let xyz = xyz?;
    Some((xyz.iter().sum::<glam::DVec3>() / xyz.len() as f64).to_array())
}
