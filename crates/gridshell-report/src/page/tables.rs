//! Tables of the page.

use crate::measures::{self, Known};
use crate::picture::svg::escaped;
use gridshell::design::Design;
use gridshell::recipe::Start;
use gridshell::run::{CandidateReport, PartReport, Run, SymmetryReport};

/// Longer lists are cut.
const MOST_ROWS: usize = 200;

/// All figures.
pub fn figures(design: &Design) -> String {
    let row = |name: &str, value: &str| {
        format!("<div class=\"fact\"><span>{name}</span><b>{}</b></div>", escaped(value))
    };
    let known = Known::of(design);
    let rows: String =
        measures::ALL.iter().filter_map(|m| Some(row(m.name, &m.full_text(&known)?))).collect();
    let supports = design.document.supports.len();
    let supports = row("supported nodes", &supports.to_string());
    format!("<section><h2>All figures</h2><div class=\"two\">{rows}{supports}</div></section>")
}

/// What the stages did.
pub fn stages(run: &Run) -> String {
    let head = [
        "stage",
        "nodes",
        "mean length, m",
        "r",
        "mean q",
        "mu",
        "delta, deg",
        "Q",
        "irregular inside",
        "at the border",
        "seconds",
    ];
    let mut rows = String::new();
    for stage in &run.stages {
        let mut cells = vec![stage.name.to_owned()];
        match &stage.quality {
            None => cells.extend(std::iter::repeat_n("-".to_owned(), 9)),
            Some(q) => cells.extend([
                q.nodes.to_string(),
                format!("{:.3}", q.edge_length.mean),
                format!("{:.4}", q.edge_length.cv),
                format!("{:.4}", q.shape.mean),
                format!("{:.3}", q.mu),
                format!("{:.2}", q.delta_deg),
                quality(q.fluency),
                q.irregular.interior.to_string(),
                q.irregular.boundary.to_string(),
            ]),
        }
        cells.push(format!("{:.2}", stage.seconds));
        rows += &tr("td", &cells);
    }
    let notes: Vec<String> = run
        .stages
        .iter()
        .flat_map(|s| {
            let stopped = (!s.converged).then(|| "stopped at a limit".to_owned());
            s.notes.iter().cloned().chain(stopped).map(|n| format!("{}: {n}", s.name))
        })
        .map(|n| escaped(&n))
        .collect();
    let head = tr("th", &head.map(str::to_owned));
    format!(
        "<section><h2>Stages</h2><div class=\"scroll\"><table>{head}{rows}</table></div><p class=\"note\">{}</p>{}</section>",
        notes.join("<br>"),
        candidates(run)
    )
}

/// The pieces of a grid on several parts; nothing where there is one.
pub fn parts(run: &Run) -> String {
    if run.parts.is_empty() {
        return String::new();
    }
    let row = |part: &PartReport| {
        let symmetry = part.symmetry.as_ref().map_or("-".to_owned(), SymmetryReport::told);
        let nodes = format!("N{} to N{}", part.first_node, part.first_node + part.nodes - 1);
        let cells = [part.number.to_string(), nodes, part.nodes.to_string()];
        let further = [format!("{:.2}", part.area), quality(part.fluency), symmetry];
        tr("td", &[cells, further].concat())
    };
    let rows: String = run.parts.iter().map(row).collect();
    let head = ["part", "from node to node", "nodes", "area, m²", "Q", "symmetry"];
    let head = tr("th", &head.map(str::to_owned));
    format!(
        "<section><h2>Parts</h2><div class=\"scroll\"><table>{head}{rows}</table></div></section>"
    )
}

