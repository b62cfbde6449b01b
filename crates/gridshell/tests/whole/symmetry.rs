//! Grids as symmetric as their surface.

use crate::promise::{check, model};
use gridshell::job::Job;
use gridshell::recipe::{Recipe, Symmetry};
use gridshell::run::Run;
use gridshell::surface::{Group, Model, Motion, PolygonMesh};
use gridshell::{DVec2, DVec3, pipeline};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

/// Images of nodes are this near to nodes, metres over the size.
const EXACT: f64 = 1e-9;

fn quick(symmetry: Symmetry, edge_length: f64) -> Recipe {
    let mut recipe = Recipe { symmetry, edge_length: Some(edge_length), ..Recipe::default() };
    recipe.pack.draws = 8;
    recipe.regularize.candidates = 2;
    recipe.regularize.trials = 500;
    recipe.regularize.heats = vec![[1, 10]];
    recipe
}

/// A run that keeps all promises and is the same under `motions`.
fn symmetric(model: &Model, recipe: &Recipe, motions: &[Motion]) -> Run {
    symmetric_within(model, recipe, motions, EXACT * model.size())
}

/// The same where images of nodes are this near to nodes, metres.
fn symmetric_within(model: &Model, recipe: &Recipe, motions: &[Motion], close: f64) -> Run {
    let run = pipeline::generate(model, recipe, &Job::default()).unwrap();
    check(model, &run);
    for stage in &run.stages {
        let grid = stage.grid.as_ref().unwrap();
        let edges: BTreeSet<(u32, u32)> =
            grid.mesh.edges().map(|(a, b)| (a.min(b), a.max(b))).collect();
        for motion in motions {
            let images: Vec<u32> =
                grid.xyz.iter().map(|&p| nearest(&grid.xyz, motion.image(p), close)).collect();
            let all: BTreeMap<u32, usize> =
                images.iter().enumerate().map(|(v, &w)| (w, v)).collect();
            assert_eq!(all.len(), images.len(), "{}: two nodes have the same image", stage.name);
            for &(a, b) in &edges {
                let (c, d) = (images[a as usize], images[b as usize]);
                assert!(
                    edges.contains(&(c.min(d), c.max(d))),
                    "{}: no image of member {a} {b}",
                    stage.name
                );
            }
        }
    }
    run
}

fn nearest(xyz: &[DVec3], p: DVec3, close: f64) -> u32 {
    let off = |&v: &usize| xyz[v].distance(p);
    let v = (0..xyz.len()).min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
    assert!(off(&v) <= close, "no node at {p}, the image of one: {:e} m off", off(&v));
    v as u32
}

fn mirror_x() -> Motion {
    Motion::mirroring(DVec2::ZERO, DVec2::Y)
}

fn mirror_y() -> Motion {
    Motion::mirroring(DVec2::ZERO, DVec2::X)
}

fn turn(n: u32) -> Motion {
    Motion::turn(DVec2::ZERO, 1, n)
}

#[test]
fn the_great_court_is_mirrored_at_x() {
    let run = symmetric(&model("great-court"), &quick(Symmetry::X, 5.0), &[mirror_x()]);
    let told = run.symmetry.unwrap();
    assert_eq!((told.rotations, told.mirrors.len()), (1, 1));
    assert!(told.mirrors[0][0].abs() == 1.0 && told.centre[0].abs() < 1e-9);
}

#[test]
fn a_symmetry_that_is_not_there_is_refused_with_the_place() {
    for (name, symmetry) in [
        ("great-court", Symmetry::Y),
        ("great-court", Symmetry::Turns(2)),
        ("saddle", Symmetry::Xy),
        ("barrel", Symmetry::Turns(3)),
    ] {
        let refused = pipeline::generate(&model(name), &quick(symmetry, 5.0), &Job::default());
        let told = refused.map(|_| ()).unwrap_err().to_string();
        assert!(told.contains("m off it") && told.contains("the image ("), "{name}: {told}");
    }
}

#[test]
fn a_dome_takes_any_number_of_turns() {
    for n in [2, 3, 5, 6] {
        symmetric(&model("dome"), &quick(Symmetry::Turns(n), 2.0), &[turn(n)]);
    }
}

