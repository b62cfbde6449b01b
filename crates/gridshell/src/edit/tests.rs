use super::*;
use crate::bubbles::Bubbles;
use crate::stages::measure::measure;
use crate::stages::{pack, triangulate};
use crate::surface::{Fixtures, Sampling, builtin};
use glam::DVec3;
use proptest::prelude::*;
use std::sync::LazyLock;

/// A surface of this name with a rough grid on it: random bubbles, relaxed once.
fn start(name: &str, length: f64, guided: bool) -> (Arc<Surface>, Grid, Recipe) {
    let sampling =
        Sampling { max_edge: 0.5 * length, chord_error: 2e-3 * length, corner_angle: 0.5 };
    let mut surface = builtin::model(name)
        .expect("built in")
        .surface(&sampling, &Job::default())
        .expect("a surface");
    if guided {
        let guide = vec![DVec3::new(-2.0, -1.0, 0.0), DVec3::new(2.0, 1.5, 0.0)];
        let anchors = [DVec3::new(0.0, -2.0, 0.0)];
        let wanted = Fixtures {
            crease_angle: None,
            guides: &[guide],
            anchors: &anchors,
            corner_angle: 0.5,
            edge_length: length,
        };
        surface.fix(&wanted, &Job::default()).expect("guide and anchor are on the surface");
    }
    let counts = |pieces: &[pack::boundary::Piece]| -> Vec<usize> {
        pieces.iter().map(|p| pack::boundary::member_count(p, length)).collect()
    };
    let pieces = pack::boundary::pieces(&surface);
    let boundary = pack::boundary::place(&surface, &pieces, &counts(&pieces), 0.0);
    let lines = pack::boundary::feature_pieces(&surface);
    let features = pack::boundary::place_on_features(&surface, &lines, &counts(&lines));
    let fixed = surface.fixed.clone();
    let mut bubbles = Bubbles { boundary, features, fixed, interior: Vec::new() };
    let mut rng = fastrand::Rng::with_seed(3);
    let count = pack::interior_count(&surface, bubbles.len(), length, 1.0);
    let held = bubbles.xyz(&surface);
    bubbles.interior =
        pack::scatter(&surface, count, &held, 0.6 * length, &mut rng, &Job::default());
    let recipe = Recipe { edge_length: Some(length), ..Recipe::default() };
    pack::settle(&surface, &mut bubbles, length, &recipe.pack, &crate::job::Job::default());
    let mut grid =
        triangulate::triangulate(&surface, &bubbles, &Job::default()).expect("a manifold").0;
    let mut few = recipe.clone();
    few.regularize.method = crate::recipe::RegularizeMethod::Paper;
    few.regularize.max_rounds = 1;
    let job = crate::job::Job::default();
    grid = crate::stages::regularize::regularize(&surface, grid, length, &few, 1, &job).0;
    crate::stages::relax::relax(&surface, &mut grid, &recipe, &crate::job::Job::default());
    grid.settle_exactly(&surface);
    (Arc::new(surface), grid, recipe)
}

type Start = (Arc<Surface>, Grid, Recipe);

static STARTS: LazyLock<[Start; 3]> = LazyLock::new(|| {
    [start("hexagon", 0.7, true), start("saddle", 3.0, false), start("torus", 1.6, false)]
});

fn editor(which: usize) -> Editor {
    let (surface, grid, recipe) = STARTS[which].clone();
    let length = recipe.edge_length.expect("given");
    Editor::new(surface, grid, recipe, length)
}

/// Every bit of a grid.
fn bits(grid: &Grid) -> String {
    let xyz: Vec<[u64; 3]> = grid.xyz.iter().map(|p| p.to_array().map(f64::to_bits)).collect();
    format!("{:?} {:?} {xyz:?}", grid.mesh, grid.places)
}

/// What is promised of the grid after any edit.
fn assert_sound(editor: &Editor, euler: i64) {
    editor.grid.mesh.check().expect("a manifold");
    assert_eq!(editor.grid.mesh.euler_characteristic(), euler);
    let grid = editor.finished();
    let quality = measure(&grid, &editor.surface, editor.edge_length, &editor.recipe.measure);
    assert_eq!(quality.folded_panels, 0);
    assert!(quality.surface_deviation < 1e-9, "{}", quality.surface_deviation);
    assert!(quality.boundary_deviation < 1e-9, "{}", quality.boundary_deviation);
    let figures = editor.figures();
    assert_eq!(figures.irregular, quality.irregular.interior + quality.irregular.boundary);
    assert!((figures.mu - quality.mu).abs() < 1e-9);
}

