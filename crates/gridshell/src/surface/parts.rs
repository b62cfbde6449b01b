//! The parts of a model: faces that hang together by shared edges. And surfaces laid side by side again.

use super::{Brep, Carrier, Chain, Model, PolygonMesh, Surface, SurfacePoint};
use glam::DVec3;
use std::collections::BTreeMap;

impl Model {
    /// Faces that hang together by shared edges: for each part its faces, ascending; parts by their first face.
    pub fn parts(&self) -> Vec<Vec<u32>> {
        let mut sets = Sets::new(self.face_count());
        let mut first: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        let mut meet = |edge: (u32, u32), face: usize| {
            let other = *first.entry(edge).or_insert(face as u32);
            sets.join(other, face as u32);
        };
        match self {
            Model::Brep(brep) => {
                for (f, face) in brep.faces.iter().enumerate() {
                    face.loops.iter().flatten().for_each(|c| meet((c.edge, c.edge), f));
                }
            }
            Model::Mesh(mesh) => {
                for (f, face) in mesh.faces.iter().enumerate() {
                    let n = face.len();
                    for (k, &a) in face.iter().enumerate() {
                        let b = face[(k + 1) % n];
                        meet((a.min(b), a.max(b)), f);
                    }
                }
            }
        }
        sets.listed()
    }

    /// Number of faces.
    pub fn face_count(&self) -> usize {
        match self {
            Model::Brep(brep) => brep.faces.len(),
            Model::Mesh(mesh) => mesh.faces.len(),
        }
    }

    /// The model of these faces only.
    #[must_use]
    pub fn of_faces(&self, faces: &[u32]) -> Model {
        match self {
            Model::Brep(brep) => Model::Brep(brep_of(brep, faces)),
            Model::Mesh(mesh) => Model::Mesh(mesh_of(mesh, faces)),
        }
    }

    /// What the objects of these faces are called, each once; empty where no objects are known.
    pub fn objects_of(&self, faces: &[u32]) -> Vec<String> {
        let Model::Brep(brep) = self else { return Vec::new() };
        let of = |&f: &u32| brep.object_of.get(f as usize).copied();
        let mut objects: Vec<u32> = faces.iter().filter_map(of).collect();
        objects.sort_unstable();
        objects.dedup();
        let told = |&o: &u32| brep.source.objects.get(o as usize).map(super::Object::told);
        objects.iter().filter_map(told).collect()
    }
}

fn brep_of(brep: &Brep, faces: &[u32]) -> Brep {
    let (mut edge_number, mut vertex_number) = (Numbers::default(), Numbers::default());
    let mut chosen = Vec::with_capacity(faces.len());
    for &f in faces {
        let mut face = brep.faces[f as usize].clone();
        for coedge in face.loops.iter_mut().flatten() {
            coedge.edge = edge_number.of(coedge.edge);
        }
        chosen.push(face);
    }
    let edges = edge_number.old.iter().map(|&e| {
        let mut edge = brep.edges[e as usize].clone();
        edge.ends = edge.ends.map(|v| vertex_number.of(v));
        edge
    });
    let edges = edges.collect();
    let of = |&f: &u32| brep.object_of.get(f as usize).copied();
    Brep {
        name: brep.name.clone(),
        unit_in_metres: brep.unit_in_metres,
        vertices: vertex_number.old.iter().map(|&v| brep.vertices[v as usize]).collect(),
        edges,
        object_of: faces.iter().filter_map(of).collect(),
        faces: chosen,
        source: brep.source.clone(),
        notes: brep.notes.clone(),
        tolerance: brep.tolerance,
        sewing: brep.sewing,
        origin: brep.origin,
    }
}

fn mesh_of(mesh: &PolygonMesh, faces: &[u32]) -> PolygonMesh {
    let mut number = Numbers::default();
    let face = |&f: &u32| mesh.faces[f as usize].iter().map(|&v| number.of(v)).collect();
    let faces = faces.iter().map(face).collect();
    let points = number.old.iter().map(|&v| mesh.points[v as usize]).collect();
    PolygonMesh { points, faces, ..mesh.without_faces() }
}

