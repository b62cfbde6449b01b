//! The quality of the grids: measured and held against the bars, and shown. `cargo xtask bench quality` writes
//! `docs/quality.md`, `cargo xtask pictures` the gallery.

mod bars;
mod figure;
mod gallery;
mod table;
mod trouble;

pub use gallery::{gallery, picture};

use crate::build;
use crate::laid::{Laid, Order, lay};
use bars::{Bar, CASES, Case, EVERY, FURTHER};
use figure::Figure;
use std::fs;
use std::path::{Path, PathBuf};
use table::Table;
use trouble::{Trouble, summary};

/// Seeds of the further surfaces.
const SEEDS: u64 = 5;

/// Figures of the further surfaces.
const SHORT: [Figure; 5] =
    [Figure::Fluency, Figure::Mu, Figure::Spread, Figure::LeastShape, Figure::Irregular];

/// What is measured, and on what.
#[derive(Default)]
pub struct Scope<'a> {
    /// Folder with the cases as STEP files; without it the built-in surfaces like them.
    folder: Option<&'a Path>,
    /// Seeds of the further surfaces.
    seeds: u64,
    /// Surfaces by name; all when empty.
    names: Vec<&'a str>,
}

impl<'a> Scope<'a> {
    /// From `[--cases FOLDER] [--quick] [NAME]...`.
    ///
    /// # Errors
    /// Names the first argument that is none of these.
    pub fn parse(args: &[&'a str]) -> Result<Scope<'a>, String> {
        let mut scope = Scope { seeds: SEEDS, ..Scope::default() };
        let mut args = args.iter();
        while let Some(&arg) = args.next() {
            match arg {
                "--cases" => {
                    scope.folder = Some(Path::new(*args.next().ok_or("--cases takes a folder")?));
                }
                "--quick" => scope.seeds = 1,
                name if FURTHER.contains(&name) || CASES.iter().any(|c| c.name == name) => {
                    scope.names.push(name);
                }
                _ => {
                    return Err(format!(
                        "{arg} is not an option and none of the surfaces measured"
                    ));
                }
            }
        }
        Ok(scope)
    }

    fn has(&self, name: &str) -> bool {
        self.names.is_empty() || self.names.contains(&name)
    }

    fn cases(&self) -> impl Iterator<Item = &'static Case> {
        CASES.iter().filter(|c| self.has(c.name))
    }

    fn further(&self) -> impl Iterator<Item = &'static str> {
        FURTHER.into_iter().filter(|name| self.has(name))
    }

    /// A case as the command takes it.
    fn surface(&self, case: &Case) -> String {
        self.folder.map_or_else(
            || case.builtin.to_owned(),
            |folder| folder.join(format!("{}.step", case.name)).display().to_string(),
        )
    }
}

/// Measure everything in `scope`, print it, and write `docs/quality.md` when that is all there is.
pub fn bench(scope: &Scope) -> Result<(), String> {
    let gridshell = build::gridshell()?;
    let mut troubles = Vec::new();
    let cases = six(&gridshell, scope, &mut troubles);
    println!("{}", cases.text());
    let further = further(&gridshell, scope, &mut troubles);
    println!("{}", further.text());
    for trouble in &troubles {
        println!("{trouble}");
    }
    if scope.names.is_empty() {
        let file = docs().join("quality.md");
        fs::write(&file, page(scope, &cases, &further, &troubles))
            .map_err(|e| format!("{}: {e}", file.display()))?;
        println!("wrote {}", file.display());
    }
    Ok(())
}

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs")
}

/// The six cases: a column each, figures in rows, then the same of the paper's method.
fn six(gridshell: &Path, scope: &Scope, troubles: &mut Vec<Trouble>) -> Table {
    let mut rows: Vec<Vec<String>> = vec![vec![String::new()]];
    rows.extend(Figure::ALL.map(|f| vec![f.title().to_owned()]));
    rows.push(vec!["bars reached".to_owned()]);
    rows.extend(SHORT.map(|f| vec![format!("{}, method paper", f.title())]));
    for case in scope.cases() {
        eprintln!("{}", case.name);
        let surface = scope.surface(case);
        let edge_length = Some(case.edge_length);
        let order = Order { edge_length, ..Order::plain(&surface) };
        let run = told(case.name, 1, lay(gridshell, &order), troubles);
        let paper = lay(gridshell, &Order { method: "paper", ..order }).ok();
        let mut column = vec![case.name.to_owned()];
        let (mut reached, mut all) = (0, 0);
        for figure in Figure::ALL {
            let value = run.as_ref().map_or(f64::NAN, |run| figure.of(run));
            let bar = case.bars.iter().chain(&EVERY).find(|b| b.figure == figure);
            column.push(cell(figure, value, bar));
            // Times depend on the machine; they are told but not counted.
            if let Some(bar) = bar.filter(|_| figure != Figure::Seconds) {
                all += 1;
                reached += usize::from(figure.reaches(value, bar.limit));
            }
        }
        column.push(format!("{reached} of {all}"));
        column.extend(SHORT.map(|f| f.show(paper.as_ref().map_or(f64::NAN, |run| f.of(run)))));
        rows.iter_mut().zip(column).for_each(|(row, cell)| row.push(cell));
    }
    Table(rows)
}

