//! A polygon mesh as design surface: faces split into triangles, long edges halved. The mesh is the
//! surface: nothing here moves a point or changes the shape (but for the choice of diagonals in faces that
//! are not plane).

pub(in crate::surface) mod caps;
mod facets;
mod plane;
pub(crate) mod triangulate;

use super::carrier::chain::boundary_loops;
use super::{Carrier, PREPARING, PolygonMesh, Sampling, Surface};
use crate::error::{Error, Result};
use crate::job::{Job, Picture};
use glam::DVec3;
use std::collections::{HashMap, HashSet};
use triangulate::split;

/// Memory that a triangle takes, about, bytes.
const BYTES_A_TRIANGLE: f64 = 300.0;
/// More triangles than this are refused: they would fill a small machine.
pub(super) const MAX_TRIANGLES: f64 = 4e6;
/// Edges are never halved below this share of the largest coordinate, where their middles would be their ends.
const FINEST: f64 = 1e-12;

impl PolygonMesh {
    /// The mesh as a surface, with no triangle edge longer than the sampling's longest.
    ///
    /// # Errors
    /// [`Error::Surface`] where there is no face, or the sampling is far too fine for the mesh.
    pub fn surface(&self, sampling: &Sampling, job: &Job) -> Result<Surface> {
        let mut points = self.points.clone();
        let (mut triangles, _) = self.split(&mut points);
        caps::flatten(&points, &mut triangles);
        if triangles.is_empty() {
            return Err(Error::Surface(format!("{}: the mesh has no faces", self.name)));
        }
        self.check_size(&points, &triangles, sampling.max_edge, job)?;
        job.check(PREPARING)?;
        job.progress("surface", 0.0, Picture::None);
        while let Some(finer) = halve(&mut points, &triangles, sampling.max_edge) {
            triangles = finer;
            job.check(PREPARING)?;
        }
        let area = triangles.iter().map(|t| area(&points, t)).sum();
        let patch = vec![0; triangles.len()];
        job.check(PREPARING)?;
        let carrier = Carrier::new(points, triangles, patch, Vec::new());
        job.check(PREPARING)?;
        let loops = boundary_loops(&carrier, sampling.corner_angle, |_, _| None);
        let surface = Surface::bare(self.name.clone(), carrier, loops, area);
        Ok(Surface { origin: self.origin, ..surface })
    }

    /// All faces in triangles. A face whose diagonal would double an edge of the mesh is split from its
    /// middle instead: between two vertices there is one edge only. With each triangle comes its face.
    pub(super) fn split(&self, points: &mut Vec<DVec3>) -> (Vec<[u32; 3]>, Vec<u32>) {
        let mut edges: HashSet<(u32, u32)> = HashSet::new();
        for face in &self.faces {
            edges.extend((0..face.len()).map(|k| sorted(face[k], face[(k + 1) % face.len()])));
        }
        let (mut triangles, mut face_of) = (Vec::new(), Vec::new());
        for (f, face) in self.faces.iter().enumerate() {
            let from = triangles.len();
            split(&self.points, face, &mut triangles);
            let diagonals = diagonals(face, &triangles[from..]);
            if diagonals.iter().any(|d| edges.contains(d)) {
                triangles.truncate(from);
                points.push(
                    face.iter().map(|&v| self.points[v as usize]).sum::<DVec3>()
                        / face.len() as f64,
                );
                let middle = points.len() as u32 - 1;
                triangles
                    .extend((0..face.len()).map(|k| [face[k], face[(k + 1) % face.len()], middle]));
            } else {
                edges.extend(diagonals);
            }
            face_of.resize(triangles.len(), f as u32);
        }
        (triangles, face_of)
    }

    /// Halving goes on by powers of two, so a triangle yields about as many as its edges hold `max_edge`,
    /// squared.
    fn check_size(
        &self,
        points: &[DVec3],
        triangles: &[[u32; 3]],
        max_edge: f64,
        job: &Job,
    ) -> Result<()> {
        let farthest = points.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        if max_edge <= FINEST * farthest {
            return Err(Error::Surface(format!(
                "{}: coordinates of {farthest:.3} m cannot tell points apart that are {max_edge:.1e} m from one another; \
                 choose a larger edge length, or check the unit of the mesh",
                self.name
            )));
        }
        let expected: f64 = triangles
            .iter()
            .map(|t| {
                let long = lengths(points, t).into_iter().fold(0.0, f64::max) / max_edge;
                let wide = 2.0 * area(points, t) / (max_edge * max_edge);
                1.0 + long + 2.0 * wide
            })
            .sum();
        if expected <= MAX_TRIANGLES {
            let what = format!("sampling the mesh every {max_edge:.3} m");
            job.reserve(expected * BYTES_A_TRIANGLE, &what)?;
            return Ok(());
        }
        Err(Error::Surface(format!(
            "{}: sampling the mesh every {max_edge:.3} m would take about {expected:.0} triangles; choose a larger \
             edge length, or scale the mesh if its unit is not the metre",
            self.name
        )))
    }
}