/// An edit drawn by four numbers.
fn drawn(editor: &Editor, [kind, pick, side, more]: [u32; 4]) -> Edit {
    let mesh = &editor.grid.mesh;
    let alive: Vec<u32> = mesh.vertices().collect();
    let a = alive[pick as usize % alive.len()];
    let b = mesh.ring(a)[side as usize % mesh.degree(a)];
    let nodes = [a, b];
    let toward = editor.grid.xyz[a as usize]
        .lerp(editor.grid.xyz[b as usize], f64::from(more % 100) / 120.0)
        .to_array();
    match kind % 24 {
        0..6 => Edit::Flip { nodes },
        6..10 => Edit::Split { nodes },
        10..14 => Edit::Collapse { nodes },
        14 => Edit::Drift { nodes, toward: None, steps: Some(more % 5) },
        15..18 => Edit::Move { node: a, to: toward },
        18 => Edit::Pin { node: a },
        19 => Edit::Unpin { node: a },
        20 => Edit::AddAnchor { at: toward },
        21 => Edit::RemoveAnchor { node: a },
        22 => Edit::Relax { nodes: vec![a], rings: more % 4 },
        _ if more % 8 == 0 => Edit::RelaxAll {},
        _ => Edit::Heal { nodes: vec![a], rings: 2, seed: u64::from(more) },
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    #[test]
    fn any_edits_keep_the_grid_sound_and_can_all_be_undone_redone_and_replayed(
        which in 0usize..3,
        draws in prop::collection::vec(any::<[u32; 4]>(), 60..140),
    ) {
        let mut editor = editor(which);
        let before = bits(&editor.grid);
        let euler = editor.grid.mesh.euler_characteristic();
        assert_sound(&editor, euler);
        for draw in draws {
            let here = bits(&editor.grid);
            let edit = drawn(&editor, draw);
            let promised = editor.preview(&edit);
            prop_assert_eq!(&bits(&editor.grid), &here);
            let got = editor.apply(edit);
            prop_assert_eq!(&got, &promised);
            if let Ok(effect) = got {
                let now = editor.figures();
                prop_assert!((effect.after.residual - now.residual).abs() < 1e-6);
                prop_assert!((effect.after.mu - now.mu).abs() < 1e-6);
                prop_assert!((effect.after.merit - now.merit).abs() < 1e-6 * now.merit);
                prop_assert_eq!(effect.after.irregular, now.irregular);
                prop_assert_eq!(effect.after.nodes, now.nodes);
            } else {
                prop_assert_eq!(&bits(&editor.grid), &here);
            }
            assert_sound(&editor, euler);
        }
        let after = bits(&editor.grid);
        let log = editor.log();
        while editor.undo().is_some() {}
        prop_assert_eq!(&bits(&editor.grid), &before);
        while editor.redo().is_some() {}
        prop_assert_eq!(&bits(&editor.grid), &after);

        let read = Log::from_json(&log.to_json()).expect("what was written");
        prop_assert_eq!(&read, &log);
        let mut again = self::editor(which);
        again.replay(&read, &Job::default()).expect("it fits");
        prop_assert_eq!(&bits(&again.grid), &after);
    }
}

fn reason(result: Result<Effect, Refusal>) -> String {
    result.expect_err("refused").to_string()
}

#[test]
fn refusals_name_the_nodes_and_say_what_to_do() {
    let mut editor = editor(0);
    let mesh = &editor.grid.mesh;
    let corner = mesh.vertices().find(|&v| mesh.is_pinned(v) && mesh.is_boundary(v)).expect("six");
    let next = mesh.next_on_boundary(corner).expect("on the boundary");
    let inside =
        mesh.vertices().find(|&v| matches!(editor.grid.places[v as usize], Place::Interior(_)));
    let inside = inside.expect("a free node");
    let at = editor.grid.xyz[inside as usize].to_array();

    let text = reason(editor.preview(&Edit::Flip { nodes: [corner, next] }));
    assert!(text.starts_with(&format!("member {corner}-{next} is on the boundary: ")), "{text}");
    let text = reason(editor.preview(&Edit::Move { node: corner, to: at }));
    assert!(text.starts_with(&format!("node {corner} is a corner")), "{text}");
    let text = reason(editor.preview(&Edit::Flip { nodes: [corner, 100_000] }));
    assert!(text.starts_with("there is no node 100000: "), "{text}");
    let text = reason(editor.preview(&Edit::Split { nodes: [corner, corner] }));
    assert!(text.starts_with("no member joins nodes"), "{text}");
    let text = reason(editor.preview(&Edit::Unpin { node: inside }));
    assert!(text.contains("is not pinned"), "{text}");
    let text = reason(editor.preview(&Edit::Move { node: inside, to: [0.0, 0.0, f64::NAN] }));
    assert!(text.contains("the target is"), "{text}");
    let text = reason(editor.preview(&Edit::AddAnchor { at: [1e3, 0.0, 0.0] }));
    assert!(text.starts_with("no free node can come to"), "{text}");
    editor.apply(Edit::Pin { node: inside }).expect("free");
    let text = reason(editor.preview(&Edit::Move { node: inside, to: at }));
    assert_eq!(text, format!("node {inside} is pinned: unpin it first"));
}

#[test]
fn a_pinned_node_stays_through_everything() {
    let mut editor = editor(1);
    let mesh = &editor.grid.mesh;
    let inside = mesh.vertices().filter(|&v| !mesh.is_boundary(v)).nth(10).expect("many");
    let on_boundary = mesh.vertices().find(|&v| mesh.is_boundary(v) && !mesh.is_pinned(v));
    let pinned = [inside, on_boundary.expect("many")];
    let before = pinned.map(|v| editor.grid.xyz[v as usize]);
    for node in pinned {
        editor.apply(Edit::Pin { node }).expect("free");
    }
    for node in pinned {
        for &w in &editor.grid.mesh.ring(node).to_vec() {
            let _ = editor.apply(Edit::Collapse { nodes: [w, node] });
        }
    }
    let _ = editor.apply(Edit::Heal { nodes: pinned.to_vec(), rings: 4, seed: 1 });
    editor.apply(Edit::RelaxAll {}).expect("always done");
    assert_eq!(pinned.map(|v| editor.grid.xyz[v as usize]), before);
}

#[test]
fn an_anchor_is_where_it_was_wanted_until_it_is_removed() {
    let mut editor = editor(1);
    let mesh = &editor.grid.mesh;
    let (a, b) =
        mesh.edges().find(|&(a, b)| !mesh.is_boundary(a) && !mesh.is_boundary(b)).expect("many");
    let near = editor.grid.xyz[a as usize].lerp(editor.grid.xyz[b as usize], 0.4);
    editor.apply(Edit::AddAnchor { at: near.to_array() }).expect("between two nodes");
    editor.apply(Edit::RelaxAll {}).expect("always done");
    let apart = |v: &u32| editor.grid.xyz[*v as usize].distance(near);
    let node =
        editor.grid.mesh.vertices().min_by(|v, w| apart(v).total_cmp(&apart(w))).expect("many");
    // The saddle bends under the chord between the two.
    assert!(apart(&node) < 0.05, "{}", apart(&node));
    assert!(editor.grid.mesh.is_pinned(node));
    editor.apply(Edit::RemoveAnchor { node }).expect("an anchor");
    assert!(!editor.grid.mesh.is_pinned(node));
}

#[test]
fn a_log_that_does_not_fit_names_its_entry_and_changes_nothing() {
    let mut editor = editor(1);
    let before = bits(&editor.grid);
    let mesh = &editor.grid.mesh;
    let (a, b) =
        mesh.edges().find(|&(a, b)| !mesh.is_boundary(a) && !mesh.is_boundary(b)).expect("many");
    let text = format!(
        r#"{{"schema":"gridshell.edits/1","edits":[{{"op":"split","nodes":[{a},{b}]}},{{"op":"pin","node":9999}}]}}"#
    );
    let log = Log::from_json(&text).expect("a log");
    let error = editor.replay(&log, &Job::default()).expect_err("no such node").to_string();
    assert!(
        error.starts_with(
            "entry 2 of the log's 2 (pin 9999) does not fit the grid: there is no node 9999"
        ),
        "{error}"
    );
    assert_eq!(bits(&editor.grid), before);
    assert_eq!((editor.history().len(), editor.undone().len()), (0, 0));

    let elsewhere = self::editor(0).log();
    let error = editor.replay(&elsewhere, &Job::default()).expect_err("another grid").to_string();
    assert!(error.starts_with("the log was made on another grid"), "{error}");
}

#[test]
fn logs_that_are_none_are_refused() {
    for text in [
        "",
        "{}",
        r#"{"schema":"gridshell.edits/2","edits":[]}"#,
        r#"{"schema":"gridshell.edits/1","edits":[{"op":"melt"}]}"#,
        r#"{"schema":"gridshell.edits/1","edits":[{"op":"flip","nodes":[1]}]}"#,
        r#"{"schema":"gridshell.edits/1","edits":[{"op":"flip","nodes":[1,2],"hard":true}]}"#,
        r#"{"schema":"gridshell.edits/1","edits":[{"op":"move","node":1,"to":[1e999,0,0]}]}"#,
    ] {
        assert!(Log::from_json(text).is_err(), "{text}");
    }
}

#[test]
fn suggestions_do_what_they_say() {
    let mut editor = editor(1);
    let suggested = editor.suggest(5, &Job::default());
    assert!(!suggested.is_empty(), "a rough grid can be bettered");
    assert!(suggested.windows(2).all(|w| w[0].1.gain() >= w[1].1.gain()));
    let (edit, effect) = suggested[0].clone();
    assert!(effect.gain() > 0.0);
    assert_eq!(editor.apply(edit), Ok(effect));
}

/// The nodes at the ends of members on features, and how far each is off the line from `p` to `q`.
fn off_line(editor: &Editor, [p, q]: [DVec3; 2]) -> Vec<f64> {
    let mesh = &editor.grid.mesh;
    let on = mesh.vertices().filter(|&v| !mesh.along_features(v).is_empty());
    let along = (q - p).normalize();
    on.map(|v| (editor.grid.xyz[v as usize] - p).reject_from(along).length()).collect()
}

#[test]
fn a_guide_is_followed_at_once_and_until_it_is_removed() {
    let (surface, grid, recipe) = start("hexagon", 0.5, false);
    let mut editor = Editor::new(surface, grid, recipe, 0.5);
    let euler = editor.grid.mesh.euler_characteristic();
    let before = bits(&editor.grid);
    let ends = [DVec3::new(-2.0, -1.0, 0.0), DVec3::new(2.0, 1.5, 0.0)];
    let points = ends.map(|p| p.to_array()).to_vec();
    editor.apply(Edit::AddGuide { points: points.clone() }).expect("there is room");
    assert_sound(&editor, euler);
    let off = off_line(&editor, ends);
    assert!(off.len() >= 8, "{off:?}");
    assert!(off.iter().all(|d| *d < 1e-9), "{off:?}");
    let text = reason(editor.preview(&Edit::AddGuide { points }));
    assert!(text.starts_with("there is a crease or guide along that line"), "{text}");

    let crossing = vec![[-1.5, 2.0, 0.0], [1.5, -1.5, 0.0]];
    editor.apply(Edit::AddGuide { points: crossing }).expect("they may cross");
    assert_sound(&editor, euler);
    editor.apply(Edit::RelaxAll {}).expect("always done");
    assert_sound(&editor, euler);

    let mesh = &editor.grid.mesh;
    let (a, b) = mesh.edges().find(|&(a, b)| mesh.is_feature_edge(a, b)).expect("a member on it");
    let text = reason(editor.preview(&Edit::Flip { nodes: [a, b] }));
    assert!(text.contains("follows a crease or guide"), "{text}");
    editor.apply(Edit::RemoveGuide { nodes: [a, b] }).expect("it is on one");
    assert_sound(&editor, euler);
    assert!(!editor.grid.mesh.is_feature_edge(a, b));

    let (after, log) = (bits(&editor.grid), editor.log());
    while editor.undo().is_some() {}
    assert_eq!(bits(&editor.grid), before);
    editor.replay(&log, &Job::default()).expect("it fits");
    assert_eq!(bits(&editor.grid), after);
}

#[test]
fn relaxing_that_is_stopped_leaves_the_grid_as_it_was() {
    let mut editor = editor(1);
    let before = bits(&editor.grid);
    let job = Job::default();
    let first = job.clone();
    let watched = job.with_progress(move |_| first.cancel());
    let text = reason(editor.apply_with(Edit::RelaxAll {}, &watched));
    assert!(text.contains("stopped"), "{text}");
    assert_eq!(bits(&editor.grid), before);
    assert_eq!(editor.history().len(), 0);
}

#[test]
fn healing_only_moves_what_is_near() {
    let mut editor = editor(1);
    let mesh = &editor.grid.mesh;
    let node =
        mesh.vertices().find(|&v| !mesh.is_boundary(v) && mesh.degree(v) != 6).expect("rough");
    let before = editor.grid.clone();
    let effect = editor.apply(Edit::Heal { nodes: vec![node], rings: 3, seed: 0 }).expect("rough");
    assert!(effect.gain() > 0.0);
    let at = before.xyz[node as usize];
    let shared = before.mesh.vertices().filter(|&v| editor.grid.mesh.is_alive(v));
    let far = shared.filter(|&v| before.xyz[v as usize].distance(at) > 9.0 * editor.edge_length);
    for v in far {
        assert_eq!(before.xyz[v as usize], editor.grid.xyz[v as usize], "node {v}");
    }
}
