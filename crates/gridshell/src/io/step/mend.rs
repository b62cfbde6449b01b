//! A STEP file's text put into words that the parser knows, one thing after the other.

use super::text::Text;
use super::{axes, envelope, facets, numbers, sets, swept, trimmed, units};

/// In this order: what is added by one may be changed by the next.
const STEPS: [fn(&Text) -> Option<Vec<u8>>; 6] =
    [numbers::mended, units::mended, axes::mended, facets::mended, sets::mended, swept::mended];

/// The text, and what was done that the user should know.
pub(super) fn mended(bytes: Vec<u8>) -> (Text, Vec<String>) {
    let (bytes, notes) = envelope::clean(bytes);
    let mut text = Text::of(bytes);
    for step in STEPS {
        if let Some(changed) = step(&text) {
            text = Text::of(changed);
        }
    }
    let bytes = trimmed::without(std::mem::take(&mut text.bytes));
    (Text::of(bytes), notes)
}
