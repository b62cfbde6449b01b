//! A chain of carrier edges with exact curves behind it: a boundary loop (closed), or a stretch of a feature
//! between two fixed nodes (open) or round to where it began (closed).
//!
//! Places on a chain are given by their arc length `s` along the carrier's polyline, in metres, from the
//! chain's first vertex. On a closed chain `s` wraps round; on an open one it ends at the ends.

use super::{Carrier, NONE, SurfacePoint};
use crate::math::trig;
use crate::surface::{Curve, Surface};
use glam::DVec3;

/// Tangents at a segment's ends are taken this share of the segment inside it, so that a kink in the
/// curve at the vertex shows.
const INSIDE: f64 = 1e-4;

/// Loops are equally long when their lengths differ by no more than this share: files hold nine digits and more.
const ALIKE: f64 = 1e-7;

/// A turn that comes within this of an angle asked for, radians, is beyond it: the corners of a regular dodecagon turn
/// by thirty degrees, and rounding must not say which of them are corners. Far above what files and tangents leave, far
/// below what is told apart by eye.
const TIE: f64 = 1e-3;

/// Whether a turn by `angle` is beyond the one asked for.
pub(crate) fn exceeds(angle: f64, limit: f64) -> bool {
    angle > limit - TIE
}

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

/// A boundary loop of the surface, or a stretch of a feature.
#[derive(Clone, Debug, Default)]
pub struct Chain {
    /// Carrier vertices in order; of a closed chain the first one is not repeated at the end. A boundary loop
    /// has the surface to its left.
    pub vertices: Vec<u32>,
    /// Segment k leads from vertex k to vertex k + 1 (on a closed chain the last one back to the first).
    pub segments: Vec<Segment>,
    /// Arc length at each vertex, and of a closed chain the whole length at the end.
    pub arc: Vec<f64>,
    /// Places k in `vertices` that are fixed nodes, ascending: corners, ends of features, anchors. The ends of
    /// an open chain are fixed and not listed.
    pub corners: Vec<u32>,
}

/// A place on a chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChainPoint {
    /// Index of the loop, or of the feature.
    pub chain: u32,
    /// Arc length in metres.
    pub s: f64,
}

impl Chain {
    /// Whole length in metres, along the carrier.
    pub fn length(&self) -> f64 {
        self.arc.last().copied().unwrap_or(0.0)
    }

    /// Whether it leads back to where it began.
    pub fn is_closed(&self) -> bool {
        self.segments.len() == self.vertices.len()
    }

    /// `s` brought into [0, length), or on an open chain into [0, length].
    pub fn wrap(&self, s: f64) -> f64 {
        let l = self.length();
        if !self.is_closed() {
            return s.clamp(0.0, l);
        }
        let w = s - (s / l).floor() * l;
        if w < l { w } else { 0.0 }
    }

