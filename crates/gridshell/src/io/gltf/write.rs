//! A grid as binary glTF 2.0: panels as triangles and members as lines, coloured, in metres with y up, measures in
//! `extras`.
//!
//! Coordinates are single precision, so they are taken from a whole point near the grid's middle, which the root
//! node's translation adds again: georeferenced grids keep their digits.

use super::super::GridFile;
use crate::io::WRITING;
use crate::job::Job;
use crate::schedule::Schedule;
use glam::DVec3;
use serde_json::{Value, json};

/// glTF's numbers for what an accessor holds and a buffer view is for.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const UNSIGNED_BYTE: u32 = 5121;
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;
/// Modes of primitives.
const POINTS: u32 = 0;
const LINES: u32 = 1;
const TRIANGLES: u32 = 4;

/// Lengths this share off the mean have the full colour.
const FULL: f64 = 0.2;

type Colour = [u8; 4];
const PANEL: Colour = [226, 229, 233, 255];
const FEW: Colour = [20, 20, 20, 255];
const MANY: Colour = [250, 140, 0, 255];
const SUPPORT: Colour = [40, 140, 70, 255];
const EVEN: [f64; 3] = [150.0, 150.0, 150.0];
const SHORT: [f64; 3] = [20.0, 80.0, 220.0];
const LONG: [f64; 3] = [215.0, 40.0, 30.0];

/// The buffer as it grows, with what tells of it.
#[derive(Default)]
struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

/// The file's bytes.
pub(in crate::io) fn encode(grid: &GridFile, job: &Job) -> Vec<u8> {
    // What is made here is a few flat arrays; the caller checks again.
    if job.is_over(WRITING) {
        return Vec::new();
    }
    let Schedule { nodes, members, panels, .. } = grid.schedule;
    let origin = origin(&nodes.xyz);
    let at = |v: u32| y_up(nodes.xyz[v as usize] - origin);
    let mut buffer = Buffer::default();

    let positions: Vec<DVec3> = (0..nodes.xyz.len() as u32).map(at).collect();
    let normals: Vec<DVec3> = nodes.normal.iter().map(|&n| y_up(n)).collect();
    let panel_primitive = json!({
        "attributes": {
            "POSITION": buffer.vectors(&positions),
            "NORMAL": buffer.vectors(&normals),
            "COLOR_0": buffer.colours(&vec![PANEL; positions.len()]),
        },
        "indices": buffer.indices(&panels.nodes.concat()),
        "mode": TRIANGLES,
        "material": 0,
    });

    let ends: Vec<DVec3> = members.ends.iter().flatten().map(|&v| at(v)).collect();
    let mean = grid.schedule.figures.length.spread.mean;
    let colours: Vec<Colour> = members
        .length
        .iter()
        .flat_map(|l| {
            let colour = by_length(l / mean - 1.0);
            [colour, colour]
        })
        .collect();
    let member_primitive = json!({
        "attributes": { "POSITION": buffer.vectors(&ends), "COLOR_0": buffer.colours(&colours) },
        "mode": LINES,
        "material": 1,
    });

    let mut meshes = vec![
        json!({
            "name": "panels",
            "primitives": [panel_primitive],
            "extras": { "area": panels.area, "shape": panels.shape, "group": panels.group },
        }),
        json!({
            "name": "members",
            "primitives": [member_primitive],
            "extras": {
                "nodes": members.ends,
                "length": members.length,
                "twist_deg": members.twist_deg,
                "group": members.group,
            },
        }),
    ];
    meshes.extend(marks(&mut buffer, grid, &positions));
    pack(&root(grid, origin, &meshes, &buffer), &buffer.bytes)
}

/// The irregular nodes and the supports as points, where there are any.
fn marks(buffer: &mut Buffer, grid: &GridFile, positions: &[DVec3]) -> Vec<Value> {
    let nodes = &grid.schedule.nodes;
    let irregular: Vec<u32> =
        (0..positions.len()).filter(|&v| nodes.is_irregular(v)).map(|v| v as u32).collect();
    let of_degree = |&v: &u32| if nodes.adjusted_degree[v as usize] < 6 { FEW } else { MANY };
    let irregular_colours = irregular.iter().map(of_degree).collect();
    let supports = grid.document.supports.clone();
    let support_colours = vec![SUPPORT; supports.len()];
    let kinds =
        [("irregular", irregular, irregular_colours), ("supports", supports, support_colours)];
    let mut marks = Vec::new();
    for (name, which, colours) in kinds {
        if which.is_empty() {
            continue;
        }
        let places: Vec<DVec3> = which.iter().map(|&v| positions[v as usize]).collect();
        let primitive = json!({
            "attributes": {
                "POSITION": buffer.vectors(&places),
                "COLOR_0": buffer.colours(&colours),
            },
            "mode": POINTS,
            "material": 1,
        });
        let extras = json!({ "nodes": which });
        marks.push(json!({ "name": name, "primitives": [primitive], "extras": extras }));
    }
    marks
}

