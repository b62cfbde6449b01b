//! Meshes of a Rhino file: objects that are meshes, and what exact objects are shown by where they cannot be read
//! themselves. Beside exact surfaces each triangle becomes a plane face.

use super::Reading;
use super::convert;
use crate::io::mesh::soup::Soup;
use crate::io::{Choice, LengthUnit, Opening, mesh};
use crate::job::Job;
use crate::surface::brep::{BrepEdge, BrepFace, Coedge};
use crate::surface::nurbs::{NurbsCurve, NurbsSurface};
use crate::surface::{Curve, Loss, PolygonMesh, Shape, polygon::triangulate};
use cadmpeg_ir::tessellation::Tessellation;
use glam::DVec3;
use std::collections::BTreeMap;
use std::path::Path;

/// More triangles than this are not laid beside exact surfaces: each would be a face to sew and sample, at about a
/// thousand times the cost of a triangle of a mesh.
const MOST_FACETS: usize = 20_000;
/// What an object is shown by, in the order in which it is asked.
const SHOWN_BY: [&str; 3] = [".render-", ".cache-", ".analysis-"];

/// Triangles of an object.
pub(super) struct Meshed {
    pub object: usize,
    pub points: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
    /// Why they stand for exact faces, and for how many (0 where it is not known); None for a mesh of its own right.
    pub instead: Option<(String, usize)>,
}

impl Meshed {
    fn new(object: usize, instead: Option<(String, usize)>) -> Meshed {
        Meshed { object, points: Vec::new(), triangles: Vec::new(), instead }
    }

    fn add(&mut self, mesh: &Tessellation) {
        let first = self.points.len() as u32;
        self.points.extend(mesh.vertices().iter().map(|p| convert::point(**p)));
        self.triangles.extend(mesh.triangles().iter().map(|t| t.map(|v| v + first)));
    }

    fn area(&self) -> f64 {
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| self.points[v as usize]);
            0.5 * (b - a).cross(c - a).length()
        };
        self.triangles.iter().map(area).sum()
    }

    fn soup(&self) -> Soup {
        let faces = self.triangles.iter().map(|t| t.to_vec()).collect();
        // The decoder has brought it to metres.
        Soup {
            points: self.points.clone(),
            faces,
            unit: Some(LengthUnit::Metre),
            ..Soup::default()
        }
    }
}

