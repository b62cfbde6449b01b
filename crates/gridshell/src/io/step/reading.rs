//! A STEP file's products, faces, edges and vertices brought together, each placed copy by itself.

use super::operators::Operators;
use super::owners;
use super::place::{placed, plain};
use super::shape;
use super::text::Text;
use crate::surface::brep::{Brep, BrepEdge, BrepFace, Coedge};
use crate::surface::nurbs::{FARTHEST, NurbsCurve, reach};
use crate::surface::{Curve, Loss};
use glam::{DMat4, DVec3};
use std::collections::{HashMap, HashSet};
use step_io::scene::{Bound, Edge, Face, MappedInstance, ProductDef, Scene, Vertex};
use step_io::{EntityKey, Orientation, Report, StepModel};

/// More faces, counted with every placed copy, are refused.
const MOST_FACES: usize = 100_000;
/// Assemblies nested deeper than this are cut off (some files contain themselves).
const MOST_LEVELS: usize = 32;
/// A closed edge begins at its vertex when nearer to it than this share of its curve's size.
const AT_VERTEX: f64 = 1e-7;
/// Two vertices at the ends of a closed curve are one place when nearer than this share of its size.
const SAME_PLACE: f64 = 1e-6;
/// Edges that follow each other in a loop may be this share of the loop's size apart.
const LOOP_GAP: f64 = 1e-2;

/// Placements are one whose axes differ by less than this share of the scale, and whose origins by so many metres.
const SAME_TURN: f64 = 1e-9;
const SAME_ORIGIN: f64 = 1e-6;

/// Longer loops are not put in order.
const MOST_STRUNG: usize = 10_000;

/// Where and what, of what ends the reading.
pub(super) type Fatal = (String, String);

/// A file while it is read.
pub(super) struct Reading<'m> {
    pub brep: Brep,
    model: &'m StepModel,
    /// Placements that mirror or scale.
    operators: Operators,
    /// Faces that some product placed, and where.
    seen: HashMap<EntityKey, Vec<DMat4>>,
    /// Mapped items of products.
    mapped_of: HashMap<EntityKey, Vec<EntityKey>>,
    /// Edges and vertices of each placed copy; None for an edge that is only a point.
    edges: HashMap<(usize, EntityKey), Option<u32>>,
    vertices: HashMap<(usize, EntityKey), u32>,
    /// Placed copies so far; 0 is for faces outside any product.
    copies: usize,
    /// Identifiers of faces in the file.
    names: HashMap<EntityKey, u64>,
    /// Faces that the file hides.
    hidden: HashSet<EntityKey>,
}

