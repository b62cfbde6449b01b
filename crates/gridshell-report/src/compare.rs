//! Grids side by side: their figures in columns, the best of each marked.

use crate::facts::{Fact, Rank, facts};
use crate::page::{self, Colored};
use crate::picture::colour::{Coloring, Colours};
use crate::picture::svg::escaped;
use gridshell::design::Design;
use std::fmt::Write;

/// One grid's figures.
struct Column<'a> {
    name: &'a str,
    facts: Vec<Fact>,
}

fn columns(grids: &[(String, Design)]) -> Vec<Column<'_>> {
    grids.iter().map(|(name, design)| Column { name, facts: facts(design) }).collect()
}

/// Whether this grid is the best in this figure, where some are worse.
fn is_best(columns: &[Column], row: usize, column: usize) -> bool {
    let key = |c: &Column| c.facts[row].rank.map(Rank::key);
    let keys: Option<Vec<f64>> = columns.iter().map(key).collect();
    let Some(keys) = keys else { return false };
    let best = keys.iter().copied().fold(f64::INFINITY, f64::min);
    keys[column] == best && keys.iter().any(|k| *k != best)
}

/// A table of grids with their names, a column each; the best figures have a star.
pub fn table(grids: &[(String, Design)]) -> String {
    let columns = columns(grids);
    let Some(first) = columns.first() else { return String::new() };
    let mut rows = vec![columns.iter().map(|c| c.name.to_owned()).collect::<Vec<_>>()];
    for row in 0..first.facts.len() {
        let cell = |(k, c): (usize, &Column)| {
            let star = if is_best(&columns, row, k) { " *" } else { "  " };
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

/// A page with the same table and a plan of each grid.
pub fn page(grids: &[(String, Design)]) -> String {
    let columns = columns(grids);
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
            style = page::style(&colored);
        }
        body += &format!("<td><figure>{}</figure></td>", page::plan(design, &colored));
    }
    body += "</tr>";
    for row in 0..columns.first().map_or(0, |c| c.facts.len()) {
        body += &format!("<tr><td>{}</td>", columns[0].facts[row].name);
        body += &cells(&|k| {
            let best = if is_best(&columns, row, k) { " class=\"best\"" } else { "" };
            format!("<td{best}>{}</td>", escaped(&columns[k].facts[row].value))
        });
        body += "</tr>";
    }
    body += "</table></div><p class=\"note\">Plans: grey members have the wanted length, blue ones are shorter, red \
             ones longer; black nodes have too few members, white ones too many.</p></section>";
    body +=
        &format!("<footer>gridshell {}. Lengths in metres.</footer>", env!("CARGO_PKG_VERSION"));
    page::whole("Grids side by side", &style, &body)
}
