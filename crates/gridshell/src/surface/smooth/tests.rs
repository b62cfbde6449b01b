//! Meshes sampled from known surfaces come out near to these.

use super::*;
use crate::math::trig;
use crate::surface::Sampling;
use crate::surface::carrier::NONE;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

const SMOOTH: Smooth = Smooth {
    coarse: 0.05,
    chord_error: 1e-4,
    corner_angle: 30.0 * PI / 180.0,
    crease_angle: 40.0 * PI / 180.0,
};

fn mesh(points: Vec<DVec3>, faces: Vec<Vec<u32>>) -> PolygonMesh {
    PolygonMesh { name: "mesh".into(), points, faces, ..PolygonMesh::default() }
}

/// Quads of a grid of m by n cells over the unit square.
fn quads(m: u32, n: u32, place: impl Fn(f64, f64) -> DVec3) -> PolygonMesh {
    let at = |i: u32, j: u32| i * (n + 1) + j;
    let vertices = (0..=m).flat_map(|i| (0..=n).map(move |j| (i, j)));
    let points =
        vertices.map(|(i, j)| place(f64::from(i) / f64::from(m), f64::from(j) / f64::from(n)));
    let cells = (0..m).flat_map(|i| (0..n).map(move |j| (i, j)));
    let faces = cells.map(|(i, j)| vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
    mesh(points.collect(), faces.collect())
}

fn triangles(m: u32, n: u32, place: impl Fn(f64, f64) -> DVec3) -> PolygonMesh {
    let quads = quads(m, n, place);
    let halves = quads.faces.iter().flat_map(|f| [vec![f[0], f[1], f[2]], vec![f[0], f[2], f[3]]]);
    let faces = halves.collect();
    PolygonMesh { faces, ..quads }
}

/// An icosahedron, each face in four, on the unit sphere.
fn ball() -> PolygonMesh {
    let g = f64::midpoint(1.0, 5f64.sqrt());
    let mut points: Vec<DVec3> = Vec::new();
    for (a, b) in [(1.0, g), (1.0, -g), (-1.0, g), (-1.0, -g)] {
        points.extend([DVec3::new(0.0, a, b), DVec3::new(a, b, 0.0), DVec3::new(b, 0.0, a)]);
    }
    let mut faces: Vec<Vec<u32>> = Vec::new();
    let near = |a: usize, b: usize| points[a].distance(points[b]) < 2.1;
    for a in 0..12 {
        for b in a + 1..12 {
            for c in (b + 1..12).filter(|&c| near(a, b) && near(b, c) && near(a, c)) {
                let out = (points[b] - points[a]).cross(points[c] - points[a]).dot(points[a]) > 0.0;
                faces.push(if out {
                    vec![a as u32, b as u32, c as u32]
                } else {
                    vec![a as u32, c as u32, b as u32]
                });
            }
        }
    }
    let mut middles = std::collections::BTreeMap::new();
    let mut finer = Vec::new();
    for f in faces {
        let m = [0, 1, 2].map(|k| {
            let (a, b) = (f[k], f[(k + 1) % 3]);
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                points.push(points[a as usize] + points[b as usize]);
                points.len() as u32 - 1
            })
        });
        finer.extend([
            vec![f[0], m[0], m[2]],
            vec![m[0], f[1], m[1]],
            vec![m[1], f[2], m[2]],
            m.to_vec(),
        ]);
    }
    mesh(points.into_iter().map(DVec3::normalize).collect(), finer)
}

/// Largest distance, as `off` has it, of the mesh's faces and of the smoothed mesh.
fn errors(coarse: &PolygonMesh, off: impl Fn(DVec3) -> f64) -> [f64; 2] {
    let smooth = coarse.smoothed(&SMOOTH, &Job::default()).expect("smooth");
    assert_eq!(smooth.points[..coarse.points.len()], coarse.points, "it goes through the vertices");
    let shares: Vec<[f64; 3]> = (0..=6)
        .flat_map(|i| (0..=6 - i).map(move |j| [i, j, 6 - i - j].map(|w| f64::from(w) / 6.0)))
        .collect();
    [coarse, &smooth].map(|mesh| {
        let mut points = mesh.points.clone();
        let (triangles, _) = mesh.split(&mut points);
        let on = |t: &[u32; 3], w: &[f64; 3]| (0..3).map(|k| points[t[k] as usize] * w[k]).sum();
        let all = triangles.iter().flat_map(|t| shares.iter().map(move |w| (t, w)));
        all.map(|(t, w)| off(on(t, w))).fold(0.0, f64::max)
    })
}

