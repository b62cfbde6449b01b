//! The merit of a grid: its fluency Q, held back by what spoils a grid that has a fine Q.
//!
//! Everything that merit needs is a sum over nodes, members and panels, so the change made by an edit is the
//! sums round it afterwards less those before.

use crate::degree::{REGULAR, adjusted_degree, weight};
use crate::grid::Grid;
use crate::math::trig;
use crate::surface::Surface;
use glam::DVec3;
use std::f64::consts::PI;
use std::ops::{Add, Sub};

/// Below this, the denominator of Q (Eq. 31) is rounding and the grid a perfect lattice.
pub const PERFECT: f64 = 1e-9;

/// Sums over (a part of) a grid. Lengths over the wanted one, angles in radians.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sums {
    /// n* of Eq. 26.
    pub weighted: f64,
    /// R of Eq. 14.
    pub residual: f64,
    /// Regular interior nodes, and their angle fluency indices (Eq. 29).
    pub regular: f64,
    /// See `regular`.
    pub delta: f64,
    /// All members.
    pub members: Lengths,
    /// The members that touch the boundary.
    pub border_members: Lengths,
    /// All panels, and their shapes q (Eq. 25).
    pub panels: f64,
    /// See `panels`.
    pub shape: f64,
    /// The panels that touch the boundary, and their shapes.
    pub border_panels: f64,
    /// See `border_panels`.
    pub border_shape: f64,
    /// Area of the panels over that of the surface.
    pub area: f64,
    /// Nodes inside where a direction is wanted, and how far their members are off it.
    pub guided: f64,
    /// See `guided`.
    pub astray: f64,
    /// How far members and panels are beyond what is wanted of each.
    pub excess: f64,
}

/// Sums of lengths.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lengths {
    /// How many.
    pub count: f64,
    /// Their sum.
    pub sum: f64,
    /// The sum of their squares.
    pub squares: f64,
}

/// Members shorter or longer than this, over the wanted length, are beyond what is wanted.
const MEMBERS: [f64; 2] = [0.64, 1.42];
/// Members shorter than this, over l0, are hardly ever worth it.
const LEAST: f64 = 0.61;
/// Panels of a lower shape q are beyond what is wanted.
const SHAPE: f64 = 0.68;

/// What holds a grid's merit back. Weights say how much of Q is given up for a unit of what is beyond a limit: with a
/// weight of 8, merit falls to a half where a spread is 0.125 beyond.
struct Guards {
    /// Length spread r that is free for members inside, and for those at the border, which cannot be as even: the limit
    /// for a grid lies between, by how many it has of each. Tighter ones give calm lengths for restless lines.
    spread_inside: f64,
    /// See `spread_inside`.
    spread_border: f64,
    /// Of the length spread r: against Q, as lines straighten where lengths may differ.
    spread_weight: f64,
    /// Length spread r of the members at the border: an architect sees the border first, but a row that fits it tightly
    /// costs irregular nodes inside.
    border_spread: Guard,
    /// Mean shape q of the panels at the border: ragged panels there against irregular nodes inside.
    border_shape: Guard,
    /// Mean shape q that is free for panels inside, and at the border: as for lengths.
    shape_inside: f64,
    /// See `shape_inside`.
    shape_border: f64,
    /// Of the mean shape q: panels near to equilateral against lines that flow round corners.
    shape_weight: f64,
    /// Mean length off the wanted one, over it: without it, grids grow coarser, as fewer nodes have fewer irregular ones.
    mean_length: Guard,
    /// Area of the panels over that of the surface: without it, grids cut across what bends.
    area: Guard,
    /// Mean angle off a wanted direction, radians: what the designer asks for against what flows by itself.
    direction: Guard,
    /// Of single members and panels beyond what is wanted of each: the worst place against the mean.
    excess_weight: f64,
}

/// A limit, and what each unit beyond it weighs.
struct Guard {
    limit: f64,
    weight: f64,
}

impl Guard {
    fn above(&self, x: f64) -> f64 {
        self.weight * over(x, self.limit)
    }

    fn below(&self, x: f64) -> f64 {
        self.weight * over(self.limit, x)
    }
}

/// Found by trials on the six cases of `docs/quality.md`.
const GUARDS: Guards = Guards {
    spread_inside: 0.04,
    spread_border: 0.13,
    spread_weight: 8.0,
    border_spread: Guard { limit: 0.12, weight: 6.0 },
    border_shape: Guard { limit: 0.958, weight: 3.0 },
    shape_inside: 0.992,
    shape_border: 0.965,
    shape_weight: 8.0,
    mean_length: Guard { limit: 0.01, weight: 10.0 },
    area: Guard { limit: 0.988, weight: 60.0 },
    direction: Guard { limit: 0.03, weight: 20.0 },
    excess_weight: 8.0,
};

impl Lengths {
    fn count(&mut self, length: f64) {
        self.count += 1.0;
        self.sum += length;
        self.squares += length * length;
    }

