//! Edits that would better the grid, the best first.

use super::workbench::Workbench;
use super::{Edit, Editor, Effect};
use crate::job::Job;
use crate::merit::Sums;
use crate::stages::regularize::{Operation, estimate};
use rayon::prelude::*;
use std::collections::BTreeSet;

/// What lengths and lines may at best win by an edit that raises R, in units of what one more irregular node on the
/// border costs.
const HOPE: f64 = 1.0;
/// Edits that gain less than this, in units of Q, are not worth a person's time.
const LEAST_GAIN: f64 = 0.005;

impl Editor {
    /// The `n` edits of a single member near irregular nodes that gain most (see [`Effect::gain`]), best first; fewer
    /// where fewer gain as much as 0.005, or the job was stopped.
    pub fn suggest(&self, n: usize, job: &Job) -> Vec<(Edit, Effect)> {
        let edits = if n > 0 { self.hopeful() } else { Vec::new() };
        let mut found: Vec<(Edit, Effect)> = edits
            .into_par_iter()
            .map_init(
                || Workbench::new(self),
                |bench, edit| {
                    if job.stopped() {
                        return None;
                    }
                    let effect = bench.carry_out(&edit).ok();
                    bench.take_back();
                    effect.filter(|e| e.gain() >= LEAST_GAIN).map(|e| (edit, e))
                },
            )
            .flatten()
            .collect();
        found.sort_by(|a, b| b.1.gain().total_cmp(&a.1.gain()));
        found.truncate(n);
        found
    }

    /// The edits near irregular nodes that might gain something, judged by degrees alone.
    fn hopeful(&self) -> Vec<Edit> {
        let bench = Workbench::new(self);
        let state = &bench.state;
        let mesh = &self.grid.mesh;
        let lambda = self.lambda();
        let merit =
            |change: f64| Sums { residual: self.sums.residual + change, ..self.sums }.merit(lambda);
        let bar = merit(HOPE * (1.0 - lambda));
        let mut members = BTreeSet::new();
        let mut irregular = state.irregular().to_vec();
        irregular.sort_unstable();
        for &v in &irregular {
            let ring = mesh.ring(v).iter().map(|&w| (v, w));
            members.extend(ring.chain(mesh.fan(v)).map(|(a, b)| (a.min(b), a.max(b))));
        }
        let mut edits = Vec::new();
        for (a, b) in members {
            let nodes = [a, b];
            let kinds = [
                (Operation::Flip, Edit::Flip { nodes }),
                (Operation::Split, Edit::Split { nodes }),
                (Operation::Collapse, Edit::Collapse { nodes }),
            ];
            let hopeful = kinds.into_iter().filter(|(operation, _)| {
                estimate(state, *operation, a, b).is_some_and(|change| merit(change) >= bar)
            });
            edits.extend(hopeful.map(|(_, edit)| edit));
            let [x, y] = nodes.map(|v| state.deviation[v as usize]);
            let inside = !mesh.is_boundary(a) && !mesh.is_boundary(b);
            if inside && x.signum() * y.signum() < 0 {
                edits.push(Edit::Drift { nodes, toward: None, steps: None });
            }
        }
        edits
    }
}
