//! Where a view stands on the paper.

use super::view::Camera;
use gridshell::DVec3;

/// The part of the picture plane that holds what is seen.
#[derive(Clone, Copy)]
pub struct Extent {
    /// Least and largest right and up, metres.
    pub low: [f64; 2],
    pub high: [f64; 2],
}

impl Extent {
    /// Of these points.
    pub fn of(camera: &Camera, points: &[DVec3]) -> Extent {
        let mut extent = Extent { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };
        for &p in points {
            let seen = camera.see(p);
            for k in 0..2 {
                extent.low[k] = extent.low[k].min(seen[k]);
                extent.high[k] = extent.high[k].max(seen[k]);
            }
        }
        extent
    }

    /// Width and height, metres.
    pub fn size(&self) -> [f64; 2] {
        [self.high[0] - self.low[0], self.high[1] - self.low[1]]
    }
}

/// From the picture plane to the paper.
pub struct Frame {
    /// Paper per metre.
    pub scale: f64,
    /// Where the extent's upper left stands.
    at: [f64; 2],
    corner: [f64; 2],
}

impl Frame {
    /// The extent with its upper left at this place.
    pub fn new(extent: &Extent, scale: f64, at: [f64; 2]) -> Frame {
        Frame { scale, at, corner: [extent.low[0], extent.high[1]] }
    }

    /// The extent in the middle of a rectangle with this upper left.
    pub fn centred(extent: &Extent, scale: f64, at: [f64; 2], room: [f64; 2]) -> Frame {
        let size = extent.size().map(|x| x * scale);
        Frame::new(extent, scale, [0, 1].map(|k| at[k] + 0.5 * (room[k] - size[k])))
    }

    /// Where something seen stands on the paper.
    pub fn place(&self, seen: [f64; 3]) -> [f64; 2] {
        [
            self.at[0] + (seen[0] - self.corner[0]) * self.scale,
            self.at[1] + (self.corner[1] - seen[1]) * self.scale,
        ]
    }
}

/// The largest of 1, 2 and 5 times a power of ten that is at most `most`, metres.
pub fn round_length(most: f64) -> f64 {
    let power = (-12..12).rev().map(|k| 10f64.powi(k)).find(|&p| p <= most).unwrap_or(1e-12);
    [5.0, 2.0, 1.0].map(|f| f * power).into_iter().find(|&l| l <= most).unwrap_or(power)
}
