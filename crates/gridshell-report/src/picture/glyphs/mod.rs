//! Letters as strokes, as on technical drawings: no font is asked for. Their widths are those of Helvetica, so a text
//! is as long in every format.

mod accents;
mod letters;

use super::drawing::{Anchor, GROUND, Text};
use gridshell::math::trig;

/// Pen width of strokes over the size of the type.
pub const PEN: f64 = 0.1;
/// One step of the raster over the size of the type.
const STEP: f64 = 0.08;
/// The ground line on the raster.
const GROUND_LINE: f64 = 3.0;
/// Width of a step and of the room about it, where Helvetica is not asked: thousandths of the size.
const STEP_WIDTH: u32 = 80;
const ROOM_WIDTH: u32 = 170;
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
        let (own, wide) = character(c);
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

/// Width of a character, thousandths of the size.
fn width(c: char) -> u32 {
    let c = accents::parted(c).map_or(c, |(base, _)| base);
    let k = (c as usize).wrapping_sub(' ' as usize);
    WIDTHS.get(k).copied().unwrap_or_else(|| ROOM_WIDTH + STEP_WIDTH * character(c).1 as u32)
}

/// The strokes of a character on the raster, and how wide they are without accents.
fn character(c: char) -> (Vec<Vec<[f64; 2]>>, f64) {
    let (base, accent) = accents::parted(c).map_or((c, None), |(base, a)| (base, Some(a)));
    let mut strokes: Vec<_> = letters::strokes(base).split(';').map(points).collect();
    let bound = |k: usize| {
        let along = || strokes.iter().flatten().map(|p: &[f64; 2]| p[k]);
        [along().fold(f64::INFINITY, f64::min), along().fold(0.0, f64::max)]
    };
    let ([left, right], [_, top]) = (bound(0), bound(1));
    if let Some(accent) = accent {
        let middle = f64::midpoint(left, right);
        let place = |[x, y]: [f64; 2]| accent.place([x, y], middle, top);
        let marks = accent.strokes().split(';').map(points);
        strokes.extend(marks.map(|s| s.into_iter().map(place).collect()));
    }
    (strokes, right - left.min(right))
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
    fn names_of_other_tongues_are_written_and_not_left_out() {
        let unknown = strokes(&text("\u{4e00}", Anchor::Start, 0.0));
        for name in
            ["Großbölting", "Århus", "Łódź", "Čeřín", "Señor Ibáñez", "Θόλος", "μ δ ° ² × – „“ €"]
        {
            for c in name.chars().filter(|c| *c != ' ') {
                let drawn = strokes(&text(&c.to_string(), Anchor::Start, 0.0));
                assert!(!drawn.is_empty() && drawn != unknown, "{c} in {name}");
            }
        }
        let marks = |s: &str| strokes(&text(s, Anchor::Start, 0.0)).len();
        assert_eq!((marks("u"), marks("ü"), marks("ű")), (2, 4, 4));
        assert_eq!(length("Müller", 10.0), length("Muller", 10.0));
    }

    #[test]
    fn turned_by_a_right_angle_a_text_runs_upwards() {
        let points: Vec<[f64; 2]> = strokes(&text("IIII", Anchor::Start, 90.0)).concat();
        assert!(points.iter().all(|p| p[1] < 20.0 && (p[0] - 10.0).abs() < 5.0), "{points:?}");
    }
}
