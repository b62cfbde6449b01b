//! A grid seen from above: members coloured by their length, irregular nodes as in the paper's figures, black
//! for those with too few members (adjusted degree below 6) and white for those with too many.

use crate::build::{self, target};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use tiny_skia::{Color, FillRule, LineCap, Paint, PathBuilder, Pixmap, Stroke, Transform};

/// Longer side of the picture, pixels.
const SIDE: f64 = 1000.0;
/// White all round, pixels.
const MARGIN: f64 = 16.0;
/// Radius of a node's mark and width of a member, over l0.
const MARK: f64 = 0.2;
const WIDTH: f64 = 0.08;
/// Deviations from l0 at which the colours are full.
const FULL: f64 = 0.2;
/// Colours of short, right and long members.
const SHORT: [f64; 3] = [0.13, 0.38, 0.75];
const RIGHT: [f64; 3] = [0.62, 0.63, 0.62];
const LONG: [f64; 3] = [0.82, 0.25, 0.12];

/// What is drawn; irregular nodes with what their degree is too large by.
struct Plan {
    nodes: Vec<[f64; 3]>,
    members: Vec<[usize; 2]>,
    irregular: Vec<([f64; 2], i64)>,
    edge_length: f64,
}

/// Lay a grid on `surface` by the default recipe and draw it to `file`.
pub fn draw(surface: &str, file: &Path) -> Result<(), String> {
    let plan = plan(surface)?;
    let mut sheet = Sheet::new(&plan)?;
    // Far ones first, so that what is on top is seen on top.
    let mut members = plan.members.clone();
    let height = |m: &[usize; 2]| plan.nodes[m[0]][2] + plan.nodes[m[1]][2];
    members.sort_by(|a, b| height(a).total_cmp(&height(b)));
    for [a, b] in members {
        sheet.member(plan.nodes[a], plan.nodes[b]);
    }
    for &(at, excess) in &plan.irregular {
        sheet.mark(at, excess);
    }
    sheet.pixels.save_png(file).map_err(|e| format!("{}: {e}", file.display()))
}

/// Run the command, and read what it wrote.
fn plan(surface: &str) -> Result<Plan, String> {
    let gridshell = build::gridshell()?;
    let grid = target().join("picture.obj");
    let run = Command::new(gridshell)
        .args(["generate", surface, "--json", "-o"])
        .arg(&grid)
        .stderr(Stdio::inherit())
        .output()
        .map_err(|e| e.to_string())?;
    let run: Value = serde_json::from_slice(&run.stdout).map_err(|_| "no grid".to_owned())?;
    let text = fs::read_to_string(&grid).map_err(|e| e.to_string())?;
    let (mut nodes, mut members) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => nodes.push(triple(words.filter_map(|w| w.parse().ok()))?),
            Some("f") => {
                let panel: [usize; 3] = triple(words.filter_map(|w| w.parse().ok()))?;
                let sides = [0, 1, 2].map(|k| [panel[k] - 1, panel[(k + 1) % 3] - 1]);
                members.extend(sides.map(|[a, b]| [a.min(b), a.max(b)]));
            }
            _ => {}
        }
    }
    members.sort_unstable();
    members.dedup();
    let irregular = run["irregular"].as_array().into_iter().flatten().filter_map(|node| {
        let xy = [node["xyz"][0].as_f64()?, node["xyz"][1].as_f64()?];
        Some((xy, node["adjusted_degree"].as_i64()? - 6))
    });
    let edge_length = run["edge_length"].as_f64().ok_or("a run without an edge length")?;
    Ok(Plan { nodes, members, irregular: irregular.collect(), edge_length })
}

fn triple<T>(items: impl Iterator<Item = T>) -> Result<[T; 3], String> {
    let items: Vec<T> = items.collect();
    items.try_into().map_err(|_| "a line of the grid without three numbers".to_owned())
}

/// The picture in the making.
struct Sheet {
    pixels: Pixmap,
    /// Pixels per metre.
    scale: f64,
    /// Least x and largest y, metres.
    corner: [f64; 2],
    edge_length: f64,
}

impl Sheet {
    fn new(plan: &Plan) -> Result<Sheet, String> {
        let bound = |k: usize, pick: fn(f64, f64) -> f64, start: f64| {
            plan.nodes.iter().map(|p| p[k]).fold(start, pick)
        };
        let [left, bottom] = [0, 1].map(|k| bound(k, f64::min, f64::INFINITY));
        let [right, top] = [0, 1].map(|k| bound(k, f64::max, f64::NEG_INFINITY));
        let scale = (SIDE - 2.0 * MARGIN) / (right - left).max(top - bottom);
        let size = |length: f64| (length * scale + 2.0 * MARGIN).ceil() as u32;
        let mut pixels = Pixmap::new(size(right - left), size(top - bottom))
            .ok_or("a grid without extent in plan")?;
        pixels.fill(Color::WHITE);
        Ok(Sheet { pixels, scale, corner: [left, top], edge_length: plan.edge_length })
    }

    fn place(&self, x: f64, y: f64) -> (f32, f32) {
        let [left, top] = self.corner;
        let place = [(x - left) * self.scale + MARGIN, (top - y) * self.scale + MARGIN];
        (place[0] as f32, place[1] as f32)
    }

    fn member(&mut self, a: [f64; 3], b: [f64; 3]) {
        let length = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
        let (from, to) = (self.place(a[0], a[1]), self.place(b[0], b[1]));
        let mut path = PathBuilder::new();
        path.move_to(from.0, from.1);
        path.line_to(to.0, to.1);
        let Some(path) = path.finish() else { return };
        let paint = paint(colour(length / self.edge_length - 1.0));
        let stroke = self.stroke(WIDTH);
        self.pixels.stroke_path(&path, &paint, &stroke, Transform::identity(), None);
    }

    fn mark(&mut self, [x, y]: [f64; 2], excess: i64) {
        let (x, y) = self.place(x, y);
        let radius = MARK * self.edge_length * self.scale;
        let Some(path) = PathBuilder::from_circle(x, y, radius as f32) else { return };
        let (black, white) = (paint([0.0; 3]), paint([1.0; 3]));
        let fill = if excess < 0 { &black } else { &white };
        let stroke = self.stroke(WIDTH);
        self.pixels.fill_path(&path, fill, FillRule::Winding, Transform::identity(), None);
        self.pixels.stroke_path(&path, &black, &stroke, Transform::identity(), None);
    }

    fn stroke(&self, width: f64) -> Stroke {
        let width = (width * self.edge_length * self.scale).max(1.0) as f32;
        Stroke { width, line_cap: LineCap::Round, ..Stroke::default() }
    }
}

/// The colour of a member that is longer than l0 by this share.
fn colour(excess: f64) -> [f64; 3] {
    let end = if excess < 0.0 { SHORT } else { LONG };
    let share = (excess.abs() / FULL).min(1.0);
    [0, 1, 2].map(|k| RIGHT[k] + share * (end[k] - RIGHT[k]))
}

fn paint([red, green, blue]: [f64; 3]) -> Paint<'static> {
    let byte = |x: f64| (255.0 * x).round() as u8;
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(byte(red), byte(green), byte(blue), 255);
    paint
}
