//! A grid as a picture: members coloured by their length, irregular nodes as in the paper's figures, black for
//! those with too few members (adjusted degree below 6) and white for those with too many. Panels are painted
//! from far to near, so that what is hidden stays hidden.

mod file;
mod legend;
mod sheet;
mod view;

pub use view::View;

use crate::build;
use crate::laid::{Laid, Order, lay};
use glam::DVec3;
use sheet::Sheet;
use std::path::Path;

/// Where the light comes from; need not be a unit vector.
const LIGHT: DVec3 = DVec3::new(-0.4, -0.3, 1.0);
/// Brightness of panels that face the light, and what is taken from those that stand along it.
const BRIGHT: f64 = 0.985;
const SHADE: f64 = 0.16;
/// Brightness of panels seen from below, over that from above.
const BELOW: f64 = 0.86;
/// Panels and members are painted in pieces, so many along a member: whole ones have no place in the order of
/// depths where two sheets are close.
const PIECES: u32 = 5;
/// Members and marks lie so far before their panels, over l0.
const MEMBERS_BEFORE: f64 = 0.12;
const MARKS_BEFORE: f64 = 0.25;

/// Lay a grid on `surface` by the default recipe and draw its plan to `file`.
pub fn plan(surface: &str, file: &Path) -> Result<(), String> {
    draw(&lay(&build::gridshell()?, &Order::plain(surface))?, View::Plan, file)
}

/// One thing to paint.
enum Item {
    /// A piece of a panel, and its brightness.
    Panel([[f64; 3]; 3], f64),
    /// A piece of a member, and the member's length over l0.
    Member([[f64; 3]; 2], f64),
    /// An irregular node, and what its adjusted degree is too large by.
    Mark([f64; 3], i64),
}

/// Draw a grid to `file`.
pub fn draw(laid: &Laid, view: View, file: &Path) -> Result<(), String> {
    let edge_length = laid.document["edge_length"].as_f64().ok_or("a run without edge length")?;
    let camera = view.camera(&laid.nodes);
    let places: Vec<[f64; 3]> = laid.nodes.iter().map(|&p| camera.see(p)).collect();
    let mut items = Vec::new();
    for &panel in &laid.panels {
        let bright = brightness(laid, panel, camera.eye());
        items.extend(pieces_of_panel(panel.map(|v| places[v])).map(|p| Item::Panel(p, bright)));
    }
    for [a, b] in members(&laid.panels) {
        let length = laid.nodes[a].distance(laid.nodes[b]) / edge_length;
        let pieces = pieces_of_member([places[a], places[b]]);
        items.extend(pieces.map(|p| Item::Member(p, length)));
    }
    let irregular = laid.document["irregular"].as_array().into_iter().flatten();
    items.extend(irregular.filter_map(|node| {
        let place = places.get(node["node"].as_u64()? as usize)?;
        Some(Item::Mark(*place, node["adjusted_degree"].as_i64()? - 6))
    }));
    // Far ones first.
    items.sort_by(|a, b| b.depth(edge_length).total_cmp(&a.depth(edge_length)));
    let mut sheet = Sheet::new(&places, edge_length)?;
    for item in items {
        match item {
            Item::Panel(corners, brightness) => sheet.panel(corners, brightness),
            Item::Member([a, b], length) => sheet.member(a, b, length),
            Item::Mark(at, excess) => sheet.mark(at, excess),
        }
    }
    legend::draw(&mut sheet);
    sheet.save(file)
}

impl Item {
    /// What the order of painting goes by, metres.
    fn depth(&self, edge_length: f64) -> f64 {
        match self {
            Item::Panel([a, b, c], _) => (a[2] + b[2] + c[2]) / 3.0,
            Item::Member([a, b], _) => f64::midpoint(a[2], b[2]) - MEMBERS_BEFORE * edge_length,
            Item::Mark(at, _) => at[2] - MARKS_BEFORE * edge_length,
        }
    }
}

/// Every member once.
fn members(panels: &[[usize; 3]]) -> Vec<[usize; 2]> {
    let sides = |p: &[usize; 3]| [[p[0], p[1]], [p[1], p[2]], [p[2], p[0]]];
    let ordered = |[a, b]: [usize; 2]| [a.min(b), a.max(b)];
    let mut members: Vec<[usize; 2]> = panels.iter().flat_map(sides).map(ordered).collect();
    members.sort_unstable();
    members.dedup();
    members
}

fn pieces_of_member([a, b]: [[f64; 3]; 2]) -> impl Iterator<Item = [[f64; 3]; 2]> {
    (0..PIECES).map(move |k| {
        [k, k + 1].map(|k| {
            let f = f64::from(k) / f64::from(PIECES);
            [0, 1, 2].map(|i| a[i] + f * (b[i] - a[i]))
        })
    })
}

fn pieces_of_panel([a, b, c]: [[f64; 3]; 3]) -> impl Iterator<Item = [[f64; 3]; 3]> {
    let at = move |i: u32, j: u32| {
        let [f, g] = [i, j].map(|k| f64::from(k) / f64::from(PIECES));
        [0, 1, 2].map(|k| a[k] + f * (b[k] - a[k]) + g * (c[k] - a[k]))
    };
    let cells = (0..PIECES).flat_map(|i| (0..PIECES - i).map(move |j| (i, j)));
    cells.flat_map(move |(i, j)| {
        let upright = [at(i, j), at(i + 1, j), at(i, j + 1)];
        let inverted = [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        std::iter::once(upright).chain((i + j + 1 < PIECES).then_some(inverted))
    })
}

/// From 0 to 1, by how the panel stands in the light and which side of it is seen.
fn brightness(laid: &Laid, panel: [usize; 3], eye: DVec3) -> f64 {
    let [a, b, c] = panel.map(|v| laid.nodes[v]);
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let lit = BRIGHT - SHADE * (1.0 - normal.dot(LIGHT.normalize()).abs());
    if normal.dot(eye - a) > 0.0 { lit } else { lit * BELOW }
}
