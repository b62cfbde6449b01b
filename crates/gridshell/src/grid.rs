//! The triangular grid on a surface: topology, and where each node sits.

use crate::error::{Error, Result};
use crate::job::Picture;
use crate::mesh::Mesh;
use crate::surface::{Chain, ChainPoint, Locator, Surface, SurfacePoint};
use glam::DVec3;

/// A node on a line slides at most this share of the way to the next node there.
const ROOM: f64 = 0.4;

/// Where a node sits on the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// Free to slide on the surface.
    Interior(SurfacePoint),
    /// Free to slide along a boundary loop.
    Boundary(ChainPoint),
    /// Fixed at a corner of a boundary loop or an anchor on it: `chain` is the loop, `s` the arc length there.
    Corner(ChainPoint),
    /// Free to slide along a feature, of which `chain` is the number.
    Feature(ChainPoint),
    /// Fixed inside: an anchor, or an end, junction or corner of a feature. A vertex of the carrier, but for anchors
    /// put in by hand.
    Fixed(SurfacePoint),
}

/// Cosine of the turn of the surface along a sharp member.
const SHARP: f64 = 0.35;

/// A triangular grid on a design surface. Node `i` is vertex `i` of the mesh; none is missing.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Topology.
    pub mesh: Mesh,
    /// Place of each node.
    pub places: Vec<Place>,
    /// Position of each node in metres.
    pub xyz: Vec<DVec3>,
}

