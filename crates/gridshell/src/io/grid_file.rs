//! What a grid file holds, whatever its format.

use glam::DVec3;

/// A grid to be written. Metres.
#[derive(Clone, Copy, Debug)]
pub struct GridFile<'a> {
    /// Node positions.
    pub xyz: &'a [DVec3],
    /// Panels, counter-clockwise seen from outside.
    pub triangles: &'a [[u32; 3]],
    /// Members.
    pub edges: &'a [(u32, u32)],
    /// Lines for the head of the file: version, seed, units. No line breaks inside.
    pub header: &'a [String],
}
