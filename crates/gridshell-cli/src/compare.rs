//! `gridshell compare`: grids side by side, for choosing between them.

use crate::Outcome;
use crate::args::Compare;
use crate::facts::{Fact, Rank, facts};
use crate::failure::Failure;
use crate::picture::colour::{Coloring, Colours};
use crate::picture::svg::escaped;
use crate::progress::Work;
use crate::report::{self, Colored};
use crate::{open, say};
use gridshell::design::Design;
use gridshell::schedule::Figures;
use gridshell::stages::measure::Quality;
use serde::Serialize;
use std::fmt::Write;
use std::path::Path;

/// The document of `--json`.
#[derive(Serialize)]
struct Document<'a> {
    schema: &'static str,
    version: &'static str,
    units: &'static str,
    grids: Vec<Entry<'a>>,
}

#[derive(Serialize)]
struct Entry<'a> {
    grid: &'a str,
    edge_length: f64,
    quality: &'a Quality,
    figures: &'a Figures,
}

impl<'a> Entry<'a> {
    fn new(name: &'a str, design: &'a Design) -> Entry<'a> {
        let Design { edge_length, quality, schedule, .. } = design;
        Entry { grid: name, edge_length: *edge_length, quality, figures: &schedule.figures }
    }
}

pub fn run(args: &Compare, work: &Work) -> Result<Outcome, Failure> {
    let job = &work.job;
    args.html.as_deref().map_or(Ok(()), report::check)?;
    let how = open::reopening(
        args.surface.as_deref(),
        args.reading.opening(),
        args.following.follow(),
        &args.alike,
    );
    let mut grids = Vec::new();
    for path in &args.grids {
        let of = format!("{}: ", path.display());
        grids.push((label(path), open::read(path, &of, &how, job)?));
    }
    work.told();
    let columns: Vec<Column> =
        grids.iter().map(|(name, design)| Column { name, facts: facts(design) }).collect();
    let mut reported = Ok(());
    if let Some(file) = &args.html {
        reported = report::write(file, &page(&columns, &grids));
        if reported.is_ok() {
            say::note(&format!("wrote {}", file.display()));
        }
    }
    if args.json {
        say::json(&Document {
            schema: "gridshell.compare/1",
            version: env!("CARGO_PKG_VERSION"),
            units: "m",
            grids: grids.iter().map(|(name, design)| Entry::new(name, design)).collect(),
        })?;
    } else {
        say::result(&table(&columns))?;
    }
    reported.map(|()| Outcome::Done)
}

/// One grid's figures.
struct Column<'a> {
    name: &'a str,
    facts: Vec<Fact>,
}

/// The file's name without its end.
fn label(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// Whether this grid is the best in this figure, where some are worse.
fn is_best(columns: &[Column], row: usize, column: usize) -> bool {
    let key = |c: &Column| c.facts[row].rank.map(Rank::key);
    let keys: Option<Vec<f64>> = columns.iter().map(key).collect();
    let Some(keys) = keys else { return false };
    let best = keys.iter().copied().fold(f64::INFINITY, f64::min);
    keys[column] == best && keys.iter().any(|k| *k != best)
}

/// A column per grid, the best figures with a star.
fn table(columns: &[Column]) -> String {
    let Some(first) = columns.first() else { return String::new() };
    let mut rows = vec![columns.iter().map(|c| c.name.to_owned()).collect::<Vec<_>>()];
    for row in 0..first.facts.len() {
        let cell = |(k, c): (usize, &Column)| {
            let star = if is_best(columns, row, k) { " *" } else { "  " };
            c.facts[row].value.clone() + star
        };
        rows.push(columns.iter().enumerate().map(cell).collect());
    }
    let width = |k: usize| rows.iter().map(|r| r[k].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns.len()).map(width).collect();
    let mut text = String::new();
    for (row, cells) in rows.iter().enumerate() {
        let name = row.checked_sub(1).map_or("", |row| first.facts[row].name);
        let _ = write!(text, "{name:30}");
        for (cell, width) in cells.iter().zip(&widths) {
            let _ = write!(text, "  {cell:>width$}");
        }
        text.truncate(text.trim_end().len());
        text.push('\n');
    }
    text + "* the best of these\n"
}

/// The table with a plan of each grid.
fn page(columns: &[Column], grids: &[(String, Design)]) -> String {
    let cells = |of: &dyn Fn(usize) -> String| (0..columns.len()).map(of).collect::<String>();
    let mut body = String::from(
        "<header><h1>Grids side by side</h1><p>The best of these in green.</p></header>",
    );
    body += "<section><div class=\"scroll\"><table class=\"compare\"><tr><th></th>";
    body += &cells(&|k| format!("<th>{}</th>", escaped(columns[k].name)));
    body += "</tr><tr><td></td>";
    let mut style = String::new();
    for (k, (_, design)) in grids.iter().enumerate() {
        let colours = Colours::new(Coloring::Length, design);
        let colored = [Colored { key: "length", colours }];
        // The steps have the same colours in every grid: one style does for all.
        if k == 0 {
            style = report::style(&colored);
        }
        body += &format!("<td><figure>{}</figure></td>", report::plan(design, &colored));
    }
    body += "</tr>";
    for row in 0..columns.first().map_or(0, |c| c.facts.len()) {
        body += &format!("<tr><td>{}</td>", columns[0].facts[row].name);
        body += &cells(&|k| {
            let best = if is_best(columns, row, k) { " class=\"best\"" } else { "" };
            format!("<td{best}>{}</td>", escaped(&columns[k].facts[row].value))
        });
        body += "</tr>";
    }
    body += "</table></div><p class=\"note\">Plans: grey members have the wanted length, blue ones are shorter, red \
             ones longer; black nodes have too few members, white ones too many.</p></section>";
    body +=
        &format!("<footer>gridshell {}. Lengths in metres.</footer>", env!("CARGO_PKG_VERSION"));
    report::whole("Grids side by side", &style, &body)
}
