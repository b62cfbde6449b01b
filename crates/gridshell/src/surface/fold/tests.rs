//! Folded faces made here: parted, they are what several faces would be.

use super::*;
use crate::surface::brep::{BrepEdge, BrepFace, Coedge};
use crate::surface::exact::nurbs::NurbsCurve;
use crate::surface::{Fixtures, Surface, tessellate};
use glam::{DVec2, DVec3};
use std::sync::Arc;

const SAMPLING: Sampling = Sampling { max_edge: 0.4, chord_error: 0.01, corner_angle: 0.5 };

fn knots(degree: usize, spans: usize) -> Vec<f64> {
    let inner = (1..spans).flat_map(|k| std::iter::repeat_n(k as f64, degree));
    let ends = |t: f64| std::iter::repeat_n(t, degree + 1);
    ends(0.0).chain(inner).chain(ends(spans as f64)).collect()
}

/// A polyline of degree 1 drawn straight along y.
fn extruded(line: &[(f64, f64)], depth: f64) -> NurbsSurface {
    let points = line.iter().flat_map(|&(x, z)| [0.0, depth].map(|y| DVec3::new(x, y, z)));
    let knots = [knots(1, line.len() - 1), knots(1, 1)];
    NurbsSurface::new([1, 1], knots, [line.len(), 2], points.collect(), vec![]).unwrap()
}

/// A net of degree 1 by 1 over whole numbers.
fn net(n: usize, m: usize, z: impl Fn(usize, usize) -> f64) -> NurbsSurface {
    let at = |i: usize, j: usize| DVec3::new(i as f64, j as f64, z(i, j));
    let points = (0..=n).flat_map(|i| (0..=m).map(move |j| (i, j))).map(|(i, j)| at(i, j));
    let points = points.collect();
    NurbsSurface::new([1, 1], [knots(1, n), knots(1, m)], [n + 1, m + 1], points, vec![]).unwrap()
}

fn whole(patch: NurbsSurface) -> Brep {
    let face = BrepFace {
        shape: Shape::Nurbs(patch),
        loops: Vec::new(),
        reversed: false,
        label: String::new(),
    };
    Brep { faces: vec![face], ..Brep::default() }
}

/// The patch trimmed by polygons in (u, v): the first round it, the others holes.
fn trimmed(patch: NurbsSurface, polygons: &[&[(f64, f64)]]) -> Brep {
    let mut brep = whole(patch);
    let shape = Arc::new(brep.faces[0].shape.clone());
    for polygon in polygons {
        let from = brep.vertices.len() as u32;
        let n = polygon.len();
        let mut coedges = Vec::new();
        for (k, &(u, v)) in polygon.iter().enumerate() {
            brep.vertices.push(shape.point(DVec2::new(u, v)));
            let next = polygon[(k + 1) % n];
            let uv = vec![DVec3::new(u, v, 0.0), DVec3::new(next.0, next.1, 0.0)];
            let line = NurbsCurve::new(1, knots(1, 1), uv, vec![]).unwrap();
            let curve = Curve::OnShape(shape.clone(), line);
            let ends = [from + k as u32, from + ((k + 1) % n) as u32];
            coedges.push(Coedge { edge: brep.edges.len() as u32, reversed: false });
            brep.edges.push(BrepEdge { curve, range: [0.0, 1.0], ends });
        }
        brep.faces[0].loops.push(coedges);
    }
    brep
}

/// Parted, tessellated, and its creases found.
fn laid(mut brep: Brep) -> (Brep, Surface) {
    split_folds(&mut brep, &Job::default()).unwrap();
    let mut surface = tessellate(&brep, &SAMPLING, &Job::default()).unwrap();
    surface.fix(&creases(), &Job::default()).unwrap();
    (brep, surface)
}

fn creases() -> Fixtures<'static> {
    Fixtures {
        crease_angle: Some(0.35),
        guides: &[],
        anchors: &[],
        corner_angle: 0.5,
        edge_length: 1.0,
    }
}

fn length(surface: &Surface) -> f64 {
    surface.features.iter().map(crate::surface::Chain::length).sum()
}

fn near(a: f64, b: f64) -> bool {
    (a / b - 1.0).abs() < 1e-9
}

#[test]
fn a_gable_in_one_face_has_its_ridge_as_a_crease() {
    let (brep, surface) = laid(whole(extruded(&[(0.0, 0.0), (4.0, 3.0), (8.0, 0.0)], 10.0)));
    assert_eq!((brep.faces.len(), brep.edges.len(), brep.vertices.len()), (2, 7, 6));
    assert!(near(surface.area, 100.0), "{}", surface.area);
    assert_eq!((surface.features.len(), surface.loops.len()), (1, 1));
    assert!(near(length(&surface), 10.0));
    assert_eq!(surface.loops[0].corners.len(), 6);
}

