//! Tables of wanted lengths and directions.
#![no_main]
use gridshell::job::Job;
use gridshell::io;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    gridshell_fuzz::with_file("csv", bytes, |path| {
        if let Ok(rows) = io::read_lengths(path, &Job::default()) {
            assert!(rows.iter().all(|r| r[3] > 0.0 && r.iter().all(|x| x.is_finite())));
        }
        if let Ok(rows) = io::read_directions(path, &Job::default()) {
            assert!(rows.iter().flatten().all(|x| x.is_finite()));
        }
    });
});
