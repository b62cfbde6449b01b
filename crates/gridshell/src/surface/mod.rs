//! The design surface: what every input becomes.
//!
//! A *carrier* (fine, manifold, oriented triangle mesh, for walking) with the exact trimmed patches
//! behind it, where the input had them. Boundary loops are [`Chain`]s of carrier vertices with the
//! exact curves behind them. Metres throughout.
//!
//! Each room uses only rooms above it; the [`Surface`] itself, which all of them know, stands in this file.
//!
//! | room | what lives there | may use |
//! |---|---|---|
//! | `source` | what a file says of itself | – |
//! | `origin` | where local coordinates have their origin | – |
//! | `sampling` | how finely a model is sampled | – |
//! | `exact` | patches and curves: splines, derivatives, offsets, closest points, areas | – |
//! | `brep` | the trimmed model of CAD files, and what sewing did to it | `exact`, `origin`, `source` |
//! | `model` | a B-rep or a polygon mesh; its size; put elsewhere | `brep`, `exact`, `origin`, `source` |
//! | `builtin` | surfaces by name | `brep`, `exact`, `model` |
//! | `carrier` | the mesh to walk on, chains of its edges, lengths along them, nearest places, the border, the box | `exact` |
//! | `polygon` | a mesh as surface: triangles of polygons, caps, halving | `carrier`, `model`, `sampling` |
//! | `smooth` | a fine mesh through the vertices of a coarse one | `carrier`, `model`, `polygon` |
//! | `tessellate` | a B-rep as surface: edges sampled, faces trimmed, filled, woven, refined, turned alike, numbered | `brep`, `carrier`, `exact`, `model`, `origin`, `sampling` |
//! | `sew` | one edge where faces only touch | `brep`, `exact`, `model`, `origin`, `source`, `tessellate` |
//! | `fold` | faces parted along their folds | `brep`, `exact`, `model`, `sampling`, `tessellate` |
//! | `features` | creases, guides and anchors cut in and gathered; dense ones thinned; the cutter | `carrier`, `exact`, `origin` |
//! | `fields` | charts, wanted lengths and directions, sharp bends | `carrier` |
//! | `symmetry` | turns and mirrorings; the part between two planes | `carrier`, `exact`, `features` |
//! | `parts` | the parts of a model; surfaces side by side | `brep`, `carrier`, `model`, `source` |

pub mod brep;
pub mod builtin;
pub mod carrier;
pub mod exact;
pub mod features;
pub mod fields;
mod fold;
pub mod model;
mod origin;
pub mod parts;
pub(crate) mod polygon;
mod sampling;
pub mod sew;
pub mod smooth;
pub mod source;
pub mod symmetry;
pub mod tessellate;

pub use brep::{Brep, Sewing};
pub use carrier::{Carrier, Chain, ChainPoint, Locator, Ruler, SurfacePoint};
pub use exact::{Curve, OffsetSurface, Shape, nurbs};
pub use features::Fixtures;
pub use fields::chart;
pub use fold::split_folds;
pub use model::{Model, PolygonMesh, Smoothing};
pub use origin::Origin;
pub use sampling::Sampling;
pub use sew::sew;
pub use smooth::Smooth;
pub use source::{Loss, Object, Source, Unit};
pub use symmetry::{Group, Motion, Symmetries};
pub use tessellate::tessellate;

pub(crate) use tessellate::bound;

use carrier::track::Tracks;
use glam::DVec3;

/// What runs so many times as far away from all else in a file as that is long comes from a wrong number: a face from the
/// model's edges, a vertex from all others. Sound models stay within two; a wrong digit in front that gets by costs as
/// many times its triangles.
pub(crate) const FARTHEST: f64 = 64.0;
/// Nodes nearer to one another than this, over the length wanted there, count as one. Larger, and details of a border
/// that can well be built would be left out; smaller, and members shorter than a node is wide would pass.
pub const NEAREST: f64 = 0.05;

