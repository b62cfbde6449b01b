//! Points and weights of the file as they are worked with: placed, in metres.

use crate::surface::nurbs::{FARTHEST, reach};
use glam::{DMat4, DVec3};

/// Points of the file at their place in metres.
pub(super) fn placed<'a>(
    points: impl Iterator<Item = &'a [f64; 3]>,
    place: DMat4,
) -> Result<Vec<DVec3>, String> {
    let placed = points.map(|&p| reach(place.transform_point3(p.into()), FARTHEST));
    placed.collect::<Result<_, _>>().map_err(|e| e.to_string())
}

/// Weights, or none where all are 1.
pub(super) fn plain(weights: Vec<f64>) -> Vec<f64> {
    if weights.iter().all(|&w| w == 1.0) { Vec::new() } else { weights }
}
