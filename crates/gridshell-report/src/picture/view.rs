//! Where a model is seen from.

use gridshell::DVec3;

/// From the middle of the model towards the eye of a perspective; need not be a unit vector.
const TOWARDS_EYE: DVec3 = DVec3::new(-0.45, -0.75, 0.55);
/// The same for an isometric view: equal angles with all axes.
const ISOMETRIC: DVec3 = DVec3::new(-1.0, -1.0, 1.0);
/// Distance of the eye over the radius of the model.
const FAR: f64 = 3.0;
/// The eye of a parallel view is so many radii away: as good as infinitely far.
const AWAY: f64 = 1e6;

/// The ways of looking at a model. All but the perspective are parallel, so lengths can be measured in them.
#[derive(Clone, Copy, PartialEq)]
pub enum View {
    /// From above, x to the right.
    Plan,
    /// Along y, x to the right.
    Front,
    /// From the side of the largest x.
    Right,
    /// Against y.
    Back,
    /// From the side of the least x.
    Left,
    /// From the front, the left and above, at equal angles with all axes.
    Isometric,
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
    /// As a sheet calls it.
    pub fn name(self) -> &'static str {
        match self {
            View::Plan => "plan",
            View::Front => "front, along y",
            View::Right => "right, against x",
            View::Back => "back, against y",
            View::Left => "left, along x",
            View::Isometric => "isometric",
            View::Perspective => "perspective",
        }
    }

    /// The camera that has all points before it.
    pub fn camera(self, points: &[DVec3]) -> Camera {
        let low = points.iter().fold(DVec3::INFINITY, |a, &b| a.min(b));
        let high = points.iter().fold(DVec3::NEG_INFINITY, |a, &b| a.max(b));
        let middle = (low + high) / 2.0;
        let radius = low.distance(high) / 2.0;
        let towards = match self {
            View::Plan => DVec3::Z,
            View::Front => -DVec3::Y,
            View::Right => DVec3::X,
            View::Back => DVec3::Y,
            View::Left => -DVec3::X,
            View::Isometric => ISOMETRIC.normalize(),
            View::Perspective => TOWARDS_EYE.normalize(),
        };
        let forward = -towards;
        let right = match self {
            View::Plan => DVec3::X,
            _ => forward.cross(DVec3::Z).normalize(),
        };
        let up = right.cross(forward);
        let (away, distance) = match self {
            View::Perspective => (FAR * radius, FAR * radius),
            _ => (AWAY * radius, f64::INFINITY),
        };
        Camera { eye: middle + towards * away, right, up, forward, radius, distance }
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
