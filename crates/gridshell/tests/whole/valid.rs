//! Every grid that is given is valid, or there is none: by a check that knows nothing of the library's own.

use crate::promise::{model, quick, surface};
use gridshell::job::Job;
use gridshell::recipe::{Effort, Recipe};
use gridshell::run::Run;
use gridshell::surface::{Model, PolygonMesh, builtin};
use gridshell::{DVec3, Error, pipeline};
use std::f64::consts::TAU;

type Point = [f64; 3];

/// Nodes of a valid grid are farther apart than this, over l0, unless their borders are as near.
const NEAREST: f64 = 0.05;

fn draft(edge_length: f64) -> Recipe {
    Recipe { effort: Effort::Draft, edge_length: Some(edge_length), ..Recipe::default() }
}

fn nodes(count: usize) -> Recipe {
    Recipe { effort: Effort::Draft, nodes: Some(count), ..Recipe::default() }
}

/// A valid grid, or a refusal of one in words: None.
fn valid_or_refused(what: &str, model: &Model, recipe: &Recipe) -> Option<Run> {
    match pipeline::generate(model, recipe, &Job::default()) {
        Ok(run) => {
            assert!(run.valid && run.faults.is_empty(), "{what}");
            check(what, model, &run);
            Some(run)
        }
        Err(Error::Invalid { message, advice, places }) => {
            assert!(!message.is_empty() && advice.contains("keep"), "{what}: {message}; {advice}");
            assert!(!places.is_empty(), "{what}: {message}");
            None
        }
        Err(other) => {
            assert!(!other.to_string().is_empty(), "{what}");
            None
        }
    }
}

fn valid(what: &str, model: &Model, recipe: &Recipe) -> Run {
    valid_or_refused(what, model, recipe).unwrap_or_else(|| panic!("{what}: no grid"))
}

/// What a grid must be, worked out from its nodes and panels.
fn check(what: &str, model: &Model, run: &Run) {
    let (grid, l0) = (&run.grid, run.edge_length);
    let surface = surface(model, l0);
    grid.mesh.check().expect(what);
    assert_eq!(grid.mesh.euler_characteristic(), surface.euler_characteristic(), "{what}");
    let demanded = run.warnings.iter().any(|w| w.contains("apart, as"));
    for (a, p) in grid.xyz.iter().enumerate() {
        for (b, q) in grid.xyz[..a].iter().enumerate() {
            let near = p.distance(*q) < NEAREST * l0;
            assert!(!near || demanded, "{what}: nodes {b} and {a} are {} apart", p.distance(*q));
        }
    }
    let own = pipeline::surface(model, &run.recipe, &Job::default()).expect("the run had one").0;
    let mut area = 0.0;
    let told = run.warnings.iter().any(|w| w.contains("is folded, as the surface turns"));
    for t in grid.mesh.triangles() {
        let [p, q, r] = t.map(|v| grid.xyz[v as usize]);
        let panel = (q - p).cross(r - p);
        area += 0.5 * panel.length();
        assert!(panel.length() > 1e-4 * l0 * l0 * NEAREST, "{what}: panel {t:?} has no area");
        let normal: DVec3 = t.iter().map(|&v| grid.places[v as usize].normal(&own)).sum();
        assert!(panel.dot(normal) > 0.0 || told, "{what}: panel {t:?} is folded");
    }
    let share = area / surface.area;
    assert!((0.75..1.1).contains(&share), "{what}: {share} of the area");
}

fn polygon(name: &str, xy: &[[f64; 2]]) -> Model {
    let points = xy.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect();
    let faces = vec![(0..xy.len() as u32).collect()];
    Model::Mesh(PolygonMesh { name: name.into(), points, faces, ..PolygonMesh::default() })
}

/// Koch's snowflake of this side after so many steps.
fn koch(side: f64, steps: usize) -> Vec<[f64; 2]> {
    let high = 0.5 * 3f64.sqrt();
    let mut at = vec![[0.0, 0.0], [side, 0.0], [0.5 * side, high * side]];
    for _ in 0..steps {
        let next = |k: usize| at[(k + 1) % at.len()];
        let parts = (0..at.len()).flat_map(|k| {
            let ([x, y], [u, v]) = (at[k], next(k));
            let [dx, dy] = [(u - x) / 3.0, (v - y) / 3.0];
            let tip = [x + 1.5 * dx + high * dy, y + 1.5 * dy - high * dx];
            [[x, y], [x + dx, y + dy], tip, [x + 2.0 * dx, y + 2.0 * dy]]
        });
        at = parts.collect();
    }
    at
}

#[test]
fn an_anchor_beyond_the_border_of_a_surface_without_end_is_refused_in_words() {
    let outside: [(&str, f64, Point); 6] = [
        ("hexagon", 0.5, [100.0, 0.0, 0.0]),
        ("hexagon", 0.5, [0.0, 20.0, 0.0]),
        ("hexagon", 0.5, [-9.0, -9.0, 0.0]),
        ("dome", 2.0, [200.0, 0.0, 0.0]),
        ("skylights", 2.0, [1000.0, 1000.0, 0.0]),
        ("saddle", 1.0, [50.0, -50.0, 0.0]),
    ];
    for (name, length, anchor) in outside {
        let recipe = Recipe { anchors: vec![anchor], ..draft(length) };
        let refused = pipeline::generate(&model(name), &recipe, &Job::default()).unwrap_err();
        let message = refused.to_string();
        assert!(message.contains("anchor 1") && message.contains("off the surface"), "{message}");
    }
}

