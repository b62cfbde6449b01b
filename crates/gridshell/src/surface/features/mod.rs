//! What the designer fixes: creases and guides become *features*, lines that members follow; anchors become
//! nodes.
//!
//! Creases are carrier edges as they stand. Guides and anchors are cut into the carrier. Then all feature edges
//! are gathered into chains, which end at fixed nodes: where a feature ends, meets another or the boundary,
//! turns sharply, or carries an anchor.

mod crowd;
pub(in crate::surface) mod cut;
mod dense;
mod extend;
mod guide;
mod thin;

use super::carrier::NONE;
use super::carrier::chain::{Segment, boundary_loops, exceeds};
use super::carrier::track::Track;
use super::{Chain, Surface, SurfacePoint};
use crate::error::Result;
use crate::job::{Job, Picture};
use crate::math::trig;
use cut::Cutter;
use dense::thin_guide;
use glam::DVec3;
use rstar::RTree;
use rstar::primitives::GeomWithData;
use std::collections::BTreeSet;
use thin::thinned;

/// Features shorter than this, over l0, have no room for a member.
const SHORT: f64 = 0.5;
/// Features nearer to one another or to the boundary than this, over l0, leave no room for panels.
const NEAR: f64 = 0.5;
/// Within this distance of a fixed node, over l0, lines that meet there are near one another by nature.
const MEETING: f64 = 1.5;
/// More places of one kind than this are only counted.
const MOST_TOLD: usize = 5;

/// What is to be fixed on a surface. Metres and radians.
#[derive(Clone, Copy, Debug)]
pub struct Fixtures<'a> {
    /// Edges where the surface turns by more than this are creases; None finds none.
    pub crease_angle: Option<f64>,
    /// Polylines near the surface.
    pub guides: &'a [Vec<DVec3>],
    /// Points near the surface.
    pub anchors: &'a [DVec3],
    /// Where a feature or the boundary turns by more than this, it has a corner.
    pub corner_angle: f64,
    /// Wanted member length l0.
    pub edge_length: f64,
}

impl Surface {
    /// Fix creases, guides and anchors; gives what the user should know of them.
    ///
    /// # Errors
    /// [`Error::Surface`](crate::Error::Surface) with coordinates where a guide leaves the surface or is
    /// shorter than a member, or an anchor lies off the surface by more than one.
    pub fn fix(&mut self, wanted: &Fixtures, job: &Job) -> Result<Vec<String>> {
        let mut notes = Vec::new();
        if let Some(angle) = wanted.crease_angle {
            self.mark_creases(angle);
            notes.extend(self.drop_short_creases(wanted));
        }
        let mut dense = self.thin_corners(wanted.edge_length);
        let mut anchors = Vec::new();
        if !wanted.guides.is_empty() || !wanted.anchors.is_empty() {
            let origin = self.origin;
            let mut cutter = Cutter::new(self, wanted.edge_length);
            for (i, guide) in wanted.guides.iter().enumerate() {
                job.check("fixing guides")?;
                job.progress("fix", i as f64 / wanted.guides.len() as f64, Picture::None);
                let (points, noise) = thinned(guide, wanted.edge_length);
                if noise {
                    let (n, m) = (guide.len(), points.len());
                    notes.push(format!(
                        "guide {} has {n} points, far nearer to each other than members are long: {m} of them are \
                         followed",
                        i + 1
                    ));
                }
                let thinned =
                    thin_guide(i, &points, wanted.corner_angle, wanted.edge_length, origin);
                let guide: &[DVec3] = match &thinned {
                    Some((guide, note)) => {
                        notes.push(note.clone());
                        guide
                    }
                    None => &points,
                };
                notes.extend(cutter.cut_guide(i, guide)?);
            }
            // An anchor given many times is one.
            let mut known = BTreeSet::new();
            for (i, &anchor) in wanted.anchors.iter().enumerate() {
                job.check("fixing anchors")?;
                job.progress("fix", i as f64 / wanted.anchors.len() as f64, Picture::None);
                if known.insert(anchor.to_array().map(f64::to_bits)) {
                    let (vertex, note) = cutter.put_anchor(i, anchor)?;
                    anchors.push(vertex);
                    notes.extend(note);
                }
            }
            cutter.finish();
            let tracks = &self.tracks;
            self.loops =
                boundary_loops(&self.carrier, wanted.corner_angle, |a, b| tracks.curve_of(a, b));
            for l in &mut self.loops {
                l.find_corners(&self.carrier, &self.curves, wanted.corner_angle);
            }
            dense = self.thin_corners(wanted.edge_length).or(dense);
        }
        notes.extend(dense);
        if anchors.is_empty() && self.tracks.features().next().is_none() {
            return Ok(notes);
        }
        self.gather(&anchors, wanted.corner_angle);
        notes.extend(self.near_features(wanted.edge_length));
        Ok(notes)
    }

