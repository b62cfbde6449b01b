//! Which objects a file holds: those that the decoder made something of, and those that it dropped.

use super::Reading;
use super::table::{Kind, Row};
use crate::io::Choice;
use crate::surface::{Loss, Object};
use cadmpeg_ir::topology::Face;
use cadmpeg_ir::{
    CadIr, NativeRecord, SourceGeometryRole as Role, SourceObjectAssociation as Owner,
};
use std::collections::BTreeSet;

/// What to do about an object that cannot be read.
pub(super) const ADVICE: &str = "open it in Rhino and save it again, or export it as STEP";

impl<'a> Reading<'a> {
    /// List all objects that hold faces.
    pub(super) fn objects(&mut self) {
        let arenas = self.arenas;
        let mut used: Vec<&str> = Vec::new();
        for face in &arenas.faces {
            used.push(face.surface.as_str());
            if let Some(owner) = self.owner(face) {
                self.object(owner, "brep");
            }
        }
        used.sort_unstable();
        for surface in &arenas.surfaces {
            if let Some(owner) = loose(surface.source_object.as_ref(), surface.id.as_str(), &used) {
                let kind =
                    if surface.id.as_str().contains(".lateral-") { "extrusion" } else { "surface" };
                self.object(owner, kind);
            }
        }
        for subd in &arenas.subds {
            if let Some(owner) = &subd.source_object {
                let object = self.object(owner, Kind::SubD.told());
                // One that is hidden in a mesh is read in its place.
                Kind::SubD.told().clone_into(&mut self.listed[object].kind);
            }
        }
        for mesh in &arenas.tessellations {
            // What an exact object is shown by is not an object of its own.
            if let Some(owner) = &mesh.source_object {
                self.object(owner, "mesh");
            }
        }
        self.dropped();
    }

    /// The number of an object, listed now if it is not yet. What the file's own table calls it goes before `kind`.
    pub(super) fn object(&mut self, owner: &Owner, kind: &str) -> usize {
        let key = (owner.instance_path.clone(), owner.object_id.to_string());
        if let Some(&known) = self.number.get(&key) {
            return known;
        }
        let id = owner.layer.clone().unwrap_or_default();
        let known = self.layers.get(&id);
        let shown = owner.visible != Some(false) && known.is_none_or(|layer| layer.shown);
        let layer = known.map_or(id.clone(), |layer| layer.path.clone());
        let name = owner.name.clone().unwrap_or_default();
        let row = self.table.iter().find(|row| row.id == key.1 && row.kind != Kind::Other);
        let kind = row.map_or(kind, |row| row.kind.told()).to_owned();
        self.listed.push(Object { name, layer, kind, faces: 0 });
        self.shown.push(shown);
        self.number.insert(key, self.listed.len() - 1);
        self.listed.len() - 1
    }

    pub(super) fn owner(&self, face: &Face) -> Option<&'a Owner> {
        let surfaces = &self.arenas.surfaces;
        // Arenas are sorted by identifier.
        let k = surfaces.binary_search_by(|s| s.id.as_str().cmp(face.surface.as_str())).ok()?;
        surfaces[k].source_object.as_ref()
    }

    /// List the objects of the file's own table that the decoder made nothing of.
    fn dropped(&mut self) {
        let mut seen: BTreeSet<&str> = BTreeSet::new();
        for (path, id) in self.number.keys() {
            seen.insert(id);
            seen.extend(path.iter().map(String::as_str));
        }
        let hidden = self.hidden();
        let lost = |row: &&Row| {
            let is_lost = row.kind != Kind::Other && !row.id.is_empty();
            is_lost && !seen.contains(row.id.as_str())
        };
        let mut found = Vec::new();
        for row in self.table.iter().filter(lost) {
            let why = match row.kind {
                Kind::Block => self.blocks.why(row, &self.table),
                _ => Some(format!("its data could not be understood; {ADVICE}")),
            };
            let Some(why) = why else { continue };
            let layer = self.layers.values().find(|layer| layer.index == i64::from(row.layer));
            let shown = !hidden.contains(&row.id) && layer.is_none_or(|layer| layer.shown);
            let layer = layer.map(|layer| layer.path.clone()).unwrap_or_default();
            let kind = row.kind.told().to_owned();
            let object = Object { name: row.name.clone(), layer, kind, faces: 0 };
            found.push((row.id.clone(), object, shown, why));
        }
        for (id, object, shown, why) in found {
            self.unread.insert(self.listed.len(), why);
            self.number.insert((Vec::new(), id), self.listed.len());
            self.listed.push(object);
            self.shown.push(shown);
        }
    }

    /// Objects that are hidden, whatever their layers.
    fn hidden(&self) -> BTreeSet<String> {
        let of = |id: &str| id.rsplit_once('#').map(|(_, id)| id.to_owned());
        records(self.ir, "object_presentation")
            .filter(|record| record.field("visible").and_then(|v| v.as_bool()) == Some(false))
            .filter_map(|record| of(record.id()))
            .collect()
    }

    /// Take the chosen objects, or those that are shown; members of blocks where one of their places is taken.
    pub(super) fn choose(&mut self, choice: &Choice) {
        let mut hidden = 0;
        let members = self.members();
        for (k, object) in self.listed.iter().enumerate() {
            let shown: Vec<bool> = match members.get(&k) {
                Some(places) => places.iter().map(|p| p.shown && self.shown[k]).collect(),
                None => vec![self.shown[k]],
            };
            let taken = shown.iter().any(|&shown| choice.takes(object, shown));
            hidden += usize::from(!taken && shown.iter().any(|&shown| !shown));
            self.taken.push(taken);
        }
        if hidden > 0 && choice.is_all() {
            self.brep.notes.push(format!(
                "{hidden} hidden objects left out; choose them by layer or name to read them"
            ));
        }
    }

    /// What was taken, and could not be read at all.
    pub(super) fn lose_unread(&mut self) {
        for (&object, why) in self.unread.iter().filter(|(object, _)| self.taken[**object]) {
            let what = self.listed[object].told();
            self.losses.push(Loss { what, why: why.clone(), whole: true, ..Loss::default() });
        }
        for subd in &self.arenas.subds {
            let Some(owner) = &subd.source_object else { continue };
            let object = self.object(owner, Kind::SubD.told());
            if self.taken[object] {
                let cage = serde_json::to_value(&subd.cage).unwrap_or_default();
                let faces = cage["faces"].as_array().map_or(0, Vec::len);
                let why = "subdivision surfaces cannot be read yet; turn it into NURBS (ToNURBS) or a mesh in Rhino";
                let what = self.listed[object].told();
                self.losses.push(Loss { what, why: why.into(), faces, area: None, whole: true });
            }
        }
    }
}

/// What the decoder keeps of the file beside geometry.
pub(super) fn records<'a>(
    ir: &'a CadIr,
    arena: &str,
) -> impl Iterator<Item = &'a NativeRecord> + use<'a> {
    let native = ir.native.namespace("rhino");
    native.and_then(|n| n.arenas().get(arena)).into_iter().flatten()
}

/// The object of a surface that belongs to no face and helps no other geometry.
pub(super) fn loose<'a>(owner: Option<&'a Owner>, id: &str, used: &[&str]) -> Option<&'a Owner> {
    let owner = owner?;
    let helps = owner.geometry_role == Some(Role::Support);
    (!helps && used.binary_search(&id).is_err()).then_some(owner)
}
