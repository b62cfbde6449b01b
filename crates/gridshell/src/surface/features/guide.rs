//! Guides: polylines given by the designer, cut into the carrier so that they are chains of its edges.
//!
//! A guide is walked over the carrier from one of its points to the next, from vertex to vertex: across the
//! triangle ahead to the edge where the guide leaves it, which is split there. On patches every place on a guide
//! is the foot of the guide's own point, so nodes on it are exact.

use super::cut::{Cutter, SAME};
use crate::error::{Error, Result};
use crate::surface::Curve;
use crate::surface::carrier::NONE;
use crate::surface::carrier::locate::nearest_in_triangle;
use crate::surface::carrier::track::Track;
use glam::DVec3;

/// A crossing this near to an end of an edge, in shares of it, moves that end, where it may.
const AT_END: f64 = 0.2;
/// Farther off the surface than this, over l0, is worth a word.
const OFF: f64 = 1e-3;
/// Edges crossed by one guide at most: far more than a carrier has in a row.
const MOST_CROSSINGS: usize = 1_000_000;
/// Secant steps to where a guide crosses an edge.
const SECANT_STEPS: usize = 6;

/// From one point of a guide to the next.
#[derive(Clone, Copy)]
struct Line {
    p: DVec3,
    q: DVec3,
    /// The guide ends with it.
    is_last: bool,
}

/// A place on the way along a guide.
#[derive(Clone, Copy)]
struct Foot {
    vertex: u32,
    /// The guide's own point whose foot the vertex is.
    aim: DVec3,
}

