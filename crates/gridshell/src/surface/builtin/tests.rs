//! The built-in B-reps are consistent: edges end in their vertices, lie on their faces, and run round them
//! with the surface to the left.

use super::*;
use crate::surface::brep::{BrepEdge, BrepFace, Coedge};
use crate::surface::{Sampling, Shape, Surface};
use glam::{DVec2, DVec3};

fn breps() -> impl Iterator<Item = Brep> {
    ALL.iter().map(|b| (b.build)())
}

/// Points along an edge, as a loop uses it.
fn sample(edge: &BrepEdge, coedge: Coedge) -> Vec<DVec3> {
    let [a, b] = edge.range;
    let at = |k: i32| edge.curve.point(a + (b - a) * f64::from(k) / 24.0);
    let points: Vec<DVec3> = (0..=24).map(at).collect();
    if coedge.reversed { points.into_iter().rev().collect() } else { points }
}

/// The parameters of the point of a patch nearest to `p`, by Gauss and Newton from the nearest of a raster.
fn locate(shape: &Shape, p: DVec3) -> DVec2 {
    let Shape::Nurbs(patch) = shape else { return p.truncate() };
    let range = [0, 1].map(|k| [patch.knots[k][patch.degree[k]], patch.knots[k][patch.count[k]]]);
    let at = |k: usize, i: i32| range[k][0] + (range[k][1] - range[k][0]) * f64::from(i) / 32.0;
    let raster = (0..33 * 33).map(|i| DVec2::new(at(0, i / 33), at(1, i % 33)));
    let mut uv = raster
        .min_by(|a, b| shape.point(*a).distance(p).total_cmp(&shape.point(*b).distance(p)))
        .expect("a raster");
    for _ in 0..50 {
        let j = shape.jet(uv);
        let d = p - j.point;
        let (e, f, g) = (j.du.dot(j.du), j.du.dot(j.dv), j.dv.dot(j.dv));
        let (r, s) = (d.dot(j.du), d.dot(j.dv));
        uv += DVec2::new(g * r - f * s, e * s - f * r) / (e * g - f * f);
        uv = uv.clamp(DVec2::new(range[0][0], range[1][0]), DVec2::new(range[0][1], range[1][1]));
    }
    uv
}

#[test]
fn edges_end_in_their_vertices_and_loops_close() {
    for brep in breps() {
        for edge in &brep.edges {
            for k in 0..2 {
                let gap =
                    edge.curve.point(edge.range[k]).distance(brep.vertices[edge.ends[k] as usize]);
                assert!(gap < 1e-12 * 1e3, "{}: {gap}", brep.name);
            }
        }
        for outline in brep.faces.iter().flat_map(|f| &f.loops) {
            let end = |c: &Coedge, k: usize| {
                brep.edges[c.edge as usize].ends[k ^ usize::from(c.reversed)]
            };
            for (k, c) in outline.iter().enumerate() {
                assert_eq!(end(c, 1), end(&outline[(k + 1) % outline.len()], 0), "{}", brep.name);
            }
        }
    }
}

#[test]
fn every_edge_bounds_one_face_or_two_in_opposite_directions() {
    for brep in breps() {
        let mut uses = vec![Vec::new(); brep.edges.len()];
        for c in brep.faces.iter().flat_map(|f| &f.loops).flatten() {
            uses[c.edge as usize].push(c.reversed);
        }
        let closed = matches!(brep.name.as_str(), "torus" | "sphere");
        for mut u in uses {
            u.sort_unstable();
            assert!(u == [false, true] || (!closed && u.len() == 1), "{}: {u:?}", brep.name);
        }
    }
}

#[test]
fn edges_lie_on_their_faces_with_the_surface_to_the_left() {
    for brep in breps() {
        for face in &brep.faces {
            let areas: Vec<f64> = face.loops.iter().map(|l| signed_area(&brep, face, l)).collect();
            assert!(
                areas[0] > 0.0 && areas[1..].iter().all(|&a| a < 0.0),
                "{}: {areas:?}",
                brep.name
            );
        }
    }
}

/// Area inside a loop in the face's parameters; negative where the loop runs clockwise.
fn signed_area(brep: &Brep, face: &BrepFace, outline: &[Coedge]) -> f64 {
    let mut uv: Vec<DVec2> = Vec::new();
    for c in outline {
        for p in sample(&brep.edges[c.edge as usize], *c) {
            let at = locate(&face.shape, p);
            let gap = face.shape.point(at).distance(p);
            assert!(gap < 1e-9, "{}: {gap} at {p}", brep.name);
            uv.push(at);
        }
    }
    (0..uv.len()).map(|k| uv[k].perp_dot(uv[(k + 1) % uv.len()]) / 2.0).sum()
}