/// The smoothed mesh is nearer to the surface that the mesh was taken from than its faces are, by this factor.
fn assert_nearer(factor: f64, coarse: &PolygonMesh, off: impl Fn(DVec3) -> f64) {
    let [faces, smooth] = errors(coarse, off);
    assert!(smooth * factor < faces, "{smooth} is not {factor} times less than {faces}");
}

fn polar(radius: f64, angle: f64) -> [f64; 2] {
    [radius * trig::cos(angle), radius * trig::sin(angle)]
}

/// A cap of the unit sphere: a pole, and rings of quads down to this angle.
fn dome(rings: u32, sides: u32, down_to: f64) -> PolygonMesh {
    let mut points = vec![DVec3::Z];
    let mut faces = Vec::new();
    for ring in 0..rings {
        let [z, r] = polar(1.0, down_to * f64::from(ring + 1) / f64::from(rings));
        for k in 0..sides {
            let [x, y] = polar(r, TAU * f64::from(k) / f64::from(sides));
            points.push(DVec3::new(x, y, z));
            let (a, b) = (1 + ring * sides + k, 1 + ring * sides + (k + 1) % sides);
            faces.push(if ring == 0 { vec![0, a, b] } else { vec![a - sides, a, b, b - sides] });
        }
    }
    mesh(points, faces)
}

#[test]
fn coarse_spheres_cylinders_and_saddles_come_out_as_such() {
    assert_nearer(500.0, &ball(), |p| (p.length() - 1.0).abs());
    let half_pipe = |s: f64, t: f64| {
        let [x, z] = polar(1.0, PI * s);
        DVec3::new(x, 2.0 * t, z)
    };
    let off = |p: DVec3| (p.x.hypot(p.z) - 1.0).abs();
    assert_nearer(40.0, &quads(8, 5, half_pipe), off);
    assert_nearer(40.0, &triangles(8, 5, half_pipe), off);
    let height = |x: f64, y: f64| 0.25 * (x * x - y * y);
    let saddle = |s: f64, t: f64| {
        let (x, y) = (2.0 * s - 1.0, 2.0 * t - 1.0);
        DVec3::new(x, y, height(x, y))
    };
    let off = |p: DVec3| (p.z - height(p.x, p.y)).abs();
    assert_nearer(12.0, &quads(8, 8, saddle), off);
    assert_nearer(12.0, &triangles(8, 8, saddle), off);
    let twisted = |s: f64, t: f64| DVec3::new(s, t, s * t);
    assert_nearer(10.0, &quads(6, 6, twisted), |p| (p.z - p.x * p.y).abs());
}

#[test]
fn the_rim_of_a_dome_of_sixteen_sides_is_a_circle() {
    let dome = dome(4, 16, 1.2);
    assert_nearer(50.0, &dome, |p| (p.length() - 1.0).abs());
    let sampling = Sampling { max_edge: 9.0, chord_error: 1.0, corner_angle: SMOOTH.corner_angle };
    let surface = dome
        .smoothed(&SMOOTH, &Job::default())
        .unwrap()
        .surface(&sampling, &Job::default())
        .unwrap();
    assert_eq!((surface.loops.len(), surface.euler_characteristic()), (1, 1));
    let rim = &surface.loops[0];
    assert!(rim.corners.is_empty());
    let [z, r] = polar(1.0, 1.2);
    for &v in &rim.vertices {
        let p = surface.carrier.points[v as usize];
        assert!((p.z - z).abs() < 1e-5 && (p.x.hypot(p.y) - r).abs() < 1e-5, "{p}");
    }
}

#[test]
fn uneven_meshes_do_not_overshoot() {
    // Rows get narrower twentyfold and wide again along an arch.
    let warp = |s: f64| s - 0.95 * trig::sin(TAU * s) / TAU;
    let arch = |s: f64, t: f64| {
        let [x, z] = polar(1.0, PI * warp(s));
        DVec3::new(x, 2.0 * t * t, z)
    };
    assert_nearer(20.0, &quads(12, 5, arch), |p| (p.x.hypot(p.z) - 1.0).abs());
    assert_nearer(20.0, &triangles(12, 5, arch), |p| (p.x.hypot(p.z) - 1.0).abs());
}

