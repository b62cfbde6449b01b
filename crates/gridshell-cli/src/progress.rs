//! The progress bar on stderr, when that is a terminal, and the job behind it.

use crate::args::Limits;
use crate::failure::Failure;
use crate::say;
use gridshell::job::{Job, Progress, memory};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal, stderr};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// The stage in which others' decoders may be at work.
const READ: &str = "read";
/// How long one may go on after a stop, and how often that is looked at.
const LONG: Duration = Duration::from_millis(300);
const LOOK: Duration = Duration::from_millis(50);

/// Steps of the bar.
const STEPS: f64 = 1000.0;

/// Exit code of a second interrupt, by the shells' habit: 128 + SIGINT.
const INTERRUPTED: i32 = 130;

/// Work that a command does: it keeps to its limits, stops at an interrupt, and is seen.
pub struct Work {
    /// What the library is given.
    pub job: Job,
    bar: ProgressBar,
}

impl Work {
    /// Work with these limits.
    pub fn new(limits: &Limits) -> Work {
        let bar = bar();
        let (shown, reading) = (bar.clone(), Arc::new(AtomicBool::new(false)));
        let reads = Arc::clone(&reading);
        let mut job = Job::default().with_progress(move |p: &Progress| {
            reads.store(p.stage == READ, Ordering::Relaxed);
            if shown.message() != p.stage {
                shown.set_message(p.stage);
            }
            shown.set_position((p.fraction * STEPS) as u64);
        });
        if let Some(limit) = memory_limit(limits) {
            job = job.with_memory_limit(limit);
        }
        if let Some(seconds) = limits.time_limit {
            // Longer than the clock can tell is not a limit.
            let limit = Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX);
            job = job.with_time_limit(limit);
        }
        leave_where_reading_does_not_end(&job, reading);
        Work { job, bar }
    }

    /// The same, and the first interrupt asks to finish with what there is, the second one leaves at once.
    pub fn interruptible(limits: &Limits) -> Work {
        let work = Work::new(limits);
        let job = work.job.clone();
        let asked = AtomicBool::new(false);
        let handler = move || {
            if asked.swap(true, Ordering::Relaxed) {
                std::process::exit(INTERRUPTED);
            }
            job.cancel();
        };
        // Without a handler an interrupt ends the program as it always does.
        let _ = ctrlc::set_handler(handler);
        work
    }

    /// The same for a command that has no best so far: there is nothing to wait for when it is to stop.
    pub fn ends_at_once(self) -> Work {
        Work { job: self.job.with_patience(Duration::ZERO), ..self }
    }

    /// Take the bar away: results are told now.
    pub fn told(&self) {
        self.bar.finish_and_clear();
    }
}

/// The decoders of some formats are not ours and cannot be stopped: where one goes on long after it should have stopped,
/// the program leaves. Nothing has been written by then.
fn leave_where_reading_does_not_end(job: &Job, reading: Arc<AtomicBool>) {
    let job = job.clone();
    let watch = move || {
        let mut late = Duration::ZERO;
        while late < LONG {
            std::thread::sleep(LOOK);
            let over = reading.load(Ordering::Relaxed) && job.is_over("reading");
            late = if over { late + LOOK } else { Duration::ZERO };
        }
        if let Err(error) = job.check("reading") {
            let Failure { code, message } = Failure::from(error);
            say::note(&format!("gridshell: {message}"));
            std::process::exit(code.into());
        }
    };
    // Without it reading goes on to its end.
    let _ = std::thread::Builder::new().name("reading".into()).spawn(watch);
}

/// The limit of memory that is given, else the usual one, bytes.
pub fn memory_limit(limits: &Limits) -> Option<u64> {
    limits.memory_limit.or_else(memory::usual_limit)
}

fn bar() -> ProgressBar {
    if !stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(STEPS as u64), ProgressDrawTarget::stderr());
    let style = ProgressStyle::with_template("{elapsed_precise} {msg:12} {bar:40} {percent:>3} %")
        .expect("the template is well formed");
    bar.set_style(style);
    bar
}
