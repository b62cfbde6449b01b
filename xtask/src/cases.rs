//! Grids on a folder of cases, as a table of their measures; then what becomes of its broken files.
//!
//! The folder has a README.md with a table whose columns begin with `file`, `what`, `area m2`, `loops` and `l0`.
//! A row may name several files: `roof.step, .igs` or `B_roof_ap203.step, _ap242.step`. Files with an l0 get a
//! grid, the others are only inspected; all of them count in the unit that the row's area shows. A row `broken/` stands for every file in that folder: each is to be
//! refused with exit code 3, or opened with notes, within ten seconds and a gigabyte.

use crate::build::{self, target};
use crate::watched::{self, Watched};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Command;

const HEADER: &str = "\
case                         nodes  mean/l0       r  mean q min q     mu (floor)  delta (floor)     Q   irregular  border r  area ratio  off surface  off boundary  chi faults  seconds    MB";
const BROKEN: &str = "\nfile                         exit  seconds    MB  what is said";
/// A broken file is to be done with within this many seconds.
const MOST_SECONDS: f64 = 10.0;
/// And with this much memory, MB.
const MOST_MEGABYTES: f64 = 1000.0;

/// A file of the table.
#[derive(Debug, PartialEq)]
struct Case {
    file: String,
    area: Option<Told>,
    loops: Option<u64>,
    edge_length: Option<f64>,
}

/// An area as the table tells it, with the error that its digits leave.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Told {
    value: f64,
    error: f64,
}

impl Told {
    fn parse(cell: &str) -> Option<Told> {
        let word = cell.split_whitespace().next()?;
        let value: f64 = word.parse().ok()?;
        let decimals = word.split_once('.').map_or(0, |(_, d)| d.len());
        Some(Told { value, error: (1e-4 * value).max(0.5 * 0.1f64.powi(decimals as i32)) })
    }

    /// The row's unit in the file's metres: 1, or a thousandth where the row speaks of millimetres.
    fn unit(self, area: f64) -> f64 {
        let fits = |unit: &f64| (area / (unit * unit) - self.value).abs() <= self.error;
        [1.0, 1e-3].into_iter().find(fits).unwrap_or(1.0)
    }
}

/// Run all cases of `folder`, or those whose file begins with one of the `words`; `--draft` among them makes quick
/// grids.
pub fn run(folder: &Path, words: &[&str]) -> Result<(), String> {
    let (draft, names): (Vec<&str>, Vec<&str>) = words.iter().partition(|&&w| w == "--draft");
    let effort = if draft.is_empty() { "standard" } else { "draft" };
    let table = fs::read_to_string(folder.join("README.md"))
        .map_err(|e| format!("{}: {e}", folder.join("README.md").display()))?;
    let gridshell = build::gridshell()?;
    let wanted = |file: &str| names.is_empty() || names.iter().any(|n| file.starts_with(n));
    let cases: Vec<Case> = table.lines().flat_map(parse_row).filter(|c| wanted(&c.file)).collect();
    println!("{HEADER}");
    for case in cases.iter().filter(|c| !c.file.ends_with('/')) {
        println!(
            "{}",
            measure(&gridshell, folder, case, effort)
                .unwrap_or_else(|e| format!("{:26} {e}", case.file))
        );
    }
    for case in cases.iter().filter(|c| c.file.ends_with('/')) {
        println!("{BROKEN}");
        for file in files(&folder.join(&case.file))? {
            let run = watched::run(Command::new(&gridshell).arg("inspect").arg(&file))?;
            println!("{}", broken_row(&file, &run));
        }
    }
    Ok(())
}

/// The files of a folder, by name.
fn files(folder: &Path) -> Result<Vec<std::path::PathBuf>, String> {
    let entries = fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut files: Vec<_> = entries.filter_map(|e| Some(e.ok()?.path())).collect();
    files.sort();
    Ok(files)
}

/// The files of a row of the table; none for other lines.
fn parse_row(line: &str) -> Vec<Case> {
    let cells = line.strip_prefix('|').map(|l| l.split('|').map(str::trim).collect::<Vec<_>>());
    let Some([files, _, area, loops, edge_length, ..]) = cells.as_deref() else {
        return Vec::new();
    };
    if *files == "file" || files.starts_with("---") {
        return Vec::new();
    }
    let number = |cell: &str| cell.split_whitespace().next()?.parse::<f64>().ok();
    let names = names(files);
    let case = |file: String| Case {
        file,
        area: Told::parse(area),
        loops: loops.parse().ok(),
        edge_length: number(edge_length),
    };
    names.into_iter().map(case).collect()
}

/// `roof.step, .igs, _mm.step` is short for names that begin as the first does.
fn names(cell: &str) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for name in cell.split(',').map(str::trim) {
        let first = names.first().map_or("", String::as_str);
        let stem = first.rsplit_once('.').map_or(first, |f| f.0);
        let full = match name.as_bytes().first() {
            Some(b'.') => format!("{stem}{name}"),
            Some(b'_') => format!("{}{name}", stem.rsplit_once('_').map_or(stem, |s| s.0)),
            _ => name.to_owned(),
        };
        names.push(full);
    }
    names
}

