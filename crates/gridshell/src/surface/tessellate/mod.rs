//! A boundary representation made into a [`Surface`]: carrier, loops, exact area.
//!
//! Edges are sampled once, so that faces fit together; each face is trimmed, filled, woven and refined on its
//! own; then all are turned to the same side and joined.

pub(in crate::surface) mod edges;
mod fill;
mod numbering;
mod orient;
pub(in crate::surface) mod poles;
mod refine;
pub(in crate::surface) mod seam;
mod stretch;
pub(in crate::surface) mod trim;
mod weave;

pub(crate) use seam::bound;

use super::brep::BrepFace;
use super::carrier::track::{Track, Tracks};
use super::carrier::{NONE, chain};
use super::exact::area;
use super::{Brep, FARTHEST, Model, Origin, PREPARING, Sampling, Shape, Surface};
use crate::error::{Error, Result};
use crate::job::{Job, Picture};
use edges::{fault, sample_edges};
use glam::{DVec2, DVec3};
use orient::Wing;
use rayon::prelude::*;
use refine::Web;
use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};
use stretch::Stretch;
use trim::{Edges, NEW, Node, Polyline, Tracer, Trim};

/// More triangles than this are not made.
const MOST_TRIANGLES: f64 = 8e6;

/// Nodes of one face at most: its share of some for the bends of the whole model, and some for each square of the
/// longest edge in its area. A flat face has 2.3 to a square, a sphere of 17 squares twice that. With more for bends,
/// waves shorter than a member cost seconds that no grid gains from; with fewer, they are drawn too coarsely.
const NODES_FOR_BENDS: f64 = 20_000.0;
const NODES_TO_A_SQUARE: f64 = 8.0;
/// As many are left to each face of a model of many.
const LEAST_FOR_BENDS: f64 = 1_000.0;
/// What the chord error is eased by where a crumpled face would have more.
const EASED: f64 = 4.0;
/// Eased so often, the spacing no longer depends on bends.
const MOST_EASINGS: usize = 8;

/// Rounds of leaving out nodes that pinch the surface at a pole.
const MOST_PINCHES: usize = 20;

/// The triangles of one face.
struct Piece {
    nodes: Vec<Node>,
    triangles: Vec<[u32; 3]>,
    area: f64,
}

impl Model {
    /// The surface with a carrier of this sampling.
    ///
    /// # Errors
    /// [`Error::Surface`] where the model is not a manifold surface.
    pub fn surface(&self, sampling: &Sampling, job: &Job) -> Result<Surface> {
        match self {
            Model::Brep(brep) => tessellate(brep, sampling, job),
            Model::Mesh(mesh) => mesh.surface(sampling, job),
        }
    }
}

/// Make the surface of `brep` with a carrier of this sampling.
///
/// # Errors
/// [`Error::Surface`] naming the face whose boundary crosses itself or lies off its surface, or where more
/// than two faces meet in an edge; [`Error::Option`] where the sampling is too fine for the model.
pub fn tessellate(brep: &Brep, sampling: &Sampling, job: &Job) -> Result<Surface> {
    check(brep, sampling)?;
    job.check(PREPARING)?;
    let brep = &seam::complete(brep, sampling, job)?;
    let (mut points, polylines) = sample_edges(brep, sampling, job)?;
    let curves: Vec<_> = brep.edges.iter().map(|e| e.curve.clone()).collect();
    let origin = brep.origin;
    let edges = Edges { curves: &curves, polylines: &polylines, points: &points, origin };
    let done = AtomicUsize::new(0);
    let pieces: Vec<Piece> = brep
        .faces
        .par_iter()
        .enumerate()
        .map(|(i, face)| {
            let made = piece(face, brep.faces.len(), &edges, sampling, job);
            // What was broken off tells nothing of the face.
            job.check(PREPARING)?;
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            job.progress("surface", done as f64 / brep.faces.len() as f64, Picture::None);
            made.map_err(|what| fault(brep, i, &what))
        })
        .collect::<Result<_>>()?;

    let mut wings = Vec::new();
    let mut uv = Vec::new();
    let mut patch = Vec::new();
    for (i, piece) in pieces.iter().enumerate() {
        let ids: Vec<u32> = piece
            .nodes
            .iter()
            .map(|n| {
                if n.vertex == NEW {
                    points.push(n.xyz);
                    points.len() as u32 - 1
                } else {
                    n.vertex
                }
            })
            .collect();
        let mut wing = Wing::default();
        for t in &piece.triangles {
            let t = if brep.faces[i].reversed { [t[0], t[2], t[1]] } else { *t };
            wing.triangles.push(t.map(|n| ids[n as usize]));
            uv.push(t.map(|n| parameters(&piece.nodes[n as usize])));
            patch.push(i as u32);
        }
        wings.push(wing);
    }
    job.check(PREPARING)?;
    let flipped = orient::alike(&wings, &points)?;
    let mut triangles: Vec<[u32; 3]> = wings.into_iter().flat_map(|w| w.triangles).collect();
    for (k, t) in triangles.iter_mut().enumerate() {
        if flipped[patch[k] as usize] {
            t.swap(1, 2);
            uv[k].swap(1, 2);
        }
    }
    if triangles.is_empty() {
        return Err(Error::Surface(format!("{}: there is no face with an area", brep.name)));
    }
    job.check(PREPARING)?;
    let order = numbering::of(&points, &triangles);
    job.check(PREPARING)?;
    let carrier = order.carrier(&points, &triangles, &patch, &uv);
    job.check(PREPARING)?;
    let tracks = tracks(brep, &polylines, &order.points);
    let curve_of = |a: u32, b: u32| tracks.curve_of(a, b);
    let mut loops = chain::boundary_loops(&carrier, PI, curve_of);
    for l in &mut loops {
        l.find_corners(&carrier, &curves, sampling.corner_angle);
    }
    Ok(Surface {
        name: brep.name.clone(),
        carrier,
        loops,
        features: Vec::new(),
        fixed: Vec::new(),
        shapes: brep.faces.iter().map(|f| f.shape.clone()).collect(),
        curves,
        scale: Vec::new(),
        direction: Vec::new(),
        area: pieces.iter().map(|p| p.area).sum(),
        origin: brep.origin,
        tracks,
    })
}

