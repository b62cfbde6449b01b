//! A grid under edge operations: connectivity, positions and adjusted degrees change together, and a run of
//! changes can be taken back.

use crate::balance::arc_over_chord;
use crate::degree::{boundary_angle, virtual_degree};
use crate::grid::{Grid, Place};
use crate::merit;
use crate::mesh::{Refusal, Undo};
use crate::surface::{ChainPoint, Surface};
use glam::DVec3;
use smallvec::SmallVec;

/// A few vertices.
pub type Few = SmallVec<[u32; 80]>;

/// A grid being regularized.
#[derive(Clone)]
pub struct State<'a> {
    pub surface: &'a Surface,
    pub grid: Grid,
    /// Wanted edge length, metres.
    pub length: f64,
    /// Weight of interior vertices, Eq. 13.
    pub lambda: f64,
    /// Normal of the surface at each node, where it bends so sharply that lengths are to follow it; else empty.
    normals: Vec<DVec3>,
    /// Adjusted degree minus six of each vertex (0 for removed ones).
    pub deviation: Vec<i32>,
    /// Irregular vertices in use, in no meaning order, and where each stands in that list.
    irregular: Vec<u32>,
    listed: Vec<u32>,
    undo: Undo,
    moved: Vec<(u32, Place, DVec3)>,
    /// Marks of the last region gathered, and where each vertex stands in it.
    mark: Vec<u32>,
    slot: Vec<u32>,
    stamp: u32,
}

const UNLISTED: u32 = u32::MAX;

impl<'a> State<'a> {
    pub fn new(surface: &'a Surface, grid: Grid, length: f64, lambda: f64) -> State<'a> {
        let n = grid.mesh.slots();
        let bends = !grid.sharp_members(surface).is_empty();
        let normals = |places: &[Place]| places.iter().map(|p| p.normal(surface)).collect();
        let mut state = State {
            surface,
            normals: if bends { normals(&grid.places) } else { Vec::new() },
            grid,
            length,
            lambda,
            deviation: vec![0; n],
            irregular: Vec::new(),
            listed: vec![UNLISTED; n],
            undo: Undo::default(),
            moved: Vec::new(),
            mark: vec![0; n],
            slot: vec![0; n],
            stamp: 0,
        };
        state.refresh_all();
        state
    }

    /// Work out every adjusted degree anew.
    pub fn refresh_all(&mut self) {
        let all: Vec<u32> = (0..self.grid.mesh.slots() as u32).collect();
        self.refresh(&all);
    }

    /// Work out the adjusted degrees of these vertices anew.
    pub fn refresh(&mut self, vertices: &[u32]) {
        for &v in vertices {
            let d = self.deviation_of(v);
            self.deviation[v as usize] = d;
            let at = self.listed[v as usize];
            if d != 0 && at == UNLISTED {
                self.listed[v as usize] = self.irregular.len() as u32;
                self.irregular.push(v);
            } else if d == 0 && at != UNLISTED {
                self.irregular.swap_remove(at as usize);
                self.listed[v as usize] = UNLISTED;
                if let Some(&other) = self.irregular.get(at as usize) {
                    self.listed[other as usize] = at;
                }
            }
        }
    }

    fn deviation_of(&self, v: u32) -> i32 {
        let mesh = &self.grid.mesh;
        if !mesh.is_alive(v) {
            return 0;
        }
        let degree = mesh.degree(v) as i32;
        if mesh.is_boundary(v) {
            degree + virtual_degree(boundary_angle(mesh, &self.grid.xyz, v)) - 6
        } else {
            degree - 6
        }
    }

    /// Irregular vertices, in an order that depends on history only.
    pub fn irregular(&self) -> &[u32] {
        &self.irregular
    }

    /// gamma_i of Eq. 13.
    pub fn gamma(&self, v: u32) -> f64 {
        if self.grid.mesh.is_boundary(v) { 1.0 - self.lambda } else { self.lambda }
    }

    /// Change of the residual R (Eq. 14, 17) when the deviation of `v` changes by `by`.
    pub fn residual_change(&self, v: u32, by: i32) -> f64 {
        let d = self.deviation[v as usize];
        self.gamma(v) * f64::from((d + by) * (d + by) - d * d)
    }

    /// Change of R by flipping the edge (Eq. 15 to 17); None on the boundary.
    pub fn flip_change(&self, a: u32, b: u32) -> Option<f64> {
        let (c, d) = (self.grid.mesh.left(a, b)?, self.grid.mesh.right(a, b)?);
        let lose = self.residual_change(a, -1) + self.residual_change(b, -1);
        Some(lose + self.residual_change(c, 1) + self.residual_change(d, 1))
    }

    /// The flips that may lower R because of `v`, of its own edges where they are too many and of those opposite to it
    /// where they are too few, each with the change of R.
    pub fn flips_for(&self, v: u32) -> impl Iterator<Item = (f64, u32, u32)> + '_ {
        let off = self.deviation[v as usize];
        self.grid.mesh.fan(v).filter(move |_| off != 0).filter_map(move |(a, b)| {
            let (a, b) = if off > 0 { (v, a) } else { (a, b) };
            Some((self.flip_change(a, b)?, a, b))
        })
    }

