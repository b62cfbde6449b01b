//! Grid files of the project's own, opened as a user would: what opens is a manifold grid with places that are numbers.
#![no_main]
use gridshell::io::Opening;
use gridshell::reopen;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    gridshell_fuzz::with_file("gridshell", bytes, |path| {
        let Ok(opened) = reopen::open(path, None, &Opening::default(), gridshell::io::Follow::Near, &gridshell::job::Job::default()) else { return };
        assert!(opened.grid.mesh.check().is_ok(), "a grid that is no manifold");
        assert!(opened.grid.xyz.iter().all(|p| p.is_finite()), "a place that is none");
    });
});
