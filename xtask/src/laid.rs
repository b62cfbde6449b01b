//! A grid laid by the command: what it printed, and the grid that it wrote.

use crate::build::target;
use glam::DVec3;
use serde_json::Value;
use std::fs;
use std::path::Path;
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
    /// Places of the nodes, metres.
    pub nodes: Vec<DVec3>,
    /// The nodes of each panel.
    pub panels: Vec<[usize; 3]>,
    /// Time from start to end.
    pub seconds: f64,
}

impl<'a> Order<'a> {
    /// The default recipe at seed 1 and the surface's own edge length.
    pub fn plain(surface: &'a str) -> Order<'a> {
        Order { surface, edge_length: None, seed: 1, method: "default" }
    }
}

/// Run the command `gridshell` and read what it wrote.
///
/// # Errors
/// What the command says on stderr where it gives no grid.
pub fn lay(gridshell: &Path, order: &Order) -> Result<Laid, String> {
    let file = target().join("laid.obj");
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
    let text = fs::read_to_string(&file).map_err(|e| format!("{}: {e}", file.display()))?;
    let (mut nodes, mut panels) = (Vec::new(), Vec::new());
    for line in text.lines() {
        match line.split_once(' ') {
            Some(("v", rest)) => nodes.push(DVec3::from(triple::<f64>(rest)?)),
            Some(("f", rest)) => panels.push(triple::<usize>(rest)?.map(|k| k - 1)),
            _ => {}
        }
    }
    Ok(Laid { document, nodes, panels, seconds })
}

fn triple<T: std::str::FromStr>(text: &str) -> Result<[T; 3], String> {
    let items: Vec<T> = text.split_whitespace().filter_map(|w| w.parse().ok()).collect();
    items.try_into().map_err(|_| "a line of the grid without three numbers".to_owned())
}
