//! A drawing as SVG, to a hundredth of a pixel.

use super::drawing::{Drawing, Mark, Rgb};
use std::fmt::Write;

/// Triangles are outlined in their own colour, so that no paper shines through between them.
const OVERLAP: f64 = 0.6;

pub fn encode(drawing: &Drawing) -> String {
    let [w, h] = drawing.size;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w:.0}\" height=\"{h:.0}\" viewBox=\"0 0 {w:.0} {h:.0}\" \
         stroke-linejoin=\"round\" stroke-linecap=\"round\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    for mark in &drawing.marks {
        let _ = match mark {
            Mark::Area { points, rgb } => {
                let (at, colour) = (list(points), hex(rgb));
                writeln!(
                    out,
                    "<polygon points=\"{at}\" fill=\"{colour}\" stroke=\"{colour}\" stroke-width=\"{OVERLAP}\"/>"
                )
            }
            Mark::Line { points, width, rgb } | Mark::Foot { points, width, rgb } => writeln!(
                out,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{width}\"/>",
                list(points),
                hex(rgb)
            ),
            Mark::Text { at: [x, y], text, size, rgb, .. } => writeln!(
                out,
                "<text x=\"{x:.2}\" y=\"{:.2}\" font-family=\"sans-serif\" font-size=\"{size}\" \
                 text-anchor=\"middle\" fill=\"{}\">{text}</text>",
                y + 0.35 * size,
                hex(rgb)
            ),
        };
    }
    out + "</svg>\n"
}

fn list(points: &[[f64; 2]]) -> String {
    let mut out = String::new();
    for [x, y] in points {
        let _ = write!(out, "{x:.2},{y:.2} ");
    }
    out.truncate(out.trim_end().len());
    out
}

fn hex(rgb: &Rgb) -> String {
    let [r, g, b] = rgb.map(|x| (255.0 * x.clamp(0.0, 1.0)).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}
