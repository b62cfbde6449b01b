//! Closest points on shapes and curves: Gauss-Newton with Levenberg's damping.
//!
//! For targets near the surface (against its radius of curvature) this converges fast; it always ends,
//! never further away than it began. It finds the foot nearest to its start, not the nearest of all: begin
//! from [`Seeds`] where nothing is known.

use super::curve::Curve;
use super::shape::Shape;
use glam::{DVec2, DVec3};

/// Steps before giving up: a dozen is usual.
const MAX_STEPS: usize = 80;
/// Damping above which no step can help any more.
const MAX_DAMPING: f64 = 1e9;

impl Shape {
    /// The foot of `target` on the patch, found from `near_uv`: its parameters and the point. Parameters
    /// stay inside the domain, but run on past it where the patch closes on itself.
    pub fn project(&self, near_uv: DVec2, target: DVec3) -> (DVec2, DVec3) {
        let domain = self.domain();
        let closed = self.closed();
        let width = DVec2::new(domain[0][1] - domain[0][0], domain[1][1] - domain[1][0]);
        let aspect = if width.is_finite() { width.y / width.x } else { 1.0 };
        let mut uv = self.clamp(near_uv);
        let mut jet = self.jet(uv);
        let mut damping = 0.0;
        for _ in 0..MAX_STEPS {
            let miss = target - jet.point;
            let mut slope = [jet.du.dot(miss), jet.dv.dot(miss)];
            let (mut a, mut b, mut c) =
                (jet.du.length_squared(), jet.du.dot(jet.dv), jet.dv.length_squared());
            // Not out of the domain: a direction that leads out of it is left alone.
            for k in 0..2 {
                let out = !closed[k]
                    && ((uv[k] <= domain[k][0] && slope[k] < 0.0)
                        || (uv[k] >= domain[k][1] && slope[k] > 0.0));
                if out {
                    slope[k] = 0.0;
                    b = 0.0;
                }
            }
            // At a pole one derivative vanishes; keep the system solvable.
            a = a.max(1e-18 * c * aspect * aspect);
            c = c.max(1e-18 * a / (aspect * aspect));
            let (da, dc) = (a * (1.0 + damping), c * (1.0 + damping));
            let det = da * dc - b * b;
            if det.is_nan() || det <= 0.0 {
                break;
            }
            let mut step =
                DVec2::new(slope[0] * dc - slope[1] * b, slope[1] * da - slope[0] * b) / det;
            if width.is_finite() {
                step = step.clamp(-0.3 * width, 0.3 * width);
            }
            let next_uv = self.clamp(uv + step);
            let moved =
                (jet.du * (next_uv.x - uv.x)).length() + (jet.dv * (next_uv.y - uv.y)).length();
            let next = self.jet(next_uv);
            let better = target.distance_squared(next.point) < miss.length_squared();
            let rounding = 4e-16 * jet.point.abs().max_element();
            if better {
                (uv, jet) = (next_uv, next);
                damping = if damping < 1e-6 { 0.0 } else { damping * 0.1 };
                if moved <= rounding {
                    break;
                }
            } else {
                damping = (damping * 10.0).max(1e-3);
                if moved <= rounding + 1e-8 * miss.length() || damping > MAX_DAMPING {
                    break;
                }
            }
        }
        (uv, jet.point)
    }
}

impl Curve {
    /// The foot of `target` on the piece `range` of the curve, found from `near_t`: its parameter and the
    /// point.
    pub fn project(&self, near_t: f64, range: [f64; 2], target: DVec3) -> (f64, DVec3) {
        let mut t = near_t.clamp(range[0], range[1]);
        let mut jet = self.jet(t);
        let mut damping = 0.0;
        for _ in 0..MAX_STEPS {
            let miss = target - jet[0];
            let speed = jet[1].length_squared();
            if speed == 0.0 {
                break;
            }
            let step = jet[1].dot(miss) / (speed * (1.0 + damping));
            let next_t = (t + step).clamp(range[0], range[1]);
            let moved = (next_t - t).abs() * speed.sqrt();
            let next = self.jet(next_t);
            let rounding = 4e-16 * jet[0].abs().max_element();
            if target.distance_squared(next[0]) < miss.length_squared() {
                (t, jet) = (next_t, next);
                damping = if damping < 1e-6 { 0.0 } else { damping * 0.1 };
                if moved <= rounding {
                    break;
                }
            } else {
                damping = (damping * 10.0).max(1e-3);
                if moved <= rounding + 1e-8 * miss.length() || damping > MAX_DAMPING {
                    break;
                }
            }
        }
        (t, jet[0])
    }
}

/// Points spread over a patch from which to begin a projection when nothing is known.
pub struct Seeds {
    spread: Vec<(DVec2, DVec3)>,
}

/// This many nearest seeds are tried.
const TRIED: usize = 4;

