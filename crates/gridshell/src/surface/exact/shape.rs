//! Exact patch geometry: a mapping from (u, v) to xyz with first derivatives.

use super::jet::Jet;
use super::nurbs::{NurbsSurface, into_domain};
use super::offset::OffsetSurface;
use glam::{DVec2, DVec3};

/// A side whose points lie within this share of the patch's size is one point: a pole.
const POLE_SHARE: f64 = 1e-6;

/// The exact geometry of one patch.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A (rational) B-spline surface.
    Nurbs(NurbsSurface),
    /// A surface at a constant distance from another.
    Offset(Box<OffsetSurface>),
    /// z as an analytic function of x = u and y = v: its value and its two derivatives.
    Height(fn(f64, f64) -> [f64; 3]),
}

/// A side of a patch that is a single point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pole {
    /// The parameter that is fixed on this side: 0 for u, 1 for v.
    pub fixed: usize,
    /// Its value there.
    pub value: f64,
    /// Whether it is the upper end of that parameter's domain.
    pub upper: bool,
    /// The point.
    pub point: DVec3,
}

impl Shape {
    /// Position at `uv`.
    pub fn point(&self, uv: DVec2) -> DVec3 {
        self.jet(uv).point
    }

    /// Position and first derivatives at `uv`.
    pub fn jet(&self, uv: DVec2) -> Jet {
        match self {
            Shape::Nurbs(s) => s.jet(uv),
            Shape::Offset(s) => s.jet(uv),
            Shape::Height(f) => {
                let [z, zx, zy] = f(uv.x, uv.y);
                Jet {
                    point: DVec3::new(uv.x, uv.y, z),
                    du: DVec3::new(1.0, 0.0, zx),
                    dv: DVec3::new(0.0, 1.0, zy),
                }
            }
        }
    }

    /// First and last parameter in u and in v; infinite for a height function.
    pub fn domain(&self) -> [[f64; 2]; 2] {
        match self {
            Shape::Nurbs(s) => s.domain(),
            Shape::Offset(s) => s.basis().domain(),
            Shape::Height(_) => [[f64::NEG_INFINITY, f64::INFINITY]; 2],
        }
    }

    /// Whether the patch closes on itself in u and in v. There, parameters may run past the domain.
    pub fn closed(&self) -> [bool; 2] {
        match self {
            Shape::Nurbs(s) => s.closed(),
            Shape::Offset(s) => s.closed(),
            Shape::Height(_) => [false; 2],
        }
    }

    /// The period in u and in v; 0 where the patch does not close.
    pub fn period(&self) -> DVec2 {
        let (domain, closed) = (self.domain(), self.closed());
        let period = |k: usize| if closed[k] { domain[k][1] - domain[k][0] } else { 0.0 };
        DVec2::new(period(0), period(1))
    }

    /// `uv` clamped to the domain in the directions that do not close.
    pub fn clamp(&self, uv: DVec2) -> DVec2 {
        let (domain, closed) = (self.domain(), self.closed());
        let clamp = |k: usize, t: f64| {
            if closed[k] { t } else { into_domain(domain[k][0], domain[k][1], false, t) }
        };
        DVec2::new(clamp(0, uv.x), clamp(1, uv.y))
    }

    /// The spline patch that it is, or is an offset of.
    pub fn spline(&self) -> Option<&NurbsSurface> {
        match self {
            Shape::Nurbs(s) => Some(s),
            Shape::Offset(s) => Some(s.basis()),
            Shape::Height(_) => None,
        }
    }

    /// The sides that are a single point.
    pub fn poles(&self) -> Vec<Pole> {
        let Some(s) = self.spline() else { return Vec::new() };
        let domain = s.domain();
        let size = {
            let lo = s.points.iter().fold(DVec3::MAX, |a, &b| a.min(b));
            let hi = s.points.iter().fold(DVec3::MIN, |a, &b| a.max(b));
            lo.distance(hi)
        };
        let mut poles = Vec::new();
        for (fixed, ends) in domain.iter().enumerate() {
            let along = self.lattice(1 - fixed);
            for upper in [false, true] {
                let value = ends[usize::from(upper)];
                let at = |t: f64| {
                    let uv = if fixed == 0 { [value, t] } else { [t, value] };
                    self.point(DVec2::from(uv))
                };
                let point = at(along[0]);
                if along.iter().all(|&t| at(t).distance(point) <= POLE_SHARE * size) {
                    poles.push(Pole { fixed, value, upper, point });
                }
            }
        }
        poles
    }

    /// Parameters of direction `k` that tell the patch's shape: several in each knot span.
    pub fn lattice(&self, k: usize) -> Vec<f64> {
        let Some(s) = self.spline() else { return Vec::new() };
        let breaks = s.breaks(k);
        // A plane needs few; a patch of many spans is well told by a few in each.
        let each = (32 / (breaks.len() - 1)).clamp(2, 8);
        let mut lattice = vec![breaks[0]];
        for w in breaks.windows(2) {
            lattice.extend((1..=each).map(|i| w[0] + (w[1] - w[0]) * i as f64 / each as f64));
        }
        lattice
    }
}
