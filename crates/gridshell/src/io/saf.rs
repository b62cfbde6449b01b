//! A grid in the Structural Analysis Format (SAF, `.saf.xlsx`), version 2.0.0 or 1.0.5: one sheet a kind, after the
//! public specification. The surface's normal is every member's local z axis. Lists are joined by semicolons; section,
//! material and panes are stated assumptions of [`Structure`].

use super::GridFile;
use super::xlsx::Cell::{Blank, Made, Number, Text};
use super::xlsx::{Cell, MOST_ROWS, Workbook};
use crate::job::Job;
use crate::schedule::Schedule;
use crate::structure::{Material, Shape, Structure};

/// Name of the only cross-section.
const SECTION: &str = "CS1";

/// The file's bytes; the error says why it cannot be.
pub(super) fn encode(grid: &GridFile, job: &Job) -> Result<Vec<u8>, String> {
    if grid.schedule.members.ends.len() >= MOST_ROWS {
        return Err(format!(
            "{} members: a sheet holds {} rows; write another format, or a coarser grid",
            grid.schedule.members.ends.len(),
            MOST_ROWS - 1
        ));
    }
    let mut book = Workbook::new(job);
    project(&mut book, grid);
    model(&mut book, grid);
    materials(&mut book, grid);
    sections(&mut book, grid.structure);
    let joints = grid.joints();
    nodes(&mut book, grid.schedule, &joints);
    members(&mut book, grid, &joints);
    panels(&mut book, grid, &joints);
    supports(&mut book, grid, &joints);
    book.pack().map_err(|e| format!("the workbook cannot be packed: {e}"))
}

/// Two columns: what, and its value.
fn properties<const N: usize>(book: &mut Workbook, name: &'static str, rows: [(&str, Cell); N]) {
    book.sheet(name);
    for (what, value) in rows {
        book.row(&[Text(what), value]);
    }
}

fn header(book: &mut Workbook, name: &'static str, columns: &[&str]) {
    book.sheet(name);
    let cells: Vec<Cell> = columns.iter().map(|c| Text(c)).collect();
    book.row(&cells);
}

fn project(book: &mut Workbook, grid: &GridFile) {
    let rows = [
        ("Name", Made(grid.document.name.replace(char::is_control, " "))),
        ("Description", Made(grid.headline())),
        ("Status", Text("Draft")),
    ];
    properties(book, "Project", rows);
}

fn model(book: &mut Workbook, grid: &GridFile) {
    let rows = [
        ("Name", Made(grid.document.name.replace(char::is_control, " "))),
        ("Description", Made(grid.headline())),
        ("Discipline", Text("Load-bearing structure")),
        ("Level of detail", Text("Draft")),
        ("Source type", Text("Structural analysis model")),
        ("Source application", Made(format!("gridshell {}", grid.document.version))),
        ("SAF Version", Text(grid.structure.saf.number())),
        ("Global coordinate system", Text("Z vertical")),
        ("LCS of cross-section", Text("ZYX")),
        ("System of units", Text("Metric")),
        ("National code", Text("EC-Standard-EN")),
    ];
    properties(book, "Model", rows);
}

fn materials(book: &mut Workbook, grid: &GridFile) {
    let columns = [
        "Name",
        "Type",
        "Subtype",
        "Quality",
        "Unit mass [kg/m3]",
        "E modulus [MPa]",
        "G modulus [MPa]",
        "Poisson Coefficient",
        "Thermal expansion [1/K]",
    ];
    header(book, "StructuralMaterial", &columns);
    let all: [&Material; 2] = [&grid.structure.material, &Structure::PANE];
    for m in all {
        let cells = [
            Text(m.name),
            Text(m.kind),
            Blank,
            Text(m.name),
            Number(m.density),
            Number(m.youngs_mpa),
            Number(m.shear_mpa),
            Number(m.poisson),
            Number(m.expansion),
        ];
        book.row(&cells);
    }
}

fn sections(book: &mut Workbook, structure: &Structure) {
    let columns = [
        "Name",
        "Material",
        "Cross-section type",
        "Shape",
        "Parameters [mm]",
        "Profile",
        "Form code",
        "Description ID of the profile",
        "A [m2]",
        "Iy [m4]",
        "Iz [m4]",
        "It [m4]",
    ];
    header(book, "StructuralCrossSection", &columns);
    let (shape, parameters) = match structure.section.shape {
        Shape::Tube { height, width, wall } => {
            let [outer, inner] = Shape::radii(wall);
            ("Tube", vec![height, width, wall, outer, inner])
        }
        Shape::Pipe { diameter, wall } => ("Pipe", vec![diameter, wall]),
        Shape::Bar { height, width } => ("Rectangle", vec![height, width]),
    };
    let parameters: Vec<String> = parameters.iter().map(f64::to_string).collect();
    let p = structure.section.shape.properties();
    let cells = [
        Text(SECTION),
        Text(structure.material.name),
        Text("Parametric"),
        Text(shape),
        Made(parameters.join(";")),
        Blank,
        Blank,
        Blank,
        Number(p.area),
        Number(p.iy),
        Number(p.iz),
        Number(p.torsion),
    ];
    book.row(&cells);
}