impl Seeds {
    /// Spread seeds over `shape`.
    pub fn new(shape: &Shape) -> Seeds {
        let (us, vs) = (shape.lattice(0), shape.lattice(1));
        let mut spread = Vec::with_capacity(us.len() * vs.len());
        for &u in &us {
            for &v in &vs {
                let uv = DVec2::new(u, v);
                spread.push((uv, shape.point(uv)));
            }
        }
        Seeds { spread }
    }

    /// The foot of `target` on the whole of `shape`, as far as the nearest seeds lead to it.
    pub fn project(&self, shape: &Shape, target: DVec3) -> (DVec2, DVec3) {
        if self.spread.is_empty() {
            // A height function: its own parameters are x and y.
            return shape.project(target.truncate(), target);
        }
        let mut nearest: Vec<(f64, usize)> = Vec::with_capacity(TRIED + 1);
        for (i, s) in self.spread.iter().enumerate() {
            let d = s.1.distance_squared(target);
            if nearest.len() == TRIED && d >= nearest[TRIED - 1].0 {
                continue;
            }
            let at = nearest.partition_point(|n| n.0 <= d);
            nearest.insert(at, (d, i));
            nearest.truncate(TRIED);
        }
        let mut best: Option<(DVec2, DVec3)> = None;
        for &(_, i) in &nearest {
            let found = shape.project(self.spread[i].0, target);
            if best.is_none_or(|b| found.1.distance_squared(target) < b.1.distance_squared(target))
            {
                best = Some(found);
            }
        }
        best.expect("a patch has seeds")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::exact::nurbs::{NurbsCurve, NurbsSurface, octant};

    #[test]
    fn foot_on_a_sphere_lies_on_the_ray_from_its_centre() {
        let shape = Shape::Nurbs(octant());
        let start = DVec2::new(0.4, 0.4);
        for target in [(2.0, 1.0, 0.5), (0.3, 0.2, 0.4), (0.1, 0.1, 5.0), (1e-4, 2e-4, 1.0)] {
            let target = DVec3::from(target);
            let (uv, foot) = shape.project(start, target);
            assert!(foot.distance(target.normalize()) < 1e-7, "{target} {foot}");
            assert!(shape.point(uv).distance(foot) == 0.0);
        }
    }

    #[test]
    fn foot_stays_inside_the_domain() {
        let shape = Shape::Nurbs(octant());
        let (uv, foot) = shape.project(DVec2::new(0.9, 0.1), DVec3::new(2.0, -1.0, -3.0));
        assert!(uv.length() < 1e-12, "{uv}");
        assert!(foot.distance(DVec3::X) < 1e-12);
    }

    #[test]
    fn projection_from_the_pole_gets_away_and_back() {
        let shape = Shape::Nurbs(octant());
        let (_, foot) = shape.project(DVec2::new(0.5, 1.0), DVec3::new(1.0, 1.0, 1.0));
        assert!(foot.distance(DVec3::splat(1.0 / 3.0_f64.sqrt())) < 1e-7, "{foot}");
        let (_, foot) = shape.project(DVec2::new(0.2, 0.5), DVec3::Z * 1.5);
        assert!(foot.distance(DVec3::Z) < 1e-7, "{foot}");
    }

    #[test]
    fn seeds_find_the_right_sheet() {
        // A U of two sheets 0.2 apart.
        let line = [(0., 0.), (3., 0.), (3.4, 0.1), (3., 0.2), (0., 0.2)];
        let points = line.iter().flat_map(|&(x, z)| [DVec3::new(x, 0., z), DVec3::new(x, 1., z)]);
        let knots = [vec![0., 0., 0., 1., 2., 3., 3., 3.], vec![0., 0., 1., 1.]];
        let sheet = NurbsSurface::new([2, 1], knots, [5, 2], points.collect(), vec![]).unwrap();
        let shape = Shape::Nurbs(sheet);
        let seeds = Seeds::new(&shape);
        for u in [0.2, 2.8] {
            let target = shape.point(DVec2::new(u, 0.45));
            assert!(seeds.project(&shape, target).1.distance(target) < 1e-12);
        }
    }

    #[test]
    fn foot_on_a_curve_keeps_to_its_piece() {
        let points = vec![DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
        let arc = NurbsCurve::new(
            2,
            vec![0., 0., 0., 1., 1., 1.],
            points,
            vec![1.0, std::f64::consts::FRAC_1_SQRT_2, 1.0],
        )
        .unwrap();
        let curve = Curve::Nurbs(arc);
        let target = DVec3::new(0.9, 1.2, 0.3);
        let (t, foot) = curve.project(0.1, [0.0, 1.0], target);
        let there = DVec3::new(0.9, 1.2, 0.0).normalize();
        assert!(foot.distance(there) < 1e-7 && curve.point(t) == foot);
        let (t, _) = curve.project(0.1, [0.0, 0.3], target);
        assert_eq!(t, 0.3);
    }
}
