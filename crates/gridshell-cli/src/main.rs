//! The command `gridshell`: reads arguments, calls the library, prints. All geometry is in the library.

mod args;
mod compare;
mod convert;
mod draw;
mod edit;
mod failure;
mod generate;
mod handover;
mod inspect;
mod manual;
mod measure;
mod open;
mod progress;
mod recipe;
mod say;
#[cfg(feature = "studio")]
mod studio;
mod surfaces;
mod table;
mod threads;

use args::{Args, Command};
use clap::Parser;
use failure::Failure;
use progress::Work;
use std::io::{ErrorKind, Write};
use std::process::ExitCode;

/// How a command that did not fail has ended.
pub enum Outcome {
    /// All done.
    Done,
    /// Done, but for parts of the surface that have no grid.
    Partial,
    /// Stopped by a limit or a signal; the best so far was written.
    Stopped,
}

fn main() -> ExitCode {
    threads::keep_when_files_are_limited();
    let args = match Args::try_parse() {
        Ok(args) => args,
        Err(error) => return usage(&error),
    };
    let asked = match &args.command {
        Command::Generate(args) => args.threads,
        _ => None,
    };
    let limits = &args.limits;
    let work = match &args.command {
        #[cfg(feature = "studio")]
        // Its runs have jobs of their own; an interrupt ends it.
        Command::Studio(_) => Work::new(limits),
        Command::Generate(_) | Command::Edit(_) => Work::interruptible(limits),
        _ => Work::interruptible(limits).ends_at_once(),
    };
    let result = threads::start(asked).and_then(|()| run(&args, &work));
    work.told();
    match result {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::Partial) => ExitCode::from(failure::PARTIAL),
        Ok(Outcome::Stopped) => ExitCode::from(failure::STOPPED),
        Err(Failure { code, message }) => {
            say::note(&format!("gridshell: {message}"));
            ExitCode::from(code)
        }
    }
}

fn run(args: &Args, work: &Work) -> Result<Outcome, Failure> {
    let limits = &args.limits;
    match &args.command {
        Command::Generate(args) => generate::run(args, work),
        Command::Measure(args) => measure::run(args, work),
        Command::Edit(args) => edit::run(args, work),
        Command::Convert(args) => convert::run(args, work),
        Command::Draw(args) => draw::run(args, work),
        Command::Compare(args) => compare::run(args, work),
        Command::Inspect(args) => inspect::run(args, work),
        #[cfg(feature = "studio")]
        Command::Studio(args) => studio::run(args, limits),
        Command::Surfaces => surfaces::run(),
        Command::Manual(args) => manual::run(args),
    }
}

/// Arguments that are wrong, or that ask for help or the version.
fn usage(error: &clap::Error) -> ExitCode {
    let printed = error.print().and_then(|()| std::io::stdout().flush());
    match printed {
        _ if error.use_stderr() => ExitCode::from(failure::USAGE),
        Err(e) if e.kind() != ErrorKind::BrokenPipe => ExitCode::from(failure::FAILED),
        _ => ExitCode::SUCCESS,
    }
}
