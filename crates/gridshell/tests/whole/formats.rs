//! One surface as programs write it: in every format and unit the same figures, whatever the search does with the last
//! digits in which files differ.

use crate::promise::{kept, recipe};
use gridshell::io::{self, Opening};
use gridshell::job::Job;
use gridshell::recipe::Recipe;
use std::path::Path;

/// Share by which figures may differ.
const ALIKE: f64 = 1e-3;

/// Nodes, then the paper's measures.
fn figures(file: &str, recipe: &Recipe) -> [f64; 6] {
    let files = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files");
    let model = io::load(&files.join(file), &Opening::default(), &Job::default()).unwrap();
    let run = kept(&model, recipe);
    let q = &run.quality;
    let nodes = run.grid.mesh.vertex_count() as f64;
    [nodes, q.fluency.unwrap(), q.mu, q.delta_deg, q.edge_length.cv, q.shape.mean]
}

fn check(files: &[&str]) {
    let recipe = Recipe { candidates: Some(4), ..recipe(0.6) };
    let first = figures(files[0], &recipe);
    for file in &files[1..] {
        let other = figures(file, &recipe);
        let alike = first.iter().zip(&other).all(|(a, b)| (a - b).abs() <= ALIKE * a.abs());
        assert!(alike, "{}: {first:?}\n{file}: {other:?}", files[0]);
    }
}

#[test]
fn a_trimmed_roof_gives_one_grid_from_step_and_iges_in_metres_millimetres_and_inches() {
    check(&[
        "roof_m_ap203.step",
        "roof_mm_ap214.step",
        "roof_inch_ap242.step",
        "roof_no_pcurves.step",
        "roof_m.igs",
        "roof_mm.igs",
        "roof_inch_brep.igs",
    ]);
}

#[test]
#[cfg(feature = "3dm")]
fn a_patch_gives_one_grid_from_step_and_rhino_in_metres_millimetres_and_inches() {
    check(&[
        "patch_m.step",
        "patch_mm.step",
        "patch_in.step",
        "patch_v2_mm.3dm",
        "patch_v3_m.3dm",
        "patch_v4_in.3dm",
        "patch_v5_mm.3dm",
        "patch_v6_m.3dm",
        "patch_v7_mm.3dm",
        "patch_v8_in.3dm",
    ]);
}
