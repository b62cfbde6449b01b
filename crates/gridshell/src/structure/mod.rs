//! What hand-over files state beside the grid: section and material of the members, the panes, the supports. They
//! are stated assumptions for the engineer to replace, no design.

mod material;
mod section;
mod supports;

pub use material::Material;
pub use section::{Properties, Section, Shape};
pub use supports::Supports;

use crate::error::{Error, Result};

/// Members and panels as engineering formats want them.
#[derive(Clone, Debug, PartialEq)]
pub struct Structure {
    /// Section of all members, its height along the members' local z axis.
    pub section: Section,
    /// Material of all members.
    pub material: Material,
    /// Thickness of the panels, millimetres.
    pub pane_mm: f64,
    /// Version of SAF files.
    pub saf: SafVersion,
}

/// Versions of the Structural Analysis Format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SafVersion {
    /// 1.0.5, for older programs.
    V105,
    /// 2.0.0.
    #[default]
    V200,
}

impl SafVersion {
    /// As files state it.
    pub fn number(self) -> &'static str {
        match self {
            SafVersion::V105 => "1.0.5",
            SafVersion::V200 => "2.0.0",
        }
    }
}

impl std::str::FromStr for SafVersion {
    type Err = Error;

    fn from_str(text: &str) -> Result<SafVersion> {
        let all = [SafVersion::V105, SafVersion::V200];
        all.into_iter().find(|v| v.number() == text).ok_or_else(|| {
            Error::Option(format!("no SAF version {text:?}; there are: 2.0.0, 1.0.5"))
        })
    }
}

impl Structure {
    /// Material of the panels.
    pub const PANE: Material = Material {
        name: "Float glass",
        kind: "Other",
        youngs_mpa: 70_000.0,
        shear_mpa: 28_455.0,
        poisson: 0.23,
        density: 2500.0,
        expansion: 9e-6,
    };

    /// Mass of members of this length in all, kg; metres from node to node.
    pub fn member_mass(&self, length: f64) -> f64 {
        self.section.shape.properties().area * self.material.density * length
    }

    /// Mass of panels of this area in all, kg; m2 between the members' axes.
    pub fn pane_mass(&self, area: f64) -> f64 {
        1e-3 * self.pane_mm * Self::PANE.density * area
    }
}

impl Default for Structure {
    /// Steel S355, hollow sections 100 x 60 x 5 mm set upright, panes of 16 mm.
    fn default() -> Self {
        Structure {
            section: Section::default(),
            material: Material::default(),
            pane_mm: 16.0,
            saf: SafVersion::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A timber bar of 1 dm2 weighs 4.2 kg a metre, float glass 2.5 kg a square metre and millimetre.
    #[test]
    fn masses_are_those_of_the_tables() {
        let structure = Structure {
            section: "REC 100x100".parse().expect("a section"),
            material: Material::named("GL24h").expect("a material"),
            pane_mm: 10.0,
            ..Structure::default()
        };
        assert!((structure.member_mass(7.0) - 29.4).abs() < 1e-9);
        assert!((structure.pane_mass(4.0) - 100.0).abs() < 1e-9);
    }
}