    /// Flip an edge.
    pub fn flip(&mut self, a: u32, b: u32) -> Result<(u32, u32), Refusal> {
        self.grid.mesh.try_flip(a, b, &mut self.undo)
    }

    /// Split an edge at its middle (on the surface, or on the loop or feature that it is part of).
    pub fn split(&mut self, a: u32, b: u32) -> Result<u32, Refusal> {
        let on_boundary = self.grid.mesh.is_boundary_edge(a, b);
        let place = if on_boundary {
            self.middle_on_loop(a, b)
        } else if self.grid.mesh.is_feature_edge(a, b) {
            self.grid.middle_on_feature(self.surface, a, b).ok_or(Refusal::Feature)?
        } else {
            self.middle_on_surface(a, b)
        };
        let m = self.grid.mesh.try_split(a, b, &mut self.undo)?;
        let n = self.grid.mesh.slots();
        if self.grid.xyz.len() < n {
            self.grid.xyz.resize(n, DVec3::ZERO);
            self.grid.places.resize(n, place);
            if self.bends() {
                self.normals.resize(n, DVec3::ZERO);
            }
            self.deviation.resize(n, 0);
            self.listed.resize(n, UNLISTED);
            self.mark.resize(n, 0);
            self.slot.resize(n, 0);
        }
        self.set_place(m, place);
        Ok(m)
    }

    /// Collapse an edge; the end that is the more fixed one (pinned, then boundary, then on a feature) stays, or else `a`, which
    /// goes to the middle. Gives the end that stays.
    pub fn collapse(&mut self, a: u32, b: u32) -> Result<u32, Refusal> {
        let mesh = &self.grid.mesh;
        let rank =
            |v: u32| (mesh.is_pinned(v), mesh.is_boundary(v), !mesh.along_features(v).is_empty());
        let (keep, gone) = if rank(b) > rank(a) { (b, a) } else { (a, b) };
        let place = match (self.grid.places[keep as usize], mesh.is_boundary_edge(a, b)) {
            (pinned, _) if mesh.is_pinned(keep) => pinned,
            (Place::Interior(_), _) => self.middle_on_surface(keep, gone),
            (Place::Boundary(_), true) => self.middle_on_loop(keep, gone),
            (Place::Feature(_), _) if mesh.is_feature_edge(a, b) => {
                self.grid.middle_on_feature(self.surface, a, b).ok_or(Refusal::Feature)?
            }
            (fixed, _) => fixed,
        };
        self.grid.mesh.try_collapse(keep, gone, &mut self.undo)?;
        self.set_place(keep, place);
        Ok(keep)
    }

    fn set_place(&mut self, v: u32, place: Place) {
        let i = v as usize;
        self.moved.push((v, self.grid.places[i], self.grid.xyz[i]));
        self.grid.places[i] = place;
        self.grid.xyz[i] = place.xyz(self.surface);
        self.refresh_normal(v);
    }

    fn refresh_normal(&mut self, v: u32) {
        if self.bends() {
            self.normals[v as usize] = self.grid.places[v as usize].normal(self.surface);
        }
    }

    fn bends(&self) -> bool {
        !self.normals.is_empty()
    }

    /// Slide node `v` by about `step` (see [`Grid::slide`]). To be remembered first where it may be taken back.
    pub fn slide(&mut self, v: u32, step: DVec3) {
        self.grid.slide(self.surface, v as usize, step);
        self.refresh_normal(v);
    }

