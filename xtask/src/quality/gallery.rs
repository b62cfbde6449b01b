//! The gallery: every grid in plan and in perspective, and a sheet of one; drawn by the command.

use super::figure::Figure;
use super::{Scope, docs};
use crate::build;
use crate::laid::{Laid, Order, lay};
use std::fs;
use std::path::Path;

/// The two pictures of a grid: the end of the file's name, and how it is drawn.
const VIEWS: [(&str, &str); 2] = [("-plan", "plan"), ("", "perspective")];
/// What is drawn as a sheet too.
const SHEET: &str = "great_court";

/// Lay a grid on `surface` by the default recipe and draw its plan to `file`.
pub fn picture(surface: &str, file: &Path) -> Result<(), String> {
    let gridshell = build::gridshell()?;
    small(&lay(&gridshell, &Order::plain(surface))?, &gridshell, "plan", file)
}

fn small(laid: &Laid, gridshell: &Path, view: &str, file: &Path) -> Result<(), String> {
    laid.draw(gridshell, &["--paper", "none", "--view", view], file)
}

/// Draw every grid in `scope` at seed 1; and write the page when that is all there is.
pub fn gallery(scope: &Scope) -> Result<(), String> {
    let gridshell = build::gridshell()?;
    let folder = docs().join("gallery");
    fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut rows = String::new();
    let mut draw = |name: &str, order: &Order| -> Result<(), String> {
        let laid = lay(&gridshell, order).map_err(|e| format!("{name}: {e}"))?;
        for (end, view) in VIEWS {
            small(&laid, &gridshell, view, &folder.join(format!("{name}{end}.png")))?;
        }
        if name == SHEET {
            let labels = ["--paper", "a3", "--labels", "nodes,members,panels"];
            laid.draw(&gridshell, &labels, &folder.join("sheet.pdf"))?;
            let marks = ["--paper", "a4", "--view", "iso", "--color", "degree"];
            laid.draw(&gridshell, &marks, &folder.join("sheet.png"))?;
        }
        rows += &row(name, order.surface, &laid);
        println!("{name}");
        Ok(())
    };
    for case in scope.cases() {
        let edge_length = Some(case.edge_length);
        draw(case.name, &Order { edge_length, ..Order::plain(&scope.surface(case)) })?;
    }
    scope.further().try_for_each(|name| draw(name, &Order::plain(name)))?;
    if scope.names.is_empty() {
        let file = docs().join("gallery.md");
        fs::write(&file, page(&rows)).map_err(|e| format!("{}: {e}", file.display()))?;
        println!("wrote {}", file.display());
    }
    Ok(())
}

/// A grid's figures beside its pictures.
fn row(name: &str, surface: &str, laid: &Laid) -> String {
    let [nodes, fluency] = [Figure::Nodes, Figure::Fluency].map(|f| f.show(f.of(laid)));
    let length = laid.document["edge_length"].as_f64().unwrap_or(f64::NAN);
    let [plan, view] =
        VIEWS.map(|(end, view)| format!("![{name}, {view}](gallery/{name}{end}.png)"));
    format!(
        "| `{surface}`<br>{nodes} nodes<br>members of {length:.2} m<br>Q {fluency} | {plan} | {view} |\n"
    )
}

fn page(rows: &str) -> String {
    format!(
        "# Gallery\n\n\
         Grids on built-in surfaces by the default recipe at seed 1, made by `cargo xtask pictures`; each is laid by \
         `gridshell generate NAME -o NAME.gridshell` and drawn by `gridshell draw NAME.gridshell --paper none -o NAME.png`. \
         Members have the colour of their length, grey where it is l0, blue where shorter, red where longer; black nodes \
         have too few members, white ones too many, green triangles are supports. What Q is and how the grids measure up \
         is told in [quality.md](quality.md).\n\n\
         | | plan | perspective |\n|---|---|---|\n{rows}\n\
         ## Sheets\n\n\
         `gridshell draw great-court.gridshell --view iso --color degree --paper a4 -o sheet.png` gives a sheet to scale:\n\n\
         ![A sheet of the Great Court](gallery/sheet.png)\n\n\
         With `--labels nodes,members,panels --paper a3 -o sheet.pdf` everything has its number, as in the schedules: \
         [sheet.pdf](gallery/sheet.pdf).\n"
    )
}
