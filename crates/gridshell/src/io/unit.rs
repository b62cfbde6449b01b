//! The unit of a file's lengths, as the designer says it or the file does.

use crate::error::{Error, Result};
use crate::surface::{Model, Unit};
use serde::{Deserialize, Serialize};
use std::str::FromStr;

/// A unit of length that meshes are drawn in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LengthUnit {
    /// 0.001 m.
    Millimetre,
    /// 0.01 m.
    Centimetre,
    /// 1 m.
    Metre,
    /// 0.0254 m.
    Inch,
    /// 0.3048 m.
    Foot,
}

impl LengthUnit {
    /// Its length in metres.
    pub fn metres(self) -> f64 {
        match self {
            LengthUnit::Millimetre => 0.001,
            LengthUnit::Centimetre => 0.01,
            LengthUnit::Metre => 1.0,
            LengthUnit::Inch => 0.0254,
            LengthUnit::Foot => 0.3048,
        }
    }

    /// As people write it: `mm`.
    pub fn name(self) -> &'static str {
        match self {
            LengthUnit::Millimetre => "mm",
            LengthUnit::Centimetre => "cm",
            LengthUnit::Metre => "m",
            LengthUnit::Inch => "in",
            LengthUnit::Foot => "ft",
        }
    }

    /// The unit that a comment states: a word for one behind `unit`, `units` or `lengths`.
    pub(super) fn stated(comment: &str) -> Option<LengthUnit> {
        let mut words =
            comment.split(|c: char| !c.is_ascii_alphanumeric()).filter(|w| !w.is_empty());
        let heralds = ["unit", "units", "lengths"];
        words.find(|w| heralds.iter().any(|h| w.eq_ignore_ascii_case(h)))?;
        // `in` is the inch where nothing follows it, as in `units: in`.
        let rest: Vec<&str> = words.collect();
        if let [only] = rest.as_slice() {
            return word(only);
        }
        rest.into_iter().filter(|w| !w.eq_ignore_ascii_case("in")).find_map(word)
    }
}

/// Units are the same where their lengths differ by no more than this share.
const SAME: f64 = 1e-9;

/// Have a model's lengths in the unit that is wanted, whatever its file states: tags are often wrong.
///
/// # Errors
/// As [`Model::scale`].
pub(super) fn take(model: &mut Model, wanted: Option<LengthUnit>) -> Result<()> {
    let Some(wanted) = wanted else { return Ok(()) };
    let of_brep = match model {
        Model::Brep(brep) => Some(Unit::of_metres(brep.unit_in_metres)),
        Model::Mesh(_) => None,
    };
    let stated = model.source().unit.clone().or(of_brep).unwrap_or_else(|| Unit::of_metres(1.0));
    let factor = wanted.metres() / stated.metres;
    if (factor - 1.0).abs() <= SAME {
        return Ok(());
    }
    model.scale(factor)?;
    let note = format!("the file states {}, but {} was asked for", stated.name, wanted.name());
    let source = match model {
        Model::Brep(brep) => {
            brep.unit_in_metres = wanted.metres();
            brep.notes.push(note);
            &mut brep.source
        }
        Model::Mesh(mesh) => {
            mesh.notes.push(note);
            &mut mesh.source
        }
    };
    for area in source.losses.iter_mut().filter_map(|l| l.area.as_mut()) {
        *area *= factor * factor;
    }
    Ok(())
}

/// The unit that one word means.
fn word(word: &str) -> Option<LengthUnit> {
    Some(match word.to_ascii_lowercase().as_str() {
        "mm" | "millimetre" | "millimetres" | "millimeter" | "millimeters" => {
            LengthUnit::Millimetre
        }
        "cm" | "centimetre" | "centimetres" | "centimeter" | "centimeters" => {
            LengthUnit::Centimetre
        }
        "m" | "metre" | "metres" | "meter" | "meters" => LengthUnit::Metre,
        "in" | "inch" | "inches" => LengthUnit::Inch,
        "ft" | "foot" | "feet" => LengthUnit::Foot,
        _ => return None,
    })
}

impl FromStr for LengthUnit {
    type Err = Error;

    fn from_str(text: &str) -> Result<LengthUnit> {
        word(text).ok_or_else(|| {
            Error::Option(format!(
                "`{text}` is not a unit of length; the units are mm, cm, m, in, ft"
            ))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_state_units_and_other_comments_do_not() {
        for (comment, unit) in [
            (" File units = millimeters", Some(LengthUnit::Millimetre)),
            ("units: in", Some(LengthUnit::Inch)),
            ("Units: Feet", Some(LengthUnit::Foot)),
            ("edge length 2 m, seed 1, lengths in metres", Some(LengthUnit::Metre)),
            ("1 unit = 1 cm", Some(LengthUnit::Centimetre)),
            ("the unit is in the north", None),
            ("12 mm plate", None),
            ("", None),
        ] {
            assert_eq!(LengthUnit::stated(comment), unit, "{comment}");
        }
        assert!("yard".parse::<LengthUnit>().is_err());
        assert_eq!("ft".parse::<LengthUnit>().expect("a unit").metres(), 0.3048);
    }
}
