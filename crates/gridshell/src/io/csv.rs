//! Schedules as tables (CSV, RFC 4180): one header row with units, decimal points, an empty field for what there is none
//! of. Nodes, members and panels are numbered as in every other file, from 0.

use super::GridFile;
use crate::io::WRITING;
use crate::job::Job;
use crate::schedule::{Figures, Schedule, Spread};
use std::fmt::Write;

/// Names of the tables.
pub(super) const TABLES: [&str; 4] = ["nodes", "members", "panels", "summary"];

/// The tables: name and text.
pub(super) fn tables(grid: &GridFile, job: &Job) -> [(&'static str, String); 4] {
    let [a, b, c, d] = TABLES;
    [(a, nodes(grid, job)), (b, members(grid, job)), (c, panels(grid, job)), (d, summary(grid))]
}

fn nodes(grid: &GridFile, job: &Job) -> String {
    let nodes = &grid.schedule.nodes;
    let supported = grid.supported();
    let mut out = String::from(
        "node,x [m],y [m],z [m],normal x,normal y,normal z,degree,adjusted degree,boundary,support,\
         least angle [deg],greatest angle [deg],bend [deg],bend by curvature [deg],angle defect [deg],\
         off surface [m],group\n",
    );
    for (v, p) in nodes.xyz.iter().enumerate().take_while(|_| !job.is_over(WRITING)) {
        let n = nodes.normal[v];
        let [least, greatest] = nodes.angles_deg[v];
        let (degree, adjusted) = (nodes.degree[v], nodes.adjusted_degree[v]);
        let (boundary, support) = (u8::from(nodes.boundary[v]), u8::from(supported[v]));
        let _ = write!(out, "{v},{},{},{},{},{},{},", p.x, p.y, p.z, n.x, n.y, n.z);
        let _ = write!(out, "{degree},{adjusted},{boundary},{support},{least},{greatest},");
        let _ = write!(out, "{},", maybe(nodes.bend_deg[v]));
        let _ = write!(out, "{},{},", maybe(nodes.curvature_bend_deg[v]), nodes.defect_deg[v]);
        let _ = writeln!(out, "{},{}", nodes.off_surface[v], nodes.group[v]);
    }
    out
}

fn members(grid: &GridFile, job: &Job) -> String {
    let members = &grid.schedule.members;
    let mut out = String::from(
        "member,node 1,node 2,length [m],normal x,normal y,normal z,twist [deg],fold [deg],bend [deg],boundary,\
         feature,group\n",
    );
    for (k, [a, b]) in members.ends.iter().enumerate().take_while(|_| !job.is_over(WRITING)) {
        let n = members.normal[k];
        let (fold, bend) = (maybe(members.fold_deg[k]), maybe(members.bend_deg[k]));
        let (boundary, feature) = (u8::from(members.boundary[k]), u8::from(members.feature[k]));
        let _ = write!(out, "{k},{a},{b},{},{},{},{},", members.length[k], n.x, n.y, n.z);
        let _ = write!(out, "{},{fold},{bend},", members.twist_deg[k]);
        let _ = writeln!(out, "{boundary},{feature},{}", members.group[k]);
    }
    out
}

fn panels(grid: &GridFile, job: &Job) -> String {
    let Schedule { panels, members, .. } = grid.schedule;
    let mut out = String::from(
        "panel,node 1,node 2,node 3,member 1-2,member 2-3,member 3-1,area [m2],shape q,angle 1 [deg],angle 2 [deg],\
         angle 3 [deg],normal x,normal y,normal z,group\n",
    );
    for (k, t) in panels.nodes.iter().enumerate().take_while(|_| !job.is_over(WRITING)) {
        let [a, b, c] = *t;
        let side = |a, b| members.between(a, b).expect("the sides of panels are members");
        let (n, angles) = (panels.normal[k], panels.angles_deg[k]);
        let _ = write!(out, "{k},{a},{b},{c},{},{},{},", side(a, b), side(b, c), side(c, a));
        let _ = write!(out, "{},{},", panels.area[k], panels.shape[k]);
        let _ = write!(out, "{},{},{},", angles[0], angles[1], angles[2]);
        let _ = writeln!(out, "{},{},{},{}", n.x, n.y, n.z, panels.group[k]);
    }
    out
}

fn summary(grid: &GridFile) -> String {
    let (document, figures) = (grid.document, &grid.schedule.figures);
    let Figures { length, panel, .. } = figures;
    let mut out = String::from("figure,value,unit\n");
    let mut row = |name: &str, value: String, unit: &str| {
        let _ = writeln!(out, "{name},{value},{unit}");
    };
    row("name", quoted(&document.name), "");
    row("gridshell version", document.version.clone(), "");
    row("seed", document.seed.map_or_else(String::new, |s| s.to_string()), "");
    row("wanted edge length", maybe(document.edge_length), "m");
    row("nodes", grid.schedule.nodes.xyz.len().to_string(), "");
    row("members", grid.schedule.members.ends.len().to_string(), "");
    row("panels", grid.schedule.panels.nodes.len().to_string(), "");
    row("supports", document.supports.len().to_string(), "");
    row("length tolerance", figures.length_tolerance.to_string(), "m");
    row("angle tolerance", figures.angle_tolerance_deg.to_string(), "deg");
    row("length total", length.total.to_string(), "m");
    row("length groups", length.groups.to_string(), "");
    row("area total", panel.total_area.to_string(), "m2");
    row("distinct panels", panel.distinct.to_string(), "");
    row("distinct nodes", figures.distinct_nodes.to_string(), "");
    row("curvature share of bending", maybe(figures.curvature_share), "");
    row("gauss curvature", figures.gauss_curvature_deg.to_string(), "deg");
    for (name, spread, unit) in [
        ("length", &length.spread, "m"),
        ("area", &panel.area, "m2"),
        ("shape q", &panel.shape, ""),
        ("fold", &figures.fold_deg, "deg"),
        ("angle", &figures.angle_deg, "deg"),
        ("twist", &figures.twist_deg, "deg"),
    ] {
        let Spread { mean, min, max, deviation, .. } = spread;
        for (which, value) in
            [("mean", mean), ("least", min), ("greatest", max), ("deviation", deviation)]
        {
            row(&format!("{name} {which}"), value.to_string(), unit);
        }
    }
    out
}

fn maybe(value: Option<f64>) -> String {
    value.map_or_else(String::new, |x| x.to_string())
}

/// A text field: quotes about it, doubled inside.
fn quoted(text: &str) -> String {
    let text = text.replace(char::is_control, " ").replace('"', "\"\"");
    format!("\"{text}\"")
}
