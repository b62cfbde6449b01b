//! Where a model is seen from.

use gridshell::DVec3;

/// From the middle of the model towards the eye; need not be a unit vector.
const TOWARDS_EYE: DVec3 = DVec3::new(-0.45, -0.75, 0.55);
/// Distance of the eye over the radius of the model.
const FAR: f64 = 3.0;
/// The eye of a plan is so many radii above it: as good as infinitely far.
const ABOVE: f64 = 1e6;

/// The two ways of looking at a model.
#[derive(Clone, Copy)]
pub enum View {
    /// From above, without perspective.
    Plan,
    /// From the front, the left and above.
    Perspective,
}

/// An eye and what it sees.
pub struct Camera {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    radius: f64,
    /// Distance from the eye to the middle; infinite without perspective.
    distance: f64,
}

impl View {
    /// The camera that has all points before it.
    pub fn camera(self, points: &[DVec3]) -> Camera {
        let low = points.iter().fold(DVec3::INFINITY, |a, &b| a.min(b));
        let high = points.iter().fold(DVec3::NEG_INFINITY, |a, &b| a.max(b));
        let middle = (low + high) / 2.0;
        let radius = low.distance(high) / 2.0;
        match self {
            View::Plan => Camera {
                eye: middle + DVec3::Z * (ABOVE * radius),
                right: DVec3::X,
                up: DVec3::Y,
                forward: -DVec3::Z,
                radius,
                distance: f64::INFINITY,
            },
            View::Perspective => {
                let forward = -TOWARDS_EYE.normalize();
                let right = forward.cross(DVec3::Z).normalize();
                let (eye, up) = (middle - forward * (FAR * radius), right.cross(forward));
                Camera { eye, right, up, forward, radius, distance: FAR * radius }
            }
        }
    }
}

impl Camera {
    /// Where the eye is.
    pub fn eye(&self) -> DVec3 {
        self.eye
    }

    /// Half the diagonal of the box about the model, metres.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// Right, up and depth of a point. Right and up are metres at the depth of the middle.
    pub fn see(&self, point: DVec3) -> [f64; 3] {
        let ray = point - self.eye;
        let depth = ray.dot(self.forward);
        let scale = if self.distance.is_finite() { self.distance / depth } else { 1.0 };
        [ray.dot(self.right) * scale, ray.dot(self.up) * scale, depth]
    }
}
