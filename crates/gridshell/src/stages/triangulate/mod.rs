//! Triangulate (Section 4.3): connect bubbles to a Delaunay grid on the surface.
//!
//! The bubbles are put into the carrier as vertices, and the carrier's own vertices are taken away one by
//! one, flipping edges to Delaunay all the while. Lengths are kept *along the surface* (an intrinsic
//! triangulation; Sharp, Soliman & Crane, *Navigating intrinsic triangulations*, 2019), never through space,
//! so near sheets and sharp bends do not matter; and since every step is a legal edit, the grid is always a
//! manifold with the Euler characteristic of the surface. Where the bubbles are too few to carry the topology
//! (a neck or handle narrower than a member), carrier vertices stay as nodes and the report names them.

mod intrinsic;
mod lawson;
mod planar;
mod removal;
#[cfg(test)]
mod tests;

pub use intrinsic::Work;
pub use planar::triangulate as triangulate_in_chart;

use crate::bubbles::Bubbles;
use crate::error::Result;
use crate::grid::{Grid, Place};
use crate::job::Job;
use crate::mesh::Mesh;
use crate::surface::{Chain, ChainPoint, Surface, SurfacePoint};
use glam::DVec3;
use intrinsic::Intrinsic;

/// What a stop in here is told as.
const PHASE: &str = "triangulating";

/// What triangulating did.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Positions of nodes that had to be added to keep the surface's topology, metres.
    pub added: Vec<DVec3>,
    /// What it took.
    pub work: Work,
}

/// Looks at edges, to each vertex, for making the carrier Delaunay with the bubbles in it. Good carriers take 4 to 8,
/// needles that lean across one another 26. More would be spent on a few edges that no member comes from.
const LOOKS_TO_CONNECT: usize = 60;

/// Looks at edges, to each vertex, for removing the carrier's: half of them for keeping the rest Delaunay. Good
/// carriers take 22, crumpled ones 30.
const LOOKS_TO_REMOVE: usize = 120;

/// The Delaunay grid of `bubbles` on `surface`: boundary bubbles become boundary nodes (corners fixed) and
/// come first, in order; then those on features, the fixed and the interior ones, in order; then nodes added to
/// keep the topology. Members follow the features whether or not they are Delaunay.
///
/// # Errors
/// [`Error::Surface`](crate::Error::Surface) when the carrier is not a manifold.
pub fn triangulate(surface: &Surface, bubbles: &Bubbles, job: &Job) -> Result<(Grid, Report)> {
    job.check(PHASE)?;
    let carrier = &surface.carrier;
    let mut tri = Intrinsic::new(
        Mesh::from_triangles(carrier.points.len(), &carrier.triangles)?,
        &carrier.points,
    );
    let mut nodes: Vec<(u32, Place)> = Vec::with_capacity(bubbles.len());
    for chain in &surface.features {
        for k in 0..chain.segments.len() {
            tri.mesh
                .mark_feature(chain.vertices[k], chain.vertices[(k + 1) % chain.vertices.len()])?;
        }
    }
    job.check(PHASE)?;
    let interior = insert_interior(&mut tri, surface, &bubbles.interior);
    insert_on_chains(&mut tri, &surface.loops, &bubbles.boundary, Place::Boundary, &mut nodes);
    insert_on_chains(&mut tri, &surface.features, &bubbles.features, Place::Feature, &mut nodes);
    for p in &bubbles.fixed {
        let corner = p.bary.iter().position(|&b| b == 1.0).expect("fixed points are vertices");
        nodes.push((carrier.triangles[p.triangle as usize][corner], Place::Fixed(*p)));
    }
    nodes.extend(interior.into_iter().zip(bubbles.interior.iter().map(|&p| Place::Interior(p))));

    let mut place: Vec<Option<(u32, Place)>> = vec![None; tri.mesh.slots()];
    for (i, &(v, p)) in nodes.iter().enumerate() {
        place[v as usize] = Some((i as u32, p));
    }
    let strays: Vec<u32> = tri.mesh.vertices().filter(|&v| place[v as usize].is_none()).collect();
    tri.complete();
    let vertices = tri.work.vertices;
    tri.make_delaunay(LOOKS_TO_CONNECT * vertices, job);
    let kept = tri.remove_all(strays, LOOKS_TO_REMOVE * vertices, job);
    job.check(PHASE)?;

    let mut report = Report { work: tri.work, ..Report::default() };
    let homes = if kept.is_empty() { Vec::new() } else { vertex_places(surface) };
    for v in kept {
        place[v as usize] = Some((nodes.len() as u32, homes[v as usize]));
        nodes.push((v, homes[v as usize]));
        report.added.push(carrier.points[v as usize]);
    }
    let number = |v: u32| place[v as usize].expect("only nodes are left").0;
    let triangles: Vec<[u32; 3]> = tri.mesh.triangles().map(|t| t.map(number)).collect();
    let mut mesh = Mesh::from_triangles(nodes.len(), &triangles)?;
    for (i, (v, place)) in nodes.iter().enumerate() {
        mesh.pin(i as u32, place.is_fixed());
        for &w in tri.mesh.along_features(*v) {
            mesh.mark_feature(i as u32, number(w))?;
        }
    }
    let places: Vec<Place> = nodes.into_iter().map(|(_, p)| p).collect();
    let xyz = places.iter().map(|p| p.xyz(surface)).collect();
    Ok((Grid { mesh, places, xyz }, report))
}

