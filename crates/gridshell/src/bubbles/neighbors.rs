//! Which bubbles can touch: near one another in space *and* on the same sheet of the surface.

use crate::surface::{Carrier, SurfacePoint};
use glam::DVec3;
use rayon::prelude::*;

/// Neighbours of each point within `radius`, in ascending order. A neighbour counts only if walking along
/// the chord on the carrier arrives at it, so the other sheet of a fold is no neighbour however near. Points
/// that were neighbours in `before` (empty, or lists of the same points a little while ago) are on one sheet.
pub fn neighbors(
    carrier: &Carrier,
    points: &[SurfacePoint],
    xyz: &[DVec3],
    radius: f64,
    before: &[Vec<u32>],
) -> Vec<Vec<u32>> {
    let cells = Cells::new(xyz, radius);
    let mut lists: Vec<Vec<u32>> = (0..points.len())
        .into_par_iter()
        .map(|i| {
            let known = before.get(i).map_or(&[][..], Vec::as_slice);
            let mut near = cells.near(xyz[i]);
            near.retain(|&j| {
                j as usize > i
                    && xyz[i].distance_squared(xyz[j as usize]) < radius * radius
                    && (known.binary_search(&j).is_ok()
                        || same_sheet(carrier, &points[i], xyz[j as usize], radius))
            });
            near.sort_unstable();
            near
        })
        .collect();
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
    both
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
