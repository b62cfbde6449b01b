//! `gridshell generate`: from a surface to a measured grid.

use crate::Outcome;
use crate::args::Generate;
use crate::failure::Failure;
use crate::progress::Work;
use crate::subject::Subject;
use crate::{handover, recipe, report, say, table};
use gridshell::io::{self, Document, GridFile};
use gridshell::job::Job;
use gridshell::run::Run;
use gridshell::structure::Supports;
use gridshell::{DVec3, pipeline};
use std::path::{Path, PathBuf};

pub fn run(args: &Generate, work: &Work) -> Result<Outcome, Failure> {
    let job = &work.job;
    let again = again(&args.surface, job)?;
    let recipe = recipe::from_args(args, again.as_ref().and_then(|d| d.recipe.as_ref()), job)?;
    args.output.iter().try_for_each(|path| handover::check_output(path))?;
    args.report.as_deref().map_or(Ok(()), report::check)?;
    let structure = handover::structure(&args.handover)?;
    let supports = handover::supports(&args.handover, job)?;
    if let Some(n) = args.threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(n));
        pool.build_global().map_err(Failure::other)?;
    }
    let opening = args.reading.opening();
    let (model, reference) = match again.as_ref().and_then(|d| d.surface.clone()) {
        Some(reference) => {
            (io::open_reference(&reference, Path::new(&args.surface), job), Ok(reference))
        }
        None => (
            io::open_with(&args.surface, &opening, job),
            io::reference(&args.surface, &opening, job),
        ),
    };
    let model = model.map_err(Failure::of_input)?;
    let reference = reference.map_err(Failure::of_input)?;
    let run = pipeline::generate(&model, &recipe, job)?;
    // What was stopped is there: what remains is to write it.
    let job = &job.after();

    let outputs = match args.output.as_slice() {
        [] => vec![default_output(&run, &args.surface)],
        given => given.to_vec(),
    };
    let supports = match (supports, again) {
        (None, Some(before)) if is_same(&run, &before) => before.supports,
        (supports, _) => {
            let (surface, _) = pipeline::surface(&model, &recipe, job)?;
            supports.unwrap_or(Supports::Boundary).nodes(&run.grid, &surface)?
        }
    };
    let document = Document::of_run(&run, reference, supports);
    let file = GridFile { document: &document, schedule: &run.schedule, structure: &structure };
    let wrote = handover::write_all(&outputs, &file, job);
    let mut told = String::new();
    if let Some(path) = &args.report {
        let page = report::page(&Subject::of_run(&run, &document), Some(&run));
        report::write(path, &page)?;
        told = format!("\nwrote {}", path.display());
    }
    let wrote = wrote? + &told;
    work.told();
    if args.json {
        say::json(&run)?;
        say::note(&wrote);
    } else {
        say::result(&(table::run(&run) + &wrote + "\n"))?;
    }
    Ok(if run.stopped { Outcome::Stopped } else { Outcome::Done })
}

/// The run to be repeated, where the surface is a grid file of one.
fn again(surface: &str, job: &Job) -> Result<Option<Document>, Failure> {
    let path = Path::new(surface);
    if path.extension().is_none_or(|e| !e.eq_ignore_ascii_case("gridshell")) {
        return Ok(None);
    }
    let document = io::read_document(path, job).map_err(Failure::of_input)?;
    if document.surface.is_none() || document.recipe.is_none() {
        return Err(Failure::input(path, "it tells of no run that could be repeated"));
    }
    Ok(Some(document))
}

fn is_same(run: &Run, before: &Document) -> bool {
    run.grid.xyz.iter().map(DVec3::to_array).eq(before.nodes.iter().copied())
}

/// `<name>.obj` in the current folder, or `<name>-grid.obj` where that is the surface's own file.
fn default_output(run: &Run, surface: &str) -> PathBuf {
    let plain = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
    let name: String = run.surface.name.chars().map(plain).collect();
    let name = if name.is_empty() { "grid" } else { &name };
    let path = PathBuf::from(format!("{name}.obj"));
    match (path.canonicalize(), Path::new(surface).canonicalize()) {
        (Ok(output), Ok(input)) if output == input => PathBuf::from(format!("{name}-grid.obj")),
        _ => path,
    }
}