    /// The segment that holds `s`, and the fraction along it in [0, 1].
    pub fn locate(&self, s: f64) -> (usize, f64) {
        let s = self.wrap(s);
        let last = self.segments.len() - 1;
        // Where segments are equally long, the right one is the first guess.
        let guess = s * (last + 1) as f64 / self.arc[last + 1].max(f64::MIN_POSITIVE);
        let guess = (guess as usize).min(last);
        let k = if self.arc[guess] <= s && s < self.arc[guess + 1] {
            guess
        } else {
            self.arc[1..=last].partition_point(|&a| a <= s)
        };
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
            Some(_) if f == 1.0 => {
                surface.carrier.points[self.vertices[(k + 1) % self.vertices.len()] as usize]
            }
            Some(curve) => curve.point(seg.t[0] + (seg.t[1] - seg.t[0]) * f),
            None => self.xyz(&surface.carrier, s),
        }
    }

    /// Distance of `xyz` from the exact boundary curve of the segment at `s`.
    pub fn deviation(&self, surface: &Surface, s: f64, xyz: DVec3) -> f64 {
        self.foot(surface, s, xyz).distance(xyz)
    }

    /// The foot of `xyz` on the exact boundary curve of the segment at `s`.
    pub fn foot(&self, surface: &Surface, s: f64, xyz: DVec3) -> DVec3 {
        let (k, f) = self.locate(s);
        let n = self.vertices.len();
        // Vertices count as they stand: curves of neighbouring edges need not quite meet in them.
        let ends = [k, k + 1].map(|k| surface.carrier.points[self.vertices[k % n] as usize]);
        let seg = &self.segments[k];
        let foot = match surface.curves.get(seg.curve as usize) {
            None => self.xyz(&surface.carrier, s),
            Some(curve) => {
                let [t0, t1] = seg.t;
                curve.project(t0 + (t1 - t0) * f, [t0.min(t1), t0.max(t1)], xyz).1
            }
        };
        let nearer = |a: DVec3, b: DVec3| {
            if b.distance_squared(xyz) < a.distance_squared(xyz) { b } else { a }
        };
        ends.into_iter().fold(foot, nearer)
    }

    /// The arc length of the point of the carrier's polyline that is nearest to `xyz`, and how far off it is, metres.
    pub fn nearest(&self, carrier: &Carrier, xyz: DVec3) -> (f64, f64) {
        let n = self.vertices.len();
        let on = |k: usize| {
            let [a, b] = [k, k + 1].map(|k| carrier.points[self.vertices[k % n] as usize]);
            let along = b - a;
            let f = (xyz - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
            let f = f.clamp(0.0, 1.0);
            (self.arc[k] + (self.arc[k + 1] - self.arc[k]) * f, (a + along * f).distance(xyz))
        };
        let all = (0..self.segments.len()).map(on);
        all.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0.0, f64::INFINITY))
    }

    /// Mark as corners the vertices where the chain turns by more than `corner_angle` radians, between
    /// the exact tangents where segments have curves and between the segments themselves elsewhere. A
    /// chain with corners is turned to begin at one.
    pub fn find_corners(&mut self, carrier: &Carrier, curves: &[Curve], corner_angle: f64) {
        let n = self.segments.len();
        let ends: Vec<[DVec3; 2]> = (0..n).map(|k| self.end_tangents(carrier, curves, k)).collect();
        self.corners = (0..n)
            .filter(|&k| exceeds(trig::angle(ends[(k + n - 1) % n][1], ends[k][0]), corner_angle))
            .map(|k| k as u32)
            .collect();
        if !self.corners.is_empty() {
            self.begin_at_corner();
            self.measure(carrier);
        }
    }

    /// Directions of segment `k` at its two ends.
    pub(in crate::surface) fn end_tangents(
        &self,
        carrier: &Carrier,
        curves: &[Curve],
        k: usize,
    ) -> [DVec3; 2] {
        let a = carrier.points[self.vertices[k] as usize];
        let b = carrier.points[self.vertices[(k + 1) % self.vertices.len()] as usize];
        let seg = &self.segments[k];
        let Some(curve) = curves.get(seg.curve as usize) else { return [b - a; 2] };
        let [t0, t1] = seg.t;
        [INSIDE, 1.0 - INSIDE].map(|f| {
            let d = curve.jet(t0 + (t1 - t0) * f)[1] * (t1 - t0);
            // A curve with no speed here says nothing of its direction.
            if d.length() > INSIDE * a.distance(b) { d } else { b - a }
        })
    }

    /// Fill in the arc lengths.
    pub(in crate::surface) fn measure(&mut self, carrier: &Carrier) {
        let n = self.vertices.len();
        self.arc = Vec::with_capacity(n + 1);
        let mut s = 0.0;
        for k in 0..self.segments.len() {
            self.arc.push(s);
            let (a, b) = (self.vertices[k], self.vertices[(k + 1) % n]);
            s += carrier.points[a as usize].distance(carrier.points[b as usize]);
        }
        self.arc.push(s);
    }
}

