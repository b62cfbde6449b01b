//! What the designer wishes for: lengths that vary, and directions.

use gridshell::job::Job;
use gridshell::recipe::{Direction, Recipe, Size};
use gridshell::run::Run;
use gridshell::surface::{Model, PolygonMesh, builtin};
use gridshell::{DVec3, pipeline};

/// Fewer tries than by default: enough for what is tested here.
fn quick(recipe: Recipe) -> Recipe {
    let mut recipe = recipe;
    recipe.pack.draws = 12;
    recipe.regularize.candidates = 2;
    recipe.regularize.trials = 1500;
    recipe.regularize.most_polish = 500;
    recipe
}

fn grid_on(model: &Model, recipe: Recipe) -> Run {
    pipeline::generate(model, &quick(recipe), &Job::default()).expect("a grid")
}

/// A flat square from -10 to 10.
fn square() -> Model {
    let points = [[-10., -10., 0.], [10., -10., 0.], [10., 10., 0.], [-10., 10., 0.]];
    Model::Mesh(PolygonMesh {
        name: "square".into(),
        points: points.map(DVec3::from_array).to_vec(),
        faces: vec![vec![0, 1, 2, 3]],
        ..PolygonMesh::default()
    })
}

/// Wanted length on the square: 0.7 at its left side, 1.5 at its right one.
fn wanted(x: f64) -> f64 {
    1.1 + 0.04 * x
}

fn points() -> Vec<[f64; 4]> {
    let along = |k: i32| -10.0 + 2.0 * f64::from(k);
    (0..=10)
        .flat_map(|i| (0..=10).map(move |j| [along(i), along(j), 0.0, wanted(along(i))]))
        .collect()
}

#[test]
fn members_follow_lengths_given_at_points() {
    let size = Size::Points { points: points() };
    let run = grid_on(&square(), Recipe { size, ..Recipe::default() });
    let grid = &run.grid;
    let members: Vec<(f64, f64)> = grid
        .mesh
        .edges()
        .map(|(a, b)| {
            let x = 0.5 * (grid.xyz[a as usize].x + grid.xyz[b as usize].x);
            (x, grid.length(a, b))
        })
        .collect();
    // By fifths of the square: each as long as wanted there, to within four per cent.
    for k in 0..5 {
        let from = -10.0 + 4.0 * f64::from(k);
        let there: Vec<f64> = members
            .iter()
            .filter(|(x, _)| (from..from + 4.0).contains(x))
            .map(|(x, l)| l / wanted(*x))
            .collect();
        let mean = there.iter().sum::<f64>() / there.len() as f64;
        assert!((mean - 1.0).abs() < 0.04, "from x = {from}: {mean}");
    }
    let quality = &run.quality;
    assert!(quality.edge_length.cv < 0.09, "{}", quality.edge_length.cv);
    // As many nodes as there is room for: the integral of dA / (sqrt(3)/2 l^2), half the boundary's, and one.
    let steps = 1000;
    let (mut area, mut sides) = (0.0, 0.0);
    for k in 0..steps {
        let l = wanted(-10.0 + 20.0 * (f64::from(k) + 0.5) / f64::from(steps));
        area += 20.0 * (20.0 / f64::from(steps)) / (0.75f64.sqrt() * l * l);
        sides += 2.0 * (20.0 / f64::from(steps)) / l;
    }
    sides += 20.0 / wanted(-10.0) + 20.0 / wanted(10.0);
    let count = area + 0.5 * sides + 1.0;
    assert!((quality.nodes as f64 / count - 1.0).abs() < 0.04, "{} for {count}", quality.nodes);
}

#[test]
fn an_edge_length_is_the_mean_of_lengths_that_vary() {
    let size = Size::Points { points: points() };
    let recipe = Recipe { size, edge_length: Some(1.6), ..Recipe::default() };
    let run = grid_on(&square(), recipe);
    let grid = &run.grid;
    let (sum, count) = grid
        .mesh
        .edges()
        .fold((0.0, 0.0), |(sum, count), (a, b)| (sum + grid.length(a, b), count + 1.0));
    assert!((sum / count / 1.6 - 1.0).abs() < 0.04, "{}", sum / count);
}

#[test]
fn lines_follow_a_direction_where_the_shape_allows() {
    // Half way between the lattice's natural directions.
    let across = Direction::Vector { xyz: [1.0, 1.0, 0.0] };
    let barrel = builtin::model("barrel").expect("built in");
    for (model, direction, length) in [
        (square(), across, 1.3),
        (square(), Direction::Boundary, 1.2),
        (barrel, Direction::Boundary, 1.5),
    ] {
        let recipe = Recipe { direction, edge_length: Some(length), ..Recipe::default() };
        let off = grid_on(&model, recipe).quality.direction_deviation_deg.expect("a direction");
        assert!(off < 3.0, "{length}: {off} degrees");
    }
}
