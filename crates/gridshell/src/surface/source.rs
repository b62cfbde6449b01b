//! Where a model comes from: what a file says of itself.

use serde::Serialize;
use std::fmt;

/// What a file says of itself. What it does not say is empty.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Source {
    /// Format, as people call it: `STEP`, `3DM`, `OBJ`; empty for a built-in surface.
    pub format: String,
    /// Version or dialect of the format: `AP214 ed3 (IS)`.
    pub version: String,
    /// Program that wrote the file.
    pub application: String,
    /// Unit of the file's lengths; None where the file states none.
    pub unit: Option<Unit>,
    /// Objects of the file, in its order; empty where the format knows none.
    pub objects: Vec<Object>,
    /// What of the file's geometry is not in the model; points, curves and what was not asked for do not count.
    pub losses: Vec<Loss>,
}

/// Geometry of a file that could not be taken into the model.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Loss {
    /// What it is, as the user knows it, with its name, layer and entity: `brep "North" on layer "Roof"`, `face #12`.
    pub what: String,
    /// Why it was left out, and how to get it all the same.
    pub why: String,
    /// Number of its faces; 0 where it is not known.
    pub faces: usize,
    /// Its area in square metres; None where it is not known.
    pub area: Option<f64>,
    /// Whether it is an object of its own in the file, rather than a few faces of one.
    pub whole: bool,
}

impl fmt::Display for Loss {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "left out {}", self.what)?;
        let faces = match self.faces {
            0 => None,
            1 => Some("1 face".to_owned()),
            n => Some(format!("{n} faces")),
        };
        let area = self.area.map(|a| format!("{a:.3} m2"));
        let size: Vec<String> = faces.into_iter().chain(area).collect();
        if !size.is_empty() {
            write!(f, " ({})", size.join(", "))?;
        }
        write!(f, ": {}", self.why)
    }
}

/// A unit of length.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Unit {
    /// As people write it: `mm`.
    pub name: String,
    /// Its length in metres.
    pub metres: f64,
}

/// One object of a file.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Object {
    /// Its name; empty where it has none.
    pub name: String,
    /// The layer it is on; empty where it is on none.
    pub layer: String,
    /// What it is: `brep`, `surface`, `extrusion`, `mesh`, ...
    pub kind: String,
    /// Number of faces read from it; 0 where it was left out.
    pub faces: usize,
}

impl Source {
    /// A file of this format that says nothing more.
    pub fn of_format(format: &str) -> Source {
        Source { format: format.to_owned(), ..Source::default() }
    }
}

impl Unit {
    /// The unit of this length in metres, named where it has a name that people write.
    pub fn of_metres(metres: f64) -> Unit {
        const NAMED: [(f64, &str); 9] = [
            (1.0, "m"),
            (1e-1, "dm"),
            (1e-2, "cm"),
            (1e-3, "mm"),
            (1e-6, "um"),
            (1e3, "km"),
            (0.0254, "in"),
            (0.3048, "ft"),
            (0.9144, "yd"),
        ];
        let near = |m: f64| (metres / m - 1.0).abs() < 1e-9;
        let named = NAMED.iter().find(|u| near(u.0));
        let name = named.map_or_else(|| format!("{metres} m"), |u| u.1.to_owned());
        Unit { name, metres }
    }
}

impl Object {
    /// As it is called in lists: its name and its layer.
    pub fn told(&self) -> String {
        let name = if self.name.is_empty() { "unnamed" } else { &self.name };
        let layer = if self.layer.is_empty() {
            String::new()
        } else {
            format!(" on layer `{}`", self.layer)
        };
        format!("{} `{name}`{layer}", self.kind)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_called_as_people_write_them() {
        for (metres, name) in [(1.0, "m"), (0.001, "mm"), (25.4 * 0.001, "in"), (12.0, "12 m")] {
            assert_eq!(Unit::of_metres(metres).name, name);
        }
    }
}
