//! The one error of the library, in the user's words.

use std::path::PathBuf;

/// Shorthand used throughout the crate.
pub type Result<T> = std::result::Result<T, Error>;

/// What can go wrong, with the file, line, entity or place that it concerns.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file could not be opened, read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A file's contents are not what its format asks for.
    #[error("{}: {place}: {message}", path.display())]
    Parse {
        /// The file.
        path: PathBuf,
        /// Line ("line 12") or entity ("#40") where it happened.
        place: String,
        /// What is wrong and what to do.
        message: String,
    },
    /// The input is readable but no grid can be laid on it.
    #[error("{0}")]
    Surface(String),
    /// An option or recipe value is out of range.
    #[error("{0}")]
    Option(String),
    /// No valid grid of this edge length exists at this place.
    #[error("no valid grid near ({:.3}, {:.3}, {:.3}): {message}; an edge length of about {edge_length:.3} m would work", at[0], at[1], at[2])]
    NoGrid {
        /// Where, in metres.
        at: [f64; 3],
        /// What went wrong there.
        message: String,
        /// A length that would fit, in metres.
        edge_length: f64,
    },
    /// A grid was made, but it is not valid, and repairing it did not help.
    #[error("no valid grid: {message}; {advice}")]
    Invalid {
        /// What is wrong with it, how often and where.
        message: String,
        /// What to do.
        advice: String,
        /// All places, in metres.
        places: Vec<[f64; 3]>,
    },
    /// Stopped by a limit or by who asked for it, before there was a grid.
    #[error("{}", stopped(phase))]
    Stopped {
        /// What was going on: "reading", "preparing the surface".
        phase: &'static str,
    },
    /// More memory was needed than the limit allows.
    #[error("{0}")]
    Memory(String),
}

/// What a stop is told as: once a grid is there, it is only what was asked of it that is not done.
fn stopped(phase: &str) -> String {
    match phase {
        "measuring" | "drawing" | "writing" | "searching for a valid grid" => {
            format!("stopped {phase}")
        }
        _ => format!("stopped {phase}, before there was a grid"),
    }
}
