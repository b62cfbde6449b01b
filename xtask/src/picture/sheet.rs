//! The paper and the pens.

use super::file;
use std::path::Path;
use tiny_skia::{Color, FillRule, LineCap, Paint, PathBuilder, Pixmap, Stroke, Transform};

/// Longer side of the picture, pixels.
const SIDE: f64 = 760.0;
/// White all round, pixels.
const MARGIN: f64 = 14.0;
/// Below the grid, for the legend, pixels.
pub const FOOT: f64 = 34.0;
/// A picture is at least so wide, for the legend, pixels.
const LEAST: f64 = 330.0;
/// Radius of a node's mark and width of a member, over l0.
const MARK: f64 = 0.17;
const WIDTH: f64 = 0.075;
/// Widest member and mark, pixels.
const MOST: f64 = 9.0;
/// Deviation from l0 at which the colours are full.
pub const FULL: f64 = 0.2;
/// Steps of colour to either side.
pub const STEPS: u8 = 10;
/// Colours of short, right and long members.
const SHORT: [f64; 3] = [0.13, 0.38, 0.75];
const RIGHT: [f64; 3] = [0.62, 0.63, 0.62];
const LONG: [f64; 3] = [0.82, 0.25, 0.12];

/// A picture in the making.
pub struct Sheet {
    pixels: Pixmap,
    /// Pixels per metre.
    scale: f64,
    /// Of the least x and the largest y, metres.
    corner: [f64; 2],
    /// Space left and right of the grid, pixels.
    indent: f64,
    edge_length: f64,
}

impl Sheet {
    /// White paper that holds all `places`.
    pub fn new(places: &[[f64; 3]], edge_length: f64) -> Result<Sheet, String> {
        let bound = |k: usize, pick: fn(f64, f64) -> f64, start: f64| {
            places.iter().map(|p| p[k]).fold(start, pick)
        };
        let [left, bottom] = [0, 1].map(|k| bound(k, f64::min, f64::INFINITY));
        let [right, top] = [0, 1].map(|k| bound(k, f64::max, f64::NEG_INFINITY));
        let scale = (SIDE - 2.0 * MARGIN) / (right - left).max(top - bottom);
        let width = ((right - left) * scale + 2.0 * MARGIN).max(LEAST);
        let height = (top - bottom) * scale + 2.0 * MARGIN + FOOT;
        let mut pixels = Pixmap::new(width.ceil() as u32, height.ceil() as u32)
            .ok_or("a grid without extent in the picture")?;
        pixels.fill(Color::WHITE);
        let indent = (width - (right - left) * scale) / 2.0;
        Ok(Sheet { pixels, scale, corner: [left, top], indent, edge_length })
    }

    /// Fill a panel.
    pub fn panel(&mut self, corners: [[f64; 3]; 3], brightness: f64) {
        let corners = corners.map(|p| self.pixel(p));
        // Rims that are not smoothed leave no gaps between pieces.
        let paint = Paint { anti_alias: false, ..paint([brightness; 3]) };
        self.area(&corners, &paint);
    }

    /// Draw a member of this length over l0.
    pub fn member(&mut self, a: [f64; 3], b: [f64; 3], length: f64) {
        let line = [a, b].map(|p| self.pixel(p));
        self.line(&line, self.size(WIDTH).max(1.0), colour(length));
    }

    /// Mark an irregular node.
    pub fn mark(&mut self, at: [f64; 3], excess: i64) {
        let radius = self.size(MARK).max(2.5);
        self.dot(self.pixel(at), radius, if excess < 0 { 0.0 } else { 1.0 });
    }

    /// A dot of this brightness with a black rim; pixels.
    pub fn dot(&mut self, [x, y]: [f64; 2], radius: f64, brightness: f64) {
        let Some(path) = PathBuilder::from_circle(x as f32, y as f32, radius as f32) else {
            return;
        };
        let stroke = Stroke { width: (radius * 0.35).max(1.0) as f32, ..Stroke::default() };
        let (fill, rim) = (paint([brightness; 3]), paint([0.0; 3]));
        self.pixels.fill_path(&path, &fill, FillRule::Winding, Transform::identity(), None);
        self.pixels.stroke_path(&path, &rim, &stroke, Transform::identity(), None);
    }

    /// A line through these pixels.
    pub fn line(&mut self, points: &[[f64; 2]], width: f64, rgb: [f64; 3]) {
        let mut path = PathBuilder::new();
        trace(&mut path, points);
        let Some(path) = path.finish() else { return };
        let stroke = Stroke { width: width as f32, line_cap: LineCap::Round, ..Stroke::default() };
        self.pixels.stroke_path(&path, &paint(rgb), &stroke, Transform::identity(), None);
    }

    /// Fill a polygon of pixels.
    pub fn fill(&mut self, points: &[[f64; 2]], rgb: [f64; 3]) {
        self.area(points, &paint(rgb));
    }

    fn area(&mut self, points: &[[f64; 2]], paint: &Paint) {
        let mut path = PathBuilder::new();
        trace(&mut path, points);
        path.close();
        let Some(path) = path.finish() else { return };
        let rule = FillRule::Winding;
        self.pixels.fill_path(&path, paint, rule, Transform::identity(), None);
    }

    /// Left end of the legend's ground line, pixels.
    pub fn foot(&self) -> [f64; 2] {
        [MARGIN, f64::from(self.pixels.height()) - MARGIN]
    }

    /// Write the picture.
    pub fn save(&self, path: &Path) -> Result<(), String> {
        let steps = i32::from(STEPS);
        let inks: Vec<[f64; 3]> = (-steps..=steps).map(ink).collect();
        let size = [self.pixels.width(), self.pixels.height()];
        file::write(path, size, self.pixels.data(), &inks)
    }

    fn pixel(&self, [x, y, _]: [f64; 3]) -> [f64; 2] {
        let [left, top] = self.corner;
        [(x - left) * self.scale + self.indent, (top - y) * self.scale + MARGIN]
    }

    /// Pixels of a length over l0.
    fn size(&self, length: f64) -> f64 {
        (length * self.edge_length * self.scale).min(MOST)
    }
}

fn trace(path: &mut PathBuilder, points: &[[f64; 2]]) {
    for (k, &[x, y]) in points.iter().enumerate() {
        if k == 0 {
            path.move_to(x as f32, y as f32);
        } else {
            path.line_to(x as f32, y as f32);
        }
    }
}

/// The colour of a member of this length over l0.
pub fn colour(length: f64) -> [f64; 3] {
    let steps = f64::from(STEPS);
    ink(((length - 1.0) / FULL * steps).round().clamp(-steps, steps) as i32)
}

/// The colours of members, from the shortest (-STEPS) to the longest (STEPS).
fn ink(step: i32) -> [f64; 3] {
    let end = if step < 0 { SHORT } else { LONG };
    let share = f64::from(step.abs()) / f64::from(STEPS);
    [0, 1, 2].map(|k| RIGHT[k] + share * (end[k] - RIGHT[k]))
}

fn paint([red, green, blue]: [f64; 3]) -> Paint<'static> {
    let byte = |x: f64| (255.0 * x).round() as u8;
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(byte(red), byte(green), byte(blue), 255);
    paint
}
