//! A run told to the page: measures with their floors, histograms, stages, candidates.

use crate::color;
use crate::message::{CandidateRow, Histogram, Measure, RunInfo, RunSummary, StageRow};
use gridshell::grid::Grid;
use gridshell::run::Run;
use gridshell::stages::measure::Quality;
use gridshell::surface::Surface;

/// Bins of a histogram.
const BINS: usize = 24;

/// All about a run.
pub fn told(
    summary: RunSummary,
    run: &Run,
    quality: &Quality,
    grid: &Grid,
    surface: &Surface,
) -> RunInfo {
    RunInfo {
        summary,
        edge_length: run.edge_length,
        stopped: run.stopped,
        measures: measures(quality, run.edge_length),
        histograms: histograms(grid, surface),
        stages: run.stages.iter().map(stage).collect(),
        candidates: run.candidates.iter().map(candidate).collect(),
        warnings: run.warnings.clone(),
    }
}

fn measures(q: &Quality, edge_length: f64) -> Vec<Measure> {
    let mut all = Vec::new();
    let mut add = |group: &str, key: &str, label: &str, value: String, unit: &str, help: &str| {
        all.push(Measure {
            key: key.into(),
            label: label.into(),
            value,
            floor: None,
            unit: unit.into(),
            help: help.into(),
            group: group.into(),
            bad: false,
        });
    };
    let fluency = q.fluency.map_or_else(|| "∞".to_owned(), |f| format!("{f:.2}"));
    add(
        "Fluency",
        "fluency",
        "Fluency Q",
        fluency,
        "",
        "How smoothly lines run; higher is better. Eq. 31.",
    );
    add(
        "Fluency",
        "mu",
        "Irregularity μ",
        format!("{:.4}", q.mu),
        "",
        "Average nodal degree residual, Eq. 27.",
    );
    add(
        "Fluency",
        "delta_deg",
        "Disfluency δ",
        format!("{:.2}", q.delta_deg),
        "°",
        "Mean angle fluency index, Eq. 30.",
    );
    add(
        "Fluency",
        "rho",
        "Regular share ρ",
        format!("{:.3}", q.rho),
        "",
        "Weighted share of regular nodes inside, Eq. 32.",
    );
    add(
        "Fluency",
        "irregular",
        "Irregular nodes",
        format!("{} + {}", q.irregular.interior, q.irregular.boundary),
        "",
        "Inside, and on the boundary.",
    );
    add(
        "Lengths",
        "mean",
        "Mean length",
        format!("{:.3}", q.edge_length.mean),
        "m",
        "Mean length of the members.",
    );
    add(
        "Lengths",
        "range",
        "Shortest, longest",
        format!("{:.3} – {:.3}", q.edge_length.min, q.edge_length.max),
        "m",
        "Least and largest member length.",
    );
    add(
        "Lengths",
        "cv",
        "Spread r",
        format!("{:.2}", 100.0 * q.edge_length.cv),
        "%",
        "Coefficient of variation of the lengths, Eq. 24.",
    );
    add(
        "Panels",
        "shape",
        "Mean shape q",
        format!("{:.4}", q.shape.mean),
        "",
        "1 is equilateral, Eq. 25.",
    );
    add(
        "Panels",
        "worst",
        "Worst shape",
        format!("{:.3}", q.shape.min),
        "",
        "Shape of the worst panel.",
    );
    add(
        "Panels",
        "min_angle_deg",
        "Least angle",
        format!("{:.1}", q.min_angle_deg),
        "°",
        "Least angle of a panel.",
    );
    add(
        "Panels",
        "area_ratio",
        "Area",
        format!("{:.2}", 100.0 * q.area_ratio),
        "%",
        "Area of the panels over that of the surface.",
    );
    add(
        "Fit",
        "surface_deviation",
        "Nodes off the surface",
        millimetres(q.surface_deviation * edge_length),
        "mm",
        "Largest distance of a node to the exact surface.",
    );
    add(
        "Fit",
        "boundary_deviation",
        "Nodes off the boundary",
        millimetres(q.boundary_deviation * edge_length),
        "mm",
        "Largest distance of a boundary node to the exact boundary.",
    );
    add(
        "Fit",
        "folded_panels",
        "Folded panels",
        q.folded_panels.to_string(),
        "",
        "Panels that lie folded back; there should be none.",
    );
    add(
        "Fit",
        "bridging_members",
        "Bridging members",
        q.bridging_members.to_string(),
        "",
        "Members that leap from sheet to sheet; there should be none.",
    );
    add(
        "Border",
        "border_shape",
        "Mean shape q",
        format!("{:.4}", q.border.shape_mean),
        "",
        "Shape of the panels at the border.",
    );
    add(
        "Border",
        "border_cv",
        "Spread r",
        format!("{:.2}", 100.0 * q.border.edge_length_cv),
        "%",
        "Length spread of the members at the border.",
    );
    if let Some(off) = q.direction_deviation_deg {
        add(
            "Fit",
            "direction",
            "Off the direction",
            format!("{off:.1}"),
            "°",
            "Mean angle between the wanted direction and the nearest member.",
        );
    }
    for m in &mut all {
        match m.key.as_str() {
            "mu" => m.floor = Some(format!("{:.4}", q.mu_floor)),
            "delta_deg" => m.floor = Some(format!("{:.2}", q.delta_floor_deg)),
            "folded_panels" => m.bad = q.folded_panels > 0,
            "bridging_members" => m.bad = q.bridging_members > 0,
            _ => {}
        }
    }
    all
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
