//! Grids on a folder of cases, as a table of their measures.
//!
//! The folder has a README.md with a table whose columns include `file`, `area m2`, `loops` and `l0`; the
//! first name in a row's `file` is taken, at the row's `l0`.

use crate::build::{self, target};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

const HEADER: &str = "\
case                       nodes  mean/l0       r  mean q min q     mu (floor)  delta (floor)     Q   irregular  border r  area ratio  off surface  off boundary  chi faults   seconds";

/// A row of the table.
struct Case {
    file: String,
    area: f64,
    loops: u64,
    edge_length: f64,
}

/// Run all cases of `folder`, or those whose file begins with one of `names`.
pub fn run(folder: &Path, names: &[&str]) -> Result<(), String> {
    let table = fs::read_to_string(folder.join("README.md"))
        .map_err(|e| format!("{}: {e}", folder.join("README.md").display()))?;
    let gridshell = build::gridshell()?;
    println!("{HEADER}");
    let wanted = |c: &Case| names.is_empty() || names.iter().any(|n| c.file.starts_with(n));
    for case in table.lines().filter_map(parse_row).filter(wanted) {
        println!(
            "{}",
            measure(&gridshell, folder, &case).unwrap_or_else(|e| format!("{:24} {e}", case.file))
        );
    }
    Ok(())
}

/// A row with a file, an area, a number of loops and an edge length; None for other lines.
fn parse_row(line: &str) -> Option<Case> {
    let cells: Vec<&str> = line.strip_prefix('|')?.split('|').map(str::trim).collect();
    let [file, _, area, loops, edge_length, ..] = cells.as_slice() else { return None };
    let number = |cell: &str| cell.split_whitespace().next()?.parse::<f64>().ok();
    Some(Case {
        file: file.split(',').next()?.to_owned(),
        area: number(area)?,
        loops: loops.parse().ok()?,
        edge_length: number(edge_length)?,
    })
}

fn measure(gridshell: &Path, folder: &Path, case: &Case) -> Result<String, String> {
    let stem = Path::new(&case.file).file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let output = target().join("cases").join(format!("{stem}.obj"));
    fs::create_dir_all(target().join("cases")).map_err(|e| e.to_string())?;
    let start = Instant::now();
    let run = Command::new(gridshell)
        .args(["generate", "--json", "--edge-length", &case.edge_length.to_string(), "-o"])
        .arg(output)
        .arg(folder.join(&case.file))
        .output()
        .map_err(|e| e.to_string())?;
    let seconds = start.elapsed().as_secs_f64();
    let document: Value = serde_json::from_slice(&run.stdout)
        .map_err(|_| String::from_utf8_lossy(&run.stderr).trim().to_owned())?;
    Ok(row(case, &document, seconds))
}

fn row(case: &Case, document: &Value, seconds: f64) -> String {
    let q = &document["quality"];
    let at = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let surface = &document["surface"];
    let remarks = remarks(case, surface);
    format!(
        "{:24} {:7} {:8.4} {:7.4} {:7.4} {:5.3} {:6.3} ({:5.3}) {:6.2} ({:5.2}) {:6.2} {:5} {:5} {:9.4} {:11.4} {:12.1e} {:13.1e} {:4} {:6} {seconds:9.1}{remarks}",
        case.file,
        at(&q["nodes"]),
        at(&q["edge_length"]["mean"]) / case.edge_length,
        at(&q["edge_length"]["cv"]),
        at(&q["shape"]["mean"]),
        at(&q["shape"]["min"]),
        at(&q["mu"]),
        at(&q["mu_floor"]),
        at(&q["delta_deg"]),
        at(&q["delta_floor_deg"]),
        q["fluency"].as_f64().unwrap_or(f64::INFINITY),
        at(&q["irregular"]["interior"]),
        at(&q["irregular"]["boundary"]),
        at(&q["border"]["edge_length_cv"]),
        at(&q["area_ratio"]),
        at(&q["surface_deviation"]),
        at(&q["boundary_deviation"]),
        at(&q["euler_characteristic"]),
        at(&q["bridging_members"]) + at(&q["folded_panels"]),
    )
}

/// Where the surface is not what the folder's table says.
fn remarks(case: &Case, surface: &Value) -> String {
    let area = surface["area"].as_f64().unwrap_or(f64::NAN);
    let same_area = (area / case.area - 1.0).abs() <= 1e-4;
    let same_loops = surface["loops"].as_u64() == Some(case.loops);
    let area =
        if same_area { String::new() } else { format!("  area {area} is not {}", case.area) };
    let loops = if same_loops {
        String::new()
    } else {
        format!("  {} loops, not {}", surface["loops"], case.loops)
    };
    area + &loops
}