impl Grid {
    /// As it is shown while it is worked on.
    pub fn picture(&self) -> Picture<'_> {
        Picture::Grid { mesh: &self.mesh, xyz: &self.xyz }
    }

    /// Length of the member between nodes `a` and `b`, metres.
    pub fn length(&self, a: u32, b: u32) -> f64 {
        self.xyz[a as usize].distance(self.xyz[b as usize])
    }

    /// Wanted length of the member between `a` and `b` over the mean one: the mean of its ends'.
    pub fn scale(&self, surface: &Surface, a: u32, b: u32) -> f64 {
        if surface.scale.is_empty() {
            return 1.0;
        }
        0.5 * (self.places[a as usize].scale(surface) + self.places[b as usize].scale(surface))
    }

    /// Length of the member between `a` and `b` over its scale, metres: l0 is what is wanted of all members.
    pub fn scaled_length(&self, surface: &Surface, a: u32, b: u32) -> f64 {
        self.length(a, b) / self.scale(surface, a, b)
    }

    /// The members along which the surface turns by more than about seventy degrees: there chords say little
    /// of lengths along the surface, nor tangent planes of straight lines.
    pub fn sharp_members(&self, surface: &Surface) -> Vec<(u32, u32)> {
        let normals: Vec<DVec3> = self.places.iter().map(|p| p.normal(surface)).collect();
        let sharp = |&(a, b): &(u32, u32)| normals[a as usize].dot(normals[b as usize]) < SHARP;
        self.mesh.edges().filter(sharp).collect()
    }

    /// Whether the member is one of [`Grid::sharp_members`].
    pub fn is_sharp(&self, surface: &Surface, a: u32, b: u32) -> bool {
        let normal = |v: u32| self.places[v as usize].normal(surface);
        normal(a).dot(normal(b)) < SHARP
    }

    /// All positions, x y z of one node after the other.
    pub fn flat_xyz(&self) -> Vec<f64> {
        self.xyz.iter().flat_map(DVec3::to_array).collect()
    }

    /// Move every node to the exact surface (and exact boundary) point that its place stands for.
    pub fn settle_exactly(&mut self, surface: &Surface) {
        for (p, place) in self.xyz.iter_mut().zip(&self.places) {
            *p = place.exact(surface);
        }
    }

    /// The part of `v` along which node `i` may move: in the tangent plane, along the boundary, not at all
    /// (where it is fixed or pinned).
    pub fn tangential(&self, surface: &Surface, i: usize, v: DVec3) -> DVec3 {
        if self.mesh.is_pinned(i as u32) {
            return DVec3::ZERO;
        }
        match &self.places[i] {
            Place::Interior(p) => {
                let n = surface.carrier.normal(p);
                v - n * v.dot(n)
            }
            Place::Boundary(c) => {
                let t = surface.loops[c.chain as usize].tangent(&surface.carrier, c.s);
                t * v.dot(t)
            }
            Place::Feature(c) => {
                let t = surface.features[c.chain as usize].tangent(&surface.carrier, c.s);
                t * v.dot(t)
            }
            Place::Corner(_) | Place::Fixed(_) => DVec3::ZERO,
        }
    }

    /// Slide node `i` by about `step` on the surface or along its loop or feature, where it keeps a distance from
    /// its neighbours; gives the distance moved, metres. A pinned node stays.
    pub fn slide(&mut self, surface: &Surface, i: usize, step: DVec3) -> f64 {
        if self.mesh.is_pinned(i as u32) {
            return 0.0;
        }
        let before = self.xyz[i];
        match &mut self.places[i] {
            Place::Interior(p) => {
                *p = surface.carrier.trace_between_features(p, step);
                self.xyz[i] = surface.carrier.xyz(p);
            }
            Place::Boundary(c) => {
                let chain = &surface.loops[c.chain as usize];
                let along = step.dot(chain.tangent(&surface.carrier, c.s));
                let at = *c;
                let along =
                    along.clamp(-self.room(surface, i, at, false), self.room(surface, i, at, true));
                let s = chain.wrap(at.s + along);
                self.places[i] = Place::Boundary(ChainPoint { s, ..at });
                self.xyz[i] = chain.xyz(&surface.carrier, s);
            }
            Place::Feature(c) => {
                let chain = &surface.features[c.chain as usize];
                let along = step.dot(chain.tangent(&surface.carrier, c.s));
                let at = *c;
                let [back, forward] = self.room_on_feature(chain, i, at);
                let s = chain.wrap(at.s + along.clamp(-back, forward));
                self.places[i] = Place::Feature(ChainPoint { s, ..at });
                self.xyz[i] = chain.xyz(&surface.carrier, s);
            }
            Place::Corner(_) | Place::Fixed(_) => {}
        }
        self.xyz[i].distance(before)
    }

    /// How far node `i` may slide back and forward along its loop or feature, metres; None where it is on none.
    pub(crate) fn room_on_line(&self, surface: &Surface, i: usize) -> Option<[f64; 2]> {
        match self.places[i] {
            Place::Boundary(at) => {
                Some([false, true].map(|ahead| self.room(surface, i, at, ahead)))
            }
            Place::Feature(at) => {
                Some(self.room_on_feature(&surface.features[at.chain as usize], i, at))
            }
            Place::Interior(_) | Place::Corner(_) | Place::Fixed(_) => None,
        }
    }

    /// How far boundary node `i` at `at` may slide forward (or back) along its loop: part of the way to the
    /// next node there.
    fn room(&self, surface: &Surface, i: usize, at: ChainPoint, forward: bool) -> f64 {
        let v = i as u32;
        let next =
            if forward { self.mesh.next_on_boundary(v) } else { self.mesh.previous_on_boundary(v) };
        let Some(Place::Boundary(other) | Place::Corner(other)) =
            next.map(|n| self.places[n as usize])
        else {
            return 0.0;
        };
        let gap = if forward { other.s - at.s } else { at.s - other.s };
        ROOM * surface.loops[at.chain as usize].wrap(gap)
    }

    /// How far node `i` at `at` on a feature may slide back and forward: part of the way to the next node there.
    fn room_on_feature(&self, chain: &Chain, i: usize, at: ChainPoint) -> [f64; 2] {
        let length = chain.length();
        let mut room = if chain.is_closed() { [length; 2] } else { [at.s, length - at.s] };
        for &w in self.mesh.along_features(i as u32) {
            // Fixed nodes stand at the ends.
            let Place::Feature(other) = self.places[w as usize] else { continue };
            let gaps = [at.s - other.s, other.s - at.s];
            for (room, gap) in room.iter_mut().zip(gaps) {
                if chain.is_closed() {
                    *room = room.min(chain.wrap(gap));
                } else if gap >= 0.0 {
                    *room = room.min(gap);
                }
            }
        }
        room.map(|gap| ROOM * gap)
    }

    /// The middle of the feature member between nodes `a` and `b`; None where both are fixed and no node of a
    /// feature tells which one it is.
    pub fn middle_on_feature(&self, surface: &Surface, a: u32, b: u32) -> Option<Place> {
        let (pa, pb) = (self.places[a as usize], self.places[b as usize]);
        let ((Place::Feature(at), other) | (other, Place::Feature(at))) = (pa, pb) else {
            return self.middle_of_whole_feature(surface, pa, pb);
        };
        let chain = &surface.features[at.chain as usize];
        let s = match other {
            Place::Feature(other) if chain.is_closed() => {
                let gap = chain.wrap(other.s - at.s);
                let half = 0.5 * chain.length();
                chain.wrap(at.s + 0.5 * if gap > half { gap - chain.length() } else { gap })
            }
            Place::Feature(other) => 0.5 * (at.s + other.s),
            end => {
                // The nearer end where both are the same fixed node.
                let far = self.xyz[a as usize] + self.xyz[b as usize];
                let middles = [0.5 * at.s, 0.5 * (at.s + chain.length())];
                let ends = [0.0, chain.length()].map(|s| chain.xyz(&surface.carrier, s));
                let is_end = ends.map(|e| e == end.xyz(surface));
                let off = middles.map(|s| (chain.xyz(&surface.carrier, s) * 2.0 - far).length());
                match is_end {
                    [true, false] => middles[0],
                    [false, true] => middles[1],
                    _ => middles[usize::from(off[1] < off[0])],
                }
            }
        };
        Some(Place::Feature(ChainPoint { chain: at.chain, s }))
    }

    /// The middle of the feature from one fixed node to another that is a single member.
    fn middle_of_whole_feature(&self, surface: &Surface, a: Place, b: Place) -> Option<Place> {
        let ends = [a.xyz(surface), b.xyz(surface)];
        let taken =
            |c: u32| self.places.iter().any(|p| matches!(p, Place::Feature(at) if at.chain == c));
        let joins = |chain: &Chain| {
            let last = chain.vertices[chain.vertices.len() - 1];
            let own = [chain.vertices[0], last].map(|v| surface.carrier.points[v as usize]);
            !chain.is_closed() && (own == ends || [own[1], own[0]] == ends)
        };
        let mut whole = (0..surface.features.len()).filter(|&c| joins(&surface.features[c]));
        let c = whole.find(|&c| !taken(c as u32))?;
        let s = 0.5 * surface.features[c].length();
        Some(Place::Feature(ChainPoint { chain: c as u32, s }))
    }

    /// The grid of these nodes and panels (oriented alike), each node with the place of `surface` nearest to
    /// it; positions stay as they are. Panels that look inwards are turned to look outwards, all together.
    ///
    /// # Errors
    /// [`Error::Surface`] when the panels are not a manifold, or the grid has a boundary and the surface
    /// has none.
    pub fn from_panels(xyz: Vec<DVec3>, panels: &[[u32; 3]], surface: &Surface) -> Result<Grid> {
        let mesh = Mesh::from_triangles(xyz.len(), panels)?;
        let locator = Locator::new(surface);
        let place = |(v, &x): (usize, &DVec3)| {
            if mesh.is_boundary(v as u32) {
                locator.nearest_on_loops(x).map(Place::Boundary)
            } else {
                locator.nearest(x).map(Place::Interior)
            }
        };
        let found: Option<Vec<_>> = xyz.iter().enumerate().map(place).collect();
        let places = found.ok_or_else(|| {
            Error::Surface(
                "the grid has a boundary but the surface has none: is it the right surface?".into(),
            )
        })?;
        let outwards = |t: &[u32; 3]| {
            let p = t.map(|v| xyz[v as usize]);
            let normal = surface.carrier.normal(&places[t[0] as usize].surface_point(surface));
            (p[1] - p[0]).cross(p[2] - p[0]).dot(normal)
        };
        if panels.iter().map(outwards).sum::<f64>() >= 0.0 {
            return Ok(Grid { mesh, places, xyz });
        }
        let turned: Vec<_> = panels.iter().map(|&[a, b, c]| [a, c, b]).collect();
        Ok(Grid { mesh: Mesh::from_triangles(xyz.len(), &turned)?, places, xyz })
    }

    /// A grid that is its own surface: what can be measured when the design surface is not known.
    ///
    /// # Errors
    /// [`Error::Surface`] when the panels are not a manifold.
    pub fn alone(name: &str, xyz: Vec<DVec3>, panels: &[[u32; 3]]) -> Result<(Grid, Surface)> {
        // Checked before the surface is made, which trusts its triangles.
        Mesh::from_triangles(xyz.len(), panels)?;
        let surface = Surface::from_facets(name, xyz.clone(), panels.to_vec());
        let grid = Grid::from_panels(xyz, panels, &surface)?;
        Ok((grid, surface))
    }
}