#[test]
fn planes_stay_plane_and_creases_sharp() {
    // A gable roof with a ridge of sixty degrees: nothing bends.
    let gable = quads(4, 3, |s, t| DVec3::new(s, t, 0.577 * (0.5 - (s - 0.5).abs())));
    let smooth = gable.smoothed(&SMOOTH, &Job::default()).unwrap();
    assert!(smooth.smoothing.unwrap().departure < 1e-12);
    assert_eq!(smooth.faces.len(), 2 * gable.faces.len());
    // Below the crease angle the same roof is rounded, but only beside its ridge.
    let round = quads(8, 3, |s, t| DVec3::new(s, t, 0.2 * (0.5 - (s - 0.5).abs())));
    let smooth = round.smoothed(&SMOOTH, &Job::default()).unwrap();
    let off = |p: &DVec3| (p.z - 0.2 * (0.5 - (p.x - 0.5).abs())).abs();
    assert!(smooth.smoothing.unwrap().departure > 1e-3);
    assert!(smooth.points.iter().all(|p| off(p) < 1e-9 || (p.x - 0.5).abs() <= 0.25 + 1e-9));
}

#[test]
fn patches_meet_with_one_tangent_plane() {
    let wave = |s: f64, t: f64| {
        DVec3::new(s, t + 0.1 * s * t, 0.1 * trig::sin(5.0 * s) * trig::cos(4.0 * t))
    };
    let web = Web::of(&triangles(5, 4, wave), &SMOOTH);
    // Normal of the patch over a triangle, a hair beside the point at `s` of its side from corner k on.
    let normal = |t: u32, k: usize, s: f64| {
        let at = |s: f64, inside: f64| {
            let mut bary = [inside; 3];
            (bary[k], bary[(k + 1) % 3]) = ((1.0 - s) * (1.0 - inside), s * (1.0 - inside));
            web.patch(t).point(bary)
        };
        let here = at(s, 0.0);
        (at(s + 1e-6, 0.0) - here).cross(at(s, 1e-6) - here).normalize()
    };
    for (t, across) in web.net.neighbors.iter().enumerate() {
        for k in (0..3).filter(|&k| across[k] != NONE) {
            let u = across[k] as usize;
            let back = web.net.neighbors[u].iter().position(|&n| n == t as u32).unwrap();
            for s in [0.03, 0.2, 0.5, 0.9] {
                let turn = trig::angle(normal(t as u32, k, s), normal(u as u32, back, 1.0 - s));
                assert!(turn < 1e-4, "{turn}");
            }
        }
    }
}

#[test]
fn faces_finer_than_wanted_stay_as_they_are() {
    let dome = dome(4, 16, 1.2);
    let fine = dome.smoothed(&Smooth { coarse: 2.0, ..SMOOTH }, &Job::default()).unwrap();
    assert_eq!((fine.points, fine.smoothing.unwrap().departure), (dome.points.clone(), 0.0));
    // The rings near the pole are narrow: only those below are divided, and what touches them.
    let some = dome.smoothed(&Smooth { coarse: 0.31, ..SMOOTH }, &Job::default()).unwrap();
    let all = dome.smoothed(&SMOOTH, &Job::default()).unwrap();
    assert!(some.faces.len() < all.faces.len() && some.points.len() > dome.points.len());
}

#[test]
fn honeycombs_are_smoothed_too() {
    // Hexagons on a paraboloid, none of them plane.
    let (mut points, mut faces): (Vec<DVec3>, Vec<Vec<u32>>) = (Vec::new(), Vec::new());
    for row in 0..5 {
        for column in 0..5 {
            let centre = (
                f64::from(column) + 0.5 * f64::from(row % 2),
                0.75 * f64::from(row) * 2.0 / 3f64.sqrt(),
            );
            let face = (0..6).map(|k| {
                let [x, y] = polar(1.0 / 3f64.sqrt(), PI * (f64::from(k) / 3.0 + 1.0 / 6.0));
                let (x, y) = (x + centre.0 - 2.5, y + centre.1 - 1.7);
                let p = DVec3::new(x, y, -0.05 * (x * x + y * y));
                points.iter().position(|q| q.distance(p) < 1e-6).unwrap_or_else(|| {
                    points.push(p);
                    points.len() - 1
                }) as u32
            });
            faces.push(face.collect());
        }
    }
    let rounded = Smooth { corner_angle: 2.0, ..SMOOTH };
    let smooth = mesh(points.clone(), faces.clone()).smoothed(&rounded, &Job::default()).unwrap();
    let off = |p: &DVec3| (p.z + 0.05 * (p.x * p.x + p.y * p.y)).abs();
    let worst =
        smooth.points.iter().filter(|p| p.truncate().length() < 1.2).map(off).fold(0.0, f64::max);
    // Faces leave it by 0.05 / 3.
    assert!(worst < 0.05 / 30.0, "{worst}");
}
