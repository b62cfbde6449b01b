//! Jobs that are stopped still end with a valid grid.

use crate::promise::{check, model, quick};
use gridshell::job::Job;
use gridshell::pipeline;
use gridshell::recipe::Recipe;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// However busy the machine is, a first grid is waited for.
const PATIENCE: Duration = Duration::from_secs(600);

fn stopped(name: &str, recipe: &Recipe, job: &Job) {
    let run = pipeline::generate(&model(name), recipe, job).unwrap();
    assert!(run.stopped, "{name}");
    // Random bubbles that never moved may leave folded panels; all else holds.
    run.grid.mesh.check().unwrap();
    check(&model(name), &run);
}

#[test]
fn a_job_cancelled_before_its_start_gives_a_valid_grid() {
    for (name, length) in [("hexagon", 0.5), ("saddle", 3.0), ("great-court", 6.0)] {
        let job = Job::default().with_patience(PATIENCE);
        job.cancel();
        stopped(name, &quick(length), &job);
    }
}

#[test]
fn a_tiny_time_limit_gives_a_valid_grid() {
    let job = Job::default().with_time_limit(Duration::from_millis(1)).with_patience(PATIENCE);
    stopped("saddle", &quick(3.0), &job);
}

#[test]
fn a_job_cancelled_from_its_own_progress_stops_in_the_middle() {
    let seen = Arc::new(AtomicBool::new(false));
    let job = Job::default().with_patience(PATIENCE);
    let (stop, told) = (job.clone(), Arc::clone(&seen));
    let job = job.with_progress(move |progress| {
        assert!((0.0..=1.0).contains(&progress.fraction));
        told.store(true, Ordering::Relaxed);
        stop.cancel();
    });
    stopped("saddle", &quick(2.0), &job);
    assert!(seen.load(Ordering::Relaxed), "no progress was told");
}
