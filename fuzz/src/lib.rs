//! Damaged files for every reader: what libFuzzer makes of the seeds, written to a file and opened as a user
//! would. A reader answers with a surface or an error; a panic, more than ten seconds or more than a gigabyte is
//! a find.

use gridshell::job::Job;
use gridshell::surface::{Model, Sampling};
use std::fs;
use std::path::{Path, PathBuf};

/// Carrier edges over the size of the model: coarse, so that more files are tried.
const FINENESS: f64 = 1.0 / 16.0;
/// Distance between carrier and surface over the size of the model.
const CHORD_ERROR: f64 = 1e-2;
/// Corners turn by more than this, radians.
const CORNER: f64 = 0.6;

/// Open these bytes as the surface in a file with this extension, and sample it.
pub fn surface(extension: &str, bytes: &[u8]) {
    with_file(extension, bytes, |path| {
        let Ok(model) = gridshell::io::open(&path.to_string_lossy(), &Job::default()) else { return };
        let size = model.size();
        assert!(size.is_finite(), "a model without a finite size");
        if let Model::Mesh(mesh) = &model {
            let count = mesh.points.len();
            assert!(
                mesh.faces.iter().flatten().all(|&v| (v as usize) < count),
                "a corner that is none"
            );
            assert!(mesh.points.iter().all(|p| p.is_finite()), "a place that is none");
        }
        let max_edge = size * FINENESS;
        let sampling = Sampling { max_edge, chord_error: size * CHORD_ERROR, corner_angle: CORNER };
        if let Ok(surface) = model.surface(&sampling, &Job::default()) {
            assert!(surface.area.is_finite(), "an area that is not a number");
        }
    });
}

/// Put these bytes into a file with this extension for as long as `read` takes.
pub fn with_file<T>(extension: &str, bytes: &[u8], read: impl FnOnce(&Path) -> T) -> T {
    let path = place(extension);
    fs::write(&path, bytes).expect("the temporary folder can be written");
    let answer = read(&path);
    // The next input overwrites it: that it stays behind once does no harm.
    let _ = fs::remove_file(&path);
    answer
}

fn place(extension: &str) -> PathBuf {
    std::env::temp_dir().join(format!("gridshell-fuzz-{}.{extension}", std::process::id()))
}
