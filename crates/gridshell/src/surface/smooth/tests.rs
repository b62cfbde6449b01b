//! Meshes sampled from known surfaces come out near to these.

use super::*;
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

/// Largest distance, as `off` has it, over the faces of the mesh each in many points, and of the smoothed mesh.
fn errors(coarse: &PolygonMesh, off: impl Fn(DVec3) -> f64) -> (f64, f64) {
    let smooth = coarse.smoothed(&SMOOTH).expect("smooth");
    for (k, p) in coarse.points.iter().enumerate() {
        assert_eq!(smooth.points[k], *p, "the surface goes through the vertices");
    }
    let worst = |mesh: &PolygonMesh| {
        let mut points = mesh.points.clone();
        let (triangles, _) = mesh.split(&mut points);
        let weights = (0..=6)
            .flat_map(|i| (0..=6 - i).map(move |j| [i, j, 6 - i - j].map(|w| f64::from(w) / 6.0)));
        let weights: Vec<_> = weights.collect();
        triangles
            .iter()
            .flat_map(|t| {
                weights.iter().map(|w| (0..3).map(|k| points[t[k] as usize] * w[k]).sum())
            })
            .map(&off)
            .fold(0.0, f64::max)
    };
    let at = smooth.points.iter().copied().max_by(|a, b| off(*a).total_cmp(&off(*b))).unwrap();
    println!("worst at {at:.3}");
    (worst(coarse), worst(&smooth))
}

#[test]
fn a_measure() {
    let show = |name: &str, (a, b): (f64, f64)| println!("{name:20} {a:.5} {b:.6} {:.1}", a / b);
    show("ball", errors(&ball(), |p| (p.length() - 1.0).abs()));
    let cyl = |s: f64, t: f64| {
        let a = PI * s;
        DVec3::new(a.cos(), 2.0 * t, a.sin())
    };
    let off = |p: DVec3| (p.x.hypot(p.z) - 1.0).abs();
    show("cylinder quads", errors(&quads(8, 5, cyl), off));
    show("cylinder tri", errors(&triangles(8, 5, cyl), off));
    let saddle = |s: f64, t: f64| {
        let (x, y) = (2.0 * s - 1.0, 2.0 * t - 1.0);
        DVec3::new(x, y, 0.25 * (x * x - y * y))
    };
    let off = |p: DVec3| {
        let g = (1.0 + 0.25 * (p.x * p.x + p.y * p.y)).sqrt();
        (p.z - 0.25 * (p.x * p.x - p.y * p.y)).abs() / g
    };
    show("saddle quads", errors(&quads(8, 8, saddle), off));
    show("saddle tri", errors(&triangles(8, 8, saddle), off));
    let hypar = |s: f64, t: f64| {
        let (x, y) = (2.0 * s - 1.0, 2.0 * t - 1.0);
        DVec3::new(x, y, x * y)
    };
    let off = |p: DVec3| (p.z - p.x * p.y).abs() / (1.0 + p.x * p.x + p.y * p.y).sqrt();
    show("hypar quads", errors(&quads(6, 6, hypar), off));
    show("hypar tri", errors(&triangles(6, 6, hypar), off));
    let wave = |s: f64, t: f64| {
        let (x, y) = (4.0 * s + 0.3 * (7.0 * t).sin() * s * (1.0 - s), 4.0 * t);
        DVec3::new(x, y, 0.3 * x.sin() * (y + 0.5).cos())
    };
    let off = |p: DVec3| (p.z - 0.3 * p.x.sin() * (p.y + 0.5).cos()).abs();
    show("wave quads", errors(&quads(12, 12, wave), off));
    show("wave tri", errors(&triangles(12, 12, wave), off));
    // A dome: a pole and rings, uneven.
    let mut points = vec![DVec3::Z];
    let mut faces = Vec::new();
    for r in 1..=4u32 {
        for k in 0..16u32 {
            let (lat, lon) = (f64::from(r) / 4.0 * 1.2, TAU * f64::from(k) / 16.0);
            points.push(DVec3::new(lat.sin() * lon.cos(), lat.sin() * lon.sin(), lat.cos()));
            let (a, b) = (1 + (r - 1) * 16 + k, 1 + (r - 1) * 16 + (k + 1) % 16);
            if r == 1 {
                faces.push(vec![0, a, b]);
            } else {
                faces.push(vec![a - 16, a, b, b - 16]);
            }
        }
    }
    let dome = mesh(points, faces);
    show("dome", errors(&dome, |p| (p.length() - 1.0).abs()));
    let smooth = dome.smoothed(&SMOOTH).unwrap();
    let rim: Vec<DVec3> = smooth.points.iter().copied().filter(|p| (p.z - 1.2f64.cos()).abs() < 0.02).collect();
    let _ = rim;
}
