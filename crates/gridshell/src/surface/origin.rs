//! Where a model lies, so that one far from its file's origin is worked on as if it were near.
//!
//! Doubles tell half a nanometre apart at four million metres, and a grid is a long chain of comparisons: whatever
//! is computed in such coordinates differs from the same near the origin. So a model is moved when it is read, and
//! all that comes in beside it (guides, anchors, grids) with it; what goes out is moved back. In between, every
//! coordinate is *local*. Both ways are exact but for the file's own rounding: by Sterbenz' lemma the difference of two
//! doubles is one where neither is twice the other.

use glam::DVec3;

/// A model is moved along an axis where its middle is further out than this many of its sizes, rounded up to a power
/// of ten. Less would move models that lose no digit worth having and change their grids by a rounding; more would
/// leave more to rounding.
const FAR: f64 = 4.0;
/// It is moved by whole multiples of at least this many metres. Together with powers of ten this has a roof drawn at
/// (500000, 4000000) come to lie where it is drawn at (0, 0), so that both give the same grid.
const LEAST_STEP: f64 = 1.0;

/// The place of local coordinates' origin in those of the file, metres. Zero for what is near.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Origin(DVec3);

impl Origin {
    /// For what lies between these least and largest coordinates of a file.
    pub fn of_box(low: DVec3, high: DVec3) -> Origin {
        let size = (high - low).length();
        if !size.is_finite() || size == 0.0 {
            return Origin::default();
        }
        let step = step(size);
        let along = |middle: f64| {
            if middle.abs() <= FAR * step {
                return 0.0;
            }
            (middle / step).round_ties_even() * step
        };
        Origin((0.5 * (low + high)).to_array().map(along).into())
    }

    /// For these points of a file.
    pub fn of_points(points: &[DVec3]) -> Origin {
        let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (low, high) = points.iter().fold(start, |(low, high), &p| (low.min(p), high.max(p)));
        Origin::of_box(low, high)
    }

    /// Local coordinates of a point of the file.
    pub fn local(self, file: DVec3) -> DVec3 {
        if self.is_near() { file } else { file - self.0 }
    }

    /// The file's coordinates of a local point.
    pub fn world(self, local: DVec3) -> DVec3 {
        if self.is_near() { local } else { local + self.0 }
    }

    /// A local point as people read it, to millimetres, in the file's coordinates.
    pub fn told(self, local: DVec3) -> String {
        let p = self.world(local);
        format!("({:.3}, {:.3}, {:.3})", p.x, p.y, p.z)
    }

    /// Whether local coordinates are the file's.
    pub fn is_near(self) -> bool {
        self.0 == DVec3::ZERO
    }
}

/// The power of ten, in metres, that is no less than a size. By comparisons: the same on every machine.
fn step(size: f64) -> f64 {
    let mut step = LEAST_STEP;
    while step < size {
        step *= 10.0;
    }
    step
}

#[cfg(test)]
mod tests {
    use super::*;

    fn box_at(middle: [f64; 3], half: [f64; 3]) -> Origin {
        let (middle, half) = (DVec3::from(middle), DVec3::from(half));
        Origin::of_box(middle - half, middle + half)
    }

    #[test]
    fn near_models_stay_and_far_ones_come_to_where_they_are_drawn_near() {
        for near in [[0.0; 3], [20.0, 15.0, 3.0], [-90.0, 60.0, 1.0]] {
            let half = [20.0, 15.0, 3.0];
            assert!(box_at(near, half).is_near(), "{near:?}");
            let far = [500_000.0 + near[0], -4_000_000.0 + near[1], near[2]];
            let local = box_at(far, half).local(DVec3::from(far));
            assert!(local.abs().max_element() <= 90.0, "{near:?} {local}");
        }
        let round = box_at([500_020.0, 4_000_015.0, 3.0], [20.0, 15.0, 3.0]);
        assert_eq!(
            round.local(DVec3::new(500_020.0, 4_000_015.0, 3.0)),
            DVec3::new(20.0, 15.0, 3.0)
        );
    }

    #[test]
    fn what_comes_in_goes_out_bit_for_bit() {
        let origin = box_at([653_217.37, 5_412_983.3, -1e6], [37.0, 21.0, 8.0]);
        for k in 0..1000 {
            let off =
                DVec3::new(f64::from(k) * 0.0371, f64::from(k) * 0.0123, f64::from(k) / 117.0);
            let file = DVec3::new(653_200.0, 5_412_970.0, -1e6) + off;
            assert_eq!(origin.world(origin.local(file)), file);
        }
        // Not even the sign of zero changes near the origin.
        assert!(Origin::default().world(-DVec3::ZERO).x.is_sign_negative());
    }

    #[test]
    fn models_without_extent_or_measure_stay() {
        assert!(box_at([5e8; 3], [0.0; 3]).is_near());
        assert!(Origin::of_points(&[]).is_near());
        assert!(box_at([f64::NAN; 3], [1.0; 3]).is_near());
    }
}
