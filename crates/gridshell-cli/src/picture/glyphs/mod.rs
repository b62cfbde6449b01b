//! Letters as strokes, as on technical drawings: no font is asked for. Their widths are those of Helvetica, so a text
//! is as long in every format.

use super::drawing::{Anchor, GROUND, Text};
use gridshell::math::trig;

/// One step of the raster over the size of the type.
const STEP: f64 = 0.08;
/// The ground line on the raster.
const GROUND_LINE: f64 = 3.0;
/// Width of what is not known, thousandths of the size.
const OTHER_WIDTH: u32 = 556;
/// Widths from the space to the tilde, thousandths of the size.
const WIDTHS: [u32; 95] = [
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278, 556, 556, 556,
    556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667,
    611, 778, 722, 278, 500, 667, 556, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667,
    667, 611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500,
    222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584,
];

/// How long a text of this size is.
pub fn length(text: &str, size: f64) -> f64 {
    text.chars().map(|c| f64::from(width(c))).sum::<f64>() * size / 1000.0
}

/// Where a text begins, along itself from its anchor.
pub fn start(text: &Text) -> f64 {
    match text.anchor {
        Anchor::Start => 0.0,
        Anchor::Middle => -0.5 * length(&text.words, text.size),
        Anchor::End => -length(&text.words, text.size),
    }
}

/// The strokes of a text; y downwards.
pub fn strokes(text: &Text) -> Vec<Vec<[f64; 2]>> {
    let turn = text.turn_deg.to_radians();
    let (sin, cos) = (trig::sin(turn), trig::cos(turn));
    let step = STEP * text.size;
    let mut all = Vec::new();
    let mut along = start(text);
    for c in text.words.chars() {
        let own: Vec<Vec<[f64; 2]>> = character(c).split(';').map(points).collect();
        let xs = || own.iter().flatten().map(|p| p[0]);
        let wide = xs().fold(0.0, f64::max) - xs().fold(f64::INFINITY, f64::min).min(9.0);
        let cell = f64::from(width(c)) * text.size / 1000.0;
        let left = along + (cell - wide * step) / 2.0;
        let place = |p: &[f64; 2]| {
            let x = left + p[0] * step;
            let y = GROUND * text.size - (p[1] - GROUND_LINE) * step;
            [text.at[0] + x * cos + y * sin, text.at[1] - x * sin + y * cos]
        };
        all.extend(own.iter().filter(|s| s.len() > 1).map(|s| s.iter().map(place).collect()));
        along += cell;
    }
    all
}

fn width(c: char) -> u32 {
    let k = (c as usize).wrapping_sub(' ' as usize);
    WIDTHS.get(k).copied().unwrap_or(OTHER_WIDTH)
}

/// Points as pairs of hexadecimal digits x, y.
fn points(stroke: &str) -> Vec<[f64; 2]> {
    let digit = |c: char| c.to_digit(16).map_or(0.0, f64::from);
    let pair = |word: &str| {
        let mut digits = word.chars().map(digit);
        [digits.next().unwrap_or(0.0), digits.next().unwrap_or(0.0)]
    };
    stroke.split_whitespace().map(pair).collect()
}

