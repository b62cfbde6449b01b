//! The numbering of a carrier that every file of one surface gets.
//!
//! Files of one roof list its faces, edges and loops in different orders and begin them at different places, and
//! round the last digits differently. Sums that are taken in another order round differently too, and the search
//! makes another grid of that. So triangles are numbered as they are met when the carrier is walked through from a
//! place that its shape alone says: only the choice of that place looks at coordinates.

use crate::surface::Carrier;
use crate::surface::carrier::{NONE, adjacency};
use glam::{DVec2, DVec3};
use std::collections::VecDeque;

/// A direction in which no two places of a sensible surface are equally far out: no symmetry plane is perpendicular to
/// it, and it lies in none.
const OUT: DVec3 = DVec3::new(0.737_51, 0.541_13, 0.404_27);

/// New places of points and triangles.
pub(super) struct Order {
    /// New number of each point, [`NONE`] for those that no triangle uses.
    pub points: Vec<u32>,
    /// For each new triangle its old number and the corner that is now its first.
    pub triangles: Vec<(u32, usize)>,
}

impl Order {
    /// The carrier of these triangles, renumbered.
    pub fn carrier(
        &self,
        points: &[DVec3],
        triangles: &[[u32; 3]],
        patch: &[u32],
        uv: &[[DVec2; 3]],
    ) -> Carrier {
        let used = self.points.iter().filter(|&&v| v != NONE).count();
        let mut placed = vec![DVec3::ZERO; used];
        for (&p, &v) in points.iter().zip(&self.points).filter(|p| *p.1 != NONE) {
            placed[v as usize] = p;
        }
        let turned = |&(t, first): &(u32, usize)| [0, 1, 2].map(|k| (t as usize, (first + k) % 3));
        let corners = self.triangles.iter().map(turned);
        Carrier::new(
            placed,
            corners
                .clone()
                .map(|c| c.map(|(t, k)| self.points[triangles[t][k] as usize]))
                .collect(),
            self.triangles.iter().map(|&(t, _)| patch[t as usize]).collect(),
            corners.map(|c| c.map(|(t, k)| uv[t][k])).collect(),
        )
    }
}

/// The order in which a walk meets `triangles` over `points`: breadth first, each piece from its outermost point.
pub(super) fn of(points: &[DVec3], triangles: &[[u32; 3]]) -> Order {
    let neighbors = adjacency(triangles);
    let out: Vec<f64> = points.iter().map(|p| p.dot(OUT)).collect();
    let mut order =
        Order { points: vec![NONE; points.len()], triangles: Vec::with_capacity(triangles.len()) };
    let mut met = vec![false; triangles.len()];
    let mut count = 0;
    let mut open = VecDeque::new();
    for (t, k) in starts(triangles, &out) {
        if std::mem::replace(&mut met[t as usize], true) {
            continue;
        }
        open.push_back((t, k));
        while let Some((t, first)) = open.pop_front() {
            order.triangles.push((t, first));
            for k in (0..3).map(|k| (first + k) % 3) {
                let here = triangles[t as usize][k];
                let number = &mut order.points[here as usize];
                if *number == NONE {
                    *number = count;
                    count += 1;
                }
                let next = neighbors[t as usize][k];
                if next == NONE || std::mem::replace(&mut met[next as usize], true) {
                    continue;
                }
                // The edge runs the other way there, and ends at the corner that is its first here.
                let end = triangles[next as usize].iter().position(|&c| c == here);
                open.push_back((next, end.expect("neighbours share an edge")));
            }
        }
    }
    order
}

/// For each point the triangle and its corner there whose edge leads farthest out; the outermost point first.
fn starts(triangles: &[[u32; 3]], out: &[f64]) -> Vec<(u32, usize)> {
    let ahead = |(t, k): (u32, usize)| out[triangles[t as usize][(k + 1) % 3] as usize];
    let mut leads: Vec<Option<(u32, usize)>> = vec![None; out.len()];
    for (t, corners) in triangles.iter().enumerate() {
        for (k, &v) in corners.iter().enumerate() {
            let (lead, this) = (&mut leads[v as usize], (t as u32, k));
            if lead.is_none_or(|lead| ahead(this) > ahead(lead)) {
                *lead = Some(this);
            }
        }
    }
    let mut points: Vec<usize> = (0..out.len()).collect();
    points.sort_by(|&a, &b| out[b].total_cmp(&out[a]));
    points.into_iter().filter_map(|v| leads[v]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of squares, each cut in two, with a gap in the middle: two pieces. And a point that is not used.
    fn pieces() -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let points = (0..21).map(|i| DVec3::new(f64::from(i / 2), f64::from(i % 2), 0.1)).collect();
        let squares = (0..9).filter(|&i| i != 4).map(|i| 2 * i);
        let triangles = squares.flat_map(|a| [[a, a + 2, a + 1], [a + 1, a + 2, a + 3]]).collect();
        (points, triangles)
    }

    fn carrier(points: &[DVec3], triangles: &[[u32; 3]]) -> Carrier {
        let n = triangles.len();
        of(points, triangles).carrier(points, triangles, &vec![0; n], &vec![[DVec2::ZERO; 3]; n])
    }

    #[test]
    fn however_points_and_triangles_are_listed_the_carrier_is_the_same() {
        let (points, triangles) = pieces();
        let first = carrier(&points, &triangles);
        assert_eq!((first.points.len(), first.triangles.len()), (20, 16));
        let mut rng = fastrand::Rng::with_seed(1);
        for _ in 0..20 {
            let mut places: Vec<u32> = (0..points.len() as u32).collect();
            rng.shuffle(&mut places);
            let mut shuffled = vec![DVec3::ZERO; points.len()];
            for (p, &place) in points.iter().zip(&places) {
                shuffled[place as usize] = *p;
            }
            let mut turned: Vec<[u32; 3]> =
                triangles.iter().map(|t| t.map(|v| places[v as usize])).collect();
            rng.shuffle(&mut turned);
            for t in &mut turned {
                t.rotate_left(rng.usize(..3));
            }
            let other = carrier(&shuffled, &turned);
            assert_eq!((&other.points, &other.triangles), (&first.points, &first.triangles));
        }
    }
}
