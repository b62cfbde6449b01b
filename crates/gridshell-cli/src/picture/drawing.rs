//! A drawing as marks on paper: what both writers draw. Pixels, y downwards.

/// Red, green, blue from 0 to 1.
pub type Rgb = [f64; 3];

/// Paper with marks, the later ones over the earlier.
pub struct Drawing {
    /// Width and height.
    pub size: [f64; 2],
    pub marks: Vec<Mark>,
}

/// One mark.
pub enum Mark {
    /// A filled polygon.
    Area { points: Vec<[f64; 2]>, rgb: Rgb },
    /// A line through points.
    Line { points: Vec<[f64; 2]>, width: f64, rgb: Rgb },
    /// A line whose y is counted from the foot line.
    Foot { points: Vec<[f64; 2]>, width: f64, rgb: Rgb },
    /// Digits, points and the letter m, about `at`; `foot`: whether its y is counted from the foot line.
    Text { at: [f64; 2], text: String, size: f64, rgb: Rgb, foot: bool },
}

/// Height of the foot line above the lower edge.
const FOOT_LINE: f64 = 20.0;

impl Drawing {
    /// Put the marks of the foot where they belong.
    pub fn put_down_feet(&mut self) {
        let ground = self.size[1] - FOOT_LINE;
        for mark in &mut self.marks {
            match mark {
                Mark::Foot { points, width, rgb } => {
                    let points = points.iter().map(|p| [p[0], p[1] + ground]).collect();
                    *mark = Mark::Line { points, width: *width, rgb: *rgb };
                }
                Mark::Text { at, foot, .. } if *foot => {
                    at[1] += ground;
                    *foot = false;
                }
                _ => {}
            }
        }
    }
}

impl Mark {
    /// The points of the mark.
    #[cfg(test)]
    pub fn points(&self) -> &[[f64; 2]] {
        match self {
            Mark::Area { points, .. } | Mark::Line { points, .. } | Mark::Foot { points, .. } => {
                points
            }
            Mark::Text { at, .. } => std::slice::from_ref(at),
        }
    }
}
