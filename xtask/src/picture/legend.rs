//! What the colours and the marks mean, at the foot of a picture: lengths over l0, degrees.

use super::sheet::{FULL, STEPS, Sheet, colour};

/// Width and height of the colour scale, pixels.
const SCALE: [f64; 2] = [120.0, 7.0];
/// Side of the raster that characters are drawn on, pixels, and their distance in steps of it.
const RASTER: f64 = 1.8;
const ADVANCE: f64 = 5.5;
/// Pen width of the characters, pixels.
const PEN: f64 = 1.1;
/// Radius of the marks, pixels.
const RADIUS: f64 = 4.5;

/// Draw the legend.
pub fn draw(sheet: &mut Sheet) {
    let [left, ground] = sheet.foot();
    let base = ground - 6.0 * RASTER - 5.0;
    let fields = 2 * u32::from(STEPS) + 1;
    for k in 0..fields {
        let [x, y] = [k, k + 1].map(|k| left + SCALE[0] * f64::from(k) / f64::from(fields));
        let length = 1.0 + FULL * (f64::from(k) / f64::from(STEPS) - 1.0);
        let top = base - SCALE[1];
        sheet.fill(&[[x, base], [y, base], [y, top], [x, top]], colour(length));
    }
    let middle = left + SCALE[0] / 2.0 - 1.5 * RASTER;
    write(sheet, "0.8", left, ground);
    write(sheet, "1", middle, ground);
    write(sheet, "1.2", left + SCALE[0] - 3.0 * ADVANCE * RASTER, ground);
    let text = left + SCALE[0] + 12.0;
    write(sheet, "l/l0", text, base);
    for (k, (brightness, degree)) in [(0.0, "<6"), (1.0, ">6")].into_iter().enumerate() {
        let x = text + 55.0 + 50.0 * k as f64;
        sheet.dot([x, base - 3.0 * RASTER], RADIUS, brightness);
        write(sheet, degree, x + 10.0, base);
    }
}

/// Write `text` from `left` on the line `ground`.
fn write(sheet: &mut Sheet, text: &str, left: f64, ground: f64) {
    for (k, c) in text.chars().enumerate() {
        let x = left + k as f64 * ADVANCE * RASTER;
        for stroke in strokes(c) {
            let points: Vec<[f64; 2]> = stroke
                .iter()
                .map(|&[column, row]| [x + column * RASTER, ground - row * RASTER])
                .collect();
            sheet.line(&points, PEN, [0.25; 3]);
        }
    }
}

/// A character as lines on a raster of 4 by 6 steps, (0, 0) at its lower left.
fn strokes(c: char) -> &'static [&'static [[f64; 2]]] {
    match c {
        '0' => &[&[[0.0, 0.0], [4.0, 0.0], [4.0, 6.0], [0.0, 6.0], [0.0, 0.0]]],
        '1' => &[&[[0.5, 4.5], [2.0, 6.0], [2.0, 0.0]]],
        '2' => &[&[[0.0, 6.0], [4.0, 6.0], [4.0, 3.0], [0.0, 3.0], [0.0, 0.0], [4.0, 0.0]]],
        '6' => &[&[[4.0, 6.0], [0.0, 6.0], [0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]]],
        '8' => &[
            &[[0.0, 0.0], [4.0, 0.0], [4.0, 6.0], [0.0, 6.0], [0.0, 0.0]],
            &[[0.0, 3.0], [4.0, 3.0]],
        ],
        '.' => &[&[[1.8, 0.0], [2.2, 0.0]]],
        'l' => &[&[[0.5, 6.0], [2.0, 6.0], [2.0, 1.0], [3.0, 0.0], [4.0, 0.0]]],
        '/' => &[&[[0.5, -0.5], [3.5, 6.5]]],
        '<' => &[&[[4.0, 5.0], [0.5, 3.0], [4.0, 1.0]]],
        '>' => &[&[[0.0, 5.0], [3.5, 3.0], [0.0, 1.0]]],
        _ => &[],
    }
}
