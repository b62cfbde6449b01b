//! Edges that are still naked although another naked edge runs beside them: gaps that a larger tolerance would sew.

use super::PHASE;
use super::naked::Naked;
use crate::job::Job;
use crate::surface::{Brep, Sewing};

/// Looks along each edge.
const LOOKS: usize = 16;
/// So many looks of them must see another edge.
const SEEN: usize = 13;
/// The cosine of the angle up to which another edge counts as running alongside.
const ALONG: f64 = 0.9;

/// Places on other edges that are looked at in all: a heap of copies would ask for their square.
const MOST_FEET: usize = 4_000_000;

/// Add to `sewing` what is left within `reach` metres, but farther than its tolerance.
pub(super) fn look(brep: &Brep, reach: f64, sewing: &mut Sewing, job: &Job) {
    let naked = Naked::new(brep, job);
    let mut feet = 0;
    for line in &naked.lines {
        if job.is_over(PHASE) {
            return;
        }
        let edge = &brep.edges[line.edge as usize];
        let length: f64 = line.points.windows(2).map(|w| w[0].distance(w[1])).sum();
        if length < 2.0 * reach || feet > MOST_FEET {
            continue;
        }
        let (mut seen, mut gap) = (0, 0.0_f64);
        for i in 0..LOOKS {
            let share = (i as f64 + 0.5) / LOOKS as f64;
            let [p, along] =
                edge.curve.jet(edge.range[0] + (edge.range[1] - edge.range[0]) * share);
            let along = along.normalize_or_zero();
            let around = naked.feet(brep, p, reach);
            feet += around.len();
            let beside = around.into_iter().filter(|foot| {
                let other = &naked.lines[foot.line as usize];
                let curve = &brep.edges[other.edge as usize].curve;
                other.edge != line.edge
                    && curve.jet(foot.t)[1].normalize_or_zero().dot(along).abs() >= ALONG
            });
            if let Some(d) = beside.map(|foot| foot.distance).min_by(f64::total_cmp) {
                seen += 1;
                gap = gap.max(d);
            }
        }
        // What is near enough was left apart for another reason: more than two faces meet there.
        if seen >= SEEN && gap > sewing.tolerance {
            sewing.facing += 1;
            sewing.facing_length += length;
            sewing.facing_gap = sewing.facing_gap.max(gap);
        }
    }
}
