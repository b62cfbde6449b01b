//! The recipe as a form: its fields with unit and help, and the recipe that given values make.
//!
//! What a field may hold is checked by the recipe itself: limits here only help the page.

use crate::message::{Control, Field, Named};
use gridshell::error::{Error, Result};
use gridshell::recipe::Recipe;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Values by key, as the page sends them.
pub type Values = BTreeMap<String, Value>;

/// Longest text of points, bytes.
const MOST_TEXT: usize = 200_000;

/// All fields.
pub fn fields() -> Vec<Field> {
    let recipe = Recipe::default();
    let mut all = grid_fields();
    all.extend(shape_fields(&recipe));
    all.extend(method_fields(&recipe));
    all
}

fn grid_fields() -> Vec<Field> {
    let effort = choice(&[
        ("draft", "Draft: seconds"),
        ("standard", "Standard"),
        ("best", "Best: three times as long"),
    ]);
    let methods: Vec<(&str, &str)> = Recipe::METHODS
        .iter()
        .map(|&(name, _)| {
            (name, if name == "paper" { "As printed in the paper" } else { "Default" })
        })
        .collect();
    vec![
        field(
            ["edge_length", "Edge length", "m", "Wanted length of the members."],
            "Grid",
            optional(0.001, 1000.0, 0.1),
            Value::Null,
        ),
        field(
            ["nodes", "Nodes", "", "Wanted number of nodes; counts where no edge length is given."],
            "Grid",
            optional(3.0, 2e6, 50.0),
            Value::Null,
        ),
        field(
            ["effort", "Effort", "", "How much work to put in."],
            "Grid",
            effort,
            json!("standard"),
        ),
        field(
            [
                "candidates",
                "Candidates",
                "",
                "Grids made side by side, of which the best is kept; empty: as many as suit.",
            ],
            "Grid",
            optional(1.0, 1000.0, 1.0),
            Value::Null,
        ),
        field(
            [
                "seed",
                "Seed",
                "",
                "Another number gives another grid, the same number the same grid.",
            ],
            "Grid",
            number(0.0, 9_007_199_254_740_991.0, 1.0),
            json!(1),
        ),
        field(
            [
                "method",
                "Method",
                "",
                "The default searches; the paper's follows the paper step by step.",
            ],
            "Grid",
            choice(&methods),
            json!("default"),
        ),
    ]
}

fn shape_fields(recipe: &Recipe) -> Vec<Field> {
    let symmetry = choice(&[
        ("none", "None"),
        ("auto", "All that the surface has"),
        ("x", "Mirror perpendicular to x"),
        ("y", "Mirror perpendicular to y"),
        ("xy", "Mirrors perpendicular to x and y"),
        ("2", "2 turns"),
        ("3", "3 turns"),
        ("4", "4 turns"),
        ("5", "5 turns"),
        ("6", "6 turns"),
        ("8", "8 turns"),
        ("12", "12 turns"),
    ]);
    let part = choice(&[("one", "The only one"), ("all", "All")]);
    let size =
        choice(&[("uniform", "The same everywhere"), ("curvature", "Shorter where it bends")]);
    let direction = choice(&[
        ("any", "Any"),
        ("boundary", "Along the longest boundary"),
        ("vector", "A vector"),
    ]);
    vec![
        field(
            ["part", "Part", "", "Which of several parts the grid is laid on."],
            "Shape",
            part,
            json!("one"),
        ),
        field(
            ["symmetry", "Symmetry", "", "Symmetry of the surface that the grid is to have too."],
            "Shape",
            symmetry,
            json!("none"),
        ),
        field(
            ["size", "Lengths", "", "Whether all members aim for the same length."],
            "Shape",
            size,
            json!("uniform"),
        ),
        field(
            [
                "direction",
                "Direction",
                "",
                "What one family of lines follows where the shape allows.",
            ],
            "Shape",
            direction,
            json!("any"),
        ),
        field(
            ["vector", "Vector", "", "The direction, for `A vector`: x, y, z."],
            "Shape",
            Control::Vector,
            Value::Null,
        ),
        field(
            [
                "border",
                "Border",
                "",
                "0: one lattice, cut off at the border; 1: rows along every border.",
            ],
            "Shape",
            number(0.0, 1.0, 0.05),
            json!(recipe.border),
        ),
        field(
            [
                "feature_angle_deg",
                "Crease angle",
                "°",
                "Edges where the surface turns by more become lines of members; 180 finds none.",
            ],
            "Shape",
            number(1.0, 180.0, 1.0),
            json!(recipe.feature_angle_deg),
        ),
        field(
            [
                "corner_angle_deg",
                "Corner angle",
                "°",
                "Boundary corners that turn by more are fixed nodes.",
            ],
            "Shape",
            number(0.0, 180.0, 1.0),
            json!(recipe.corner_angle_deg),
        ),
        smooth_field(),
        losses_field(),
        field(
            ["anchors", "Anchors", "m", "Points that become nodes: x, y, z, one a line."],
            "Shape",
            Control::Points,
            Value::Null,
        ),
    ]
}

