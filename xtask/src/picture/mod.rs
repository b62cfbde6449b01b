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

/// Lay a grid on `surface` by the default recipe and draw its plan to `file`.
pub fn plan(surface: &str, file: &Path) -> Result<(), String> {
    draw(&lay(&build::gridshell()?, &Order::plain(surface))?, View::Plan, file)
}

/// One thing to paint.
enum Item {
    Panel(usize),
    /// An irregular node, with what its adjusted degree is too large by.
    Mark(usize, i64),
}

/// Draw a grid to `file`.
pub fn draw(laid: &Laid, view: View, file: &Path) -> Result<(), String> {
    let edge_length = laid.document["edge_length"].as_f64().ok_or("a run without edge length")?;
    let camera = view.camera(&laid.nodes);
    let places: Vec<[f64; 3]> = laid.nodes.iter().map(|&p| camera.see(p)).collect();
    let mut sheet = Sheet::new(&places, edge_length)?;
    for (_, item) in by_depth(laid, &places) {
        match item {
            Item::Panel(k) => {
                let panel = laid.panels[k];
                sheet.panel(panel.map(|v| places[v]), brightness(laid, panel, camera.eye()));
                for (a, b) in [(0, 1), (1, 2), (2, 0)].map(|(i, j)| (panel[i], panel[j])) {
                    let length = laid.nodes[a].distance(laid.nodes[b]) / edge_length;
                    sheet.member(places[a], places[b], length);
                }
            }
            Item::Mark(v, excess) => sheet.mark(places[v], excess),
        }
    }
    legend::draw(&mut sheet);
    sheet.save(file)
}

/// All panels and marks with their depths, far ones first; a mark lies on the nearest panel at its node.
fn by_depth(laid: &Laid, places: &[[f64; 3]]) -> Vec<(f64, Item)> {
    let mut nearest = vec![f64::INFINITY; places.len()];
    let mut items = Vec::new();
    for (k, panel) in laid.panels.iter().enumerate() {
        let depth = panel.map(|v| places[v][2]).iter().sum::<f64>() / 3.0;
        for &v in panel {
            nearest[v] = nearest[v].min(depth);
        }
        items.push((depth, Item::Panel(k)));
    }
    let irregular = laid.document["irregular"].as_array();
    for node in irregular.into_iter().flatten() {
        let (Some(v), Some(degree)) = (node["node"].as_u64(), node["adjusted_degree"].as_i64())
        else {
            continue;
        };
        let v = v as usize;
        items.push((nearest[v], Item::Mark(v, degree - 6)));
    }
    // Stable: marks stand behind panels in the list, so they are painted over those of the same depth.
    items.sort_by(|a, b| b.0.total_cmp(&a.0));
    items
}

/// From 0 to 1, by how the panel stands in the light and which side of it is seen.
fn brightness(laid: &Laid, panel: [usize; 3], eye: DVec3) -> f64 {
    let [a, b, c] = panel.map(|v| laid.nodes[v]);
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let lit = BRIGHT - SHADE * (1.0 - normal.dot(LIGHT.normalize()).abs());
    if normal.dot(eye - a) > 0.0 { lit } else { lit * BELOW }
}
