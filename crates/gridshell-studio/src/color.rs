//! The table of colourings for the page: what there is, and the colors of a grid as a frame.

use crate::frame::Frame;
use crate::laid::{Laid, Now};
use crate::message::{Coloring, Label, Scale, Shows};
use axum::body::Bytes;
use gridshell_report::colourings::{self, Colouring, Subject};

/// What stands for an element without a color.
const NO_STEP: u32 = u32::MAX;

/// All that the table has.
pub fn colorings() -> Vec<Coloring> {
    let told =
        |c: &Colouring| Coloring { name: c.key.into(), label: c.label.into(), help: c.help.into() };
    colourings::ALL.iter().map(told).collect()
}

/// The colors of a kept grid as it is now, as a frame; None for a way that is not in the table.
pub fn frame(laid: &Laid, by: &str) -> Option<Bytes> {
    let colouring = colourings::of(by)?;
    let colours = colouring.colours(&subject(laid, &laid.now()));
    let label = |(at, text): &(f64, String)| Label { at: *at, text: text.clone() };
    let scale = Scale {
        by: colouring.key.into(),
        title: colours.scale.title.clone(),
        on: colouring.on.name().into(),
        inks: colours.scale.hexes(),
        labels: colours.scale.labels.iter().map(label).collect(),
        note: colours.scale.note.clone(),
        all_nodes: colours.all_nodes(),
    };
    let steps = colours.steps.iter().map(|s| s.map_or(NO_STEP, u32::from));
    let frame = Frame::new(Shows::Colors, laid.number).scaled(scale);
    Some(frame.wholes("steps", steps).bytes())
}

/// The grid as it is now, in the order in which the page has its elements.
pub fn subject<'a>(laid: &'a Laid, now: &'a Now) -> Subject<'a> {
    Subject::edited(&laid.design, &now.grid, &now.surface)
}