fn smooth_field() -> Field {
    field(
        [
            "smooth_input",
            "Coarse mesh",
            "",
            "A mesh with edges longer than half a member may give way to a smooth surface through its vertices.",
        ],
        "Shape",
        choice(&[("false", "As it is"), ("true", "Smoothed")]),
        json!("false"),
    )
}

fn losses_field() -> Field {
    field(
        [
            "accept_losses",
            "Missing parts",
            "",
            "What of the file could not be read is listed in the notes: whether a grid is laid without it.",
        ],
        "Shape",
        choice(&[("false", "Not without them"), ("true", "Accepted")]),
        json!("false"),
    )
}

fn method_fields(recipe: &Recipe) -> Vec<Field> {
    vec![
        field(
            [
                "relax.straightness",
                "Straightness",
                "",
                "Weight of straight lines against equal lengths.",
            ],
            "Method",
            number(0.0, 100.0, 0.05),
            json!(recipe.relax.straightness),
        ),
        field(
            [
                "measure.lambda",
                "λ",
                "",
                "Weight of nodes inside against those on the border, Eq. 13.",
            ],
            "Method",
            number(0.0, 1.0, 0.05),
            json!(recipe.measure.lambda),
        ),
        field(
            ["pack.k_n", "kₙ", "", "Factor on the number of bubbles, Eq. 1."],
            "Method",
            number(0.1, 10.0, 0.05),
            json!(recipe.pack.k_n),
        ),
        field(
            [
                "pack.diameter",
                "Bubble diameter",
                "l₀",
                "Diameter of the bubbles over the edge length.",
            ],
            "Method",
            number(0.5, 3.0, 0.05),
            json!(recipe.pack.diameter),
        ),
        field(
            [
                "regularize.node_range",
                "Node range",
                "",
                "Share by which the number of nodes may change.",
            ],
            "Method",
            number(0.0, 1.0, 0.05),
            json!(recipe.regularize.node_range),
        ),
    ]
}

fn field(
    [key, label, unit, help]: [&str; 4],
    group: &str,
    control: Control,
    value: Value,
) -> Field {
    Field {
        key: key.into(),
        label: label.into(),
        unit: unit.into(),
        help: help.into(),
        group: group.into(),
        control,
        value,
    }
}

fn number(min: f64, max: f64, step: f64) -> Control {
    Control::Number { min, max, step, optional: false }
}

fn optional(min: f64, max: f64, step: f64) -> Control {
    Control::Number { min, max, step, optional: true }
}

fn choice(options: &[(&str, &str)]) -> Control {
    let named = |&(name, description): &(&str, &str)| Named {
        name: name.into(),
        description: description.into(),
    };
    Control::Choice { options: options.iter().map(named).collect() }
}

/// The method of a recipe that came with a grid.
const FILE: &str = "file";

/// The recipe that these values make; what is not given stays as the method has it. The method `file` is the recipe
/// that came with a grid.
///
/// # Errors
/// [`Error::Option`] naming the field.
pub fn recipe(values: &Values, file: Option<&Recipe>) -> Result<Recipe> {
    let text = |key: &str| values.get(key).and_then(Value::as_str);
    let method = text("method").unwrap_or("default");
    let given = file.filter(|_| method == FILE);
    let base = given.map_or_else(|| Recipe::named(method), |r| Ok(r.clone()))?;
    let mut document = serde_json::to_value(base).map_err(|e| Error::Option(e.to_string()))?;
    let known = fields();
    for (key, value) in values {
        if !known.iter().any(|f| f.key == *key) {
            return Err(Error::Option(format!("there is no field `{key}`")));
        }
        let value = match key.as_str() {
            "method" | "vector" => continue,
            "edge_length" | "nodes" | "candidates" if value.is_null() => Value::Null,
            "anchors" if value.is_null() => json!([]),
            // What the file says of curvature or points is more than the form can tell.
            "size" | "direction" if given.is_some() && document[key]["kind"] == *value => continue,
            _ if value.is_null() => continue,
            "direction" if value == "vector" => vector(text("vector").unwrap_or_default())?,
            "size" | "direction" => json!({ "kind": value }),
            "smooth_input" | "accept_losses" => json!(value == "true"),
            "anchors" => points(value.as_str().unwrap_or_default())?,
            "nodes" | "candidates" | "seed" => whole(key, value)?,
            _ => value.clone(),
        };
        let path = format!("/{}", key.replace('.', "/"));
        if let Some(place) = document.pointer_mut(&path) {
            *place = value;
        }
    }
    let recipe: Recipe =
        serde_json::from_value(document).map_err(|e| Error::Option(format!("the recipe: {e}")))?;
    recipe.validate()?;
    Ok(recipe)
}

