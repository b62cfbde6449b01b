//! Materials by name.

use crate::error::{Error, Result};

/// A material: what a linear frame needs, and its weight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Name, which is its grade.
    pub name: &'static str,
    /// Kind: Steel, Timber, Aluminium, Other.
    pub kind: &'static str,
    /// Young's modulus, MPa.
    pub youngs_mpa: f64,
    /// Shear modulus, MPa.
    pub shear_mpa: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// Density, kg/m3.
    pub density: f64,
    /// Thermal expansion, 1/K.
    pub expansion: f64,
}

/// Structural steel, EN 1993-1-1, 3.2.6.
const fn steel(name: &'static str) -> Material {
    Material {
        name,
        kind: "Steel",
        youngs_mpa: 210_000.0,
        shear_mpa: 80_769.0,
        poisson: 0.3,
        density: 7850.0,
        expansion: 12e-6,
    }
}

impl Material {
    /// All that are known.
    pub const ALL: [Material; 5] = [
        steel("S235"),
        steel("S275"),
        steel("S355"),
        // EN 14080: mean values of homogeneous glued laminated timber.
        Material {
            name: "GL24h",
            kind: "Timber",
            youngs_mpa: 11_500.0,
            shear_mpa: 650.0,
            poisson: 0.3,
            density: 420.0,
            expansion: 5e-6,
        },
        // EN 1999-1-1, 3.2.5.
        Material {
            name: "EN AW-6082",
            kind: "Aluminium",
            youngs_mpa: 70_000.0,
            shear_mpa: 27_000.0,
            poisson: 0.3,
            density: 2700.0,
            expansion: 23e-6,
        },
    ];

    /// The material of this name.
    ///
    /// # Errors
    /// [`Error::Option`] listing the names when there is none.
    pub fn named(name: &str) -> Result<Material> {
        let found = Material::ALL.iter().find(|m| m.name.eq_ignore_ascii_case(name.trim()));
        found.copied().ok_or_else(|| {
            let names: Vec<&str> = Material::ALL.iter().map(|m| m.name).collect();
            Error::Option(format!("no material {name:?}; there are: {}", names.join(", ")))
        })
    }
}

impl Default for Material {
    fn default() -> Self {
        steel("S355")
    }
}
