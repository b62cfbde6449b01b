//! A grid as a COMPAS mesh: nodes with their normals and support flags, panels, and members as edge data, whose key is
//! exactly `(u, v)` with the lower node first: any other spelling loads, but its values are lost.

use super::super::{GridFile, digest};
use crate::io::WRITING;
use crate::job::Job;
use crate::schedule::Schedule;
use serde_json::json;
use std::fmt::Write;

/// The file's bytes.
pub(in crate::io) fn encode(grid: &GridFile, job: &Job) -> Vec<u8> {
    let Schedule { nodes, members, panels, figures } = grid.schedule;
    let document = grid.document;
    let attributes = json!({
        "name": document.name,
        "gridshell_version": document.version,
        "seed": document.seed,
        "edge_length": document.edge_length,
        "units": document.units,
        "figures": figures,
    });
    let mut out = String::from("{\"dtype\":\"compas.datastructures/Mesh\",\"data\":{");
    let _ = write!(out, "\"attributes\":{attributes},");
    out.push_str("\"default_vertex_attributes\":{\"x\":0.0,\"y\":0.0,\"z\":0.0},");
    out.push_str("\"default_edge_attributes\":{},\"default_face_attributes\":{},");
    let supported = grid.supported();
    list(&mut out, "vertex", nodes.xyz.len(), job, |out, v| {
        let (p, n) = (nodes.xyz[v], nodes.normal[v]);
        let _ = write!(out, "\"{v}\":{{\"x\":{:?},\"y\":{:?},\"z\":{:?},", p.x, p.y, p.z);
        let _ = write!(out, "\"normal\":[{:?},{:?},{:?}],", n.x, n.y, n.z);
        let _ = write!(out, "\"degree\":{},\"is_support\":{}", nodes.degree[v], supported[v]);
        let _ = write!(out, ",\"irregular\":{}}}", nodes.is_irregular(v));
    });
    out.push(',');
    list(&mut out, "face", panels.nodes.len(), job, |out, k| {
        let [a, b, c] = panels.nodes[k];
        let _ = write!(out, "\"{k}\":[{a},{b},{c}]");
    });
    out.push(',');
    list(&mut out, "facedata", panels.nodes.len(), job, |out, k| {
        let (area, shape, group) = (panels.area[k], panels.shape[k], panels.group[k]);
        let _ = write!(out, "\"{k}\":{{\"area\":{area:?},\"shape\":{shape:?},\"group\":{group}}}");
    });
    out.push(',');
    list(&mut out, "edgedata", members.ends.len(), job, |out, k| {
        let ([a, b], n) = (members.ends[k], members.normal[k]);
        let _ = write!(out, "\"({a}, {b})\":{{\"length\":{:?},", members.length[k]);
        let _ = write!(out, "\"normal\":[{:?},{:?},{:?}],", n.x, n.y, n.z);
        let _ = write!(out, "\"twist_deg\":{:?},", members.twist_deg[k]);
        let _ = write!(out, "\"group\":{}}}", members.group[k]);
    });
    let last = |count: usize| count as i64 - 1;
    let _ = write!(out, ",\"max_vertex\":{},", last(nodes.xyz.len()));
    let _ = write!(out, "\"max_face\":{}}},", last(panels.nodes.len()));
    let guid = digest::uuid(digest::fnv1a_128(out.as_bytes()));
    let _ = writeln!(out, "\"inheritance\":[],\"guid\":\"{guid}\"}}");
    out.into_bytes()
}

/// An object of so many entries, each written by `one`.
fn list(out: &mut String, name: &str, count: usize, job: &Job, one: impl Fn(&mut String, usize)) {
    let _ = write!(out, "\"{name}\":{{");
    for k in (0..count).take_while(|_| !job.is_over(WRITING)) {
        out.push_str(if k == 0 { "\n" } else { ",\n" });
        one(out, k);
    }
    out.push('}');
}
