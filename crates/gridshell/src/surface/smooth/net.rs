//! The mesh in triangles, with what each face is: what normals and patches are worked out on.

use crate::math::trig;
use crate::surface::PolygonMesh;
use crate::surface::carrier::{NONE, adjacency};
use crate::surface::polygon::caps;
use crate::surface::polygon::triangulate::newell;
use glam::DVec3;
use std::collections::BTreeMap;

/// A mesh in triangles.
pub(super) struct Net {
    pub points: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
    /// Triangle across the edge from corner k to corner k + 1, or [`NONE`].
    pub neighbors: Vec<[u32; 3]>,
    /// Index of each triangle's face.
    pub face: Vec<u32>,
    /// Corners of the faces.
    pub faces: Vec<Vec<u32>>,
    /// Unit normals of the faces.
    pub normals: Vec<DVec3>,
}

impl Net {
    pub(super) fn of(mesh: &PolygonMesh) -> Net {
        let mut points = mesh.points.clone();
        let (mut triangles, face) = mesh.split(&mut points);
        let pieces = triangles.iter().zip(face);
        let known: BTreeMap<[u32; 3], u32> = pieces.map(|(&t, f)| (sorted(t), f)).collect();
        caps::flatten(&points, &mut triangles);
        // What was flipped belongs to two faces: it stands for itself.
        let mut faces = mesh.faces.clone();
        let face = triangles.iter().map(|t| {
            known.get(&sorted(*t)).copied().unwrap_or_else(|| {
                faces.push(t.to_vec());
                faces.len() as u32 - 1
            })
        });
        let face = face.collect();
        let normals = faces.iter().map(|f| newell(&points, f).normalize_or_zero()).collect();
        let neighbors = adjacency(&triangles);
        Net { points, triangles, neighbors, face, faces, normals }
    }

    /// Corners of triangle `t`.
    pub(super) fn corners(&self, t: u32) -> [DVec3; 3] {
        self.triangles[t as usize].map(|v| self.points[v as usize])
    }

    /// Normal of the face that triangle `t` is of.
    pub(super) fn normal(&self, t: u32) -> DVec3 {
        self.normals[self.face[t as usize] as usize]
    }

    /// Vertices of the face that triangle `t` is of.
    pub(super) fn outline(&self, t: u32) -> &[u32] {
        &self.faces[self.face[t as usize] as usize]
    }

    /// Whether the edge of triangle `t` from its corner `k` on is on the boundary or a crease: the faces turn by more
    /// than `crease_angle` there.
    pub(super) fn is_line(&self, t: u32, k: usize, crease_angle: f64) -> bool {
        let u = self.neighbors[t as usize][k];
        u == NONE || trig::angle(self.normal(t), self.normal(u)) > crease_angle
    }
}

fn sorted(mut t: [u32; 3]) -> [u32; 3] {
    t.sort_unstable();
    t
}
