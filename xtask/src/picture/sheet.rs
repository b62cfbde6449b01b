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

/// What lies so far behind a panel is still seen, over l0: members and marks lie in their panels.
const BEHIND: f64 = 0.1;

/// Pieces of a member that are seen or not.
const PIECES: u32 = 12;

/// A picture in the making.
pub struct Sheet {
    pixels: Pixmap,
    /// Depth of the nearest panel at each pixel, metres.
    depths: Vec<f64>,
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
        let depths = vec![f64::INFINITY; (pixels.width() * pixels.height()) as usize];
        Ok(Sheet { pixels, depths, scale, corner: [left, top], indent, edge_length })
    }

    /// Fill a panel where it is nearer than what is there.
    pub fn panel(&mut self, corners: [[f64; 3]; 3], brightness: f64) {
        let [a, b, c] = corners.map(|p| self.pixel(p));
        let area = cross(a, b, c);
        let grey = (255.0 * brightness).round() as u8;
        let bound = |k: usize, size: u32| {
            let low = a[k].min(b[k]).min(c[k]).floor().max(0.0) as u32;
            let high = a[k].max(b[k]).max(c[k]).ceil() as u32 + 1;
            low..high.min(size)
        };
        let width = self.pixels.width();
        let (columns, rows) = (bound(0, width), bound(1, self.pixels.height()));
        for (x, y) in rows.flat_map(|y| columns.clone().map(move |x| (x, y))) {
            let p = [f64::from(x) + 0.5, f64::from(y) + 0.5];
            let share = [cross(p, b, c) / area, cross(a, p, c) / area, cross(a, b, p) / area];
            // Not so for panels seen edge on, whose shares are no numbers.
            if !share.iter().all(|&s| s >= 0.0) {
                continue;
            }
            let depth = (0..3).map(|k| share[k] * corners[k][2]).sum();
            let place = (y * width + x) as usize;
            if depth < self.depths[place] {
                self.depths[place] = depth;
                self.pixels.data_mut()[4 * place..4 * place + 3].fill(grey);
            }
        }
    }

    /// Draw a member of this length over l0 where it is seen.
    pub fn member(&mut self, a: [f64; 3], b: [f64; 3], length: f64) {
        let at = |f: f64| [0, 1, 2].map(|k| a[k] + f * (b[k] - a[k]));
        let share = |k: u32| f64::from(k) / f64::from(PIECES);
        let width = self.size(WIDTH).max(1.0);
        let mut start = None;
        for k in 0..=PIECES {
            let seen = k < PIECES && self.sees(at(share(k) + 0.5 / f64::from(PIECES)));
            match (seen, start) {
                (true, None) => start = Some(k),
                (false, Some(first)) => {
                    let line = [at(share(first)), at(share(k))].map(|p| self.pixel(p));
                    self.line(&line, width, colour(length));
                    start = None;
                }
                _ => {}
            }
        }
    }

    /// Mark an irregular node, if it is seen.
    pub fn mark(&mut self, at: [f64; 3], excess: i64) {
        if self.sees(at) {
            let radius = self.size(MARK).max(2.5);
            self.dot(self.pixel(at), radius, if excess < 0 { 0.0 } else { 1.0 });
        }
    }

    /// Whether no panel hides a place. The pixels round about count too: where a panel is seen almost edge on,
    /// depths change much from one pixel to the next.
    fn sees(&self, at: [f64; 3]) -> bool {
        let [x, y] = self.pixel(at).map(|x| x.floor() as i64);
        let [width, height] = [self.pixels.width(), self.pixels.height()].map(i64::from);
        let round_about = (y - 1..=y + 1).flat_map(|y| (x - 1..=x + 1).map(move |x| (x, y)));
        let inside = round_about.filter(|&(x, y)| x >= 0 && y >= 0 && x < width && y < height);
        let mut depths = inside.map(|(x, y)| self.depths[(y * width + x) as usize]);
        depths.any(|depth| at[2] - BEHIND * self.edge_length <= depth)
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
        let mut path = PathBuilder::new();
        trace(&mut path, points);
        path.close();
        let Some(path) = path.finish() else { return };
        let rule = FillRule::Winding;
        self.pixels.fill_path(&path, &paint(rgb), rule, Transform::identity(), None);
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

/// Twice the area of a triangle, with its sign.
fn cross(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
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
