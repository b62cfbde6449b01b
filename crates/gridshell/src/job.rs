//! A running job seen from outside: progress with intermediate positions, cancel, time limit.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// One progress message.
pub struct Progress<'a> {
    /// Stage name as in the output: `pack`, `triangulate`, `regularize`, `relax`.
    pub stage: &'static str,
    /// Share of the stage that is done, 0 to 1.
    pub fraction: f64,
    /// Present node (or bubble) positions, xyz in metres, flat; may be empty.
    pub positions: &'a [f64],
}

type Sink = Arc<dyn Fn(&Progress) + Send + Sync>;

/// Cancel flag, deadline and progress sink of one run. Cheap to clone; clones share the flag.
#[derive(Clone, Default)]
pub struct Job {
    cancelled: Arc<AtomicBool>,
    deadline: Option<Instant>,
    sink: Option<Sink>,
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

    /// Ask the job to stop; from any thread. The best grid so far is still finished and returned.
    pub fn cancel(&self) {
        self.cancelled.store(true, Ordering::Relaxed);
    }

    /// Whether the job should stop: cancelled, or past its deadline.
    pub fn stopped(&self) -> bool {
        self.cancelled.load(Ordering::Relaxed) || self.deadline.is_some_and(|d| Instant::now() >= d)
    }

    /// Report progress; costs nothing without a sink.
    pub fn progress(&self, stage: &'static str, fraction: f64, positions: &[f64]) {
        if let Some(sink) = &self.sink {
            sink(&Progress { stage, fraction: fraction.clamp(0.0, 1.0), positions });
        }
    }
}