#[test]
fn an_anchor_a_little_beyond_the_border_is_put_on_it_and_told() {
    for (name, length) in [("hexagon", 0.5), ("dome", 2.0), ("saddle", 1.0)] {
        let plain = pipeline::surface(&model(name), &draft(length), &Job::default()).unwrap().0;
        let chain = &plain.loops[0];
        for share in [0.06, 0.43, 0.81] {
            let s = share * chain.length();
            let at = chain.surface_point(s);
            let out = chain.tangent(&plain.carrier, s).cross(plain.carrier.normal(&at));
            let edge = chain.exact(&plain, s);
            let anchor = (edge + out * (0.4 * length)).to_array();
            let run = valid(name, &model(name), &Recipe { anchors: vec![anchor], ..draft(length) });
            assert!(run.warnings.iter().any(|w| w.contains("moved onto it")), "{:?}", run.warnings);
            let nearest = run.grid.xyz.iter().map(|p| p.distance(edge)).fold(f64::MAX, f64::min);
            assert!(nearest < 0.2 * length, "{name}: {nearest} from the foot");
        }
    }
}

#[test]
fn anchors_a_hair_apart_or_off_the_border_share_a_node() {
    let twins: [(&str, f64, Vec<Point>, usize); 4] = [
        ("hexagon", 0.5, vec![[0.3, 0.2, 0.0], [0.3001, 0.2, 0.0], [0.3, 0.2, 0.0]], 1),
        (
            "hexagon",
            1.0,
            vec![[0.3, 0.2, 0.0], [0.33, 0.21, 0.0], [1.3, 0.2, 0.0], [1.3, 0.22, 0.0]],
            2,
        ),
        ("saddle", 2.0, vec![[0.5, 0.5, 0.0], [0.5, 0.58, 0.0]], 1),
        ("dome", 3.0, vec![[0.5, 0.5, 9.0], [0.5, 0.5, 9.0]], 1),
    ];
    for (name, length, mut anchors, _) in twins {
        let plain = pipeline::surface(&model(name), &draft(length), &Job::default()).unwrap().0;
        let locator = gridshell::surface::Locator::new(&plain);
        for p in &mut anchors {
            *p = plain.exact(&locator.nearest((*p).into()).unwrap()).to_array();
        }
        let run = valid(name, &model(name), &Recipe { anchors: anchors.clone(), ..draft(length) });
        for p in anchors {
            let nearest =
                run.grid.xyz.iter().map(|q| q.distance(p.into())).fold(f64::MAX, f64::min);
            assert!(nearest <= NEAREST * length, "{name}: no node near {p:?}");
        }
    }
}

#[test]
fn thousands_of_anchors_and_tangled_guides_give_a_valid_grid_or_a_refusal() {
    let mut rng = fastrand::Rng::with_seed(7);
    let scattered = |rng: &mut fastrand::Rng, n: usize| -> Vec<Point> {
        (0..n).map(|_| [3.0 * rng.f64() - 1.5, 3.0 * rng.f64() - 1.5, 0.0]).collect()
    };
    let spiral = |turns: f64, n: usize| -> Vec<Point> {
        let at = |k: usize| k as f64 / n as f64;
        (0..n)
            .map(at)
            .map(|f| [2.0 * f * (turns * TAU * f).cos(), 2.0 * f * (turns * TAU * f).sin(), 0.0])
            .collect()
    };
    let zigzag = |n: usize, high: f64| -> Vec<Point> {
        (0..n)
            .map(|k| [3.0 * k as f64 / n as f64 - 1.5, if k % 2 == 0 { 0.0 } else { high }, 0.0])
            .collect()
    };
    let mut cases: Vec<(String, Recipe)> = Vec::new();
    for n in [20, 300, 2000] {
        cases.push((
            format!("{n} anchors"),
            Recipe { anchors: scattered(&mut rng, n), ..draft(0.5) },
        ));
    }
    for (turns, n) in [(1.0, 200), (3.0, 1000), (12.0, 1000)] {
        cases.push((
            format!("spiral {turns}"),
            Recipe { guides: vec![spiral(turns, n)], ..draft(0.5) },
        ));
    }
    for (n, high) in [(6, 1.0), (40, 0.4), (200, 0.1)] {
        cases.push((format!("zigzag {n}"), Recipe { guides: vec![zigzag(n, high)], ..draft(0.5) }));
    }
    for gap in [0.3, 0.1, 0.01] {
        let rows =
            (0..5).map(|k| vec![[-1.2, gap * f64::from(k), 0.0], [1.2, gap * f64::from(k), 0.0]]);
        cases.push((format!("rows {gap}"), Recipe { guides: rows.collect(), ..draft(0.5) }));
    }
    let mut laid = 0;
    for (what, recipe) in cases {
        laid += usize::from(valid_or_refused(&what, &model("hexagon"), &recipe).is_some());
    }
    assert!(laid >= 6, "only {laid} of them got a grid");
}

