//! glTF 2.0.

pub(super) mod write;
