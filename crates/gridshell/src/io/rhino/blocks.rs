//! Blocks: what is drawn once and placed many times. The decoder gives up a block where it cannot place one curve of
//! it, so here the members are read by themselves, from the file without its table of definitions, and placed.

use super::Reading;
use super::convert::{METRES, Read};
use super::meshes::Meshed;
use super::objects::{ADVICE, records};
use super::table::{Kind, Row};
use crate::io::Choice;
use crate::surface::brep::{Brep, BrepEdge, BrepFace, Coedge};
use crate::surface::nurbs::{NurbsCurve, NurbsSurface};
use crate::surface::{Curve, Loss, Shape};
use cadmpeg_ir::{CadIr, NativeRecord};
use glam::{DAffine3, DMat3, DVec3};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// Blocks in blocks are followed so deep.
const MOST_LEVELS: usize = 32;
/// More places than this come of blocks that hold each other.
const MOST_PLACES: usize = 100_000;

/// Definitions of blocks and where they are placed.
#[derive(Default)]
pub(super) struct Blocks {
    definitions: BTreeMap<String, Definition>,
    /// Blocks that are placed, among them those within others.
    placed: BTreeMap<String, Placed>,
    /// Objects that belong to definitions: they are seen where those are placed.
    members: BTreeSet<String>,
}

struct Definition {
    members: Vec<String>,
    /// Its contents lie in another file.
    elsewhere: bool,
}

struct Placed {
    definition: String,
    place: DAffine3,
    shown: bool,
}

/// A place of a member of a block.
#[derive(Clone)]
pub(super) struct Place {
    member: String,
    at: DAffine3,
    pub shown: bool,
}

impl Blocks {
    /// What the decoder tells of a file.
    pub fn of(ir: &CadIr) -> Blocks {
        let text =
            |record: &NativeRecord, field: &str| record.field(field)?.as_str().map(str::to_owned);
        let mut blocks = Blocks::default();
        for record in records(ir, "product_definitions") {
            let Some(id) = text(record, "source_uuid") else { continue };
            let listed = record.field("member_object_ids").unwrap_or_default();
            let listed = listed.as_array().into_iter().flatten();
            let members: Vec<String> =
                listed.filter_map(|v| v.as_str().map(str::to_owned)).collect();
            blocks.members.extend(members.iter().cloned());
            let elsewhere = text(record, "external_reference").is_some();
            blocks.definitions.insert(id, Definition { members, elsewhere });
        }
        for record in records(ir, "product_occurrences") {
            let millimetres = text(record, "transform_units").as_deref() == Some("millimeter");
            let ids = [text(record, "source_uuid"), text(record, "definition_uuid")];
            let place = transform(record).filter(|_| millimetres);
            if let ([Some(id), Some(definition)], Some(place)) = (ids, place) {
                let shown = record.field("visible").and_then(|v| v.as_bool()) != Some(false);
                blocks.placed.insert(id, Placed { definition, place, shown });
            }
        }
        blocks
    }

    fn definition(&self, placed: &str) -> Option<&Definition> {
        self.definitions.get(&self.placed.get(placed)?.definition)
    }

    /// Why nothing of a block can be read; None where something can, or there are no surfaces in it.
    pub fn why(&self, row: &Row, table: &[Row]) -> Option<String> {
        if self.members.contains(&row.id) {
            return None;
        }
        match self.definition(&row.id) {
            None => Some(format!("what it is made of is not in the file; {ADVICE}")),
            Some(of) if of.elsewhere && of.members.is_empty() => {
                Some("it lies in another file; embed it, or open that file".into())
            }
            Some(of) => {
                let known = |id: &String| table.iter().any(|row| row.id == *id);
                let missing = !of.members.is_empty() && !of.members.iter().any(known);
                missing.then(|| format!("what it is made of is not in the file; {ADVICE}"))
            }
        }
    }