    fn middle_on_surface(&self, a: u32, b: u32) -> Place {
        let (mesh, xyz) = (&self.grid.mesh, &self.grid.xyz);
        // A trace from the boundary, across a bay of it or along a straight side, may be out at once; and the place of
        // a node on a feature is on its left side, which may be the wrong one.
        let inside = |v: &u32| matches!(self.grid.places[*v as usize], Place::Interior(_));
        let near = [Some(a), Some(b), mesh.left(a, b), mesh.right(a, b)];
        let from = near.into_iter().flatten().find(inside).unwrap_or(a) as usize;
        let start = self.grid.places[from].surface_point(self.surface);
        let middle = (xyz[a as usize] + xyz[b as usize]) * 0.5;
        let carrier = &self.surface.carrier;
        let end = carrier.trace(&start, middle - xyz[from]);
        if !carrier.is_at_boundary(&end) {
            return Place::Interior(end);
        }
        // On the boundary itself the next one would be at one place with this.
        Place::Interior(carrier.trace(&start, (carrier.xyz(&end) - xyz[from]) * 0.5))
    }

    fn middle_on_loop(&self, a: u32, b: u32) -> Place {
        let (a, b) = if self.grid.mesh.next_on_boundary(a) == Some(b) { (a, b) } else { (b, a) };
        let on_loop = |v: u32| match self.grid.places[v as usize] {
            Place::Boundary(c) | Place::Corner(c) => c,
            _ => unreachable!("boundary vertices have places on loops"),
        };
        let (from, to) = (on_loop(a), on_loop(b));
        let chain = &self.surface.loops[from.chain as usize];
        let s = chain.wrap(from.s + 0.5 * chain.wrap(to.s - from.s));
        Place::Boundary(ChainPoint { chain: from.chain, s })
    }

    /// Vertices within `rings` rings of these.
    pub fn region(&mut self, seeds: &[u32], rings: usize) -> Few {
        self.stamp += 1;
        let mut region = Few::new();
        for &v in seeds {
            if self.grid.mesh.is_alive(v) && self.mark[v as usize] != self.stamp {
                self.mark[v as usize] = self.stamp;
                self.slot[v as usize] = region.len() as u32;
                region.push(v);
            }
        }
        let mut from = 0;
        for _ in 0..rings {
            let to = region.len();
            for i in from..to {
                for &w in self.grid.mesh.ring(region[i]) {
                    if self.mark[w as usize] != self.stamp {
                        self.mark[w as usize] = self.stamp;
                        self.slot[w as usize] = region.len() as u32;
                        region.push(w);
                    }
                }
            }
            from = to;
        }
        region
    }

    /// Sum over the members that touch the region *last gathered* of (l / l0 - 1)^2.
    pub fn length_energy(&self, region: &[u32]) -> f64 {
        let mut sum = 0.0;
        for &v in region {
            for &w in self.grid.mesh.ring(v) {
                if w > v || !self.in_region(w) {
                    let strain = self.member(v, w).1 / self.length - 1.0;
                    sum += strain * strain;
                }
            }
        }
        sum
    }

    /// The chord from `v` to `w`, and its length (where the surface bends sharply: of the arc above it) over the
    /// scale there.
    pub fn member(&self, v: u32, w: u32) -> (DVec3, f64) {
        let chord = self.grid.xyz[w as usize] - self.grid.xyz[v as usize];
        let length = chord.length() / self.scale(v, w);
        if !self.bends() {
            return (chord, length);
        }
        let [n, m] = [v, w].map(|v| self.normals[v as usize]);
        (chord, length * arc_over_chord(n, m))
    }

    /// Wanted length from `v` to `w` over the mean one.
    pub fn scale(&self, v: u32, w: u32) -> f64 {
        self.grid.scale(self.surface, v, w)
    }

    /// Sweep over the vertices, moving each to where its members are nearest to the wanted length.
    pub fn relax(&mut self, region: &[u32], sweeps: usize) {
        self.remember(region);
        let least = 1e-9 * self.length;
        for _ in 0..sweeps {
            for &v in region {
                let ring = self.grid.mesh.ring(v);
                let pull: DVec3 = ring
                    .iter()
                    .map(|&w| {
                        let (chord, length) = self.member(v, w);
                        chord * ((length - self.length) / chord.length().max(least))
                    })
                    .sum();
                // The members of a regular node resist a move with half their number in either direction.
                let scale = self.scale(v, v);
                let mut step = pull * (2.0 * scale / ring.len() as f64);
                let reach = 0.3 * scale * self.length;
                if step.length_squared() > reach * reach {
                    step *= reach / step.length();
                }
                self.slide(v, step);
            }
        }
    }

    /// Whether `v` is in the region last gathered.
    pub fn in_region(&self, v: u32) -> bool {
        self.mark[v as usize] == self.stamp
    }

