//! How finely a model is sampled.

/// How finely a model is sampled.
#[derive(Clone, Copy, Debug)]
pub struct Sampling {
    /// Carrier edges are at most this long, metres.
    pub max_edge: f64,
    /// Largest distance between the carrier and the exact surface, metres.
    pub chord_error: f64,
    /// Boundary vertices turning by more than this are corners, radians.
    pub corner_angle: f64,
}