/// New numbers in order of first use.
#[derive(Default)]
struct Numbers {
    new: BTreeMap<u32, u32>,
    old: Vec<u32>,
}

impl Numbers {
    fn of(&mut self, old: u32) -> u32 {
        let next = self.old.len() as u32;
        let new = *self.new.entry(old).or_insert(next);
        if new == next {
            self.old.push(old);
        }
        new
    }
}

/// Sets of faces, joined pair by pair.
struct Sets {
    parent: Vec<u32>,
}

impl Sets {
    fn new(n: usize) -> Sets {
        Sets { parent: (0..n as u32).collect() }
    }

    fn root(&mut self, mut v: u32) -> u32 {
        while self.parent[v as usize] != v {
            let up = self.parent[self.parent[v as usize] as usize];
            self.parent[v as usize] = up;
            v = up;
        }
        v
    }

    /// The lower root stays, so a set's root is its first face.
    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        self.parent[a.max(b) as usize] = a.min(b);
    }

    fn listed(mut self) -> Vec<Vec<u32>> {
        let mut sets: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for v in 0..self.parent.len() as u32 {
            let root = self.root(v);
            sets.entry(root).or_default().push(v);
        }
        sets.into_values().collect()
    }
}

/// Where a part's carrier points, triangles, loops and so on begin in the surface of all parts.
#[derive(Clone, Copy, Debug, Default)]
pub struct Offset {
    /// Triangles of the carrier.
    pub triangles: u32,
    /// Loops.
    pub loops: u32,
    /// Features.
    pub features: u32,
    points: u32,
    shapes: u32,
    curves: u32,
}

impl Surface {
    /// Surfaces side by side as one of several pieces, under the first one's name; and where each begins in it.
    ///
    /// # Panics
    /// Without a surface.
    pub fn side_by_side(parts: Vec<Surface>) -> (Surface, Vec<Offset>) {
        let name = parts.first().expect("a surface has a part").name.clone();
        let origin = parts[0].origin;
        let mut at = Offset::default();
        let mut offsets = Vec::with_capacity(parts.len());
        let (mut points, mut triangles) = (Vec::new(), Vec::new());
        let (mut patch, mut uv, mut walls) = (Vec::new(), Vec::new(), Vec::new());
        let walled = parts.iter().any(|s| !s.carrier.walls.is_empty());
        let scaled = parts.iter().any(|s| !s.scale.is_empty());
        let directed = parts.iter().any(|s| !s.direction.is_empty());
        let mut all = Surface::bare(name, Carrier::default(), Vec::new(), 0.0);
        all.origin = origin;
        for part in parts {
            offsets.push(at);
            let (n, t) = (part.carrier.points.len(), part.carrier.triangles.len());
            all.loops.extend(part.loops.into_iter().map(|l| at.chain(l)));
            all.features.extend(part.features.into_iter().map(|l| at.chain(l)));
            all.fixed.extend(part.fixed.iter().map(|p| at.point(p)));
            all.area += part.area;
            for ((a, b), mut track) in part.tracks.iter() {
                track.curve = at.curve(track.curve);
                all.tracks.lay(a + at.points, b + at.points, track);
            }
            triangles.extend(part.carrier.triangles.iter().map(|c| c.map(|v| v + at.points)));
            patch.extend(part.carrier.patch.iter().map(|p| p + at.shapes));
            points.extend(part.carrier.points);
            uv.extend(part.carrier.uv);
            fill(walled, &mut walls, part.carrier.walls, t, [false; 3]);
            fill(scaled, &mut all.scale, part.scale, n, 1.0);
            fill(directed, &mut all.direction, part.direction, n, DVec3::ZERO);
            at.points += n as u32;
            at.triangles += t as u32;
            at.shapes += part.shapes.len() as u32;
            at.curves += part.curves.len() as u32;
            all.shapes.extend(part.shapes);
            all.curves.extend(part.curves);
            at.loops = all.loops.len() as u32;
            at.features = all.features.len() as u32;
        }
        all.carrier = Carrier::new(points, triangles, patch, uv);
        all.carrier.walls = walls;
        (all, offsets)
    }
}

