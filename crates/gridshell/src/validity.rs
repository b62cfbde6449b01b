//! What is promised of every grid that is written, and where a grid breaks it.
//!
//! A grid is valid if it is a manifold of the surface's Euler characteristic, lies on the surface with its border on
//! the surface's, covers its area, has no two nodes at (nearly) one place, no panel that is flat or folded over, and
//! no member that leaps from sheet to sheet. What the surface itself demands (borders that touch, corners beside one
//! another, a bend within a member) is not a fault, but told by its place.

use crate::grid::{Grid, Place};
use crate::merit;
use crate::stages::measure::{Quality, bridges, is_folded};
pub use crate::surface::NEAREST;
use crate::surface::{Chain, Surface};
use crate::words::counted;
use glam::DVec3;
use rstar::RTree;
use rstar::primitives::GeomWithData;
use serde::Serialize;

/// A panel of a lower shape q than this has no area to speak of: its least angle is below a thirtieth of a degree.
pub const FLAT: f64 = 1e-3;
/// Area of the panels over that of the surface. Chords lose area where the surface bends within a member; a quarter
/// lost is another shape. More area than the surface has is gained by folding only.
pub const AREA: [f64; 2] = [0.75, 1.1];
/// Nodes are no farther than this, over l0, from the surface, and those at the border from its border. Far above
/// rounding, single precision and what files leave between edges and patches; far below what can be built.
pub const OFF: f64 = 1e-3;
/// The surface turns over within a panel whose corners have normals of a lower cosine (seventy degrees).
const SHARP: f64 = 0.35;
/// Two nodes on a loop are apart along it if the way there is longer than this many times the distance between them.
const AROUND: f64 = 2.0;
/// Nodes on two borders no farther apart than this, over l0, are at one place.
const TOUCHING: f64 = 1e-6;
/// Pairs of near nodes on sheets that face the same way for which the way between them is looked for. Each look may
/// cross thousands of triangles; a grid with more such pairs is none, whatever the surface is like.
const MOST_WALKS: usize = 32;
/// Faults and remarks beyond this many are only counted.
const MOST_TOLD: usize = 8;

/// What can be wrong with a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Its panels are not a manifold.
    Manifold,
    /// Its Euler characteristic is not the surface's.
    Topology,
    /// Two nodes are (nearly) at one place.
    Near,
    /// A panel is folded over, or faces against the surface.
    Folded,
    /// A panel has no area.
    Flat,
    /// A member leaps from one sheet of the surface to another.
    Bridging,
    /// A node is off the surface.
    OffSurface,
    /// A node at the border is off the surface's border.
    OffBoundary,
    /// Its area is not the surface's.
    Area,
}

/// One thing that is wrong with a grid, or that the surface demands though it would be wrong elsewhere.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fault {
    /// What.
    pub kind: Kind,
    /// Where, metres in the surface's file.
    pub at: [f64; 3],
    /// The nodes concerned; none where it is the whole grid.
    pub nodes: Vec<u32>,
    /// In words.
    pub message: String,
}

/// What a look at a whole grid gives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Validity {
    /// What is wrong with it; nothing if it is valid.
    pub faults: Vec<Fault>,
    /// What the surface demands.
    pub demanded: Vec<Fault>,
}

impl Kind {
    /// `n` of them, in words.
    fn counted(self, n: usize) -> String {
        let with = |noun: &str, rest: &str| format!("{}{rest}", counted(n, noun));
        match self {
            Kind::Near => with("pair", " of nodes at nearly one place"),
            Kind::Folded => with("folded panel", ""),
            Kind::Flat => with("panel", " without area"),
            Kind::Bridging => with("bridging member", ""),
            Kind::OffSurface => with("node", " off the surface"),
            Kind::OffBoundary => with("node", " off the border"),
            Kind::Manifold | Kind::Topology | Kind::Area => with("fault", " of the whole grid"),
        }
    }
}

impl Validity {
    /// Look at `grid` on `surface`, where members of `length` metres were wanted and which measures `quality`.
    pub fn of(grid: &Grid, surface: &Surface, length: f64, quality: &Quality) -> Validity {
        if let Err(message) = grid.mesh.check() {
            let at = grid.xyz.first().copied().unwrap_or_default();
            let at = surface.origin.world(at);
            return Validity {
                faults: vec![fault(Kind::Manifold, at, &[], message)],
                ..Validity::default()
            };
        }
        let mut found = Validity::default();
        found.whole(grid, surface, quality);
        found.near(grid, surface, length);
        found.panels(grid, surface);
        if quality.bridging_members > 0 {
            for (a, b) in bridges(grid, surface, length) {
                let at = grid.xyz[a as usize].midpoint(grid.xyz[b as usize]);
                let message =
                    format!("the member {a}-{b} leaps from one sheet of the surface to another");
                found.faults.push(fault(Kind::Bridging, at, &[a, b], message));
            }
        }
        if quality.surface_deviation.max(quality.boundary_deviation) > OFF {
            found.off(grid, surface, length);
        }
        for fault in found.faults.iter_mut().chain(&mut found.demanded) {
            fault.at = surface.origin.world(fault.at.into()).to_array();
        }
        found
    }

