//! `gridshell inspect`: what a surface is.

use crate::Outcome;
use crate::args::Inspect;
use crate::failure::Failure;
use crate::{say, table};
use gridshell::io::{self, Opening};
use gridshell::recipe::Recipe;
use gridshell::run::SurfaceSummary;
use gridshell::surface::{Model, Sampling};
use serde::Serialize;

/// Carrier edges over the size of the model: fine enough to count loops and corners.
const FINENESS: f64 = 1.0 / 80.0;

/// Distance between carrier and surface over the size of the model.
const CHORD_ERROR: f64 = 1e-4;

/// The document of `--json`.
#[derive(Serialize)]
struct Document {
    schema: &'static str,
    version: &'static str,
    units: &'static str,
    surface: SurfaceSummary,
}

pub fn run(args: &Inspect) -> Result<Outcome, Failure> {
    let opening = Opening { sew: args.sew, unit: args.units };
    let model = io::open_with(&args.surface, &opening).map_err(Failure::of_input)?;
    let surface = model.surface(&sampling(&model))?;
    let summary = SurfaceSummary::new(&model, &surface);
    if args.json {
        let version = env!("CARGO_PKG_VERSION");
        say::json(&Document {
            schema: "gridshell.inspect/1",
            version,
            units: "m",
            surface: summary,
        })?;
    } else {
        say::result(&table::surface(&summary))?;
    }
    Ok(Outcome::Done)
}

fn sampling(model: &Model) -> Sampling {
    let size = model.size();
    let corner_angle = Recipe::default().corner_angle_deg.to_radians();
    Sampling { max_edge: size * FINENESS, chord_error: size * CHORD_ERROR, corner_angle }
}
