//! What the designer fixes stays fixed through every stage: members follow features, anchors are nodes.

use crate::promise::{kept, model, paper, quick};
use gridshell::DVec3;
use gridshell::grid::Grid;
use gridshell::job::Job;
use gridshell::pipeline;
use gridshell::recipe::Recipe;
use gridshell::run::Run;
use gridshell::surface::brep::{BrepEdge, BrepFace, Coedge};
use gridshell::surface::nurbs::{NurbsCurve, NurbsSurface};
use gridshell::surface::{Brep, Curve, Model, PolygonMesh, Shape};

/// Nodes are this close to what they are on, metres.
const EXACT: f64 = 1e-9;

type Point = [f64; 3];

/// Both methods.
fn recipes(edge_length: f64) -> [Recipe; 2] {
    [quick(edge_length), paper(edge_length)]
}

/// Every stage's grid and the final one.
fn grids(run: &Run) -> impl Iterator<Item = &Grid> {
    run.stages.iter().filter_map(|s| s.grid.as_ref()).chain([&*run.grid])
}

/// Distance from a polyline, and the arc length of the foot.
fn foot(line: &[DVec3], p: DVec3) -> (f64, f64) {
    let mut best = (f64::INFINITY, 0.0);
    let mut before = 0.0;
    for w in line.windows(2) {
        let d = w[1] - w[0];
        let f = ((p - w[0]).dot(d) / d.length_squared()).clamp(0.0, 1.0);
        let off = (w[0] + d * f).distance(p);
        if off < best.0 {
            best = (off, before + f * d.length());
        }
        before += d.length();
    }
    best
}

/// In every stage the line is covered by members in order, from its first point to its last, and they are
/// marked as a feature.
fn assert_followed(run: &Run, line: &[DVec3]) {
    let length: f64 = line.windows(2).map(|w| w[0].distance(w[1])).sum();
    let closed = line[0] == line[line.len() - 1];
    for grid in grids(run) {
        let mut on: Vec<(f64, u32)> = grid
            .mesh
            .vertices()
            .map(|v| (foot(line, grid.xyz[v as usize]), v))
            .filter(|((off, _), _)| *off < EXACT)
            .map(|((_, s), v)| (s, v))
            .collect();
        on.sort_by(|a, b| a.0.total_cmp(&b.0));
        assert!(on.len() > 2, "{} nodes on the line", on.len());
        if closed {
            on.push((on[0].0 + length, on[0].1));
        } else {
            assert!(on[0].0 < EXACT && on[on.len() - 1].0 > length - EXACT, "not to its ends");
        }
        for w in on.windows(2) {
            let at = grid.xyz[w[0].1 as usize];
            assert!(
                grid.mesh.is_feature_edge(w[0].1, w[1].1),
                "no member follows the line at {at}"
            );
            assert!(w[1].0 - w[0].0 < 2.5 * run.edge_length, "a long member at {at}");
        }
    }
}

fn assert_anchored(run: &Run, anchor: Point) {
    for grid in grids(run) {
        let off = grid.xyz.iter().map(|p| p.distance(anchor.into())).fold(f64::MAX, f64::min);
        assert!(off < 1e-12, "the anchor {anchor:?} is {off:e} m from the nearest node");
    }
}

fn line(points: &[Point]) -> Vec<DVec3> {
    points.iter().map(|&p| p.into()).collect()
}

#[test]
fn guides_and_anchors_on_a_plane_stay() {
    let bent: Vec<Point> = vec![[-2.5, -1.5, 0.0], [0.3, -1.2, 0.0], [2.0, 1.5, 0.0]];
    let across: Vec<Point> = vec![[-1.9, 2.0, 0.0], [0.5, -2.8, 0.0]];
    let anchors = [[-2.03, 0.4, 0.0], [0.7, -12f64.sqrt(), 0.0], [2.9, -0.3, 0.0]];
    for recipe in recipes(0.6) {
        let guides = vec![bent.clone(), across.clone()];
        let run = kept(&model("hexagon"), &Recipe { guides, anchors: anchors.to_vec(), ..recipe });
        assert_eq!(run.warnings, Vec::<String>::new());
        assert_followed(&run, &line(&bent));
        assert_followed(&run, &line(&across));
        for &a in &anchors {
            assert_anchored(&run, a);
        }
        // The corner of the bent guide and the crossing are nodes.
        assert_anchored(&run, bent[1]);
    }
}

