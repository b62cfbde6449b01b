//! Tables of the page.

use crate::facts::facts;
use crate::picture::svg::escaped;
use crate::subject::Subject;
use gridshell::run::Run;

/// Longer lists are cut.
const MOST_ROWS: usize = 200;

/// All figures.
pub fn figures(subject: &Subject) -> String {
    let row = |name: &str, value: &str| {
        format!("<div class=\"fact\"><span>{name}</span><b>{}</b></div>", escaped(value))
    };
    let rows: String = facts(subject).iter().map(|f| row(f.name, &f.value)).collect();
    let supports = subject.document.supports.len();
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
                q.fluency.map_or("inf".to_owned(), |x| format!("{x:.2}")),
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
        "<section><h2>Stages</h2><div class=\"scroll\"><table>{head}{rows}</table></div><p class=\"note\">{}</p></section>",
        notes.join("<br>")
    )
}

/// The groups of members to be cut alike.
pub fn lengths(subject: &Subject) -> String {
    let members = &subject.schedule.members;
    let groups = subject.schedule.figures.length.groups;
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
    let millimetres = 1e3 * subject.schedule.figures.length_tolerance;
    let summary = format!("Lengths to be cut: {groups} groups within {millimetres:.1} mm");
    folded(&summary, &format!("<table>{head}{rows}</table>{}", cut(groups)))
}

/// The irregular nodes.
pub fn irregular(subject: &Subject) -> String {
    let nodes = &subject.schedule.nodes;
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
pub fn recipe(subject: &Subject) -> String {
    let Some(recipe) = &subject.document.recipe else { return String::new() };
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