    /// Gather the feature edges into chains, and enter these anchors and the chains' ends among what is fixed.
    pub(super) fn gather(&mut self, anchors: &[u32], corner_angle: f64) {
        let Lines { chains, fixed } = self.lines(anchors, corner_angle);
        self.wall_up();
        self.features = chains;
        self.fix_vertices(&fixed);
    }

    /// Mark as features the carrier edges inside where the exact surface turns by more than `angle`. Where the
    /// surface has patches, only their edges are looked at: inside a patch, a turn is a tight bend.
    fn mark_creases(&mut self, angle: f64) {
        let carrier = &self.carrier;
        let mut found = Vec::new();
        for t in 0..carrier.triangles.len() {
            for k in 0..3 {
                let u = carrier.neighbors[t][k];
                if u == NONE || u < t as u32 {
                    continue;
                }
                let (a, b) = (carrier.triangles[t][k], carrier.triangles[t][(k + 1) % 3]);
                let smooth = carrier.face_normal(t as u32).dot(carrier.face_normal(u)) > 0.9999;
                let curved = !self.shapes.is_empty();
                if smooth && !curved || curved && self.tracks.curve_of(a, b).is_none() {
                    continue;
                }
                let [m, n] = [t as u32, u].map(|t| self.normal_beside(t, a, b));
                if exceeds(trig::angle(m, n), angle) {
                    found.push((a, b));
                }
            }
        }
        for (a, b) in found {
            self.tracks.lay(a, b, Track::of_mesh());
        }
    }

    /// Normal of the exact surface on the side of triangle `t` of its edge between `a` and `b`, in the middle.
    fn normal_beside(&self, t: u32, a: u32, b: u32) -> DVec3 {
        let flat = self.carrier.face_normal(t);
        let corners = self.carrier.triangles[t as usize];
        let bary = corners.map(|v| if v == a || v == b { 0.5 } else { 0.0 });
        let Some(shape) = self.shapes.get(self.carrier.patch[t as usize] as usize) else {
            return flat;
        };
        let normal = shape.jet(self.carrier.uv_at(&SurfacePoint { triangle: t, bary })).normal();
        match normal.dot(flat) {
            d if d > 0.0 => normal,
            d if d < 0.0 => -normal,
            _ => flat,
        }
    }

    /// Creases without room for a member are none: dust in a mesh, or a facetted surface under a coarse grid.
    fn drop_short_creases(&mut self, wanted: &Fixtures) -> Option<String> {
        let mut dropped: Vec<DVec3> = Vec::new();
        loop {
            let chains = self.lines(&[], wanted.corner_angle).chains;
            let short = chains.iter().filter(|c| {
                let rounds = if c.is_closed() { 6.0 } else { 1.0 };
                c.length() < rounds * SHORT * wanted.edge_length
            });
            let before = dropped.len();
            for chain in short {
                dropped.push(self.carrier.points[chain.vertices[0] as usize]);
                for k in 0..chain.segments.len() {
                    let next = chain.vertices[(k + 1) % chain.vertices.len()];
                    self.tracks.unmark(chain.vertices[k], next);
                }
            }
            if dropped.len() == before {
                break;
            }
        }
        let first = dropped.first()?;
        Some(format!(
            "{} short creases are not followed (less than half a member; the first near {})",
            dropped.len(),
            self.origin.told(*first)
        ))
    }

    /// Gather the feature edges into chains between fixed vertices.
    fn lines(&self, anchors: &[u32], corner_angle: f64) -> Lines {
        let web = Web::new(self);
        let mut is_fixed = vec![false; self.carrier.points.len()];
        for &v in anchors {
            is_fixed[v as usize] = true;
        }
        for &(v, _) in &web.links {
            let joined = web.joined(v);
            let turns = || match joined {
                &[(_, p), (_, q)] => {
                    let into = self.direction(&web, p, v, 1);
                    exceeds(trig::angle(into, self.direction(&web, v, q, 0)), corner_angle)
                }
                _ => true,
            };
            is_fixed[v as usize] |= web.on_boundary[v as usize] || turns();
        }
        let mut seen = vec![false; web.links.len()];
        let mut chains = Vec::new();
        let starts = web.links.iter().map(|l| l.0);
        let ends_first = starts.clone().filter(|&v| is_fixed[v as usize]).chain(starts);
        for start in ends_first {
            // From a fixed vertex every way out, from another any one: it leads round.
            for &(_, next) in web.joined(start) {
                if let Some(vertices) = web.follow(start, next, &is_fixed, &mut seen) {
                    chains.push(self.chain(&web, vertices));
                }
            }
        }
        let fixed = (0..is_fixed.len() as u32).filter(|&v| is_fixed[v as usize]).collect();
        Lines { chains, fixed }
    }

