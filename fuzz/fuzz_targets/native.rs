//! Grid files of the project's own, opened as a user would: what opens is a manifold grid with places that are numbers.
#![no_main]
use gridshell::design::Design;
use gridshell::job::Job;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    gridshell_fuzz::with_file("gridshell", bytes, |path| {
        let Ok(design) = Design::open(path, &Job::default()) else { return };
        assert!(design.grid.mesh.check().is_ok(), "a grid that is not a manifold");
        assert!(design.grid.xyz.iter().all(|p| p.is_finite()), "a place that is none");
    });
});