    /// Where the members of the blocks are placed, in the order of the file.
    pub fn places(&self, table: &[Row]) -> Vec<Place> {
        let kinds: BTreeMap<&str, Kind> = table.iter().map(|r| (r.id.as_str(), r.kind)).collect();
        let mut places = Vec::new();
        let alone = |row: &&Row| row.kind == Kind::Block && !self.members.contains(&row.id);
        for row in table.iter().filter(alone) {
            self.follow(&row.id, (DAffine3::IDENTITY, true), 0, &kinds, &mut places);
        }
        places
    }

    fn follow(
        &self,
        id: &str,
        (above, shown): (DAffine3, bool),
        level: usize,
        kinds: &BTreeMap<&str, Kind>,
        places: &mut Vec<Place>,
    ) {
        let Some(placed) = self.placed.get(id).filter(|_| level < MOST_LEVELS) else { return };
        let Some(definition) = self.definitions.get(&placed.definition) else { return };
        let (place, shown) = (above * placed.place, shown && placed.shown);
        for member in &definition.members {
            if places.len() >= MOST_PLACES {
                return;
            }
            if kinds.get(member.as_str()) == Some(&Kind::Block) {
                self.follow(member, (place, shown), level + 1, kinds, places);
            } else {
                places.push(Place { member: member.clone(), at: place, shown });
            }
        }
    }
}

/// Rows of four numbers, in millimetres, as a place in metres.
fn transform(record: &NativeRecord) -> Option<DAffine3> {
    let field = record.field("transform")?;
    let rows = field.as_array()?;
    let at = |r: usize, c: usize| rows.get(r)?.as_array()?.get(c)?.as_f64();
    let column = |c: usize| Some(DVec3::new(at(0, c)?, at(1, c)?, at(2, c)?));
    let matrix = DMat3::from_cols(column(0)?, column(1)?, column(2)?);
    let place = DAffine3::from_mat3_translation(matrix, column(3)? * METRES);
    (place.is_finite() && matrix.determinant() != 0.0).then_some(place)
}

impl Reading<'_> {
    /// Members of blocks among the listed objects, with their places.
    pub(super) fn members(&self) -> BTreeMap<usize, Vec<Place>> {
        let mut members: BTreeMap<usize, Vec<Place>> = BTreeMap::new();
        let number = |id: &String| self.number.get(&(Vec::new(), id.clone())).copied();
        for member in self.blocks.members.iter().filter_map(number) {
            members.insert(member, Vec::new());
        }
        for place in &self.places {
            if let Some(of) = number(&place.member).and_then(|k| members.get_mut(&k)) {
                of.push(place.clone());
            }
        }
        members
    }

    /// Put a copy of what was read of each member of a block at each of its places that is taken.
    pub(super) fn place(&mut self, choice: &Choice) {
        let members = self.members();
        if members.is_empty() {
            return;
        }
        let mut faces_of: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for (&object, f) in self.brep.object_of.iter().zip(0..) {
            faces_of.entry(object).or_default().push(f);
        }
        let notes = std::mem::take(&mut self.brep.notes);
        let unit_in_metres = self.brep.unit_in_metres;
        let new = Brep { unit_in_metres, notes, ..Brep::default() };
        let old = std::mem::replace(&mut self.brep, new);
        let meshed = std::mem::take(&mut self.meshed);
        let listed = std::mem::take(&mut self.listed);
        for (k, mut object) in listed.into_iter().enumerate() {
            let faces = faces_of.remove(&(k as u32)).unwrap_or_default();
            let meshes = || meshed.iter().filter(|mesh| mesh.object == k);
            let Some(places) = members.get(&k) else {
                let number = self.listed.len();
                self.listed.push(object);
                let _ = copy(&mut self.brep, &old, &faces, None, number);
                self.meshed.extend(meshes().map(|mesh| mesh.placed(number, None)));
                continue;
            };
            let read = object.faces > 0 || meshes().next().is_some();
            for place in places {
                if read && !choice.takes(&object, place.shown && self.shown[k]) {
                    continue;
                }
                let number = self.listed.len();
                let copied = copy(&mut self.brep, &old, &faces, Some(&place.at), number);
                if let Err(why) = copied {
                    let (what, faces) = (object.told(), std::mem::take(&mut object.faces));
                    self.losses.push(Loss { what, why, faces, area: None, whole: true });
                }
                self.listed.push(object.clone());
                self.meshed.extend(meshes().map(|mesh| mesh.placed(number, Some(&place.at))));
            }
        }
    }
}

