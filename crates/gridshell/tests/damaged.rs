//! The files that the fuzz targets start from, and those that they broke a reader with: the first are read, the
//! second are no larger and take no longer than others.

use gridshell::io;
use gridshell::job::Job;
use gridshell::surface::{Model, Sampling};
use std::fs;
use std::path::{Path, PathBuf};

/// Folders whose files hold no surface.
const OTHER: [&str; 6] = ["lines", "values", "recipe", "native", "edits", "messages"];

/// The files of one of the fuzz folders that hold surfaces.
fn files(folder: &str) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz").join(folder);
    let mut files = Vec::new();
    for entry in fs::read_dir(root).expect("the folder is in the repository") {
        let folder = entry.expect("it can be listed").path();
        if folder.is_dir() && !OTHER.iter().any(|o| folder.ends_with(o)) {
            let inside = fs::read_dir(folder).expect("it can be listed");
            files.extend(inside.map(|e| e.expect("it can be listed").path()));
        }
    }
    files.sort();
    files
}

fn sampling(model: &Model) -> Sampling {
    let size = model.size();
    Sampling { max_edge: size / 16.0, chord_error: size / 100.0, corner_angle: 0.6 }
}

#[test]
fn every_seed_is_a_surface() {
    let files = files("seeds");
    assert!(files.len() > 10);
    for file in files {
        let model =
            io::open(&file.to_string_lossy(), &Job::default()).expect("a seed is a valid file");
        let surface =
            model.surface(&sampling(&model), &Job::default()).expect("a seed is a valid surface");
        assert!(surface.area > 0.0, "{}", file.display());
    }
}

#[test]
fn no_find_takes_more_triangles_than_a_sane_file_unless_it_is_refused() {
    let files = files("finds");
    assert!(files.len() >= 2);
    for file in files {
        let model = io::open(&file.to_string_lossy(), &Job::default())
            .expect("its numbers are odd, not wrong");
        let size = model.size();
        assert!(size < 1e9, "{}: {size:e} m large", file.display());
        let fine = Sampling { max_edge: size / 80.0, chord_error: 1e-4 * size, corner_angle: 0.6 };
        let triangles = match model.surface(&fine, &Job::default()) {
            Ok(surface) => surface.carrier.triangles.len(),
            Err(gridshell::Error::Surface(_)) => continue,
            Err(e) => panic!("{}: {e}", file.display()),
        };
        assert!(triangles < 200_000, "{}: {triangles} triangles", file.display());
    }
}