/// What the grid was chosen from; nothing where there was no choice.
fn candidates(run: &Run) -> String {
    let count = run.candidates.len();
    if count < 2 {
        return String::new();
    }
    let several = !run.parts.is_empty();
    let row = |c: &CandidateReport| {
        let start = match c.start {
            Start::Lattice => "a lattice",
            Start::Random => "random bubbles",
        };
        let part = several.then(|| c.part.map_or("-".to_owned(), |p| p.to_string()));
        let cells = [
            c.seed.to_string(),
            start.to_owned(),
            c.heats.to_string(),
            format!("{:.3}", c.merit),
            quality(c.fluency),
            format!("{:.4}", c.cv),
            format!("{:.3}", c.mu),
            format!("{:.2}", c.delta_deg),
        ];
        tr("td", &part.into_iter().chain(cells).collect::<Vec<_>>())
    };
    let rows: String = run.candidates.iter().take(MOST_ROWS).map(row).collect();
    let names = ["seed", "begun with", "heats", "merit", "Q", "r", "mu", "delta, deg"];
    let names = several.then_some("part").into_iter().chain(names).map(str::to_owned);
    let head = tr("th", &names.collect::<Vec<_>>());
    let note = "<p class=\"note\">As they were when they were left behind, before relaxing; the one that was kept comes \
                first. They are ranked by merit: fluency, held back by uneven lengths and bad borders.</p>";
    let summary = format!("Candidates: {count}");
    folded(&summary, &format!("<table>{head}{rows}</table>{}{note}", cut(count)))
}

fn quality(fluency: Option<f64>) -> String {
    fluency.map_or("\u{221e}".to_owned(), |q| format!("{q:.2}"))
}

/// The groups of members to be cut alike.
pub fn lengths(design: &Design) -> String {
    let members = &design.schedule.members;
    let groups = design.schedule.figures.length.groups;
    let mut spans = vec![(0usize, f64::INFINITY, 0f64); groups];
    for (&group, &length) in members.group.iter().zip(&members.length) {
        let span = &mut spans[group as usize];
        *span = (span.0 + 1, span.1.min(length), span.2.max(length));
    }
    let rows: String = spans
        .iter()
        .take(MOST_ROWS)
        .enumerate()
        .map(|(k, (count, from, to))| {
            tr("td", &[k.to_string(), count.to_string(), format!("{from:.4}"), format!("{to:.4}")])
        })
        .collect();
    let head = tr("th", &["group", "members", "from, m", "to, m"].map(str::to_owned));
    let millimetres = 1e3 * design.schedule.figures.length_tolerance;
    let summary = format!("Lengths to be cut: {groups} groups within {millimetres:.1} mm");
    folded(&summary, &format!("<table>{head}{rows}</table>{}", cut(groups)))
}

/// The irregular nodes.
pub fn irregular(design: &Design) -> String {
    let nodes = &design.schedule.nodes;
    let found: Vec<usize> = (0..nodes.xyz.len()).filter(|&v| nodes.is_irregular(v)).collect();
    if found.is_empty() {
        return String::new();
    }
    let row = |&v: &usize| {
        let p = nodes.xyz[v];
        tr(
            "td",
            &[
                format!("N{v}"),
                nodes.degree[v].to_string(),
                nodes.adjusted_degree[v].to_string(),
                if nodes.boundary[v] { "border" } else { "inside" }.to_owned(),
                format!("{:.3}", p.x),
                format!("{:.3}", p.y),
                format!("{:.3}", p.z),
            ],
        )
    };
    let rows: String = found.iter().take(MOST_ROWS).map(row).collect();
    let head = ["node", "members", "adjusted degree", "where", "x, m", "y, m", "z, m"];
    let head = tr("th", &head.map(str::to_owned));
    let summary = format!("Irregular nodes: {}", found.len());
    folded(&summary, &format!("<table>{head}{rows}</table>{}", cut(found.len())))
}

/// The recipe as it can be given back.
pub fn recipe(design: &Design) -> String {
    let Some(recipe) = &design.document.recipe else { return String::new() };
    let text = toml::to_string(recipe).unwrap_or_default();
    folded("Recipe (for --recipe FILE.toml)", &format!("<pre>{}</pre>", escaped(&text)))
}

fn folded(summary: &str, body: &str) -> String {
    format!("<details><summary>{summary}</summary><div class=\"scroll\">{body}</div></details>")
}

fn cut(count: usize) -> String {
    match count.checked_sub(MOST_ROWS) {
        Some(more) if more > 0 => {
            format!("<p class=\"note\">and {more} more: the schedules (.csv) have them all</p>")
        }
        _ => String::new(),
    }
}

fn tr(cell: &str, cells: &[String]) -> String {
    let cells: Vec<String> =
        cells.iter().map(|c| format!("<{cell}>{}</{cell}>", escaped(c))).collect();
    format!("<tr>{}</tr>", cells.concat())
}