#[test]
fn a_closed_guide_is_followed_all_round() {
    let mut ring: Vec<Point> = (0..48)
        .map(|i| f64::from(i) * std::f64::consts::TAU / 48.0)
        .map(|t| [2.0 * t.cos(), 2.0 * t.sin(), 0.0])
        .collect();
    ring.push(ring[0]);
    for recipe in recipes(0.6) {
        let run = kept(&model("hexagon"), &Recipe { guides: vec![ring.clone()], ..recipe });
        assert_followed(&run, &line(&ring));
    }
}

#[test]
fn guides_from_border_to_border_of_a_vault_stay() {
    // Straight lines of the cylinder: radius 34 / 3, axis 16 / 3 below.
    let ruling = |y: f64| {
        let z = ((34.0f64 / 3.0).powi(2) - y * y).sqrt() - 16.0 / 3.0;
        vec![[-15.0, y, z], [15.0, y, z]]
    };
    for recipe in recipes(2.0) {
        let guides = vec![ruling(3.3), ruling(-5.1)];
        let run = kept(&model("barrel"), &Recipe { guides: guides.clone(), ..recipe });
        for g in &guides {
            assert_followed(&run, &line(g));
        }
    }
}

/// A saddle roof of two planes: its points, the ridge between the last two.
fn gable() -> Vec<DVec3> {
    let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    vec![
        at(0., 0., 0.),
        at(12., 0., 0.),
        at(12., 9., 0.),
        at(0., 9., 0.),
        at(0., 4., 3.),
        at(12., 5., 3.),
    ]
}

fn gable_mesh() -> Model {
    let faces = vec![vec![0, 1, 5, 4], vec![4, 5, 2, 3]];
    Model::Mesh(PolygonMesh {
        name: "gable".into(),
        points: gable(),
        faces,
        ..PolygonMesh::default()
    })
}

/// The same with two ruled patches that share the ridge.
fn gable_patches() -> Model {
    let vertices = gable();
    let straight = |a: usize, b: usize| {
        let points = vec![vertices[a], vertices[b]];
        let curve = NurbsCurve::new(1, vec![0., 0., 1., 1.], points, Vec::new()).unwrap();
        let ends = [a as u32, b as u32];
        BrepEdge { curve: Curve::Nurbs(curve), range: [0.0, 1.0], ends }
    };
    let ends = [(0, 1), (1, 5), (5, 4), (4, 0), (5, 2), (2, 3), (3, 4)];
    let face = |[a, b, c, d]: [usize; 4], loops: [(u32, bool); 4]| {
        let knots = || vec![0., 0., 1., 1.];
        let points = [a, d, b, c].map(|v| vertices[v]).to_vec();
        let shape =
            NurbsSurface::new([1, 1], [knots(), knots()], [2, 2], points, Vec::new()).unwrap();
        let coedges = loops.map(|(edge, reversed)| Coedge { edge, reversed });
        BrepFace {
            shape: Shape::Nurbs(shape),
            loops: vec![coedges.to_vec()],
            reversed: false,
            label: String::new(),
        }
    };
    let south = face([0, 1, 5, 4], [(0, false), (1, false), (2, false), (3, false)]);
    let north = face([4, 5, 2, 3], [(2, true), (4, false), (5, false), (6, false)]);
    Model::Brep(Brep {
        name: "gable".into(),
        unit_in_metres: 1.0,
        edges: ends.iter().map(|&(a, b)| straight(a, b)).collect(),
        faces: vec![south, north],
        vertices,
        ..Brep::default()
    })
}

#[test]
fn members_follow_the_ridge_of_a_roof() {
    let ridge = gable()[4..].to_vec();
    for model in [gable_mesh(), gable_patches()] {
        for recipe in recipes(1.0) {
            let run = kept(&model, &recipe);
            assert_followed(&run, &ridge);
            // A guide over the ridge meets it in a node.
            let guide: Vec<Point> = vec![[5.0, 0.0, 0.0], [6.0, 4.5, 3.0], [7.0, 9.0, 0.0]];
            let run = kept(&model, &Recipe { guides: vec![guide], ..recipe });
            assert_followed(&run, &ridge);
            assert_anchored(&run, [6.0, 4.5, 3.0]);
        }
    }
}