impl Place {
    /// Distance in metres of `xyz`, which should stand at this place, from the exact surface: its patches with
    /// their edges. Files draw edges a little off their patches; a node on the edge is on the surface.
    pub fn off_surface(&self, surface: &Surface, xyz: DVec3) -> f64 {
        let off_patch = surface.deviation(&self.surface_point(surface), xyz);
        match self {
            Place::Interior(_) | Place::Fixed(_) => off_patch,
            Place::Feature(c) => {
                off_patch.min(surface.features[c.chain as usize].deviation(surface, c.s, xyz))
            }
            Place::Boundary(_) | Place::Corner(_) => off_patch.min(self.off_boundary(surface, xyz)),
        }
    }

    /// Distance in metres of `xyz` from the exact boundary; 0 for an interior place.
    pub fn off_boundary(&self, surface: &Surface, xyz: DVec3) -> f64 {
        match self {
            Place::Interior(_) | Place::Feature(_) | Place::Fixed(_) => 0.0,
            Place::Boundary(c) | Place::Corner(c) => {
                surface.loops[c.chain as usize].deviation(surface, c.s, xyz)
            }
        }
    }

    /// Whether it may not move at all.
    pub fn is_fixed(&self) -> bool {
        matches!(self, Place::Corner(_) | Place::Fixed(_))
    }

