//! Models of several separate parts: choosing one, and one grid of several pieces.

use crate::promise::quick;
use gridshell::job::Job;
use gridshell::recipe::{Parts, Recipe};
use gridshell::surface::{Model, PolygonMesh};
use gridshell::{DVec3, pipeline};

/// A sheet of 6 by 4 with a hole of 2 by 2, and apart from it one of 3 by 2.
fn sheets() -> Model {
    let (mut points, mut faces) = (Vec::new(), Vec::new());
    let mut sheet = |at: [f64; 2], cells: [u32; 2], hole: &dyn Fn(u32, u32) -> bool| {
        let first = points.len() as u32;
        for j in 0..=cells[1] {
            for i in 0..=cells[0] {
                points.push(DVec3::new(at[0] + f64::from(i), at[1] + f64::from(j), 0.0));
            }
        }
        let corner = |i: u32, j: u32| first + j * (cells[0] + 1) + i;
        for j in 0..cells[1] {
            for i in (0..cells[0]).filter(|&i| !hole(i, j)) {
                faces.push(vec![
                    corner(i, j),
                    corner(i + 1, j),
                    corner(i + 1, j + 1),
                    corner(i, j + 1),
                ]);
            }
        }
    };
    sheet([0.0, 0.0], [6, 4], &|i, j| (2..4).contains(&i) && (1..3).contains(&j));
    sheet([8.0, 0.0], [3, 2], &|_, _| false);
    Model::Mesh(PolygonMesh { name: "sheets".into(), points, faces, ..PolygonMesh::default() })
}

#[test]
fn several_parts_without_a_choice_are_an_error_that_lists_them() {
    let error = pipeline::generate(&sheets(), &quick(0.8), &Job::default()).unwrap_err();
    let text = error.to_string();
    for told in ["2 separate parts", "part 1: 20 faces, 20.000 m2, 2 loops", "part 2: 6 faces"] {
        assert!(text.contains(told), "{told} is not in: {text}");
    }
    let recipe = Recipe { part: Parts::Number(3), ..quick(0.8) };
    let error = pipeline::generate(&sheets(), &recipe, &Job::default()).unwrap_err();
    assert!(error.to_string().contains("1 to 2"), "{error}");
}

#[test]
fn all_parts_make_one_grid_whose_pieces_are_those_of_each_part() {
    let lay = |part| {
        let recipe = Recipe { part, ..quick(0.8) };
        pipeline::generate(&sheets(), &recipe, &Job::default()).unwrap()
    };
    let (all, one, two) = (lay(Parts::All), lay(Parts::Number(1)), lay(Parts::Number(2)));
    all.grid.mesh.check().unwrap();
    let together: Vec<DVec3> = one.grid.xyz.iter().chain(&two.grid.xyz).copied().collect();
    assert_eq!(all.grid.xyz, together);
    assert_eq!(all.quality.panels, one.quality.panels + two.quality.panels);
    assert_eq!(all.quality.euler_characteristic, 1);
    assert!((all.quality.area_ratio - 1.0).abs() < 0.02, "{}", all.quality.area_ratio);
    assert!(all.quality.surface_deviation < 1e-6 && all.quality.boundary_deviation < 1e-6);
    assert_eq!((all.surface.loops, all.parts.len()), (3, 2));
    assert_eq!(all.parts[1].first_node, one.grid.xyz.len());
    assert_eq!(all.stages.len(), one.stages.len());
    assert!(all.stages.iter().all(|stage| stage.grid.is_some()));
}

#[test]
fn an_anchor_goes_to_the_part_that_it_is_on() {
    let anchor = [9.3, 1.1, 0.0];
    let recipe = Recipe { part: Parts::All, anchors: vec![anchor], ..quick(0.8) };
    let run = pipeline::generate(&sheets(), &recipe, &Job::default()).unwrap();
    let at = run.grid.xyz.iter().position(|p| p.distance(anchor.into()) < 1e-9);
    assert!(at.unwrap() >= run.parts[1].first_node);
}