/// The values that make `recipe` again, together with the recipe itself as the method [`FILE`]. What the form has no
/// words for stays empty, which leaves it as it is.
pub fn values(recipe: &Recipe) -> Values {
    let document = json!(recipe);
    let triple = |xyz: &Value| {
        let numbers = xyz.as_array().into_iter().flatten().map(Value::to_string);
        numbers.collect::<Vec<_>>().join(", ")
    };
    let value = |field: Field| {
        let key = field.key;
        let at = |path: &str| document.pointer(path).cloned().unwrap_or_default();
        let plain = at(&format!("/{}", key.replace('.', "/")));
        let value = match key.as_str() {
            "method" => json!(FILE),
            "vector" => match &plain {
                _ if at("/direction/kind") == "vector" => json!(triple(&at("/direction/xyz"))),
                _ => Value::Null,
            },
            "size" | "direction" if plain["kind"] == "points" => Value::Null,
            "size" | "direction" => plain["kind"].clone(),
            "smooth_input" | "accept_losses" => json!(plain.to_string()),
            "anchors" => {
                let lines: Vec<String> =
                    plain.as_array().into_iter().flatten().map(triple).collect();
                json!(lines.join("\n"))
            }
            _ => plain,
        };
        (key, value)
    };
    fields().into_iter().map(value).collect()
}

fn whole(key: &str, value: &Value) -> Result<Value> {
    match value.as_f64() {
        Some(x) if x.fract() == 0.0 && (0.0..=9_007_199_254_740_991.0).contains(&x) => {
            Ok(json!(x as u64))
        }
        _ => Err(Error::Option(format!("{key} is {value}: it must be a whole number"))),
    }
}

fn vector(text: &str) -> Result<Value> {
    let xyz = numbers(text, "the direction's vector")?;
    Ok(json!({ "kind": "vector", "xyz": xyz }))
}

fn points(text: &str) -> Result<Value> {
    if text.len() > MOST_TEXT {
        return Err(Error::Option("there are too many anchors".into()));
    }
    let lines = text.lines().enumerate().filter(|(_, l)| !l.trim().is_empty());
    let points: Vec<[f64; 3]> = lines
        .map(|(k, l)| numbers(l, &format!("line {} of the anchors", k + 1)))
        .collect::<Result<_>>()?;
    Ok(json!(points))
}

fn numbers(text: &str, what: &str) -> Result<[f64; 3]> {
    let parts = text.split([',', ' ', ';', '\t']).filter(|p| !p.is_empty());
    let numbers: Option<Vec<f64>> =
        parts.map(|p| p.parse().ok().filter(|x: &f64| x.is_finite())).collect();
    numbers.and_then(|n| n.try_into().ok()).ok_or_else(|| {
        Error::Option(format!("{what} must be three numbers x, y, z, but is `{text}`"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_as_the_page_has_them_at_first_make_the_default_recipe() {
        let values: Values = fields().into_iter().map(|f| (f.key, f.value)).collect();
        assert_eq!(recipe(&values, None).unwrap(), Recipe::default());
    }

    #[test]
    fn a_recipe_comes_back_from_its_values_with_what_the_form_cannot_tell() {
        let mut given = Recipe::named("paper").unwrap();
        given.edge_length = Some(1.25);
        given.seed = 7;
        given.anchors = vec![[1.0, 2.0, 3.5], [0.0, -1.0, 0.125]];
        given.size = gridshell::recipe::Size::Curvature { range: [0.5, 1.5], strength: 0.3 };
        given.guides = vec![vec![[0.0; 3], [1.0, 0.0, 0.0]]];
        given.direction = gridshell::recipe::Direction::Vector { xyz: [1.0, 0.5, 0.0] };
        let values = values(&given);
        assert_eq!(recipe(&values, Some(&given)).unwrap(), given);
        let mut fewer = values;
        fewer.insert("anchors".into(), Value::Null);
        fewer.insert("edge_length".into(), Value::Null);
        let changed = recipe(&fewer, Some(&given)).unwrap();
        assert_eq!((changed.anchors.len(), changed.edge_length), (0, None));
        assert_eq!(changed.guides, given.guides);
    }

    #[test]
    fn every_option_of_every_choice_makes_a_recipe() {
        for field in fields() {
            let Control::Choice { options } = field.control else { continue };
            for option in options {
                let mut values = Values::from([(field.key.clone(), json!(option.name))]);
                values.insert("vector".into(), json!("1, 0, 0"));
                recipe(&values, None)
                    .unwrap_or_else(|e| panic!("{} {}: {e}", field.key, option.name));
            }
        }
    }

    #[test]
    fn what_is_no_value_is_refused_by_its_name() {
        for (key, value) in [
            ("edge_length", json!(-1.0)),
            ("seed", json!(1.5)),
            ("nodes", json!("many")),
            ("anchors", json!("1 2 3\n4 5")),
            ("border", json!(7)),
            ("guides", json!([])),
        ] {
            let values = Values::from([(key.to_owned(), value)]);
            let error = recipe(&values, None).unwrap_err().to_string();
            assert!(error.contains(key), "{key}: {error}");
        }
    }
}
