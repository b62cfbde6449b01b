//! The one door for edits of a mesh: flip, split, collapse, each with every rule of topology, boundary and
//! pins in one place. Geometry (folded triangles, lengths) is the caller's to judge, before or after: a
//! recorded run of edits can be taken back.

use super::{Along, Mesh, Ring};

/// Why an edit was refused; the mesh is then unchanged.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// The two vertices are not joined.
    #[error("there is no such edge")]
    NoEdge,
    /// A boundary edge cannot be flipped.
    #[error("the edge lies on the boundary")]
    Boundary,
    /// The edge that the flip would make exists already.
    #[error("the flipped edge exists already")]
    Doubled,
    /// A vertex would be left with too few edges.
    #[error("a vertex would be left with too few edges")]
    Degree,
    /// Collapsing would pinch the surface, close a hole or leave the boundary.
    #[error("collapsing the edge would change the surface's topology or leave the boundary")]
    Link,
    /// The edge is part of a feature, or the vertex would leave its feature.
    #[error("the edge or vertex is part of a feature")]
    Feature,
    /// The vertex is a corner or an anchor.
    #[error("the vertex is a corner or an anchor")]
    Pinned,
}

/// What takes back a run of edits: the vertices touched, as they were.
#[derive(Clone, Debug, Default)]
pub struct Undo {
    touched: Vec<Touched>,
}

/// A vertex as it was.
#[derive(Clone, Debug)]
struct Touched {
    vertex: u32,
    ring: Ring,
    boundary: bool,
    features: Along,
}

impl Undo {
    /// The vertices touched since recording began, in order, with repetitions.
    pub fn touched(&self) -> impl Iterator<Item = u32> + '_ {
        self.touched.iter().map(|t| t.vertex)
    }

    /// Whether the edits together changed nothing in `mesh`.
    pub fn is_idle(&self, mesh: &Mesh) -> bool {
        self.touched.iter().enumerate().all(|(k, t)| {
            let again = self.touched[..k].iter().any(|earlier| earlier.vertex == t.vertex);
            again || is_turned(&t.ring, mesh.ring(t.vertex))
        })
    }

    /// Forget everything: keep the edits.
    pub fn clear(&mut self) {
        self.touched.clear();
    }
}

/// Whether two rings are the same up to where they begin.
fn is_turned(a: &[u32], b: &[u32]) -> bool {
    let Some(first) = a.first() else { return b.is_empty() };
    let Some(turn) = b.iter().position(|x| x == first) else { return false };
    a.len() == b.len() && (0..a.len()).all(|i| a[i] == b[(i + turn) % b.len()])
}

impl Mesh {
    /// Flip the edge `a`, `b`. Gives the new edge `(c, d)`, `c` being the old left apex of `a -> b`.
    ///
    /// ```text
    ///     c            c
    ///    / \          /|\
    ///   a---b   ->   a | b
    ///    \ /          \|/
    ///     d            d
    /// ```
    ///
    /// # Errors
    /// [`Refusal`] when an end would lose too many edges or the new edge exists already.
    pub fn try_flip(&mut self, a: u32, b: u32, undo: &mut Undo) -> Result<(u32, u32), Refusal> {
        if !self.adjacent(a, b) {
            return Err(Refusal::NoEdge);
        }
        let (Some(c), Some(d)) = (self.left(a, b), self.right(a, b)) else {
            return Err(Refusal::Boundary);
        };
        if self.is_feature_edge(a, b) {
            return Err(Refusal::Feature);
        }
        if !self.spares_edge(a) || !self.spares_edge(b) {
            return Err(Refusal::Degree);
        }
        if self.adjacent(c, d) {
            return Err(Refusal::Doubled);
        }
        self.touch(&[a, b, c, d], undo);
        self.remove(a, b);
        self.remove(b, a);
        self.insert_after(c, a, d);
        self.insert_after(d, b, c);
        Ok((c, d))
    }

