//! The few characters that pictures need, as strokes on a raster of 4 by 6 steps: no font is asked for.

/// Steps from one character to the next, and the height of one.
const ADVANCE: f64 = 5.5;
const HEIGHT: f64 = 6.0;

/// The strokes of a text of this height over its middle; pixels, y downwards.
pub fn strokes(text: &str, [x, y]: [f64; 2], size: f64) -> Vec<Vec<[f64; 2]>> {
    let step = 0.72 * size / HEIGHT;
    let width = (text.chars().count() as f64 * ADVANCE - (ADVANCE - 4.0)) * step;
    let left = x - width / 2.0;
    let ground = y + HEIGHT * step / 2.0;
    let mut all = Vec::new();
    for (k, c) in text.chars().enumerate() {
        let from = left + k as f64 * ADVANCE * step;
        for stroke in character(c) {
            all.push(stroke.iter().map(|&[a, b]| [from + a * step, ground - b * step]).collect());
        }
    }
    all
}

/// A character's strokes, (0, 0) at its lower left.
fn character(c: char) -> &'static [&'static [[f64; 2]]] {
    match c {
        '0' => &[&[[0.0, 0.0], [4.0, 0.0], [4.0, 6.0], [0.0, 6.0], [0.0, 0.0]]],
        '1' => &[&[[0.8, 4.6], [2.4, 6.0], [2.4, 0.0]]],
        '2' => &[&[[0.0, 6.0], [4.0, 6.0], [4.0, 3.0], [0.0, 3.0], [0.0, 0.0], [4.0, 0.0]]],
        '3' => &[&[[0.0, 6.0], [4.0, 6.0], [4.0, 0.0], [0.0, 0.0]], &[[1.0, 3.0], [4.0, 3.0]]],
        '4' => &[&[[3.2, 0.0], [3.2, 6.0], [0.0, 2.0], [4.0, 2.0]]],
        '5' => &[&[[4.0, 6.0], [0.0, 6.0], [0.0, 3.0], [4.0, 3.0], [4.0, 0.0], [0.0, 0.0]]],
        '6' => &[&[[4.0, 6.0], [0.0, 6.0], [0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]]],
        '7' => &[&[[0.0, 6.0], [4.0, 6.0], [1.5, 0.0]]],
        '8' => &[
            &[[0.0, 0.0], [4.0, 0.0], [4.0, 6.0], [0.0, 6.0], [0.0, 0.0]],
            &[[0.0, 3.0], [4.0, 3.0]],
        ],
        '9' => &[&[[0.0, 0.0], [4.0, 0.0], [4.0, 6.0], [0.0, 6.0], [0.0, 3.0], [4.0, 3.0]]],
        '.' => &[&[[1.8, 0.0], [2.2, 0.0]]],
        'm' => &[&[[0.0, 0.0], [0.0, 4.0], [4.0, 4.0], [4.0, 0.0]], &[[2.0, 4.0], [2.0, 0.0]]],
        _ => &[],
    }
}