    /// Whether nothing is wrong.
    pub fn is_valid(&self) -> bool {
        self.faults.is_empty()
    }

    /// All faults in one sentence: how many of each kind, and where the first ones are.
    pub fn summary(&self) -> String {
        summary(&self.faults)
    }

    /// What the user should know: each fault and each remark by its place, of many the first ones and their number.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = listed(&self.faults, "not valid: ");
        warnings.extend(listed(&self.demanded, ""));
        warnings
    }

    /// What concerns the grid as a whole.
    fn whole(&mut self, grid: &Grid, surface: &Surface, quality: &Quality) {
        let at = grid.xyz.first().copied().unwrap_or_default();
        let (got, wanted) = (quality.euler_characteristic, surface.euler_characteristic());
        if got != wanted {
            let message = format!("Euler characteristic {got}, but the surface has {wanted}");
            self.faults.push(fault(Kind::Topology, at, &[], message));
        }
        let share = quality.area_ratio;
        if !(AREA[0]..=AREA[1]).contains(&share) {
            let message = format!("the panels have {:.1} % of the surface's area", 100.0 * share);
            self.faults.push(fault(Kind::Area, at, &[], message));
        }
    }

    fn near(&mut self, grid: &Grid, surface: &Surface, length: f64) {
        let mut walks = MOST_WALKS;
        for Pair { nodes: [a, b], apart } in near_pairs(grid, surface, length) {
            let at = grid.xyz[a as usize].midpoint(grid.xyz[b as usize]);
            let pair = format!("nodes {a} and {b} are {} apart", metres(apart));
            match demand(grid, surface, length, [a, b], apart, &mut walks) {
                None => self.faults.push(fault(Kind::Near, at, &[a, b], pair)),
                Some(why) => {
                    let message = format!("{pair}, as {why}");
                    self.demanded.push(fault(Kind::Near, at, &[a, b], message));
                }
            }
        }
    }

    fn panels(&mut self, grid: &Grid, surface: &Surface) {
        let slots = grid.mesh.slots();
        let mut normals = vec![DVec3::ZERO; slots];
        for v in grid.mesh.vertices() {
            normals[v as usize] = grid.places[v as usize].normal(surface);
        }
        let normal = |v: u32| normals[v as usize];
        for t in grid.mesh.triangles() {
            let p = t.map(|v| grid.xyz[v as usize]);
            let name = format!("{}-{}-{}", t[0], t[1], t[2]);
            let at = (p[0] + p[1] + p[2]) / 3.0;
            if merit::shape(p) < FLAT {
                self.faults.push(fault(Kind::Flat, at, &t, format!("panel {name} has no area")));
            } else if is_folded(grid, normal, t) {
                let turns = |k: usize| normal(t[k]).dot(normal(t[(k + 1) % 3])) < SHARP;
                if (0..3).any(turns) {
                    let message =
                        format!("panel {name} is folded, as the surface turns over within it");
                    self.demanded.push(fault(Kind::Folded, at, &t, message));
                } else {
                    self.faults.push(fault(
                        Kind::Folded,
                        at,
                        &t,
                        format!("panel {name} is folded over"),
                    ));
                }
            }
        }
    }

    fn off(&mut self, grid: &Grid, surface: &Surface, length: f64) {
        for v in grid.mesh.vertices() {
            let (place, xyz) = (&grid.places[v as usize], grid.xyz[v as usize]);
            let found = [
                (Kind::OffSurface, "surface", place.off_surface(surface, xyz)),
                (Kind::OffBoundary, "border", place.off_boundary(surface, xyz)),
            ];
            for (kind, what, off) in found {
                if off.is_nan() || off > OFF * length {
                    let message = format!("node {v} is {} off the {what}", metres(off));
                    self.faults.push(fault(kind, xyz, &[v], message));
                }
            }
        }
    }
}

/// These faults in one sentence: how many of each kind, and where the first ones are.
pub fn summary(faults: &[Fault]) -> String {
    let of_all = faults.iter().filter(|f| f.nodes.is_empty()).map(|f| f.message.clone());
    let mut what: Vec<String> = of_all.collect();
    let mut kinds: Vec<Kind> =
        faults.iter().filter(|f| !f.nodes.is_empty()).map(|f| f.kind).collect();
    kinds.sort_unstable();
    what.extend(kinds.chunk_by(|a, b| a == b).map(|k| k[0].counted(k.len())));
    let mut places: Vec<String> = Vec::new();
    for place in faults.iter().filter(|f| !f.nodes.is_empty()).map(|f| told(f.at)) {
        if places.len() < MOST_TOLD && !places.contains(&place) {
            places.push(place);
        }
    }
    if kinds.is_empty() {
        return what.join(", ");
    }
    let first = if kinds.len() > places.len() { ", the first near " } else { ", near " };
    what.join(", ") + first + &places.join(", ")
}

