//! Which bubbles can touch: near one another in space *and* on the same sheet of the surface.

use crate::surface::{Carrier, SurfacePoint};
use glam::DVec3;
use rayon::prelude::*;

/// Neighbours of points that move, brought up to date from time to time.
#[derive(Default)]
pub struct Neighbors {
    /// Neighbours of each point, in ascending order.
    pub lists: Vec<Vec<u32>>,
    /// Points as near as neighbours, but on another sheet; of each pair, those of the higher index.
    apart: Vec<Vec<u32>>,
    /// Where each point was when all that are near it were last walked to.
    walked_at: Vec<DVec3>,
}

impl Neighbors {
    /// List the neighbours within `radius` anew. A neighbour counts only if walking along the chord on the carrier
    /// arrives at it, so the other sheet of a fold is not a neighbour however near. Points that were neighbours the last
    /// time are on one sheet; those that were on two are walked again once either has moved by `stray`.
    pub fn list(
        &mut self,
        carrier: &Carrier,
        points: &[SurfacePoint],
        xyz: &[DVec3],
        radius: f64,
        stray: f64,
    ) {
        let cells = Cells::new(xyz, radius);
        let has = |lists: &[Vec<u32>], i: usize, j| {
            lists.get(i).is_some_and(|list| list.binary_search(&j).is_ok())
        };
        self.walked_at.resize(points.len(), DVec3::INFINITY);
        let strayed: Vec<bool> =
            xyz.iter().zip(&self.walked_at).map(|(p, &q)| p.distance(q) > stray).collect();
        let (mut lists, apart): (Vec<Vec<u32>>, Vec<Vec<u32>>) = (0..points.len())
            .into_par_iter()
            .map(|i| {
                let mut near = cells.near(xyz[i]);
                near.retain(|&j| {
                    j as usize > i && xyz[i].distance_squared(xyz[j as usize]) < radius * radius
                });
                near.sort_unstable();
                near.into_iter().partition(|&j| {
                    let again = strayed[i] || strayed[j as usize] || !has(&self.apart, i, j);
                    has(&self.lists, i, j)
                        || again && same_sheet(carrier, &points[i], xyz[j as usize], radius)
                })
            })
            .unzip();
        for i in (0..points.len()).filter(|&i| strayed[i]) {
            self.walked_at[i] = xyz[i];
        }
        // Each pair was looked at from one side: the other learns of it, the least neighbours first.
        let mut both: Vec<Vec<u32>> = vec![Vec::new(); points.len()];
        for (i, list) in lists.iter().enumerate() {
            for &j in list {
                both[j as usize].push(i as u32);
            }
        }
        for (all, above) in both.iter_mut().zip(&mut lists) {
            all.append(above);
        }
        (self.lists, self.apart) = (both, apart);
    }
}

/// Whether walking from `from` along the straight line to `target` arrives there.
fn same_sheet(carrier: &Carrier, from: &SurfacePoint, target: DVec3, radius: f64) -> bool {
    let start = carrier.xyz(from);
    let mut at = *from;
    for share in [0.25, 0.5, 0.75, 1.0] {
        at = carrier.follow(&at, start.lerp(target, share));
    }
    carrier.xyz(&at).distance(target) < 0.1 * radius
}

/// Points sorted into cubes of space.
struct Cells {
    size: f64,
    /// (cube, point), sorted.
    members: Vec<([i64; 3], u32)>,
}

impl Cells {
    fn new(xyz: &[DVec3], size: f64) -> Cells {
        let mut members: Vec<_> =
            xyz.iter().enumerate().map(|(i, &p)| (cube(p, size), i as u32)).collect();
        members.sort_unstable();
        Cells { size, members }
    }

    /// The points in the 27 cubes round `p`.
    fn near(&self, p: DVec3) -> Vec<u32> {
        let [x, y, z] = cube(p, self.size);
        let mut found = Vec::new();
        for dx in -1..=1 {
            for dy in -1..=1 {
                // The three cubes above one another are neighbours in the sorted list.
                let first = [x + dx, y + dy, z - 1];
                let last = [x + dx, y + dy, z + 1];
                let start = self.members.partition_point(|m| m.0 < first);
                let column = self.members[start..].iter().take_while(|m| m.0 <= last);
                found.extend(column.map(|m| m.1));
            }
        }
        found
    }
}

fn cube(p: DVec3, size: f64) -> [i64; 3] {
    (p / size).floor().to_array().map(|x| x as i64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two sheets 0.1 apart, joined by a wall at x = 0.
    fn pocket() -> Carrier {
        let points = [[3.0, 0.0], [0.0, 0.0], [0.0, 0.1], [3.0, 0.1]];
        let points =
            points.iter().flat_map(|&[x, z]| [0.0, 3.0].map(|y| DVec3::new(x, y, z))).collect();
        let triangles = [0, 2, 4].iter().flat_map(|&k| [[k, k + 2, k + 1], [k + 1, k + 2, k + 3]]);
        let triangles: Vec<[u32; 3]> = triangles.collect();
        let patch = vec![0; triangles.len()];
        Carrier::new(points, triangles, patch, Vec::new())
    }

    /// Waves shorter than a member had thousands of pairs that were walked in vain at every list.
    #[test]
    fn sheets_stay_apart_and_one_sheet_together_however_often_they_are_listed() {
        let carrier = pocket();
        // Two points on the lower sheet, one above the first.
        let points = [(0, [0.5, 0.3, 0.2]), (0, [0.5, 0.2, 0.3]), (4, [0.3, 0.4, 0.3])]
            .map(|(triangle, bary)| SurfacePoint { triangle, bary });
        let xyz = points.map(|p| carrier.xyz(&p));
        let mut neighbors = Neighbors::default();
        for _ in 0..8 {
            neighbors.list(&carrier, &points, &xyz, 1.0, 0.0);
            assert_eq!(neighbors.lists, [vec![1], vec![0], vec![]]);
        }
    }

    /// A pair that was apart is walked again once one of its points has come round the fold.
    #[test]
    fn points_that_come_round_a_fold_become_neighbours() {
        let carrier = pocket();
        let lower = SurfacePoint { triangle: 0, bary: [0.5, 0.3, 0.2] };
        let upper = SurfacePoint { triangle: 4, bary: [0.3, 0.4, 0.3] };
        let mut neighbors = Neighbors::default();
        let mut listed = |points: [SurfacePoint; 2]| {
            let xyz = points.map(|p| carrier.xyz(&p));
            neighbors.list(&carrier, &points, &xyz, 1.0, 0.1);
            neighbors.lists.clone()
        };
        assert_eq!(listed([lower, upper]), vec![Vec::<u32>::new(); 2]);
        let round = SurfacePoint { triangle: 4, bary: [0.35, 0.35, 0.3] };
        assert_eq!(listed([round, upper]), [vec![1], vec![0]]);
    }
}
