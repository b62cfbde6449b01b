//! A chain of carrier edges with exact curves behind it: a boundary loop (closed), later also a feature.
//!
//! Places on a chain are given by their arc length `s` along the carrier's polyline, in metres, from the
//! chain's first vertex. On a closed chain `s` wraps round.

use super::{Carrier, Surface, SurfacePoint};
use glam::DVec3;

/// One segment of a chain: the carrier edge from vertex k to the next one.
#[derive(Clone, Copy, Debug)]
pub struct Segment {
    /// Index into [`Surface::curves`], or `u32::MAX` where the input was a mesh.
    pub curve: u32,
    /// Curve parameters at the segment's two ends, in the chain's direction.
    pub t: [f64; 2],
    /// The carrier triangle on the left.
    pub triangle: u32,
    /// Which edge of that triangle it is: from its corner `edge` to corner `edge + 1`.
    pub edge: u8,
}

/// A boundary loop of the surface.
#[derive(Clone, Debug, Default)]
pub struct Chain {
    /// Carrier vertices in order, the first one not repeated at the end; surface to the left.
    pub vertices: Vec<u32>,
    /// Segment k leads from vertex k to vertex k + 1 (the last one back to the first).
    pub segments: Vec<Segment>,
    /// Arc length at each vertex, and the whole length at the end: `vertices.len() + 1` numbers.
    pub arc: Vec<f64>,
    /// Places k in `vertices` that are corners, ascending.
    pub corners: Vec<u32>,
}

/// A place on a chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChainPoint {
    /// Index of the loop.
    pub chain: u32,
    /// Arc length in metres.
    pub s: f64,
}

impl Chain {
    /// Whole length in metres, along the carrier.
    pub fn length(&self) -> f64 {
        self.arc[self.vertices.len()]
    }

    /// `s` brought into [0, length).
    pub fn wrap(&self, s: f64) -> f64 {
        let l = self.length();
        let w = s - (s / l).floor() * l;
        if w < l { w } else { 0.0 }
    }

    /// The segment that holds `s`, and the fraction along it in [0, 1].
    pub fn locate(&self, s: f64) -> (usize, f64) {
        let s = self.wrap(s);
        let k = self.arc.partition_point(|&a| a <= s).clamp(1, self.segments.len()) - 1;
        let (a, b) = (self.arc[k], self.arc[k + 1]);
        (k, if b > a { ((s - a) / (b - a)).clamp(0.0, 1.0) } else { 0.0 })
    }

    /// Position on the carrier at `s`.
    pub fn xyz(&self, carrier: &Carrier, s: f64) -> DVec3 {
        let (k, f) = self.locate(s);
        let a = carrier.points[self.vertices[k] as usize];
        let b = carrier.points[self.vertices[(k + 1) % self.vertices.len()] as usize];
        a + (b - a) * f
    }

    /// The carrier point at `s`.
    pub fn surface_point(&self, s: f64) -> SurfacePoint {
        let (k, f) = self.locate(s);
        let seg = self.segments[k];
        let mut bary = [0.0; 3];
        bary[seg.edge as usize] = 1.0 - f;
        bary[(seg.edge as usize + 1) % 3] = f;
        SurfacePoint { triangle: seg.triangle, bary }
    }

    /// Unit tangent of the carrier's polyline at `s`, in the chain's direction.
    pub fn tangent(&self, carrier: &Carrier, s: f64) -> DVec3 {
        let (k, _) = self.locate(s);
        let a = carrier.points[self.vertices[k] as usize];
        let b = carrier.points[self.vertices[(k + 1) % self.vertices.len()] as usize];
        (b - a).normalize_or_zero()
    }

    /// The exact boundary point at `s`: the edge curve evaluated at the interpolated parameter.
    pub fn exact(&self, surface: &Surface, s: f64) -> DVec3 {
        let (k, f) = self.locate(s);
        let seg = self.segments[k];
        match surface.curves.get(seg.curve as usize) {
            // A vertex of the chain is exact as it stands: edges snap their ends to it.
            Some(_) if f == 0.0 => surface.carrier.points[self.vertices[k] as usize],
            Some(curve) => curve.point(seg.t[0] + (seg.t[1] - seg.t[0]) * f),
            None => self.xyz(&surface.carrier, s),
        }
    }
}
