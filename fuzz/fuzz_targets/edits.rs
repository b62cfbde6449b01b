//! Logs of edits, replayed on a small grid: every edit is done or refused, and the grid stays a manifold.
#![no_main]
use gridshell::edit::{Editor, Log};
use gridshell::io::Opening;
use gridshell::reopen::{self, Opened};
use std::path::Path;
use std::sync::{Arc, OnceLock};

static GRID: OnceLock<(Arc<gridshell::surface::Surface>, Opened)> = OnceLock::new();

libfuzzer_sys::fuzz_target!(|text: &str| {
    let Ok(log) = Log::from_json(text) else { return };
    let (surface, opened) = GRID.get_or_init(|| {
        let seed = Path::new(env!("CARGO_MANIFEST_DIR")).join("seeds/native/hexagon.gridshell");
        let opened = reopen::open(&seed, None, &Opening::default(), gridshell::io::Follow::Near, &gridshell::job::Job::default()).expect("the seed is a grid");
        (Arc::new(opened.surface.clone()), opened)
    });
    let recipe = opened.recipe.clone();
    let mut editor = Editor::new(surface.clone(), opened.grid.clone(), recipe, opened.edge_length);
    let _ = editor.replay(&log, &gridshell::job::Job::default());
    assert!(editor.grid().mesh.check().is_ok(), "a grid that is no manifold");
    assert!(editor.grid().xyz.iter().all(|p| p.is_finite()), "a place that is none");
});
