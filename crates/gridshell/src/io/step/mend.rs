//! A STEP file's text put into words that the parser knows, one thing after the other.

use super::operators::{self, Operators};
use super::text::Text;
use super::{axes, envelope, facets, numbers, sets, swept, trimmed, units};

/// Gives the changed text, or None where nothing is to be changed.
type Step = fn(&Text) -> Option<Vec<u8>>;

/// In this order: what is added by one may be changed by the next.
const STEPS: [Step; 5] =
    [numbers::mended, units::mended, axes::mended, facets::mended, sets::mended];

/// A text for the parser, and what it does not say.
pub(super) struct Mended {
    pub text: Text,
    pub operators: Operators,
    /// What was done that the user should know.
    pub notes: Vec<String>,
}

/// The text in words that the parser knows.
pub(super) fn mended(bytes: Vec<u8>) -> Mended {
    let (bytes, notes) = envelope::clean(bytes);
    let mut text = Text::of(bytes);
    for step in STEPS {
        if let Some(changed) = step(&text) {
            text = Text::of(changed);
        }
    }
    text = Text::of(trimmed::without(text.bytes));
    // What is swept may have been swept under a trimmed surface.
    if let Some(changed) = swept::mended(&text) {
        text = Text::of(changed);
    }
    let mut operators = Operators::default();
    if let Some((changed, found)) = operators::mended(&text) {
        text = Text::of(changed);
        operators = found;
    }
    Mended { text, operators, notes }
}