/// Refuse what the rest relies on.
fn check(brep: &Brep, sampling: &Sampling) -> Result<()> {
    let positive = |x: f64| x.is_finite() && x > 0.0;
    if !positive(sampling.max_edge) || !positive(sampling.chord_error) {
        return Err(Error::Option("the sampling's lengths must be positive".into()));
    }
    for (i, e) in brep.edges.iter().enumerate() {
        let known = e.ends.iter().all(|&v| (v as usize) < brep.vertices.len());
        if !known || e.range[0] >= e.range[1] || !e.range.iter().all(|t| t.is_finite()) {
            return Err(Error::Surface(format!("edge {} has no proper ends or range", i + 1)));
        }
    }
    for (i, f) in brep.faces.iter().enumerate() {
        if f.loops.iter().flatten().any(|c| c.edge as usize >= brep.edges.len()) {
            return Err(fault(brep, i, "a loop names an edge that does not exist"));
        }
    }
    Ok(())
}

/// Mesh one face of so many.
fn piece(
    face: &BrepFace,
    faces: usize,
    edges: &Edges,
    sampling: &Sampling,
    job: &Job,
) -> std::result::Result<Piece, String> {
    let shape = &face.shape;
    let tracer = Tracer::new(shape, edges, sampling, job);
    let Trim { loops, sliver } = tracer.trim(face)?;
    let all = || loops.iter().flatten().map(|n| n.uv);
    let (lo, hi) = (all().fold(DVec2::MAX, DVec2::min), all().fold(DVec2::MIN, DVec2::max));
    tame(shape, [lo, hi], edges)?;
    let stretch = Stretch::new(shape, tracer.poles(), lo, hi, sampling.max_edge);
    let rough = polygon_area(&loops, stretch.scale()) / (sampling.max_edge * sampling.max_edge);
    if rough > MOST_TRIANGLES {
        return Err(
            "it is far too large for members this short; ask for longer ones, or repair it if it should be smaller"
                .into(),
        );
    }
    let mut nodes: Vec<Node> = loops.iter().flatten().copied().collect();
    let mut rims = Vec::with_capacity(nodes.len());
    let mut from = 0;
    for l in &loops {
        let n = l.len() as u32;
        rims.extend((0..n).map(|i| [from + i, from + (i + 1) % n]));
        from += n;
    }
    let bends = (NODES_FOR_BENDS / faces as f64).max(LEAST_FOR_BENDS);
    let most = most_nodes(shape, [lo, hi], &loops, bends, sampling);
    let (mut eased, mut looks) = (*sampling, fill::LOOKS + fill::LOOKS_TO_A_NODE * most);
    let inside = (0..MOST_EASINGS).find_map(|_| {
        let inside = fill::inside(shape, &loops, &eased, most, looks, job);
        eased.chord_error *= EASED;
        // Half the bends need half the rows or fewer; all that follow take no more time than the first did.
        looks /= 2;
        inside
    });
    nodes.extend(inside.ok_or(
        "it is too crumpled for triangles of this length; repair it in the program that made it",
    )?);
    let mut web = weave_web(shape, nodes, &rims, &stretch, edges.origin, job)?;
    web.refine(sampling, most, job);
    let area: f64 = web
        .triangles
        .iter()
        .take_while(|_| !job.is_over(PREPARING))
        .map(|t| area::triangle(shape, t.map(|n| parameters(&web.nodes[n as usize]))))
        .sum();
    Ok(Piece { nodes: web.nodes, triangles: web.triangles, area: area + sliver })
}

