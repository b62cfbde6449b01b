//! What is seen: a surface, bubbles, a grid, as frames of flat arrays.

use crate::frame::Frame;
use crate::message::Shows;
use axum::body::Bytes;
use glam::DVec3;
use gridshell::degree::{REGULAR, adjusted_degree};
use gridshell::grid::Grid;
use gridshell::surface::{Chain, Surface};

/// A surface: its triangles, and its boundaries and creases as lines.
pub fn surface(surface: &Surface) -> Bytes {
    let carrier = &surface.carrier;
    let lines = surface.loops.iter().chain(&surface.features).flat_map(segments);
    Frame::new(Shows::Surface, 0)
        .points("xyz", &carrier.points)
        .points("normals", &carrier.normals)
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

/// A grid, with its irregular nodes and by how much their adjusted degree exceeds 6.
pub fn grid(shows: Shows, run: u32, grid: &Grid) -> Bytes {
    let mesh = &grid.mesh;
    let excess = |v: u32| adjusted_degree(mesh, &grid.xyz, v) - REGULAR;
    let irregular: Vec<(u32, i32)> =
        mesh.vertices().map(|v| (v, excess(v))).filter(|n| n.1 != 0).collect();
    Frame::new(shows, run)
        .points("xyz", &grid.xyz)
        .wholes("panels", mesh.triangles().flatten())
        .wholes("members", mesh.edges().flat_map(|(a, b)| [a, b]))
        .wholes("irregular", irregular.iter().map(|n| n.0))
        .floats("excess", irregular.iter().map(|n| f64::from(n.1)))
        .bytes()
}