    /// Split the edge `a`, `b` by a new vertex, joined to the apexes on both sides. Gives the new vertex. A
    /// feature runs on through it.
    ///
    /// ```text
    ///     c            c
    ///    / \          /|\
    ///   a---b   ->   a-m-b
    ///    \ /          \|/
    ///     d            d
    /// ```
    ///
    /// # Errors
    /// [`Refusal::NoEdge`].
    pub fn try_split(&mut self, a: u32, b: u32, undo: &mut Undo) -> Result<u32, Refusal> {
        if !self.adjacent(a, b) {
            return Err(Refusal::NoEdge);
        }
        let (a, b) = if self.left(a, b).is_some() { (a, b) } else { (b, a) };
        let c = self.left(a, b).ok_or(Refusal::NoEdge)?;
        let d = self.right(a, b);
        let m = self.create();
        self.touch(&[m, a, b, c], undo);
        self.replace(a, b, m);
        self.replace(b, a, m);
        self.insert_after(c, a, m);
        self.rings[m as usize] = Ring::from_slice(&[b, c, a]);
        self.boundary[m as usize] = d.is_none();
        if self.is_feature_edge(a, b) {
            self.features[m as usize] = Along::from_slice(&[a, b]);
            self.rejoin(a, b, m);
            self.rejoin(b, a, m);
        }
        self.alive += 1;
        if let Some(d) = d {
            self.touch(&[d], undo);
            self.insert_after(d, b, m);
            self.rings[m as usize].push(d);
        }
        Ok(m)
    }

    /// Collapse the edge `keep`, `gone`: `gone` disappears and its edges go to `keep`.
    ///
    /// # Errors
    /// [`Refusal`] when the link condition fails, a vertex would leave the boundary or its feature, `gone` is
    /// pinned, or an apex would be left with too few edges.
    pub fn try_collapse(&mut self, keep: u32, gone: u32, undo: &mut Undo) -> Result<(), Refusal> {
        let (a, b) = (keep, gone);
        if !self.adjacent(a, b) {
            return Err(Refusal::NoEdge);
        }
        if self.pinned[b as usize] {
            return Err(Refusal::Pinned);
        }
        let boundary_edge = self.is_boundary_edge(a, b);
        if self.boundary[b as usize] && !boundary_edge {
            return Err(Refusal::Link);
        }
        let onward = self.onward(a, b)?;
        let apexes = [self.left(a, b), self.right(a, b)];
        let common = self.ring(a).iter().filter(|&&x| self.adjacent(b, x)).count();
        if common != apexes.iter().flatten().count() {
            return Err(Refusal::Link);
        }
        if !apexes.iter().flatten().all(|&x| self.spares_edge(x)) {
            return Err(Refusal::Degree);
        }
        // The neighbours of b between the apexes, counter-clockwise from the right one to the left one.
        let ring = &self.rings[b as usize];
        let at = self.position(b, a).ok_or(Refusal::NoEdge)?;
        let others: Ring = (1..ring.len())
            .map(|i| ring[(at + i) % ring.len()])
            .filter(|&x| apexes[0] != Some(x) && apexes[1] != Some(x))
            .collect();
        let least = if self.boundary[a as usize] { 2 } else { 3 };
        if self.degree(a) - 1 + others.len() < least {
            return Err(Refusal::Degree);
        }
        self.touch(&[a, b], undo);
        self.touch(&others, undo);
        if let Some(w) = onward {
            self.touch(&[w], undo);
            self.rejoin(w, b, a);
            self.rejoin(a, b, w);
        }
        self.features[b as usize].clear();
        for &x in apexes.iter().flatten() {
            self.touch(&[x], undo);
            self.remove(x, b);
        }
        for &x in &others {
            self.replace(x, b, a);
        }
        if let Some(i) = self.position(a, b) {
            self.rings[a as usize].remove(i);
            self.rings[a as usize].insert_many(i, others);
        }
        self.rings[b as usize].clear();
        self.boundary[b as usize] = false;
        self.alive -= 1;
        self.free.push(b);
        Ok(())
    }

