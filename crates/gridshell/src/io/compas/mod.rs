//! COMPAS meshes as JSON.

pub(super) mod read;
pub(super) mod write;