#[test]
fn outsides_point_up_and_closed_ones_outwards() {
    for brep in breps() {
        for face in &brep.faces {
            let edge = &brep.edges[face.loops[0][0].edge as usize];
            let p = edge.curve.point(edge.range[0] * 0.6 + edge.range[1] * 0.4);
            let j = face.shape.jet(locate(&face.shape, p));
            let outside = j.du.cross(j.dv);
            let wanted = match brep.name.as_str() {
                "sphere" | "dome" => p,
                // Away from the circle in the middle of the tube.
                "torus" => p - DVec3::new(p.x, p.y, 0.0).normalize() * 10.0,
                _ => DVec3::Z,
            };
            assert!(outside.dot(wanted) > 0.0, "{}", brep.name);
        }
    }
}

/// Vertices less edges plus triangles of the carrier.
fn euler_characteristic(surface: &Surface) -> i64 {
    let count = |n: usize| i64::try_from(n).expect("a count");
    let triangles = surface.carrier.triangles.len();
    let rim: usize = surface.loops.iter().map(|l| l.segments.len()).sum();
    // Every edge has two sides, those on a loop one.
    let sides = 3 * triangles + rim;
    count(surface.carrier.points.len()) - count(sides / 2) + count(triangles)
}

#[test]
fn areas_loops_and_corners_are_those_worked_out_by_hand() {
    // Great Court: measured on an independent NURBS model of the same function. Barrel: arc times length,
    // 30 x 2 R asin(10 / R) with R = 34 / 3. Saddle, roof and facade: checked below.
    let barrel = 734.9705203679945;
    let pi = std::f64::consts::PI;
    let table: [(&str, Option<f64>, &[usize], i64); 9] = [
        ("great-court", Some(6180.254), &[4, 0], 0),
        ("hexagon", Some(24.0 * 3.0_f64.sqrt()), &[6], 1),
        ("dome", Some(200.0 * pi), &[0], 1),
        ("saddle", Some(saddle_area()), &[4, 0], 0),
        ("barrel", Some(barrel), &[4], 1),
        ("torus", Some(160.0 * pi * pi), &[], 0),
        ("sphere", Some(400.0 * pi), &[], 2),
        ("roof", None, &[2, 0, 0], -1),
        ("facade", None, &[4], 1),
    ];
    for (builtin, (name, area, corners, euler)) in ALL.iter().zip(table) {
        let l0 = builtin.edge_length;
        let sampling = Sampling { max_edge: 0.7 * l0, chord_error: 0.02 * l0, corner_angle: 0.5 };
        let surface = model(name).expect("built in").surface(&sampling).expect("a surface");
        assert_eq!(builtin.name, name);
        assert_eq!(
            surface.loops.iter().map(|l| l.corners.len()).collect::<Vec<_>>(),
            corners,
            "{name}"
        );
        assert_eq!(euler_characteristic(&surface), euler, "{name}");
        if let Some(area) = area {
            assert!((surface.area / area - 1.0).abs() < 1e-5, "{name}: {} {area}", surface.area);
        }
        for (p, n) in surface.carrier.points.iter().zip(&surface.carrier.normals) {
            assert!(p.is_finite() && n.is_normalized(), "{name}: {p} {n}");
        }
    }
}

/// The integral of sqrt(1 + |gradient|^2) over the square less that over the disc, by Simpson's rule.
fn saddle_area() -> f64 {
    let stretch = |x: f64, y: f64| (1.0 + (x * x + y * y) / 900.0).sqrt();
    let simpson = |a: f64, b: f64, f: &dyn Fn(f64) -> f64| {
        let (n, h) = (64, (b - a) / 64.0);
        let weight = |k: i32| if k == 0 || k == n { 1.0 } else { 2.0 + 2.0 * f64::from(k % 2) };
        (0..=n).map(|k| weight(k) * f(a + h * f64::from(k))).sum::<f64>() * h / 3.0
    };
    let square = simpson(-15.0, 15.0, &|x| simpson(-15.0, 15.0, &|y| stretch(x, y)));
    let disc = simpson(0.0, 4.5, &|r| {
        let ring = simpson(0.0, std::f64::consts::TAU, &|a| {
            stretch(-4.0 + r * crate::math::trig::cos(a), 2.5 + r * crate::math::trig::sin(a))
        });
        r * ring
    });
    square - disc
}

#[test]
fn roof_and_facade_have_the_size_they_say() {
    for (name, size) in [("roof", [78.0, 39.0, 12.0]), ("facade", [650.0, 240.0, 33.0])] {
        let sampling = Sampling { max_edge: size[0] / 100.0, chord_error: 0.1, corner_angle: 0.5 };
        let surface = model(name).expect("built in").surface(&sampling).expect("a surface");
        let points = &surface.carrier.points;
        let (low, high) =
            points.iter().fold((points[0], points[0]), |(l, h), &p| (l.min(p), h.max(p)));
        for (k, wanted) in size.into_iter().enumerate() {
            assert!(((high - low)[k] / wanted - 1.0).abs() < 0.02, "{name}: {}", high - low);
        }
    }
}