    /// Take back the edits recorded in `undo`, newest first, and clear it.
    pub fn take_back(&mut self, undo: &mut Undo) {
        while let Some(Touched { vertex: v, ring, boundary, features }) = undo.touched.pop() {
            match (self.rings[v as usize].is_empty(), ring.is_empty()) {
                (true, false) => {
                    self.alive += 1;
                    self.free.retain(|&f| f != v);
                }
                (false, true) => {
                    self.alive -= 1;
                    self.free.push(v);
                }
                _ => {}
            }
            self.rings[v as usize] = ring;
            self.boundary[v as usize] = boundary;
            self.features[v as usize] = features;
        }
    }

    /// Where the feature through `gone` runs on to when `gone` is taken into `keep`; None where there is none.
    fn onward(&self, keep: u32, gone: u32) -> Result<Option<u32>, Refusal> {
        let next = match self.features[gone as usize].as_slice() {
            [] => return Ok(None),
            &[p, q] if p == keep => q,
            &[p, q] if q == keep => p,
            // Off the feature, or the feature's end or junction.
            _ => return Err(Refusal::Feature),
        };
        // A feature of three members all round would collapse into one edge.
        if self.is_feature_edge(keep, next) { Err(Refusal::Feature) } else { Ok(Some(next)) }
    }

    /// Put a new vertex into the triangle `a`, `b`, `c` (counter-clockwise), joined to its corners.
    pub(crate) fn insert_in_triangle(&mut self, [a, b, c]: [u32; 3]) -> u32 {
        debug_assert_eq!(self.left(a, b), Some(c));
        let m = self.create();
        self.insert_after(a, b, m);
        self.insert_after(b, c, m);
        self.insert_after(c, a, m);
        self.rings[m as usize] = Ring::from_slice(&[a, b, c]);
        self.boundary[m as usize] = false;
        self.alive += 1;
        m
    }

    /// Renumber the vertices in use to 0.., keeping their order; gives the old id of each new one.
    pub fn compact(&mut self) -> Vec<u32> {
        let old: Vec<u32> = self.vertices().collect();
        let mut new = vec![u32::MAX; self.slots()];
        for (i, &v) in old.iter().enumerate() {
            new[v as usize] = i as u32;
        }
        let keep = |v: &u32| *v as usize;
        self.rings = old
            .iter()
            .map(|v| self.rings[*v as usize].iter().map(|&w| new[w as usize]).collect())
            .collect();
        self.features = old
            .iter()
            .map(|v| self.features[*v as usize].iter().map(|&w| new[w as usize]).collect())
            .collect();
        self.boundary = old.iter().map(|v| self.boundary[keep(v)]).collect();
        self.pinned = old.iter().map(|v| self.pinned[keep(v)]).collect();
        self.free.clear();
        old
    }

    /// Whether `v` can lose an edge and still close up.
    fn spares_edge(&self, v: u32) -> bool {
        self.degree(v) > if self.boundary[v as usize] { 2 } else { 3 }
    }

    fn create(&mut self) -> u32 {
        if let Some(v) = self.free.pop() {
            self.pinned[v as usize] = false;
            return v;
        }
        self.rings.push(Ring::new());
        self.boundary.push(false);
        self.pinned.push(false);
        self.features.push(Along::new());
        self.rings.len() as u32 - 1
    }

    fn touch(&self, vertices: &[u32], undo: &mut Undo) {
        for &v in vertices {
            let i = v as usize;
            undo.touched.push(Touched {
                vertex: v,
                ring: self.rings[i].clone(),
                boundary: self.boundary[i],
                features: self.features[i].clone(),
            });
        }
    }

