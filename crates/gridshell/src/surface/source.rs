//! Where a model comes from: what a file says of itself.

use crate::math::digits::three;
use serde::Serialize;
use std::fmt;

/// A grid is not laid unasked where more than this share of a file's area could not be read: less is no more than a
/// sliver or a fillet, which the grid would bridge all the same.
const MOST_LOST: f64 = 0.01;
/// Losses that are told one by one; more are only counted.
const MOST_TOLD: usize = 20;

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
    /// About its area in square metres; None where it is not known.
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
        let area = self.area.map(|a| format!("about {} m2", three(a)));
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

    /// Whether so much is missing that nobody would take what was read, `area` square metres, for the file's surface:
    /// a whole object, an unknown area, or more than a hundredth of all.
    pub fn is_incomplete(&self, area: f64) -> bool {
        let unknown = self.losses.iter().any(|loss| loss.whole || loss.area.is_none());
        let lost: f64 = self.losses.iter().filter_map(|loss| loss.area).sum();
        unknown || lost > MOST_LOST * (area + lost)
    }

    /// The losses a line each; of many the largest part is only counted.
    pub fn told_losses(&self) -> Vec<String> {
        // Whole objects first: they are what is missed most.
        let (whole, parts): (Vec<&Loss>, Vec<&Loss>) = self.losses.iter().partition(|l| l.whole);
        let all: Vec<&Loss> = whole.into_iter().chain(parts).collect();
        let mut told: Vec<String> = all.iter().take(MOST_TOLD).map(ToString::to_string).collect();
        let rest = all.get(MOST_TOLD..).unwrap_or_default();
        if !rest.is_empty() {
            let faces: usize = rest.iter().map(|loss| loss.faces).sum();
            told.push(format!(
                "left out {} more with {faces} faces; `inspect --json` lists all of them",
                rest.len()
            ));
        }
        told
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

    fn lost(area: Option<f64>, whole: bool) -> Source {
        let loss =
            Loss { what: "face #12".into(), why: "it is crumpled".into(), faces: 1, area, whole };
        Source { losses: vec![loss], ..Source::of_format("STEP") }
    }

    #[test]
    fn a_hundredth_may_be_missing_and_no_whole_object() {
        assert!(!Source::of_format("STEP").is_incomplete(100.0));
        assert!(!lost(Some(0.9), false).is_incomplete(99.1));
        assert!(lost(Some(1.1), false).is_incomplete(98.9));
        assert!(lost(Some(0.1), true).is_incomplete(99.9));
        assert!(lost(None, false).is_incomplete(99.9));
    }

    #[test]
    fn losses_are_told_with_digits_that_fit_and_many_are_counted() {
        let mut source = lost(Some(3.2e-5), false);
        assert_eq!(
            source.told_losses(),
            ["left out face #12 (1 face, about 3.20e-5 m2): it is crumpled"]
        );
        source.losses = vec![source.losses[0].clone(); MOST_TOLD + 7];
        let told = source.told_losses();
        assert_eq!(told.len(), MOST_TOLD + 1);
        assert!(told[MOST_TOLD].starts_with("left out 7 more with 7 faces"), "{told:?}");
    }

    #[test]
    fn units_are_called_as_people_write_them() {
        for (metres, name) in [(1.0, "m"), (0.001, "mm"), (25.4 * 0.001, "in"), (12.0, "12 m")] {
            assert_eq!(Unit::of_metres(metres).name, name);
        }
    }
}
