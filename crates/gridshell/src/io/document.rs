//! What a grid file of gridshell's own holds: the grid, and what it takes to make it again. The schema is described in
//! `docs/gridshell-file.md`.

use super::Reference;
use crate::grid::{Grid, Place};
use crate::recipe::Recipe;
use crate::run::Run;
use crate::surface::{ChainPoint, Origin, SurfacePoint};
use glam::DVec3;
use rstar::RTree;
use rstar::primitives::GeomWithData;
use serde::{Deserialize, Serialize};

/// Name and version of the schema.
pub const SCHEMA: &str = "gridshell.grid/1";

/// A grid with its history. Metres.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Document {
    /// [`SCHEMA`].
    pub schema: String,
    /// Version of the program that made it.
    pub version: String,
    /// Unit of all lengths: `m`.
    pub units: String,
    /// Name of the surface.
    pub name: String,
    /// Where the design surface is; None where it is not known.
    pub surface: Option<Reference>,
    /// Seed of every random choice; None where no run is known.
    pub seed: Option<u64>,
    /// Member length that was aimed at; None where no run is known.
    pub edge_length: Option<f64>,
    /// The recipe, complete; None where no run is known.
    pub recipe: Option<Recipe>,
    /// Positions of the nodes, in the coordinates of the surface's file.
    pub nodes: Vec<[f64; 3]>,
    /// Where each node sits on the surface; empty where that is not known.
    pub places: Vec<PlaceRecord>,
    /// Nodes of the panels, counter-clockwise seen from outside, the lowest first; ascending.
    pub panels: Vec<[u32; 3]>,
    /// Members on creases and guides, the lower node first; ascending.
    pub features: Vec<[u32; 2]>,
    /// Nodes at the recipe's anchors, in its order.
    pub anchors: Vec<u32>,
    /// Supported nodes, ascending.
    pub supports: Vec<u32>,
    /// What was edited by hand, in its order. Kept as it is.
    pub edits: Vec<serde_json::Value>,
    /// What is wrong with the grid, where it was kept though it is not valid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub invalid: Option<String>,
}

/// A place on the surface's carrier, which surface and recipe give anew, bit for bit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PlaceRecord {
    /// Triangle and barycentric coordinates.
    Interior(u32, [f64; 3]),
    /// Loop and arc length.
    Boundary(u32, f64),
    /// Loop and arc length.
    Corner(u32, f64),
    /// Feature and arc length.
    Feature(u32, f64),
    /// Triangle and barycentric coordinates.
    Fixed(u32, [f64; 3]),
}

impl Document {
    /// A grid of which nothing else is known, whose coordinates have this origin.
    pub fn of_grid(name: &str, grid: &Grid, origin: Origin) -> Document {
        let mut panels: Vec<[u32; 3]> = grid.mesh.triangles().collect();
        panels.sort_unstable();
        let mut features: Vec<[u32; 2]> = grid
            .mesh
            .edges()
            .filter(|&(a, b)| grid.mesh.is_feature_edge(a, b))
            .map(|(a, b)| [a, b])
            .collect();
        features.sort_unstable();
        Document {
            schema: SCHEMA.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            units: "m".to_owned(),
            name: name.to_owned(),
            surface: None,
            seed: None,
            edge_length: None,
            recipe: None,
            nodes: grid.xyz.iter().map(|&p| origin.world(p).to_array()).collect(),
            places: Vec::new(),
            panels,
            features,
            anchors: Vec::new(),
            supports: Vec::new(),
            edits: Vec::new(),
            invalid: None,
        }
    }

    /// The grid of a run, supported at these nodes; where its surface is remains to be said.
    pub fn of_run(run: &Run, supports: Vec<u32>) -> Document {
        let grid = &run.grid;
        let nodes = grid.xyz.iter().zip(0_u32..);
        let nodes = RTree::bulk_load(
            nodes.map(|(p, v)| GeomWithData::new(p.to_array(), v)).collect::<Vec<_>>(),
        );
        // Of nodes as near as each other the first.
        let anchor = |p: &[f64; 3]| {
            let p = run.origin.local(DVec3::from_array(*p)).to_array();
            let (_, reach) = nodes.nearest_neighbor_with_distance_2(p)?;
            nodes.locate_within_distance(p, reach).map(|n| n.data).min()
        };
        Document {
            seed: Some(run.seed),
            edge_length: Some(run.edge_length),
            recipe: Some(run.recipe.clone()),
            places: grid.places.iter().map(|&p| p.into()).collect(),
            anchors: run.recipe.anchors.iter().filter_map(anchor).collect(),
            supports,
            invalid: run.invalid(),
            ..Document::of_grid(&run.surface.name, grid, run.origin)
        }
    }
}

impl From<Place> for PlaceRecord {
    fn from(place: Place) -> PlaceRecord {
        match place {
            Place::Interior(p) => PlaceRecord::Interior(p.triangle, p.bary),
            Place::Boundary(c) => PlaceRecord::Boundary(c.chain, c.s),
            Place::Corner(c) => PlaceRecord::Corner(c.chain, c.s),
            Place::Feature(c) => PlaceRecord::Feature(c.chain, c.s),
            Place::Fixed(p) => PlaceRecord::Fixed(p.triangle, p.bary),
        }
    }
}

impl From<PlaceRecord> for Place {
    fn from(record: PlaceRecord) -> Place {
        match record {
            PlaceRecord::Interior(triangle, bary) => {
                Place::Interior(SurfacePoint { triangle, bary })
            }
            PlaceRecord::Boundary(chain, s) => Place::Boundary(ChainPoint { chain, s }),
            PlaceRecord::Corner(chain, s) => Place::Corner(ChainPoint { chain, s }),
            PlaceRecord::Feature(chain, s) => Place::Feature(ChainPoint { chain, s }),
            PlaceRecord::Fixed(triangle, bary) => Place::Fixed(SurfacePoint { triangle, bary }),
        }
    }
}