    /// Let the feature at `v` run to `new` instead of `old`.
    fn rejoin(&mut self, v: u32, old: u32, new: u32) {
        for x in &mut self.features[v as usize] {
            if *x == old {
                *x = new;
            }
        }
    }

    fn remove(&mut self, v: u32, neighbor: u32) {
        self.rings[v as usize].retain(|&mut x| x != neighbor);
    }

    fn replace(&mut self, v: u32, old: u32, new: u32) {
        for x in &mut self.rings[v as usize] {
            if *x == old {
                *x = new;
            }
        }
    }

    fn insert_after(&mut self, v: u32, after: u32, new: u32) {
        let i = self.position(v, after).expect("the neighbours of an edge's apex hold its ends");
        self.rings[v as usize].insert(i + 1, new);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A disc: a triangular lattice of `n` x `n` vertices.
    fn lattice(n: u32) -> Mesh {
        let mut triangles = Vec::new();
        for j in 0..n - 1 {
            for i in 0..n - 1 {
                let v = j * n + i;
                triangles.push([v, v + 1, v + n]);
                triangles.push([v + 1, v + n + 1, v + n]);
            }
        }
        Mesh::from_triangles((n * n) as usize, &triangles).expect("a lattice is a disc")
    }

    /// A torus of `n` x `n` vertices.
    fn torus(n: u32) -> Mesh {
        let id = |i: u32, j: u32| (j % n) * n + i % n;
        let mut triangles = Vec::new();
        for j in 0..n {
            for i in 0..n {
                triangles.push([id(i, j), id(i + 1, j), id(i, j + 1)]);
                triangles.push([id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)]);
            }
        }
        Mesh::from_triangles((n * n) as usize, &triangles).expect("a torus")
    }

    #[test]
    fn a_flip_and_its_flip_back_change_nothing() {
        let mut mesh = lattice(4);
        let before = mesh.clone();
        let mut undo = Undo::default();
        let (c, d) = mesh.try_flip(5, 6, &mut undo).expect("interior");
        mesh.check().expect("valid");
        assert!(mesh.adjacent(c, d) && !mesh.adjacent(5, 6));
        mesh.take_back(&mut undo);
        assert_eq!(mesh, before);
    }

    #[test]
    fn collapsing_across_a_strip_would_pinch_it() {
        let mut mesh = Mesh::from_triangles(4, &[[0, 1, 2], [1, 3, 2]]).expect("two triangles");
        assert_eq!(mesh.try_collapse(1, 2, &mut Undo::default()), Err(Refusal::Link));
    }

    #[test]
    fn pinned_vertices_stay() {
        let mut mesh = lattice(4);
        mesh.pin(5, true);
        assert_eq!(mesh.try_collapse(6, 5, &mut Undo::default()), Err(Refusal::Pinned));
        assert!(mesh.try_collapse(5, 6, &mut Undo::default()).is_ok());
    }

    /// The vertices of the feature that begins at `start` and runs on over unpinned vertices to a pinned one.
    fn feature(mesh: &Mesh, start: u32) -> Vec<u32> {
        let mut found = vec![start];
        let mut at = mesh.along_features(start)[0];
        while !mesh.is_pinned(at) {
            let before = found[found.len() - 1];
            found.push(at);
            let along = mesh.along_features(at);
            assert_eq!(along.len(), 2, "vertex {at}");
            at = if along[0] == before { along[1] } else { along[0] };
        }
        found.push(at);
        found
    }

    /// A lattice of `n` x `n` with a feature along the row in its middle, its ends pinned.
    fn creased(n: u32) -> (Mesh, [u32; 2]) {
        let mut mesh = lattice(n);
        let row = n * (n / 2);
        for i in 0..n - 1 {
            mesh.mark_feature(row + i, row + i + 1).expect("a row of the lattice");
        }
        let ends = [row, row + n - 1];
        for v in ends {
            mesh.pin(v, true);
        }
        (mesh, ends)
    }

