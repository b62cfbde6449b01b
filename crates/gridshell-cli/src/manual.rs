//! `gridshell manual`: shell completions and man pages, made from the arguments.

use crate::Outcome;
use crate::args::{Args, Manual};
use crate::failure::Failure;
use clap::CommandFactory;
use clap_complete::Shell;
use std::fs;

const SHELLS: [Shell; 4] = [Shell::Bash, Shell::Fish, Shell::PowerShell, Shell::Zsh];

pub fn run(args: &Manual) -> Result<Outcome, Failure> {
    let [completions, man] = ["completions", "man"].map(|name| args.folder.join(name));
    for folder in [&completions, &man] {
        fs::create_dir_all(folder)
            .map_err(|e| Failure::other(format!("{}: {e}", folder.display())))?;
    }
    for shell in SHELLS {
        clap_complete::generate_to(shell, &mut Args::command(), "gridshell", &completions)
            .map_err(|e| Failure::other(format!("{}: {e}", completions.display())))?;
    }
    clap_mangen::generate_to(Args::command(), &man)
        .map_err(|e| Failure::other(format!("{}: {e}", man.display())))?;
    Ok(Outcome::Done)
}
