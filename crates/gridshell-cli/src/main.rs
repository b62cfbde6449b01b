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
    let result = match &args.command {
        Command::Generate(args) => generate::run(args),
        Command::Measure(args) => measure::run(args),
        Command::Edit(args) => edit::run(args),
        Command::Convert(args) => convert::run(args),
        Command::Draw(args) => draw::run(args),
        Command::Compare(args) => compare::run(args),
        Command::Inspect(args) => inspect::run(args),
        #[cfg(feature = "studio")]
        Command::Studio(args) => studio::run(args),
        Command::Surfaces => surfaces::run(),
    };
    match result {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::Stopped) => ExitCode::from(failure::STOPPED),
        Err(Failure { code, message }) => {
            eprintln!("gridshell: {message}");
            ExitCode::from(code)
        }
    }
}
