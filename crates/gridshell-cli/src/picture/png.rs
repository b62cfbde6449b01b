//! A drawing as PNG.

use super::drawing::{Drawing, Mark, Rgb};
use super::glyphs;
use crate::failure::Failure;
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, Transform,
};

/// Triangles are outlined in their own colour, so that no paper shines through between them.
const OVERLAP: f64 = 0.6;
/// Pen width of characters over their size.
const PEN: f64 = 0.1;

pub fn encode(drawing: &Drawing) -> Result<Vec<u8>, Failure> {
    let [w, h] = drawing.size.map(|x| x.ceil() as u32);
    let mut pixels = Pixmap::new(w, h).ok_or_else(|| Failure::other("a picture without extent"))?;
    pixels.fill(Color::WHITE);
    for mark in &drawing.marks {
        match mark {
            Mark::Area { points, rgb } => {
                let Some(path) = trace(points, true) else { continue };
                let rule = FillRule::Winding;
                pixels.fill_path(&path, &paint(rgb), rule, Transform::identity(), None);
                stroke(&mut pixels, &path, OVERLAP, rgb);
            }
            Mark::Line { points, width, rgb } | Mark::Foot { points, width, rgb } => {
                if let Some(path) = trace(points, false) {
                    stroke(&mut pixels, &path, *width, rgb);
                }
            }
            Mark::Text { at, text, size, rgb, .. } => {
                for points in glyphs::strokes(text, *at, *size) {
                    if let Some(path) = trace(&points, false) {
                        stroke(&mut pixels, &path, PEN * size, rgb);
                    }
                }
            }
        }
    }
    pixels.encode_png().map_err(Failure::other)
}

fn trace(points: &[[f64; 2]], closed: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    for (k, &[x, y]) in points.iter().enumerate() {
        let (x, y) = (x as f32, y as f32);
        if k == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
    }
    if closed {
        path.close();
    }
    path.finish()
}

fn stroke(pixels: &mut Pixmap, path: &Path, width: f64, rgb: &Rgb) {
    let pen = Stroke {
        width: width as f32,
        line_cap: LineCap::Round,
        line_join: LineJoin::Round,
        ..Stroke::default()
    };
    pixels.stroke_path(path, &paint(rgb), &pen, Transform::identity(), None);
}

fn paint(rgb: &Rgb) -> Paint<'static> {
    let [r, g, b] = rgb.map(|x| (255.0 * x.clamp(0.0, 1.0)).round() as u8);
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(r, g, b, 255);
    paint
}
