//! How faces look in the light.

use super::drawing::Rgb;
use super::view::Camera;
use gridshell::DVec3;

/// Where the light comes from; need not be a unit vector.
const LIGHT: DVec3 = DVec3::new(-0.4, -0.3, 1.0);
/// What is taken from the brightness of faces along the light, and of those seen from below.
const SHADE: f64 = 0.35;
const BELOW: f64 = 0.12;

/// The colour of a face with this unit normal at this place.
pub fn lit(rgb: Rgb, normal: DVec3, at: DVec3, camera: &Camera) -> Rgb {
    let lit = 1.0 - SHADE * (1.0 - normal.dot(LIGHT.normalize()).abs());
    let below = if normal.dot(camera.eye() - at) < 0.0 { BELOW } else { 0.0 };
    rgb.map(|x| x * (lit - below))
}