fn root(grid: &GridFile, origin: DVec3, meshes: &[Value], buffer: &Buffer) -> Value {
    let document = grid.document;
    let mut nodes: Vec<Value> = meshes
        .iter()
        .enumerate()
        .map(|(k, mesh)| json!({ "name": mesh["name"], "mesh": k }))
        .collect();
    let children: Vec<usize> = (0..nodes.len()).collect();
    nodes.push(json!({
        "name": document.name,
        "children": children,
        "translation": y_up(origin).to_array(),
    }));
    json!({
        "asset": {
            "version": "2.0",
            "generator": format!("gridshell {}", document.version),
            "extras": { "seed": document.seed, "edge_length": document.edge_length, "units": "m" },
        },
        "scene": 0,
        "scenes": [{
            "name": document.name,
            "nodes": [nodes.len() - 1],
            "extras": { "figures": grid.schedule.figures },
        }],
        "nodes": nodes,
        "meshes": meshes,
        "materials": [
            {
                "name": "panels",
                "doubleSided": true,
                "pbrMetallicRoughness": { "metallicFactor": 0.0, "roughnessFactor": 0.6 },
            },
            {
                "name": "members",
                "pbrMetallicRoughness": { "metallicFactor": 0.0, "roughnessFactor": 1.0 },
            },
        ],
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{ "byteLength": buffer.bytes.len() }],
    })
}

/// The grid's middle, to a whole metre; near the origin it is the origin itself.
fn origin(xyz: &[DVec3]) -> DVec3 {
    let first = xyz.first().copied().unwrap_or_default();
    let (low, high) = xyz.iter().fold((first, first), |(l, h), p| (l.min(*p), h.max(*p)));
    let middle = (0.5 * (low + high)).round();
    if middle.length() <= 10.0 * (high - low).length() { DVec3::ZERO } else { middle }
}

fn y_up(p: DVec3) -> DVec3 {
    DVec3::new(p.x, p.z, -p.y)
}

/// From short over even to long.
fn by_length(off: f64) -> Colour {
    let far = if off < 0.0 { SHORT } else { LONG };
    let share = (off.abs() / FULL).min(1.0);
    let mix = |k: usize| (EVEN[k] + share * (far[k] - EVEN[k])) as u8;
    [mix(0), mix(1), mix(2), 255]
}

impl Buffer {
    fn vectors(&mut self, points: &[DVec3]) -> usize {
        let single: Vec<[f32; 3]> = points.iter().map(|p| p.as_vec3().to_array()).collect();
        let bytes = single.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        let bound = |pick: fn(f32, f32) -> f32, start: f32| {
            [0, 1, 2].map(|k| single.iter().map(|p| p[k]).fold(start, pick))
        };
        let accessor = json!({
            "componentType": FLOAT,
            "count": points.len(),
            "type": "VEC3",
            "min": bound(f32::min, f32::INFINITY),
            "max": bound(f32::max, f32::NEG_INFINITY),
        });
        self.push(bytes, VERTICES, accessor)
    }

    fn colours(&mut self, colours: &[Colour]) -> usize {
        let accessor = json!({
            "componentType": UNSIGNED_BYTE,
            "normalized": true,
            "count": colours.len(),
            "type": "VEC4",
        });
        self.push(colours.concat(), VERTICES, accessor)
    }

    fn indices(&mut self, indices: &[u32]) -> usize {
        let bytes = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
        let accessor =
            json!({ "componentType": UNSIGNED_INT, "count": indices.len(), "type": "SCALAR" });
        self.push(bytes, INDICES, accessor)
    }

    /// Put a view with an accessor of its own behind the others; all components have four bytes together or apiece.
    fn push(&mut self, bytes: Vec<u8>, target: u32, mut accessor: Value) -> usize {
        accessor["bufferView"] = json!(self.views.len());
        self.views.push(json!({
            "buffer": 0,
            "byteOffset": self.bytes.len(),
            "byteLength": bytes.len(),
            "target": target,
        }));
        self.bytes.extend(bytes);
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }
}

/// The two chunks in their container, each padded to four bytes.
fn pack(root: &Value, binary: &[u8]) -> Vec<u8> {
    let mut json = root.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut out = Vec::with_capacity(28 + json.len() + binary.len());
    let whole = (28 + json.len() + binary.len()) as u32;
    out.extend(b"glTF");
    out.extend(2u32.to_le_bytes());
    out.extend(whole.to_le_bytes());
    for (kind, bytes) in [(b"JSON", &json[..]), (b"BIN\0", binary)] {
        out.extend((bytes.len() as u32).to_le_bytes());
        out.extend(kind);
        out.extend(bytes);
    }
    out
}
