//! glTF 2.0.

mod document;
mod numbers;
pub(super) mod read;
pub(super) mod write;
