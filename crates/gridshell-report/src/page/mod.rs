//! One page that tells of a grid: pictures, a view that can be turned, figures and tables. It holds all it needs, so it
//! opens without a network; colours and cameras are those of the sheets.

mod cards;
mod charts;
mod pictures;
mod tables;
mod viewer;

use crate::colourings::{self, Colours};
use crate::picture::svg::escaped;
use crate::picture::view::View;
use gridshell::design::Design;
use gridshell::run::{Run, SurfaceSummary};
use gridshell::{Error, Result, io};
use std::path::Path;

pub(crate) use pictures::{Colored, plan, style};

const STYLE: &str = include_str!("page.css");

/// Refuse a file that is not a page, or cannot be written, before the work is done.
///
/// # Errors
/// [`Error::Option`] for another extension, or a folder that is not there; [`Error::Io`].
pub fn check(file: &Path) -> Result<()> {
    if !file.extension().is_some_and(|e| e.eq_ignore_ascii_case("html")) {
        return Err(Error::Option(format!("{}: a page must end in .html", file.display())));
    }
    io::check_place(file)
}

/// Write a page; it appears whole or not at all.
///
/// # Errors
/// As [`check`].
pub fn write(file: &Path, page: &str) -> Result<()> {
    io::replace(file, page.as_bytes())
}

/// The page of a grid, and of the run that made it if there is one: that tells of the grid before edits.
pub fn of(design: &Design) -> String {
    let run = design.run.as_deref();
    let colored: Vec<Colored> = colourings::ALL
        .iter()
        .map(|colouring| Colored { colouring, colours: Colours::new(colouring, design) })
        .collect();
    let mut body = header(design, run);
    body += &warnings(run);
    body += &viewer::section(design, &colored);
    body += "<section><h2>Plan and perspective</h2><div class=\"pictures\">";
    for (view, caption) in [(View::Plan, "Plan"), (View::Perspective, "Perspective")] {
        let picture = pictures::picture(design, &colored, view);
        body += &format!("<figure>{picture}<figcaption>{caption}</figcaption></figure>");
    }
    body += "</div><p class=\"note\">Black nodes have too few members, white ones too many. <span class=\"screen\">The pictures take \
             their colours from the choice above.</span></p></section>";
    body += &cards::section(design);
    body += &charts::section(design);
    body += &tables::figures(design);
    if let Some(run) = run {
        body += &tables::parts(run);
        body += &tables::stages(run);
    }
    body += &tables::lengths(design);
    body += &tables::irregular(design);
    body += &tables::recipe(design);
    body += &format!(
        "<footer>{}. Lengths in metres, angles in degrees.</footer>",
        escaped(&imprint(design))
    );
    body += &viewer::script();
    let title = format!("{}: triangular grid", design.name());
    whole(&title, &style(&colored), &body)
}

/// A page of these parts.
pub(crate) fn whole(title: &str, style: &str, body: &str) -> String {
    format!(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" \
         content=\"width=device-width, initial-scale=1\"><title>{}</title>\n<style>\n{STYLE}\n{style}</style></head>\n\
         <body data-colour=\"length\">\n{body}\n</body></html>\n",
        escaped(title)
    )
}

fn header(design: &Design, run: Option<&Run>) -> String {
    let (q, f) = (&design.quality, &design.schedule.figures);
    let tile = |value: String, name: &str| {
        format!("<div class=\"tile\"><b>{value}</b><span>{name}</span></div>")
    };
    let tiles = [
        tile(q.nodes.to_string(), "nodes"),
        tile(q.members.to_string(), "members"),
        tile(q.panels.to_string(), "panels"),
        tile(format!("{:.2} m", f.length.spread.mean), "mean member"),
        tile(q.fluency.map_or("&infin;".to_owned(), |x| format!("{x:.2}")), "fluency Q"),
        tile(q.irregular.interior.to_string(), "irregular nodes inside"),
        tile(f.length.groups.to_string(), "member lengths"),
        tile(f.panel.distinct.to_string(), "kinds of panels"),
    ];
    let seed = design.document.seed.map_or(String::new(), |s| format!(" Seed {s}."));
    let surface = run.map_or(String::new(), |run| surface(&run.surface));
    let symmetry = run.and_then(|run| run.symmetry.as_ref());
    let symmetry = symmetry.map_or(String::new(), |s| format!(" Symmetric: {}.", s.told()));
    let took = run.map_or(String::new(), |run| {
        let seconds: f64 = run.stages.iter().map(|s| s.seconds).sum();
        format!(" Made in {seconds:.1} s.")
    });
    format!(
        "<header><h1>{}</h1><p>Triangular grid of members about {:.3} m long{surface}, by gridshell \
         {}.{seed}{symmetry}{took}</p>\
         <div class=\"tiles\">{}</div></header>",
        escaped(design.name()),
        design.edge_length,
        escaped(&design.document.version),
        tiles.concat()
    )
}

/// The design surface in a few words.
fn surface(s: &SurfaceSummary) -> String {
    let counted =
        |n: usize, one: &str, more: &str| format!("{n} {}", if n == 1 { one } else { more });
    let patches = match s.patches {
        0 => "a mesh".to_owned(),
        n => counted(n, "patch", "patches"),
    };
    let size = [0, 1, 2].map(|k| format!("{:.1}", s.bounds.max[k] - s.bounds.min[k])).join(" × ");
    let loops = counted(s.loops, "boundary", "boundaries");
    format!(" on a surface of {:.1} m² ({patches}, {loops}, {size} m)", s.area)
}

fn warnings(run: Option<&Run>) -> String {
    let Some(run) = run else { return String::new() };
    let mut all: Vec<String> = run.surface.notes.iter().chain(&run.warnings).cloned().collect();
    if let Some(what) = run.invalid() {
        all.insert(0, format!("this grid is NOT VALID: {what}"));
    }
    if run.stopped {
        all.push("the run was stopped early: this is the best grid so far".into());
    }
    if all.is_empty() {
        return String::new();
    }
    let items: Vec<String> = all.iter().map(|w| format!("<li>{}</li>", escaped(w))).collect();
    format!(
        "<section class=\"warnings\"><h2>What to know</h2><ul>{}</ul></section>",
        items.concat()
    )
}

/// Seed and version.
fn imprint(design: &Design) -> String {
    let seed = design.document.seed.map_or(String::new(), |s| format!("seed {s}, "));
    format!("{seed}gridshell {}", design.document.version)
}