impl Cutter<'_> {
    /// Cut guide `i` into the carrier and mark it as a feature; gives what is to be said of it.
    ///
    /// # Errors
    /// [`Error::Surface`] with coordinates where it leaves the surface by more than a member or is shorter than
    /// one.
    pub(super) fn cut_guide(&mut self, i: usize, points: &[DVec3]) -> Result<Vec<String>> {
        let origin = self.surface.origin;
        let at = |p: DVec3| origin.told(p);
        let fault = |p: DVec3, what: String| {
            Err(Error::Surface(format!("guide {} {what} near {}", i + 1, at(p))))
        };
        let Some(&first) = points.first() else { return Ok(Vec::new()) };
        let length: f64 = points.windows(2).map(|w| w[0].distance(w[1])).sum();
        if length < self.length {
            let what = format!(
                "is only {length:.3} m long, shorter than a member of {:.3} m,",
                self.length
            );
            return fault(first, what);
        }
        let mut notes = Vec::new();
        let mut worst = (0.0, first);
        let mut here = Foot { vertex: self.put(first), aim: first };
        for (k, w) in points.windows(2).enumerate() {
            let off = self.xyz(here.vertex).distance(w[0]);
            if off > worst.0 {
                worst = (off, w[0]);
            }
            if off > self.length {
                return fault(w[0], format!("is {off:.3} m off the surface"));
            }
            let line = Line { p: w[0], q: w[1], is_last: k + 2 == points.len() };
            here = self.cut_line(here, line)?;
            if self.is_outside(here.vertex, w[1]) {
                // It met the boundary; the rest is outside.
                let end = self.xyz(here.vertex);
                let rest: f64 = end.distance(w[1])
                    + points[k + 1..].windows(2).map(|w| w[0].distance(w[1])).sum::<f64>();
                if rest > self.length {
                    return fault(end, format!("leaves the surface, with {rest:.3} m to go,"));
                }
                if rest > OFF * self.length {
                    notes.push(format!(
                        "guide {} ends at the boundary near {}, {rest:.3} m short",
                        i + 1,
                        at(end)
                    ));
                }
                return Ok(notes);
            }
        }
        let last = points[points.len() - 1];
        let off = self.xyz(here.vertex).distance(last);
        if off > self.length {
            return fault(last, format!("is {off:.3} m off the surface"));
        }
        worst = if off > worst.0 { (off, last) } else { worst };
        if worst.0 > OFF * self.length {
            notes.push(format!(
                "guide {} is up to {:.3} m off the surface (near {}) and was projected to it",
                i + 1,
                worst.0,
                at(worst.1)
            ));
        }
        Ok(notes)
    }

    /// Whether `q` lies beyond the boundary that was met at `v`.
    fn is_outside(&self, v: u32, q: DVec3) -> bool {
        let on_boundary = self
            .fan(v)
            .iter()
            .any(|&(t, _)| self.surface.carrier.neighbors[t as usize].contains(&NONE));
        let normal: DVec3 =
            self.fan(v).iter().map(|&(t, _)| self.surface.carrier.face_normal(t)).sum();
        let off = q - self.xyz(v);
        let aside = off - normal.normalize_or_zero() * off.dot(normal.normalize_or_zero());
        on_boundary && aside.length() > SAME * self.length && self.way(v, q).is_none()
    }

    /// Cut a line on which the walk stands at `here`; gives where it ends, which is on the boundary where
    /// it leads out.
    fn cut_line(&mut self, mut here: Foot, line: Line) -> Result<Foot> {
        let Line { p, q, is_last } = line;
        self.tie(here.vertex);
        for _ in 0..MOST_CROSSINGS {
            if self.xyz(here.vertex).distance(q) <= SAME * self.length {
                return Ok(here);
            }
            let Some(way) = self.way(here.vertex, q) else { return Ok(here) };
            let next = if way.share >= 1.0 {
                let spot = self.spot(way.triangle, way.bary_of(q, self), q);
                let vertex = if is_last { self.insert_end(&spot) } else { self.insert(&spot) };
                Foot { vertex, aim: q }
            } else {
                self.cross(&way, p, q)
            };
            if next.vertex == here.vertex {
                // The line's end is nearer to this vertex than points are told apart.
                return Ok(here);
            }
            self.tie(next.vertex);
            self.mark(here, next);
            if way.share >= 1.0 && !self.leads_on(next.vertex, q) {
                return Ok(next);
            }
            here = next;
        }
        Err(Error::Surface(format!(
            "a guide does not come to an end near {}",
            self.surface.origin.told(q)
        )))
    }

    /// Whether the surface, having turned at `v` (a crease), leads on from there much nearer to `q`.
    fn leads_on(&self, v: u32, q: DVec3) -> bool {
        const NEARER: f64 = 0.9;
        let off = self.xyz(v).distance(q);
        if off <= OFF * self.length {
            return false;
        }
        self.way(v, q).is_some_and(|way| {
            let c = self.surface.carrier.corners(way.triangle);
            let b = nearest_in_triangle(c, q);
            (c[0] * b[0] + c[1] * b[1] + c[2] * b[2]).distance(q) < NEARER * off
        })
    }

    /// The triangle at `v` that lies towards `q`; None where that is outside.
    fn way(&self, v: u32, q: DVec3) -> Option<Way> {
        // Along an edge, either triangle beside it will do.
        const SLACK: f64 = 1e-7;
        const ABOVE: f64 = 1e-9;
        let carrier = &self.surface.carrier;
        let from = self.xyz(v);
        let mut best: Option<(f64, Way)> = None;
        for (t, k) in self.fan(v) {
            let edge = (k + 1) % 3;
            let c = carrier.corners(t);
            let (a, b) = (c[edge], c[(edge + 1) % 3]);
            let inwards = carrier.face_normal(t).cross(b - a);
            let (here, there) = ((from - a).dot(inwards), (q - a).dot(inwards));
            // As good as straight above: the triangle leads nowhere.
            if here - there <= ABOVE * inwards.length() * self.length {
                continue;
            }
            let share = here / (here - there);
            let crossing = from.lerp(q, share);
            let f = (crossing - a).dot(b - a) / (b - a).length_squared();
            let margin = f.min(1.0 - f);
            if margin >= -SLACK && best.as_ref().is_none_or(|(m, _)| margin > *m) {
                best = Some((margin, Way { triangle: t, edge, share, f }));
            }
        }
        best.map(|b| b.1)
    }

    /// Go on to where the line from `p` to `q` leaves the triangle ahead.
    fn cross(&mut self, way: &Way, p: DVec3, q: DVec3) -> Foot {
        let (t, k) = (way.triangle, way.edge);
        let corners = self.surface.carrier.triangles[t as usize];
        let (a, b) = (corners[k], corners[(k + 1) % 3]);
        let (f, aim) = self.crossing(way, p, q);
        let whole = self.xyz(a).distance(self.xyz(b));
        for (v, from_end) in [(a, f), (b, 1.0 - f)] {
            if from_end * whole <= SAME * self.length {
                return Foot { vertex: v, aim: self.xyz(v) };
            }
            if from_end < AT_END && !self.is_tied(v) {
                let x = self.xyz(v);
                let along = (x - p).dot(q - p) / (q - p).length_squared();
                let aim = p.lerp(q, along.clamp(0.0, 1.0));
                let mut bary = [0.0; 3];
                bary[if v == a { k } else { (k + 1) % 3 }] = 1.0;
                let spot = self.spot(t, bary, aim);
                if self.move_vertex(v, &spot) {
                    return Foot { vertex: v, aim };
                }
            }
        }
        let on_line = self.surface.tracks.get(a, b).is_some()
            || self.surface.carrier.neighbors[t as usize][k] == NONE;
        if on_line {
            let vertex = self.put_on_line(t, k, aim);
            return Foot { vertex, aim: self.xyz(vertex) };
        }
        let mut bary = [0.0; 3];
        bary[k] = 1.0 - f;
        bary[(k + 1) % 3] = f;
        let spot = self.spot(t, bary, aim);
        Foot { vertex: self.split_edge(t, k, f, spot.xyz), aim }
    }

    /// Where the edge ahead is crossed: the share of it, and the guide's point above. On a patch the guide's foot
    /// counts, on a mesh the straight line from here to the guide's next point.
    fn crossing(&self, way: &Way, p: DVec3, q: DVec3) -> (f64, DVec3) {
        let carrier = &self.surface.carrier;
        let c = carrier.corners(way.triangle);
        let k = way.edge;
        let (a, b) = (c[k], c[(k + 1) % 3]);
        let inwards = carrier.face_normal(way.triangle).cross(b - a).normalize_or_zero();
        let from = c[(k + 2) % 3];
        let straight = from.lerp(q, way.share);
        if self.is_mesh() {
            return (way.f.clamp(0.0, 1.0), straight);
        }
        let mut bary = [0.0; 3];
        let f = way.f.clamp(0.0, 1.0);
        bary[k] = 1.0 - f;
        bary[(k + 1) % 3] = f;
        let along = |x: DVec3| (x - p).dot(q - p) / (q - p).length_squared();
        let foot = |s: f64| self.spot(way.triangle, bary, p.lerp(q, s)).xyz;
        let beyond = |s: f64| (foot(s) - a).dot(inwards);
        let start = along(from).max(0.0);
        let (mut s0, mut s1) = (start, along(straight).clamp(0.0, 1.0));
        let (mut g0, mut g1) = (beyond(s0), beyond(s1));
        for _ in 0..SECANT_STEPS {
            if g0 == g1 || g1.abs() < 1e-12 * self.length {
                break;
            }
            let s = (s1 - g1 * (s1 - s0) / (g1 - g0)).clamp(start, 1.0);
            (s0, g0) = (s1, g1);
            (s1, g1) = (s, beyond(s));
        }
        let f = (foot(s1) - a).dot(b - a) / (b - a).length_squared();
        (f.clamp(0.0, 1.0), p.lerp(q, s1))
    }

    /// Mark the edge between two places on a guide as a feature.
    fn mark(&mut self, from: Foot, to: Foot) {
        let carrier = &self.surface.carrier;
        let (a, b) = (from.vertex, to.vertex);
        let ends = |&(t, k): &(u32, usize)| {
            let corners = carrier.triangles[t as usize];
            [1, 2].into_iter().find(|&j| corners[(k + j) % 3] == b).map(|j| (t, k, (k + j) % 3))
        };
        let Some((t, k, other)) = self.fan(a).iter().find_map(ends) else { return };
        let known = self.surface.tracks.curve_of(a, b).is_some();
        let track = match self.shape(t).filter(|_| !known) {
            Some(shape) => {
                let uv = carrier.uv[t as usize];
                let curve = Curve::Guide {
                    shape: shape.clone(),
                    line: [from.aim, to.aim],
                    near: [uv[k], uv[other]],
                };
                self.surface.curves.push(curve);
                let curve = self.surface.curves.len() as u32 - 1;
                Track { curve, t: [0.0, 1.0], feature: true }
            }
            None => Track::of_mesh(),
        };
        self.surface.tracks.lay(a, b, track);
    }
}

/// The way ahead from a vertex: a triangle at it, and its edge opposite.
#[derive(Clone, Copy)]
struct Way {
    triangle: u32,
    edge: usize,
    /// The edge is reached at this share of the way to the target.
    share: f64,
    /// Where on the edge.
    f: f64,
}

impl Way {
    /// Shares of the triangle's corners at the point below `q`.
    fn bary_of(&self, q: DVec3, cutter: &Cutter) -> [f64; 3] {
        nearest_in_triangle(cutter.surface.carrier.corners(self.triangle), q)
    }
}
