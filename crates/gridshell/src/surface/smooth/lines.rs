//! The lines that stay sharp, boundary and creases, and how they run: smoothly between corners, ends and junctions.

use super::net::Net;
use super::patch::square_to;
use crate::math::trig;
use crate::surface::carrier::chain::exceeds;
use glam::DVec3;

/// Where two sides turn so plainly, a line between them runs as their planes meet.
const PLAIN: f64 = 0.3;

/// Boundary and creases of a net.
pub(super) struct Lines {
    /// Of each triangle, whether the edge from corner k to corner k + 1 lies on a line.
    pub edges: Vec<[bool; 3]>,
    /// The vertices before and after each vertex inside a line, and the line's unit tangent there.
    within: Vec<Option<([u32; 2], DVec3)>>,
}

impl Lines {
    pub(super) fn of(net: &Net, crease_angle: f64, corner_angle: f64) -> Lines {
        let all = 0..net.triangles.len() as u32;
        let edges: Vec<[bool; 3]> =
            all.map(|t| [0, 1, 2].map(|k| net.is_line(t, k, crease_angle))).collect();
        let mut beside: Vec<Vec<u32>> = vec![Vec::new(); net.points.len()];
        for (t, corners) in net.triangles.iter().enumerate() {
            for k in (0..3).filter(|&k| edges[t][k]) {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                beside[a as usize].push(b);
                beside[b as usize].push(a);
            }
        }
        let within = beside.into_iter().enumerate().map(|(v, mut ends)| {
            // A crease is met from both its sides.
            ends.sort_unstable();
            ends.dedup();
            let [before, after] = *ends.as_slice() else { return None };
            let [p, q, r] = [before, v as u32, after].map(|v| net.points[v as usize]);
            let (come, go) = (q - p, r - q);
            let smooth = !exceeds(trig::angle(come, go), corner_angle);
            // The tangent of the circle through the three.
            let tangent =
                come.normalize_or_zero() * go.length() + go.normalize_or_zero() * come.length();
            smooth.then(|| ([before, after], tangent.normalize_or_zero()))
        });
        let within = within.collect();
        Lines { edges, within }
    }

    /// Unit tangent of the line that vertex `v` is inside; None at corners, ends, junctions, and off all lines.
    pub(super) fn tangent(&self, v: u32) -> Option<DVec3> {
        self.within[v as usize].map(|w| w.1)
    }

    /// Direction in which the line through the edge from `v` to `w` leaves `v`; `sides` are the unit normals of the
    /// surface at `v` on the edge's sides.
    pub(super) fn leaving(&self, net: &Net, v: u32, w: u32, sides: &[DVec3]) -> DVec3 {
        if let Some(direction) = self.towards(v, w) {
            return direction;
        }
        let chord = (net.points[w as usize] - net.points[v as usize]).normalize_or_zero();
        // As the circle does that arrives at `w` in the line's direction there.
        let back = self.towards(w, v).map_or(chord, |back| -back);
        let guess = chord * (2.0 * chord.dot(back)) - back;
        let both = sides.iter().copied().reduce(DVec3::cross).unwrap_or(guess);
        let ridge = both * both.dot(guess).signum();
        if sides.len() == 2 && ridge.dot(guess) > PLAIN {
            return ridge.normalize();
        }
        sides.iter().fold(guess, |direction, &normal| square_to(normal, direction))
    }

    /// Tangent at `v`, inside a line, towards its neighbour `w` there.
    fn towards(&self, v: u32, w: u32) -> Option<DVec3> {
        let ([_, after], tangent) = self.within[v as usize]?;
        Some(if w == after { tangent } else { -tangent })
    }
}
