//! Schedules: figures per node, member and panel, and what they come to; beside the paper's measures.
//!
//! Every list is a struct of arrays in a fixed order: nodes as in the grid, members by their lower and then their
//! higher node, panels by their lowest node first. Metres; angles in degrees, as in the paper's measures.
//!
//! Elements are sorted into *groups* that can be made alike: the lengths in a group differ by at most the length
//! tolerance, panels of a group have members of the same groups in the same turn, nodes of a group have members
//! that leave in the same directions within the angle tolerance.

mod figures;
mod group;
mod members;
mod nodes;
mod panels;

pub use figures::{Figures, Histogram, LengthFigures, PanelFigures, Spread};
pub use group::groups_within;
pub use members::Members;
pub use nodes::Nodes;
pub use panels::Panels;

use crate::error::Result;
use crate::grid::Grid;
use crate::job::{Job, Picture};
use crate::recipe;
use crate::surface::Surface;

/// What a stop in here is told as.
const PHASE: &str = "measuring";
/// The length tolerance, where none is given, over the mean member length.
const TOLERANCE: f64 = 1.0 / 200.0;

/// Within what elements count as alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances {
    /// Lengths, metres; None takes a two hundredth of the mean member length.
    pub length: Option<f64>,
    /// Angles at nodes, degrees.
    pub angle_deg: f64,
}

impl From<&recipe::Measure> for Tolerances {
    fn from(measure: &recipe::Measure) -> Tolerances {
        Tolerances { length: measure.length_tolerance, angle_deg: measure.angle_tolerance_deg }
    }
}

impl Default for Tolerances {
    fn default() -> Self {
        Tolerances::from(&recipe::Measure::default())
    }
}

/// The schedules of one grid.
#[derive(Clone, Debug, Default)]
pub struct Schedule {
    /// The nodes, in the grid's order.
    pub nodes: Nodes,
    /// The members, by their nodes.
    pub members: Members,
    /// The panels, by their nodes.
    pub panels: Panels,
    /// What they come to.
    pub figures: Figures,
}

impl Schedule {
    /// The schedules of `grid` on `surface`.
    pub fn new(grid: &Grid, surface: &Surface, tolerances: &Tolerances) -> Schedule {
        Schedule::looked_at(grid, surface, tolerances, &Job::default())
    }

    /// The same, as long as the job goes on.
    ///
    /// # Errors
    /// [`Error::Stopped`](crate::Error::Stopped) where it is over.
    pub fn within(
        grid: &Grid,
        surface: &Surface,
        tolerances: &Tolerances,
        job: &Job,
    ) -> Result<Schedule> {
        job.check(PHASE)?;
        job.progress("measure", 0.5, Picture::None);
        let schedule = Schedule::looked_at(grid, surface, tolerances, job);
        job.check(PHASE)?;
        Ok(schedule)
    }

    /// The schedules; of no use where the job is over.
    fn looked_at(grid: &Grid, surface: &Surface, tolerances: &Tolerances, job: &Job) -> Schedule {
        let mut members = Members::new(grid, surface, job);
        if job.is_over(PHASE) {
            return Schedule::default();
        }
        let count = members.length.len().max(1) as f64;
        let mean = members.length.iter().sum::<f64>() / count;
        let length_tolerance = tolerances.length.unwrap_or(TOLERANCE * mean);
        members.group = groups_within(&members.length, length_tolerance);
        let panels = Panels::new(grid, &members);
        let nodes = Nodes::new(grid, surface, tolerances.angle_deg, job);
        members.take_bend(&nodes);
        let figures =
            Figures::new(&nodes, &members, &panels, length_tolerance, tolerances.angle_deg);
        Schedule { nodes, members, panels, figures }
    }
}

#[cfg(test)]
mod tests;
