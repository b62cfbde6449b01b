//! An intrinsic triangulation: a mesh with edge lengths measured along the surface.
//!
//! Every triangle can be laid into the plane: the lengths of its sides satisfy the triangle inequality with
//! [`ROOM`]. Edges of the boundary and of features are the exception. They follow the surface's lines however
//! those bend, and no edit flips them: one that is too long for a triangle beside it counts there as just
//! short enough.

use crate::mesh::{Mesh, Undo};
use glam::{DVec2, DVec3};
use smallvec::SmallVec;

/// A mesh and the lengths of its edges.
pub struct Intrinsic {
    pub mesh: Mesh,
    /// Per vertex: (neighbour with a higher id, length).
    lengths: Vec<SmallVec<[(u32, f64); 4]>>,
    /// Edges that may have ceased to be Delaunay.
    pub(super) suspects: Vec<(u32, u32)>,
    /// What takes back the edits since the last commit: the mesh's part, and lengths as they were.
    pub(super) undo: Undo,
    was: Vec<(u32, u32, Option<f64>)>,
    /// Commits so far, and the last one that touched each vertex.
    commits: u32,
    touched: Vec<u32>,
    /// What has been done.
    pub work: Work,
}

/// What triangulating took. Both counts are bounded by a multiple of the vertices, whatever their triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Vertices there were: those of the carrier, and the bubbles.
    pub vertices: usize,
    /// Edges looked at: for being Delaunay, or for being flipped away from a vertex that is to go.
    pub looks: usize,
    /// Edges flipped, those flipped back included.
    pub flips: usize,
    /// Whether the bound was reached: not all edges are Delaunay then, or not all vertices gone.
    pub cut_short: bool,
}

impl Work {
    /// In words; None where the carrier was not touched.
    pub fn note(&self) -> Option<String> {
        let &Work { vertices, looks, flips, .. } = self;
        let count = format!("{looks} looks and {flips} flips at {vertices} vertices");
        (vertices > 0).then_some(count)
    }
}

/// The longest side of a triangle is shorter than the other two together by this share of them. Lengths are
/// rounded at 1e-16 of themselves, so the height of the flattest triangle (a millionth of its base) is still
/// known to four digits; and nothing that a designer draws is as flat.
const ROOM: f64 = 1e-12;

impl Intrinsic {
    /// The triangulation of a carrier, with straight edges.
    pub fn new(mesh: Mesh, xyz: &[DVec3]) -> Intrinsic {
        let lengths = vec![SmallVec::new(); mesh.slots()];
        let edges: Vec<(u32, u32)> = mesh.edges().collect();
        let mut this = Intrinsic {
            mesh,
            lengths,
            suspects: Vec::new(),
            undo: Undo::default(),
            was: Vec::new(),
            commits: 0,
            touched: Vec::new(),
            work: Work::default(),
        };
        for (a, b) in edges {
            this.set_length(a, b, xyz[a as usize].distance(xyz[b as usize]));
        }
        this.was.clear();
        this
    }

    /// Length of an edge as it is kept.
    pub(super) fn length(&self, a: u32, b: u32) -> f64 {
        self.known_length(a, b).expect("every edge has a length")
    }

    fn known_length(&self, a: u32, b: u32) -> Option<f64> {
        let (a, b) = (a.min(b), a.max(b));
        self.lengths[a as usize].iter().find(|e| e.0 == b).map(|e| e.1)
    }

    pub(super) fn set_length(&mut self, a: u32, b: u32, length: f64) {
        self.was.push((a, b, None));
        let (a, b) = (a.min(b), a.max(b));
        if self.lengths.len() < self.mesh.slots() {
            self.lengths.resize(self.mesh.slots(), SmallVec::new());
        }
        let list = &mut self.lengths[a as usize];
        match list.iter_mut().find(|e| e.0 == b) {
            Some(e) => {
                let old = std::mem::replace(&mut e.1, length);
                if let Some(was) = self.was.last_mut() {
                    was.2 = Some(old);
                }
            }
            None => list.push((b, length)),
        }
    }

    pub(super) fn forget_length(&mut self, a: u32, b: u32) {
        let old = self.known_length(a, b);
        self.was.push((a, b, old));
        let (a, b) = (a.min(b), a.max(b));
        self.lengths[a as usize].retain(|e| e.0 != b);
    }

