//! A grid as a picture: members coloured by their length, irregular nodes as in the paper's figures, black for
//! those with too few members (adjusted degree below 6) and white for those with too many. What is hidden by
//! panels stays hidden.

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
/// Lay a grid on `surface` by the default recipe and draw its plan to `file`.
pub fn plan(surface: &str, file: &Path) -> Result<(), String> {
    draw(&lay(&build::gridshell()?, &Order::plain(surface))?, View::Plan, file)
}

/// Draw a grid to `file`.
pub fn draw(laid: &Laid, view: View, file: &Path) -> Result<(), String> {
    let edge_length = laid.document["edge_length"].as_f64().ok_or("a run without edge length")?;
    let camera = view.camera(&laid.nodes);
    let places: Vec<[f64; 3]> = laid.nodes.iter().map(|&p| camera.see(p)).collect();
    let mut sheet = Sheet::new(&places, edge_length)?;
    for &panel in &laid.panels {
        sheet.panel(panel.map(|v| places[v]), brightness(laid, panel, camera.eye()));
    }
    let mut members = members(&laid.panels);
    // Far ones first.
    let depth = |m: &[usize; 2]| places[m[0]][2] + places[m[1]][2];
    members.sort_by(|a, b| depth(b).total_cmp(&depth(a)));
    for [a, b] in members {
        let length = laid.nodes[a].distance(laid.nodes[b]) / edge_length;
        sheet.member(places[a], places[b], length);
    }
    for node in laid.document["irregular"].as_array().into_iter().flatten() {
        let place = node["node"].as_u64().and_then(|v| places.get(v as usize));
        if let (Some(&place), Some(degree)) = (place, node["adjusted_degree"].as_i64()) {
            sheet.mark(place, degree - 6);
        }
    }
    legend::draw(&mut sheet);
    sheet.save(file)
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

/// From 0 to 1, by how the panel stands in the light and which side of it is seen.
fn brightness(laid: &Laid, panel: [usize; 3], eye: DVec3) -> f64 {
    let [a, b, c] = panel.map(|v| laid.nodes[v]);
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let lit = BRIGHT - SHADE * (1.0 - normal.dot(LIGHT.normalize()).abs());
    if normal.dot(eye - a) > 0.0 { lit } else { lit * BELOW }
}