#[test]
fn a_fractal_border_is_thinned_by_rule_and_told() {
    for (side, steps, count) in [(20.0, 4, 300), (20.0, 5, 300), (2000.0, 4, 250)] {
        let border = koch(side, steps);
        let run = valid("Koch", &polygon("koch", &border), &nodes(count));
        let got = run.quality.nodes;
        let told = run.warnings.iter().any(|w| w.contains("were asked for"));
        assert!(got.abs_diff(count) as f64 <= 0.15 * count as f64 || told, "{got} for {count}");
        assert!(got < 2 * count, "{got} nodes for {count}");
        let thinned = run.warnings.iter().any(|w| w.contains("leave the border by up to"));
        assert!(thinned, "{:?}", run.warnings);
        assert!(run.quality.boundary_deviation < 1e-9, "border nodes stay on the border");
    }
}

#[test]
fn a_turn_of_just_the_angle_asked_for_is_a_corner_whatever_rounding_says() {
    for (side, turned, n) in
        [(5.0, 0.0, 12), (5.0, 0.1, 12), (0.013, 1.0, 12), (777.7, 0.4, 12), (3.0, 0.2, 8)]
    {
        let radius = 0.5 * side / (0.5 * TAU / n as f64).sin();
        let at = |k: usize| turned + TAU * k as f64 / n as f64;
        let border: Vec<[f64; 2]> =
            (0..n).map(|k| [radius * at(k).cos(), radius * at(k).sin()]).collect();
        let recipe = Recipe { corner_angle_deg: 360.0 / n as f64, ..draft(side) };
        let (surface, _) =
            pipeline::surface(&polygon("ring", &border), &recipe, &Job::default()).unwrap();
        assert_eq!(surface.loops[0].corners.len(), n, "side {side} turned by {turned}");
    }
}

#[test]
fn very_few_nodes_give_a_valid_grid_or_a_refusal_on_every_built_in() {
    let mut laid = 0;
    for b in builtin::ALL {
        for n in [1, 4, 10] {
            let what = format!("{} -n {n}", b.name);
            laid += usize::from(valid_or_refused(&what, &model(b.name), &nodes(n)).is_some());
        }
    }
    assert!(laid >= builtin::ALL.len() / 2, "only {laid} got a grid");
}

#[test]
fn a_grid_that_is_not_valid_is_kept_when_asked_and_marked() {
    // Four to six nodes lose most of a ball's area.
    for (name, count) in [("sphere", 4), ("sphere", 6), ("torus", 8)] {
        let refused = pipeline::generate(&model(name), &nodes(count), &Job::default());
        let Err(Error::Invalid { message, places, .. }) = refused else {
            panic!("{name} -n {count}: {:?}", refused.map(|run| run.quality.area_ratio));
        };
        assert!(message.contains("area") && !places.is_empty(), "{message}");
        let recipe = Recipe { keep_invalid: true, ..nodes(count) };
        let run = pipeline::generate(&model(name), &recipe, &Job::default()).unwrap();
        assert!(!run.valid && !run.faults.is_empty());
        assert!(run.warnings.iter().any(|w| w.starts_with("not valid")), "{:?}", run.warnings);
        assert!(run.invalid().is_some_and(|what| what.contains("area")));
    }
}

#[test]
fn a_number_of_nodes_that_is_not_kept_is_told() {
    // Each opening has four corners, and these alone are more nodes than asked for.
    for (openings, count) in [(2, 8), (3, 12), (4, 20)] {
        let n = 2 * openings + 1;
        let points = (0..=n).flat_map(|j| (0..=n).map(move |i| (i, j)));
        let points = points.map(|(i, j)| DVec3::new(f64::from(i), f64::from(j), 0.0)).collect();
        let squares = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
        let faces = squares.filter(|(i, j)| i % 2 == 0 || j % 2 == 0).map(|(i, j)| {
            let v = (j * (n + 1) + i) as u32;
            let m = n as u32;
            vec![v, v + 1, v + m + 2, v + m + 1]
        });
        let faces = faces.collect();
        let name = "pierced".into();
        let model = Model::Mesh(PolygonMesh { name, points, faces, ..PolygonMesh::default() });
        let recipe = Recipe { keep_invalid: true, ..nodes(count) };
        let run = pipeline::generate(&model, &recipe, &Job::default()).unwrap();
        let told = run.warnings.iter().any(|w| w.contains("were asked for"));
        assert!(told, "{} nodes for {count}: {:?}", run.quality.nodes, run.warnings);
    }
}

#[test]
fn ordinary_grids_are_not_repaired() {
    for (name, length) in [("hexagon", 1.0), ("saddle", 1.5), ("barrel", 2.0), ("great-court", 5.0)]
    {
        let run = valid(name, &model(name), &quick(length));
        assert!(
            run.stages.iter().all(|s| s.notes.iter().all(|n| !n.contains("repaired"))),
            "{name}"
        );
    }
}
