//! A run told to the page: measures with their floors, histograms, stages, candidates.

use crate::color;
use crate::laid::{Laid, Now};
use crate::message::{CandidateRow, Histogram, Measure, RunInfo, RunSummary, StageRow};
use gridshell::grid::Grid;
use gridshell::stages::measure::Quality;
use gridshell::surface::Surface;

/// Bins of a histogram.
const BINS: usize = 24;

/// All about a grid that is kept, as it is now.
pub fn told(summary: RunSummary, laid: &Laid, now: &Now) -> RunInfo {
    let run = laid.design.run.as_deref();
    RunInfo {
        summary,
        edge_length: laid.design.edge_length,
        stopped: run.is_some_and(|r| r.stopped),
        measures: measures(&now.quality, laid.design.edge_length),
        histograms: histograms(&now.grid, &laid.opened.sketch),
        stages: run.iter().flat_map(|r| &r.stages).map(stage).collect(),
        candidates: run.iter().flat_map(|r| &r.candidates).map(candidate).collect(),
        warnings: laid.notes(),
    }
}

fn measures(q: &Quality, edge_length: f64) -> Vec<Measure> {
    [fluency(q), lengths(q), panels(q), fit(q, edge_length), border(q)].concat()
}

/// A measure: its key, name, unit and help.
fn measure(group: &str, [key, label, unit, help]: [&str; 4], value: String) -> Measure {
    Measure {
        key: key.into(),
        label: label.into(),
        value,
        floor: None,
        unit: unit.into(),
        help: help.into(),
        group: group.into(),
        bad: false,
    }
}

fn fluency(q: &Quality) -> Vec<Measure> {
    let row = |told, value| measure("Fluency", told, value);
    let fluency = q.fluency.map_or_else(|| "\u{221e}".to_owned(), |f| format!("{f:.2}"));
    let odd = format!("{} + {}", q.irregular.interior, q.irregular.boundary);
    let help = "How smoothly lines run; higher is better. Eq. 31.";
    let mu = row(
        ["mu", "Irregularity \u{3bc}", "", "Average nodal degree residual, Eq. 27."],
        format!("{:.4}", q.mu),
    );
    let delta = row(
        ["delta_deg", "Disfluency \u{3b4}", "\u{b0}", "Mean angle fluency index, Eq. 30."],
        format!("{:.2}", q.delta_deg),
    );
    vec![
        row(["fluency", "Fluency Q", "", help], fluency),
        Measure { floor: Some(format!("{:.4}", q.mu_floor)), ..mu },
        Measure { floor: Some(format!("{:.2}", q.delta_floor_deg)), ..delta },
        row(
            ["rho", "Regular share \u{3c1}", "", "Weighted share of regular nodes inside, Eq. 32."],
            format!("{:.3}", q.rho),
        ),
        row(["irregular", "Irregular nodes", "", "Inside, and on the boundary."], odd),
    ]
}

fn lengths(q: &Quality) -> Vec<Measure> {
    let row = |told, value| measure("Lengths", told, value);
    let l = &q.edge_length;
    let range = format!("{:.3} \u{2013} {:.3}", l.min, l.max);
    vec![
        row(["mean", "Mean length", "m", "Mean length of the members."], format!("{:.3}", l.mean)),
        row(["range", "Shortest, longest", "m", "Least and largest member length."], range),
        row(
            ["cv", "Spread r", "%", "Coefficient of variation of the lengths, Eq. 24."],
            format!("{:.2}", 100.0 * l.cv),
        ),
    ]
}

fn panels(q: &Quality) -> Vec<Measure> {
    let row = |told, value| measure("Panels", told, value);
    let area = format!("{:.2}", 100.0 * q.area_ratio);
    vec![
        row(
            ["shape", "Mean shape q", "", "1 is equilateral, Eq. 25."],
            format!("{:.4}", q.shape.mean),
        ),
        row(
            ["worst", "Worst shape", "", "Shape of the worst panel."],
            format!("{:.3}", q.shape.min),
        ),
        row(
            ["min_angle_deg", "Least angle", "\u{b0}", "Least angle of a panel."],
            format!("{:.1}", q.min_angle_deg),
        ),
        row(["area_ratio", "Area", "%", "Area of the panels over that of the surface."], area),
    ]
}