    /// Where `v` stands in the region last gathered; None outside.
    pub fn slot_in_region(&self, v: u32) -> Option<usize> {
        self.in_region(v).then(|| self.slot[v as usize] as usize)
    }

    /// Whether the surface turns so much along this member that lines are not held straight across it.
    pub fn is_sharp(&self, a: u32, b: u32) -> bool {
        self.bends() && self.grid.is_sharp(self.surface, a, b)
    }

    /// Keep the places of these vertices for a possible roll back.
    pub fn remember(&mut self, region: &[u32]) {
        for &v in region {
            self.moved.push((v, self.grid.places[v as usize], self.grid.xyz[v as usize]));
        }
    }

    /// Go on from another grid.
    pub fn replace(&mut self, grid: Grid) {
        *self = State::new(self.surface, grid, self.length, self.lambda);
    }

    /// Whether a panel at one of these vertices is a sliver (shape below `least`) or turned over.
    pub fn has_bad_panel(&self, vertices: &[u32], least: f64) -> bool {
        let grid = &self.grid;
        vertices.iter().any(|&v| {
            grid.mesh.fan(v).any(|(a, b)| {
                let t = [v, a, b];
                merit::shape(t.map(|v| grid.xyz[v as usize])) < least
                    || merit::is_turned(grid, self.surface, t)
            })
        })
    }

    /// The vertices whose rings changed since the last commit.
    pub fn touched(&self) -> Few {
        self.undo.touched().collect()
    }

    /// Whether the edits since the last commit left connectivity as it was.
    pub fn is_idle(&self) -> bool {
        self.undo.is_idle(&self.grid.mesh)
    }

    /// Keep the changes since the last commit; adjusted degrees must have been refreshed.
    pub fn commit(&mut self) {
        self.undo.clear();
        self.moved.clear();
    }

    /// Take back the changes since the last commit, adjusted degrees included where they were refreshed.
    pub fn roll_back(&mut self) {
        let mut stale: Few = self.undo.touched().collect();
        self.grid.mesh.take_back(&mut self.undo);
        while let Some((v, place, xyz)) = self.moved.pop() {
            self.grid.places[v as usize] = place;
            self.grid.xyz[v as usize] = xyz;
            self.refresh_normal(v);
            if self.grid.mesh.is_boundary(v) {
                stale.push(v);
            }
        }
        stale.sort_unstable();
        stale.dedup();
        self.refresh(&stale);
    }

