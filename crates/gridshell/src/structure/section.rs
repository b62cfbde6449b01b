//! Cross-sections of members: `RHS 100x60x5`, `CHS 88.9x5`, `REC 120x60`, in millimetres.

use crate::error::{Error, Result};
use std::f64::consts::PI;

/// A cross-section. Millimetres.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// As people write it.
    pub name: String,
    /// Its shape.
    pub shape: Shape,
}

/// The shapes of sections. Millimetres; the height stands along the member's local z axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Rectangular hollow section, hot finished (EN 10210): corners of radius 1.5 t outside and t inside.
    Tube {
        /// Height.
        height: f64,
        /// Width.
        width: f64,
        /// Wall t.
        wall: f64,
    },
    /// Circular hollow section.
    Pipe {
        /// Outer diameter.
        diameter: f64,
        /// Wall.
        wall: f64,
    },
    /// Solid rectangle.
    Bar {
        /// Height.
        height: f64,
        /// Width.
        width: f64,
    },
}

/// What a linear frame needs of a section. Metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Properties {
    /// Area A, m2.
    pub area: f64,
    /// Second moment about the local y axis, m4: of bending out of the surface.
    pub iy: f64,
    /// Second moment about the local z axis, m4.
    pub iz: f64,
    /// Torsion constant, m4.
    pub torsion: f64,
}

/// Nothing larger is a member, millimetres.
const LARGEST: f64 = 10_000.0;

impl Default for Section {
    fn default() -> Self {
        let shape = Shape::Tube { height: 100.0, width: 60.0, wall: 5.0 };
        Section { name: "RHS 100x60x5".to_owned(), shape }
    }
}

impl std::str::FromStr for Section {
    type Err = Error;

    fn from_str(text: &str) -> Result<Section> {
        let wrong = || {
            Error::Option(format!(
                "no section {text:?}: give RHS height x width x wall, CHS diameter x wall or REC height x width in \
                 millimetres, for instance RHS 100x60x5"
            ))
        };
        let letters = text.trim().find(|c: char| !c.is_ascii_alphabetic()).ok_or_else(wrong)?;
        let (kind, sizes) = text.trim().split_at(letters);
        let sizes: Option<Vec<f64>> =
            sizes.split(['x', 'X', '*']).map(|w| w.trim().parse().ok()).collect();
        let sizes = sizes.ok_or_else(wrong)?;
        let shape = match (kind.to_ascii_uppercase().as_str(), sizes.as_slice()) {
            ("RHS", &[height, width, wall]) => Shape::Tube { height, width, wall },
            ("CHS", &[diameter, wall]) => Shape::Pipe { diameter, wall },
            ("REC", &[height, width]) => Shape::Bar { height, width },
            _ => return Err(wrong()),
        };
        if !shape.is_possible() {
            return Err(wrong());
        }
        let sizes: Vec<String> = sizes.iter().map(f64::to_string).collect();
        let name = format!("{} {}", kind.to_ascii_uppercase(), sizes.join("x"));
        Ok(Section { name, shape })
    }
}

impl Shape {
    fn is_possible(self) -> bool {
        let size = |x: f64| x > 0.0 && x <= LARGEST;
        match self {
            // The inner corners' radius is the wall, so the opening is at least twice that.
            Shape::Tube { height, width, wall } => {
                size(height) && size(width) && size(wall) && 4.0 * wall <= height.min(width)
            }
            Shape::Pipe { diameter, wall } => size(diameter) && size(wall) && 2.0 * wall < diameter,
            Shape::Bar { height, width } => size(height) && size(width),
        }
    }

    /// Outer and inner corner radius of a tube, millimetres.
    pub fn radii(wall: f64) -> [f64; 2] {
        [1.5 * wall, wall]
    }

    /// Area, second moments, torsion.
    pub fn properties(self) -> Properties {
        let (area, iy, iz, torsion) = match self {
            Shape::Tube { height, width, wall } => tube(height, width, wall),
            Shape::Pipe { diameter, wall } => {
                let inner = diameter - 2.0 * wall;
                let i = PI / 64.0 * (diameter.powi(4) - inner.powi(4));
                (PI / 4.0 * (diameter * diameter - inner * inner), i, i, 2.0 * i)
            }
            Shape::Bar { height, width } => {
                let (a, b) = (height.max(width), height.min(width));
                let torsion = a
                    * b.powi(3)
                    * (1.0 / 3.0 - 0.21 * b / a * (1.0 - b.powi(4) / (12.0 * a.powi(4))));
                let iy = width * height.powi(3) / 12.0;
                (height * width, iy, height * width.powi(3) / 12.0, torsion)
            }
        };
        Properties { area: area * 1e-6, iy: iy * 1e-12, iz: iz * 1e-12, torsion: torsion * 1e-12 }
    }
}

/// A, Iy, Iz, It of a rectangular hollow section, EN 10210-2, Annex A; millimetres.
fn tube(h: f64, b: f64, t: f64) -> (f64, f64, f64, f64) {
    let [ro, ri] = Shape::radii(t);
    let area = 2.0 * t * (b + h - 2.0 * t) - (4.0 - PI) * (ro * ro - ri * ri);
    // What a rounded corner takes away: its area, and its moment about the axis at half of height h.
    let corner = |r: f64, h: f64| {
        let own = (1.0 / 3.0 - PI / 16.0 - 1.0 / (3.0 * (12.0 - 3.0 * PI))) * r.powi(4);
        let arm = h / 2.0 - (10.0 - 3.0 * PI) / (12.0 - 3.0 * PI) * r;
        own + (1.0 - PI / 4.0) * r * r * arm * arm
    };
    let second = |h: f64, b: f64| {
        let (hi, bi) = (h - 2.0 * t, b - 2.0 * t);
        b * h.powi(3) / 12.0 - bi * hi.powi(3) / 12.0 - 4.0 * corner(ro, h) + 4.0 * corner(ri, hi)
    };
    let mid = f64::midpoint(ro, ri);
    let around = 2.0 * ((b - t) + (h - t)) - 2.0 * mid * (4.0 - PI);
    let within = (b - t) * (h - t) - mid * mid * (4.0 - PI);
    let torsion = t.powi(3) * around / 3.0 + 4.0 * within * within * t / around;
    (area, second(h, b), second(b, h), torsion)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// EN 10210-2, Table B.3: 100 x 60 x 5 has 14.7 cm2, 189 and 83.6 cm4, torsion 188 cm4.
    #[test]
    fn a_hollow_section_has_the_figures_of_its_standard() {
        let p = Section::default().shape.properties();
        assert!((p.area * 1e4 - 14.7).abs() < 0.05, "{p:?}");
        assert!((p.iy * 1e8 - 189.0).abs() < 0.5, "{p:?}");
        assert!((p.iz * 1e8 - 83.6).abs() < 0.05, "{p:?}");
        assert!((p.torsion * 1e8 - 188.0).abs() < 0.5, "{p:?}");
    }

    #[test]
    fn sections_are_understood_or_refused_with_an_example() {
        let section: Section = " chs 88.9 x 5 ".parse().expect("a pipe");
        assert_eq!(section.name, "CHS 88.9x5");
        assert_eq!(section.shape, Shape::Pipe { diameter: 88.9, wall: 5.0 });
        for text in ["", "RHS", "RHS 100x60", "IPE 200", "CHS 10x5", "REC 0x5", "REC nanx5"] {
            let error = text.parse::<Section>().expect_err(text).to_string();
            assert!(error.contains("RHS 100x60x5"), "{error}");
        }
    }
}
