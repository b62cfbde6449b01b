//! The one door for edits.

/// Why an edit was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {}

/// What undoes a run of edits.
#[derive(Clone, Debug, Default)]
pub struct Undo {}
