//! Numbers of nodes, members and panels, as schedules have them: on the nodes, along the members and in the middle of the
//! panels, so large that neighbours do not touch. What is hidden or seen almost edge on gets none.

use super::drawing::{Anchor, Drawing, Mark, Rgb, Text};
use super::frame::Frame;
use super::glyphs;
use super::hidden::Cover;
use super::scene::{INK, PAPER};
use super::view::Camera;
use crate::colourings::{Colours, Element};
use gridshell::degree::REGULAR;
use gridshell::design::Design;
use gridshell::math::trig;

/// What is written on the elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Labels {
    /// N0, N1, ... as in schedules.
    Nodes,
    /// M0, M1, ...
    Members,
    /// P0, P1, ...
    Panels,
}

const OF_MEMBERS: Rgb = [0.10, 0.25, 0.60];
const OF_PANELS: Rgb = [0.45, 0.30, 0.10];
/// Letters need so much height, and labels that room at either end, over the size of the type.
const HEIGHT: f64 = 0.95;
const ROOM: f64 = 0.3;
/// Type is at most this share of a member's length.
const LARGEST: f64 = 0.2;
/// Type of members over the radius of the circle in a panel beside them, at most.
const BESIDE: f64 = 0.7;
/// Elements that would need a smaller share of the usual type get no label.
const LEAST: f64 = 0.4;
/// So many of a hundred members are shorter than the one that the usual type suits.
const SHORTER: usize = 20;

/// What all labels of one view share.
struct Writing<'a> {
    design: &'a Design,
    /// Places of the nodes on the paper.
    places: Vec<[f64; 2]>,
    /// Lengths of the members on the paper.
    lengths: Vec<f64>,
    /// Radii of the circles in the panels.
    radii: Vec<f64>,
    /// The widest label of each kind over the size of its type; 0 for kinds that are not asked for.
    node: f64,
    member: f64,
    panel: f64,
    /// The usual size of type.
    size: f64,
}

/// Write the numbers that are asked for, at most in this size.
pub fn draw(
    design: &Design,
    labels: &[Labels],
    colours: Option<&Colours>,
    camera: &Camera,
    frame: &Frame,
    largest: f64,
    drawing: &mut Drawing,
) {
    let schedule = &design.schedule;
    let seen: Vec<[f64; 3]> = schedule.nodes.xyz.iter().map(|&p| camera.see(p)).collect();
    let places = seen.iter().map(|&s| frame.place(s)).collect();
    let writing = Writing::new(design, labels, places, largest);
    let cover = Cover::new(design, &seen);
    let middle = |nodes: &[u32]| {
        let all = nodes.iter().map(|&v| seen[v as usize]);
        let sum = all.fold([0.0; 3], |s, p| [s[0] + p[0], s[1] + p[1], s[2] + p[2]]);
        sum.map(|x| x / nodes.len() as f64)
    };
    if labels.contains(&Labels::Panels) {
        let shown = |t: &[u32; 3]| !cover.hides(middle(t));
        for (k, t) in schedule.panels.nodes.iter().enumerate().filter(|(_, t)| shown(t)) {
            writing.panel(k, *t, drawing);
        }
    }
    if labels.contains(&Labels::Members) {
        let shown = |ends: &[u32; 2]| !cover.hides(middle(ends));
        let room = writing.room_beside_members();
        for (k, ends) in schedule.members.ends.iter().enumerate().filter(|(_, e)| shown(e)) {
            writing.member(k, *ends, room[k], drawing);
        }
    }
    if labels.contains(&Labels::Nodes) {
        let shortest = writing.shortest();
        for v in (0..seen.len()).filter(|&v| !cover.hides(seen[v])) {
            let colour = colours.and_then(|c| c.of(Element::Nodes, v));
            writing.node(v, shortest[v], colour, drawing);
        }
    }
}

