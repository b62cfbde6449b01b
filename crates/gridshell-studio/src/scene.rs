//! What is seen: a surface, bubbles, a grid, as frames of flat arrays.

use crate::frame::Frame;
use crate::message::Shows;
use axum::body::Bytes;
use glam::{DVec2, DVec3};
use gridshell::degree::{REGULAR, adjusted_degree};
use gridshell::grid::Grid;
use gridshell::inspect::Sketch;
use gridshell::mesh::Mesh;
use gridshell::surface::Chain;

/// Small pictures of larger grids show their boundary only.
const MOST_MEMBERS: usize = 8000;

/// A surface: its triangles with their parts, and its boundaries and creases as lines.
pub fn surface(sketch: &Sketch) -> Bytes {
    let surface = &sketch.surface;
    let carrier = &surface.carrier;
    // Parts share no points.
    let mut part = vec![0; carrier.points.len()];
    for (triangle, number) in carrier.triangles.iter().zip(&sketch.part) {
        for &v in triangle {
            part[v as usize] = *number as u32 + 1;
        }
    }
    let lines = surface.loops.iter().chain(&surface.features).flat_map(segments);
    Frame::new(Shows::Surface, 0)
        .points("xyz", &carrier.points)
        .points("normals", &carrier.normals)
        .wholes("part", part.into_iter())
        .wholes("triangles", carrier.triangles.iter().copied().flatten())
        .wholes("lines", lines)
        .bytes()
}

fn segments(chain: &Chain) -> impl Iterator<Item = u32> + '_ {
    let v = &chain.vertices;
    let closing = chain.is_closed().then(|| [v[v.len() - 1], v[0]]);
    let along = v.windows(2).map(|w| [w[0], w[1]]);
    along.chain(closing.filter(|c| c[0] != c[1])).flatten()
}

/// Bubbles of these diameters over `diameter`.
pub fn bubbles(run: u32, xyz: &[DVec3], scales: &[f64], diameter: f64) -> Bytes {
    Frame::new(Shows::Bubbles, run)
        .points("xyz", xyz)
        .floats("radii", scales.iter().map(|s| 0.5 * s * diameter))
        .bytes()
}

/// Grids seen from above, each scaled to fit a square.
pub fn thumbnails<'a>(run: u32, grids: impl Iterator<Item = &'a Grid>) -> Bytes {
    let mut frame = Frame::new(Shows::Candidates, run);
    for (k, grid) in grids.enumerate() {
        let mesh = &grid.mesh;
        let seen = || mesh.vertices().map(|v| grid.xyz[v as usize].truncate());
        let low = seen().reduce(DVec2::min).unwrap_or_default();
        let size = seen().reduce(DVec2::max).unwrap_or_default() - low;
        let scale = size.max_element().max(f64::MIN_POSITIVE).recip();
        let margin = 0.5 * (DVec2::ONE - size * scale);
        let at = |v: u32| ((grid.xyz[v as usize].truncate() - low) * scale + margin).to_array();
        let all = mesh.edge_count() <= MOST_MEMBERS;
        let members = mesh.edges().filter(|&(a, b)| all || mesh.is_boundary_edge(a, b));
        let excess = |v: &u32| adjusted_degree(mesh, &grid.xyz, *v) - REGULAR;
        let odd = |sign: i32| mesh.vertices().filter(move |v| excess(v).signum() == sign);
        frame = frame
            .floats(&format!("members{k}"), members.flat_map(|(a, b)| [at(a), at(b)]).flatten())
            .floats(&format!("few{k}"), odd(-1).flat_map(at))
            .floats(&format!("many{k}"), odd(1).flat_map(at));
    }
    frame.bytes()
}

/// A grid, with the members on creases and guides, the nodes that do not move, its irregular nodes and by how much their adjusted degree exceeds 6.
pub fn grid(shows: Shows, run: u32, grid: &Grid) -> Bytes {
    nodes_of(shows, run, &grid.mesh, &grid.xyz)
}

/// How the page draws a mesh with its nodes at these places.
pub fn nodes_of(shows: Shows, run: u32, mesh: &Mesh, xyz: &[DVec3]) -> Bytes {
    let excess = |v: u32| adjusted_degree(mesh, xyz, v) - REGULAR;
    let irregular: Vec<(u32, i32)> =
        mesh.vertices().map(|v| (v, excess(v))).filter(|n| n.1 != 0).collect();
    let features = mesh.edges().filter(|&(a, b)| mesh.is_feature_edge(a, b));
    Frame::new(shows, run)
        .points("xyz", xyz)
        .wholes("panels", mesh.triangles().flatten())
        .wholes("members", mesh.edges().flat_map(|(a, b)| [a, b]))
        .wholes("features", features.flat_map(|(a, b)| [a, b]))
        .wholes("fixed", mesh.vertices().filter(|&v| mesh.is_pinned(v)))
        .wholes("irregular", irregular.iter().map(|n| n.0))
        .floats("excess", irregular.iter().map(|n| f64::from(n.1)))
        .bytes()
}