    /// Their mean.
    pub fn mean(&self) -> f64 {
        self.sum / self.count.max(1.0)
    }

    /// Their coefficient of variation (Eq. 24).
    pub fn cv(&self) -> f64 {
        let variance = self.squares / self.count.max(1.0) - self.mean() * self.mean();
        variance.max(0.0).sqrt() / self.mean().max(f64::MIN_POSITIVE)
    }
}

impl Sums {
    /// The sums over a whole grid.
    pub fn whole(grid: &Grid, surface: &Surface, length: f64, lambda: f64) -> Sums {
        let all: Vec<u32> = grid.mesh.vertices().collect();
        Sums::over(grid, surface, length, lambda, &all, |_| true, |v| delta(grid, v))
    }

    /// The sums over these nodes and the members and panels at them, for members of `length` metres. `inside`
    /// says whether a node is one of them, `delta` gives the angle fluency index of a regular one inside.
    pub fn over(
        grid: &Grid,
        surface: &Surface,
        length: f64,
        lambda: f64,
        nodes: &[u32],
        inside: impl Fn(u32) -> bool,
        mut delta: impl FnMut(u32) -> f64,
    ) -> Sums {
        let mesh = &grid.mesh;
        let mut sums = Sums::default();
        for &v in nodes {
            let gamma = weight(mesh, v, lambda);
            let off = adjusted_degree(mesh, &grid.xyz, v) - REGULAR;
            sums.weighted += gamma;
            sums.residual += gamma * f64::from(off * off);
            let at_border = mesh.is_boundary(v);
            if !at_border && off == 0 {
                sums.regular += 1.0;
                sums.delta += delta(v);
            }
            if !at_border && let Some(off) = off_direction(grid, surface, v) {
                sums.guided += 1.0;
                sums.astray += off;
            }
            // A member or panel is counted by the least of its nodes that is inside.
            for &w in mesh.ring(v).iter().filter(|&&w| w > v || !inside(w)) {
                sums.member(
                    grid.scaled_length(surface, v, w) / length,
                    at_border || mesh.is_boundary(w),
                );
            }
            for (a, b) in mesh.fan(v) {
                if [a, b].iter().all(|&w| w > v || !inside(w)) {
                    let at_border = at_border || mesh.is_boundary(a) || mesh.is_boundary(b);
                    sums.panel(grid, surface, [v, a, b], at_border);
                }
            }
        }
        sums.area /= surface.area;
        sums
    }

    fn member(&mut self, length: f64, at_border: bool) {
        self.members.count(length);
        if at_border {
            self.border_members.count(length);
        }
        let beyond = (MEMBERS[0] - length).max(length - MEMBERS[1]).max(0.0);
        self.excess += beyond * beyond + (LEAST - length).max(0.0);
    }

    fn panel(&mut self, grid: &Grid, surface: &Surface, t: [u32; 3], at_border: bool) {
        let p = t.map(|v| grid.xyz[v as usize]);
        let shape = shape(p);
        self.area += 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).length();
        self.panels += 1.0;
        self.shape += shape;
        if at_border {
            self.border_panels += 1.0;
            self.border_shape += shape;
        }
        let beyond = (SHAPE - shape).max(0.0);
        self.excess += beyond * beyond + f64::from(is_turned(grid, surface, t));
    }

    /// mu of Eq. 27.
    pub fn mu(&self) -> f64 {
        (self.residual.max(0.0) / self.weighted.max(f64::MIN_POSITIVE)).sqrt()
    }

    /// Mean angle fluency index (Eq. 30), degrees.
    pub fn delta_deg(&self) -> f64 {
        (self.delta / self.regular.max(1.0)).to_degrees()
    }

    /// Mean shape of the panels at the border; 1 without any.
    pub fn border_shape_mean(&self) -> f64 {
        if self.border_panels > 0.0 { self.border_shape / self.border_panels } else { 1.0 }
    }

    /// Fluency Q (Eq. 31); None for a perfect lattice.
    pub fn fluency(&self, lambda: f64) -> Option<f64> {
        let rho = lambda * self.regular / self.weighted.max(f64::MIN_POSITIVE);
        let disorder = self.mu() + rho * self.delta_deg() / 60.0;
        (disorder > PERFECT).then(|| 1.0 / disorder)
    }

    /// Q, divided by one and what is beyond the guards of spread, shape, border, mean length, area and direction. Higher
    /// is better.
    pub fn merit(&self, lambda: f64) -> f64 {
        let guards = &GUARDS;
        let share = self.border_members.count / self.members.count.max(1.0);
        let [inside, border] = [guards.spread_inside, guards.spread_border];
        let spread = (share * border * border + (1.0 - share) * inside * inside).sqrt();
        let share = self.border_panels / self.panels.max(1.0);
        let even = share * guards.shape_border + (1.0 - share) * guards.shape_inside;
        let held_back = guards.spread_weight * over(self.members.cv(), spread)
            + guards.border_spread.above(self.border_members.cv())
            + guards.border_shape.below(self.border_shape_mean())
            + guards.shape_weight * over(even, self.shape / self.panels.max(1.0))
            + guards.mean_length.above((self.members.mean() - 1.0).abs())
            + guards.area.below(self.area)
            + guards.direction.above(self.astray / self.guided.max(1.0))
            + guards.excess_weight * self.excess;
        self.fluency(lambda).unwrap_or(1.0 / PERFECT) / (1.0 + held_back)
    }
}