    /// Direction of the feature edge from `a` to `b`, at its beginning (0) or its end (1).
    fn direction(&self, web: &Web, a: u32, b: u32, end: usize) -> DVec3 {
        let chain = Chain {
            vertices: vec![a, b],
            segments: vec![self.segment(web, a, b)],
            ..Chain::default()
        };
        chain.end_tangents(&self.carrier, &self.curves, 0)[end]
    }

    fn segment(&self, web: &Web, a: u32, b: u32) -> Segment {
        let (curve, t0, t1) = self.tracks.curve_of(a, b).unwrap_or((u32::MAX, 0.0, 0.0));
        let (triangle, edge) = web.side(a, b);
        Segment { curve, t: [t0, t1], triangle, edge }
    }

    /// The chain over these vertices, the first one repeated at the end where it is closed.
    fn chain(&self, web: &Web, Path { mut vertices, closed }: Path) -> Chain {
        let segments = vertices.windows(2).map(|w| self.segment(web, w[0], w[1])).collect();
        if closed {
            vertices.pop();
        }
        let mut chain = Chain { vertices, segments, ..Chain::default() };
        chain.measure(&self.carrier);
        chain
    }

    /// Let the carrier know its features.
    fn wall_up(&mut self) {
        let carrier = &self.carrier;
        let wall = |a: u32, b: u32| self.tracks.get(a, b).is_some_and(|track| track.feature);
        let walls = |c: &[u32; 3]| [0, 1, 2].map(|k| wall(c[k], c[(k + 1) % 3]));
        self.carrier.walls = carrier.triangles.iter().map(walls).collect();
    }

    /// Enter the fixed vertices among the corners of the loops, or among those inside.
    fn fix_vertices(&mut self, fixed: &[u32]) {
        let is_fixed = |v: &u32| fixed.binary_search(v).is_ok();
        let mut on_loops = Vec::new();
        for chain in &mut self.loops {
            for (k, v) in chain.vertices.iter().enumerate().filter(|(_, v)| is_fixed(v)) {
                chain.corners.push(k as u32);
                on_loops.push(*v);
            }
            chain.corners.sort_unstable();
            chain.corners.dedup();
        }
        on_loops.sort_unstable();
        let mut inside: Vec<(u32, SurfacePoint)> = Vec::new();
        for (t, corners) in self.carrier.triangles.iter().enumerate() {
            for (k, v) in corners.iter().enumerate().filter(|(_, v)| is_fixed(v)) {
                if on_loops.binary_search(v).is_err() {
                    let mut bary = [0.0; 3];
                    bary[k] = 1.0;
                    inside.push((*v, SurfacePoint { triangle: t as u32, bary }));
                }
            }
        }
        inside.sort_by_key(|f| (f.0, f.1.triangle));
        inside.dedup_by_key(|f| f.0);
        self.fixed = inside.into_iter().map(|f| f.1).collect();
    }

    /// Warnings where features run so near to one another or to the boundary that there is no room for panels,
    /// or are too short for a member.
    fn near_features(&self, length: f64) -> Vec<String> {
        let mut notes = Vec::new();
        let point = |chain: &Chain, s: f64| chain.xyz(&self.carrier, s);
        for chain in self.features.iter().filter(|c| c.length() < SHORT * length) {
            notes.push(format!(
                "a feature is only {:.3} m long between two fixed nodes near {}",
                chain.length(),
                self.origin.told(point(chain, 0.0))
            ));
        }
        let samples = |chain: &Chain| -> Vec<DVec3> {
            let n = (chain.length() / (0.25 * length)).ceil().max(1.0) as usize;
            (0..=n).map(|i| point(chain, chain.length() * i as f64 / n as f64)).collect()
        };
        let features: Vec<Vec<DVec3>> = self.features.iter().map(samples).collect();
        let on_features = Points::of(
            features.iter().enumerate().flat_map(|(i, l)| l.iter().map(move |p| (*p, i))),
        );
        let on_loops = Points::of(self.loops.iter().flat_map(samples).map(|p| (p, 0)));
        let mut fixed: Vec<DVec3> = self.fixed.iter().map(|p| self.carrier.xyz(p)).collect();
        for chain in &self.loops {
            fixed.extend(chain.corners.iter().map(|&k| point(chain, chain.arc[k as usize])));
        }
        let at_fixed = Points::of(fixed.iter().enumerate().map(|(i, p)| (*p, i)));
        for (i, line) in features.iter().enumerate() {
            for p in line.iter().filter(|p| !at_fixed.near(**p, MEETING * length, |_| true)) {
                let what = if on_features.near(*p, NEAR * length, |j| j > i) {
                    "another feature"
                } else if on_loops.near(*p, NEAR * length, |_| true) {
                    "the boundary"
                } else {
                    continue;
                };
                notes.push(format!(
                    "a feature runs closer than half a member to {what} near {}",
                    self.origin.told(*p)
                ));
                break;
            }
        }
        for (i, p) in fixed.iter().enumerate() {
            if at_fixed.near(*p, NEAR * length, |j| j > i) {
                notes.push(format!(
                    "fixed nodes are closer than half a member near {}",
                    self.origin.told(*p)
                ));
            }
        }
        if notes.len() > MOST_TOLD {
            let more = notes.len() - MOST_TOLD;
            notes.truncate(MOST_TOLD);
            notes.push(format!("and {more} more places where features leave too little room"));
        }
        notes
    }
}

