//! Points beyond the border. A patch goes on past its trims, some without end, so a point there has its foot on the
//! patch and yet is off the surface: what counts then is the border.

use super::{NONE, SurfacePoint};
use crate::surface::Surface;
use glam::DVec3;

/// A carrier point with a smaller share of a corner is on the edge opposite to it.
const ON_EDGE: f64 = 1e-9;

/// The border where something lies beyond it.
#[derive(Clone, Copy, Debug)]
pub(in crate::surface) struct Border {
    /// The carrier triangle, and which of its edges.
    pub triangle: u32,
    /// From this corner to the next.
    pub edge: usize,
    /// The border's point that is nearest.
    pub foot: DVec3,
}

impl Surface {
    /// The border at the carrier point `at`, if `xyz`, of which `at` is the nearest place, lies beyond it.
    pub(in crate::surface) fn beyond(&self, at: &SurfacePoint, xyz: DVec3) -> Option<Border> {
        let edges = self.open_edges(at);
        let mut nearest: Option<Border> = None;
        for (t, k) in edges {
            let corners = self.carrier.triangles[t as usize];
            let [a, b] = [k, (k + 1) % 3].map(|k| self.carrier.points[corners[k] as usize]);
            let foot = self.foot_on_edge(t, k, xyz).1;
            let out = (b - a).cross(self.carrier.face_normal(t));
            // Between the carrier's straight edge and the curve behind it a point is on the surface.
            if (xyz - a).dot(out) <= (foot - a).dot(out).max(0.0) {
                return None;
            }
            if nearest.is_none_or(|n| foot.distance(xyz) < n.foot.distance(xyz)) {
                nearest = Some(Border { triangle: t, edge: k, foot });
            }
        }
        nearest
    }

    /// The edges on the border that the carrier point stands on: one, or two at a vertex.
    fn open_edges(&self, at: &SurfacePoint) -> Vec<(u32, usize)> {
        let (t, carrier) = (at.triangle, &self.carrier);
        let open = |t: u32, k: usize| carrier.neighbors[t as usize][k] == NONE;
        if let Some(corner) = (0..3).find(|&k| at.bary[k] >= 1.0 - ON_EDGE) {
            let v = carrier.triangles[t as usize][corner];
            let fan = self.fan_from(t, v);
            let of = |&t: &u32| {
                let holds = move |k: usize| {
                    let c = carrier.triangles[t as usize];
                    open(t, k) && (c[k] == v || c[(k + 1) % 3] == v)
                };
                (0..3).filter(move |&k| holds(k)).map(move |k| (t, k))
            };
            return fan.iter().flat_map(of).collect();
        }
        (0..3).filter(|&k| open(t, k) && at.bary[(k + 2) % 3] <= ON_EDGE).map(|k| (t, k)).collect()
    }

    /// The triangles round `v`, of which `t` is one.
    fn fan_from(&self, t: u32, v: u32) -> Vec<u32> {
        let carrier = &self.carrier;
        let mut fan = vec![t];
        for side in [0, 2] {
            let mut here = t;
            // To the left of `v`, then to the right, each time to the border or once round.
            while let Some(k) = carrier.triangles[here as usize].iter().position(|&c| c == v) {
                here = carrier.neighbors[here as usize][(k + side) % 3];
                if here == NONE || here == t {
                    break;
                }
                fan.push(here);
            }
            if here == t {
                break;
            }
        }
        fan
    }

    /// The point of edge `k` of triangle `t`, or of the curve behind it, that is nearest to `p`: the share of
    /// the edge, and the point.
    pub(in crate::surface) fn foot_on_edge(&self, t: u32, k: usize, p: DVec3) -> (f64, DVec3) {
        let corners = self.carrier.triangles[t as usize];
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        let [start, end] = [a, b].map(|v| self.carrier.points[v as usize]);
        let d = end - start;
        let f = ((p - start).dot(d) / d.length_squared()).clamp(0.0, 1.0);
        let xyz = match self.tracks.curve_of(a, b) {
            Some((curve, t0, t1)) => {
                let range = [t0.min(t1), t0.max(t1)];
                self.curves[curve as usize].project(t0 + (t1 - t0) * f, range, p).1
            }
            None => start + d * f,
        };
        (f, xyz)
    }
}

#[cfg(test)]
mod tests {
    use crate::job::Job;
    use crate::surface::{Locator, Sampling, Surface, builtin};
    use glam::DVec3;

    fn surface(name: &str, l0: f64) -> Surface {
        let sampling = Sampling { max_edge: 0.5 * l0, chord_error: 2e-3 * l0, corner_angle: 0.5 };
        builtin::model(name)
            .expect("built in")
            .surface(&sampling, &Job::default())
            .expect("a surface")
    }

    fn off(surface: &Surface, p: DVec3) -> f64 {
        let place = Locator::new(surface).nearest(p).expect("a place");
        surface.deviation(&place, p)
    }

    #[test]
    fn a_point_beyond_the_border_is_off_the_surface_by_its_distance_from_the_border() {
        for (name, l0) in [("hexagon", 0.5), ("dome", 2.0), ("saddle", 1.0), ("great-court", 4.0)] {
            let surface = surface(name, l0);
            let chain = &surface.loops[0];
            let size = chain.length();
            for share in [0.03, 0.21, 0.48, 0.77] {
                let s = share * size;
                let edge = chain.exact(&surface, s);
                let at = chain.surface_point(s);
                let outward = chain
                    .tangent(&surface.carrier, s)
                    .cross(surface.carrier.normal(&at))
                    .normalize_or_zero();
                let near = off(&surface, edge);
                assert!(near < 1e-9 * size, "{name}: the border itself is {near:e} off");
                for far in [0.01 * l0, 0.1 * l0, 0.5 * l0] {
                    let found = off(&surface, edge + outward * far);
                    assert!(
                        (found / far - 1.0).abs() < 0.1,
                        "{name} at {share}: {found} for {far}"
                    );
                }
            }
        }
    }
}
