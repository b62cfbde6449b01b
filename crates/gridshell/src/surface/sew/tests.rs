//! Sewing of small sheets.

use super::*;
use crate::surface::brep::BrepFace;
use crate::surface::exact::nurbs::NurbsSurface;
use crate::surface::{Sampling, Shape, Surface, tessellate};
use glam::DVec3;

/// A bilinear patch over the corners, counter-clockwise.
fn patch(corners: [[f64; 3]; 4]) -> BrepFace {
    let [a, b, c, d] = corners.map(DVec3::from);
    let knots = || vec![0.0, 0.0, 1.0, 1.0];
    let sheet = NurbsSurface::new([1, 1], [knots(), knots()], [2, 2], vec![a, d, b, c], vec![]);
    BrepFace {
        shape: Shape::Nurbs(sheet.unwrap()),
        loops: Vec::new(),
        reversed: false,
        label: String::new(),
    }
}

/// A level rectangle.
fn plate(x: [f64; 2], y: [f64; 2]) -> BrepFace {
    patch([[x[0], y[0], 0.0], [x[1], y[0], 0.0], [x[1], y[1], 0.0], [x[0], y[1], 0.0]])
}

fn model(faces: Vec<BrepFace>) -> Brep {
    Brep { name: "sheets".into(), unit_in_metres: 1.0, faces, ..Brep::default() }
}

fn sewn(faces: Vec<BrepFace>, tolerance: Option<f64>) -> Brep {
    let mut brep = model(faces);
    sew(&mut brep, tolerance, &Job::default()).unwrap();
    brep
}

fn surface(brep: &Brep) -> Surface {
    tessellate(
        brep,
        &Sampling { max_edge: 0.4, chord_error: 0.01, corner_angle: 0.5 },
        &Job::default(),
    )
    .unwrap()
}

#[test]
fn three_plates_at_a_t_junction_become_one_sheet() {
    let brep = sewn(
        vec![
            plate([0.0, 4.0], [0.0, 2.0]),
            plate([0.0, 1.5], [2.0, 3.0]),
            plate([1.5, 4.0], [2.0, 3.0]),
        ],
        None,
    );
    let sewing = brep.sewing.unwrap();
    assert_eq!((sewing.joints, sewing.facing), (3, 0));
    let s = surface(&brep);
    assert_eq!(s.loops.len(), 1);
    assert!((s.area - 12.0).abs() < 1e-12 && (s.loops[0].length() - 14.0).abs() < 1e-12);
    assert_eq!(s.euler_characteristic(), 1);
}

#[test]
fn faces_turned_over_are_sewn_all_the_same() {
    let mut back = plate([4.0, 8.0], [0.0, 2.0]);
    back.reversed = true;
    let s = surface(&sewn(vec![plate([0.0, 4.0], [0.0, 2.0]), back], None));
    assert_eq!(s.loops.len(), 1);
    assert!((s.loops[0].length() - 20.0).abs() < 1e-12);
}

#[test]
fn a_gap_beyond_the_tolerance_stays_and_is_told_with_the_tolerance_that_closes_it() {
    let faces = || vec![plate([0.0, 4.0], [0.0, 4.0]), plate([4.005, 8.0], [0.0, 4.0])];
    let brep = sewn(faces(), Some(1e-3));
    let sewing = brep.sewing.unwrap();
    assert_eq!((sewing.joints, sewing.facing), (0, 2));
    assert!((sewing.facing_gap - 0.005).abs() < 1e-12 && (sewing.facing_length - 8.0).abs() < 1e-9);
    assert!(brep.notes.iter().any(|n| n.contains("0.00550")), "{:?}", brep.notes);
    assert_eq!(surface(&brep).loops.len(), 2);
    let brep = sewn(faces(), Some(6e-3));
    let sewing = brep.sewing.unwrap();
    assert_eq!((sewing.joints, sewing.facing), (1, 0));
    assert!((sewing.largest_gap - 0.005).abs() < 1e-12);
    assert_eq!(surface(&brep).loops.len(), 1);
}

#[test]
fn plates_that_touch_in_a_point_stay_apart() {
    let brep = sewn(vec![plate([0.0, 1.0], [0.0, 1.0]), plate([1.0, 2.0], [1.0, 2.0])], None);
    assert_eq!(brep.sewing.unwrap().joints, 0);
    assert_eq!(surface(&brep).loops.len(), 2);
}

#[test]
fn four_plates_round_a_corner_share_one_vertex() {
    let faces = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    let faces = faces.map(|[x, y]| plate([x, x + 1.0], [y, y + 1.0]));
    let brep = sewn(faces.to_vec(), None);
    assert_eq!((brep.vertices.len(), brep.edges.len()), (9, 12));
    assert_eq!(surface(&brep).euler_characteristic(), 1);
}

#[test]
fn of_three_sheets_at_an_edge_the_smooth_two_are_joined_and_the_third_is_told() {
    let wall = patch([[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0], [1.0, 0.0, 1.0]]);
    let brep = sewn(vec![wall, plate([0.0, 1.0], [0.0, 1.0]), plate([1.0, 2.0], [0.0, 1.0])], None);
    assert_eq!(brep.sewing.unwrap().joints, 1);
    assert!(brep.notes.iter().any(|n| n.contains("more than two faces meet")), "{:?}", brep.notes);
    let s = surface(&brep);
    let lengths: Vec<f64> = s.loops.iter().map(|l| (l.length() * 1e6).round() / 1e6).collect();
    assert_eq!(lengths, [6.0, 4.0]);
}

#[test]
fn a_face_given_twice_counts_once() {
    let faces = vec![
        plate([0.0, 1.0], [0.0, 1.0]),
        plate([0.0, 1.0], [0.0, 1.0]),
        plate([1.0, 3.0], [0.0, 1.0]),
    ];
    let brep = sewn(faces, None);
    assert_eq!(brep.faces.len(), 2);
    assert!(brep.notes.iter().any(|n| n.contains("which lies on another")), "{:?}", brep.notes);
    assert!((surface(&brep).area - 3.0).abs() < 1e-12);
}

#[test]
fn a_sliver_narrower_than_the_tolerance_does_not_part_its_neighbours() {
    let faces = vec![
        plate([0.0, 1.0], [0.0, 1.0]),
        plate([1.0, 1.0005], [0.0, 1.0]),
        plate([1.0005, 2.0], [0.0, 1.0]),
    ];
    let s = surface(&sewn(faces, Some(1e-3)));
    assert_eq!(s.loops.len(), 1);
    assert!((s.area - 2.0).abs() < 2e-3);
}

#[test]
fn tolerances_that_would_swallow_the_model_are_refused() {
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY, 0.5] {
        assert!(
            sew(&mut model(vec![plate([0.0, 1.0], [0.0, 1.0])]), Some(tolerance), &Job::default())
                .is_err()
        );
    }
}

#[test]
fn sewing_twice_changes_nothing() {
    let once = sewn(vec![plate([0.0, 4.0], [0.0, 2.0]), plate([0.0, 1.5], [2.0, 3.0])], None);
    let mut twice = once.clone();
    sew(&mut twice, None, &Job::default()).unwrap();
    assert_eq!(twice.sewing.unwrap().joints, 0);
    assert_eq!(twice.edges.len(), once.edges.len());
    assert_eq!(twice.vertices, once.vertices);
}
