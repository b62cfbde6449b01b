//! A drawing as marks on paper: what all writers draw. Its unit is a pixel or a millimetre; y downwards.

use gridshell::math::trig;

/// Red, green, blue from 0 to 1.
pub type Rgb = [f64; 3];

/// Paper with marks, the later ones over the earlier.
pub struct Drawing {
    /// Width and height.
    pub size: [f64; 2],
    /// What a step of one is.
    pub unit: Unit,
    /// What it is called, for readers of files.
    pub title: String,
    pub marks: Vec<Mark>,
}

/// What a drawing is measured in.
#[derive(Clone, Copy, PartialEq)]
pub enum Unit {
    Pixel,
    Millimetre,
}

/// One mark.
pub enum Mark {
    /// A filled polygon.
    Area { points: Vec<[f64; 2]>, rgb: Rgb },
    /// A line through points.
    Line { points: Vec<[f64; 2]>, width: f64, rgb: Rgb },
    /// A line of text.
    Text(Text),
}

/// A line of text.
pub struct Text {
    /// The place of its anchor, at half the height of its capitals.
    pub at: [f64; 2],
    pub words: String,
    /// Height of the type; capitals are seven tenths of it.
    pub size: f64,
    pub rgb: Rgb,
    pub anchor: Anchor,
    /// How far it is turned counter-clockwise about the anchor, degrees.
    pub turn_deg: f64,
}

/// What of a text stands at its place.
#[derive(Clone, Copy)]
pub enum Anchor {
    Start,
    Middle,
    End,
}

/// From the middle of capitals down to the ground line, over the size of the type.
pub const GROUND: f64 = 0.36;

impl Unit {
    /// How much triangles of one colour overlap, so that no paper shines through between them.
    pub fn overlap(self) -> f64 {
        match self {
            Unit::Pixel => 0.6,
            Unit::Millimetre => 0.05,
        }
    }
}

impl Drawing {
    /// Paper without marks.
    pub fn new(size: [f64; 2], unit: Unit, title: String) -> Drawing {
        Drawing { size, unit, title, marks: Vec::new() }
    }

    pub fn area(&mut self, points: Vec<[f64; 2]>, rgb: Rgb) {
        self.marks.push(Mark::Area { points, rgb });
    }

    pub fn line(&mut self, points: Vec<[f64; 2]>, width: f64, rgb: Rgb) {
        self.marks.push(Mark::Line { points, width, rgb });
    }

    pub fn text(&mut self, at: [f64; 2], text: &str, size: f64, rgb: Rgb, anchor: Anchor) {
        let words = text.to_owned();
        self.marks.push(Mark::Text(Text { at, words, size, rgb, anchor, turn_deg: 0.0 }));
    }

    /// A filled circle with a ring.
    pub fn disc(&mut self, [x, y]: [f64; 2], radius: f64, rgb: Rgb, ring: Rgb) {
        let corner = |k: usize| {
            let angle = k as f64 * std::f64::consts::TAU / 20.0;
            let (sin, cos) = (trig::sin(angle), trig::cos(angle));
            [x + radius * cos, y + radius * sin]
        };
        self.area((0..20).map(corner).collect(), rgb);
        self.line((0..=20).map(corner).collect(), 0.22 * radius, ring);
    }

    /// A rectangle from its upper left.
    pub fn rectangle(&mut self, [x, y]: [f64; 2], [w, h]: [f64; 2], rgb: Rgb) {
        self.area(vec![[x, y], [x + w, y], [x + w, y + h], [x, y + h]], rgb);
    }
}

impl Mark {
    /// The points of the mark.
    #[cfg(test)]
    pub fn points(&self) -> &[[f64; 2]] {
        match self {
            Mark::Area { points, .. } | Mark::Line { points, .. } => points,
            Mark::Text(text) => std::slice::from_ref(&text.at),
        }
    }
}
