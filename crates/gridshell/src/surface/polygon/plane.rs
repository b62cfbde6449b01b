//! A polygon in the plane split into triangles over its own corners, as nearly equilateral as they allow
//! (constrained Delaunay).

use glam::DVec2;
use spade::handles::{FixedFaceHandle, InnerTag};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// Coordinates nearer to zero than this are zero, as the triangulation asks for.
const TINY: f64 = 1e-60;
/// The triangles cover the polygon but for this share of its area.
const LOST: f64 = 1e-9;

type Web = ConstrainedDelaunayTriangulation<Point2<f64>>;

/// The triangles, counter-clockwise, for corners counter-clockwise; None where the polygon crosses or touches itself.
pub(super) fn split(plan: &[DVec2]) -> Option<Vec<[usize; 3]>> {
    let mut web = Web::new();
    let mut corners = Vec::with_capacity(plan.len());
    for p in plan {
        let near = |c: f64| if c.abs() < TINY { 0.0 } else { c };
        corners.push(web.insert(Point2::new(near(p.x), near(p.y))).ok()?);
    }
    if web.num_vertices() < plan.len() {
        return None;
    }
    for k in 0..corners.len() {
        let (a, b) = (corners[k], corners[(k + 1) % corners.len()]);
        if !web.can_add_constraint(a, b) {
            return None;
        }
        web.add_constraint(a, b);
    }
    // An edge that runs through a corner becomes two.
    if web.num_constraints() != plan.len() {
        return None;
    }
    let triangles = inside(&web);
    let area = |t: &[usize; 3]| (plan[t[1]] - plan[t[0]]).perp_dot(plan[t[2]] - plan[t[0]]);
    let covered: f64 = triangles.iter().map(area).sum();
    let n = plan.len();
    let whole: f64 = (1..n - 1).map(|k| area(&[0, k, k + 1])).sum();
    (triangles.len() == n - 2 && (covered - whole).abs() <= LOST * whole.abs()).then_some(triangles)
}

/// The triangles on the inner side of an odd number of polygon edges. Corners were inserted in their order, so the
/// vertices of the web count as they do.
fn inside(web: &Web) -> Vec<[usize; 3]> {
    let mut side: Vec<Option<bool>> = vec![None; web.num_all_faces()];
    let mut open: Vec<(FixedFaceHandle<InnerTag>, bool)> = (web.convex_hull())
        .filter_map(|edge| {
            let face = edge.rev().face().as_inner().or_else(|| edge.face().as_inner())?;
            Some((face.fix(), edge.is_constraint_edge()))
        })
        .collect();
    while let Some((face, inner)) = open.pop() {
        if side[face.index()].replace(inner).is_some() {
            continue;
        }
        for edge in web.face(face).adjacent_edges() {
            if let Some(next) = edge.rev().face().as_inner()
                && side[next.fix().index()].is_none()
            {
                open.push((next.fix(), inner != edge.is_constraint_edge()));
            }
        }
    }
    (web.inner_faces())
        .filter(|f| side[f.fix().index()] == Some(true))
        .map(|f| f.vertices().map(|v| v.fix().index()))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_round_polygon_gets_no_fan_and_crossing_ones_nothing() {
        let at = |k: usize| {
            let angle = k as f64 * std::f64::consts::TAU / 60.0;
            DVec2::new(crate::math::trig::cos(angle), crate::math::trig::sin(angle))
        };
        let round: Vec<DVec2> = (0..60).map(at).collect();
        let triangles = split(&round).expect("a simple polygon");
        assert_eq!(triangles.len(), 58);
        let uses = (0..60).map(|v| triangles.iter().filter(|t| t.contains(&v)).count());
        assert!(uses.max() < Some(20));
        let bow = [DVec2::ZERO, DVec2::ONE, DVec2::X, DVec2::Y, DVec2::new(-1.0, 0.5)];
        assert_eq!(split(&bow), None);
        let pinched = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::ZERO, DVec2::Y];
        assert_eq!(split(&pinched), None);
    }
}
