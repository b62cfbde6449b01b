//! A drawing as PNG.

use super::drawing::{Drawing, Mark, Rgb, Unit};
use super::glyphs;
use super::palette::{self, Indexed};
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, Transform,
};

/// Colours of a small picture and of a sheet, at most.
const OF_PICTURE: u8 = 80;
const OF_SHEET: u8 = 255;
/// Pixels of a millimetre: 150 to the inch.
const PIXELS: f64 = 150.0 / 25.4;

pub fn encode(drawing: &Drawing) -> Result<Vec<u8>, String> {
    let scale = match drawing.unit {
        Unit::Pixel => 1.0,
        Unit::Millimetre => PIXELS,
    };
    let [w, h] = drawing.size.map(|x| (x * scale).ceil() as u32);
    let pixels = Pixmap::new(w, h).ok_or("a picture without extent")?;
    let mut canvas = Canvas { pixels, scale: Transform::from_scale(scale as f32, scale as f32) };
    canvas.pixels.fill(Color::WHITE);
    for mark in &drawing.marks {
        match mark {
            Mark::Area { points, rgb } => canvas.fill(points, drawing.unit.overlap(), rgb),
            Mark::Line { points, width, rgb } => canvas.stroke(points, *width, rgb),
            Mark::Text(text) => {
                for points in glyphs::strokes(text) {
                    canvas.stroke(&points, glyphs::PEN * text.size, &text.rgb);
                }
            }
        }
    }
    packed(&canvas.pixels, drawing).map_err(|e| e.to_string())
}

/// The file: colours by numbers, and how large it is on paper.
fn packed(pixels: &Pixmap, drawing: &Drawing) -> Result<Vec<u8>, png::EncodingError> {
    let mut inks: Vec<[u8; 3]> = drawing.marks.iter().filter_map(ink).map(bytes).collect();
    inks.sort_unstable();
    inks.dedup();
    let most = match drawing.unit {
        Unit::Pixel => OF_PICTURE,
        Unit::Millimetre => OF_SHEET,
    };
    let Indexed { palette, pixels: numbers } = palette::indexed(pixels.data(), &inks, most);
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, pixels.width(), pixels.height());
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_palette(palette.concat());
    // Neighbouring numbers are no neighbouring colours, so differences between pixels tell nothing.
    encoder.set_filter(png::FilterType::NoFilter);
    // The encoder's own choice counts on such differences, and gives up without.
    encoder.set_compression(match drawing.unit {
        Unit::Pixel => png::Compression::Best,
        Unit::Millimetre => png::Compression::Default,
    });
    if drawing.unit == Unit::Millimetre {
        let per_metre = (1000.0 * PIXELS).round() as u32;
        let unit = png::Unit::Meter;
        encoder.set_pixel_dims(Some(png::PixelDimensions {
            xppu: per_metre,
            yppu: per_metre,
            unit,
        }));
    }
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&numbers)?;
    writer.finish()?;
    Ok(bytes)
}

/// The colour of a line or a text. Areas have many by the light on them, and fill enough pixels.
fn ink(mark: &Mark) -> Option<&Rgb> {
    match mark {
        Mark::Area { .. } => None,
        Mark::Line { rgb, .. } => Some(rgb),
        Mark::Text(text) => Some(&text.rgb),
    }
}

fn bytes(rgb: &Rgb) -> [u8; 3] {
    rgb.map(|x| (255.0 * x.clamp(0.0, 1.0)).round() as u8)
}

struct Canvas {
    pixels: Pixmap,
    scale: Transform,
}

impl Canvas {
    fn fill(&mut self, points: &[[f64; 2]], overlap: f64, rgb: &Rgb) {
        let Some(path) = trace(points, true) else { return };
        self.pixels.fill_path(&path, &paint(rgb), FillRule::Winding, self.scale, None);
        self.pen(&path, overlap, rgb);
    }

    fn stroke(&mut self, points: &[[f64; 2]], width: f64, rgb: &Rgb) {
        if let Some(path) = trace(points, false) {
            self.pen(&path, width, rgb);
        }
    }

    fn pen(&mut self, path: &Path, width: f64, rgb: &Rgb) {
        let pen = Stroke {
            width: width as f32,
            line_cap: LineCap::Round,
            line_join: LineJoin::Round,
            ..Stroke::default()
        };
        self.pixels.stroke_path(path, &paint(rgb), &pen, self.scale, None);
    }
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

fn paint(rgb: &Rgb) -> Paint<'static> {
    let [r, g, b] = bytes(rgb);
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    paint.set_color_rgba8(r, g, b, 255);
    paint
}