/// Numbered points that are asked for near places.
struct Points(RTree<GeomWithData<[f64; 3], usize>>);

impl Points {
    fn of(points: impl Iterator<Item = (DVec3, usize)>) -> Points {
        let points = points.map(|(p, i)| GeomWithData::new(p.to_array(), i));
        Points(RTree::bulk_load(points.collect()))
    }

    /// Whether one whose number is `wanted` is nearer to `p` than `reach`.
    fn near(&self, p: DVec3, reach: f64, wanted: impl Fn(usize) -> bool) -> bool {
        self.0.locate_within_distance(p.to_array(), reach * reach).any(|q| wanted(q.data))
    }
}

/// Features, cut at fixed vertices.
struct Lines {
    chains: Vec<Chain>,
    /// Ascending.
    fixed: Vec<u32>,
}

/// A walk along feature edges.
struct Path {
    vertices: Vec<u32>,
    /// It came back to where it began and nothing is fixed on it.
    closed: bool,
}

/// The feature edges inside, from both ends.
struct Web {
    /// (vertex, joined vertex), sorted.
    links: Vec<(u32, u32)>,
    /// Triangle to the left of each link, and the number of the edge in it.
    sides: Vec<(u32, u8)>,
    on_boundary: Vec<bool>,
}

impl Web {
    fn new(surface: &Surface) -> Web {
        let carrier = &surface.carrier;
        let n = carrier.points.len();
        let (mut on_feature, mut on_boundary) = (vec![false; n], vec![false; n]);
        for (a, b) in surface.tracks.features() {
            on_feature[a as usize] = true;
            on_feature[b as usize] = true;
        }
        let mut found: Vec<((u32, u32), (u32, u8))> = Vec::new();
        for (t, corners) in carrier.triangles.iter().enumerate() {
            for k in 0..3 {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                if carrier.neighbors[t][k] == NONE {
                    on_boundary[a as usize] = true;
                    on_boundary[b as usize] = true;
                } else if on_feature[a as usize]
                    && on_feature[b as usize]
                    && surface.tracks.get(a, b).is_some_and(|track| track.feature)
                {
                    found.push(((a, b), (t as u32, k as u8)));
                }
            }
        }
        found.sort_unstable();
        let (links, sides) = found.into_iter().unzip();
        Web { links, sides, on_boundary }
    }

    /// The links from `v`.
    fn joined(&self, v: u32) -> &[(u32, u32)] {
        let from = self.links.partition_point(|l| l.0 < v);
        let to = self.links.partition_point(|l| l.0 <= v);
        &self.links[from..to]
    }

    fn at(&self, a: u32, b: u32) -> usize {
        self.links.binary_search(&(a, b)).expect("links are kept from both ends")
    }

    fn side(&self, a: u32, b: u32) -> (u32, u8) {
        self.sides[self.at(a, b)]
    }

    /// Walk from `start` by way of `next` to the next fixed vertex, or back; None where that was done before.
    fn follow(&self, start: u32, next: u32, is_fixed: &[bool], seen: &mut [bool]) -> Option<Path> {
        let mut vertices = vec![start];
        let (mut from, mut to) = (start, next);
        loop {
            if std::mem::replace(&mut seen[self.at(from, to)], true) {
                return None;
            }
            seen[self.at(to, from)] = true;
            vertices.push(to);
            if is_fixed[to as usize] || to == start {
                return Some(Path { vertices, closed: !is_fixed[to as usize] });
            }
            let onward = self.joined(to).iter().find(|l| l.1 != from)?;
            (from, to) = (to, onward.1);
        }
    }
}
