//! COMPAS meshes: `vertex` and `face` as objects by key (or `vertices` and `faces` as lists), in `data` or, in old files, in `value` or at the top.
//! Session files hold several of them in depth. COMPAS states no unit.

use super::super::json::{self, Json};
use super::super::mesh::soup::Soup;
use super::super::{file, scan};
use crate::error::{Error, Result};
use crate::job::Job;
use crate::surface::Loss;
use glam::DVec3;
use std::collections::HashMap;
use std::path::Path;

/// What faces are marked with, if false, that stand for openings in a form diagram.
const LOADED: [&str; 2] = ["is_loaded", "_is_loaded"];

/// More meshes of a session are not looked at.
const MOST_MESHES: usize = 1000;

/// A mesh found in a file.
struct Found<'a> {
    /// The names that lead to it, by dots.
    way: String,
    /// `dtype` of it or of what holds it.
    kind: &'a str,
    mesh: &'a Json,
}

/// Read the mesh; of several in a session file the thrust diagram, else the first that is not a form or force diagram.
///
/// # Errors
/// [`Error::Parse`] with the line, or the vertex or face by its key.
pub(in crate::io) fn read(path: &Path, job: &Job) -> Result<Soup> {
    let tree = json::parse(path, &file::read(path, job)?)?;
    let mut found = Vec::new();
    find(&tree, &mut Vec::new(), "", &mut found);
    let Some(best) =
        (0..found.len()).reduce(|a, b| if rank(&found[b]) > rank(&found[a]) { b } else { a })
    else {
        let kind = tree.get("dtype").and_then(Json::text);
        let kind = kind.map_or_else(String::new, |k| format!(" (it is a `{}`)", scan::clip(k)));
        return Err(scan::error(
            path,
            "whole file",
            format!(
                "there is no COMPAS mesh, with `vertex` and `face`, in it{kind}; export the surface as a Mesh"
            ),
        ));
    };
    let mut soup = soup(path, found[best].mesh)?;
    if found.len() > 1 {
        let others: Vec<String> =
            (0..found.len()).filter(|&k| k != best).map(|k| found[k].told()).collect();
        let (taken, more) = (found[best].told(), others.len().saturating_sub(5));
        let dots = if more > 0 { format!(" and {more} more") } else { String::new() };
        let others = others.into_iter().take(5).collect::<Vec<_>>().join(", ");
        soup.notes.push(format!("of several meshes {taken} was taken; left out: {others}{dots}"));
        // Form and force diagrams are drawings; any other mesh may be meant as well.
        let surfaces = (0..found.len()).filter(|&k| k != best && rank(&found[k]) >= SURFACE);
        let lost = surfaces.map(|k| lost(path, &found[k]));
        soup.losses = lost.collect();
    }
    Ok(soup)
}

/// A mesh that was not taken.
fn lost(path: &Path, found: &Found) -> Loss {
    let soup = soup(path, found.mesh).unwrap_or_default();
    Loss {
        what: format!("mesh {}", found.told()),
        why: "one mesh is read from a COMPAS file; export this one to a file of its own".to_owned(),
        faces: soup.faces.len(),
        area: None,
        whole: true,
    }
}

impl Found<'_> {
    fn told(&self) -> String {
        let way = if self.way.is_empty() { "the top one" } else { &self.way };
        let kind = if self.kind.is_empty() { "mesh" } else { self.kind };
        format!("{} ({})", scan::clip(way), scan::clip(kind))
    }
}

/// A step on the way to a mesh: the name of a member, or the place in a list.
enum Step<'a> {
    Name(&'a str),
    Place(usize),
}

/// The meshes below `tree`, in the file's order. The depth is bounded by the parser.
fn find<'a>(tree: &'a Json, way: &mut Vec<Step<'a>>, kind: &'a str, found: &mut Vec<Found<'a>>) {
    if found.len() >= MOST_MESHES {
        return;
    }
    let kind = tree.get("dtype").and_then(Json::text).unwrap_or(kind);
    let is_map = |name: &str| matches!(tree.get(name), Some(Json::Map(_)));
    let is_list = |name: &str| matches!(tree.get(name), Some(Json::List(_)));
    if is_map("vertex") && is_map("face") || is_list("vertices") && is_list("faces") {
        found.push(Found { way: told_way(way), kind, mesh: tree });
        return;
    }
    let named = tree.members().iter().map(|(name, value)| (Step::Name(name), value));
    let placed = tree.list().unwrap_or_default().iter().enumerate();
    for (step, value) in named.chain(placed.map(|(k, value)| (Step::Place(k), value))) {
        if matches!(value, Json::Map(_) | Json::List(_)) {
            way.push(step);
            find(value, way, kind, found);
            way.pop();
        }
    }
}

fn told_way(way: &[Step]) -> String {
    let told = |step: &Step| match step {
        Step::Name(name) => scan::clip(name),
        Step::Place(k) => k.to_string(),
    };
    way.iter().map(told).collect::<Vec<_>>().join(".")
}

/// The rank of a mesh that is not a drawing.
const SURFACE: u8 = 2;

/// How likely a mesh is the surface: a thrust diagram is, form and force diagrams are drawings in the plane.
fn rank(found: &Found) -> u8 {
    let is = |word: &str| {
        found.way.to_ascii_lowercase().contains(word)
            || found.kind.to_ascii_lowercase().contains(word)
    };
    match () {
        () if is("thrust") => 3,
        () if is("force") => 0,
        () if is("form") || is("pattern") => 1,
        () => SURFACE,
    }
}