    /// The grid, numbered without gaps: boundary and interior nodes keep their order.
    pub fn into_grid(mut self) -> Grid {
        let old = self.grid.mesh.compact();
        self.grid.places = old.iter().map(|&v| self.grid.places[v as usize]).collect();
        self.grid.xyz = old.iter().map(|&v| self.grid.xyz[v as usize]).collect();
        self.grid
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bubbles::Bubbles;
    use crate::job::Job;
    use crate::stages::{pack, triangulate};
    use crate::surface::{Fixtures, PolygonMesh, Sampling, builtin};

    const LENGTH: f64 = 0.7;

    /// The flat hexagon with a guide from (-2, -1) to (2, 1.5) and an anchor at (0, -2).
    fn fixed() -> Surface {
        let sampling = Sampling { max_edge: 0.35, chord_error: 1e-3, corner_angle: 0.5 };
        let model = builtin::model("hexagon").expect("built in");
        let mut surface = model.surface(&sampling, &Job::default()).expect("a surface");
        let guide = vec![DVec3::new(-2.0, -1.0, 0.0), DVec3::new(2.0, 1.5, 0.0)];
        let wanted = Fixtures {
            crease_angle: None,
            guides: &[guide],
            anchors: &[DVec3::new(0.0, -2.0, 0.0)],
            corner_angle: 0.5,
            edge_length: LENGTH,
        };
        surface.fix(&wanted, &Job::default()).expect("guide and anchor are on the surface");
        surface
    }

    fn grid(surface: &Surface) -> Grid {
        let counts = |pieces: &[pack::boundary::Piece]| -> Vec<usize> {
            pieces.iter().map(|p| pack::boundary::member_count(p, LENGTH)).collect()
        };
        let pieces = pack::boundary::pieces(surface);
        let boundary = pack::boundary::place(surface, &pieces, &counts(&pieces), 0.0);
        let lines = pack::boundary::feature_pieces(surface);
        let features = pack::boundary::place_on_features(surface, &lines, &counts(&lines));
        let fixed = surface.fixed.clone();
        let mut bubbles = Bubbles { boundary, features, fixed, interior: Vec::new() };
        let held = bubbles.xyz(surface);
        let mut rng = fastrand::Rng::with_seed(3);
        bubbles.interior =
            pack::scatter(surface, 80, &held, 0.5 * LENGTH, &mut rng, &Job::default());
        triangulate::triangulate(surface, &bubbles, &Job::default()).expect("a manifold").0
    }

    /// The nodes on the guide are joined by its members in order, and the anchor is where it was.
    fn assert_kept(grid: &Grid) {
        let (start, end) = (DVec3::new(-2.0, -1.0, 0.0), DVec3::new(2.0, 1.5, 0.0));
        let along = (end - start).normalize();
        let on: Vec<u32> =
            grid.mesh.vertices().filter(|&v| !grid.mesh.along_features(v).is_empty()).collect();
        let s = |v: u32| (grid.xyz[v as usize] - start).dot(along);
        let mut sorted = on.clone();
        sorted.sort_by(|&a, &b| s(a).total_cmp(&s(b)));
        for &v in &sorted {
            let x = grid.xyz[v as usize];
            assert!((start + along * s(v)).distance(x) < 1e-9, "{x} is off the guide");
        }
        for w in sorted.windows(2) {
            assert!(grid.mesh.is_feature_edge(w[0], w[1]), "{} {}", s(w[0]), s(w[1]));
        }
        let ends = [sorted[0], sorted[sorted.len() - 1]].map(|v| grid.xyz[v as usize]);
        assert!(ends[0].distance(start) < 1e-12 && ends[1].distance(end) < 1e-12);
        let anchor = DVec3::new(0.0, -2.0, 0.0);
        assert!(grid.mesh.vertices().any(|v| grid.xyz[v as usize].distance(anchor) < 1e-12));
    }

    #[test]
    fn a_member_across_a_bay_is_split_away_from_its_ends() {
        // A trace from the boundary out of the surface went nowhere: two nodes at one place, whose angles, and all that a
        // search made of them, were rounding. Files of one roof got different grids by that.
        //        3
        //      / 4 \       the chord from 0 to 2 leaves the surface below 1
        //    / 1     \
        //   0          2
        let points = [(-3.0, 0.0), (-1.0, 1.0), (3.0, 0.0), (0.0, 4.0), (0.0, 2.5)];
        let points: Vec<DVec3> = points.map(|(x, y)| DVec3::new(x, y, 0.0)).into();
        let faces = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]].map(|f| f.to_vec()).into();
        let mesh = PolygonMesh { points: points.clone(), faces, ..PolygonMesh::default() };
        let sampling = Sampling { max_edge: 9.0, chord_error: 1e-3, corner_angle: 3.0 };
        let surface = mesh.surface(&sampling, &Job::default()).expect("a surface");
        let panels = [[0, 1, 2], [0, 2, 4], [2, 3, 4], [3, 0, 4]];
        let grid = Grid::from_panels(points, &panels, &surface).expect("a grid");
        for (a, b) in [(0, 2), (2, 0)] {
            let mut state = State::new(&surface, grid.clone(), LENGTH, 0.9);
            let m = state.split(a, b).expect("an inner member");
            let at = state.grid.xyz[m as usize];
            assert!(at.distance(DVec3::new(0.0, 1.625, 0.0)) < 1e-9, "{at}");
        }
    }

    #[test]
    fn any_edits_and_moves_keep_guides_and_anchors() {
        let surface = fixed();
        let mut state = State::new(&surface, grid(&surface), LENGTH, 0.9);
        assert_kept(&state.grid);
        let mut rng = fastrand::Rng::with_seed(4);
        for _ in 0..3000 {
            let alive: Vec<u32> = state.grid.mesh.vertices().collect();
            let a = alive[rng.usize(..alive.len())];
            let ring = state.grid.mesh.ring(a);
            let b = ring[rng.usize(..ring.len())];
            let done = match rng.u8(..3) {
                0 => state.flip(a, b).is_ok(),
                1 => alive.len() < 250 && state.split(a, b).is_ok(),
                _ => alive.len() > 80 && state.collapse(a, b).is_ok(),
            };
            if done {
                let touched = state.touched();
                let alive = state.region(&touched, 0);
                state.relax(&alive, 2);
            }
            if rng.u8(..3) == 0 {
                state.roll_back();
            } else {
                state.commit();
            }
            state.grid.mesh.check().expect("valid");
            assert_kept(&state.grid);
        }
    }
}