#[test]
fn a_barrel_has_two_mirror_planes() {
    for symmetry in [Symmetry::Xy, Symmetry::Auto] {
        let motions = [mirror_x(), mirror_y(), turn(2)];
        let run = symmetric(&model("barrel"), &quick(symmetry, 2.0), &motions);
        assert_eq!(run.symmetry.unwrap().mirrors.len(), 2);
    }
    symmetric(&model("barrel"), &quick(Symmetry::Y, 2.0), &[mirror_y()]);
}

#[test]
fn a_hexagon_has_six_turns_and_the_perfect_lattice() {
    let mut recipe = quick(Symmetry::Auto, 1.0);
    recipe.pack.draws = 24;
    recipe.regularize = Recipe::default().regularize;
    let run = symmetric(&model("hexagon"), &recipe, &[turn(6)]);
    assert_eq!((run.quality.nodes, run.quality.fluency), (61, None));
}

#[test]
fn a_surface_with_a_hole_is_turned_about_it() {
    let motions = [turn(6), mirror_x(), mirror_y()];
    symmetric(&model("cone"), &quick(Symmetry::Turns(6), 2.5), &motions);
}

#[test]
fn a_closed_surface_is_cut_too() {
    symmetric(&model("sphere"), &quick(Symmetry::Turns(5), 3.0), &[turn(5)]);
    symmetric(&model("torus"), &quick(Symmetry::X, 2.5), &[mirror_x()]);
}

/// A ridge over a rectangle away from the origin, its crease along x.
fn ridge() -> Model {
    let points =
        [[3., 1., 0.], [13., 1., 0.], [13., 5., 4.], [3., 5., 4.], [13., 9., 0.], [3., 9., 0.]];
    Model::Mesh(PolygonMesh {
        name: "ridge".into(),
        points: points.map(DVec3::from_array).to_vec(),
        faces: vec![vec![0, 1, 2, 3], vec![3, 2, 4, 5]],
        ..PolygonMesh::default()
    })
}

#[test]
fn creases_on_and_across_a_mirror_plane_stay_creases() {
    let centre = DVec2::new(8.0, 5.0);
    let [x, y] = [DVec2::Y, DVec2::X].map(|along| Motion::mirroring(centre, along));
    for (symmetry, motions) in
        [(Symmetry::X, vec![x]), (Symmetry::Y, vec![y]), (Symmetry::Xy, vec![x, y])]
    {
        let run = symmetric(&ridge(), &quick(symmetry, 1.0), &motions);
        let on_crease =
            run.grid.xyz.iter().filter(|p| (p.y - 5.0).abs() < 1e-9 && (p.z - 4.0).abs() < 1e-9);
        assert!((9..=13).contains(&on_crease.count()), "{symmetry}");
    }
}

#[test]
fn a_surface_without_symmetry_gets_none_from_auto() {
    let run = pipeline::generate(&model("saddle"), &quick(Symmetry::Auto, 4.0), &Job::default());
    let run = run.unwrap();
    assert_eq!(run.symmetry, None);
    assert!(run.warnings.iter().any(|w| w.contains("no symmetry")), "{:?}", run.warnings);
}

#[test]
fn what_need_not_be_symmetric_is_refused_beside_a_symmetry() {
    let recipe = Recipe { anchors: vec![[1.0, 1.0, 0.0]], ..quick(Symmetry::X, 2.0) };
    let refused = pipeline::generate(&model("barrel"), &recipe, &Job::default());
    assert!(refused.map(|_| ()).unwrap_err().to_string().contains("anchors"));
}

#[test]
fn a_symmetric_grid_does_not_depend_on_threads() {
    let grid = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let recipe = quick(Symmetry::Turns(6), 2.0);
        let run = pool.install(|| pipeline::generate(&model("dome"), &recipe, &Job::default()));
        let run = run.unwrap();
        let bits: Vec<u64> = run.grid.flat_xyz().iter().map(|x| x.to_bits()).collect();
        (bits, run.grid.mesh.triangles().collect::<Vec<_>>())
    };
    assert!(grid(1) == grid(2));
}

#[test]
fn a_group_has_as_many_motions_as_its_order() {
    let group = Group { centre: DVec2::ZERO, turns: 3, mirror: Some(DVec2::X) };
    assert_eq!((group.motions().len(), group.order(), group.mirrors().len()), (6, 6, 3));
}

/// Rings and places along each side of [`uneven`].
const RINGS: usize = 12;
const PIECES: usize = 9;

