//! Vertices taken out of an intrinsic triangulation.
//!
//! Edges are flipped away from a vertex until it hangs by three (inside) or two or three (boundary), the
//! shortest new one first; then it goes. Where the quadrilaterals are not convex it waits for its neighbours to
//! go; those for which waiting does not help are cut out of their star ear by ear, with the lengths of the
//! shortest ways through it.

use super::PHASE;
use super::intrinsic::Intrinsic;
use crate::job::Job;
use smallvec::SmallVec;

/// More than a full turn is round a vertex where the surface is a saddle, so that its last four neighbours may
/// lie such that no edge can be flipped away from it. This much of an edge it may be on the wrong side of the
/// new one: the vertex goes next, and with it what was wrong.
const SADDLE: f64 = 0.1;

/// The new edge passes the far end of the old one by this share of it.
const CLEAR: f64 = 1e-12;

/// A way just beside the vertex is shorter than the one through it by this share: twice the room of a triangle.
const BESIDE: f64 = 2e-12;

/// How edges may be flipped away from a vertex that is to go.
#[derive(Clone, Copy, PartialEq)]
enum Manner {
    /// Where the quadrilateral is convex, or nearly.
    Convex,
    /// Anyhow.
    Forced,
}

/// What flipping an edge away would make: how bad that is, and how long.
#[derive(Clone, Copy)]
struct Ear {
    reflex: u8,
    length: f64,
}

impl Intrinsic {
    /// Remove these vertices, keeping the rest Delaunay, with at most about so many looks; gives those that
    /// cannot go without changing the surface's topology.
    pub fn remove_all(&mut self, mut vertices: Vec<u32>, looks: usize, job: &Job) -> Vec<u32> {
        // Half of them are for settling: the others are left for removing.
        let bounds = [looks / 2, looks].map(|looks| self.work.looks + looks);
        for manner in [Manner::Convex, Manner::Forced] {
            // When each was last tried in vain: as long as nothing changes round it, it would be again.
            let mut tried = vec![None; self.mesh.slots()];
            loop {
                let before = vertices.len();
                vertices.retain(|&v| {
                    if tried[v as usize].is_some_and(|at| self.touched_round(v) <= at) {
                        return true;
                    }
                    if job.is_over(PHASE) {
                        return true;
                    }
                    let gone = self.remove(v, manner, bounds, job);
                    tried[v as usize] = Some(self.now());
                    !gone
                });
                if vertices.is_empty() {
                    return vertices;
                }
                if vertices.len() == before {
                    break;
                }
            }
        }
        vertices
    }

    /// Remove `v` and settle what is round it; nothing has changed where it cannot go.
    fn remove(&mut self, v: u32, manner: Manner, [settle, most]: [usize; 2], job: &Job) -> bool {
        if self.work.looks >= most {
            self.work.cut_short = true;
            return false;
        }
        let mut gone = self.clear(v, manner).and_then(|()| self.take(v, manner)).is_some();
        if !gone {
            self.take_back();
            gone = manner == Manner::Forced && self.merge(v);
        }
        if !gone {
            return false;
        }
        self.commit();
        self.settle(settle, job);
        true
    }

    /// Flip edges away from `v` until it hangs by few enough to be taken.
    fn clear(&mut self, v: u32, manner: Manner) -> Option<()> {
        if let &[p, q] = self.mesh.along_features(v) {
            // On a feature between p and q: one edge is left on either side.
            for (from, to) in [(p, q), (q, p)] {
                let side = self.between(v, from, to);
                self.shed(v, &side, 1, manner)?;
            }
            return Some(());
        }
        let ring: SmallVec<[u32; 8]> = self.mesh.ring(v).into();
        self.shed(v, &ring, 3, manner)
    }

    /// Flip edges from `v` to these neighbours away until so many are left, the shortest new one first.
    fn shed(&mut self, v: u32, spokes: &[u32], leave: usize, manner: Manner) -> Option<()> {
        if spokes.len() <= leave {
            return Some(());
        }
        let look = |this: &mut Self, w: u32| this.ear(v, w, manner);
        let mut ears: SmallVec<[Option<Ear>; 8]> = spokes.iter().map(|&w| look(self, w)).collect();
        let mut left = spokes.len();
        while left > leave {
            let known = (0..spokes.len()).filter_map(|i| Some((i, ears[i]?)));
            let (i, ear) = known.min_by(|(_, x), (_, y)| {
                x.reflex.cmp(&y.reflex).then(x.length.total_cmp(&y.length))
            })?;
            ears[i] = None;
            let (w, beside) =
                (spokes[i], [self.mesh.left(v, spokes[i]), self.mesh.right(v, spokes[i])]);
            if !self.flip(v, w, ear.length) {
                continue;
            }
            left -= 1;
            for w in beside.into_iter().flatten() {
                if let Some(i) = spokes.iter().position(|&s| s == w) {
                    ears[i] = look(self, w);
                }
            }
        }
        Some(())
    }

