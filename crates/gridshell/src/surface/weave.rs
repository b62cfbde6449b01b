//! Triangles of one face: constrained Delaunay in (u, v), then flips and splits measured in space.
//!
//! The (u, v) plane is scaled to the patch's mean metric for Delaunay. Triangles are sorted into inside and
//! outside by parity across the polygons' edges, not by where they lie.

use super::trim::Node;
use glam::DVec2;
use spade::handles::FixedVertexHandle;
use spade::{
    ConstrainedDelaunayTriangulation, HasPosition, Point2, PositionInTriangulation, Triangulation,
};

/// A vertex of the Delaunay triangulation: where it lies in the scaled plane.
struct Site(Point2<f64>);

type Plane = ConstrainedDelaunayTriangulation<Site>;

fn site(node: &Node, scale: DVec2) -> Site {
    let p = node.uv * scale;
    // The triangulation refuses numbers that are all but zero (below about 2e-43); these are lengths.
    let snap = |x: f64| if x.abs() < 1e-30 { 0.0 } else { x };
    Site(Point2::new(snap(p.x), snap(p.y)))
}

impl HasPosition for Site {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.0
    }
}

/// A polygon edge between nodes.
pub(super) type Rim = [u32; 2];

/// Triangulate the inside of `rims` over `nodes`. `scale` turns (u, v) into lengths. Triangles are
/// counter-clockwise in (u, v). Nodes at the same (u, v) are one: the first. Nodes of the rims stand first
/// among `nodes`; later ones that would lie right on a rim are left out.
///
/// # Errors
/// The node near which polygons cross.
pub(super) fn triangles(
    nodes: &[Node],
    rims: &[Rim],
    scale: DVec2,
) -> Result<Vec<[u32; 3]>, usize> {
    let mut cdt = Plane::new();
    let bounds = rims.iter().flatten().max().map_or(0, |&last| last as usize + 1);
    let mut handles: Vec<FixedVertexHandle> = Vec::with_capacity(bounds);
    let mut first: Vec<u32> = Vec::with_capacity(nodes.len());
    for (i, n) in nodes[..bounds].iter().enumerate() {
        let handle = cdt.insert(site(n, scale)).map_err(|_| i)?;
        if handle.index() == first.len() {
            first.push(i as u32);
        }
        handles.push(handle);
    }
    // How often the polygons use each edge: twice is a slit, with the inside on both sides.
    let mut uses: Vec<(u32, u32)> = Vec::with_capacity(rims.len());
    for &[a, b] in rims {
        let (from, to) = (handles[a as usize], handles[b as usize]);
        if from == to {
            continue;
        }
        if !cdt.exists_constraint(from, to) {
            if !cdt.can_add_constraint(from, to) {
                return Err(a as usize);
            }
            cdt.add_constraint(from, to);
            // The edge was broken at a node that lies right on it.
            if !cdt.exists_constraint(from, to) {
                return Err(a as usize);
            }
        }
        let (from, to) = (from.index() as u32, to.index() as u32);
        uses.push((from.min(to), from.max(to)));
    }
    for (i, n) in nodes.iter().enumerate().skip(bounds) {
        let site = site(n, scale);
        let on_rim = match cdt.locate(site.0) {
            PositionInTriangulation::OnEdge(e) => cdt.is_constraint_edge(e.as_undirected()),
            PositionInTriangulation::OnVertex(_) => true,
            _ => false,
        };
        if !on_rim {
            cdt.insert(site).map_err(|_| i)?;
            first.push(i as u32);
        }
    }
    uses.sort_unstable();
    let odd = |a: usize, b: usize| {
        let key = (a.min(b) as u32, a.max(b) as u32);
        (uses.partition_point(|&u| u <= key) - uses.partition_point(|&u| u < key)) % 2 == 1
    };
    let mut inside: Vec<Option<bool>> = vec![None; cdt.num_all_faces()];
    inside[cdt.outer_face().fix().index()] = Some(false);
    // The hull's edges lead in from the outside.
    let mut open: Vec<_> = cdt.convex_hull().map(|e| e.fix()).collect();
    while let Some(edge) = open.pop() {
        let edge = cdt.directed_edge(edge);
        let Some(here) = inside[edge.face().fix().index()] else { continue };
        let over = edge.rev().face().fix().index();
        if inside[over].is_some() {
            continue;
        }
        inside[over] = Some(here != odd(edge.from().fix().index(), edge.to().fix().index()));
        open.push(edge.rev().next().fix());
        open.push(edge.rev().prev().fix());
    }
    let kept = cdt.inner_faces().filter(|f| inside[f.fix().index()] == Some(true));
    Ok(kept.map(|f| f.vertices().map(|v| first[v.fix().index()])).collect())
}

#[cfg(test)]
mod tests {
    use super::super::trim::NEW;
    use super::*;

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
            let t = triangles(&n, &rims, DVec2::ONE).unwrap();
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
        let t = triangles(&n, &ring(0, 8), DVec2::ONE).unwrap();
        assert!((area(&n, &t) - 7.0).abs() < 1e-12);
    }

    #[test]
    fn slit_has_the_face_on_both_sides() {
        let n = nodes(&[(0., 0.), (4., 0.), (4., 4.), (0., 4.), (2., 1.), (2., 2.)]);
        let mut rims = ring(0, 4);
        rims.extend([[4, 5], [5, 4]]);
        let t = triangles(&n, &rims, DVec2::ONE).unwrap();
        assert!((area(&n, &t) - 16.0).abs() < 1e-12);
    }

    #[test]
    fn crossing_polygon_is_an_error_not_a_panic() {
        let n = nodes(&[(0., 0.), (1., 1.), (1., 0.), (0., 1.)]);
        assert!(triangles(&n, &ring(0, 4), DVec2::ONE).is_err());
        let n = nodes(&[(0., 0.), (f64::NAN, 1.), (1., 0.), (0., 1.)]);
        assert!(triangles(&n, &ring(0, 4), DVec2::ONE).is_err());
    }
}