/// A mesh as plain lists: `vertices` of coordinates, `faces` of places in them.
fn listed(path: &Path, vertices: &[Json], faces: &[Json]) -> Result<Soup> {
    let mut soup = Soup::default();
    for (k, vertex) in vertices.iter().enumerate() {
        let numbers: Option<Vec<f64>> =
            vertex.list().map(|l| l.iter().filter_map(Json::number).collect());
        let xyz = numbers.and_then(|n| <[f64; 3]>::try_from(n).ok()).map(DVec3::from);
        let xyz = xyz.filter(|p| p.is_finite());
        soup.points.push(xyz.ok_or_else(|| {
            fault(path, "vertex", &k.to_string(), "it is not a list of x, y, z".into())
        })?);
    }
    for (k, face) in faces.iter().enumerate() {
        let place = |corner: &Json| {
            let v = corner
                .number()
                .filter(|v| v.fract() == 0.0 && (0.0..vertices.len() as f64).contains(v));
            let message = || format!("{} is not a place in `vertices`, from 0", told(corner));
            v.map(|v| v as u32).ok_or_else(|| fault(path, "face", &k.to_string(), message()))
        };
        let corners =
            face.list().unwrap_or_default().iter().map(place).collect::<Result<Vec<u32>>>()?;
        if corners.len() >= 3 {
            soup.faces.push(corners);
        }
    }
    Ok(soup)
}

/// The corners of a face: a list of vertex keys, or in old files the key after each key.
fn corners(face: &Json) -> Option<Vec<Json>> {
    let Json::Map(steps) = face else { return face.list().map(<[Json]>::to_vec) };
    let after: HashMap<&str, &Json> = steps.iter().map(|(from, to)| (&**from, to)).collect();
    let mut corners = vec![Json::Text(steps.first()?.0.clone())];
    while corners.len() < steps.len() {
        let next = *after.get(corners.last().map(told)?.as_str())?;
        corners.push(next.clone());
    }
    Some(corners)
}

fn soup(path: &Path, mesh: &Json) -> Result<Soup> {
    let list = |name: &str| mesh.get(name).and_then(Json::list);
    if let (Some(vertices), Some(faces)) = (list("vertices"), list("faces")) {
        return listed(path, vertices, faces);
    }
    let vertices = mesh.get("vertex").map_or(&[][..], Json::members);
    let faces = mesh.get("face").map_or(&[][..], Json::members);
    let usual = mesh.get("default_vertex_attributes").or_else(|| mesh.get("dva"));
    let mut soup = Soup::default();
    let mut numbers: HashMap<&str, u32> = HashMap::with_capacity(vertices.len());
    for (key, attributes) in vertices {
        let mut p = [0.0; 3];
        for (c, name) in p.iter_mut().zip(["x", "y", "z"]) {
            *c = coordinate(attributes, usual, name).ok_or_else(|| {
                fault(path, "vertex", key, format!("its {name} is missing or no number"))
            })?;
        }
        numbers.insert(key, soup.points.len() as u32);
        soup.points.push(DVec3::from(p));
    }
    let data = mesh.get("facedata");
    let openings: HashMap<&str, bool> = (data.map_or(&[][..], Json::members).iter())
        .filter_map(|(key, data)| {
            let mark = LOADED.iter().find_map(|name| data.get(name))?;
            Some((&**key, *mark == Json::Truth(false)))
        })
        .collect();
    let mut skipped = 0;
    for (key, corners) in faces {
        if openings.get(&**key) == Some(&true) {
            skipped += 1;
            continue;
        }
        // A face that was deleted is null in some files.
        if *corners == Json::Null {
            continue;
        }
        let corners = self::corners(corners)
            .ok_or_else(|| fault(path, "face", key, "it is not a list of vertex keys".into()))?;
        let mut face = Vec::with_capacity(corners.len());
        for corner in &corners {
            let v = vertex(corner, &numbers).ok_or_else(|| {
                fault(path, "face", key, format!("vertex {} is not among `vertex`", told(corner)))
            })?;
            face.push(v);
        }
        if face.len() >= 3 {
            soup.faces.push(face);
        }
    }
    soup.note_count(
        skipped,
        "left out",
        [
            "face marked as not loaded: it stands for an opening",
            "faces marked as not loaded: they stand for openings",
        ],
    );
    Ok(soup)
}

/// A coordinate of a vertex, or the usual one where the vertex does not say.
fn coordinate(attributes: &Json, usual: Option<&Json>, name: &str) -> Option<f64> {
    let own = attributes.get(name).or_else(|| usual?.get(name))?;
    own.number().filter(|x| x.is_finite())
}

/// The vertex that a corner of a face means: its key as a number or as text.
fn vertex(corner: &Json, numbers: &HashMap<&str, u32>) -> Option<u32> {
    match corner {
        Json::Number(_) => numbers.get(told(corner).as_str()).copied(),
        Json::Text(key) => numbers.get(&**key).copied(),
        _ => None,
    }
}

fn told(corner: &Json) -> String {
    match corner {
        Json::Number(x) => format!("{x}"),
        Json::Text(key) => scan::clip(key),
        _ => "that is not a key".into(),
    }
}

fn fault(path: &Path, what: &str, key: &str, message: String) -> Error {
    scan::error(path, format!("{what} {}", scan::clip(key)), message)
}
