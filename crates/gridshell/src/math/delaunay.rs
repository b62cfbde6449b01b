//! Constrained Delaunay triangulation of the inside of polygons in the plane.
//!
//! Triangles are sorted into inside and outside by parity across the polygons' edges, not by where they lie.

use crate::job::Job;
use glam::DVec2;
use spade::handles::FixedVertexHandle;
use spade::{
    ConstrainedDelaunayTriangulation, HasPosition, Point2, PositionInTriangulation, Triangulation,
};

/// A vertex of the Delaunay triangulation: where it lies in the scaled plane.
struct Site(Point2<f64>);

type Plane = ConstrainedDelaunayTriangulation<Site>;

fn site(p: DVec2) -> Site {
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

/// A polygon edge between points.
pub(crate) type Rim = [u32; 2];

/// Triangulate the inside of `rims` over `points`; triangles are counter-clockwise. Points at the same place
/// are one: the first. Points of the rims stand first among `points`; later ones that would lie right on a rim
/// are left out.
///
/// # Errors
/// The point near which polygons cross; any where the job is over, which the caller is to check.
pub(crate) fn triangles(points: &[DVec2], rims: &[Rim], job: &Job) -> Result<Vec<[u32; 3]>, usize> {
    let mut cdt = Plane::new();
    let bounds = rims.iter().flatten().max().map_or(0, |&last| last as usize + 1);
    let mut handles: Vec<FixedVertexHandle> = Vec::with_capacity(bounds);
    let mut first: Vec<u32> = Vec::with_capacity(points.len());
    for (i, &n) in points[..bounds].iter().enumerate() {
        if job.is_over("triangulating") {
            return Err(i);
        }
        let handle = cdt.insert(site(n)).map_err(|_| i)?;
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
    for (i, &n) in points.iter().enumerate().skip(bounds) {
        let site = site(n);
        let on_rim = match cdt.locate(site.0) {
            PositionInTriangulation::OnEdge(e) => cdt.is_constraint_edge(e.as_undirected()),
            PositionInTriangulation::OnVertex(_) => true,
            _ => false,
        };
        if job.is_over("triangulating") {
            return Err(i);
        }
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
