//! Patches divided into triangles that are as good as flat.
//!
//! Edges that leave their chord by too much are halved, in both triangles beside them; with them the longest edge of
//! each triangle, which keeps the angles from shrinking (Rivara 1984).

use super::{NEAR, Smooth, Web};
use crate::error::{Error, Result};
use crate::surface::carrier::locate::nearest_in_triangle;
use crate::surface::polygon::{MAX_TRIANGLES, divide};
use glam::DVec3;
use std::collections::HashMap;

/// Places on an edge where its distance from the chord is taken; the first is where it is halved.
const LOOKS: [f64; 3] = [0.5, 0.25, 0.75];

/// A corner of a piece.
#[derive(Clone, Copy)]
pub(super) struct Corner {
    pub vertex: u32,
    /// Its barycentric coordinates in the patch.
    bary: [f64; 3],
}

/// All patches in pieces.
pub(super) struct Pieces {
    pub points: Vec<DVec3>,
    /// Each with the number of its patch.
    pub triangles: Vec<(u32, [Corner; 3])>,
    /// Of each patch, whether it is coarse: others are divided only where a coarse one beside them is.
    coarse: Vec<bool>,
    /// Largest distance of a point from its patch's flat triangle.
    pub departure: f64,
}

/// What is known of edges: where they are to be halved, None for those that stay.
type Halves = HashMap<(u32, u32), Option<DVec3>>;

impl Pieces {
    pub(super) fn of(web: &Web, wanted: &Smooth) -> Pieces {
        let net = &web.net;
        let at = |v: u32| net.points[v as usize];
        let is_coarse = |f: &Vec<u32>| {
            (0..f.len()).any(|k| at(f[k]).distance(at(f[(k + 1) % f.len()])) > wanted.coarse)
        };
        let faces: Vec<bool> = net.faces.iter().map(is_coarse).collect();
        let whole = |(t, corners): (usize, &[u32; 3])| {
            let corner = |k: usize| {
                let mut bary = [0.0; 3];
                bary[k] = 1.0;
                Corner { vertex: corners[k], bary }
            };
            (t as u32, [0, 1, 2].map(corner))
        };
        Pieces {
            points: net.points.clone(),
            triangles: net.triangles.iter().enumerate().map(whole).collect(),
            coarse: net.face.iter().map(|&f| faces[f as usize]).collect(),
            departure: 0.0,
        }
    }

    /// Divide until no edge leaves its chord by more than `chord_error`; `name` is the mesh's, for messages.
    pub(super) fn refine(&mut self, web: &Web, chord_error: f64, name: &str) -> Result<()> {
        let mut known = Halves::new();
        loop {
            self.look(web, chord_error, &mut known);
            while self.spread(web, NEAR * chord_error, &mut known) {}
            if !self.halve(web, &known) {
                return Ok(());
            }
            if self.triangles.len() as f64 > MAX_TRIANGLES {
                return Err(Error::Surface(format!(
                    "{name}: smoothing the mesh would take more than {MAX_TRIANGLES:.0} triangles; choose a larger \
                     edge length, or leave out `smooth_input`"
                )));
            }
        }
    }

    /// Find where edges that nobody has looked at bend too much.
    fn look(&mut self, web: &Web, chord_error: f64, known: &mut Halves) {
        for (patch_of, corners) in &self.triangles {
            if !self.coarse[*patch_of as usize] {
                continue;
            }
            let mut patch = None;
            for k in 0..3 {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                let key = sorted(a.vertex, b.vertex);
                if known.contains_key(&key) {
                    continue;
                }
                let patch = patch.get_or_insert_with(|| web.patch(*patch_of));
                let [p, q] = [a, b].map(|c| self.points[c.vertex as usize]);
                // What is shorter than the error cannot leave its chord by it.
                let long = p.distance(q) > chord_error;
                let looks = LOOKS.map(|s| patch.point(mix(a.bary, b.bary, s)));
                let off = |(x, s): (&DVec3, f64)| x.distance(p.lerp(q, s)) > chord_error;
                let bends = long && looks.iter().zip(LOOKS).any(off);
                known.insert(key, bends.then_some(looks[0]));
            }
        }
    }

    /// Have the longest edge halved wherever another one is; in a needle no wider than `near` both long ones, which would
    /// else come to lie above one another. Whether any was added.
    fn spread(&self, web: &Web, near: f64, known: &mut Halves) -> bool {
        let mut added = false;
        for (patch, corners) in &self.triangles {
            let key = |k: usize| sorted(corners[k].vertex, corners[(k + 1) % 3].vertex);
            let halved = |k: usize, known: &Halves| known.get(&key(k)).copied().flatten().is_some();
            if !(0..3).any(|k| halved(k, known)) {
                continue;
            }
            let longest = self.longest(corners);
            let is_needle = (0..3).any(|k| self.length(corners, k) <= near);
            let wanted = |&k: &usize| k == longest || is_needle && self.length(corners, k) > near;
            for k in (0..3).filter(wanted) {
                if !halved(k, known) {
                    let (a, b) = (corners[k], corners[(k + 1) % 3]);
                    known.insert(key(k), Some(web.patch(*patch).point(mix(a.bary, b.bary, 0.5))));
                    added = true;
                }
            }
        }
        added
    }

    /// Length of the edge from corner `k` on.
    fn length(&self, corners: &[Corner; 3], k: usize) -> f64 {
        let [p, q] = [k, (k + 1) % 3].map(|k| self.points[corners[k].vertex as usize]);
        p.distance(q)
    }

    fn longest(&self, corners: &[Corner; 3]) -> usize {
        let length = [0, 1, 2].map(|k| self.length(corners, k));
        (1..3).fold(0, |best, k| if length[k] > length[best] { k } else { best })
    }

    /// Halve the edges that are to be; whether there were any.
    fn halve(&mut self, web: &Web, known: &Halves) -> bool {
        let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
        let mut finer = Vec::with_capacity(self.triangles.len() * 2);
        for (patch, corners) in std::mem::take(&mut self.triangles) {
            let longest = self.longest(&corners);
            let turned = [0, 1, 2].map(|k| corners[(longest + k) % 3]);
            let middle = [0, 1, 2].map(|k| {
                let (a, b) = (turned[k], turned[(k + 1) % 3]);
                let key = sorted(a.vertex, b.vertex);
                let xyz = known.get(&key).copied().flatten()?;
                let vertex = *middles.entry(key).or_insert_with(|| {
                    let flat = web.net.corners(patch);
                    let [x, y, z] = nearest_in_triangle(flat, xyz);
                    let off = (flat[0] * x + flat[1] * y + flat[2] * z).distance(xyz);
                    self.departure = self.departure.max(off);
                    self.points.push(xyz);
                    self.points.len() as u32 - 1
                });
                Some(Corner { vertex, bary: mix(a.bary, b.bary, 0.5) })
            });
            let mut pieces = Vec::with_capacity(4);
            divide(turned, middle, &mut pieces);
            finer.extend(pieces.into_iter().map(|p| (patch, p)));
        }
        self.triangles = finer;
        !middles.is_empty()
    }
}

fn sorted(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

fn mix(a: [f64; 3], b: [f64; 3], s: f64) -> [f64; 3] {
    [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * s)
}