impl<'a> Writing<'a> {
    fn new(
        design: &'a Design,
        labels: &[Labels],
        places: Vec<[f64; 2]>,
        largest: f64,
    ) -> Writing<'a> {
        let schedule = &design.schedule;
        let apart = |a: u32, b: u32| {
            let [a, b] = [places[a as usize], places[b as usize]];
            ((a[0] - b[0]).powi(2) + (a[1] - b[1]).powi(2)).sqrt()
        };
        let lengths: Vec<f64> = schedule.members.ends.iter().map(|&[a, b]| apart(a, b)).collect();
        let inside = |&[a, b, c]: &[u32; 3]| {
            let [p, q, r] = [a, b, c].map(|v| places[v as usize]);
            let double = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
            let around = apart(a, b) + apart(b, c) + apart(c, a);
            double.abs() / around.max(f64::MIN_POSITIVE)
        };
        let radii = schedule.panels.nodes.iter().map(inside).collect();
        let widest = |kind: Labels, letter: char, count: usize| {
            let last = format!("{letter}{}", "0".repeat(count.max(2).ilog10() as usize + 1));
            if labels.contains(&kind) { glyphs::length(&last, 1.0) + 2.0 * ROOM } else { 0.0 }
        };
        let node = widest(Labels::Nodes, 'N', places.len());
        let member = widest(Labels::Members, 'M', lengths.len());
        let panel = widest(Labels::Panels, 'P', schedule.panels.nodes.len());
        let mut sorted = lengths.clone();
        sorted.sort_by(f64::total_cmp);
        let usual = sorted.get(sorted.len() * SHORTER / 100).copied().unwrap_or(0.0);
        let mut writing =
            Writing { design, places, lengths, radii, node, member, panel, size: f64::INFINITY };
        // The radius of the circle in an equilateral triangle over its side.
        let radius = 0.75f64.sqrt() / 3.0;
        writing.size = writing.along(usual).min(writing.within(radius * usual)).min(largest);
        writing
    }

    /// The size of type at which labels fit along a member of this length.
    fn along(&self, length: f64) -> f64 {
        // A node's label takes half its width at either end.
        (length / (self.node + self.member).max(1.0)).min(LARGEST * length).min(self.size)
    }

    /// The size of type at which labels fit in a panel with a circle of this radius in it.
    fn within(&self, radius: f64) -> f64 {
        if self.panel == 0.0 {
            return self.size;
        }
        // From the middle to a corner of the label, perpendicular to a side that rises by sixty degrees.
        let corner = 0.75f64.sqrt() * 0.5 * self.panel + 0.25 * HEIGHT;
        let beside = if self.member > 0.0 { 0.5 * HEIGHT } else { 0.0 };
        (radius / (corner + beside)).min(self.size)
    }

    fn is_large_enough(&self, size: f64) -> bool {
        size >= LEAST * self.size
    }

    fn panel(&self, k: usize, t: [u32; 3], drawing: &mut Drawing) {
        let [a, b, c] = t.map(|v| self.places[v as usize]);
        let size = self.within(self.radii[k]);
        if self.is_large_enough(size) {
            let at = [0, 1].map(|i| (a[i] + b[i] + c[i]) / 3.0);
            write(drawing, at, format!("P{k}"), size, OF_PANELS, 0.0);
        }
    }

    fn member(&self, k: usize, ends: [u32; 2], room: f64, drawing: &mut Drawing) {
        let size = self.along(self.lengths[k]).min(room);
        if !self.is_large_enough(size) {
            return;
        }
        let [a, b] = ends.map(|v| self.places[v as usize]);
        // From left to right, so that no number stands on its head.
        let (a, b) = if a[0] <= b[0] { (a, b) } else { (b, a) };
        let turn = trig::atan2(a[1] - b[1], b[0] - a[0]);
        let words = format!("M{k}");
        let at = [0, 1].map(|i| f64::midpoint(a[i], b[i]));
        let half = [0.5 * glyphs::length(&words, size) + 0.4 * ROOM * size, 0.5 * HEIGHT * size];
        let (sin, cos) = (trig::sin(turn), trig::cos(turn));
        let corner = |[x, y]: [f64; 2]| [at[0] + x * cos + y * sin, at[1] - x * sin + y * cos];
        let [x, y] = half;
        drawing.area([[-x, -y], [x, -y], [x, y], [-x, y]].map(corner).to_vec(), PAPER);
        write(drawing, at, words, size, OF_MEMBERS, turn.to_degrees());
    }

    /// The label of a node takes the place of its mark: white on black for too few members, ringed for too many,
    /// or its colour.
    fn node(&self, v: usize, shortest: f64, colour: Option<Rgb>, drawing: &mut Drawing) {
        let size = self.along(shortest);
        if !self.is_large_enough(size) {
            return;
        }
        let nodes = &self.design.schedule.nodes;
        let few = nodes.adjusted_degree[v] < REGULAR;
        let plain = if few { INK } else { PAPER };
        let fill = colour.unwrap_or(plain);
        let ink = if fill.iter().sum::<f64>() < 1.3 { PAPER } else { INK };
        let (at, words) = (self.places[v], format!("N{v}"));
        let half = [0.5 * glyphs::length(&words, size), 0.5 * HEIGHT * size];
        let around = pill(at, half);
        drawing.area(around.clone(), fill);
        if nodes.is_irregular(v) {
            drawing.line(around, 0.09 * size, INK);
        }
        write(drawing, at, words, size, ink, 0.0);
    }

    /// The size of type that the panels beside each member leave to it.
    fn room_beside_members(&self) -> Vec<f64> {
        let members = &self.design.schedule.members;
        let mut room = vec![f64::INFINITY; self.lengths.len()];
        for ([a, b, c], radius) in self.design.schedule.panels.nodes.iter().zip(&self.radii) {
            for (a, b) in [(*a, *b), (*b, *c), (*c, *a)] {
                let Some(k) = members.between(a, b) else { continue };
                room[k] = room[k].min(BESIDE * radius);
            }
        }
        room
    }

    /// The length of the shortest member at each node, on the paper.
    fn shortest(&self) -> Vec<f64> {
        let mut shortest = vec![f64::INFINITY; self.places.len()];
        for (ends, &length) in self.design.schedule.members.ends.iter().zip(&self.lengths) {
            for v in ends.map(|v| v as usize) {
                shortest[v] = shortest[v].min(length);
            }
        }
        shortest
    }
}

fn write(drawing: &mut Drawing, at: [f64; 2], words: String, size: f64, rgb: Rgb, turn_deg: f64) {
    let anchor = Anchor::Middle;
    drawing.marks.push(Mark::Text(Text { at, words, size, rgb, anchor, turn_deg }));
}

/// A rectangle of this half width and height with half circles at its ends; closed.
fn pill([x, y]: [f64; 2], [wide, high]: [f64; 2]) -> Vec<[f64; 2]> {
    let mut points = Vec::new();
    for (side, from) in [(1.0, -90.0), (-1.0, 90.0)] {
        for k in 0..=6 {
            let angle = (from + 30.0 * f64::from(k)).to_radians();
            let (sin, cos) = (trig::sin(angle), trig::cos(angle));
            points.push([x + side * (wide - 0.4 * high) + high * cos, y + high * sin]);
        }
    }
    points.push(points[0]);
    points
}
