//! A grid as VTK unstructured grid (`.vtu`, XML with numbers as text): panels first, then members; measures are point
//! and cell data. What a kind of cell has none of is 0 there.

use super::GridFile;
use crate::io::WRITING;
use crate::job::Job;
use crate::schedule::Schedule;
use glam::DVec3;
use std::fmt::{Display, Write};

/// VTK's numbers for kinds of cells.
const LINE: u8 = 3;
const TRIANGLE: u8 = 5;

/// The file's bytes.
pub(super) fn encode(grid: &GridFile, job: &Job) -> Vec<u8> {
    let Schedule { nodes, members, panels, .. } = grid.schedule;
    let (p, m) = (panels.nodes.len(), members.ends.len());
    let mut out = String::from("<?xml version=\"1.0\"?>\n");
    // Two hyphens would end the comment.
    let _ = writeln!(out, "<!-- {} -->", grid.headline().replace("--", "- -"));
    out.push_str(
        "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n",
    );
    out.push_str("<UnstructuredGrid>\n");
    let _ =
        writeln!(out, "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">", nodes.xyz.len(), p + m);
    out.push_str("<Points>\n");
    array(&mut out, "Float64", "Points", 3, job, nodes.xyz.iter().flat_map(DVec3::to_array));
    out.push_str("</Points>\n<Cells>\n");
    let corners = panels.nodes.iter().flatten().chain(members.ends.iter().flatten());
    array(&mut out, "Int64", "connectivity", 1, job, corners);
    let offsets = (1..=p).map(|k| 3 * k).chain((1..=m).map(|k| 3 * p + 2 * k));
    array(&mut out, "Int64", "offsets", 1, job, offsets);
    let kinds = std::iter::repeat_n(TRIANGLE, p).chain(std::iter::repeat_n(LINE, m));
    array(&mut out, "UInt8", "types", 1, job, kinds);
    out.push_str("</Cells>\n<PointData>\n");
    array(&mut out, "Float64", "normal", 3, job, nodes.normal.iter().flat_map(DVec3::to_array));
    array(&mut out, "Int64", "degree", 1, job, &nodes.degree);
    array(&mut out, "Int64", "adjusted_degree", 1, job, &nodes.adjusted_degree);
    array(&mut out, "Int64", "boundary", 1, job, nodes.boundary.iter().map(|&b| u8::from(b)));
    array(&mut out, "Int64", "support", 1, job, grid.supported().iter().map(|&b| u8::from(b)));
    array(&mut out, "Int64", "group", 1, job, &nodes.group);
    let bend = nodes.bend_deg.iter().map(|b| b.unwrap_or(0.0));
    array(&mut out, "Float64", "bend_deg", 1, job, bend);
    array(&mut out, "Float64", "defect_deg", 1, job, &nodes.defect_deg);
    out.push_str("</PointData>\n<CellData>\n");
    let behind = |list: &[f64]| [&vec![0.0; p][..], list].concat();
    let before = |list: &[f64]| [list, &vec![0.0; m][..]].concat();
    array(&mut out, "Float64", "area", 1, job, before(&panels.area));
    array(&mut out, "Float64", "shape", 1, job, before(&panels.shape));
    array(&mut out, "Float64", "length", 1, job, behind(&members.length));
    array(&mut out, "Float64", "twist_deg", 1, job, behind(&members.twist_deg));
    let folds: Vec<f64> = members.fold_deg.iter().map(|f| f.unwrap_or(0.0)).collect();
    array(&mut out, "Float64", "fold_deg", 1, job, behind(&folds));
    array(&mut out, "Int64", "group", 1, job, panels.group.iter().chain(&members.group));
    let normals = panels.normal.iter().chain(&members.normal).flat_map(DVec3::to_array);
    array(&mut out, "Float64", "normal", 3, job, normals);
    out.push_str("</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    out.into_bytes()
}

fn array<T: Display>(
    out: &mut String,
    kind: &str,
    name: &str,
    components: usize,
    job: &Job,
    values: impl IntoIterator<Item = T>,
) {
    // A lone number has no components: some readers would make a column of it.
    let components = match components {
        1 => String::new(),
        n => format!(" NumberOfComponents=\"{n}\""),
    };
    let _ =
        writeln!(out, "<DataArray type=\"{kind}\" Name=\"{name}\"{components} format=\"ascii\">");
    for value in values.into_iter().take_while(|_| !job.is_over(WRITING)) {
        let _ = write!(out, "{value} ");
    }
    out.push_str("\n</DataArray>\n");
}