/// Add what a part has, or `n` times what stands for nothing where others have something.
fn fill<T: Copy>(wanted: bool, all: &mut Vec<T>, part: Vec<T>, n: usize, nothing: T) {
    match (wanted, part.is_empty()) {
        (true, true) => all.extend(std::iter::repeat_n(nothing, n)),
        (true, false) => all.extend(part),
        (false, _) => {}
    }
}

impl Offset {
    /// A carrier point of the part, in the surface of all parts.
    pub fn point(&self, p: &SurfacePoint) -> SurfacePoint {
        SurfacePoint { triangle: p.triangle + self.triangles, ..*p }
    }

    fn curve(&self, curve: u32) -> u32 {
        if curve == u32::MAX { curve } else { curve + self.curves }
    }

    fn chain(&self, mut chain: Chain) -> Chain {
        for v in &mut chain.vertices {
            *v += self.points;
        }
        for segment in &mut chain.segments {
            segment.curve = self.curve(segment.curve);
            segment.triangle += self.triangles;
        }
        chain
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Job;
    use crate::surface::{Sampling, builtin};

    const SAMPLING: Sampling = Sampling { max_edge: 0.5, chord_error: 0.01, corner_angle: 0.5 };

    /// Two squares side by side that share an edge, and one apart.
    fn squares() -> Model {
        let points = [0.0, 1.0, 2.0, 4.0, 5.0].map(|x| [[x, 0.0, 0.0], [x, 1.0, 0.0]]).concat();
        let faces = vec![vec![6, 8, 9, 7], vec![0, 2, 3, 1], vec![2, 4, 5, 3]];
        let points = points.into_iter().map(DVec3::from).collect();
        Model::Mesh(PolygonMesh { name: "squares".into(), points, faces, ..PolygonMesh::default() })
    }

    #[test]
    fn faces_that_share_an_edge_are_one_part_and_others_are_not() {
        let model = squares();
        assert_eq!(model.parts(), [vec![0], vec![1, 2]]);
        let areas: Vec<f64> = model
            .parts()
            .iter()
            .map(|faces| model.of_faces(faces).surface(&SAMPLING, &Job::default()).unwrap().area)
            .collect();
        assert_eq!(areas, [1.0, 2.0]);
    }

    #[test]
    fn a_part_of_exact_faces_is_as_good_as_the_whole_where_there_is_one_only() {
        let model = builtin::model("great-court").unwrap();
        let parts = model.parts();
        assert_eq!(parts.len(), 1);
        let sampling = Sampling { max_edge: 5.0, ..SAMPLING };
        let (whole, part) = (
            model.surface(&sampling, &Job::default()),
            model.of_faces(&parts[0]).surface(&sampling, &Job::default()),
        );
        let (whole, part) = (whole.unwrap(), part.unwrap());
        assert!((whole.area / part.area - 1.0).abs() < 1e-12);
        assert_eq!(whole.loops.len(), part.loops.len());
    }

    #[test]
    fn surfaces_side_by_side_keep_their_points_and_loops() {
        let one =
            || builtin::model("hexagon").unwrap().surface(&SAMPLING, &Job::default()).unwrap();
        let saddle = builtin::model("saddle").unwrap();
        let saddle =
            saddle.surface(&Sampling { max_edge: 3.0, ..SAMPLING }, &Job::default()).unwrap();
        let (loops, area, triangle) = (saddle.loops.len(), saddle.area, 17);
        let p = SurfacePoint { triangle, bary: [0.2, 0.3, 0.5] };
        let (there, on_loop) = (saddle.exact(&p), saddle.loops[0].exact(&saddle, 1.0));
        let (all, offsets) = Surface::side_by_side(vec![one(), saddle]);
        assert_eq!(all.loops.len(), 1 + loops);
        assert!((all.area - one().area - area).abs() < 1e-9);
        assert_eq!(all.exact(&offsets[1].point(&p)), there);
        assert_eq!(all.loops[offsets[1].loops as usize].exact(&all, 1.0), on_loop);
        let euler = one().euler_characteristic() + 2 - loops as i64;
        assert_eq!(all.euler_characteristic(), euler);
    }
}
