//! What the colours and the marks of a sheet mean, its scale bar and its axes.

use super::drawing::{Anchor, Drawing};
use super::frame::round_length;
use super::scene::{INK, MEMBER, PAPER, support};
use crate::colourings::{Colours, Scale};
use gridshell::design::Design;

/// Height of the histogram and of the strip of colours, over the size of type.
const BARS: f64 = 7.0;
const STRIP: f64 = 1.6;

/// A row of name and value; the value ends at the right.
pub fn row(
    drawing: &mut Drawing,
    (name, value): (&str, &str),
    [x, y]: [f64; 2],
    width: f64,
    size: f64,
) {
    drawing.text([x, y], name, size, INK, Anchor::Start);
    drawing.text([x + width, y], value, size, INK, Anchor::End);
}

/// How many elements have which colour, and what it stands for; gives where it ends.
pub fn colours(
    drawing: &mut Drawing,
    scale: &Scale,
    [x, top]: [f64; 2],
    width: f64,
    size: f64,
) -> f64 {
    let long = super::glyphs::length(&scale.title, 1.15 * size);
    let fit = 1.15 * size * (width / long).min(1.0);
    drawing.text([x, top], &scale.title, fit, INK, Anchor::Start);
    let ground = top + (2.8 + BARS) * size;
    let step = width / scale.inks.len() as f64;
    let most = scale.counts.iter().copied().max().unwrap_or(0).max(1) as f64;
    for (k, (rgb, &count)) in scale.inks.iter().zip(&scale.counts).enumerate() {
        let left = x + k as f64 * step;
        let high = BARS * size * count as f64 / most;
        drawing.rectangle([left + 0.06 * step, ground - high], [0.88 * step, high], *rgb);
        if count > 0 {
            let at = [left + 0.5 * step, ground - high - 0.5 * size];
            let small = (0.62 * size).min(0.4 * step);
            drawing.text(at, &count.to_string(), small, INK, Anchor::Middle);
        }
    }
    let end = strip(drawing, scale, [x, ground + 0.4 * size], width, size);
    if scale.note.is_empty() {
        return end;
    }
    drawing.text([x, end + 0.4 * size], &scale.note, 0.9 * size, INK, Anchor::Start);
    end + 1.4 * size
}

/// The colours of a scale in a row, and below it what they stand for; gives where it ends.
pub fn strip(
    drawing: &mut Drawing,
    scale: &Scale,
    [x, top]: [f64; 2],
    width: f64,
    size: f64,
) -> f64 {
    let step = width / scale.inks.len() as f64;
    for (k, rgb) in scale.inks.iter().enumerate() {
        drawing.rectangle([x + k as f64 * step, top], [step, STRIP * size], *rgb);
    }
    let y = top + (STRIP + 1.0) * size;
    for (at, text) in &scale.labels {
        let anchor = match *at {
            a if a <= 0.0 => Anchor::Start,
            a if a >= 1.0 => Anchor::End,
            _ => Anchor::Middle,
        };
        drawing.text([x + at * width, y], text, 0.9 * size, INK, anchor);
    }
    y + size
}

/// What the marks mean; gives where it ends.
pub fn marks(
    drawing: &mut Drawing,
    design: &Design,
    colours: Option<&Colours>,
    [x, mut y]: [f64; 2],
    size: f64,
    line: f64,
) -> f64 {
    let text = x + 3.0 * size;
    let middle = x + size;
    if !colours.is_some_and(Colours::all_nodes) {
        drawing.disc([middle, y], 0.45 * size, INK, INK);
        drawing.text([text, y], "node with too few members", size, INK, Anchor::Start);
        y += line;
        drawing.disc([middle, y], 0.45 * size, PAPER, INK);
        drawing.text([text, y], "node with too many members", size, INK, Anchor::Start);
        y += line;
    }
    drawing.line(vec![[x, y], [x + 2.0 * size, y]], 0.3 * size, MEMBER);
    drawing.text([text, y], "boundary, crease or guide", size, INK, Anchor::Start);
    y += line;
    if !design.document.supports.is_empty() {
        support([middle, y - 0.5 * size], 0.7 * size, drawing);
        let supports = format!("support ({})", design.document.supports.len());
        drawing.text([text, y], &supports, size, INK, Anchor::Start);
        y += line;
    }
    y
}

/// A bar of four round lengths, `most` wide at most.
pub fn scale_bar(drawing: &mut Drawing, [x, y]: [f64; 2], scale: f64, size: f64, most: f64) {
    let length = round_length(most / scale / 4.0);
    let step = length * scale;
    let high = 0.55 * size;
    drawing.rectangle([x, y], [4.0 * step, high], INK);
    let line = 0.06 * size;
    for k in 0..5 {
        let left = x + f64::from(k) * step;
        if k < 4 && k % 2 == 1 {
            drawing.rectangle(
                [left + line, y + line],
                [step - 2.0 * line, high - 2.0 * line],
                PAPER,
            );
        }
        let unit = if k == 4 { " m" } else { "" };
        let text = format!("{}{unit}", round(f64::from(k) * length));
        drawing.text([left, y - 0.9 * size], &text, size, INK, Anchor::Middle);
    }
}

/// Without the dust of binary fractions.
fn round(x: f64) -> f64 {
    (x * 1e9).round() / 1e9
}

/// The directions of x and y.
pub fn axes(drawing: &mut Drawing, [x, y]: [f64; 2], length: f64, size: f64) {
    let (width, tip) = (0.08 * size, 0.5 * size);
    let (right, top) = (x + length, y - length);
    drawing.line(vec![[x, top], [x, y], [right, y]], width, INK);
    let across =
        [[right - tip, y - 0.3 * tip], [right + 0.4 * tip, y], [right - tip, y + 0.3 * tip]];
    drawing.area(across.to_vec(), INK);
    let upwards = [[x - 0.3 * tip, top + tip], [x, top - 0.4 * tip], [x + 0.3 * tip, top + tip]];
    drawing.area(upwards.to_vec(), INK);
    drawing.text([right + 0.9 * size, y], "x", size, INK, Anchor::Middle);
    drawing.text([x, top - 1.1 * size], "y", size, INK, Anchor::Middle);
}
