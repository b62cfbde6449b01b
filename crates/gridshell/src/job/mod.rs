//! A running job seen from outside: progress with pictures of the work, cancel, limits of time and memory.
//!
//! Every phase polls its job: [`Job::stopped`] asks for the best so far, [`Job::check`] gives up where there is no grid
//! yet. A poll is one atomic load, since a thread of its own watches the clock and the memory.
//!
//! Pictures are borrowed from the stage that is at work: they cost nothing unless the sink copies them, and since
//! the sink cannot change them, the grid is the same bit for bit whether anybody looks or not.

pub mod memory;
mod stop;

use crate::error::{Error, Result};
use crate::mesh::Mesh;
use glam::DVec3;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};
use stop::Stop;

/// How often a job is polled while work goes on that does not.
const LOOK_EVERY: Duration = Duration::from_millis(20);

/// One progress message.
pub struct Progress<'a> {
    /// What is done: first `read`, `sew`, `surface`, `fix`, `flatten`, then a stage as in the output (`pack`, `triangulate`,
    /// `regularize`, `relax`), then `measure`, `write`.
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
    Grid {
        /// Its topology.
        mesh: &'a Mesh,
        /// Position of each node, metres.
        xyz: &'a [DVec3],
    },
}

type Sink = Arc<dyn Fn(&Progress) + Send + Sync>;

/// Cancel flag, limits and progress sink of one run. Cheap to clone; clones share the flag.
#[derive(Clone)]
pub struct Job {
    stop: Arc<Stop>,
    /// Whether this part of the work is done even where the job is to stop.
    finishing: bool,
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
            stop: Arc::default(),
            finishing: false,
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
    pub fn with_time_limit(self, limit: Duration) -> Self {
        // A limit that the clock cannot express is none.
        if let Some(deadline) = Instant::now().checked_add(limit) {
            stop::watch_time(&self.stop, deadline);
        }
        self
    }

    /// A job that stops by itself when the process holds more than `bytes` of memory.
    #[must_use]
    pub fn with_memory_limit(self, bytes: u64) -> Self {
        stop::watch_memory(&self.stop, bytes);
        self
    }

    /// A job that, when stopped before there is a grid, may take this long to come to one before it gives up; half a
    /// second without.
    #[must_use]
    pub fn with_patience(self, patience: Duration) -> Self {
        self.stop.set_patience(patience);
        self
    }

    /// A job that tells `sink` of its progress. The sink is called from worker threads.
    #[must_use]
    pub fn with_progress(mut self, sink: impl Fn(&Progress) + Send + Sync + 'static) -> Self {
        self.sink = Some(Arc::new(sink));
        self
    }

    /// For tests: a job that counts its polls, stops at poll number `stop` and gives up `patience` polls later. No
    /// clock is involved, so a run on one thread can be repeated.
    #[must_use]
    pub fn counting(stop: u64, patience: u64) -> Job {
        Job { stop: Arc::new(Stop::counting(stop, patience)), ..Job::default() }
    }

    /// How often a [counting](Job::counting) job was polled, by phase; polls of no phase are under "".
    pub fn polls(&self) -> std::collections::BTreeMap<&'static str, u64> {
        self.stop.polls()
    }

    /// The same job, telling of this candidate, in a stretch of its stage from `span[0]` to `span[1]`.
    #[must_use]
    pub fn of_candidate(&self, candidate: usize, span: [f64; 2]) -> Self {
        Job { candidate, span, ..self.clone() }
    }

    /// The same job, told as work on `stage` whatever it is itself.
    #[must_use]
    pub fn part_of(&self, stage: &'static str) -> Self {
        Job { stage: Some(stage), ..self.clone() }
    }

    /// The same job for what must be done even after a stop: never stopped. For work that is linear in the grid.
    #[must_use]
    pub fn finishing(&self) -> Self {
        Job { finishing: true, ..self.clone() }
    }

    /// The same job, finishing where it has been asked to stop by now: for what follows when the best so far is there.
    #[must_use]
    pub fn after(&self) -> Self {
        if self.stopped() { self.finishing() } else { self.clone() }
    }

    /// Ask the job to stop; from any thread. The best grid so far is still finished and returned.
    pub fn cancel(&self) {
        self.stop.ask(Instant::now());
    }

    /// Whether the job should stop with the best it has: cancelled, or over a limit.
    pub fn stopped(&self) -> bool {
        !self.finishing && self.stop.is_asked("")
    }

    /// Whether the job should give up what it is at: stopped, and the time to come to a first grid is over; at once
    /// where memory is short.
    pub fn is_over(&self, phase: &'static str) -> bool {
        !self.finishing && self.stop.is_over(phase)
    }

    /// Go on, or give up `phase`, by words such as "reading" or "preparing the surface".
    ///
    /// # Errors
    /// [`Error::Stopped`] or [`Error::Memory`] where the job [is over](Job::is_over).
    pub fn check(&self, phase: &'static str) -> Result<()> {
        if self.is_over(phase) { Err(self.reason(phase)) } else { Ok(()) }
    }

    /// Why the job is over.
    pub(crate) fn reason(&self, phase: &'static str) -> Error {
        match self.stop.short_of_memory() {
            Some(limit) => Error::Memory(format!(
                "stopped {phase}: it took more than the memory limit of {}; ask for longer members or a simpler \
                 surface, or raise the limit (--memory-limit)",
                memory::told(limit)
            )),
            None => Error::Stopped { phase },
        }
    }

    /// Refuse work that is known to take about `bytes` of memory beyond what the process holds, where that is more
    /// than the limit; `what` names it.
    ///
    /// # Errors
    /// [`Error::Memory`].
    pub fn reserve(&self, bytes: f64, what: &str) -> Result<()> {
        let Some(limit) = self.stop.memory_limit() else { return Ok(()) };
        let needed = memory::resident().unwrap_or(0) as f64 + bytes;
        if needed <= limit as f64 {
            return Ok(());
        }
        Err(Error::Memory(format!(
            "{what} would take about {}, more than the memory limit of {}; ask for longer members or a simpler surface, \
             or raise the limit (--memory-limit)",
            memory::told(needed as u64),
            memory::told(limit)
        )))
    }

    /// Work that never polls, a decoder's say, on a thread of its own: where the job is over first, it is left behind.
    ///
    /// # Errors
    /// As [`Job::check`].
    ///
    /// # Panics
    /// Where the work does.
    pub(crate) fn apart<T: Send + 'static>(
        &self,
        phase: &'static str,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T> {
        self.check(phase)?;
        let (done, result) = mpsc::channel();
        let worker = thread::spawn(move || {
            // Nobody waits where the job was over first.
            let _ = done.send(work());
        });
        loop {
            match result.recv_timeout(LOOK_EVERY) {
                Ok(made) => return Ok(made),
                Err(RecvTimeoutError::Timeout) => self.check(phase)?,
                Err(RecvTimeoutError::Disconnected) => {
                    let Err(panic) = worker.join() else { unreachable!("it ended without a word") };
                    resume_unwind(panic);
                }
            }
        }
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

#[cfg(test)]
mod tests;