fn sorted(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

/// Edges of the triangles that are not edges of the face they make up.
fn diagonals(face: &[u32], triangles: &[[u32; 3]]) -> Vec<(u32, u32)> {
    if face.len() == 3 {
        return Vec::new();
    }
    let mut edges: Vec<(u32, u32)> =
        triangles.iter().flat_map(|t| [0, 1, 2].map(|k| sorted(t[k], t[(k + 1) % 3]))).collect();
    edges.sort_unstable();
    // A diagonal has a triangle on both sides.
    edges.chunk_by(|a, b| a == b).filter(|same| same.len() > 1).map(|same| same[0]).collect()
}

fn area(points: &[DVec3], t: &[u32; 3]) -> f64 {
    let [a, b, c] = t.map(|v| points[v as usize]);
    0.5 * (b - a).cross(c - a).length()
}

/// Length of the edge from corner k to corner k + 1.
fn lengths(points: &[DVec3], t: &[u32; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| points[t[k] as usize].distance(points[t[(k + 1) % 3] as usize]))
}

/// One round of halving every edge longer than `max_edge`; None when there is none. The longest edge of a
/// triangle is always among those halved, which keeps the angles from shrinking (Rivara 1984).
fn halve(points: &mut Vec<DVec3>, triangles: &[[u32; 3]], max_edge: f64) -> Option<Vec<[u32; 3]>> {
    let mut middles: HashMap<(u32, u32), u32> = HashMap::new();
    let mut finer = Vec::with_capacity(triangles.len() * 2);
    for t in triangles {
        let length = lengths(points, t);
        let mut middle = [None; 3];
        for k in 0..3 {
            let (a, b) = sorted(t[k], t[(k + 1) % 3]);
            // The length of an edge is the same, bit for bit, seen from both sides.
            if length[k] <= max_edge {
                continue;
            }
            middle[k] = Some(*middles.entry((a, b)).or_insert_with(|| {
                points.push((points[a as usize] + points[b as usize]) / 2.0);
                points.len() as u32 - 1
            }));
        }
        let longest = (0..3).fold(0, |best, k| if length[k] > length[best] { k } else { best });
        let turn = |k: usize| (longest + k) % 3;
        divide([0, 1, 2].map(|k| t[turn(k)]), [0, 1, 2].map(|k| middle[turn(k)]), &mut finer);
    }
    (!middles.is_empty()).then_some(finer)
}

/// Divide the triangle a b c by the middles of its edges a b (the longest), b c and c a.
pub(super) fn divide<T: Copy>([a, b, c]: [T; 3], middles: [Option<T>; 3], out: &mut Vec<[T; 3]>) {
    match middles {
        [Some(m), Some(n), Some(o)] => out.extend([[a, m, o], [m, b, n], [o, n, c], [m, n, o]]),
        [Some(m), Some(n), None] => out.extend([[a, m, c], [m, b, n], [m, n, c]]),
        [Some(m), None, Some(o)] => out.extend([[a, m, o], [m, b, c], [o, m, c]]),
        [Some(m), None, None] => out.extend([[a, m, c], [m, b, c]]),
        // Without the longest edge none is halved.
        _ => out.push([a, b, c]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    fn sampling(max_edge: f64) -> Sampling {
        Sampling { max_edge, chord_error: 0.01, corner_angle: 0.5 }
    }

    fn sheet(points: &[[f64; 3]], faces: &[&[u32]]) -> PolygonMesh {
        PolygonMesh {
            name: "sheet".into(),
            points: points.iter().map(|&p| p.into()).collect(),
            faces: faces.iter().map(|f| f.to_vec()).collect(),
            ..PolygonMesh::default()
        }
    }

    #[test]
    fn long_edges_are_halved_alike_on_both_sides_and_the_area_stays() {
        let mesh = sheet(
            &[
                [0.0, 0.0, 0.0],
                [7.0, 0.0, 1.0],
                [6.5, 5.0, 0.0],
                [-1.0, 4.0, 2.0],
                [20.0, 3.0, 0.0],
            ],
            &[&[0, 1, 2], &[0, 2, 3], &[1, 4, 2]],
        );
        let coarse = mesh.surface(&sampling(100.0), &Job::default()).expect("three triangles");
        let fine = mesh.surface(&sampling(0.7), &Job::default()).expect("many triangles");
        assert_eq!(coarse.carrier.triangles.len(), 3);
        assert!((coarse.area - fine.area).abs() < 1e-12 * coarse.area);
        assert_eq!(fine.loops.len(), 1);
        assert!((coarse.loops[0].length() - fine.loops[0].length()).abs() < 1e-12);
        assert_eq!(coarse.loops[0].corners.len(), fine.loops[0].corners.len());
        let mut uses: BTreeMap<(u32, u32), usize> = BTreeMap::new();
        for t in &fine.carrier.triangles {
            assert!(lengths(&fine.carrier.points, t).iter().all(|&l| l <= 0.7));
            for k in 0..3 {
                *uses.entry((t[k], t[(k + 1) % 3])).or_default() += 1;
            }
        }
        assert!(uses.values().all(|&n| n == 1));
        let edges = uses.keys().filter(|&&(a, b)| a < b || !uses.contains_key(&(b, a))).count();
        // Euler: V + F = E + 1 on a disc.
        assert_eq!(fine.carrier.points.len() + fine.carrier.triangles.len(), edges + 1);
    }

    #[test]
    fn a_mesh_no_larger_than_the_rounding_of_its_place_is_refused() {
        // A damaged GLB file's: the middle of an edge was one of its ends, and halving went on until the memory was full.
        let here = DVec3::new(1.0, 2.0, 3.0).to_array();
        let mesh = sheet(&[here, [1.0, 2.0, 3.0 + 4e-16], [1.0 + 2e-16, 2.0, 3.0]], &[&[0, 1, 2]]);
        let message =
            mesh.surface(&sampling(4e-17), &Job::default()).err().expect("an error").to_string();
        assert!(message.contains("cannot tell points apart"), "{message}");
    }

    #[test]
    fn sampling_far_too_fine_is_refused_before_it_fills_the_memory() {
        let mesh = sheet(&[[0.0, 0.0, 0.0], [1e6, 0.0, 0.0], [0.0, 1e6, 0.0]], &[&[0, 1, 2]]);
        let message =
            mesh.surface(&sampling(0.5), &Job::default()).err().expect("an error").to_string();
        assert!(message.contains("larger edge length"), "{message}");
    }
}
