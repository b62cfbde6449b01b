//! `gridshell generate`: from a surface to a measured grid.

use crate::Outcome;
use crate::args::Generate;
use crate::failure::Failure;
use crate::progress::Work;
use crate::{handover, recipe, say, table};
use gridshell::design::Design;
use gridshell::io::{self, Document};
use gridshell::job::Job;
use gridshell::pipeline;
use gridshell_report::page;
use std::path::{Path, PathBuf};

pub fn run(args: &Generate, work: &Work) -> Result<Outcome, Failure> {
    let job = &work.job;
    let again = again(&args.surface, job)?;
    let recipe = recipe::from_args(args, again.as_ref().and_then(|d| d.recipe.as_ref()), job)?;
    args.output.iter().try_for_each(|path| handover::check_output(path))?;
    args.report.as_deref().map_or(Ok(()), page::check).map_err(Failure::of_output)?;
    let structure = handover::structure(&args.handover)?;
    let supports = handover::supports(&args.handover, job)?;
    let opening = args.reading.opening();
    let (model, reference) = match again.as_ref().and_then(|d| d.surface.clone()) {
        Some(reference) => {
            let follow = args.following.follow();
            (io::open_reference(&reference, Path::new(&args.surface), follow, job), Ok(reference))
        }
        None => (
            io::open_with(&args.surface, &opening, job),
            io::reference(&args.surface, &opening, job),
        ),
    };
    let model = model.map_err(Failure::of_input)?;
    let reference = reference.map_err(Failure::of_input)?;
    // Losses that are too large to go on with are named by the error.
    pipeline::check_whole(&model, &recipe, job)?;
    say::reading("", &model.source().told_losses(), model.notes());
    let mut design = Design::generate(&model, &recipe, job)?.referring_to(Some(reference));
    // What was stopped is there: what remains is to write it.
    let job = &job.after();

    let outputs = match args.output.as_slice() {
        [] => vec![default_output(design.name(), &args.surface)],
        given => given.to_vec(),
    };
    match (supports, again) {
        (Some(supports), _) => design.support(&supports)?,
        (None, Some(before)) if before.nodes == design.document.nodes => {
            design.document.supports = before.supports;
        }
        (None, _) => {}
    }
    design.structure = structure;
    let (mut wrote, written) = handover::write_all(&outputs, &design, job);
    let mut reported = Ok(());
    if let Some(path) = &args.report {
        reported = page::write(path, &page::of(&design)).map_err(Failure::of_output);
        if reported.is_ok() {
            wrote.push(format!("wrote {}", path.display()));
        }
    }
    work.told();
    handover::all_or_told(&wrote, [written, reported])?;
    let wrote = wrote.join("\n");
    let run = design.run.as_deref().expect("it was made here");
    if args.json {
        say::json(run)?;
        say::note(&wrote);
    } else {
        say::result(&(table::run(run) + &wrote + "\n"))?;
    }
    for part in &run.failed {
        say::note(&format!("warning: {}", part.told()));
    }
    Ok(match () {
        () if run.stopped => Outcome::Stopped,
        () if !run.failed.is_empty() => Outcome::Partial,
        () => Outcome::Done,
    })
}

/// The run to be repeated, where the surface is a grid file of one.
fn again(surface: &str, job: &Job) -> Result<Option<Document>, Failure> {
    let path = Path::new(surface);
    if path.extension().is_none_or(|e| !e.eq_ignore_ascii_case("gridshell")) {
        return Ok(None);
    }
    let document = io::read_document(path, job).map_err(Failure::of_input)?;
    if document.surface.is_none() || document.recipe.is_none() {
        return Err(Failure::input(
            path,
            "the file does not record a run, so it cannot be repeated",
        ));
    }
    Ok(Some(document))
}

/// `<name>.obj` in the current folder, or `<name>-grid.obj` where that is the surface's own file.
fn default_output(name: &str, surface: &str) -> PathBuf {
    let plain = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
    let name: String = name.chars().map(plain).collect();
    let name = if name.is_empty() { "grid" } else { &name };
    let path = PathBuf::from(format!("{name}.obj"));
    match (path.canonicalize(), Path::new(surface).canonicalize()) {
        (Ok(output), Ok(input)) if output == input => PathBuf::from(format!("{name}-grid.obj")),
        _ => path,
    }
}