/// A value beside its bar and aim.
fn cell(figure: Figure, value: f64, bar: Option<&Bar>) -> String {
    let shown = figure.show(value);
    let Some(bar) = bar else { return shown };
    let sign = if figure.more_is_better() { '≥' } else { '≤' };
    let mark = if figure.reaches(value, bar.limit) { '✓' } else { '✗' };
    let aim = bar.aim.map_or_else(String::new, |aim| format!(", aim {}", figure.show_limit(aim)));
    format!("{shown} ({sign} {}{aim}) {mark}", figure.show_limit(bar.limit))
}

/// The further surfaces: a row each, the median and the worst over the seeds, then the paper's method.
fn further(gridshell: &Path, scope: &Scope, troubles: &mut Vec<Trouble>) -> Table {
    let mut head = vec![String::new(), "nodes".to_owned()];
    head.extend(SHORT.map(|f| f.title().to_owned()));
    head.extend(SHORT.map(|f| format!("paper {}", f.title())));
    head.push("seconds".to_owned());
    let mut rows = vec![head];
    for name in scope.further() {
        eprintln!("{name}");
        let mut runs = Vec::new();
        for seed in 1..=scope.seeds {
            let order = Order { seed, ..Order::plain(name) };
            runs.extend(told(name, seed, lay(gridshell, &order), troubles));
        }
        let of = |figure: Figure| -> Vec<f64> { runs.iter().map(|run| figure.of(run)).collect() };
        let nodes = of(Figure::Nodes).first().copied().unwrap_or(f64::NAN);
        let mut row = vec![name.to_owned(), Figure::Nodes.show(nodes)];
        row.extend(SHORT.map(|f| {
            let [median, worst] = f.median_and_worst(&of(f)).map(|x| f.show(x));
            if runs.len() > 1 { format!("{median} ({worst})") } else { median }
        }));
        let paper = lay(gridshell, &Order { method: "paper", ..Order::plain(name) }).ok();
        row.extend(SHORT.map(|f| f.show(paper.as_ref().map_or(f64::NAN, |run| f.of(run)))));
        let [_, slowest] = Figure::Seconds.median_and_worst(&of(Figure::Seconds));
        row.push(Figure::Seconds.show(slowest));
        rows.push(row);
    }
    Table(rows)
}

/// The run if there is one; what is wrong with it is added to `troubles`.
fn told(
    surface: &str,
    seed: u64,
    run: Result<Laid, String>,
    troubles: &mut Vec<Trouble>,
) -> Option<Laid> {
    let mut add = |what| troubles.push(Trouble { surface: surface.to_owned(), seed, what });
    let run = run.map_err(|e| add(format!("no grid: {e}"))).ok()?;
    for figure in [Figure::Bridging, Figure::Folded] {
        let count = figure.of(&run);
        if count != 0.0 {
            add(format!("{count} {}", figure.title()));
        }
    }
    let warnings = run.document["warnings"].as_array();
    let warnings = warnings.into_iter().flatten().filter_map(|w| w.as_str());
    warnings.for_each(|warning| add(warning.to_owned()));
    Some(run)
}

/// `docs/quality.md`.
fn page(scope: &Scope, cases: &Table, further: &Table, troubles: &[Trouble]) -> String {
    let source = match scope.folder {
        Some(_) => "The cases are STEP files of these names.",
        None => {
            "The cases are the built-in surfaces great-court, roof, facade, dome, saddle and fold."
        }
    };
    let timeless = |table: &Table| Table(without_seconds(&table.0));
    let mut text = format!(
        "# Quality\n\n\
         Measured by gridshell {version} with its default recipe, by `cargo xtask bench quality`. What the figures mean is told in the [README](../README.md); times are printed \
         by the command and not kept here.\n\n\
         The grids are shown in the [gallery](gallery.md).\n\n\
         ## Six cases\n\n\
         Seed 1. In brackets what must be reached, and what is aimed at; ✗ where it is not reached. {source}\n\n\
         {cases}\n\
         ## Further surfaces\n\n\
         Built in, of every shape, at their own edge lengths. {seeds}, the paper's method at seed 1.\n\n\
         {further}",
        version = env!("CARGO_PKG_VERSION"),
        cases = timeless(cases).markdown(),
        seeds = match scope.seeds {
            1 => "Seed 1".to_owned(),
            n => format!("Seeds 1 to {n}: the median, and in brackets the worst"),
        },
        further = timeless(further).markdown(),
    );
    if !troubles.is_empty() {
        text += "\n## What the runs warned of\n\n";
        text.extend(summary(troubles).iter().map(|line| format!("- {line}\n")));
    }
    text
}

/// The table without its row and column of seconds.
fn without_seconds(rows: &[Vec<String>]) -> Vec<Vec<String>> {
    let title = Figure::Seconds.title();
    let column = rows[0].iter().position(|head| head == title);
    let kept = rows.iter().filter(|row| row[0] != title);
    kept.map(|row| {
        let cells = row.iter().enumerate().filter(|(k, _)| Some(*k) != column);
        cells.map(|(_, cell)| cell.clone()).collect()
    })
    .collect()
}