/// Refuse a patch that runs far away from all edges, given by their points, within this box of parameters.
fn tame(shape: &Shape, [lo, hi]: [DVec2; 2], edges: &Edges) -> std::result::Result<(), String> {
    let Some(spline) = shape.spline() else { return Ok(()) };
    let corners = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = edges.points.iter().fold(corners, |(l, h), &p| (l.min(p), h.max(p)));
    let size = low.distance(high);
    let off = |p: DVec3| p.distance(p.clamp(low, high));
    let farthest = |points: &mut dyn Iterator<Item = DVec3>| {
        points.max_by(|a, b| off(*a).total_cmp(&off(*b))).filter(|&p| off(p) > FARTHEST * size)
    };
    // The patch lies within the hull of its control points; it may be a small part of a large one.
    let Some(control) = farthest(&mut spline.points.iter().copied()) else { return Ok(()) };
    let inside = |k: usize| {
        let lattice = shape.lattice(k).into_iter();
        lattice.filter(move |&t| lo[k] <= t && t <= hi[k]).collect::<Vec<_>>()
    };
    let (us, vs) = (inside(0), inside(1));
    let mut places =
        us.iter().flat_map(|&u| vs.iter().map(move |&v| shape.point(DVec2::new(u, v))));
    if farthest(&mut places).is_none() {
        return Ok(());
    }
    let away = off(control) / size;
    let control = edges.origin.world(control);
    Err(format!(
        "it runs far away from its boundary: its control point at ({:.3}, {:.3}, {:.3}) is {:.0} times as far off as \
         the model's edges are apart, so a number is most likely wrong; repair it in the program that made the file",
        control.x, control.y, control.z, away
    ))
}

/// How many nodes a face may have: a patch that is crumpled, by a fault of its file, would have millions.
fn most_nodes(
    shape: &Shape,
    [lo, hi]: [DVec2; 2],
    loops: &[Vec<Node>],
    bends: f64,
    sampling: &Sampling,
) -> usize {
    let rim: usize = loops.iter().map(Vec::len).sum();
    let area = stretch::mean_area(shape, lo, hi) * 0.5 * polygon_area(loops, DVec2::ONE);
    let squares = area / (sampling.max_edge * sampling.max_edge);
    4 * rim + (bends + NODES_TO_A_SQUARE * squares) as usize
}

/// Triangulate the nodes. Nodes that pinch the surface at a pole are left out, and all is done again.
fn weave_web<'a>(
    shape: &'a Shape,
    mut nodes: Vec<Node>,
    rims: &[[u32; 2]],
    stretch: &Stretch,
    origin: Origin,
    job: &Job,
) -> std::result::Result<Web<'a>, String> {
    for _ in 0..MOST_PINCHES {
        let triangles = weave::triangles(&nodes, rims, stretch, job).map_err(|i| {
            let p = origin.world(nodes[i].xyz);
            format!("its boundary crosses itself near ({:.4}, {:.4}, {:.4})", p.x, p.y, p.z)
        })?;
        let web = Web::new(shape, nodes, &triangles, rims);
        let pinches = web.pinches();
        if pinches.is_empty() {
            return Ok(web);
        }
        nodes = web.nodes;
        let mut i = 0;
        nodes.retain(|_| {
            i += 1;
            pinches.binary_search(&(i - 1)).is_err()
        });
    }
    Err("its triangles do not fit together at a pole".into())
}

/// Parameters of a node as the carrier keeps them: NaN where a pole leaves one without meaning.
fn parameters(node: &Node) -> DVec2 {
    let mut uv = node.uv;
    if let Some(k) = node.free {
        uv[k] = f64::NAN;
    }
    uv
}

fn polygon_area(loops: &[Vec<Node>], scale: DVec2) -> f64 {
    let one = |l: &Vec<Node>| {
        let n = l.len();
        (0..n).map(|i| (l[i].uv * scale).perp_dot(l[(i + 1) % n].uv * scale)).sum::<f64>().abs()
    };
    loops.iter().map(one).sum()
}

/// All carrier edges that lie on the edges of faces: what was left over when faces were parted bounds no triangle.
fn tracks(brep: &Brep, polylines: &[Polyline], number: &[u32]) -> Tracks {
    let mut tracks = Tracks::new();
    let mut used = vec![false; polylines.len()];
    brep.faces
        .iter()
        .flat_map(|f| f.loops.iter().flatten())
        .for_each(|c| used[c.edge as usize] = true);
    for (e, line) in polylines.iter().enumerate().filter(|(e, _)| used[*e]) {
        for k in 1..line.t.len() {
            let [a, b] = [k - 1, k].map(|i| number[line.vertices[i] as usize]);
            if a != NONE && b != NONE {
                tracks.lay(a, b, Track::of_curve(e as u32, [line.t[k - 1], line.t[k]]));
            }
        }
    }
    tracks
}
