//! A run told to the page: measures with their floors, histograms, stages, candidates.

use crate::color;
use crate::laid::{Laid, Now};
use crate::message::{CandidateRow, Histogram, Measure, RunInfo, RunSummary, StageRow};
use gridshell::stages::measure::Quality;
use gridshell_report::colourings;
use gridshell_report::measures::{self, Known};

/// Bins of a histogram.
const BINS: usize = 24;
/// The colourings whose values have one.
const HISTOGRAMS: [&str; 4] = ["length", "shape", "disfluency", "fold"];

/// All about a grid that is kept, as it is now.
pub fn told(summary: RunSummary, laid: &Laid, now: &Now) -> RunInfo {
    let run = laid.design.run.as_deref();
    RunInfo {
        summary,
        edge_length: laid.design.edge_length,
        stopped: run.is_some_and(|r| r.stopped),
        measures: measures(&now.quality, laid.design.edge_length),
        histograms: histograms(laid, now),
        stages: run.iter().flat_map(|r| &r.stages).map(stage).collect(),
        candidates: run.iter().flat_map(|r| &r.candidates).map(candidate).collect(),
        warnings: laid.notes(),
    }
}

fn measures(quality: &Quality, edge_length: f64) -> Vec<Measure> {
    // Schedules would take too long at every edit.
    let known = Known { quality, figures: None, edge_length, structure: None };
    let row = |m: &measures::Measure| {
        Some(Measure {
            key: m.key.into(),
            label: m.title(),
            value: m.text(&known)?,
            floor: m.floor(&known),
            unit: m.unit.into(),
            help: m.help(),
            group: m.group.title().into(),
            bad: m.is_fault && m.value(&known) != Some(0.0),
        })
    };
    measures::ALL.iter().filter_map(row).collect()
}

fn histograms(laid: &Laid, now: &Now) -> Vec<Histogram> {
    let subject = color::subject(laid, now);
    let colourings = HISTOGRAMS.iter().filter_map(|key| colourings::of(key));
    colourings.map(|c| histogram(c.label, c.unit, &c.values(&subject))).collect()
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
    use gridshell::grid::Grid;
    use gridshell::surface::Surface;

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