/// A character's strokes on a raster whose ground line is 3, whose small letters reach to 9 and capitals to 12 (c).
#[rustfmt::skip]
fn character(c: char) -> &'static str {
    match c {
        ' ' => "",
        '0' => "13 04 0b 1c 3c 4b 44 33 13", '1' => "0a 2c 23", '2' => "0b 1c 3c 4b 49 03 43",
        '3' => "0b 1c 3c 4b 49 38 18;38 47 44 33 13 04", '4' => "33 3c 06 46",
        '5' => "4c 0c 08 38 47 44 33 13 04", '6' => "4b 3c 1c 0b 04 13 33 44 47 38 08",
        '7' => "0c 4c 13", '8' => "18 09 0b 1c 3c 4b 49 38 18 07 04 13 33 44 47 38",
        '9' => "04 13 33 44 4b 3c 1c 0b 08 17 47",
        'A' => "03 3c 63;16 56", 'B' => "03 0c 4c 5b 59 48 08;48 57 54 43 03",
        'C' => "5b 4c 1c 0b 04 13 43 54", 'D' => "03 0c 3c 5a 55 33 03", 'E' => "5c 0c 03 53;08 48",
        'F' => "5c 0c 03;08 48", 'G' => "5b 4c 1c 0b 04 13 43 54 57 37", 'H' => "03 0c;53 5c;08 58",
        'I' | 'l' => "03 0c", 'J' => "04 13 33 44 4c", 'K' => "03 0c;5c 07;18 53", 'L' => "0c 03 53",
        'M' => "03 0c 37 6c 63", 'N' => "03 0c 53 5c", 'O' => "13 04 0b 1c 4c 5b 54 43 13",
        'P' => "03 0c 4c 5b 58 47 07", 'Q' => "13 04 0b 1c 4c 5b 54 43 13;35 62",
        'R' => "03 0c 4c 5b 58 47 07;37 53", 'S' => "5b 4c 1c 0b 09 18 47 56 54 43 13 04",
        'T' => "0c 6c;3c 33", 'U' => "0c 04 13 43 54 5c", 'V' => "0c 33 6c", 'W' => "0c 23 4a 63 8c",
        'X' => "03 5c;0c 53", 'Y' => "0c 38 6c;38 33", 'Z' => "0c 5c 03 53",
        'a' => "49 43;48 39 19 08 04 13 33 44", 'b' => "0c 03;04 13 33 44 48 39 19 08",
        'c' => "48 39 19 08 04 13 33 44", 'd' => "4c 43;44 33 13 04 08 19 39 48",
        'e' => "06 46 48 39 19 08 04 13 33 44", 'f' => "3c 2c 1b 13;09 39",
        'g' => "49 41 30 10 01;48 39 19 08 04 13 33 44", 'h' => "0c 03;08 19 39 48 43",
        'i' => "03 09;0b 0c", 'j' => "29 21 10 00;2b 2c", 'k' => "0c 03;49 05;16 43",
        'm' => "03 09;08 19 29 38 33;38 49 59 68 63", 'n' => "03 09;08 19 39 48 43",
        'o' => "13 04 08 19 39 48 44 33 13", 'p' => "00 09;08 19 39 48 44 33 13 04",
        'q' => "40 49;48 39 19 08 04 13 33 44", 'r' => "03 09;07 29 39",
        's' => "48 39 19 08 07 16 36 45 44 33 13 04", 't' => "1c 14 23 33;09 39",
        'u' => "09 04 13 33 44;49 43", 'v' => "09 23 49", 'w' => "09 13 38 53 69", 'x' => "03 49;09 43",
        'y' => "09 23;49 10 00", 'z' => "09 49 03 43",
        '.' => "03 04", ',' => "14 02", ':' => "03 04;08 09", ';' => "14 02;18 19", '-' => "07 37",
        '+' => "07 67;34 3a", '=' => "06 56;08 58", '/' => "02 4d", '\\' => "0d 42", '(' => "2d 0a 05 22",
        ')' => "0d 2a 25 02", '[' => "2d 0d 02 22", ']' => "0d 2d 22 02", '<' => "4a 06 42", '>' => "0a 46 02",
        '%' => "03 6c;0a 0c 2c 2a 0a;43 45 65 63 43", '&' => "63 1a 1b 2c 3c 4b 4a 06 04 13 33 57",
        '#' => "13 2c;43 5c;06 66;09 69", '_' => "02 52", '!' => "05 0c;03 04", '?' => "0b 1c 3c 4b 49 27 26;23 24",
        '*' => "36 3c;17 5b;57 1b", '\'' => "0a 0c", '"' => "0a 0c;2a 2c", '|' => "02 0d", '~' => "06 18 27 36 48",
        _ => "03 0c 4c 43 03",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(text: &str, anchor: Anchor, turn_deg: f64) -> Text {
        Text { at: [10.0, 20.0], words: text.into(), size: 10.0, rgb: [0.0; 3], anchor, turn_deg }
    }

    #[test]
    fn a_text_stays_within_its_length_and_about_its_place() {
        for (anchor, from) in [(Anchor::Start, 10.0), (Anchor::Middle, 0.0), (Anchor::End, -10.0)] {
            let t = text("ABCDEfgh 1234", anchor, 0.0);
            let long = length(&t.words, t.size);
            let from = match anchor {
                Anchor::Start => from,
                Anchor::Middle => 10.0 - long / 2.0,
                Anchor::End => 10.0 - long,
            };
            for p in strokes(&t).iter().flatten() {
                assert!(p[0] >= from && p[0] <= from + long, "{p:?}");
                assert!((p[1] - 20.0).abs() < 7.0, "{p:?}");
            }
        }
    }

    #[test]
    fn turned_by_a_right_angle_a_text_runs_upwards() {
        let points: Vec<[f64; 2]> = strokes(&text("IIII", Anchor::Start, 90.0)).concat();
        assert!(points.iter().all(|p| p[1] < 20.0 && (p[0] - 10.0).abs() < 5.0), "{points:?}");
    }
}