#[test]
fn an_edge_that_bounds_no_face_is_not_followed() {
    // Cuts leave such edges over; the box of the surface was then looked for at a vertex that does not exist.
    let mut brep = whole(extruded(&[(0.0, 0.0), (4.0, 3.0), (8.0, 0.0)], 10.0));
    let stray = brep.vertices.len() as u32;
    brep.vertices.extend([DVec3::new(0.0, 0.0, 50.0), DVec3::new(1.0, 0.0, 50.0)]);
    let line = NurbsCurve::new(1, knots(1, 1), brep.vertices.clone(), vec![]).unwrap();
    brep.edges.push(BrepEdge {
        curve: Curve::Nurbs(line),
        range: [0.0, 1.0],
        ends: [stray, stray + 1],
    });
    let (_, surface) = laid(brep);
    let [low, high] = surface.extent();
    assert!(low.length() < 1e-9 && high.distance(DVec3::new(8.0, 10.0, 3.0)) < 1e-9, "{high}");
}

#[test]
fn a_face_of_too_many_folds_is_told_to_stay_whole() {
    let mut brep = whole(net(240, 240, |i, j| 0.6 * (i % 2 + j % 2) as f64));
    split_folds(&mut brep, &Job::default()).unwrap();
    assert_eq!(brep.faces.len(), 1);
    assert!(
        brep.notes[0].starts_with("1 face folds along lines that could not be split (face 1"),
        "{:?}",
        brep.notes
    );
}

#[test]
fn folded_plates_in_both_directions_meet_in_points() {
    let roof = net(4, 3, |i, j| 0.6 * (i % 2 + j % 2) as f64);
    let (brep, surface) = laid(whole(roof));
    assert_eq!((brep.faces.len(), brep.vertices.len(), brep.edges.len()), (12, 20, 31));
    assert_eq!(surface.euler_characteristic(), 1);
    assert_eq!(surface.features.len(), 31 - 14);
}

#[test]
fn two_arches_that_meet_in_a_valley_are_two_faces() {
    // Degree 2, with a knot twice.
    let arch = [(0.0, 0.0), (2.5, 4.0), (5.0, 0.0), (7.5, 4.0), (10.0, 0.0)];
    let points = arch.iter().flat_map(|&(x, z)| [0.0, 12.0].map(|y| DVec3::new(x, y, z)));
    let patch =
        NurbsSurface::new([2, 1], [knots(2, 2), knots(1, 1)], [5, 2], points.collect(), vec![]);
    let (brep, surface) = laid(whole(patch.unwrap()));
    assert_eq!(brep.faces.len(), 2);
    assert!(near(length(&surface), 12.0) && surface.features.len() == 1);
}

#[test]
fn smooth_knots_and_planes_of_degree_one_stay_whole() {
    let straight = extruded(&[(0.0, 0.0), (4.0, 3.0), (8.0, 6.0)], 10.0);
    // Two pieces of a parabola that meet without a turn.
    let arch = [(0.0, 0.0), (2.5, 2.0), (5.0, 2.0), (7.5, 2.0), (10.0, 0.0)];
    let points = arch.iter().flat_map(|&(x, z)| [0.0, 12.0].map(|y| DVec3::new(x, y, z)));
    let arch =
        NurbsSurface::new([2, 1], [knots(2, 2), knots(1, 1)], [5, 2], points.collect(), vec![]);
    for patch in [straight, arch.unwrap(), net(9, 7, |i, j| 0.1 * (i + 2 * j) as f64)] {
        let mut brep = whole(patch);
        split_folds(&mut brep, &Job::default()).unwrap();
        assert_eq!((brep.faces.len(), brep.notes.len()), (1, 0));
    }
}

