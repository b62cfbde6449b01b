//! A drawing as SVG, to a hundredth of a pixel or millimetre.

use super::drawing::{Anchor, Drawing, GROUND, Mark, Rgb, Text, Unit};
use std::fmt::Write;

pub fn encode(drawing: &Drawing) -> String {
    let [w, h] = drawing.size;
    let unit = match drawing.unit {
        Unit::Pixel => "",
        Unit::Millimetre => "mm",
    };
    let overlap = drawing.unit.overlap();
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w:.0}{unit}\" height=\"{h:.0}{unit}\" viewBox=\"0 0 {w:.0} \
         {h:.0}\" stroke-linejoin=\"round\" stroke-linecap=\"round\" font-family=\"Helvetica, Arial, sans-serif\">\n\
         <title>{}</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        escaped(&drawing.title)
    );
    for mark in &drawing.marks {
        let _ = match mark {
            Mark::Area { points, rgb } => {
                let (at, colour) = (list(points), hex(rgb));
                writeln!(
                    out,
                    "<polygon points=\"{at}\" fill=\"{colour}\" stroke=\"{colour}\" stroke-width=\"{overlap}\"/>"
                )
            }
            Mark::Line { points, width, rgb } => writeln!(
                out,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{width:.3}\"/>",
                list(points),
                hex(rgb)
            ),
            Mark::Text(text) => writeln!(out, "{}", written(text)),
        };
    }
    out + "</svg>\n"
}

fn written(text: &Text) -> String {
    let Text { at: [x, y], size, rgb, .. } = text;
    let anchor = match text.anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    let turn = match text.turn_deg {
        0.0 => String::new(),
        deg => format!(" transform=\"rotate({:.1} {x:.2} {y:.2})\"", -deg),
    };
    format!(
        "<text x=\"{x:.2}\" y=\"{:.2}\"{turn} font-size=\"{size:.3}\" text-anchor=\"{anchor}\" fill=\"{}\">{}</text>",
        y + GROUND * size,
        hex(rgb),
        escaped(&text.words)
    )
}

/// Text as it stands in SVG and HTML.
pub fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '&' => out += "&amp;",
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '"' => out += "&quot;",
            '\'' => out += "&#39;",
            '\n' => out.push('\n'),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

fn list(points: &[[f64; 2]]) -> String {
    let mut out = String::new();
    for [x, y] in points {
        let _ = write!(out, "{x:.2},{y:.2} ");
    }
    out.truncate(out.trim_end().len());
    out
}

/// A colour as SVG and HTML have it.
pub fn hex(rgb: &Rgb) -> String {
    let [r, g, b] = rgb.map(|x| (255.0 * x.clamp(0.0, 1.0)).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}
