//! Logs of edits, replayed on a small grid: every edit is done or refused, and the grid stays a manifold.
#![no_main]
use gridshell::design::Design;
use gridshell::edit::Log;
use gridshell::job::Job;
use std::path::Path;
use std::sync::OnceLock;

static GRID: OnceLock<Design> = OnceLock::new();

libfuzzer_sys::fuzz_target!(|text: &str| {
    let Ok(log) = Log::from_json(text) else { return };
    let design = GRID.get_or_init(|| {
        let seed = Path::new(env!("CARGO_MANIFEST_DIR")).join("seeds/native/hexagon.gridshell");
        Design::open(&seed, &Job::default()).expect("the seed is a grid")
    });
    let mut editor = design.edit();
    let _ = editor.replay(&log, &Job::default());
    assert!(editor.grid().mesh.check().is_ok(), "a grid that is not a manifold");
    assert!(editor.grid().xyz.iter().all(|p| p.is_finite()), "a place that is none");
});