fn fit(q: &Quality, edge_length: f64) -> Vec<Measure> {
    let row = |told, value| measure("Fit", told, value);
    let [surface, boundary] =
        [q.surface_deviation, q.boundary_deviation].map(|off| millimetres(off * edge_length));
    let help = "Panels that lie folded back; there should be none.";
    let folded = row(["folded_panels", "Folded panels", "", help], q.folded_panels.to_string());
    let help = "Members that leap from sheet to sheet; there should be none.";
    let bridging =
        row(["bridging_members", "Bridging members", "", help], q.bridging_members.to_string());
    let mut all = vec![
        row(
            [
                "surface_deviation",
                "Nodes off surface",
                "mm",
                "Largest distance of a node to the exact surface.",
            ],
            surface,
        ),
        row(
            [
                "boundary_deviation",
                "Nodes off boundary",
                "mm",
                "Largest distance of a boundary node to the boundary.",
            ],
            boundary,
        ),
        Measure { bad: q.folded_panels > 0, ..folded },
        Measure { bad: q.bridging_members > 0, ..bridging },
    ];
    if let Some(off) = q.direction_deviation_deg {
        let help = "Mean angle between the wanted direction and the nearest member.";
        all.push(row(["direction", "Off the direction", "\u{b0}", help], format!("{off:.1}")));
    }
    all
}

fn border(q: &Quality) -> Vec<Measure> {
    let row = |told, value| measure("Border", told, value);
    let b = &q.border;
    vec![
        row(
            ["border_shape", "Mean shape q", "", "Shape of the panels at the border."],
            format!("{:.4}", b.shape_mean),
        ),
        row(
            ["border_cv", "Spread r", "%", "Length spread of the members at the border."],
            format!("{:.2}", 100.0 * b.edge_length_cv),
        ),
    ]
}

fn millimetres(metres: f64) -> String {
    // Rounding is not worth a figure.
    if metres < 1e-6 { "< 0.001".into() } else { format!("{:.3}", 1e3 * metres) }
}

fn histograms(grid: &Grid, surface: &Surface) -> Vec<Histogram> {
    let ways = [
        ("length", "Member length", "m"),
        ("shape", "Panel shape q", ""),
        ("disfluency", "Disfluency", "°"),
        ("fold", "Fold", "°"),
    ];
    ways.iter()
        .map(|&(by, title, unit)| histogram(title, unit, &color::values(grid, surface, by)))
        .collect()
}

fn histogram(title: &str, unit: &str, values: &[f64]) -> Histogram {
    let known = || values.iter().copied().filter(|x| x.is_finite());
    let low = known().fold(f64::INFINITY, f64::min);
    let high = known().fold(f64::NEG_INFINITY, f64::max);
    let (low, high) = match high - low {
        w if w > 1e-9 * high.abs() => (low, high),
        w if w >= 0.0 => (low - 0.5e-3, low + 0.5e-3),
        _ => (0.0, 1.0),
    };
    let mut counts = vec![0; BINS];
    for x in known() {
        let bin = ((x - low) / (high - low) * BINS as f64) as usize;
        counts[bin.min(BINS - 1)] += 1;
    }
    let edges = (0..=BINS).map(|k| low + (high - low) * k as f64 / BINS as f64).collect();
    Histogram { title: title.into(), unit: unit.into(), edges, counts }
}

fn stage(stage: &gridshell::run::StageReport) -> StageRow {
    let quality = stage.quality.as_ref();
    StageRow {
        name: stage.name.into(),
        seconds: stage.seconds,
        converged: stage.converged,
        irregular: quality.map(|q| (q.irregular.interior + q.irregular.boundary) as u32),
        mu: quality.map(|q| q.mu),
        delta_deg: quality.map(|q| q.delta_deg),
        cv: quality.map(|q| q.edge_length.cv),
        fluency: quality.and_then(|q| q.fluency),
        notes: stage.notes.clone(),
    }
}

fn candidate(c: &gridshell::run::CandidateReport) -> CandidateRow {
    CandidateRow {
        seed: c.seed.to_string(),
        start: format!("{:?}", c.start).to_lowercase(),
        heats: c.heats as u32,
        merit: c.merit,
        fluency: c.fluency,
        cv: c.cv,
    }
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use glam::DVec3;

    /// Two by two unit squares in the plane, each cut by a diagonal, as a grid that is its own surface.
    pub fn square() -> (Grid, Surface) {
        let points = (0..9).map(|k| DVec3::new(f64::from(k % 3), f64::from(k / 3), 0.0)).collect();
        let cell = |v: u32| [[v, v + 1, v + 4], [v, v + 4, v + 3]];
        let panels: Vec<[u32; 3]> = [0, 1, 3, 4].into_iter().flat_map(cell).collect();
        Grid::alone("square", points, &panels).unwrap()
    }

    #[test]
    fn every_value_is_in_one_bin() {
        let told = histogram("lengths", "m", &[1.0, 2.0, 2.0, 3.0, f64::NAN]);
        assert_eq!(told.counts.iter().sum::<u32>(), 4);
        assert_eq!((told.counts[0], told.counts[BINS - 1]), (1, 1));
        assert_eq!((told.edges[0], told.edges[BINS]), (1.0, 3.0));
    }

    #[test]
    fn equal_values_and_none_at_all_have_a_histogram() {
        assert_eq!(histogram("", "", &[2.0; 5]).counts.iter().sum::<u32>(), 5);
        assert_eq!(histogram("", "", &[f64::NAN]).counts.iter().sum::<u32>(), 0);
    }
}
