//! Tables for people, after Table 3 of the paper.

use gridshell::inspect::Inspection;
use gridshell::run::{Run, SurfaceSummary};
use gridshell::schedule::Figures;
use gridshell::stages::measure::{Lengths, Quality};
use std::fmt::Write;

const HEADER: &str = "\
stage          nodes  mean l       r       q      mu   delta       Q   irregular  seconds
                           m                             deg          in  border
";

/// One run: the surface, a row per stage, the checks, the warnings.
pub fn run(run: &Run) -> String {
    let mut text = format!("{}\n", surface_line(&run.surface));
    let _ = writeln!(text, "edge length {:.4} m, seed {}", run.edge_length, run.seed);
    if let Some(symmetry) = &run.symmetry {
        let _ = writeln!(text, "symmetry: {}", symmetry.told());
    }
    for part in &run.parts {
        let quality = part.fluency.map_or("inf".to_owned(), |q| format!("{q:.2}"));
        let _ = writeln!(
            text,
            "part {}: {}, {} m2, Q {quality}",
            part.number,
            count(part.nodes, "node"),
            four_digits(part.area)
        );
    }
    text += "\n";
    text += HEADER;
    for stage in &run.stages {
        text += &row(stage.name, stage.quality.as_ref(), Some(stage.seconds));
        if !stage.converged {
            text += "  (stopped at a limit)";
        }
        text += "\n";
    }
    text += "\n";
    text += &checks(&run.quality);
    text += &alike(&run.figures);
    if let Some(what) = run.invalid() {
        let _ = writeln!(text, "NOT VALID: {what}");
    }
    for warning in &run.warnings {
        let _ = writeln!(text, "warning: {warning}");
    }
    if run.stopped {
        text += "stopped early: this is the best grid so far\n";
    }
    text
}

/// One grid.
pub fn grid(name: &str, quality: &Quality, figures: &Figures) -> String {
    let row = row(name, Some(quality), None);
    format!("{HEADER}{row}\n\n{}{}", checks(quality), alike(figures))
}

/// All that there is to say of a model.
pub fn inspection(i: &Inspection) -> String {
    let s = &i.surface;
    let mut text = format!("{}\n", surface_line(s));
    text += &origin(i);
    for object in &i.source.objects {
        let read = match object.faces {
            0 => "left out".to_owned(),
            n => count(n, "face"),
        };
        let _ = writeln!(text, "{}: {read}", object.told());
    }
    if i.parts.len() > 1 || i.parts.iter().any(|p| p.fault.is_some()) {
        let _ =
            writeln!(text, "{} separate parts; choose with --part N or --part all", i.parts.len());
        for part in &i.parts {
            let _ = writeln!(text, "part {}", part.told());
        }
    }
    for (k, boundary) in s.boundaries.iter().enumerate() {
        let _ = writeln!(
            text,
            "loop {k}: {} m, {}",
            four_digits(boundary.length),
            count(boundary.corners, "corner")
        );
    }
    let [a, b] = [s.bounds.min, s.bounds.max];
    let _ = writeln!(
        text,
        "box: x {:.4} to {:.4}, y {:.4} to {:.4}, z {:.4} to {:.4} m",
        a[0], b[0], a[1], b[1], a[2], b[2]
    );
    match i.creases.len() {
        0 => {}
        n => {
            let whole: f64 = i.creases.iter().map(|c| c.length).sum();
            let _ = writeln!(text, "{}: {whole:.4} m in all", count(n, "crease"));
        }
    }
    let _ = writeln!(text, "unit of the file: {} m", s.unit_in_metres);
    let _ = writeln!(
        text,
        "largest gap: {:.1e} m between edges, {:.1e} m between edges and patches",
        s.gap, s.edge_gap
    );
    for suggestion in &i.edge_lengths {
        let _ = writeln!(
            text,
            "about {} nodes: edge length {}",
            suggestion.nodes,
            three_digits(suggestion.edge_length)
        );
    }
    for note in &s.notes {
        let _ = writeln!(text, "note: {note}");
    }
    text
}

/// Format, its version, the program and the unit, as far as the file tells them.
fn origin(i: &Inspection) -> String {
    let source = &i.source;
    if source.format.is_empty() {
        return String::new();
    }
    let mut parts = vec![[source.format.as_str(), &source.version].join(" ").trim().to_owned()];
    if !source.application.is_empty() {
        parts.push(format!("written by {}", source.application));
    }
    parts.push(match &source.unit {
        Some(unit) => format!("unit {}", unit.name),
        None => "no unit stated".to_owned(),
    });
    parts.join(", ") + "\n"
}