    /// Keep the edits since the last commit.
    pub(super) fn commit(&mut self) {
        self.commits += 1;
        for v in self.undo.touched() {
            self.touched[v as usize] = self.commits;
        }
        self.undo.clear();
        self.was.clear();
    }

    /// Take back the edits since the last commit.
    pub(super) fn take_back(&mut self) {
        self.mesh.take_back(&mut self.undo);
        while let Some((a, b, old)) = self.was.pop() {
            match old {
                Some(length) => self.set_length(a, b, length),
                None => self.forget_length(a, b),
            }
            self.was.pop();
        }
        self.suspects.clear();
    }

    /// Commits so far.
    pub(super) fn now(&self) -> u32 {
        self.commits
    }

    /// The last commit that touched `v` or a neighbour of it.
    pub(super) fn touched_round(&self, v: u32) -> u32 {
        let ring = self.mesh.ring(v).iter().map(|&w| self.touched[w as usize]);
        ring.fold(self.touched[v as usize], u32::max)
    }

    /// Put a vertex into a triangle, at these distances from its corners.
    pub fn insert(&mut self, corners: [u32; 3], distances: [f64; 3]) -> u32 {
        let m = self.mesh.insert_in_triangle(corners);
        for k in 0..3 {
            self.set_length(corners[k], m, distances[k]);
        }
        self.was.clear();
        m
    }

    /// Split the edge from `a` to `b`, on the boundary or on a feature, at `share` of its length.
    pub fn split(&mut self, a: u32, b: u32, share: f64) -> u32 {
        let whole = self.length(a, b);
        let c = self.mesh.left(a, b).expect("the surface lies to the left of its loops");
        let apex = self.apex(a, b, c);
        let across = self.mesh.right(a, b).map(|d| (d, self.apex(a, b, d)));
        let m = self.mesh.try_split(a, b, &mut self.undo).expect("the edge exists");
        self.undo.clear();
        if let Some((d, apex)) = across {
            self.set_length(m, d, apex.distance(DVec2::new(whole * share, 0.0)));
        }
        self.forget_length(a, b);
        self.set_length(a, m, whole * share);
        self.set_length(m, b, whole * (1.0 - share));
        self.set_length(m, c, apex.distance(DVec2::new(whole * share, 0.0)));
        self.was.clear();
        m
    }

    /// All vertices are in. Where triangles are flat or corners coincide, all edges are lengthened alike, by so
    /// little that no length a designer cares about changes, and just enough that every triangle has room
    /// (Sharp & Crane, *A Laplacian for nonmanifold triangle meshes*, 2020, Section 4.5).
    pub fn complete(&mut self) {
        self.work.vertices = self.mesh.vertex_count();
        self.touched = vec![0; self.mesh.slots()];
        let lack = |[a, b, c]: [u32; 3]| {
            let sides = [self.length(a, b), self.length(b, c), self.length(c, a)];
            let (longest, others) = split_longest(&sides);
            sides[longest] - others * (1.0 - 2.0 * ROOM)
        };
        let most = self.mesh.triangles().map(lack).fold(f64::NEG_INFINITY, f64::max);
        if most < 0.0 {
            return;
        }
        // Two corners may coincide in a triangle of no extent at all.
        let least = self.lengths.iter().flatten().fold(0.0, |m, e| e.1.max(m)) * ROOM;
        let more = (2.0 * most).max(least);
        for e in self.lengths.iter_mut().flatten() {
            e.1 += more;
        }
    }

    /// Whether no edit flips the edge: it is on the boundary or on a feature.
    fn is_tied(&self, a: u32, b: u32) -> bool {
        self.mesh.is_feature_edge(a, b) || self.mesh.is_boundary_edge(a, b)
    }

    /// Whether a triangle could have these corners, `across` being the length of the edge from the first to the
    /// second, which need not exist.
    pub(super) fn fits(&self, [a, b, c]: [u32; 3], across: f64) -> bool {
        let sides = [across, self.length(b, c), self.length(c, a)];
        let (longest, others) = split_longest(&sides);
        sides[longest] <= others * (1.0 - ROOM)
            || [false, self.is_tied(b, c), self.is_tied(c, a)][longest]
    }

    /// Whether the triangle can be laid into the plane, its tied edges being shortened where they must.
    pub(super) fn is_sound(&self, [a, b, c]: [u32; 3]) -> bool {
        self.fits([a, b, c], self.length(a, b)) || {
            let sides = [self.length(a, b), self.length(b, c), self.length(c, a)];
            split_longest(&sides).0 == 0 && self.is_tied(a, b)
        }
    }

