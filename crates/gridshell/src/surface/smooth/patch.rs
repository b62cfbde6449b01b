//! A smooth patch over one triangle, from its corners' normals and its sides (Nielson 1987, side-vertex method).
//!
//! From each corner, arcs lead to all points of the side across. The three surfaces that they sweep are blended so that
//! on each side one of them alone counts, to first order: place and tangent plane there are those of the side, the same
//! for the triangle beyond it.

use glam::DVec3;

/// A cubic between two points, with given directions there; of a circle's directions very nearly the circle.
#[derive(Clone, Copy)]
pub(super) struct Arc([DVec3; 4]);

impl Arc {
    /// From `p` to `q`, leaving in the direction `from` and arriving in the direction `to`, both of unit length.
    pub(super) fn new(p: DVec3, from: DVec3, q: DVec3, to: DVec3) -> Arc {
        let chord = q - p;
        let length = chord.length();
        // Two thirds of the chord over 1 + cos of the angle to it: right for a circle's arc to sixth order.
        let reach = |direction: DVec3| {
            let along = direction.dot(chord).max(0.0);
            direction * (2.0 * length * length / (3.0 * (length + along)).max(f64::MIN_POSITIVE))
        };
        Arc([p, p + reach(from), q - reach(to), q])
    }

    /// From `p` to `q`, perpendicular to a normal at each.
    pub(super) fn between(p: DVec3, at_p: DVec3, q: DVec3, at_q: DVec3) -> Arc {
        let chord = q - p;
        Arc::new(p, square_to(at_p, chord), q, square_to(at_q, chord))
    }

    fn point(&self, t: f64) -> DVec3 {
        let [a, b, c, d] = self.0;
        let u = 1.0 - t;
        a * (u * u * u) + b * (3.0 * u * u * t) + c * (3.0 * u * t * t) + d * (t * t * t)
    }

    /// A third of the velocity.
    fn velocity(&self, t: f64) -> DVec3 {
        let [a, b, c, d] = self.0;
        let u = 1.0 - t;
        (b - a) * (u * u) + (c - b) * (2.0 * u * t) + (d - c) * (t * t)
    }
}

/// The unit vector nearest to `v` that is perpendicular to the unit vector `normal`.
pub(super) fn square_to(normal: DVec3, v: DVec3) -> DVec3 {
    let flat = v - normal * normal.dot(v);
    flat.try_normalize().unwrap_or_else(|| v.normalize_or_zero())
}

/// One side of a patch, as the triangle beyond it has it too.
#[derive(Clone, Copy)]
pub(super) struct Side {
    /// Its curve.
    pub arc: Arc,
    /// Unit normals of the surface at its ends.
    pub normals: [DVec3; 2],
}

impl Side {
    /// Point and unit normal of the surface: between the ends' normals, and perpendicular to the curve.
    fn at(&self, s: f64) -> (DVec3, DVec3) {
        let along = self.arc.velocity(s).normalize_or_zero();
        (self.arc.point(s), square_to(along, self.normals[0].lerp(self.normals[1], s)))
    }
}

/// A patch.
pub(super) struct Patch {
    /// Its corners.
    pub corners: [DVec3; 3],
    /// Unit normals of the surface there.
    pub normals: [DVec3; 3],
    /// Side k lies across corner k, and leads from corner k + 1 to corner k + 2.
    pub sides: [Side; 3],
}

impl Patch {
    /// The point at these barycentric coordinates.
    pub(super) fn point(&self, bary: [f64; 3]) -> DVec3 {
        let [a, b, c] = bary;
        let weights = [b * b * c * c, c * c * a * a, a * a * b * b];
        let sum: f64 = weights.iter().sum();
        if sum == 0.0 {
            // A corner.
            return (0..3).map(|k| self.corners[k] * bary[k]).sum();
        }
        let swept = |k: usize| {
            let [next, last] = [bary[(k + 1) % 3], bary[(k + 2) % 3]];
            let (foot, normal) = self.sides[k].at(last / (next + last));
            Arc::between(self.corners[k], self.normals[k], foot, normal).point(1.0 - bary[k])
        };
        let counts = (0..3).filter(|&k| weights[k] > 0.0);
        counts.map(|k| swept(k) * (weights[k] / sum)).sum()
    }
}
