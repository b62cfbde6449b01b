//! glTF 2.0, text (`.gltf`) and binary (`.glb`): triangles of all meshes of the scene, placed by their nodes. The
//! format is in metres with y up; here z is up. Own reader, so that every faulty number is told with its place.

use super::document::{Document, Node, Primitive};
use super::numbers::Numbers;
use crate::error::{Error, Result};
use crate::io::mesh::soup::{Digits, Soup};
use crate::io::{LengthUnit, file, scan};
use crate::job::Job;
use crate::surface::Loss;
use glam::{DMat4, DQuat, DVec3};
use std::path::Path;

/// More corners and points than this, and than one for two bytes of the file, come of copies without end.
const COPIES: usize = 1_000_000;
/// How the name of the program begins in files that were written here.
const OURS: &str = "gridshell ";
/// Modes of primitives.
const TRIANGLES: u32 = 4;
const STRIP: u32 = 5;
const FAN: u32 = 6;
/// Extensions that change where triangles lie, and are understood here.
const UNDERSTOOD: [&str; 4] =
    ["KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "KHR_node_visibility", "MSFT_lod"];
/// Beginnings of the names of those that change nothing but looks.
const LOOKS: [&str; 8] = [
    "KHR_materials",
    "KHR_texture",
    "KHR_lights",
    "KHR_xmp",
    "EXT_texture",
    "EXT_lights",
    "EXT_structural_metadata",
    "MSFT_texture",
];

/// Read the default scene; all meshes as they stand where there is none.
///
/// # Errors
/// [`Error::Parse`] with the line of the document, or the node, mesh or accessor by its number.
pub(in crate::io) fn read(path: &Path, job: &Job) -> Result<Soup> {
    let bytes = file::read(path, job)?;
    let (text, binary) = chunks(path, &bytes)?;
    let document: Document = serde_json::from_slice(text).map_err(|e| {
        scan::error(path, format!("line {}", e.line()), format!("this is not a glTF document: {e}"))
    })?;
    let numbers = Numbers::new(path, &document, binary, job)?;
    let mut reading = Reading {
        path,
        document: &document,
        numbers,
        soup: Soup::default(),
        passed: 0,
        hidden: 0,
        room: COPIES.max(bytes.len() / 2),
    };
    reading.scene()?;
    let hidden = reading.hidden;
    let mut soup = reading.soup;
    // Members and marks of a grid that was written here say nothing new.
    if !document.asset.generator.starts_with(OURS) {
        soup.note_count(
            reading.passed,
            "skipped",
            ["primitive of points or lines", "primitives of points or lines"],
        );
    }
    soup.note_count(
        hidden,
        "left out",
        [
            "hidden node; show it before exporting to read it",
            "hidden nodes; show them before exporting to read them",
        ],
    );
    let known = |e: &&String| {
        UNDERSTOOD.contains(&e.as_str()) || LOOKS.iter().any(|looks| e.starts_with(looks))
    };
    let unknown: Vec<String> = (document.extensions_required.iter())
        .filter(|e| !known(e))
        .take(3)
        .map(|e| scan::clip(e))
        .collect();
    if !unknown.is_empty() {
        soup.notes.push(format!(
            "the file asks for {}, which is not understood: check the shape, or export it without",
            unknown.join(", ")
        ));
    }
    if soup.faces.is_empty()
        && let Some(loss) = soup.losses.first()
    {
        return Err(scan::error(path, &*loss.what, &*loss.why));
    }
    Ok(Soup { unit: Some(LengthUnit::Metre), digits: Digits::Single, ..soup })
}

/// The document, and the binary chunk of a `.glb`.
fn chunks<'a>(path: &Path, bytes: &'a [u8]) -> Result<(&'a [u8], Option<&'a [u8]>)> {
    if !bytes.starts_with(b"glTF") {
        return Ok((bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), None));
    }
    let word = |at: usize| {
        let four = bytes.get(at..at.saturating_add(4))?;
        Some(u32::from_le_bytes([four[0], four[1], four[2], four[3]]))
    };
    if word(4) != Some(2) {
        return Err(scan::error(path, "byte 4", "only version 2 of binary glTF can be read"));
    }
    let chunk = |at: usize, kind: u32| {
        let length = word(at)? as usize;
        let end = at.checked_add(8)?.checked_add(length)?;
        (word(at + 4)? == kind).then(|| bytes.get(at + 8..end)).flatten().map(|c| (c, end))
    };
    let (text, end) = chunk(12, 0x4E4F_534A).ok_or_else(|| {
        scan::error(path, "byte 12", "the document is missing or cut off; export the file again")
    })?;
    Ok((text, chunk(end, 0x004E_4942).map(|(binary, _)| binary)))
}