    /// Make room in a triangle whose longest side is too long: shorten that, or lengthen the others, whichever
    /// leaves room on their far sides.
    pub(super) fn make_room(&mut self, [a, b, c]: [u32; 3]) -> bool {
        let edges = [(a, b), (b, c), (c, a)];
        let sides = edges.map(|(a, b)| self.length(a, b));
        let (longest, others) = split_longest(&sides);
        let (p, q) = edges[longest];
        self.set_length(p, q, others * (1.0 - 2.0 * ROOM));
        if self.is_sound_beside(p, q) {
            return true;
        }
        self.set_length(p, q, sides[longest]);
        let more = 0.5 * (sides[longest] * (1.0 + 4.0 * ROOM) - others);
        let two = [(longest + 1) % 3, (longest + 2) % 3];
        for k in two {
            self.set_length(edges[k].0, edges[k].1, sides[k] + more);
        }
        two.iter().all(|&k| self.is_sound_beside(edges[k].0, edges[k].1))
    }

    fn is_sound_beside(&self, a: u32, b: u32) -> bool {
        let apexes = [self.mesh.left(a, b), self.mesh.right(a, b)];
        apexes.into_iter().flatten().all(|c| self.is_sound([a, b, c]))
    }

    /// The sides of triangle (a, b, c), from a to b first, as it is laid into the plane.
    pub(super) fn sides(&self, a: u32, b: u32, c: u32) -> [f64; 3] {
        planar([self.length(a, b), self.length(b, c), self.length(c, a)])
    }

    /// Triangle (a, b, c) laid into the plane with a at the origin and b on the x axis: where c is, above.
    fn apex(&self, a: u32, b: u32, c: u32) -> DVec2 {
        let sides = self.sides(a, b, c);
        let [ab, bc, ac] = sides;
        let x = 0.5 * (ab + (ac - bc) * (ac + bc) / ab);
        DVec2::new(x, 2.0 * area(sides) / ab)
    }

    /// The two triangles at the edge laid into the plane: length of the edge, left apex (above), right apex
    /// (below). None on the boundary.
    pub(super) fn quad(&self, a: u32, b: u32) -> Option<Quad> {
        let (c, d) = (self.mesh.left(a, b)?, self.mesh.right(a, b)?);
        let below = self.apex(a, b, d);
        Some(Quad {
            length: self.length(a, b),
            left: c,
            right: d,
            above: self.apex(a, b, c),
            below: DVec2::new(below.x, -below.y),
        })
    }
}

/// An edge along the x axis from the origin, and the apexes of its triangles laid into the plane.
pub struct Quad {
    pub length: f64,
    pub left: u32,
    pub right: u32,
    pub above: DVec2,
    pub below: DVec2,
}

impl Quad {
    /// Length of the other diagonal.
    pub fn across(&self) -> f64 {
        self.above.distance(self.below)
    }

    /// Where the line between the apexes crosses the axis, as a share of the edge.
    pub fn crossing(&self) -> f64 {
        let (c, d) = (self.above, self.below);
        (c.x + (d.x - c.x) * c.y / (c.y - d.y).max(f64::MIN_POSITIVE)) / self.length
    }
}

/// The longest side of a triangle, and the sum of the others.
fn split_longest(sides: &[f64; 3]) -> (usize, f64) {
    let longest = (1..3).fold(0, |best, k| if sides[k] > sides[best] { k } else { best });
    (longest, sides[(longest + 1) % 3] + sides[(longest + 2) % 3])
}

/// The sides of a triangle, the longest shortened where it would leave no room.
pub(super) fn planar(mut sides: [f64; 3]) -> [f64; 3] {
    let (longest, others) = split_longest(&sides);
    sides[longest] = sides[longest].min(others * (1.0 - ROOM));
    sides
}

/// Area of a triangle with these sides: Heron's formula in the order that rounding cannot spoil, however thin
/// the triangle (Kahan, *Miscalculating area and angles of a needle-like triangle*, 2014).
pub(super) fn area(mut sides: [f64; 3]) -> f64 {
    sides.sort_by(|x, y| y.total_cmp(x));
    let [a, b, c] = sides;
    let square = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
    0.25 * square.max(0.0).sqrt()
}
