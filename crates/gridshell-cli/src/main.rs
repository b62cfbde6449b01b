//! The command `gridshell`: reads arguments, calls the library, prints. All geometry is in the library.

mod args;
mod compare;
mod convert;
mod draw;
mod edit;
mod facts;
mod failure;
mod generate;
mod handover;
mod inspect;
mod measure;
mod open;
mod picture;
mod progress;
mod recipe;
mod report;
mod say;
#[cfg(feature = "studio")]
mod studio;
mod subject;
mod surfaces;
mod table;

use args::{Args, Command};
use clap::Parser;
use failure::Failure;
use progress::Work;
use std::process::ExitCode;

/// How a command that did not fail has ended.
pub enum Outcome {
    /// All done.
    Done,
    /// Stopped by a limit or a signal; the best so far was written.
    Stopped,
}

fn main() -> ExitCode {
    // A usage error leaves with code 2 here.
    let args = Args::parse();
    let limits = &args.limits;
    let work = match &args.command {
        #[cfg(feature = "studio")]
        // Its runs have jobs of their own; an interrupt ends it.
        Command::Studio(_) => Work::new(limits),
        _ => Work::interruptible(limits),
    };
    let result = match &args.command {
        Command::Generate(args) => generate::run(args, &work),
        Command::Measure(args) => measure::run(args, &work),
        Command::Edit(args) => edit::run(args, &work),
        Command::Convert(args) => convert::run(args, &work),
        Command::Draw(args) => draw::run(args, &work),
        Command::Compare(args) => compare::run(args, &work),
        Command::Inspect(args) => inspect::run(args, &work),
        #[cfg(feature = "studio")]
        Command::Studio(args) => studio::run(args, limits),
        Command::Surfaces => surfaces::run(),
    };
    work.told();
    match result {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::Stopped) => ExitCode::from(failure::STOPPED),
        Err(Failure { code, message }) => {
            eprintln!("gridshell: {message}");
            ExitCode::from(code)
        }
    }
}
