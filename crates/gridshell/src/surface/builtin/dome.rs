//! A hemisphere of radius 10 m.

use super::sketch::{Sketch, along};
use super::sphere::{RADIUS, equator, half};
use crate::surface::Brep;
use glam::DVec3;

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("dome");
    let rim = equator(&mut sketch);
    sketch.face(half(DVec3::ZERO, RADIUS, DVec3::Y, DVec3::Z), vec![vec![along(rim)]]);
    sketch.finish()
}
