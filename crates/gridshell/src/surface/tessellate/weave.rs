//! Triangles of one face: constrained Delaunay in the plane of its stretch.

use super::stretch::Stretch;
use super::trim::Node;
use crate::job::Job;
use crate::math::delaunay;
use glam::DVec2;

pub(super) use crate::math::delaunay::Rim;

/// The plane leans by this share: rows of squares, which patches are filled with, get their shorter diagonals then,
/// and not those that rounding prefers.
const LEAN: f64 = 1e-3;

/// Triangulate the inside of `rims` over `nodes`, as [`delaunay::triangles`], in the plane of `stretch`.
///
/// # Errors
/// The node near which polygons cross; any where the job is over.
pub(super) fn triangles(
    nodes: &[Node],
    rims: &[Rim],
    stretch: &Stretch,
    job: &Job,
) -> Result<Vec<[u32; 3]>, usize> {
    let leaning = |p: DVec2| DVec2::new(p.x + LEAN * p.y, p.y);
    let points: Vec<_> = nodes.iter().map(|n| leaning(stretch.place(n.uv))).collect();
    delaunay::triangles(&points, rims, job)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::Shape;
    use crate::surface::tessellate::trim::NEW;

    fn flat() -> Stretch {
        Stretch::new(&Shape::Height(|_, _| [0.0; 3]), &[], DVec2::ZERO, DVec2::splat(4.0), 1.0)
    }

    fn nodes(uv: &[(f64, f64)]) -> Vec<Node> {
        let node = |&(u, v): &(f64, f64)| {
            let uv = DVec2::new(u, v);
            Node { uv, xyz: uv.extend(0.0), vertex: NEW, free: None }
        };
        uv.iter().map(node).collect()
    }

    fn ring(from: u32, to: u32) -> Vec<Rim> {
        (from..to).map(|i| [i, if i + 1 < to { i + 1 } else { from }]).collect()
    }

    fn area(nodes: &[Node], triangles: &[[u32; 3]]) -> f64 {
        let p = |i: u32| nodes[i as usize].uv;
        triangles.iter().map(|&[a, b, c]| 0.5 * (p(b) - p(a)).perp_dot(p(c) - p(a))).sum()
    }

    #[test]
    fn hole_is_left_open_whichever_way_it_runs() {
        let square = [(0., 0.), (4., 0.), (4., 4.), (0., 4.)];
        let hole = [(1., 1.), (2., 1.), (2., 2.), (1., 2.)];
        let back: Vec<_> = hole.iter().rev().copied().collect();
        for hole in [hole.to_vec(), back] {
            let n = nodes(&[square.to_vec(), hole].concat());
            let rims = [ring(0, 4), ring(4, 8)].concat();
            let t = triangles(&n, &rims, &flat(), &Job::default()).unwrap();
            assert!((area(&n, &t) - 15.0).abs() < 1e-12);
        }
    }

    #[test]
    fn bay_of_a_bent_polygon_is_outside() {
        let n = nodes(&[
            (0., 0.),
            (3., 0.),
            (3., 3.),
            (2., 3.),
            (2., 1.),
            (1., 1.),
            (1., 3.),
            (0., 3.),
        ]);
        let t = triangles(&n, &ring(0, 8), &flat(), &Job::default()).unwrap();
        assert!((area(&n, &t) - 7.0).abs() < 1e-12);
    }

    #[test]
    fn slit_has_the_face_on_both_sides() {
        let n = nodes(&[(0., 0.), (4., 0.), (4., 4.), (0., 4.), (2., 1.), (2., 2.)]);
        let mut rims = ring(0, 4);
        rims.extend([[4, 5], [5, 4]]);
        let t = triangles(&n, &rims, &flat(), &Job::default()).unwrap();
        assert!((area(&n, &t) - 16.0).abs() < 1e-12);
    }

    #[test]
    fn crossing_polygon_is_an_error_not_a_panic() {
        let n = nodes(&[(0., 0.), (1., 1.), (1., 0.), (0., 1.)]);
        assert!(triangles(&n, &ring(0, 4), &flat(), &Job::default()).is_err());
        let n = nodes(&[(0., 0.), (f64::NAN, 1.), (1., 0.), (0., 1.)]);
        assert!(triangles(&n, &ring(0, 4), &flat(), &Job::default()).is_err());
    }
}
