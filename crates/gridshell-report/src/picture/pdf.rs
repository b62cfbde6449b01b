//! A drawing as PDF of one page, in the base font Helvetica.

use super::drawing::{Drawing, GROUND, Mark, Rgb, Text, Unit};
use super::glyphs;
use gridshell::math::trig;
use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};
use std::io::Write;

/// Points of a millimetre, and of a pixel of SVG.
const OF_MILLIMETRE: f64 = 72.0 / 25.4;
const OF_PIXEL: f64 = 0.75;
const FONT: Name = Name(b"F");

pub fn encode(drawing: &Drawing) -> Vec<u8> {
    let scale = match drawing.unit {
        Unit::Pixel => OF_PIXEL,
        Unit::Millimetre => OF_MILLIMETRE,
    };
    let [catalog, pages, page, font, content, info] = [1, 2, 3, 4, 5, 6].map(Ref::new);
    let mut pdf = Pdf::new();
    pdf.catalog(catalog).pages(pages);
    pdf.pages(pages).kids([page]).count(1);
    let [w, h] = drawing.size.map(|x| (x * scale) as f32);
    let mut sheet = pdf.page(page);
    sheet.parent(pages).media_box(Rect::new(0.0, 0.0, w, h)).contents(content);
    sheet.resources().fonts().pair(FONT, font);
    sheet.finish();
    let mut helvetica = pdf.type1_font(font);
    helvetica.base_font(Name(b"Helvetica")).encoding_predefined(Name(b"WinAnsiEncoding"));
    helvetica.finish();
    pdf.document_info(info).title(TextStr(&drawing.title)).producer(TextStr("gridshell"));
    let marks = compressed(&marks(drawing, scale));
    pdf.stream(content, &marks).filter(Filter::FlateDecode);
    pdf.finish()
}

fn marks(drawing: &Drawing, scale: f64) -> Vec<u8> {
    let mut page = Content::new();
    // From here on in the drawing's unit, y downwards.
    let k = scale as f32;
    page.transform([k, 0.0, 0.0, -k, 0.0, drawing.size[1] as f32 * k]);
    page.set_line_cap(LineCapStyle::RoundCap).set_line_join(LineJoinStyle::RoundJoin);
    for mark in &drawing.marks {
        match mark {
            Mark::Area { points, rgb } => {
                let [r, g, b] = narrow(rgb);
                page.set_fill_rgb(r, g, b).set_stroke_rgb(r, g, b);
                page.set_line_width(drawing.unit.overlap() as f32);
                trace(&mut page, points);
                page.close_fill_nonzero_and_stroke();
            }
            Mark::Line { points, width, rgb } => {
                let [r, g, b] = narrow(rgb);
                page.set_stroke_rgb(r, g, b).set_line_width(*width as f32);
                trace(&mut page, points);
                page.stroke();
            }
            Mark::Text(text) => match latin(&text.words) {
                Some(words) => write(&mut page, text, &words),
                None => stroke(&mut page, text),
            },
        }
    }
    page.finish().to_vec()
}

fn write(page: &mut Content, text: &Text, words: &[u8]) {
    let turn = text.turn_deg.to_radians();
    let (sin, cos) = (trig::sin(turn), trig::cos(turn));
    let (x, y) = (glyphs::start(text), GROUND * text.size);
    let at = [text.at[0] + x * cos + y * sin, text.at[1] - x * sin + y * cos];
    let [r, g, b] = narrow(&text.rgb);
    page.begin_text().set_font(FONT, text.size as f32).set_fill_rgb(r, g, b);
    let [a, b, c, d] = [cos, -sin, -sin, -cos].map(|x| x as f32);
    page.set_text_matrix([a, b, c, d, at[0] as f32, at[1] as f32]);
    page.show(Str(words)).end_text();
}

/// A text that the font has no letters for, as strokes.
fn stroke(page: &mut Content, text: &Text) {
    let [r, g, b] = narrow(&text.rgb);
    page.set_stroke_rgb(r, g, b).set_line_width((glyphs::PEN * text.size) as f32);
    for points in glyphs::strokes(text) {
        trace(page, &points);
        page.stroke();
    }
}

fn trace(page: &mut Content, points: &[[f64; 2]]) {
    // A thousandth of a millimetre is enough, and keeps the file small.
    let round = |x: f64| ((x * 1e3).round() / 1e3) as f32;
    for (k, &[x, y]) in points.iter().enumerate() {
        let (x, y) = (round(x), round(y));
        if k == 0 {
            page.move_to(x, y)
        } else {
            page.line_to(x, y)
        };
    }
}

fn narrow(rgb: &Rgb) -> [f32; 3] {
    rgb.map(|x| ((x * 255.0).round() / 255.0) as f32)
}

/// The text in the encoding of the font, if it has all its letters.
fn latin(text: &str) -> Option<Vec<u8>> {
    let byte = |c: char| u8::try_from(u32::from(c)).ok().filter(|b| !(127..160).contains(b));
    text.chars().map(byte).collect()
}

fn compressed(bytes: &[u8]) -> Vec<u8> {
    let mut out = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
    out.write_all(bytes).and_then(|()| out.finish()).expect("memory takes all that is written")
}