impl Meshed {
    /// A copy of another object, at a place.
    fn placed(&self, object: usize, place: Option<&DAffine3>) -> Meshed {
        let put = |p: &DVec3| place.map_or(*p, |place| place.transform_point3(*p));
        let mirrored = place.is_some_and(|place| place.matrix3.determinant() < 0.0);
        let turn = |&[a, b, c]: &[u32; 3]| if mirrored { [a, c, b] } else { [a, b, c] };
        Meshed {
            object,
            points: self.points.iter().map(put).collect(),
            triangles: self.triangles.iter().map(turn).collect(),
            instead: self.instead.clone(),
        }
    }
}

/// Add these faces of another brep, at a place. A mirrored face keeps its parameters, so its outside is the other side.
fn copy(
    to: &mut Brep,
    from: &Brep,
    faces: &[u32],
    place: Option<&DAffine3>,
    object: usize,
) -> Read<()> {
    let put = |p: DVec3| place.map_or(p, |place| place.transform_point3(p));
    let (mut edges, mut vertices) = (BTreeMap::new(), BTreeMap::new());
    let mut new = Vec::new();
    for &f in faces {
        let face = &from.faces[f as usize];
        let mut loops = face.loops.clone();
        for Coedge { edge, .. } in loops.iter_mut().flatten() {
            let old = &from.edges[*edge as usize];
            if let Some(&known) = edges.get(edge) {
                *edge = known;
                continue;
            }
            let ends = old.ends.map(|v| {
                *vertices.entry(v).or_insert_with(|| {
                    to.vertices.push(put(from.vertices[v as usize]));
                    to.vertices.len() as u32 - 1
                })
            });
            let curve = placed_curve(&old.curve, place)?;
            to.edges.push(BrepEdge { curve, range: old.range, ends });
            edges.insert(*edge, to.edges.len() as u32 - 1);
            *edge = to.edges.len() as u32 - 1;
        }
        let shape = placed_shape(&face.shape, place)?;
        new.push(BrepFace { shape, loops, reversed: face.reversed, label: face.label.clone() });
    }
    to.object_of.extend(new.iter().map(|_| object as u32));
    to.faces.extend(new);
    Ok(())
}

fn placed_shape(shape: &Shape, place: Option<&DAffine3>) -> Read<Shape> {
    let (Some(place), Shape::Nurbs(s)) = (place, shape) else { return Ok(shape.clone()) };
    let points = s.points.iter().map(|p| place.transform_point3(*p)).collect();
    NurbsSurface::new(s.degree, s.knots.clone(), s.count, points, s.weights.clone())
        .map(Shape::Nurbs)
        .map_err(|e| e.to_string())
}

fn placed_curve(curve: &Curve, place: Option<&DAffine3>) -> Read<Curve> {
    let Some(at) = place else { return Ok(curve.clone()) };
    match curve {
        Curve::Nurbs(c) => {
            let points = c.points.iter().map(|p| at.transform_point3(*p)).collect();
            NurbsCurve::new(c.degree, c.knots.clone(), points, c.weights.clone())
                .map(Curve::Nurbs)
                .map_err(|e| e.to_string())
        }
        Curve::OnShape(shape, uv) => {
            Ok(Curve::OnShape(Arc::new(placed_shape(shape, place)?), uv.clone()))
        }
        Curve::UvLine { .. } | Curve::Guide { .. } => Ok(curve.clone()),
    }
}