/// Four decimals, and for what is smaller than one as many as show four digits.
fn four_digits(x: f64) -> String {
    let digits = (4..16).find(|&d| x == 0.0 || x.abs() * 10f64.powi(d) >= 1000.0).unwrap_or(16);
    format!("{x:.0$}", digits.max(4) as usize)
}

/// A length to three digits, metres.
fn three_digits(x: f64) -> String {
    let digits = (0..9).find(|&d| x * 10f64.powi(d) >= 100.0).unwrap_or(9) as usize;
    format!("{x:.digits$} m")
}

fn surface_line(s: &SurfaceSummary) -> String {
    let patches = if s.patches == 0 { "mesh".to_owned() } else { count(s.patches, "patch") };
    format!(
        "{}: {patches}, {} m2, {}, {}",
        s.name,
        four_digits(s.area),
        count(s.loops, "loop"),
        count(s.corners, "corner")
    )
}

fn row(name: &str, quality: Option<&Quality>, seconds: Option<f64>) -> String {
    let seconds = seconds.map_or_else(|| "-".to_owned(), |s| format!("{s:.2}"));
    let Some(q) = quality else {
        return format!(
            "{name:12} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>3} {:>7} {seconds:>8}",
            "-", "-", "-", "-", "-", "-", "-", "-", "-"
        );
    };
    let fluency = q.fluency.map_or_else(|| "inf".to_owned(), |f| format!("{f:.2}"));
    format!(
        "{name:12} {:7} {:7.3} {:7.4} {:7.3} {:7.3} {:7.2} {fluency:>7} {:3} {:7} {seconds:>8}",
        q.nodes,
        q.edge_length.mean,
        q.edge_length.cv,
        q.shape.mean,
        q.mu,
        q.delta_deg,
        q.irregular.interior,
        q.irregular.boundary,
    )
}

/// What guards the fluency: the floors, and whether the grid still is the surface.
fn checks(q: &Quality) -> String {
    let mut text = String::new();
    let _ = writeln!(
        text,
        "{}, {}, {}; {} inside, {} on the border; Euler characteristic {}",
        count(q.nodes, "node"),
        count(q.members, "member"),
        count(q.panels, "panel"),
        q.interior_nodes,
        q.boundary_nodes,
        q.euler_characteristic
    );
    let _ = writeln!(text, "floors: mu {:.3}, delta {:.2} deg", q.mu_floor, q.delta_floor_deg);
    let _ = writeln!(
        text,
        "members {:.3} to {:.3} m; least q {:.3}, least angle {:.1} deg",
        q.edge_length.min, q.edge_length.max, q.shape.min, q.min_angle_deg
    );
    let _ =
        writeln!(text, "border: r {:.4}, q {:.3}", q.border.edge_length_cv, q.border.shape_mean);
    if q.lengths == Lengths::OverLocal {
        text += "lengths vary: r and members are over what is wanted where they are\n";
    }
    if let Some(off) = q.direction_deviation_deg {
        let _ = writeln!(text, "off the wanted direction: {off:.1} deg");
    }
    let _ = writeln!(
        text,
        "area ratio {:.4}; off the surface {:.1e} l0, off the boundary {:.1e} l0",
        q.area_ratio, q.surface_deviation, q.boundary_deviation
    );
    if q.bridging_members + q.folded_panels > 0 {
        let _ = writeln!(
            text,
            "faults: {}, {}",
            count(q.bridging_members, "bridging member"),
            count(q.folded_panels, "folded panel")
        );
    }
    text
}

/// What has to be made: lengths, areas, kinds, folds and twists.
fn alike(f: &Figures) -> String {
    let mut text = String::new();
    let _ = writeln!(
        text,
        "built: {:.1} m of members in {} within {:.1} mm, {:.1} m2 in {}, {}",
        f.length.total,
        count(f.length.groups, "length"),
        1e3 * f.length_tolerance,
        f.panel.total_area,
        count(f.panel.distinct, "kind of panel"),
        count(f.distinct_nodes, "kind of node")
    );
    let _ = writeln!(
        text,
        "folds up to {:.1} deg, twist up to {:.2} deg, angles {:.1} to {:.1} deg",
        f.fold_deg.max, f.twist_deg.max, f.angle_deg.min, f.angle_deg.max
    );
    text
}

fn count(n: usize, noun: &str) -> String {
    match (n, noun) {
        (1, _) => format!("1 {noun}"),
        (_, "patch") => format!("{n} patches"),
        (_, "kind of panel") => format!("{n} kinds of panels"),
        (_, "kind of node") => format!("{n} kinds of nodes"),
        _ => format!("{n} {noun}s"),
    }
}