#[test]
fn trims_and_openings_across_folds_are_cut_where_they_meet_them() {
    let roof = extruded(&[(0.0, 0.0), (4.0, 3.0), (8.0, 0.0), (12.0, 3.0)], 10.0);
    let each = 5.0;
    // All but a corner beyond the last fold, a hole over two folds, one beside them, one with a corner on a fold.
    let outer = [(0.1, 0.1), (2.9, 0.1), (2.9, 0.6), (1.8, 0.9), (0.1, 0.9)];
    let over = [(0.8, 0.3), (0.8, 0.5), (2.2, 0.5), (2.2, 0.3)];
    let beside = [(0.3, 0.6), (0.3, 0.8), (0.6, 0.8), (0.6, 0.6)];
    let touching = [(1.0, 0.7), (1.4, 0.8), (1.4, 0.6)];
    let (brep, surface) = laid(trimmed(roof, &[&outer, &over, &beside, &touching]));
    let polygon = |p: &[(f64, f64)]| {
        let n = p.len();
        let cross = |k: usize| p[k].0 * p[(k + 1) % n].1 - p[k].1 * p[(k + 1) % n].0;
        0.5 * (0..n).map(cross).sum::<f64>().abs()
    };
    let free = polygon(&outer) - polygon(&over) - polygon(&beside) - polygon(&touching);
    assert!(near(surface.area, free * each * 10.0), "{} {}", surface.area, free * 50.0);
    assert_eq!(surface.loops.len(), 4);
    // The hole over two folds leaves two parts between them.
    assert_eq!(brep.faces.len(), 4);
    // The fold at u = 1 is cut by the hole over it, and at the corner that touches it; that at u = 2 by the hole.
    let end = 0.6 + 0.3 * (2.9 - 2.0) / (2.9 - 1.8);
    let long = 10.0 * ((0.9 - 0.5) + (0.3 - 0.1) + (0.3 - 0.1) + (end - 0.5));
    assert!(near(length(&surface), long), "{} {long}", length(&surface));
}

#[test]
fn tubes_of_folded_plates_close_across_their_seam() {
    let box_ = [(0.0, 0.0), (10.0, 0.0), (10.0, 6.0), (0.0, 6.0), (0.0, 0.0)];
    let points = box_.iter().flat_map(|&(x, y)| [0.0, 3.0].map(|z| DVec3::new(x, y, z)));
    let tube =
        NurbsSurface::new([1, 1], [knots(1, 4), knots(1, 1)], [5, 2], points.collect(), vec![]);
    let (brep, surface) = laid(whole(tube.unwrap()));
    assert_eq!((brep.faces.len(), surface.loops.len()), (4, 2));
    assert!(near(surface.area, 96.0) && near(length(&surface), 12.0));
    assert!(surface.loops.iter().all(|l| l.corners.len() == 4));
}

/// A quarter circle's rational points, four times round.
fn round(profile: &[(f64, f64)]) -> NurbsSurface {
    let w = std::f64::consts::FRAC_1_SQRT_2;
    let ring = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)];
    let (mut points, mut weights) = (Vec::new(), Vec::new());
    for (k, &(x, y)) in ring.iter().enumerate() {
        for &(r, z) in profile {
            points.push(DVec3::new(r * f64::from(x), r * f64::from(y), z));
            weights.push(if k % 2 == 1 { w } else { 1.0 });
        }
    }
    let count = [9, profile.len()];
    let knots = [knots(2, 4), knots(1, profile.len() - 1)];
    NurbsSurface::new([2, 1], knots, count, points, weights).unwrap()
}

#[test]
fn a_polyline_turned_about_an_axis_has_rings_of_creases() {
    // A drum with a cone on it, down to the tip.
    let (_, surface) = laid(whole(round(&[(3.0, 0.0), (3.0, 2.0), (0.0, 6.0)])));
    let tau = std::f64::consts::TAU;
    let exact = tau * 3.0 * 2.0 + 0.5 * tau * 3.0 * 5.0;
    assert!((surface.area / exact - 1.0).abs() < 1e-4, "{} {exact}", surface.area);
    assert_eq!((surface.loops.len(), surface.features.len()), (1, 1));
    assert!((length(&surface) / (tau * 3.0) - 1.0).abs() < 2e-2);
    assert_eq!(surface.euler_characteristic(), 1);
}

#[test]
fn holes_across_a_fold_and_the_seam_of_a_tube_are_kept() {
    let drum = round(&[(3.0, 0.0), (3.0, 2.0), (1.0, 4.0)]);
    let mut brep = trimmed(drum, &[&[(-0.3, 0.7), (-0.3, 1.3), (0.4, 1.3), (0.4, 0.7)]]);
    // The two rims, without a seam, beginning elsewhere than the patch.
    for (v, way) in [(0.0, false), (2.0, true)] {
        let shape = Arc::new(brep.faces[0].shape.clone());
        let ends = [DVec2::new(2.0, v), DVec2::new(6.0, v)];
        brep.vertices.push(shape.point(ends[0]));
        let vertex = brep.vertices.len() as u32 - 1;
        brep.edges.push(BrepEdge {
            curve: Curve::UvLine { shape, ends },
            range: [0.0, 1.0],
            ends: [vertex; 2],
        });
        let edge = brep.edges.len() as u32 - 1;
        brep.faces[0].loops.push(vec![Coedge { edge, reversed: way }]);
    }
    let (_, surface) = laid(brep);
    assert_eq!(surface.loops.len(), 3);
    assert_eq!(surface.euler_characteristic(), -1);
}

