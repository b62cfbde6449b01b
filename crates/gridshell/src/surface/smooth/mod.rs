//! A smooth surface through the vertices of a coarse mesh, as a mesh fine enough to be taken for it.
//!
//! Normals at the vertices (`normals`), smooth curves between corners along boundary and creases (`lines`), and
//! over each triangle a patch that meets its neighbours with one tangent plane (`patch`, G1). Patches are then
//! divided until their pieces are as good as flat (`pieces`).
//!
//! What is plane stays plane; where faces are finer than wanted, they stay as they are.

mod lines;
mod net;
mod normals;
mod patch;
mod pieces;
#[cfg(test)]
mod tests;

use super::{PolygonMesh, Smoothing};
use crate::error::Result;
use crate::job::Job;
use lines::Lines;
use net::Net;
use patch::{Arc, Patch, Side};
use pieces::Pieces;

/// Vertices nearer to one another than this many chord errors are one place to the grid.
const NEAR: f64 = 10.0;

/// How a mesh is smoothed. Metres and radians.
#[derive(Clone, Copy, Debug)]
pub struct Smooth {
    /// Faces with an edge longer than this are coarse.
    pub coarse: f64,
    /// The pieces leave the smooth surface by no more than this.
    pub chord_error: f64,
    /// Where the boundary or a crease turns by more than this, it has a corner.
    pub corner_angle: f64,
    /// Edges where faces turn by more than this stay sharp.
    pub crease_angle: f64,
}

impl PolygonMesh {
    /// Length of the longest edge.
    pub fn longest_edge(&self) -> f64 {
        let at = |v: u32| self.points[v as usize];
        let edges = self
            .faces
            .iter()
            .flat_map(|f| (0..f.len()).map(move |k| at(f[k]).distance(at(f[(k + 1) % f.len()]))));
        edges.fold(0.0, f64::max)
    }

    /// The mesh of a smooth surface through these vertices, where it is coarse.
    ///
    /// # Errors
    /// [`Error::Surface`](crate::Error::Surface) where that would take far too many triangles.
    pub fn smoothed(&self, wanted: &Smooth, job: &Job) -> Result<PolygonMesh> {
        job.check("smoothing the mesh")?;
        let web = Web::of(self, wanted);
        let mut pieces = Pieces::of(&web, wanted);
        pieces.refine(&web, wanted.chord_error, &self.name)?;
        let smoothing =
            Smoothing { longest_edge: self.longest_edge(), departure: pieces.departure };
        let Pieces { points, triangles, .. } = pieces;
        Ok(PolygonMesh {
            points,
            faces: triangles.iter().map(|(_, t)| t.map(|c| c.vertex).to_vec()).collect(),
            smoothing: Some(smoothing),
            ..self.without_faces()
        })
    }
}

/// All that patches are made from.
struct Web {
    net: Net,
    lines: Lines,
    /// Normals at the corners of the triangles.
    normals: Vec<[glam::DVec3; 3]>,
}

impl Web {
    fn of(mesh: &PolygonMesh, wanted: &Smooth) -> Web {
        let net = Net::of(mesh);
        let lines = Lines::of(&net, wanted.crease_angle, wanted.corner_angle);
        let normals = normals::normals(&net, &lines, NEAR * wanted.chord_error);
        Web { net, lines, normals }
    }

    /// The patch over triangle `t`.
    fn patch(&self, t: u32) -> Patch {
        let corners = self.net.corners(t);
        let normals = self.normals[t as usize];
        let sides = [0, 1, 2].map(|k| self.side(t, (k + 1) % 3));
        Patch { corners, normals, sides }
    }

    /// The side of triangle `t` from its corner `k` on.
    fn side(&self, t: u32, k: usize) -> Side {
        let (i, j) = (k, (k + 1) % 3);
        let [a, b] = [i, j].map(|k| self.net.triangles[t as usize][k]);
        let [p, q] = [a, b].map(|v| self.net.points[v as usize]);
        let normals = [i, j].map(|k| self.normals[t as usize][k]);
        if !self.lines.edges[t as usize][k] {
            return Side { arc: Arc::between(p, normals[0], q, normals[1]), normals };
        }
        let [at_a, at_b] = [a, b].map(|v| self.beside(t, k, v));
        let from = self.lines.leaving(&self.net, a, b, &at_a);
        let to = -self.lines.leaving(&self.net, b, a, &at_b);
        Side { arc: Arc::new(p, from, q, to), normals }
    }

    /// Normals at the vertex `v` on both sides of the edge of triangle `t` from its corner `k` on: the same from either.
    fn beside(&self, t: u32, k: usize, v: u32) -> Vec<glam::DVec3> {
        let mut sides = [t, self.net.neighbors[t as usize][k]];
        sides.sort_unstable();
        let corner = |&t: &u32| {
            let corners = self.net.triangles.get(t as usize)?;
            let k = corners.iter().position(|&c| c == v)?;
            Some(self.normals[t as usize][k])
        };
        sides.iter().filter_map(corner).collect()
    }
}