/// The boundary loops of a carrier, longest first. `curve_of(a, b)` names the exact curve behind the
/// carrier edge from vertex a to vertex b, with its parameters at a and at b; None where there is none.
/// Corners are marked by the turning between segments; where there are curves, mark them again with
/// [`Chain::find_corners`].
pub fn boundary_loops(
    carrier: &Carrier,
    corner_angle: f64,
    curve_of: impl Fn(u32, u32) -> Option<(u32, f64, f64)>,
) -> Vec<Chain> {
    // A manifold carrier has at most one boundary edge leaving each vertex.
    let mut leaving: Vec<Option<(u32, u8)>> = vec![None; carrier.points.len()];
    for (t, corners) in carrier.triangles.iter().enumerate() {
        for k in 0..3 {
            if carrier.neighbors[t][k] == NONE {
                leaving[corners[k] as usize] = Some((t as u32, k as u8));
            }
        }
    }
    let mut loops = Vec::new();
    for start in 0..carrier.points.len() {
        let mut chain = Chain::default();
        let mut a = start as u32;
        while let Some((triangle, edge)) = leaving[a as usize].take() {
            let b = carrier.triangles[triangle as usize][(edge as usize + 1) % 3];
            let (curve, t0, t1) = curve_of(a, b).unwrap_or((u32::MAX, 0.0, 0.0));
            chain.vertices.push(a);
            chain.segments.push(Segment { curve, t: [t0, t1], triangle, edge });
            a = b;
        }
        if chain.vertices.len() >= 3 {
            chain.measure(carrier);
            chain.find_corners(carrier, &[], corner_angle);
            loops.push(chain);
        }
    }
    longest_first(&mut loops);
    loops
}

/// Sort by length, the longest first; where lengths only differ by rounding, by the first vertex.
fn longest_first(loops: &mut [Chain]) {
    loops.sort_by(|a, b| b.length().total_cmp(&a.length()));
    let alike = |a: &Chain, b: &Chain| a.length() - b.length() <= ALIKE * a.length();
    for group in loops.chunk_by_mut(alike) {
        group.sort_by_key(|l| l.vertices.iter().min().copied());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::exact::nurbs::NurbsCurve;

    /// A flat ring of 2 n triangles between a square of side 6 and one of side 2.
    fn square_ring() -> Carrier {
        let square =
            |h: f64| [(-h, -h), (h, -h), (h, h), (-h, h)].map(|(x, y)| DVec3::new(x, y, 0.0));
        let points = [square(3.0), square(1.0)].concat();
        let mut triangles = Vec::new();
        for i in 0..4u32 {
            let j = (i + 1) % 4;
            triangles.push([i, j, 4 + j]);
            triangles.push([i, 4 + j, 4 + i]);
        }
        let n = triangles.len();
        Carrier::new(points, triangles, vec![0; n], Vec::new())
    }

    #[test]
    fn ring_has_two_loops_with_the_surface_to_the_left() {
        let carrier = square_ring();
        let loops = boundary_loops(&carrier, 0.5, |_, _| None);
        assert_eq!(loops.len(), 2);
        assert!(
            (loops[0].length() - 24.0).abs() < 1e-12 && (loops[1].length() - 8.0).abs() < 1e-12
        );
        assert_eq!(loops[0].vertices, [0, 1, 2, 3]);
        assert_eq!(loops[1].vertices, [4, 7, 6, 5]);
        assert_eq!(loops[1].corners, [0, 1, 2, 3]);
        for l in &loops {
            for (k, s) in l.segments.iter().enumerate() {
                assert_eq!(carrier.triangles[s.triangle as usize][s.edge as usize], l.vertices[k]);
            }
        }
    }

    #[test]
    fn corners_count_by_the_angle_asked_for() {
        let loops = boundary_loops(&square_ring(), 1.6, |_, _| None);
        assert!(loops.iter().all(|l| l.corners.is_empty()));
    }

    #[test]
    fn coarse_round_hole_has_no_corners_when_its_curve_is_known() {
        // The inner square as four quarter circles of radius sqrt 2.
        let carrier = square_ring();
        let quarter = |a: DVec3, b: DVec3| {
            let w = vec![1.0, std::f64::consts::FRAC_1_SQRT_2, 1.0];
            let knots = vec![0., 0., 0., 1., 1., 1.];
            Curve::Nurbs(NurbsCurve::new(2, knots, vec![a, a + b, b], w).unwrap())
        };
        let curves: Vec<_> =
            (4..8).map(|i| quarter(carrier.points[i], carrier.points[4 + (i - 3) % 4])).collect();
        let curve_of =
            |a: u32, b: u32| (a >= 4 && b >= 4 && (b + 1) % 4 == a % 4).then(|| (b - 4, 1.0, 0.0));
        let mut loops = boundary_loops(&carrier, 0.5, curve_of);
        for l in &mut loops {
            l.find_corners(&carrier, &curves, 0.5);
        }
        assert_eq!(loops[0].corners.len(), 4);
        assert!(loops[1].corners.is_empty());
    }
}