#[test]
fn pyramids_fold_up_to_their_tip() {
    let square = [(5.0, 5.0), (-5.0, 5.0), (-5.0, -5.0), (5.0, -5.0), (5.0, 5.0)];
    let points = square.iter().flat_map(|&(x, y)| [DVec3::new(x, y, 0.0), DVec3::Z * 5.0]);
    let roof =
        NurbsSurface::new([1, 1], [knots(1, 4), knots(1, 1)], [5, 2], points.collect(), vec![]);
    let (brep, surface) = laid(whole(roof.unwrap()));
    assert_eq!((brep.faces.len(), surface.loops.len(), surface.features.len()), (4, 1, 4));
    assert!(near(surface.area, 100.0 * 2.0_f64.sqrt()), "{}", surface.area);
}

#[test]
fn hundreds_of_folds_cost_no_more_than_their_number() {
    // Facets of an arch stay one face; a corrugated sheet is parted into its strips.
    let arch = |k: i32| (0.05 * f64::from(k), 2.0 - 0.0008 * f64::from((k - 50) * (k - 50)));
    let mut facets = whole(extruded(&(0..=100).map(arch).collect::<Vec<_>>(), 4.0));
    split_folds(&mut facets, &Job::default()).unwrap();
    assert_eq!(facets.faces.len(), 1);
    let wave = |k: i32| (0.5 * f64::from(k), 0.3 * f64::from(k % 2));
    let mut sheet = whole(extruded(&(0..=400).map(wave).collect::<Vec<_>>(), 4.0));
    split_folds(&mut sheet, &Job::default()).unwrap();
    assert_eq!((sheet.faces.len(), sheet.edges.len()), (400, 1201));
    // Each strip has no more of the patch than it needs.
    assert!(sheet.faces.iter().all(|f| f.shape.spline().unwrap().points.len() == 4));
    let mut egg = whole(net(40, 40, |i, j| 0.5 * ((i * 7 + j * 13) % 3) as f64));
    split_folds(&mut egg, &Job::default()).unwrap();
    assert_eq!((egg.faces.len(), egg.vertices.len()), (1600, 41 * 41));
}

#[test]
fn faces_beside_a_folded_one_share_its_pieces() {
    // A gable and an upright face under its front, which keeps one edge for both sides of the fold.
    let roof = extruded(&[(0.0, 0.0), (4.0, 3.0), (8.0, 0.0)], 10.0);
    let mut brep = whole(roof);
    let line = vec![DVec3::ZERO, DVec3::new(4.0, 0.0, 3.0), DVec3::new(8.0, 0.0, 0.0)];
    let front = NurbsCurve::new(1, knots(1, 2), line, vec![]).unwrap();
    let sill = NurbsCurve::line(DVec3::ZERO, DVec3::X * 8.0);
    brep.vertices = vec![DVec3::ZERO, DVec3::X * 8.0];
    for (curve, range) in [(front, [0.0, 2.0]), (sill, [0.0, 1.0])] {
        brep.edges.push(BrepEdge { curve: Curve::Nurbs(curve), range, ends: [0, 1] });
    }
    let wall = [(0.0, 0.0), (8.0, 0.0)].map(|(x, _)| DVec3::new(x, 0.0, 0.0));
    let wall = [wall[0], wall[0] + DVec3::Z * 3.0, wall[1], wall[1] + DVec3::Z * 3.0];
    let wall = NurbsSurface::new([1, 1], [knots(1, 1), knots(1, 1)], [2, 2], wall.to_vec(), vec![]);
    let pair = [Coedge { edge: 1, reversed: false }, Coedge { edge: 0, reversed: true }];
    brep.faces.push(BrepFace {
        shape: Shape::Nurbs(wall.unwrap()),
        loops: vec![pair.to_vec()],
        reversed: false,
        label: String::new(),
    });
    crate::surface::sew(&mut brep, None, &Job::default()).unwrap();
    let (brep, surface) = laid(brep);
    assert_eq!((brep.faces.len(), surface.loops.len()), (3, 1));
    assert_eq!(brep.faces[1].loops[0].len(), 3);
    assert!(near(surface.area, 112.0) && near(length(&surface), 20.0), "{}", length(&surface));
}
