//! Triangulation ends, on whatever carrier: work per vertex is counted and held against that of a smooth roof.

use super::intrinsic::{Intrinsic, Work};
use super::{LOOKS_TO_CONNECT, LOOKS_TO_REMOVE};
use crate::job::Job;
use crate::mesh::Mesh;
use glam::{DVec2, DVec3, dvec2, dvec3};
use std::f64::consts::{PI, TAU};

/// A carrier for these tests.
struct Carrier {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

/// `n` times `m` squares over the unit square, each cut in two, laid by `f`.
fn lattice(n: u32, m: u32, f: impl Fn(DVec2) -> DVec3) -> Carrier {
    let at = |i: u32, j: u32| dvec2(f64::from(i) / f64::from(n), f64::from(j) / f64::from(m));
    let points = (0..=m).flat_map(|j| (0..=n).map(move |i| (i, j))).map(|(i, j)| f(at(i, j)));
    let corner = |i: u32, j: u32| j * (n + 1) + i;
    let squares = (0..m).flat_map(|j| (0..n).map(move |i| (i, j)));
    let halves = squares.flat_map(|(i, j)| {
        let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    Carrier { points: points.collect(), triangles: halves.collect() }
}

/// `m` rings of `n` vertices round a tip, with these radii and heights.
fn horn(n: u32, m: u32, ring: impl Fn(f64) -> [f64; 2]) -> Carrier {
    let mut points = vec![DVec3::ZERO];
    let mut triangles = Vec::new();
    for j in 0..m {
        let [radius, height] = ring(f64::from(j + 1) / f64::from(m));
        for i in 0..n {
            let angle = TAU * f64::from(i) / f64::from(n);
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            points.push(dvec3(radius * cos, radius * sin, height));
            let [a, b] = [i, (i + 1) % n].map(|i| 1 + j * n + i);
            match j {
                0 => triangles.push([0, a, b]),
                _ => triangles.extend([[a - n, a, b], [a - n, b, b - n]]),
            }
        }
    }
    Carrier { points, triangles }
}

/// A number in 0..1 that hangs on `i` only.
fn noise(i: usize) -> f64 {
    fastrand::Rng::with_seed(i as u64 + 1).f64()
}

/// What connecting took, and how many vertices stayed that were to go: a tenth of the carrier's vertices are
/// nodes, and one in every twentieth triangle, some of them right beside an edge.
fn connect(carrier: &Carrier) -> (Work, usize) {
    let mesh = Mesh::from_triangles(carrier.points.len(), &carrier.triangles).expect("a manifold");
    let euler = mesh.euler_characteristic();
    let mut tri = Intrinsic::new(mesh, &carrier.points);
    let mut node: Vec<bool> = (0..carrier.points.len()).map(|v| noise(v) < 0.1).collect();
    for rim in tri.mesh.boundary_loops() {
        for (k, &v) in rim.iter().enumerate() {
            node[v as usize] = k % 5 == 0;
        }
    }
    let strays: Vec<u32> = tri.mesh.vertices().filter(|&v| !node[v as usize]).collect();
    for (i, &corners) in carrier.triangles.iter().enumerate().step_by(20) {
        let mut bary = [0, 1, 2].map(|k| noise(3 * i + k) + 1e-5);
        bary[i / 20 % 3] *= [1.0, 1e-5][i / 20 % 2];
        let p = corners.map(|v| carrier.points[v as usize]);
        let sum: f64 = bary.iter().sum();
        let at = (p[0] * bary[0] + p[1] * bary[1] + p[2] * bary[2]) / sum;
        tri.insert(corners, p.map(|p| p.distance(at)));
    }
    tri.complete();
    let vertices = tri.work.vertices;
    tri.make_delaunay(LOOKS_TO_CONNECT * vertices, &Job::default());
    let kept = tri.remove_all(strays, LOOKS_TO_REMOVE * vertices, &Job::default());
    tri.mesh.check().expect("a valid mesh");
    assert_eq!(tri.mesh.euler_characteristic(), euler);
    (tri.work, kept.len())
}

fn smooth() -> Carrier {
    lattice(60, 60, |p| dvec3(10.0 * p.x, 10.0 * p.y, 4.0 * p.x * (1.0 - p.x) + p.y * p.y))
}

/// Carriers of the kinds that made triangulating all but endless.
fn awkward() -> Vec<(&'static str, Carrier)> {
    let tooth = |x: f64| (x - libm::floor(x) - 0.5).abs();
    let bent = |p: DVec2, turn: f64, inner: f64| {
        let (angle, r) = (turn * p.x, inner + p.y);
        dvec3(r * libm::cos(angle), -r * libm::sin(angle), 0.0)
    };
    vec![
        ("needles", lattice(400, 8, |p| dvec3(p.x, 8.0 * p.y, 0.0))),
        ("needles leaning", lattice(200, 20, |p| dvec3(p.x + 7.0 * p.y, 3.0 * p.y, 0.1 * p.x))),
        (
            "slivers",
            lattice(60, 60, |p| {
                let j = libm::round(60.0 * p.y);
                let row = libm::floor(j / 3.0) + [0.0, 1e-9, 0.5][j as usize % 3];
                dvec3(6.0 * p.x, 0.3 * row, 0.0)
            }),
        ),
        (
            "rows that coincide",
            lattice(60, 60, |p| dvec3(6.0 * p.x, 0.1 * libm::floor(30.0 * p.y), 0.0)),
        ),
        (
            "collinear triangles",
            lattice(50, 50, |p| {
                let (i, j) = (libm::round(50.0 * p.x), libm::round(50.0 * p.y));
                let down = if i as u64 % 5 == 2 { 1.0 - 1e-13 } else { 0.0 };
                dvec3(i, j - down, 0.0)
            }),
        ),
        ("horn", horn(24, 120, |t| [0.05 * t, 3.0 * t])),
        ("cusp of revolution", horn(24, 120, |t| [t * t * t, 3.0 * t])),
        ("trumpet", horn(24, 120, |t| [0.02 + t * t, 3.0 * (1.0 - t) * (1.0 - t)])),
        ("hub", horn(1500, 3, |t| [10.0 * t, t * t])),
        ("border horn", lattice(20, 150, |p| dvec3(p.x * p.y * p.y * p.y, 5.0 * p.y, 0.0))),
        ("borders that touch", lattice(200, 15, |p| bent(p, TAU, 1.0))),
        ("borders that overlap", lattice(200, 15, |p| bent(p, 1.7 * TAU, 0.05))),
        (
            "neck",
            lattice(40, 80, |p| dvec3((p.x - 0.5) * ((p.y - 0.5).abs() + 1e-9), 2.0 * p.y, 0.0)),
        ),
        (
            "gable across the lattice",
            lattice(60, 60, |p| dvec3(p.x, p.y, 2.0 * (p.x + 0.3 * p.y - 0.6).abs())),
        ),
        (
            "gull wing",
            lattice(80, 40, |p| dvec3(p.x, p.y, 3.0 * (tooth(1.3 * p.x + 0.2 * p.y)).powi(2))),
        ),
        (
            "folded plate",
            lattice(80, 40, |p| dvec3(4.0 * p.x, 2.0 * p.y, 3.0 * tooth(7.3 * p.x + 0.9 * p.y))),
        ),
        (
            "dense net",
            lattice(400, 10, |p| dvec3(40.0 * p.x, 5.0 * p.y, libm::sin(400.0 * PI * p.x * 0.97))),
        ),
        (
            "crumpled",
            lattice(60, 60, |p| {
                let i = (61.0 * libm::round(60.0 * p.y) + libm::round(60.0 * p.x)) as usize;
                dvec3(6.0 * p.x, 6.0 * p.y, 2.0 * noise(i))
            }),
        ),
        (
            "far from the origin",
            lattice(60, 60, |p| dvec3(5e8 + 1e-4 * p.x, 4e9 + 1e-4 * p.y, 0.0)),
        ),
    ]
}

/// Looks and flips to each vertex.
fn cost(work: Work) -> f64 {
    (work.looks + work.flips) as f64 / work.vertices as f64
}

/// What is wrong with connecting on this carrier, if a smooth roof costs `usual`.
fn fault(name: &str, carrier: &Carrier, usual: f64) -> Option<String> {
    let (work, kept) = connect(carrier);
    let share = cost(work) / usual;
    let well = share <= 2.0 && kept == 0 && !work.cut_short;
    (!well).then(|| format!("{name}: {share:.2} times the cost, {kept} vertices left, {work:?}"))
}

#[test]
fn awkward_carriers_cost_at_most_twice_what_a_smooth_roof_costs() {
    let (work, kept) = connect(&smooth());
    assert_eq!((kept, work.cut_short), (0, false));
    let faults: Vec<String> =
        awkward().iter().filter_map(|(name, c)| fault(name, c, cost(work))).collect();
    assert!(faults.is_empty(), "{faults:#?}");
}

/// Heights of any size, squares of any aspect, corners that fall together.
#[test]
fn random_carriers_cost_at_most_twice_what_a_smooth_roof_costs() {
    let usual = cost(connect(&smooth()).0);
    let random = |seed: u64| {
        let mut rng = fastrand::Rng::with_seed(seed);
        let power = |rng: &mut fastrand::Rng, least: f64| libm::exp(least * rng.f64());
        let (rise, width) = (0.3 * power(&mut rng, -9.0), power(&mut rng, -4.0));
        let twins = 0.05 * rng.f64();
        let mut carrier = lattice(40, 40, |p| dvec3(width * p.x, p.y, 0.0));
        for v in 0..carrier.points.len() {
            carrier.points[v].z = rise * rng.f64();
            if v > 0 && rng.f64() < twins {
                carrier.points[v] = carrier.points[v - 1];
            }
        }
        carrier
    };
    let faults: Vec<String> =
        (0..60).filter_map(|k| fault(&format!("seed {k}"), &random(k), usual)).collect();
    assert!(faults.is_empty(), "{faults:#?}");
}

#[test]
fn a_bound_that_is_reached_is_told_and_leaves_a_mesh() {
    let carrier = smooth();
    let mesh = Mesh::from_triangles(carrier.points.len(), &carrier.triangles).expect("a manifold");
    let mut tri = Intrinsic::new(mesh, &carrier.points);
    tri.complete();
    tri.make_delaunay(100, &Job::default());
    assert!(tri.work.cut_short && tri.work.looks == 100);
    let strays: Vec<u32> = tri.mesh.vertices().filter(|v| v % 7 > 0).collect();
    let left = tri.remove_all(strays.clone(), 500, &Job::default()).len();
    assert!(left > 0 && left < strays.len() && tri.work.looks < 700, "{left} {:?}", tri.work);
    tri.mesh.check().expect("a valid mesh");
}