    /// The carrier point of this place.
    pub fn surface_point(&self, surface: &Surface) -> SurfacePoint {
        match self {
            Place::Interior(p) | Place::Fixed(p) => *p,
            Place::Feature(c) => surface.features[c.chain as usize].surface_point(c.s),
            Place::Boundary(c) | Place::Corner(c) => {
                surface.loops[c.chain as usize].surface_point(c.s)
            }
        }
    }

    /// Wanted length here over the mean one; 1 everywhere unless lengths are to vary.
    pub fn scale(&self, surface: &Surface) -> f64 {
        if surface.scale.is_empty() { 1.0 } else { surface.scale_at(&self.surface_point(surface)) }
    }

    /// Unit normal of the carrier here.
    pub fn normal(&self, surface: &Surface) -> DVec3 {
        surface.carrier.normal(&self.surface_point(surface))
    }

    /// The exact position on the design surface.
    pub fn exact(&self, surface: &Surface) -> DVec3 {
        match self {
            // Fixed vertices of the carrier are exact as they stand.
            Place::Fixed(p) if p.bary.contains(&1.0) => surface.carrier.xyz(p),
            Place::Interior(p) | Place::Fixed(p) => surface.exact(p),
            Place::Feature(c) => surface.features[c.chain as usize].exact(surface, c.s),
            Place::Boundary(c) | Place::Corner(c) => {
                surface.loops[c.chain as usize].exact(surface, c.s)
            }
        }
    }

    /// The position on the carrier.
    pub fn xyz(&self, surface: &Surface) -> DVec3 {
        match self {
            Place::Interior(p) | Place::Fixed(p) => surface.carrier.xyz(p),
            Place::Feature(c) => surface.features[c.chain as usize].xyz(&surface.carrier, c.s),
            Place::Boundary(c) | Place::Corner(c) => {
                surface.loops[c.chain as usize].xyz(&surface.carrier, c.s)
            }
        }
    }
}