#[test]
fn a_closed_crease_is_followed_all_round() {
    let ring = |z: f64| {
        (0..36)
            .map(|i| f64::from(i) * std::f64::consts::TAU / 36.0)
            .map(move |t| DVec3::new(5.0 * t.cos(), 5.0 * t.sin(), z))
    };
    let mut points: Vec<DVec3> = ring(0.0).chain(ring(3.0)).collect();
    points.push(DVec3::new(0.0, 0.0, 3.0));
    let wall = (0..36).map(|i| vec![i, (i + 1) % 36, 36 + (i + 1) % 36, 36 + i]);
    let lid = (0..36).map(|i| vec![36 + i, 36 + (i + 1) % 36, 72]);
    let faces = wall.chain(lid).collect();
    let mut crease: Vec<DVec3> = ring(3.0).collect();
    crease.push(crease[0]);
    let drum =
        Model::Mesh(PolygonMesh { name: "drum".into(), points, faces, ..PolygonMesh::default() });
    for recipe in recipes(1.2) {
        let run = pipeline::generate(&drum, &recipe, &Job::default()).unwrap();
        assert_followed(&run, &crease);
    }
}

#[test]
fn smooth_joins_and_bends_are_no_creases() {
    for name in ["facade", "barrel", "sphere", "torus"] {
        let recipe = quick(
            gridshell::surface::builtin::ALL.iter().find(|b| b.name == name).unwrap().edge_length
                * 2.0,
        );
        let run = pipeline::generate(&model(name), &recipe, &Job::default()).unwrap();
        assert!(
            run.grid.mesh.vertices().all(|v| run.grid.mesh.along_features(v).is_empty()),
            "{name}"
        );
    }
}

/// What a run on the hexagon with this guide or anchor says.
fn said(guides: Vec<Vec<Point>>, anchors: Vec<Point>) -> Result<Vec<String>, String> {
    let recipe = Recipe { guides, anchors, ..quick(0.8) };
    let run = pipeline::generate(&model("hexagon"), &recipe, &Job::default());
    run.map(|r| r.warnings).map_err(|e| e.to_string())
}

#[test]
fn guides_and_anchors_off_the_surface_are_refused_with_the_place() {
    let leaves = said(vec![vec![[0., 0., 0.], [0., -9., 0.]]], vec![]).unwrap_err();
    assert!(
        leaves.contains("guide 1 leaves the surface") && leaves.contains("(0.000, -3.464, 0.000)"),
        "{leaves}"
    );
    let above = said(vec![vec![[-1., 0., 0.], [1., 0., 2.]]], vec![]).unwrap_err();
    assert!(above.contains("guide 1 is 2.000 m off the surface"), "{above}");
    let short = said(vec![vec![[0., 0., 0.], [0.5, 0., 0.]]], vec![]).unwrap_err();
    assert!(short.contains("shorter than a member"), "{short}");
    let far = said(vec![], vec![[0., 0., 1.5]]).unwrap_err();
    assert!(far.contains("anchor 1 at (0.000, 0.000, 1.500) is 1.500 m off"), "{far}");
}

#[test]
fn what_is_near_or_narrow_is_told() {
    let told = |guides, anchors, what: &str| {
        let warnings = said(guides, anchors).unwrap();
        assert!(warnings.iter().any(|w| w.contains(what)), "{what}: {warnings:?}");
    };
    let across = |y: f64| vec![[-2., y, 0.], [2., y, 0.]];
    told(vec![across(0.0), across(0.2)], vec![], "closer than half a member to another feature");
    told(vec![across(-3.3)], vec![], "closer than half a member to the boundary");
    told(vec![], vec![[0., 0., 0.1]], "0.100 m off the surface and was moved");
    told(vec![], vec![[0., 0., 0.], [0.1, 0., 0.]], "fixed nodes are closer than half a member");
    told(vec![vec![[0., 0., 0.], [0., -3.8, 0.]]], vec![], "ends at the boundary");
}