fn measure(gridshell: &Path, folder: &Path, case: &Case, effort: &str) -> Result<String, String> {
    let file = folder.join(&case.file);
    let inspected = watched::run(Command::new(gridshell).args(["inspect", "--json"]).arg(&file))?;
    let Some(edge_length) = case.edge_length else {
        return Ok(broken_row(Path::new(&case.file), &inspected));
    };
    let known: Value = serde_json::from_str(&inspected.stdout).unwrap_or_default();
    let area = known["surface"]["area"].as_f64().unwrap_or(f64::NAN);
    let unit = case.area.map_or(1.0, |told| told.unit(area));
    let edge_length = unit * edge_length;
    let stem = case.file.replace(['/', '.'], "_");
    let output = target().join("cases").join(format!("{stem}.obj"));
    fs::create_dir_all(target().join("cases")).map_err(|e| e.to_string())?;
    let mut command = Command::new(gridshell);
    command.args([
        "generate",
        "--part",
        "all",
        "--json",
        "--effort",
        effort,
        "--edge-length",
        &edge_length.to_string(),
        "-o",
    ]);
    let run = watched::run(command.arg(output).arg(file))?;
    let document: Value = serde_json::from_str(&run.stdout).map_err(|_| {
        let code = run.code.map_or("none".into(), |c| c.to_string());
        format!("exit {code} after {:.1} s: {}", run.seconds, run.stderr.trim())
    })?;
    Ok(row(case, edge_length, unit, &document, &run))
}

/// What became of a file that is only opened.
fn broken_row(file: &Path, run: &Watched) -> String {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let code = run.code.map_or("none".into(), |c| c.to_string());
    let said = if run.code == Some(0) { "opened" } else { run.stderr.trim() };
    let said = said.lines().next().unwrap_or("").replace(&*file.to_string_lossy(), &name);
    let fair = matches!(run.code, Some(0 | 3))
        && run.seconds <= MOST_SECONDS
        && run.megabytes <= MOST_MEGABYTES;
    let mark = if fair { "" } else { "  <-- not as it should be" };
    format!("{name:28} {code:>4} {:8.2} {:5.0}  {said}{mark}", run.seconds, run.megabytes)
}

fn row(case: &Case, edge_length: f64, unit: f64, document: &Value, run: &Watched) -> String {
    let q = &document["quality"];
    let at = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
    let surface = &document["surface"];
    let remarks = remarks(case, unit, surface);
    format!(
        "{:26} {:7} {:8.4} {:7.4} {:7.4} {:5.3} {:6.3} ({:5.3}) {:6.2} ({:5.2}) {:6.2} {:5} {:5} {:9.4} {:11.4} {:12.1e} {:13.1e} {:4} {:6} {:8.1} {:5.0}{remarks}",
        case.file,
        at(&q["nodes"]),
        at(&q["edge_length"]["mean"]) / edge_length,
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
        run.seconds,
        run.megabytes,
    )
}

/// Where the surface is not what the folder's table says.
fn remarks(case: &Case, unit: f64, surface: &Value) -> String {
    let mut remarks = String::new();
    let area = surface["area"].as_f64().unwrap_or(f64::NAN) / (unit * unit);
    if unit != 1.0 {
        remarks += "  in mm";
    }
    if let Some(told) = case.area.filter(|told| (area - told.value).abs() > told.error) {
        remarks += &format!("  area {area} is not {}", told.value);
    }
    if let Some(told) = case.loops.filter(|&told| surface["loops"].as_u64() != Some(told)) {
        remarks += &format!("  {} loops, not {told}", surface["loops"]);
    }
    remarks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_count_in_the_unit_that_they_show() {
        let told = Told::parse("309202 mm2").expect("an area");
        assert_eq!([told.unit(309202.3), told.unit(0.3092018), told.unit(7.0)], [1.0, 1e-3, 1.0]);
        assert_eq!(Told::parse("40.9").map(|t| t.unit(40.87)), Some(1.0));
        assert_eq!(Told::parse(""), None);
    }

    #[test]
    fn rows_name_all_their_files() {
        let files = |row| parse_row(row).into_iter().map(|c| c.file).collect::<Vec<_>>();
        assert_eq!(
            files("| B_roof_ap203.step, _ap242.step, _brep1.igs | what | 1434.444 | 3 | 1.5 |"),
            ["B_roof_ap203.step", "B_roof_ap242.step", "B_roof_brep1.igs"]
        );
        assert_eq!(
            files("| roof2.step, .igs, roof2_mm.step | what | 2488.063 | 3 | 3.1 |"),
            ["roof2.step", "roof2.igs", "roof2_mm.step"]
        );
        assert!(files("| file | what | area m2 | loops | l0 |").is_empty());
        assert!(files("|---|---|---|---|---|").is_empty());
    }

    #[test]
    fn a_row_without_figures_is_kept() {
        let cases = parse_row("| broken/ | truncated | | | |");
        assert_eq!((cases[0].area, cases[0].loops, cases[0].edge_length), (None, None, None));
    }
}
