//! Two sheets so near one another that straight lines leap between them.

use crate::promise::{kept_where_sharp, paper, quick};
use gridshell::DVec3;
use gridshell::recipe::Recipe;
use gridshell::surface::{Model, PolygonMesh};
use std::f64::consts::PI;

/// Of the bend, metres: the sheets are 0.4 m apart.
const RADIUS: f64 = 0.2;
/// Of a sheet, across the bend, metres.
const REACH: f64 = 9.0;
/// Along the bend, metres.
const WIDTH: f64 = 7.0;
/// Segments of the bend and of a sheet.
const BEND: usize = 16;
const SHEET: usize = 9;

/// Profile points: the lower sheet towards x = 0, round the bend, the upper sheet back.
fn profile() -> Vec<DVec3> {
    let out = (0..SHEET).map(|k| DVec3::new(REACH * (1.0 - k as f64 / SHEET as f64), 0.0, 0.0));
    let bend = (0..=BEND).map(|k| {
        let (sin, cos) = (PI * k as f64 / BEND as f64).sin_cos();
        DVec3::new(-RADIUS * sin, 0.0, RADIUS * (1.0 - cos))
    });
    let back = (1..=SHEET).map(|k| DVec3::new(REACH * k as f64 / SHEET as f64, 0.0, 2.0 * RADIUS));
    out.chain(bend).chain(back).collect()
}

/// The profile swept along y: developable, so distances along it are those in the unrolled plane.
fn fold() -> Model {
    let profile = profile();
    let rows = WIDTH as usize;
    let n = profile.len() as u32;
    let points = (0..=rows).flat_map(|r| profile.iter().map(move |p| p.with_y(r as f64))).collect();
    let quad = |r: u32, k: u32| {
        let a = r * n + k;
        vec![a, a + 1, a + 1 + n, a + n]
    };
    let faces = (0..rows as u32).flat_map(|r| (0..n - 1).map(move |k| quad(r, k))).collect();
    Model::Mesh(PolygonMesh { name: "fold".into(), points, faces, ..PolygonMesh::default() })
}

/// Arc length along the profile, metres from the end of the lower sheet.
fn unrolled(p: DVec3) -> DVec3 {
    let bend = PI * RADIUS;
    let across = if p.x >= 0.0 {
        if p.z < RADIUS { REACH - p.x } else { REACH + bend + p.x }
    } else {
        let angle = (-p.x).atan2(RADIUS - p.z);
        REACH + RADIUS * angle
    };
    DVec3::new(across, p.y, 0.0)
}

fn check(recipe: &Recipe) {
    let run = kept_where_sharp(&fold(), recipe);
    let l0 = run.edge_length;
    for (a, b) in run.grid.mesh.edges() {
        let [p, q] = [a, b].map(|v| run.grid.xyz[v as usize]);
        let along = unrolled(p).distance(unrolled(q));
        assert!(along < 1.8 * l0, "{p} to {q} is {along} m along the surface");
    }
}

#[test]
fn no_member_of_the_default_recipe_leaps_between_them() {
    check(&quick(1.0));
}

#[test]
fn no_member_of_the_method_as_printed_leaps_between_them() {
    check(&paper(1.0));
}
