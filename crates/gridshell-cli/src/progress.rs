//! The progress bar on stderr, when that is a terminal, and the job behind it.

use gridshell::job::{Job, Progress};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::{IsTerminal, stderr};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Steps of the bar.
const STEPS: f64 = 1000.0;

/// Exit code of a second interrupt, by the shells' habit: 128 + SIGINT.
const INTERRUPTED: i32 = 130;

/// A job with this time limit that shows its progress and stops at an interrupt; and its bar.
pub fn job(time_limit: Option<f64>) -> (Job, ProgressBar) {
    let bar = bar();
    let shown = bar.clone();
    let mut job = Job::default().with_progress(move |p: &Progress| {
        if shown.message() != p.stage {
            shown.set_message(p.stage);
        }
        shown.set_position((p.fraction * STEPS) as u64);
    });
    if let Some(seconds) = time_limit {
        job = job.with_time_limit(Duration::from_secs_f64(seconds));
    }
    stop_at_interrupt(&job);
    (job, bar)
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

/// The first interrupt asks the job to finish with what it has, the second one leaves at once.
fn stop_at_interrupt(job: &Job) {
    let job = job.clone();
    let asked = AtomicBool::new(false);
    let handler = move || {
        if asked.swap(true, Ordering::Relaxed) {
            std::process::exit(INTERRUPTED);
        }
        job.cancel();
    };
    // Without a handler an interrupt ends the program as it always does.
    let _ = ctrlc::set_handler(handler);
}
