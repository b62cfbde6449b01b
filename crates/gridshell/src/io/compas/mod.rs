//! COMPAS meshes as JSON.

pub(super) mod write;
