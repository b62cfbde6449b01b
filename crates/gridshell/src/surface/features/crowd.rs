//! Anchors so near to a corner or to one another that one node stands for all of them.

use crate::surface::{NEAREST, Surface};
use glam::DVec3;
use std::collections::BTreeMap;

/// Anchors no farther than this from a corner, over l0, are that corner, and nothing is to be told.
const SAME: f64 = 1e-6;

impl Surface {
    /// The anchors without those that count as one node with a corner of the border or with an anchor before them, for
    /// members of `length` metres; and what is to be told.
    pub fn apart(&mut self, anchors: &[DVec3], length: f64) -> (Vec<DVec3>, Option<String>) {
        if anchors.is_empty() {
            return (Vec::new(), None);
        }
        self.thin_corners(length);
        let near = NEAREST * length;
        let mut crowd = Crowd { near, cells: BTreeMap::new() };
        for chain in &self.loops {
            for &k in &chain.corners {
                crowd.add(self.carrier.points[chain.vertices[k as usize] as usize]);
            }
        }
        let (mut apart, mut shared) = (Vec::new(), Vec::new());
        for &p in anchors {
            let nearest = crowd.nearest(p);
            if nearest >= near {
                crowd.add(p);
                apart.push(p);
            } else if nearest > SAME * length {
                shared.push(p);
            }
        }
        let note = shared.first().map(|&p| {
            let p = self.origin.world(p);
            format!(
                "{} of the anchors are within {near:.3} m of a corner or of another anchor, whose node is theirs too; \
                 the first near ({:.3}, {:.3}, {:.3})",
                shared.len(),
                p.x,
                p.y,
                p.z
            )
        });
        (apart, note)
    }
}

/// Points in cubes.
struct Crowd {
    /// Size of a cube, metres.
    near: f64,
    cells: BTreeMap<[i64; 3], Vec<DVec3>>,
}

impl Crowd {
    fn cell(&self, p: DVec3) -> [i64; 3] {
        (p / self.near).floor().to_array().map(|x| x as i64)
    }

    fn add(&mut self, p: DVec3) {
        self.cells.entry(self.cell(p)).or_default().push(p);
    }

    /// Distance of the nearest point, if that is in a cube beside `p`.
    fn nearest(&self, p: DVec3) -> f64 {
        let [x, y, z] = self.cell(p);
        let around = (0..27_i64).map(|k| {
            let [i, j, l] = [k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1];
            [x.saturating_add(i), y.saturating_add(j), z.saturating_add(l)]
        });
        let near = around.filter_map(|cell| self.cells.get(&cell)).flatten();
        near.map(|q| q.distance(p)).fold(f64::INFINITY, f64::min)
    }
}