    /// What flipping (v, w) would make; None where it cannot be, or not in this manner.
    fn ear(&mut self, v: u32, w: u32, manner: Manner) -> Option<Ear> {
        self.work.looks += 1;
        if self.mesh.is_feature_edge(v, w) {
            return None;
        }
        let quad = self.quad(v, w)?;
        let (c, d) = (quad.left, quad.right);
        if self.mesh.adjacent(c, d) {
            return None;
        }
        let at = quad.crossing();
        let reflex = match at {
            at if at > 0.0 && at < 1.0 - CLEAR => 0,
            at if at > -SADDLE && at < 1.0 - CLEAR => 1,
            _ if manner == Manner::Forced => 2,
            _ => return None,
        };
        // A straight line on which v or w lies leads just beside it, and so it does where v is in its way.
        let through = |x: u32| (self.length(x, c) + self.length(x, d)) * (1.0 - BESIDE);
        let straight = if reflex == 2 && at <= 0.0 { through(v) } else { quad.across() };
        let length = straight.min(through(v)).min(through(w));
        (self.fits([c, d, v], length) && self.fits([d, c, w], length))
            .then_some(Ear { reflex, length })
    }

    /// Take `v`, which hangs by few edges.
    fn take(&mut self, v: u32, manner: Manner) -> Option<()> {
        let ring: SmallVec<[u32; 8]> = self.mesh.ring(v).into();
        let (first, last) = (ring[0], ring[ring.len() - 1]);
        let (boundary, feature) = (self.mesh.is_boundary(v), self.mesh.along_features(v));
        let line = match *feature {
            [p, q] => Some((p, q)),
            _ if boundary && ring.len() == 3 => Some((first, last)),
            _ => None,
        };
        let along = line.map(|(p, q)| self.length(v, p) + self.length(v, q));
        let keep = line.map_or(last, |(_, q)| q);
        self.mesh.try_collapse(keep, v, &mut self.undo).ok()?;
        for &w in &ring {
            self.forget_length(v, w);
        }
        if let (Some((p, q)), Some(along)) = (line, along) {
            // A line between two nodes is one member, however it bends.
            self.set_length(p, q, along);
        }
        for i in 0..ring.len() {
            self.suspects.push((ring[i], ring[(i + 1) % ring.len()]));
        }
        let triangles: SmallVec<[[u32; 3]; 2]> = match (line, ring.as_slice()) {
            (Some((p, q)), _) => {
                ring.iter().filter(|&&w| w != p && w != q).map(|&w| [p, q, w]).collect()
            }
            (None, &[a, b, c]) => SmallVec::from_slice(&[[a, b, c]]),
            _ => SmallVec::new(),
        };
        let forced = manner == Manner::Forced;
        let mut all = triangles.into_iter();
        all.all(|t| self.is_sound(t) || (forced && self.make_room(t))).then_some(())
    }

    /// Move `v` into a neighbour, the nearest first: what it was joined to is as far from there as it was by way of
    /// `v`.
    fn merge(&mut self, v: u32) -> bool {
        let mut ring: SmallVec<[u32; 8]> = self.mesh.ring(v).into();
        let star = ring.clone();
        ring.sort_by(|&x, &y| self.length(v, x).total_cmp(&self.length(v, y)));
        ring.into_iter().any(|w| {
            let merged = self.merge_into(v, w, &star).is_some();
            if !merged {
                self.take_back();
            }
            merged
        })
    }

    fn merge_into(&mut self, v: u32, w: u32, star: &[u32]) -> Option<()> {
        self.work.looks += star.len();
        let spokes: SmallVec<[f64; 8]> = star.iter().map(|&x| self.length(v, x)).collect();
        let known: SmallVec<[bool; 8]> = star.iter().map(|&x| self.mesh.adjacent(w, x)).collect();
        let step = self.length(v, w);
        self.mesh.try_collapse(w, v, &mut self.undo).ok()?;
        for (i, &x) in star.iter().enumerate() {
            self.forget_length(v, x);
            if x != w && self.mesh.adjacent(w, x) && !known[i] {
                self.set_length(w, x, step + spokes[i]);
            }
        }
        let fan: SmallVec<[(u32, u32); 8]> = self.mesh.fan(w).collect();
        let sound = |this: &mut Self, t| this.is_sound(t) || this.make_room(t);
        if !fan.iter().all(|&(x, y)| sound(self, [w, x, y])) {
            return None;
        }
        self.suspects.extend(fan.iter().flat_map(|&(x, y)| [(w, x), (x, y)]));
        Some(())
    }

    /// The neighbours of `v` counter-clockwise after `from` and before `to`.
    fn between(&self, v: u32, from: u32, to: u32) -> SmallVec<[u32; 8]> {
        let ring = self.mesh.ring(v);
        let Some(at) = self.mesh.position(v, from) else { return SmallVec::new() };
        let onward = (1..ring.len()).map(|i| ring[(at + i) % ring.len()]);
        onward.take_while(|&w| w != to).collect()
    }
}