/// A design surface, ready to carry a grid.
#[derive(Clone)]
pub struct Surface {
    /// Built-in name or file stem.
    pub name: String,
    /// Fine triangulation for walking.
    pub carrier: Carrier,
    /// Boundary loops, closed, surface to their left seen from outside.
    pub loops: Vec<Chain>,
    /// Stretches of features, cut at every fixed node on them. What ends them on the boundary is among the
    /// corners of its loop, what ends them inside among `fixed`.
    pub features: Vec<Chain>,
    /// Carrier vertices inside that are fixed nodes: anchors, and ends, junctions and corners of features.
    pub fixed: Vec<SurfacePoint>,
    /// Exact geometry of each patch, indexed by `carrier.patch`; empty where the input was a mesh.
    pub shapes: Vec<Shape>,
    /// Exact edge curves, indexed by the chains' segments; empty where the input was a mesh.
    pub curves: Vec<Curve>,
    /// Wanted length at each carrier vertex over the mean one, l0; empty where it is the same everywhere.
    pub scale: Vec<f64>,
    /// Wanted direction of members at each carrier vertex, of unit length in the tangent plane (zero where there
    /// is none); empty where any will do.
    pub direction: Vec<DVec3>,
    /// Area in square metres, integrated over the exact patches.
    pub area: f64,
    /// Where its coordinates have their origin in those of its file.
    pub origin: Origin,
    /// Carrier edges on model edges or features.
    tracks: Tracks,
}

/// What a stop is told as while a carrier is made.
pub(crate) const PREPARING: &str = "preparing the surface";

impl Surface {
    /// A carrier and its loops, with no patches behind it and nothing fixed or wanted.
    fn bare(name: String, carrier: Carrier, loops: Vec<Chain>, area: f64) -> Surface {
        Surface {
            name,
            carrier,
            loops,
            features: Vec::new(),
            fixed: Vec::new(),
            shapes: Vec::new(),
            curves: Vec::new(),
            scale: Vec::new(),
            direction: Vec::new(),
            area,
            origin: Origin::default(),
            tracks: Tracks::new(),
        }
    }

    /// V - E + F of the carrier.
    pub fn euler_characteristic(&self) -> i64 {
        let faces = self.carrier.triangles.len();
        let open = self.carrier.neighbors.iter().flatten().filter(|&&n| n == carrier::NONE).count();
        let edge_sides = 3 * faces + open;
        self.carrier.points.len() as i64 - (edge_sides / 2) as i64 + faces as i64
    }

    /// The exact point of the design surface that the carrier point stands for: the patch evaluated at
    /// the interpolated parameters. On a mesh, the carrier point itself.
    pub fn exact(&self, point: &SurfacePoint) -> DVec3 {
        let t = point.triangle as usize;
        match self.shapes.get(self.carrier.patch[t] as usize) {
            Some(shape) => shape.point(self.carrier.uv_at(point)),
            None => self.carrier.xyz(point),
        }
    }

    /// Distance of `xyz` from the exact surface near the carrier point `point`: to its [`foot`](Surface::foot).
    pub fn deviation(&self, point: &SurfacePoint, xyz: DVec3) -> f64 {
        self.foot(point, xyz).distance(xyz)
    }

    /// The foot of `xyz` on the exact surface near the carrier point `point`: on the patch of that point's
    /// triangle, or of one beside it where that is nearer; beyond the border on the border. On a mesh, the carrier point.
    pub fn foot(&self, point: &SurfacePoint, xyz: DVec3) -> DVec3 {
        let carrier = &self.carrier;
        let patch = |t: u32| carrier.patch[t as usize];
        let on = |p: &SurfacePoint| {
            let shape = self.shapes.get(patch(p.triangle) as usize)?;
            Some(shape.project(carrier.uv_at(p), xyz).1)
        };
        let Some(own) = on(point) else { return carrier.xyz(point) };
        // The carrier's edges cut corners of those between patches: a point just beyond one may be nearest to the
        // triangle before it.
        let beside = carrier.neighbors[point.triangle as usize].into_iter();
        let others = beside.filter(|&t| t != carrier::NONE && patch(t) != patch(point.triangle));
        let foot = others
            .filter_map(|triangle| on(&SurfacePoint { triangle, bary: [1.0 / 3.0; 3] }))
            .fold(own, |a, b| if b.distance(xyz) < a.distance(xyz) { b } else { a });
        // Patches go on past their trims.
        if self.beyond(point, foot).is_some() {
            return self.beyond(point, xyz).map_or(foot, |border| border.foot);
        }
        foot
    }
}
