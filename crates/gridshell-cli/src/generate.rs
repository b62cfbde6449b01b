//! `gridshell generate`: from a surface to a measured grid.

use crate::Outcome;
use crate::args::Generate;
use crate::failure::Failure;
use crate::{progress, recipe, say, table};
use gridshell::io::{self, GridFile};
use gridshell::pipeline;
use gridshell::run::Run;
use std::path::{Path, PathBuf};

pub fn run(args: &Generate) -> Result<Outcome, Failure> {
    let recipe = recipe::from_args(args)?;
    args.output.iter().try_for_each(|path| check_output(path))?;
    if let Some(n) = args.threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::from(n));
        pool.build_global().map_err(Failure::other)?;
    }
    let opening = args.reading.opening();
    let model = io::open_with(&args.surface, &opening).map_err(Failure::of_input)?;
    let (job, bar) = progress::job(args.time_limit);
    let run = pipeline::generate(&model, &recipe, &job);
    bar.finish_and_clear();
    let run = run?;

    let outputs = match args.output.as_slice() {
        [] => vec![default_output(&run, &args.surface)],
        given => given.to_vec(),
    };
    write_all(&run, &outputs)?;
    let wrote: Vec<_> = outputs.iter().map(|p| format!("wrote {}", p.display())).collect();
    let wrote = wrote.join("\n");
    if args.json {
        say::json(&run)?;
        say::note(&wrote);
    } else {
        say::result(&(table::run(&run) + &wrote + "\n"))?;
    }
    Ok(if run.stopped { Outcome::Stopped } else { Outcome::Done })
}

fn write_all(run: &Run, outputs: &[PathBuf]) -> Result<(), Failure> {
    let triangles: Vec<_> = run.grid.mesh.triangles().collect();
    let edges: Vec<_> = run.grid.mesh.edges().collect();
    let header = [
        format!(
            "gridshell {}: grid on {}",
            run.version,
            run.surface.name.replace(char::is_control, " ")
        ),
        format!("edge length {} m, seed {}, lengths in metres", run.edge_length, run.seed),
    ];
    let file =
        GridFile { xyz: &run.grid.xyz, triangles: &triangles, edges: &edges, header: &header };
    outputs.iter().try_for_each(|path| io::write(path, &file)).map_err(Failure::other)
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

/// Refuse an output that cannot be written before the work is done, not after.
fn check_output(path: &Path) -> Result<(), Failure> {
    io::check_output(path)?;
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