fn over(x: f64, limit: f64) -> f64 {
    (x - limit).max(0.0)
}

impl Add for Lengths {
    type Output = Lengths;
    fn add(self, o: Lengths) -> Lengths {
        Lengths {
            count: self.count + o.count,
            sum: self.sum + o.sum,
            squares: self.squares + o.squares,
        }
    }
}

impl Sub for Lengths {
    type Output = Lengths;
    fn sub(self, o: Lengths) -> Lengths {
        Lengths {
            count: self.count - o.count,
            sum: self.sum - o.sum,
            squares: self.squares - o.squares,
        }
    }
}

impl Add for Sums {
    type Output = Sums;
    fn add(self, o: Sums) -> Sums {
        Sums {
            weighted: self.weighted + o.weighted,
            residual: self.residual + o.residual,
            regular: self.regular + o.regular,
            delta: self.delta + o.delta,
            members: self.members + o.members,
            border_members: self.border_members + o.border_members,
            panels: self.panels + o.panels,
            shape: self.shape + o.shape,
            border_panels: self.border_panels + o.border_panels,
            border_shape: self.border_shape + o.border_shape,
            area: self.area + o.area,
            guided: self.guided + o.guided,
            astray: self.astray + o.astray,
            excess: self.excess + o.excess,
        }
    }
}

impl Sub for Sums {
    type Output = Sums;
    fn sub(self, o: Sums) -> Sums {
        Sums {
            weighted: self.weighted - o.weighted,
            residual: self.residual - o.residual,
            regular: self.regular - o.regular,
            delta: self.delta - o.delta,
            members: self.members - o.members,
            border_members: self.border_members - o.border_members,
            panels: self.panels - o.panels,
            shape: self.shape - o.shape,
            border_panels: self.border_panels - o.border_panels,
            border_shape: self.border_shape - o.border_shape,
            area: self.area - o.area,
            guided: self.guided - o.guided,
            astray: self.astray - o.astray,
            excess: self.excess - o.excess,
        }
    }
}

/// Angle between the wanted direction at node `v` and the nearest of its members, radians; None where no direction is
/// wanted.
pub fn off_direction(grid: &Grid, surface: &Surface, v: u32) -> Option<f64> {
    if surface.direction.is_empty() {
        return None;
    }
    let point = grid.places[v as usize].surface_point(surface);
    let wanted = surface.direction_at(&point)?;
    let normal = surface.carrier.normal(&point);
    let off = |&w: &u32| {
        let member = grid.xyz[w as usize] - grid.xyz[v as usize];
        let angle = trig::angle(member - normal * member.dot(normal), wanted);
        angle.min(PI - angle)
    };
    Some(grid.mesh.ring(v).iter().map(off).fold(PI, f64::min))
}

/// Angle fluency index `delta_i` of a regular interior node (Eq. 28 and 29), radians.
pub fn delta(grid: &Grid, v: u32) -> f64 {
    let at = grid.xyz[v as usize];
    let ring = grid.mesh.ring(v);
    let members: [DVec3; 6] = std::array::from_fn(|j| grid.xyz[ring[j] as usize] - at);
    let beta: [f64; 6] = std::array::from_fn(|j| trig::angle(members[j], members[(j + 1) % 6]));
    let mut squares = 0.0;
    for j in 0..3 {
        let bend = trig::angle(members[j], members[j + 3]) - PI;
        let skew = beta[j] - beta[j + 3];
        squares += bend * bend + skew * skew;
    }
    (squares / 3.0).sqrt()
}

/// Whether a panel faces against the surface: against its normal at a corner, and at all corners on average.
pub fn is_turned(grid: &Grid, surface: &Surface, t: [u32; 3]) -> bool {
    let [p, q, r] = t.map(|v| grid.xyz[v as usize]);
    let panel = (q - p).cross(r - p);
    let normal = |v: u32| grid.places[v as usize].normal(surface);
    panel.dot(normal(t[0])) <= 0.0 && panel.dot(t.map(normal).iter().sum()) <= 0.0
}

/// Panel shape index q of Eq. 25; 0 for a panel without extent.
pub fn shape(p: [DVec3; 3]) -> f64 {
    let sides =
        p[0].distance_squared(p[1]) + p[1].distance_squared(p[2]) + p[2].distance_squared(p[0]);
    if sides == 0.0 {
        return 0.0;
    }
    // Twice the area, hence 2 sqrt(3) for the 4 sqrt(3) of the paper.
    2.0 * 3f64.sqrt() * (p[1] - p[0]).cross(p[2] - p[0]).length() / sides
}