fn fault(kind: Kind, at: DVec3, nodes: &[u32], message: String) -> Fault {
    Fault { kind, at: at.to_array(), nodes: nodes.to_vec(), message }
}

/// A place in words.
pub fn told(at: [f64; 3]) -> String {
    format!("({:.3}, {:.3}, {:.3})", at[0], at[1], at[2])
}

/// A distance in words, however small.
pub fn metres(x: f64) -> String {
    if x >= 1e-3 || x == 0.0 { format!("{x:.3} m") } else { format!("{x:.1e} m") }
}

fn listed(faults: &[Fault], mark: &str) -> Vec<String> {
    let line = |f: &Fault| format!("{mark}{}, near {}", f.message, told(f.at));
    let mut lines: Vec<String> = faults.iter().take(MOST_TOLD).map(line).collect();
    if faults.len() > MOST_TOLD {
        lines.push(format!("{mark}and {} more such places", faults.len() - MOST_TOLD));
    }
    lines
}

/// Two nodes that are nearly at one place.
pub struct Pair {
    /// The lower one first.
    pub nodes: [u32; 2],
    /// Distance between them, metres.
    pub apart: f64,
}

/// All pairs of nodes nearer to one another than [`NEAREST`], ascending.
pub fn near_pairs(grid: &Grid, surface: &Surface, length: f64) -> Vec<Pair> {
    let node = |v: u32| GeomWithData::new(grid.xyz[v as usize].to_array(), v);
    let tree = RTree::bulk_load(grid.mesh.vertices().map(node).collect());
    let largest = surface.scale.iter().copied().fold(1.0, f64::max);
    let reach = NEAREST * length * largest;
    let mut pairs = Vec::new();
    for a in grid.mesh.vertices() {
        let around = tree.locate_within_distance(grid.xyz[a as usize].to_array(), reach * reach);
        for b in around.map(|n| n.data).filter(|&b| b > a) {
            let apart = grid.length(a, b);
            if apart < NEAREST * length * grid.scale(surface, a, b) {
                pairs.push(Pair { nodes: [a, b], apart });
            }
        }
    }
    pairs.sort_by_key(|p| p.nodes);
    pairs
}

/// Why the surface demands that these nodes be so near one another; None where it does not.
fn demand(
    grid: &Grid,
    surface: &Surface,
    length: f64,
    [a, b]: [u32; 2],
    apart: f64,
    walks: &mut usize,
) -> Option<&'static str> {
    let (p, q) = (&grid.places[a as usize], &grid.places[b as usize]);
    let fixed = p.is_fixed() && q.is_fixed();
    if let (Some(p), Some(q)) = (on_loop(p), on_loop(q)) {
        let chain = &surface.loops[p.0];
        let around = way_round(chain, p.1, q.1);
        return match p.0 == q.0 {
            false if apart <= TOUCHING * length => Some("two borders touch there"),
            false => Some("two borders are that near"),
            true if chain.length() < 6.0 * NEAREST * length => Some("the opening is that small"),
            true if around > (AROUND * apart).max(NEAREST * length) => {
                Some("the surface is that narrow")
            }
            true => fixed.then_some("both are corners"),
        };
    }
    if fixed {
        return Some("both are fixed");
    }
    let beside =
        grid.mesh.adjacent(a, b) || grid.mesh.ring(a).iter().any(|&c| grid.mesh.adjacent(c, b));
    if beside {
        return None;
    }
    let [m, n] = [p, q].map(|place| place.normal(surface));
    let apart_by_sheet = m.dot(n) < SHARP || {
        *walks = walks.checked_sub(1)?;
        let (s, t) = (p.surface_point(surface), q.surface_point(surface));
        let walked = surface.carrier.follow(&s, grid.xyz[b as usize]);
        let off = surface.carrier.xyz(&walked).distance(surface.carrier.xyz(&t));
        off >= 0.5 * apart.max(OFF * length)
    };
    apart_by_sheet.then_some("two sheets of the surface are that near")
}

/// The loop and arc length of a node at the border.
fn on_loop(place: &Place) -> Option<(usize, f64)> {
    match place {
        Place::Boundary(c) | Place::Corner(c) => Some((c.chain as usize, c.s)),
        Place::Interior(_) | Place::Feature(_) | Place::Fixed(_) => None,
    }
}

/// The shorter way from one place on a loop to another, metres.
fn way_round(chain: &Chain, s: f64, t: f64) -> f64 {
    let ahead = chain.wrap(t - s);
    ahead.min(chain.length() - ahead)
}
