//! Pictures of the work: there for every stage, of sense, and without a trace in the grid.

use crate::promise::{model, paper, quick};
use gridshell::job::{Job, Picture};
use gridshell::pipeline;
use gridshell::recipe::Recipe;
use std::collections::BTreeSet;
use std::sync::{Arc, Mutex};

/// The bits of the grid, and the stages that showed a picture.
fn watched(name: &str, recipe: &Recipe) -> (Vec<u64>, BTreeSet<&'static str>) {
    let seen: Arc<Mutex<BTreeSet<&'static str>>> = Arc::default();
    let told = Arc::clone(&seen);
    let job = Job::default().with_progress(move |progress| {
        assert!((0.0..=1.0).contains(&progress.fraction), "{}", progress.stage);
        let finite = match progress.picture {
            Picture::None => return,
            Picture::Bubbles { xyz, scales, diameter } => {
                assert!(xyz.len() == scales.len() && diameter > 0.0);
                xyz.iter().all(|p| p.is_finite())
            }
            Picture::Grid { mesh, xyz } => {
                mesh.triangles().flatten().all(|v| xyz[v as usize].is_finite())
            }
        };
        assert!(finite, "{}", progress.stage);
        told.lock().unwrap().insert(progress.stage);
    });
    let run = pipeline::generate(&model(name), recipe, &job).unwrap();
    let bits = run.grid.flat_xyz().iter().map(|x| x.to_bits()).collect();
    let seen = seen.lock().unwrap().clone();
    (bits, seen)
}

fn check(name: &str, recipe: &Recipe) {
    let run = pipeline::generate(&model(name), recipe, &Job::default()).unwrap();
    let alone: Vec<u64> = run.grid.flat_xyz().iter().map(|x| x.to_bits()).collect();
    let (bits, seen) = watched(name, recipe);
    assert!(alone == bits, "{name}: who looks on changes the grid");
    for stage in ["pack", "regularize", "relax"] {
        assert!(seen.contains(stage), "{name}: no picture of {stage}, only of {seen:?}");
    }
}

#[test]
fn looking_on_shows_every_stage_and_changes_nothing() {
    check("saddle", &quick(3.0));
}

#[test]
fn looking_on_at_the_method_as_printed_changes_nothing() {
    check("saddle", &paper(3.0));
}