/// Put interior points into their carrier triangles; gives the vertex of each.
fn insert_interior(tri: &mut Intrinsic, surface: &Surface, points: &[SurfacePoint]) -> Vec<u32> {
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by_key(|&i| points[i].triangle);
    let mut vertex = vec![0; points.len()];
    for same in order.chunk_by(|&i, &j| points[i].triangle == points[j].triangle) {
        let t = points[same[0]].triangle;
        let corners = surface.carrier.triangles[t as usize];
        let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mut parts = vec![[0, 1, 2].map(|k| (corners[k], unit[k]))];
        for &i in same {
            let bary = inside(points[i].bary);
            let (best, _) = parts
                .iter()
                .map(|part| least_share(&part.map(|c| c.1), bary))
                .enumerate()
                .max_by(|x, y| x.1.total_cmp(&y.1))
                .expect("a triangle has at least one part");
            let [a, b, c] = parts.swap_remove(best);
            let at = surface.carrier.xyz(&SurfacePoint { triangle: t, bary });
            let m = tri.insert(
                [a.0, b.0, c.0],
                [a, b, c].map(|corner| {
                    surface.carrier.xyz(&SurfacePoint { triangle: t, bary: corner.1 }).distance(at)
                }),
            );
            parts.extend([[a, b, (m, bary)], [b, c, (m, bary)], [c, a, (m, bary)]]);
            vertex[i] = m;
        }
    }
    vertex
}

/// A point on an edge or corner of its triangle is put a hair inside: flips and removals then see an
/// ordinary vertex, and its true place is kept beside.
fn inside(bary: [f64; 3]) -> [f64; 3] {
    const HAIR: f64 = 1e-5;
    let b = bary.map(|x| x.max(HAIR));
    let sum = b[0] + b[1] + b[2];
    b.map(|x| x / sum)
}

/// The least barycentric coordinate of `p` in the part with these corners (all given in the barycentric
/// coordinates of the carrier triangle): positive inside.
fn least_share(corners: &[[f64; 3]; 3], p: [f64; 3]) -> f64 {
    let v = |b: [f64; 3]| DVec3::from_array(b);
    let whole = v(corners[0]).dot(v(corners[1]).cross(v(corners[2])));
    (0..3)
        .map(|k| v(p).dot(v(corners[(k + 1) % 3]).cross(v(corners[(k + 2) % 3]))) / whole)
        .fold(f64::INFINITY, f64::min)
}

/// Least share of a carrier edge that is split off.
const HAIR: f64 = 1e-6;

/// Split the carrier's edges on these chains at the bubbles there.
fn insert_on_chains(
    tri: &mut Intrinsic,
    chains: &[Chain],
    points: &[ChainPoint],
    place: fn(ChainPoint) -> Place,
    nodes: &mut Vec<(u32, Place)>,
) {
    let mut last: Option<(u32, usize, u32, f64)> = None;
    for point in points {
        let chain = &chains[point.chain as usize];
        let (k, fraction) = chain.locate(point.s);
        let count = chain.vertices.len();
        let (start, end) = (chain.vertices[k], chain.vertices[(k + 1) % count]);
        let is_corner = |k: usize| chain.corners.binary_search(&(k as u32)).is_ok();
        if fraction == 0.0 && is_corner(k) {
            nodes.push((start, Place::Corner(*point)));
            continue;
        }
        // Several bubbles on one carrier edge: each splits what the last one left.
        let (from, done) = match last {
            Some((c, seg, m, f)) if c == point.chain && seg == k => (m, f),
            _ => (start, 0.0),
        };
        let share = ((fraction - done) / (1.0 - done)).clamp(HAIR, 1.0 - HAIR);
        let m = tri.split(from, end, share);
        last = Some((point.chain, k, m, fraction));
        nodes.push((m, place(*point)));
    }
}

/// A place for every carrier vertex.
fn vertex_places(surface: &Surface) -> Vec<Place> {
    let carrier = &surface.carrier;
    let mut places = vec![
        Place::Interior(SurfacePoint { triangle: 0, bary: [1.0, 0.0, 0.0] });
        carrier.points.len()
    ];
    for (t, corners) in carrier.triangles.iter().enumerate() {
        for k in 0..3 {
            let mut bary = [0.0; 3];
            bary[k] = 1.0;
            places[corners[k] as usize] =
                Place::Interior(SurfacePoint { triangle: t as u32, bary });
        }
    }
    for (c, chain) in surface.loops.iter().enumerate() {
        for (k, &v) in chain.vertices.iter().enumerate() {
            let at = ChainPoint { chain: c as u32, s: chain.arc[k] };
            let corner = chain.corners.binary_search(&(k as u32)).is_ok();
            places[v as usize] = if corner { Place::Corner(at) } else { Place::Boundary(at) };
        }
    }
    for (c, chain) in surface.features.iter().enumerate() {
        let inner = usize::from(!chain.is_closed());
        for k in inner..chain.vertices.len() - inner {
            let at = ChainPoint { chain: c as u32, s: chain.arc[k] };
            places[chain.vertices[k] as usize] = Place::Feature(at);
        }
    }
    places
}
