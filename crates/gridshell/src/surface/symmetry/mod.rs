//! The symmetries of a surface: turns about a vertical axis and mirrorings at vertical planes through it; and its part
//! between two vertical planes, as a surface of its own.
//!
//! A symmetry is believed when the images of the carrier's vertices lie on the surface and those of its loops'
//! on the loops. Of a mesh, whose facets are seldom symmetric, they may also lie where the smooth surface that it stands
//! for may be (`bow`). Where the axis or plane lies is not guessed from the carrier, which is not symmetric itself,
//! but fitted to the exact surface.

mod bow;
mod motion;
pub mod wedge;

pub use motion::Motion;
pub use wedge::{Part, Wedge};

use super::{Chain, Locator, Surface};
use crate::job::Job;
use crate::math::trig;
use bow::Bows;
use glam::{DVec2, DVec3};
use motion::unit;
use rayon::prelude::*;

/// Most turns that are looked for.
pub const MOST_TURNS: u32 = 12;
/// Turns of a surface of revolution: they suit the six members of a node on the axis.
const REVOLUTION: u32 = 6;
/// Steps of fitting an axis or plane.
const FIT_STEPS: usize = 8;
/// Points of the surface, and of its loops, that it is fitted to.
const FIT_POINTS: usize = 300;
/// Points of the surface that are looked at before a symmetry is believed.
const CHECK_POINTS: usize = 20_000;

/// A cut that leaves the border at less than the angle of this sine (53 degrees) leaves corners that no good triangle
/// fits into, and is made elsewhere if it can; beyond, the farthest corner is as good as any.
const BLUNT: f64 = 0.8;
/// Sines that differ by less are of corners that are alike.
const ALIKE: f64 = 1e-3;

/// What polls are counted under.
const PHASE: &str = "looking for symmetries";

/// Turns and mirrorings under which a surface, or a grid, stays the same.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Group {
    /// The vertical axis, or a point on the mirror plane.
    pub centre: DVec2,
    /// The turn by a full turn over this number is among them; 1 for none.
    pub turns: u32,
    /// Direction in plan of a mirror plane.
    pub mirror: Option<DVec2>,
}

/// Where an image lies farthest from the surface.
#[derive(Clone, Copy, Debug)]
pub struct Miss {
    /// How far, metres.
    pub distance: f64,
    /// The point whose image it is.
    pub point: DVec3,
    /// The image.
    pub image: DVec3,
}

impl Group {
    /// All motions, the one that moves nothing first, then the other turns, then the mirrorings.
    pub fn motions(&self) -> Vec<Motion> {
        let turns = (0..self.turns).map(|k| Motion::turn(self.centre, k, self.turns));
        let mut motions: Vec<Motion> = turns.collect();
        if let Some(along) = self.mirror {
            let mirror = Motion::mirroring(self.centre, along);
            let mirrored: Vec<_> = motions.iter().map(|turn| turn.after(&mirror)).collect();
            motions.extend(mirrored);
        }
        motions
    }

    /// Number of motions.
    pub fn order(&self) -> usize {
        self.turns as usize * if self.mirror.is_some() { 2 } else { 1 }
    }

    /// Directions in plan of all mirror planes.
    pub fn mirrors(&self) -> Vec<DVec2> {
        let Some(along) = self.mirror else { return Vec::new() };
        (0..self.turns).map(|k| turned(along, k, 2 * self.turns)).collect()
    }
}

/// `v` turned by `k` parts of `n` of a full turn.
pub(super) fn turned(v: DVec2, k: u32, n: u32) -> DVec2 {
    unit(k, n).rotate(v)
}

/// Looks for symmetries of one surface.
pub struct Symmetries<'a> {
    surface: &'a Surface,
    locator: Locator<'a>,
    /// Farther off than this, metres, an image is not on the surface.
    tolerance: f64,
    /// Or by so much more.
    bows: Bows,
    centroid: DVec2,
    /// Direction in plan in which the surface is longest.
    longest: DVec2,
    /// Once it is over, answers are of no use: the caller is to check.
    job: &'a Job,
}