fn nodes(book: &mut Workbook, schedule: &Schedule, joints: &[u32]) {
    let columns = ["Name", "Coordinate X [m]", "Coordinate Y [m]", "Coordinate Z [m]"];
    header(book, "StructuralPointConnection", &columns);
    let own = |v: usize| joints[v] == v as u32;
    for (v, p) in schedule.nodes.xyz.iter().enumerate().filter(|(v, _)| own(*v)) {
        book.row(&[Made(format!("N{v}")), Number(p.x), Number(p.y), Number(p.z)]);
    }
}

fn members(book: &mut Workbook, grid: &GridFile, joints: &[u32]) {
    let columns = [
        "Name",
        "Type",
        "Cross section",
        "Nodes",
        "Segments",
        "Begin node",
        "End node",
        "Length [m]",
        "Geometrical shape",
        "LCS",
        "LCS Rotation [deg]",
        "Coordinate X [m]",
        "Coordinate Y [m]",
        "Coordinate Z [m]",
        "System line",
        "Analysis Y Eccentricity of Beg Node [mm]",
        "Analysis Z Eccentricity of Beg Node [mm]",
        "Analysis Y Eccentricity of End Node [mm]",
        "Analysis Z Eccentricity of End Node [mm]",
        "Layer",
        "Behaviour in analysis",
    ];
    header(book, "StructuralCurveMember", &columns);
    let members = &grid.schedule.members;
    for (k, ends) in members.ends.iter().enumerate() {
        let [a, b] = ends.map(|v| joints[v as usize]);
        let n = members.normal[k];
        let cells = [
            Made(format!("B{k}")),
            Text("General"),
            Text(SECTION),
            Made(format!("N{a};N{b}")),
            Text("Line"),
            Made(format!("N{a}")),
            Made(format!("N{b}")),
            Number(members.length[k]),
            Text("Line"),
            Text("z by vector"),
            Number(0.0),
            Number(n.x),
            Number(n.y),
            Number(n.z),
            Text("Centre"),
            Number(0.0),
            Number(0.0),
            Number(0.0),
            Number(0.0),
            Made(format!("group {}", members.group[k])),
            Text("Standard"),
        ];
        book.row(&cells);
    }
}

fn panels(book: &mut Workbook, grid: &GridFile, joints: &[u32]) {
    let columns = [
        "Name",
        "Type",
        "Material",
        "Thickness type",
        "Thickness [mm]",
        "System plane at",
        "Nodes",
        "Edges",
        "Area [m2]",
        "Layer",
        "LCS Type",
        "Coordinate X [m]",
        "Coordinate Y [m]",
        "Coordinate Z [m]",
        "LCS Rotation [deg]",
        "Analysis Z Eccentricity [mm]",
        "Shape",
        "Behavior in analysis",
    ];
    header(book, "StructuralSurfaceMember", &columns);
    let Schedule { panels, nodes, .. } = grid.schedule;
    for (k, t) in panels.nodes.iter().enumerate() {
        let [a, b, _] = *t;
        let x = (nodes.xyz[b as usize] - nodes.xyz[a as usize]).normalize_or_zero();
        let cells = [
            Made(format!("S{k}")),
            Text("Plate"),
            Text(Structure::PANE.name),
            Text("Constant"),
            Number(grid.structure.pane_mm),
            Text("Centre"),
            Made(t.map(|v| format!("N{}", joints[v as usize])).join(";")),
            Text("Line;Line;Line"),
            Number(panels.area[k]),
            Made(format!("panel {}", panels.group[k])),
            Text("x by vector"),
            Number(x.x),
            Number(x.y),
            Number(x.z),
            Number(0.0),
            Number(0.0),
            Text("Flat"),
            Text("Isotropic"),
        ];
        book.row(&cells);
    }
}

fn supports(book: &mut Workbook, grid: &GridFile, joints: &[u32]) {
    let columns = ["Name", "Type", "Node", "ux", "uy", "uz", "fix", "fiy", "fiz"];
    header(book, "StructuralPointSupport", &columns);
    let supported = grid.held(joints);
    for (k, v) in (0..supported.len()).filter(|&v| supported[v]).enumerate() {
        let (held, free) = ("Rigid", "Free");
        let cells = [
            Made(format!("Sn{k}")),
            Text("Hinged"),
            Made(format!("N{v}")),
            Text(held),
            Text(held),
            Text(held),
            Text(free),
            Text(free),
            Text(free),
        ];
        book.row(&cells);
    }
}