/// A file while it is read.
struct Reading<'a> {
    path: &'a Path,
    document: &'a Document,
    numbers: Numbers<'a>,
    soup: Soup,
    /// Primitives that are not triangles.
    passed: usize,
    /// Nodes that are not shown.
    hidden: usize,
    /// Corners and points that may still come.
    room: usize,
}

impl Reading<'_> {
    fn scene(&mut self) -> Result<()> {
        let document = self.document;
        if document.nodes.is_empty() {
            return (0..document.meshes.len()).try_for_each(|m| self.mesh(m, &[], DMat4::IDENTITY));
        }
        let scene = document.scene.map_or(document.scenes.first(), |s| document.scenes.get(s));
        let roots = match scene {
            Some(scene) => scene.nodes.clone(),
            None => roots(&document.nodes),
        };
        // A node hangs on one other only, so each is seen once, in whatever circles the file runs.
        let mut seen = vec![false; document.nodes.len()];
        let mut open: Vec<(usize, DMat4)> = roots.into_iter().rev().map(|n| (n, Z_UP)).collect();
        while let Some((n, above)) = open.pop() {
            let Some(node) = document.nodes.get(n) else {
                return Err(self.error("scene", format!("node {n} is used, but there is none")));
            };
            if std::mem::replace(&mut seen[n], true) {
                return Err(
                    self.error(format!("node {n}"), "it is used twice: glTF allows one place")
                );
            }
            if node.extensions.visibility.as_ref().is_some_and(|v| !v.visible) {
                self.hidden += 1;
                continue;
            }
            let place = above * transform(node);
            if !place.is_finite() {
                return Err(self.error(format!("node {n}"), "its transform is not finite"));
            }
            if let Some(m) = node.mesh {
                self.copies(n, node, m, place)?;
            }
            open.extend(node.children.iter().rev().map(|&child| (child, place)));
        }
        Ok(())
    }

    /// The mesh of a node, as often as it says.
    fn copies(&mut self, n: usize, node: &Node, m: usize, place: DMat4) -> Result<()> {
        if node.skin.is_some() {
            self.soup.losses.push(self.skinned(n, node, m));
            return Ok(());
        }
        let Some(instancing) = &node.extensions.instancing else {
            return self.mesh(m, &node.weights, place);
        };
        let places = &instancing.attributes;
        let moved = places.translation.map(|a| self.numbers.rows::<3>(a)).transpose()?;
        let turned = places.rotation.map(|a| self.numbers.rows::<4>(a)).transpose()?;
        let scaled = places.scale.map(|a| self.numbers.rows::<3>(a)).transpose()?;
        let counts = [
            moved.as_ref().map(Vec::len),
            turned.as_ref().map(Vec::len),
            scaled.as_ref().map(Vec::len),
        ];
        let count = counts.into_iter().flatten().max().unwrap_or(1);
        if counts.into_iter().flatten().any(|c| c != count) {
            let message =
                "its copies (EXT_mesh_gpu_instancing) have not as many places as turns and sizes";
            return Err(self.error(format!("node {n}"), message));
        }
        for k in 0..count {
            let at = |rows: &Option<Vec<[f64; 3]>>| rows.as_ref().map(|rows| rows[k]);
            let [moved, scaled] = [at(&moved), at(&scaled)];
            let turned = turned.as_ref().map(|rows| rows[k]);
            self.mesh(m, &node.weights, place * placed(moved, turned, scaled))?;
        }
        Ok(())
    }

    /// What is lost of a mesh whose vertices follow the bones of a skin.
    fn skinned(&self, n: usize, node: &Node, m: usize) -> Loss {
        let mesh = self.document.meshes.get(m);
        let names = [mesh.map(|mesh| &mesh.name), Some(&node.name)];
        let name = names.into_iter().flatten().find(|name| !name.is_empty());
        let name = name.map(|name| format!(" `{}`", scan::clip(name))).unwrap_or_default();
        let accessors = &self.document.accessors;
        let corners = |p: &Primitive| {
            p.indices
                .or(p.attributes.position)
                .and_then(|a| accessors.get(a))
                .map_or(0, |a| a.count)
        };
        let faces = mesh.map_or(0, |mesh| mesh.primitives.iter().map(|p| corners(p) / 3).sum());
        Loss {
            what: format!("mesh {m}{name} (node {n})"),
            why: "it is bent by a skin; apply the skin (the armature) and export it again".into(),
            faces,
            area: None,
            whole: true,
        }
    }

    /// A mesh, drawn so far towards its morph targets; as it says itself where no weights are given.
    fn mesh(&mut self, m: usize, weights: &[f64], place: DMat4) -> Result<()> {
        let document = self.document;
        let Some(mesh) = document.meshes.get(m) else {
            return Err(self.error("nodes", format!("mesh {m} is used, but there is none")));
        };
        let weights = if weights.is_empty() { &mesh.weights } else { weights };
        for (k, primitive) in mesh.primitives.iter().enumerate() {
            self.primitive(primitive, weights, place, &format!("mesh {m}, primitive {k}"))?;
        }
        Ok(())
    }

    fn primitive(
        &mut self,
        primitive: &Primitive,
        weights: &[f64],
        place: DMat4,
        at: &str,
    ) -> Result<()> {
        let mode = primitive.mode.unwrap_or(TRIANGLES);
        if !matches!(mode, TRIANGLES | STRIP | FAN) {
            self.passed += 1;
            return Ok(());
        }
        let Some(position) = primitive.attributes.position else {
            return Err(self.error(at, "it has no positions"));
        };
        // Some files hold the numbers as they are beside the compressed ones.
        if primitive.extensions.draco.is_some() && !self.numbers.holds(position) {
            let message =
                "it is compressed (KHR_draco_mesh_compression); export it without compression";
            return Err(self.error(at, message));
        }
        let first = self.soup.points.len();
        let mut points = self.numbers.points(position)?;
        for (target, &weight) in primitive.targets.iter().zip(weights) {
            let Some(moves) = target.position.filter(|_| weight != 0.0) else { continue };
            for (p, d) in points.iter_mut().zip(self.numbers.points(moves)?) {
                *p += d * weight;
            }
        }
        let count = points.len();
        let corners = match primitive.indices {
            Some(accessor) => self.numbers.indices(accessor)?,
            None => (0..count as u32).collect(),
        };
        let Some(room) = self.room.checked_sub(corners.len() + count) else {
            return Err(
                self.error(at, "there are too many copies of meshes; export only the surface")
            );
        };
        self.room = room;
        if let Some(v) = corners.iter().find(|&&v| v as usize >= count) {
            let message = format!("it uses vertex {v}, but there are only {count}, from 0");
            return Err(self.error(at, message));
        }
        self.soup.points.extend(points.into_iter().map(|p| place.transform_point3(p)));
        let turned = place.determinant() < 0.0;
        for [a, b, c] in triangles(&corners, mode) {
            let [a, b, c] = [a, b, c].map(|v| v + first as u32);
            self.soup.faces.push(if turned { vec![a, c, b] } else { vec![a, b, c] });
        }
        Ok(())
    }

    fn error(&self, place: impl Into<String>, message: impl Into<String>) -> Error {
        scan::error(self.path, place, message)
    }
}

