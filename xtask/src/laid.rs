//! A grid laid by the command: what it printed, and the grid that it wrote.

use crate::build::target;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

/// What the command is asked for.
pub struct Order<'a> {
    /// A built-in name or a file.
    pub surface: &'a str,
    /// Wanted length of the members, metres; None for the surface's own.
    pub edge_length: Option<f64>,
    /// Seed of every random choice.
    pub seed: u64,
    /// Name of the method.
    pub method: &'a str,
}

/// What it gave.
pub struct Laid {
    /// The document of `--json`.
    pub document: Value,
    /// The grid; the next one takes its place.
    pub file: PathBuf,
    /// Time from start to end.
    pub seconds: f64,
}

impl<'a> Order<'a> {
    /// The default recipe at seed 1 and the surface's own edge length.
    pub fn plain(surface: &'a str) -> Order<'a> {
        Order { surface, edge_length: None, seed: 1, method: "default" }
    }
}

/// Run the command `gridshell`.
///
/// # Errors
/// What the command says on stderr where it gives no grid.
pub fn lay(gridshell: &Path, order: &Order) -> Result<Laid, String> {
    let file = target().join("laid.gridshell");
    let mut command = Command::new(gridshell);
    command.args(["generate", order.surface, "--json", "--method", order.method, "--seed"]);
    command.arg(order.seed.to_string()).arg("-o").arg(&file);
    if let Some(length) = order.edge_length {
        command.args(["--edge-length", &length.to_string()]);
    }
    let start = Instant::now();
    let run = command.output().map_err(|e| e.to_string())?;
    let seconds = start.elapsed().as_secs_f64();
    let document = serde_json::from_slice(&run.stdout)
        .map_err(|_| String::from_utf8_lossy(&run.stderr).trim().to_owned())?;
    Ok(Laid { document, file, seconds })
}

impl Laid {
    /// Draw the grid to a file.
    ///
    /// # Errors
    /// What the command says.
    pub fn draw(&self, gridshell: &Path, options: &[&str], picture: &Path) -> Result<(), String> {
        let mut command = Command::new(gridshell);
        command.arg("draw").arg(&self.file).args(options).arg("-o").arg(picture);
        let run = command.output().map_err(|e| e.to_string())?;
        if run.status.success() {
            return Ok(());
        }
        Err(String::from_utf8_lossy(&run.stderr).trim().to_owned())
    }
}
