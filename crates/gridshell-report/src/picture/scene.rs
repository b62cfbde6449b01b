//! A grid as it is seen: panels, members and nodes from the farthest to the nearest.

use super::drawing::{Drawing, Rgb};
use super::frame::Frame;
use super::label::Labels;
use super::light::lit;
use super::view::{Camera, View};
use crate::colourings::{Colours, Element};
use gridshell::design::Design;

/// One thing to be drawn.
#[derive(Clone, Copy)]
pub enum Item {
    Panel(usize),
    Member(usize),
    Node(usize),
}

/// Sizes on paper.
pub struct Style {
    /// Width of members.
    pub member: f64,
    /// Radius of marked nodes.
    pub node: f64,
    /// Size of supports; none are drawn at 0.
    pub support: f64,
}

/// Members and nodes lie this share of the mean member length before the panels beside them.
const BEFORE: f64 = 0.35;
/// Members of the boundary, of creases and guides are so much wider.
const WIDE: f64 = 1.8;
pub const PANEL: Rgb = [0.965, 0.972, 0.978];
pub const MEMBER: Rgb = [0.42, 0.44, 0.46];
pub const INK: Rgb = [0.10, 0.11, 0.12];
pub const PAPER: Rgb = [1.0, 1.0, 1.0];
pub const SUPPORT: Rgb = [0.05, 0.45, 0.30];

impl Style {
    /// What suits members of this mean length on paper, on a sheet whose type is `type_size` high.
    pub fn of(member_length: f64, type_size: f64) -> Style {
        let node = (0.13 * member_length).clamp(0.12 * type_size, 0.6 * type_size);
        Style {
            member: (0.045 * member_length).clamp(0.04 * type_size, 0.17 * type_size),
            node,
            support: 1.1 * node,
        }
    }

    /// Finer lines, so that labels beside them can be read.
    pub fn beside(self, labels: &[Labels]) -> Style {
        if labels.is_empty() {
            return self;
        }
        let Style { member, node, support } = self;
        Style { member: 0.45 * member, node: 0.55 * node, support: 0.55 * support }
    }
}

/// Places of the nodes as the camera sees them, and all elements from the farthest to the nearest.
pub fn seen(design: &Design, camera: &Camera) -> (Vec<[f64; 3]>, Vec<Item>) {
    let schedule = &design.schedule;
    let seen: Vec<[f64; 3]> = schedule.nodes.xyz.iter().map(|&p| camera.see(p)).collect();
    let depth = |v: u32| seen[v as usize][2];
    let before = BEFORE * schedule.figures.length.spread.mean;
    let mut items: Vec<(f64, Item)> = Vec::new();
    for (k, t) in schedule.panels.nodes.iter().enumerate() {
        items.push((t.iter().map(|&v| depth(v)).sum::<f64>() / 3.0, Item::Panel(k)));
    }
    for (k, [a, b]) in schedule.members.ends.iter().enumerate() {
        items.push((f64::midpoint(depth(*a), depth(*b)) - before, Item::Member(k)));
    }
    for v in 0..seen.len() {
        items.push((seen[v][2] - 2.0 * before, Item::Node(v)));
    }
    // From the farthest to the nearest; at equal depth in their order.
    items.sort_by(|a, b| b.0.total_cmp(&a.0));
    (seen, items.into_iter().map(|(_, item)| item).collect())
}

/// Draw a grid.
pub fn draw(
    design: &Design,
    colours: Option<&Colours>,
    view: View,
    camera: &Camera,
    frame: &Frame,
    style: &Style,
    drawing: &mut Drawing,
) {
    let schedule = &design.schedule;
    let (members, panels) = (&schedule.members, &schedule.panels);
    let (seen, items) = seen(design, camera);
    let places: Vec<[f64; 2]> = seen.iter().map(|&s| frame.place(s)).collect();
    let place = |v: u32| places[v as usize];
    let colour = |element, k| colours.and_then(|c| c.of(element, k));
    let shaded = view != View::Plan;
    let supported = supported(design);
    for item in items {
        match item {
            Item::Panel(k) => {
                let t = panels.nodes[k];
                let plain = colour(Element::Panels, k).unwrap_or(PANEL);
                let at = schedule.nodes.xyz[t[0] as usize];
                let rgb = if shaded { lit(plain, panels.normal[k], at, camera) } else { plain };
                drawing.area(t.map(place).to_vec(), rgb);
            }
            Item::Member(k) => {
                let wide = members.boundary[k] || members.feature[k];
                let width = if wide { WIDE * style.member } else { style.member };
                let rgb = colour(Element::Members, k).unwrap_or(MEMBER);
                drawing.line(members.ends[k].map(place).to_vec(), width, rgb);
            }
            Item::Node(v) => {
                if supported[v] && style.support > 0.0 {
                    support(places[v], style.support, drawing);
                }
                mark(design, colour(Element::Nodes, v), v, places[v], style.node, drawing);
            }
        }
    }
}

/// The mark of a node: its colour, or at an irregular one black for too few members and white for too many. Irregular ones
/// have a rim.
fn mark(
    design: &Design,
    colour: Option<Rgb>,
    v: usize,
    at: [f64; 2],
    radius: f64,
    drawing: &mut Drawing,
) {
    let nodes = &design.schedule.nodes;
    if nodes.is_irregular(v) {
        let few = nodes.adjusted_degree[v] < gridshell::degree::REGULAR;
        let plain = if few { INK } else { PAPER };
        drawing.disc(at, radius, colour.unwrap_or(plain), INK);
    } else if let Some(colour) = colour {
        drawing.disc(at, radius, colour, colour);
    }
}

/// A triangle that stands below a supported node.
pub fn support([x, y]: [f64; 2], size: f64, drawing: &mut Drawing) {
    let foot = [[x, y], [x + 0.8 * size, y + 1.5 * size], [x - 0.8 * size, y + 1.5 * size]];
    drawing.area(foot.to_vec(), PAPER);
    drawing.line([foot[0], foot[1], foot[2], foot[0]].to_vec(), 0.2 * size, SUPPORT);
}

fn supported(design: &Design) -> Vec<bool> {
    let mut supported = vec![false; design.schedule.nodes.xyz.len()];
    for &v in &design.document.supports {
        supported[v as usize] = true;
    }
    supported
}