impl<'a> Symmetries<'a> {
    /// For images that may be off the surface by `tolerance` metres.
    pub fn new(surface: &'a Surface, tolerance: f64, job: &'a Job) -> Symmetries<'a> {
        let carrier = &surface.carrier;
        let faces = (0..carrier.triangles.len() as u32).map(|t| {
            let middle = carrier.corners(t).iter().sum::<DVec3>() / 3.0;
            (carrier.triangle_area(t), middle.truncate())
        });
        let faces: Vec<(f64, DVec2)> = faces.collect();
        let area: f64 = faces.iter().map(|f| f.0).sum();
        let centroid = faces.iter().map(|&(a, p)| p * a).sum::<DVec2>() / area;
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for &(a, p) in &faces {
            let d = p - centroid;
            xx += a * d.x * d.x;
            xy += a * d.x * d.y;
            yy += a * d.y * d.y;
        }
        let angle = 0.5 * trig::atan2(2.0 * xy, xx - yy);
        let longest = DVec2::new(trig::cos(angle), trig::sin(angle));
        let (locator, bows) = (Locator::new(surface), Bows::default());
        Symmetries { surface, locator, tolerance, bows, centroid, longest, job }
    }

    /// For a mesh as it is in its file: images may also be off by what the smooth surface is from its facets, where
    /// these turn by less than `crease_angle`, and by less than `corner_angle` along the boundary; by `most` metres.
    pub fn of_facets(
        facets: &'a Surface,
        tolerance: f64,
        [crease_angle, corner_angle]: [f64; 2],
        most: f64,
        job: &'a Job,
    ) -> Symmetries<'a> {
        let bows = Bows::of(facets, crease_angle, corner_angle, most);
        Symmetries { bows, ..Symmetries::new(facets, tolerance, job) }
    }

    /// How far the smooth surface may be off facets, metres; 0 where images are to lie on the surface itself.
    pub fn bow(&self) -> f64 {
        self.bows.largest()
    }

    /// The mirroring at the vertical plane along the unit vector `along`.
    ///
    /// # Errors
    /// Where its images miss the surface.
    pub fn mirror(&self, along: DVec2) -> Result<Group, Miss> {
        let across = along.perp();
        let at = |s: &[f64]| Motion::mirroring(self.centroid + across * s[0], along);
        let s = self.fit(&at, vec![0.0]);
        self.verify(&at(&s))?;
        Ok(Group { centre: self.centroid + across * s[0], turns: 1, mirror: Some(along) })
    }

    /// The mirrorings at the planes along x and along y.
    ///
    /// # Errors
    /// Where images miss the surface.
    pub fn both_mirrors(&self) -> Result<Group, Miss> {
        let (x, y) = (self.mirror(DVec2::Y)?, self.mirror(DVec2::X)?);
        let centre = DVec2::new(x.centre.x, y.centre.y);
        Ok(Group { centre, turns: 2, mirror: Some(DVec2::X) })
    }

    /// The turns by a full turn over `turns`, with mirrorings where they are symmetries and suit a grid.
    ///
    /// # Errors
    /// Where images miss the surface.
    pub fn turns(&self, turns: u32) -> Result<Group, Miss> {
        let at = |c: &[f64]| Motion::turn(DVec2::new(c[0], c[1]), 1, turns);
        let c = self.fit(&at, self.centroid.to_array().to_vec());
        self.verify(&at(&c))?;
        let centre = DVec2::new(c[0], c[1]);
        let mirror = self.mirrors_at(centre, turns);
        // On the axis a mirrored grid has twice as many members as there are turns, or four times.
        let suits = turns == 3 || !self.meets_axis(centre);
        Ok(Group { centre, turns, mirror: mirror.filter(|_| suits) })
    }

    /// The largest group; None where there is no symmetry.
    pub fn largest(&self) -> Option<Group> {
        let round = |n: u32| self.turns(n).ok();
        let most = (2..=MOST_TURNS).rev().find_map(round);
        match most {
            Some(group) if group.turns == MOST_TURNS && round(MOST_TURNS - 1).is_some() => {
                round(REVOLUTION)
            }
            Some(group) if group.turns == 2 => {
                let along = self.mirrors_at(group.centre, 2);
                Some(along.map_or(group, |along| Group { mirror: Some(along), ..group }))
            }
            Some(group) => Some(group),
            None => {
                let axes = [DVec2::Y, DVec2::X, self.longest, self.longest.perp()];
                axes.into_iter().find_map(|along| self.mirror(along).ok())
            }
        }
    }

    /// Direction of the cut that parts a surface into `group.turns` alike: through the farthest corner, or another
    /// where that is a sharp one, or along a mirror plane, or across the longest direction.
    pub fn cut(&self, group: &Group) -> DVec2 {
        if let Some(along) = group.mirror {
            return along;
        }
        let corner = self.blunt_corner(group.centre).filter(|_| group.turns > 2);
        corner.or_else(|| self.mirrors_at(group.centre, group.turns)).unwrap_or(self.longest.perp())
    }

    /// Direction of the first plane through `centre` found that mirrors a surface of so many turns.
    fn mirrors_at(&self, centre: DVec2, turns: u32) -> Option<DVec2> {
        let mut axes = vec![DVec2::X, DVec2::Y];
        if let Some(corner) = self.farthest_corner(centre) {
            axes.push(corner);
        }
        axes.push(self.longest);
        for k in 1..turns.min(3) {
            axes.push(turned(self.longest, k, 4 * turns));
        }
        axes.into_iter().find(|&along| self.verify(&Motion::mirroring(centre, along)).is_ok())
    }

    /// Direction of the corner of a loop that is farthest from the axis.
    fn farthest_corner(&self, centre: DVec2) -> Option<DVec2> {
        let off = self.corners(centre);
        off.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))?.try_normalize()
    }

    /// Direction of the farthest corner, or, where the border there is too sharp for a cut, of the corner where the cut
    /// meets the border the most squarely.
    fn blunt_corner(&self, centre: DVec2) -> Option<DVec2> {
        let farthest = self.farthest_corner(centre)?;
        let of_farthest = self.squareness(centre, farthest);
        if of_farthest >= BLUNT {
            return Some(farthest);
        }
        let others = self.corners(centre).filter_map(DVec2::try_normalize);
        let first = (of_farthest, farthest);
        let best = others.map(|along| (self.squareness(centre, along), along)).fold(
            first,
            // Of corners that are alike but for rounding the first.
            |best, other| if other.0 > best.0 + ALIKE { other } else { best },
        );
        Some(best.1)
    }

    /// Corners of all loops, seen from the axis in plan.
    fn corners(&self, centre: DVec2) -> impl Iterator<Item = DVec2> + '_ {
        let points = &self.surface.carrier.points;
        let of_loop =
            |l: &'_ Chain| l.corners.iter().map(|&k| l.vertices[k as usize]).collect::<Vec<_>>();
        let all = self.surface.loops.iter().flat_map(of_loop);
        all.map(move |v| points[v as usize].truncate() - centre)
    }

    /// The sine of the sharpest angle, in plan, between a ray from the axis and the border where they meet.
    fn squareness(&self, centre: DVec2, along: DVec2) -> f64 {
        let points = &self.surface.carrier.points;
        let mut least = 1.0_f64;
        for l in &self.surface.loops {
            let n = l.vertices.len();
            for k in 0..n {
                let [a, b] =
                    [k, (k + 1) % n].map(|k| points[l.vertices[k] as usize].truncate() - centre);
                let off = [along.perp_dot(a), along.perp_dot(b)];
                let meets = off[0] * off[1] <= 0.0 || off.iter().any(|o| o.abs() <= self.tolerance);
                if meets && along.dot(a + b) > 0.0 && a.distance(b) > 0.0 {
                    least = least.min((off[1] - off[0]).abs() / a.distance(b));
                }
            }
        }
        least
    }

    /// Whether the vertical axis through `centre` meets the surface.
    fn meets_axis(&self, centre: DVec2) -> bool {
        let carrier = &self.surface.carrier;
        (0..carrier.triangles.len() as u32).any(|t| holds(carrier.corners(t), centre).is_some())
    }

    /// Refuse a motion that is no symmetry.
    ///
    /// # Errors
    /// Where its images lie farthest from the surface.
    pub fn verify(&self, motion: &Motion) -> Result<(), Miss> {
        // Most that are none are seen to be none at once.
        for count in [100, CHECK_POINTS] {
            let miss = self.worst(motion, count);
            let Some((excess, miss)) = miss else { continue };
            if excess > self.tolerance {
                return Err(self.worst(motion, CHECK_POINTS).map_or(miss, |worst| worst.1));
            }
        }
        Ok(())
    }

    /// The image that lies farthest from the surface, over about `count` points, and by how much more than facets may.
    fn worst(&self, motion: &Motion, count: usize) -> Option<(f64, Miss)> {
        let mut samples = self.inside(count);
        samples.extend(self.on_loops(count));
        let misses: Vec<(f64, Miss)> = samples
            .par_iter()
            .take_any_while(|_| !self.job.is_over(PHASE))
            .map(|sample| {
                let image = motion.image(sample.point);
                let (foot, _, bow) = self.foot(sample, image);
                let distance = foot.distance(image);
                (distance - bow, Miss { distance, point: sample.point, image })
            })
            .collect();
        misses.into_iter().rev().max_by(|a, b| a.0.total_cmp(&b.0))
    }

    fn inside(&self, count: usize) -> Vec<Sample> {
        let points = &self.surface.carrier.points;
        let step = points.len().div_ceil(count).max(1);
        points.iter().step_by(step).map(|&point| Sample { point, on_loop: false }).collect()
    }

    fn on_loops(&self, count: usize) -> Vec<Sample> {
        let all: Vec<u32> = self.surface.loops.iter().flat_map(|l| l.vertices.clone()).collect();
        let step = all.len().div_ceil(count).max(1);
        let point = |&v: &u32| self.surface.carrier.points[v as usize];
        all.iter().step_by(step).map(|v| Sample { point: point(v), on_loop: true }).collect()
    }

    /// The point of the surface, or of its loops, nearest to the image of a sample, its normal or tangent, and how far the
    /// smooth surface may be from there.
    fn foot(&self, sample: &Sample, image: DVec3) -> (DVec3, DVec3, f64) {
        let surface = self.surface;
        if !sample.on_loop {
            let place = self.locator.nearest(image).expect("a surface has triangles");
            let bow = self.bows.of_triangle(place.triangle);
            return (surface.foot(&place, image), surface.carrier.normal(&place), bow);
        }
        let place = self.locator.nearest_on_loops(image).expect("a sample of a loop");
        let chain = &surface.loops[place.chain as usize];
        let bow = self.bows.of_segment(place.chain, chain.locate(place.s).0);
        (chain.foot(surface, place.s, image), chain.tangent(&surface.carrier, place.s), bow)
    }

    /// The parameters of the motion that bring images nearest to the surface: Gauss-Newton.
    fn fit(&self, family: &dyn Fn(&[f64]) -> Motion, mut at: Vec<f64>) -> Vec<f64> {
        let mut samples = self.inside(FIT_POINTS);
        samples.extend(self.on_loops(FIT_POINTS));
        for _ in 0..FIT_STEPS {
            let step = self.step(family, &at, &samples);
            for (x, d) in at.iter_mut().zip(step) {
                *x += d;
            }
            if step.iter().all(|d| d.abs() < 1e-14 * self.tolerance.max(1.0)) {
                break;
            }
        }
        at
    }

    /// One step for one or two parameters.
    fn step(&self, family: &dyn Fn(&[f64]) -> Motion, at: &[f64], samples: &[Sample]) -> [f64; 2] {
        let motion = family(at);
        // Images depend linearly on an offset.
        let ahead: Vec<Motion> = (0..at.len())
            .map(|k| {
                let mut moved = at.to_vec();
                moved[k] += 1.0;
                family(&moved)
            })
            .collect();
        let (mut a, mut b) = ([[0.0; 2]; 2], [0.0; 2]);
        for sample in samples {
            if self.job.is_over(PHASE) {
                break;
            }
            let image = motion.image(sample.point);
            let (foot, axis, _) = self.foot(sample, image);
            let along = |v: DVec3| axis * v.dot(axis);
            // Off the surface along its normal, off a loop perpendicular to its tangent.
            let counts = |v: DVec3| if sample.on_loop { v - along(v) } else { along(v) };
            let miss = counts(foot - image);
            let slopes: Vec<DVec3> =
                ahead.iter().map(|m| counts(m.image(sample.point) - image)).collect();
            for (i, s) in slopes.iter().enumerate() {
                b[i] += s.dot(miss);
                for (j, t) in slopes.iter().enumerate() {
                    a[i][j] += s.dot(*t);
                }
            }
        }
        let least = 1e-9 * (a[0][0] + a[1][1]) + f64::MIN_POSITIVE;
        let (p, q, r) = (a[0][0] + least, a[0][1], a[1][1] + least);
        let det = p * r - q * q;
        [(b[0] * r - b[1] * q) / det, (b[1] * p - b[0] * q) / det]
    }
}

/// A point whose image is looked at.
struct Sample {
    point: DVec3,
    on_loop: bool,
}

/// The shares of a triangle's corners at the point above or below `p`, where it has one.
pub(super) fn holds(corners: [DVec3; 3], p: DVec2) -> Option<[f64; 3]> {
    let c = corners.map(|c| c.truncate() - p);
    let shares = [0, 1, 2].map(|k| c[(k + 1) % 3].perp_dot(c[(k + 2) % 3]));
    let sum: f64 = shares.iter().sum();
    let shares = shares.map(|s| s / sum);
    let inside = sum != 0.0 && shares.iter().all(|&s| s >= -1e-9);
    inside.then_some(shares.map(|s| s.max(0.0)))
}