    #[test]
    fn a_feature_edge_is_not_flipped() {
        let (mut mesh, _) = creased(5);
        assert_eq!(mesh.try_flip(11, 12, &mut Undo::default()), Err(Refusal::Feature));
    }

    #[test]
    fn a_vertex_does_not_leave_its_feature() {
        let (mut mesh, ends) = creased(5);
        assert_eq!(mesh.try_collapse(17, 12, &mut Undo::default()), Err(Refusal::Feature));
        assert_eq!(mesh.try_collapse(12, 17, &mut Undo::default()), Ok(()));
        assert_eq!(mesh.try_collapse(11, 12, &mut Undo::default()), Ok(()));
        mesh.check().expect("valid");
        assert_eq!(feature(&mesh, ends[0]), [10, 11, 13, 14]);
    }

    #[test]
    fn a_closed_feature_keeps_three_members() {
        let mut mesh = lattice(5);
        for (a, b) in [(11, 12), (12, 16), (16, 11)] {
            mesh.mark_feature(a, b).expect("the triangle 11, 12, 16");
        }
        assert_eq!(mesh.try_collapse(11, 12, &mut Undo::default()), Err(Refusal::Feature));
    }

    proptest! {
        #[test]
        fn any_legal_edits_keep_the_feature_whole(
            edits in prop::collection::vec((0u8..4, any::<u32>(), any::<u32>()), 1..200),
        ) {
            let (mut mesh, ends) = creased(7);
            for (kind, pick, side) in edits {
                let alive: Vec<u32> = mesh.vertices().collect();
                let a = alive[pick as usize % alive.len()];
                let b = mesh.ring(a)[side as usize % mesh.degree(a)];
                let before = feature(&mesh, ends[0]);
                let mut undo = Undo::default();
                let _ = match kind {
                    0 => mesh.try_flip(a, b, &mut undo).is_ok(),
                    1 => mesh.try_split(a, b, &mut undo).is_ok(),
                    _ => mesh.try_collapse(a, b, &mut undo).is_ok(),
                };
                prop_assert_eq!(mesh.check(), Ok(()));
                let after = feature(&mesh, ends[0]);
                prop_assert_eq!((after[0], after[after.len() - 1]), (ends[0], ends[1]));
                let members = mesh.vertices().map(|v| mesh.along_features(v).len()).sum::<usize>() / 2;
                prop_assert_eq!(members, after.len() - 1);
                if kind == 3 {
                    mesh.take_back(&mut undo);
                    prop_assert_eq!(feature(&mesh, ends[0]), before);
                }
            }
        }

        #[test]
        fn any_legal_edits_keep_the_mesh_valid(
            closed in any::<bool>(),
            edits in prop::collection::vec((0u8..4, any::<u32>(), any::<u32>()), 1..200),
        ) {
            let mut mesh = if closed { torus(5) } else { lattice(5) };
            let chi = mesh.euler_characteristic();
            for (kind, pick, side) in edits {
                let alive: Vec<u32> = mesh.vertices().collect();
                let a = alive[pick as usize % alive.len()];
                let b = mesh.ring(a)[side as usize % mesh.degree(a)];
                let before = mesh.clone();
                let mut undo = Undo::default();
                let done = match kind {
                    0 => mesh.try_flip(a, b, &mut undo).is_ok(),
                    1 => mesh.try_split(a, b, &mut undo).is_ok(),
                    _ => mesh.try_collapse(a, b, &mut undo).is_ok(),
                };
                prop_assert_eq!(mesh.check(), Ok(()));
                prop_assert_eq!(mesh.euler_characteristic(), chi);
                if !done {
                    prop_assert_eq!(&mesh, &before);
                } else if kind == 3 {
                    mesh.take_back(&mut undo);
                    prop_assert_eq!(&mesh.rings[..before.rings.len()], &before.rings[..]);
                    prop_assert_eq!(mesh.vertex_count(), before.vertex_count());
                }
            }
        }
    }
}