/// From y up to z up.
const Z_UP: DMat4 = DMat4::from_cols_array(&[
    1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0,
]);

/// The nodes that are nobody's children, and stand for no other that is far away.
fn roots(nodes: &[Node]) -> Vec<usize> {
    let mut child = vec![false; nodes.len()];
    let coarser = |n: &Node| n.extensions.coarser.as_ref().map_or(Vec::new(), |c| c.ids.clone());
    for c in nodes.iter().flat_map(|n| n.children.iter().copied().chain(coarser(n))) {
        if let Some(child) = child.get_mut(c) {
            *child = true;
        }
    }
    (0..nodes.len()).filter(|&n| !child[n]).collect()
}

fn transform(node: &Node) -> DMat4 {
    if let Some(matrix) = &node.matrix {
        return DMat4::from_cols_array(matrix);
    }
    placed(
        node.translation.as_deref().copied(),
        node.rotation.as_deref().copied(),
        node.scale.as_deref().copied(),
    )
}

/// Scaled, then turned by a quaternion, then moved.
fn placed(moved: Option<[f64; 3]>, turned: Option<[f64; 4]>, scaled: Option<[f64; 3]>) -> DMat4 {
    let turned = turned.map_or(DQuat::IDENTITY, |turn| {
        let turn = DQuat::from_array(turn);
        if turn.length() > 0.0 && turn.is_finite() { turn.normalize() } else { DQuat::IDENTITY }
    });
    DMat4::from_scale_rotation_translation(
        scaled.map_or(DVec3::ONE, DVec3::from),
        turned,
        moved.map_or(DVec3::ZERO, DVec3::from),
    )
}

fn triangles(corners: &[u32], mode: u32) -> Vec<[u32; 3]> {
    match mode {
        // Every other triangle of a strip runs the other way.
        STRIP => (corners.windows(3).enumerate())
            .map(|(k, t)| if k % 2 == 0 { [t[0], t[1], t[2]] } else { [t[1], t[0], t[2]] })
            .collect(),
        FAN => corners.windows(2).skip(1).map(|t| [corners[0], t[0], t[1]]).collect(),
        _ => corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
    }
}