impl Reading<'_> {
    /// The meshes among the taken objects, and those in the place of faces that could not be read.
    pub(super) fn meshes(&mut self) {
        let arenas = self.arenas;
        let mut of: BTreeMap<usize, Vec<&Tessellation>> = BTreeMap::new();
        for mesh in &arenas.tessellations {
            let Some(owner) = &mesh.source_object else { continue };
            let object = self.object(owner, "mesh");
            of.entry(object).or_default().push(mesh);
        }
        for object in 0..self.listed.len() {
            if !self.taken[object] || self.unread.contains_key(&object) {
                continue;
            }
            let shown_by = of.get(&object).map_or(&[][..], Vec::as_slice);
            match self.listed[object].kind.as_str() {
                "SubD" => {}
                "mesh" => {
                    let mut mesh = Meshed::new(object, None);
                    for m in shown_by {
                        mesh.add(m);
                    }
                    self.meshed.push(mesh);
                }
                _ => self.instead(object, shown_by),
            }
        }
    }

    /// What an exact object is shown by, in the place of its faces that could not be read.
    fn instead(&mut self, object: usize, shown_by: &[&Tessellation]) {
        let failed = self.failed.remove(&object).unwrap_or_default();
        let none_read = self.listed[object].faces == 0;
        if failed.is_empty() && !none_read {
            return;
        }
        let why = failed.first().map_or("its data could not be understood", |(_, why)| why);
        let mut mesh = Meshed::new(object, Some((why.to_owned(), failed.len())));
        let mut lost = 0;
        if none_read {
            let one =
                SHOWN_BY.iter().find(|by| shown_by.iter().any(|m| m.id.as_str().contains(**by)));
            let all = shown_by.iter().filter(|m| one.is_some_and(|by| m.id.as_str().contains(by)));
            all.for_each(|m| mesh.add(m));
        } else {
            for (id, _) in &failed {
                match shown_by.iter().find(|m| shows(m.id.as_str(), id)) {
                    Some(m) => mesh.add(m),
                    None => lost += 1,
                }
            }
        }
        let nothing = mesh.triangles.is_empty();
        if lost > 0 || nothing {
            let told = self.listed[object].told();
            let what = if none_read { told } else { format!("{lost} faces of {told}") };
            let faces = if none_read { failed.len() } else { lost };
            let why = format!("{why}; open it in Rhino and save it again, or export it as STEP");
            self.losses.push(Loss { what, why, faces, area: None, whole: none_read });
        }
        if !nothing {
            self.meshed.push(mesh);
        }
    }

    /// All meshes as one, where nothing else was read.
    pub(super) fn soup(&mut self) -> Soup {
        let mut all = Meshed::new(0, None);
        for mesh in std::mem::take(&mut self.meshed) {
            self.tell_instead(&mesh);
            let first = all.points.len() as u32;
            all.points.extend(&mesh.points);
            all.triangles.extend(mesh.triangles.iter().map(|t| t.map(|v| v + first)));
            self.listed[mesh.object].faces += mesh.triangles.len();
        }
        all.soup()
    }

    /// Meshes beside exact surfaces: triangles in the place of exact faces, and what was asked for by name, become
    /// plane faces; meshes beside them are told.
    pub(super) fn beside(&mut self, path: &Path, choice: &Choice, job: &Job) {
        for mesh in std::mem::take(&mut self.meshed) {
            let why = if mesh.instead.is_none() && choice.is_all() {
                "it is a mesh beside exact surfaces; choose it by layer or name to read it"
                    .to_owned()
            } else if mesh.triangles.len() > MOST_FACETS {
                format!(
                    "it has more than {MOST_FACETS} triangles; choose it alone, by layer or name, to read it"
                )
            } else {
                match mesh::weld(path, mesh.soup(), &Opening::default(), job) {
                    Ok(welded) => {
                        self.tell_instead(&mesh);
                        self.facets(mesh.object, &welded);
                        continue;
                    }
                    Err(fault) => fault.to_string(),
                }
            };
            let what = self.listed[mesh.object].told();
            let whole = self.listed[mesh.object].faces == 0;
            let area = Some(mesh.area());
            self.losses.push(Loss { what, why, faces: mesh.triangles.len(), area, whole });
        }
    }

    fn tell_instead(&mut self, mesh: &Meshed) {
        let Some((why, faces)) = &mesh.instead else { return };
        let told = self.listed[mesh.object].told();
        let faces = match faces {
            0 => String::new(),
            1 => "1 face of ".to_owned(),
            n => format!("{n} faces of "),
        };
        let count = mesh.triangles.len();
        self.brep.notes.push(format!(
            "{faces}{told} could not be read exactly ({why}); the {count} triangles that Rhino shows are taken instead"
        ));
    }

    /// The faces of a mesh as plane faces that share edges.
    fn facets(&mut self, object: usize, mesh: &PolygonMesh) {
        let first = self.brep.vertices.len() as u32;
        self.brep.vertices.extend(&mesh.points);
        let mut edges: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        let mut triangles = Vec::new();
        mesh.faces.iter().for_each(|face| triangulate::split(&mesh.points, face, &mut triangles));
        for t in triangles {
            let Some(shape) = plane(t.map(|v| mesh.points[v as usize])) else { continue };
            let sides = [0, 1, 2].map(|k| (t[k], t[(k + 1) % 3]));
            let coedges = sides.map(|(a, b)| {
                let (from, to) = (a.min(b), a.max(b));
                let edge = *edges.entry((from, to)).or_insert_with(|| {
                    let [p, q] = [from, to].map(|v| mesh.points[v as usize]);
                    let curve = Curve::Nurbs(NurbsCurve::line(p, q));
                    let ends = [from + first, to + first];
                    self.brep.edges.push(BrepEdge { curve, range: [0.0, 1.0], ends });
                    self.brep.edges.len() as u32 - 1
                });
                Coedge { edge, reversed: a > b }
            });
            let loops = vec![coedges.to_vec()];
            self.brep.faces.push(BrepFace { shape, loops, reversed: false, label: String::new() });
            self.brep.object_of.push(object as u32);
            self.listed[object].faces += 1;
        }
    }
}

/// The plane through three points; None where they lie on a line.
fn plane([a, b, c]: [DVec3; 3]) -> Option<Shape> {
    if (b - a).cross(c - a) == DVec3::ZERO {
        return None;
    }
    let knots = || vec![0.0, 0.0, 1.0, 1.0];
    let points = vec![a, c, b, b + (c - a)];
    let plane = NurbsSurface::new([1, 1], [knots(), knots()], [2, 2], points, Vec::new());
    plane.ok().map(Shape::Nurbs)
}

/// Whether a mesh is what a face is shown by: both end with the face's place in its brep.
fn shows(mesh: &str, face: &str) -> bool {
    let place = |id: &str, by: &str| id.rsplit_once(by).map(|(_, place)| place.to_owned());
    let face = place(face, ".slot-");
    face.is_some() && face == place(mesh, SHOWN_BY[0])
}