/// A paraboloid over a polygon about the origin, its vertices exactly on it; what is symmetric is the surface, not its
/// triangles: rings, places along the sides and diagonals are uneven.
fn uneven(corners: &[[f64; 2]], seed: u64) -> Model {
    let mut state = seed;
    let mut uneven = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
    };
    let around = corners.len() * PIECES;
    let lifted = |p: DVec2| p.extend(2.0 - 0.02 * p.length_squared());
    let mut points = vec![lifted(DVec2::ZERO)];
    for ring in 1..=RINGS {
        let share = if ring == RINGS { 1.0 } else { (ring as f64 + 0.5 * uneven()) / RINGS as f64 };
        for k in 0..around {
            let [a, b] =
                [k / PIECES, k / PIECES + 1].map(|c| DVec2::from(corners[c % corners.len()]));
            let along = if k % PIECES == 0 { 0.0 } else { (k % PIECES) as f64 + 0.7 * uneven() };
            points.push(lifted(a.lerp(b, along / PIECES as f64) * share));
        }
    }
    let at = |ring: usize, k: usize| (1 + (ring - 1) * around + k % around) as u32;
    let mut faces: Vec<Vec<u32>> = (0..around).map(|k| vec![0, at(1, k), at(1, k + 1)]).collect();
    for ring in 1..RINGS {
        for k in 0..around {
            let [a, b, c, d] = [at(ring, k), at(ring + 1, k), at(ring + 1, k + 1), at(ring, k + 1)];
            let halves =
                if uneven() > 0.0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
            faces.extend(halves.map(|t| t.to_vec()));
        }
    }
    Model::Mesh(PolygonMesh { name: "uneven".into(), points, faces, ..PolygonMesh::default() })
}

/// A star with so many points.
fn star(points: u32) -> Vec<[f64; 2]> {
    let corner = |k: u32| {
        let (angle, r) =
            (PI * f64::from(k) / f64::from(points), if k.is_multiple_of(2) { 10.0 } else { 6.0 });
        [-r * angle.sin(), r * angle.cos()]
    };
    (0..2 * points).map(corner).collect()
}

/// Symmetry is the surface's: how it is triangulated does not count, within what facets are off it.
#[test]
fn a_mesh_is_as_symmetric_as_the_surface_that_it_stands_for() {
    for (seed, turns) in [(1, 3), (2, 5), (6, 5), (3, 7)] {
        for symmetry in [Symmetry::Auto, Symmetry::Turns(turns)] {
            let model = uneven(&star(turns), seed);
            let run = symmetric_within(&model, &quick(symmetry, 1.1), &[turn(turns)], 0.03);
            assert_eq!(run.symmetry.as_ref().unwrap().rotations, turns);
            assert!(
                run.warnings.iter().any(|w| w.contains("but for its facets")),
                "{:?}",
                run.warnings
            );
        }
    }
    let kite = [[0.0, 9.0], [-7.0, 2.0], [-3.0, -8.0], [3.0, -8.0], [7.0, 2.0]];
    for symmetry in [Symmetry::Auto, Symmetry::X] {
        let run = symmetric_within(&uneven(&kite, 4), &quick(symmetry, 1.1), &[mirror_x()], 0.03);
        assert_eq!(run.symmetry.unwrap().mirrors.len(), 1);
    }
}

/// Who asks for any symmetry has a grid in any case.
#[test]
fn a_symmetric_grid_that_is_not_valid_gives_way_to_one_that_has_none() {
    for (seed, points) in [(2, 5), (6, 5), (3, 7)] {
        let model = uneven(&star(points), seed);
        let run = pipeline::generate(&model, &quick(Symmetry::Auto, 1.1), &Job::default()).unwrap();
        check(&model, &run);
        let told = run.warnings.iter().any(|w| w.contains("the grid has no symmetry, as"));
        assert_eq!(told, run.symmetry.is_none(), "{:?}", run.warnings);
    }
}

/// What is off by more than facets can be is no symmetry: a star with one point too short.
#[test]
fn a_mesh_that_is_not_symmetric_is_told_so() {
    for turns in [3, 5, 7] {
        let mut corners = star(turns);
        corners[2] = corners[2].map(|x| 0.99 * x);
        let model = uneven(&corners, 5);
        let refused =
            pipeline::generate(&model, &quick(Symmetry::Turns(turns), 1.1), &Job::default());
        let told = refused.map(|_| ()).unwrap_err().to_string();
        assert!(told.contains("m off it"), "{told}");
    }
}
