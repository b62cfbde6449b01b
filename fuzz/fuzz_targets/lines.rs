//! Guides and anchors; the first byte chooses between OBJ and text.
#![no_main]
use gridshell::job::Job;
use gridshell::io;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let extension = if bytes.starts_with(b"v") { "obj" } else { "txt" };
    gridshell_fuzz::with_file(extension, bytes, |path| {
        if let Ok(guides) = io::read_guides(path, &Job::default()) {
            assert!(guides.iter().all(|g| g.len() >= 2 && g.iter().all(|p| p.is_finite())));
        }
        if let Ok(anchors) = io::read_anchors(path, &Job::default()) {
            assert!(anchors.iter().all(|p| p.is_finite()));
        }
    });
});
