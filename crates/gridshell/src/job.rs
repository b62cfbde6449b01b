//! A running job seen from outside: progress with pictures of the work, cancel, time limit.
//!
//! Pictures are borrowed from the stage that is at work: they cost nothing unless the sink copies them, and since
//! the sink cannot change them, the grid is the same bit for bit whether anybody looks or not.

use crate::grid::Grid;
use glam::DVec3;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// One progress message.
pub struct Progress<'a> {
    /// Stage name as in the output: `pack`, `triangulate`, `regularize`, `relax`.
    pub stage: &'static str,
    /// Share of the stage that is done, 0 to 1; candidates at work side by side tell their own.
    pub fraction: f64,
    /// Which candidate this is about, counted from 0; 0 as well where there are none.
    pub candidate: usize,
    /// The work as it stands.
    pub picture: Picture<'a>,
}

/// The work as it stands, to be copied by who wants to show it.
#[derive(Clone, Copy)]
pub enum Picture<'a> {
    /// Nothing to show.
    None,
    /// Bubbles on the carrier.
    Bubbles {
        /// Their centres, metres.
        xyz: &'a [DVec3],
        /// Their diameters over `diameter`.
        scales: &'a [f64],
        /// Mean diameter, metres.
        diameter: f64,
    },
    /// A grid; nodes that are not alive belong to no panel.
    Grid(&'a Grid),
}

type Sink = Arc<dyn Fn(&Progress) + Send + Sync>;

/// Cancel flag, deadline and progress sink of one run. Cheap to clone; clones share the flag.
#[derive(Clone)]
pub struct Job {
    cancelled: Arc<AtomicBool>,
    deadline: Option<Instant>,
    sink: Option<Sink>,
    candidate: usize,
    /// The stage that the work is told to be of, where not the one that it tells.
    stage: Option<&'static str>,
    /// Where in its stage the work is that reports 0 and 1.
    span: [f64; 2],
}

impl Default for Job {
    fn default() -> Job {
        Job {
            cancelled: Arc::default(),
            deadline: None,
            sink: None,
            candidate: 0,
            stage: None,
            span: [0.0, 1.0],
        }
    }
}

impl Job {
    /// A job that stops by itself after `limit`.
    #[must_use]
    pub fn with_time_limit(mut self, limit: Duration) -> Self {
        self.deadline = Some(Instant::now() + limit);
        self
    }

    /// A job that tells `sink` of its progress. The sink is called from worker threads.
    #[must_use]
    pub fn with_progress(mut self, sink: impl Fn(&Progress) + Send + Sync + 'static) -> Self {
        self.sink = Some(Arc::new(sink));
        self
    }

    /// The same job, telling of this candidate, in a stretch of its stage from `span[0]` to `span[1]`.
    #[must_use]
    pub fn of_candidate(&self, candidate: usize, span: [f64; 2]) -> Self {
        Job { candidate, span, ..self.clone() }
    }

    /// For a short part that is finished anyway: never stopped, and told as work on `stage` whatever it is itself.
    #[must_use]
    pub fn part_of(&self, stage: &'static str) -> Self {
        Job { cancelled: Arc::default(), deadline: None, stage: Some(stage), ..self.clone() }
    }

    /// Ask the job to stop; from any thread. The best grid so far is still finished and returned.
    pub fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether the job should stop: cancelled, or past its deadline.
    pub fn stopped(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed) || self.deadline.is_some_and(|d| Instant::now() >= d)
    }

    /// Report progress; costs nothing without a sink.
    pub fn progress(&self, stage: &'static str, fraction: f64, picture: Picture) {
        let Some(sink) = &self.sink else { return };
        let [from, to] = self.span;
        let fraction = from + (to - from) * fraction.clamp(0.0, 1.0);
        let stage = self.stage.unwrap_or(stage);
        sink(&Progress { stage, fraction, candidate: self.candidate, picture });
    }
}
