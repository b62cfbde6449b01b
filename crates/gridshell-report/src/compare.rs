//! Grids side by side: their figures in columns, the best of each marked.

use crate::colourings::{self, Colours};
use crate::measures::{self, Known, Measure};
use crate::page::{self, Colored};
use crate::picture::svg::escaped;
use gridshell::design::Design;
use std::fmt::Write;

/// A measure of all grids.
struct Row {
    name: &'static str,
    /// As it is read, and whether it is the best of all, where some are worse.
    cells: Vec<(String, bool)>,
}

/// Measures that are known of all of these.
fn rows(grids: &[(String, Design)]) -> Vec<Row> {
    let known: Vec<Known> = grids.iter().map(|(_, design)| Known::of(design)).collect();
    let row = |measure: &Measure| {
        let values: Option<Vec<String>> = known.iter().map(|k| measure.full_text(k)).collect();
        let ranks: Option<Vec<f64>> = known.iter().map(|k| measure.rank(k)).collect();
        let ranks = ranks.unwrap_or_else(|| vec![0.0; known.len()]);
        let best = ranks.iter().copied().fold(f64::INFINITY, f64::min);
        let differ = ranks.iter().any(|r| *r != best);
        let is_best = ranks.iter().map(|r| differ && *r == best);
        Some(Row { name: measure.name, cells: values?.into_iter().zip(is_best).collect() })
    };
    measures::ALL.iter().filter_map(row).collect()
}

/// A table of grids with their names, a column each; the best figures have a star.
pub fn table(grids: &[(String, Design)]) -> String {
    let mut rows: Vec<(&str, Vec<String>)> = rows(grids)
        .into_iter()
        .map(|Row { name, cells }| {
            let cell = |(value, best): (String, bool)| value + if best { " *" } else { "  " };
            (name, cells.into_iter().map(cell).collect())
        })
        .collect();
    rows.insert(0, ("", grids.iter().map(|(name, _)| name.clone()).collect()));
    let width = |k: usize| rows.iter().map(|r| r.1[k].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..grids.len()).map(width).collect();
    let mut text = String::new();
    for (name, cells) in &rows {
        let _ = write!(text, "{name:35}");
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
    let mut body = String::from(
        "<header><h1>Grids side by side</h1><p>The best of these in green.</p></header>",
    );
    body += "<section><div class=\"scroll\"><table class=\"compare\"><tr><th></th>";
    for (name, _) in grids {
        body += &format!("<th>{}</th>", escaped(name));
    }
    body += "</tr><tr><td></td>";
    let mut style = String::new();
    let length = colourings::of("length").expect("in the table");
    for (k, (_, design)) in grids.iter().enumerate() {
        let colored = [Colored { colouring: length, colours: Colours::new(length, design) }];
        // The steps have the same colours in every grid: one style does for all.
        if k == 0 {
            style = page::style(&colored);
        }
        body += &format!("<td><figure>{}</figure></td>", page::plan(design, &colored));
    }
    body += "</tr>";
    for Row { name, cells } in rows(grids) {
        body += &format!("<tr><td>{name}</td>");
        for (value, best) in cells {
            let best = if best { " class=\"best\"" } else { "" };
            body += &format!("<td{best}>{}</td>", escaped(&value));
        }
        body += "</tr>";
    }
    body += "</table></div><p class=\"note\">Plans: grey members have the wanted length, blue ones are shorter, red \
             ones longer; black nodes have too few members, white ones too many.</p></section>";
    body +=
        &format!("<footer>gridshell {}. Lengths in metres.</footer>", env!("CARGO_PKG_VERSION"));
    page::whole("Grids side by side", &style, &body)
}