impl<'m> Reading<'m> {
    pub fn new(model: &'m StepModel, operators: Operators, unit_in_metres: f64) -> Reading<'m> {
        Reading {
            brep: Brep { unit_in_metres, ..Brep::default() },
            model,
            operators,
            seen: HashMap::new(),
            mapped_of: HashMap::new(),
            edges: HashMap::new(),
            vertices: HashMap::new(),
            copies: 0,
            names: HashMap::new(),
            hidden: HashSet::new(),
        }
    }

    /// Learn the identifiers of faces: the parser keeps faces of a kind in the order of the file.
    pub fn name_faces(&mut self, text: &Text, report: &Report) {
        let scene = self.model.scene();
        let faces: Vec<EntityKey> = scene.all_faces().map(|f| f.key()).collect();
        let ids = owners::kept(text, report, &["ADVANCED_FACE", "FACE_SURFACE"]);
        if ids.len() == faces.len() {
            self.names = faces.into_iter().zip(ids).collect();
        }
    }

    /// Learn which mapped items each product has.
    pub fn find_owners(&mut self, text: &Text, report: &Report) {
        let scene = self.model.scene();
        let owners = owners::of_mapped_items(text, report, &scene);
        for item in scene.all_mapped_instances() {
            if let Some(owner) = owners.get(&item.key()) {
                self.mapped_of.entry(*owner).or_default().push(item.key());
            }
        }
    }

    /// Learn which faces the file hides; all are read where it hides all of them.
    fn find_hidden(&mut self, scene: &Scene) {
        for solid in scene.all_solids().filter(|s| !s.is_visible()) {
            self.hidden.extend(solid.faces().map(|f| f.key()));
        }
        for sheet in scene.all_surface_models().filter(|s| !s.is_visible()) {
            self.hidden.extend(sheet.faces().map(|f| f.key()));
        }
        self.hidden.extend(scene.all_faces().filter(|f| !f.is_visible()).map(|f| f.key()));
        let all = scene.all_faces().count();
        if self.hidden.len() == all {
            self.hidden.clear();
        } else if !self.hidden.is_empty() {
            let count = self.hidden.len();
            self.note(format!("{count} hidden faces left out; show them in the program that wrote the file to read them"));
        }
    }

    pub fn note(&mut self, note: String) {
        self.brep.notes.push(note);
    }

    /// All faces: of products where they are placed, of mapped items, and those outside any of them.
    pub fn everything(&mut self, scene: &Scene) -> Result<(), Fatal> {
        self.find_hidden(scene);
        let metres = DMat4::from_scale(DVec3::splat(self.brep.unit_in_metres));
        for root in scene.root_definitions() {
            self.definition(&root, metres, 0)?;
        }
        let inner: HashSet<EntityKey> = scene
            .all_mapped_instances()
            .flat_map(|m| m.mapped_children().collect::<Vec<_>>())
            .map(|m| m.key())
            .collect();
        let owned: HashSet<EntityKey> = self.mapped_of.values().flatten().copied().collect();
        let loose = |m: &MappedInstance| !inner.contains(&m.key()) && !owned.contains(&m.key());
        // What a product has placed is not placed again by what belongs to none.
        let told: HashSet<EntityKey> = self.seen.keys().copied().collect();
        for item in scene.all_mapped_instances().filter(loose) {
            self.mapped(&item, metres, 0, &told)?;
        }
        for face in scene.all_faces() {
            if !self.seen.contains_key(&face.key()) {
                self.face(&face, metres, 0)?;
            }
        }
        Ok(())
    }

    /// The number of a new placed copy, or None where nesting is too deep.
    fn enter(&mut self, level: usize) -> Result<Option<usize>, Fatal> {
        if level > MOST_LEVELS {
            let note = "an assembly is nested too deep or contains itself: the rest is left out";
            if self.brep.notes.last().is_none_or(|n| n != note) {
                self.note(note.into());
            }
            return Ok(None);
        }
        self.copies += 1;
        if self.copies > MOST_FACES {
            return Err(("assembly".into(), format!("places more than {MOST_FACES} parts")));
        }
        Ok(Some(self.copies))
    }

    /// Everything in a product definition and the parts placed in it.
    fn definition(&mut self, part: &ProductDef, place: DMat4, level: usize) -> Result<(), Fatal> {
        let Some(copy) = self.enter(level)? else { return Ok(()) };
        for solid in part.solids() {
            for face in solid.faces() {
                self.face(&face, place, copy)?;
            }
            for (void, _) in solid.voids() {
                for face in void.faces() {
                    self.face(&face, place, copy)?;
                }
            }
        }
        for sheet in part.surface_models() {
            for face in sheet.faces() {
                self.face(&face, place, copy)?;
            }
        }
        for o in part.occurrences() {
            let Some(child) = o.definition() else { continue };
            match self.operators.of_part(o.transform()).map_err(str::to_owned) {
                Ok(local) => {
                    let local = local.unwrap_or(DMat4::IDENTITY);
                    self.definition(&child, place * local, level + 1)?;
                }
                Err(why) => self.lose_part(&child, &why),
            }
        }
        let scene = self.model.scene();
        let own = self.mapped_of.get(&part.key()).cloned().unwrap_or_default();
        for item in scene.all_mapped_instances().filter(|m| own.contains(&m.key())) {
            self.mapped(&item, place, level, &HashSet::new())?;
        }
        Ok(())
    }

    /// Tell that a part and all that is placed in it are left out.
    fn lose_part(&mut self, part: &ProductDef, why: &str) {
        let (mut faces, mut parts, mut met) = (Vec::new(), vec![*part], HashSet::new());
        while let Some(part) = parts.pop() {
            if !met.insert(part.key()) {
                continue;
            }
            faces
                .extend(part.solids().flat_map(|s| s.faces().map(|f| f.key()).collect::<Vec<_>>()));
            let sheets = part.surface_models();
            faces.extend(sheets.flat_map(|s| s.faces().map(|f| f.key()).collect::<Vec<_>>()));
            parts.extend(part.occurrences().filter_map(|o| o.definition()));
        }
        let name = part.product().map_or("", |p| p.name());
        self.lose(named("part", name), why.to_owned(), faces.into_iter());
    }

    /// Tell what is left out. Its faces count as seen.
    fn lose(&mut self, what: String, why: String, faces: impl Iterator<Item = EntityKey>) {
        let mut loss = Loss { what, why, whole: true, ..Loss::default() };
        for face in faces {
            self.seen.entry(face).or_default();
            loss.faces += 1;
        }
        self.brep.source.losses.push(loss);
    }

    /// Everything that a mapped item places, but for faces that are `told` already.
    fn mapped(
        &mut self,
        item: &MappedInstance,
        place: DMat4,
        level: usize,
        told: &HashSet<EntityKey>,
    ) -> Result<(), Fatal> {
        let solids = item.solids().flat_map(|s| s.faces().collect::<Vec<_>>());
        let sheets = item.surface_models().flat_map(|s| s.faces().collect::<Vec<_>>());
        let faces: Vec<Face> = solids.chain(sheets).filter(|f| !told.contains(&f.key())).collect();
        let children: Vec<MappedInstance> = item.mapped_children().collect();
        if faces.is_empty() && children.is_empty() {
            return Ok(());
        }
        let local = self.operators.of_mapped(item.transform()).map_err(str::to_owned);
        let local = match local.and_then(|l| l.ok_or("it has no placement that can be used".into()))
        {
            Ok(local) => local,
            Err(why) => {
                let name = named("mapped item", item.name());
                self.lose(name, why, faces.iter().map(Face::key));
                return Ok(());
            }
        };
        let Some(copy) = self.enter(level)? else { return Ok(()) };
        for face in &faces {
            self.face(face, place * local, copy)?;
        }
        for child in &children {
            self.mapped(child, place * local, level + 1, told)?;
        }
        Ok(())
    }

    /// One face; left out with a note where it cannot be used.
    fn face(&mut self, face: &Face, place: DMat4, copy: usize) -> Result<(), Fatal> {
        let places = self.seen.entry(face.key()).or_default();
        // Some files tell the same assembly both ways, by occurrences and by mapped items.
        if places.iter().any(|p| same_place(*p, place)) {
            return Ok(());
        }
        places.push(place);
        if self.hidden.contains(&face.key()) {
            return Ok(());
        }
        if self.brep.faces.len() >= MOST_FACES {
            return Err(("data section".into(), format!("more than {MOST_FACES} faces")));
        }
        match self.try_face(face, place, copy) {
            Ok(face) => self.brep.faces.push(face),
            Err(why) => {
                let id = self.names.get(&face.key()).map_or(String::new(), |id| format!(" #{id}"));
                let what = named(&format!("face{id}"), face.name());
                let loss = Loss { what, why, faces: 1, ..Loss::default() };
                self.brep.source.losses.push(loss);
            }
        }
        Ok(())
    }

    fn try_face(&mut self, face: &Face, place: DMat4, copy: usize) -> Result<BrepFace, String> {
        let mut loops = Vec::new();
        for bound in face.bounds() {
            let coedges = self.bound(&bound, place, copy)?;
            // A loop of a single vertex, or of edges without length, only marks a pole.
            if !coedges.is_empty() {
                let open = self.check_loop(&coedges);
                let strung = open.clone().err().and_then(|_| self.strung(&coedges));
                match strung {
                    Some(strung) => loops.push(strung),
                    None => loops.push(open.map(|()| coedges)?),
                }
            }
        }
        let points = self.control_points(&loops);
        let shape = shape::of_face(self.model, face, place, &points)?;
        let reversed = face.orientation() == Orientation::Reversed;
        let label = self.names.get(&face.key()).map(|id| format!("#{id}")).unwrap_or_default();
        let mut face = BrepFace { shape, loops, reversed, label };
        if place.determinant() < 0.0 {
            // Seen in a mirror the outside is against du x dv, and the surface to the right of its loops.
            face.reversed = !reversed;
            for coedges in &mut face.loops {
                flip(coedges);
            }
        }
        Ok(face)
    }

    fn bound(&mut self, bound: &Bound, place: DMat4, copy: usize) -> Result<Vec<Coedge>, String> {
        let mut coedges = Vec::new();
        let mut points = usize::from(bound.vertex().is_some());
        for (edge, orientation) in bound.oriented_edges() {
            let reversed = orientation == Orientation::Reversed;
            match self.edge(&edge, place, copy)? {
                Some(edge) => coedges.push(Coedge { edge, reversed }),
                None => points += 1,
            }
        }
        if coedges.is_empty() && points == 0 {
            return Err("a boundary loop is missing".into());
        }
        if bound.orientation() == Orientation::Reversed {
            flip(&mut coedges);
        }
        Ok(coedges)
    }

    /// Whether each edge begins where the last one ended.
    fn check_loop(&self, coedges: &[Coedge]) -> Result<(), String> {
        let ends = |c: &Coedge| {
            let [a, b] = self.brep.edges[c.edge as usize].ends;
            if c.reversed { [b, a] } else { [a, b] }
        };
        let at = |v: u32| self.brep.vertices[v as usize];
        let mut size = 0.0_f64;
        for c in coedges {
            let Curve::Nurbs(curve) = &self.brep.edges[c.edge as usize].curve else { continue };
            let first = at(ends(&coedges[0])[0]);
            size = curve.points.iter().fold(size, |s, p| s.max(p.distance(first)));
        }
        for (i, c) in coedges.iter().enumerate() {
            let (end, start) = (ends(c)[1], ends(&coedges[(i + 1) % coedges.len()])[0]);
            let gap = at(end).distance(at(start));
            if end != start && gap > LOOP_GAP * size {
                let p = at(end);
                return Err(format!(
                    "its loop has a gap of {gap:.4} m at ({:.4}, {:.4}, {:.4})",
                    p.x, p.y, p.z
                ));
            }
        }
        Ok(())
    }

    /// The same edges in the order and the ways in which they follow each other, where all of them do by their
    /// vertices: some programs write them as they come.
    fn strung(&self, coedges: &[Coedge]) -> Option<Vec<Coedge>> {
        let ends = |edge: u32| self.brep.edges[edge as usize].ends;
        let first = *coedges.first().filter(|_| coedges.len() <= MOST_STRUNG)?;
        let (mut rest, mut strung) = (coedges[1..].to_vec(), vec![first]);
        let start = ends(first.edge)[usize::from(first.reversed)];
        let mut at = ends(first.edge)[usize::from(!first.reversed)];
        while !rest.is_empty() {
            let next = rest.iter().position(|c| ends(c.edge).contains(&at))?;
            let edge = rest.remove(next).edge;
            let reversed = ends(edge)[0] != at;
            at = ends(edge)[usize::from(!reversed)];
            strung.push(Coedge { edge, reversed });
        }
        (at == start).then_some(strung)
    }

    fn control_points(&self, loops: &[Vec<Coedge>]) -> Vec<DVec3> {
        let curve = |c: &Coedge| match &self.brep.edges[c.edge as usize].curve {
            Curve::Nurbs(curve) => curve.points.clone(),
            _ => Vec::new(),
        };
        loops.iter().flatten().flat_map(curve).collect()
    }

    /// The edge; None where it is only a point.
    fn edge(&mut self, edge: &Edge, place: DMat4, copy: usize) -> Result<Option<u32>, String> {
        let key = (copy, edge.key());
        if let Some(&known) = self.edges.get(&key) {
            return Ok(known);
        }
        let mut end =
            |v: Option<Vertex>| self.vertex(v, place, copy).ok_or("an edge has no vertex in reach");
        let ends = [end(edge.start())?, end(edge.end())?];
        let closed = ends[0] == ends[1];
        let at = self.brep.vertices[ends[0] as usize];
        let Some(curve) = edge.to_nurbs() else {
            // From a vertex to itself along what does not close: of no length.
            if closed {
                self.edges.insert(key, None);
                return Ok(None);
            }
            return Err("an edge has no exact form here".into());
        };
        let points = placed(curve.control_points.iter(), place)?;
        if closed && points.iter().all(|&p| p == points[0]) {
            self.edges.insert(key, None);
            return Ok(None);
        }
        let curve = NurbsCurve::new(curve.degree, curve.knots, points, plain(curve.weights))
            .map_err(|e| format!("an edge: {e}"))?;
        // Two vertices at one place part a closed curve as one does.
        let apart = at.distance(self.brep.vertices[ends[1] as usize]);
        let size = curve.points.iter().fold(0.0_f64, |s, p| s.max(p.distance(at)));
        let closed = closed || curve.closed() && apart <= SAME_PLACE * size;
        // The parser hands on whole closed curves as they stand, whichever way the edge runs.
        let curve = if closed && !edge.same_sense() { backwards(&curve) } else { curve };
        let range = if closed { range_from(&curve, at) } else { curve.domain() };
        self.brep.edges.push(BrepEdge { curve: Curve::Nurbs(curve), range, ends });
        let id = self.brep.edges.len() as u32 - 1;
        self.edges.insert(key, Some(id));
        Ok(Some(id))
    }

    fn vertex(&mut self, vertex: Option<Vertex>, place: DMat4, copy: usize) -> Option<u32> {
        let vertex = vertex?;
        let key = (copy, vertex.key());
        if let Some(&known) = self.vertices.get(&key) {
            return Some(known);
        }
        let at = reach(place.transform_point3(vertex.point()?.xyz().into()), FARTHEST).ok()?;
        self.brep.vertices.push(at);
        let id = self.brep.vertices.len() as u32 - 1;
        self.vertices.insert(key, id);
        Some(id)
    }
}

/// Run the other way.
fn flip(coedges: &mut [Coedge]) {
    coedges.reverse();
    for c in coedges {
        c.reversed = !c.reversed;
    }
}

fn same_place(a: DMat4, b: DMat4) -> bool {
    let axes = |m: DMat4| [m.x_axis, m.y_axis, m.z_axis];
    let scale = b.x_axis.length();
    let alike = axes(a).into_iter().zip(axes(b));
    a.w_axis.abs_diff_eq(b.w_axis, SAME_ORIGIN)
        && alike.into_iter().all(|(a, b)| a.abs_diff_eq(b, SAME_TURN * scale))
}

/// What it is, with its name.
pub(super) fn named(what: &str, name: &str) -> String {
    if name.is_empty() { what.to_owned() } else { format!("{what} '{name}'") }
}

/// The same curve run from its end to its start.
fn backwards(curve: &NurbsCurve) -> NurbsCurve {
    let mut back = curve.clone();
    back.points.reverse();
    back.weights.reverse();
    back.knots = curve.knots.iter().rev().map(|k| -k).collect();
    back
}

/// The range of a closed curve that begins and ends at `at`.
fn range_from(curve: &NurbsCurve, at: DVec3) -> [f64; 2] {
    let [a, b] = curve.domain();
    let whole = Curve::Nurbs(curve.clone());
    let probe = |i: i32| a + (b - a) * f64::from(i) / 64.0;
    let size = (0..64).map(|i| curve.point(probe(i)).distance(at)).fold(0.0, f64::max);
    if !curve.closed() || curve.point(a).distance(at) <= AT_VERTEX * size {
        return [a, b];
    }
    let near = (0..64)
        .map(probe)
        .min_by(|&s, &t| curve.point(s).distance(at).total_cmp(&curve.point(t).distance(at)))
        .unwrap_or(a);
    let (t, _) = whole.project(near, [a, b], at);
    [t, t + (b - a)]
}
