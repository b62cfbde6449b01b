//! Errors in the words and exit codes of the command.

use gridshell::Error;
use std::fmt::Display;
use std::path::Path;

/// An output could not be written, or something unforeseen.
const FAILED: u8 = 1;
const USAGE: u8 = 2;
const INPUT: u8 = 3;
const NO_GRID: u8 = 4;
/// Exit code of a run that a limit or a signal ended.
pub const STOPPED: u8 = 5;

/// Why the command gives up, and its exit code.
#[derive(Debug)]
pub struct Failure {
    pub code: u8,
    pub message: String,
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let code = match &error {
            Error::Option(_) => USAGE,
            Error::NoGrid { .. } | Error::Invalid { .. } => NO_GRID,
            Error::Stopped { .. } | Error::Memory(_) => STOPPED,
            Error::Io { .. } | Error::Parse { .. } | Error::Surface(_) => INPUT,
        };
        Failure { code, message: error.to_string() }
    }
}

impl Failure {
    pub fn usage(message: impl Display) -> Failure {
        Failure { code: USAGE, message: message.to_string() }
    }

    /// For whatever went wrong while opening the input, a name that is none included.
    pub fn of_input(error: Error) -> Failure {
        match error {
            Error::Stopped { .. } | Error::Memory(_) => Failure::from(error),
            _ => Failure { code: INPUT, message: error.to_string() },
        }
    }

    /// For a grid that is not valid.
    pub fn invalid(message: impl Display) -> Failure {
        Failure { code: NO_GRID, message: message.to_string() }
    }

    pub fn input(path: &Path, message: impl Display) -> Failure {
        Failure { code: INPUT, message: format!("{}: {message}", path.display()) }
    }

    /// For an output that cannot be: what was asked is at fault, or the system is.
    pub fn of_output(error: Error) -> Failure {
        match error {
            Error::Io { .. } => Failure::other(error),
            _ => Failure::from(error),
        }
    }

    /// For errors after the input has been accepted.
    pub fn other(message: impl Display) -> Failure {
        Failure { code: FAILED, message: message.to_string() }
    }
}
