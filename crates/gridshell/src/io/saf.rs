//! A grid in the Structural Analysis Format (SAF, `.saf.xlsx`), version 2.0.0 or 1.0.5: one sheet a kind, after the
//! public specification. The surface's normal is every member's local z axis. Lists are joined by semicolons; section,
//! material and panes are stated assumptions of [`Structure`](crate::structure::Structure).

use super::GridFile;
use crate::schedule::Schedule;
use crate::structure::{Material, Shape, Structure};
use rust_xlsxwriter::{DocProperties, ExcelDateTime, Workbook, Worksheet, XlsxError};

/// Rows of a sheet, its header included.
const MOST_ROWS: usize = 1_048_576;

/// Name of the only cross-section.
const SECTION: &str = "CS1";

/// A cell.
enum Cell<'a> {
    /// Blank.
    None,
    Number(f64),
    Text(&'a str),
    Made(String),
}
use Cell::{Made, None as Blank, Number, Text};

type Sheets<T> = Result<T, XlsxError>;

/// The file's bytes; the error says why it cannot be.
pub(super) fn encode(grid: &GridFile) -> Result<Vec<u8>, String> {
    if grid.schedule.members.ends.len() >= MOST_ROWS {
        return Err(format!(
            "{} members: a sheet holds {} rows; write another format, or a coarser grid",
            grid.schedule.members.ends.len(),
            MOST_ROWS - 1
        ));
    }
    workbook(grid).map_err(|e| format!("the workbook cannot be made: {e}"))
}

fn workbook(grid: &GridFile) -> Sheets<Vec<u8>> {
    let mut book = Workbook::new();
    // The same grid gives the same bytes on any day.
    let day = ExcelDateTime::from_ymd(2000, 1, 1)?;
    book.set_properties(&DocProperties::new().set_creation_datetime(&day));
    project(book.add_worksheet(), grid)?;
    model(book.add_worksheet(), grid)?;
    materials(book.add_worksheet(), grid)?;
    sections(book.add_worksheet(), &grid.structure)?;
    nodes(book.add_worksheet(), grid.schedule)?;
    members(book.add_worksheet(), grid)?;
    panels(book.add_worksheet(), grid)?;
    supports(book.add_worksheet(), grid)?;
    book.save_to_buffer()
}

/// Two columns: what, and its value.
fn properties(sheet: &mut Worksheet, name: &str, rows: &[(&str, Cell)]) -> Sheets<()> {
    sheet.set_name(name)?;
    for (row, (what, value)) in rows.iter().enumerate() {
        sheet.write_string(row as u32, 0, *what)?;
        write(sheet, row as u32, 1, value)?;
    }
    Ok(())
}

fn header(sheet: &mut Worksheet, name: &str, columns: &[&str]) -> Sheets<()> {
    sheet.set_name(name)?;
    for (column, what) in columns.iter().enumerate() {
        sheet.write_string(0, column as u16, *what)?;
    }
    Ok(())
}

fn row(sheet: &mut Worksheet, number: usize, cells: &[Cell]) -> Sheets<()> {
    for (column, cell) in cells.iter().enumerate() {
        write(sheet, number as u32 + 1, column as u16, cell)?;
    }
    Ok(())
}

fn write(sheet: &mut Worksheet, row: u32, column: u16, cell: &Cell) -> Sheets<()> {
    match cell {
        Cell::None => return Ok(()),
        Number(x) => sheet.write_number(row, column, *x)?,
        Text(text) => sheet.write_string(row, column, *text)?,
        Made(text) => sheet.write_string(row, column, text)?,
    };
    Ok(())
}

fn project(sheet: &mut Worksheet, grid: &GridFile) -> Sheets<()> {
    let rows = [
        ("Name", Made(grid.document.name.replace(char::is_control, " "))),
        ("Description", Made(grid.headline())),
        ("Status", Text("Draft")),
    ];
    properties(sheet, "Project", &rows)
}

fn model(sheet: &mut Worksheet, grid: &GridFile) -> Sheets<()> {
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
    properties(sheet, "Model", &rows)
}

fn materials(sheet: &mut Worksheet, grid: &GridFile) -> Sheets<()> {
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
    header(sheet, "StructuralMaterial", &columns)?;
    let all: [&Material; 2] = [&grid.structure.material, &Structure::PANE];
    for (k, m) in all.into_iter().enumerate() {
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
        row(sheet, k, &cells)?;
    }
    Ok(())
}

fn sections(sheet: &mut Worksheet, structure: &Structure) -> Sheets<()> {
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
    header(sheet, "StructuralCrossSection", &columns)?;
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
    row(sheet, 0, &cells)
}

fn nodes(sheet: &mut Worksheet, schedule: &Schedule) -> Sheets<()> {
    let columns = ["Name", "Coordinate X [m]", "Coordinate Y [m]", "Coordinate Z [m]"];
    header(sheet, "StructuralPointConnection", &columns)?;
    for (v, p) in schedule.nodes.xyz.iter().enumerate() {
        row(sheet, v, &[Made(format!("N{v}")), Number(p.x), Number(p.y), Number(p.z)])?;
    }
    Ok(())
}

fn members(sheet: &mut Worksheet, grid: &GridFile) -> Sheets<()> {
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
    header(sheet, "StructuralCurveMember", &columns)?;
    let members = &grid.schedule.members;
    for (k, [a, b]) in members.ends.iter().enumerate() {
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
        row(sheet, k, &cells)?;
    }
    Ok(())
}

fn panels(sheet: &mut Worksheet, grid: &GridFile) -> Sheets<()> {
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
    header(sheet, "StructuralSurfaceMember", &columns)?;
    let Schedule { panels, nodes, .. } = grid.schedule;
    for (k, t) in panels.nodes.iter().enumerate() {
        let [a, b, c] = *t;
        let x = (nodes.xyz[b as usize] - nodes.xyz[a as usize]).normalize_or_zero();
        let cells = [
            Made(format!("S{k}")),
            Text("Plate"),
            Text(Structure::PANE.name),
            Text("Constant"),
            Number(grid.structure.pane_mm),
            Text("Centre"),
            Made(format!("N{a};N{b};N{c}")),
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
        row(sheet, k, &cells)?;
    }
    Ok(())
}

fn supports(sheet: &mut Worksheet, grid: &GridFile) -> Sheets<()> {
    let columns = ["Name", "Type", "Node", "ux", "uy", "uz", "fix", "fiy", "fiz"];
    header(sheet, "StructuralPointSupport", &columns)?;
    for (k, v) in grid.document.supports.iter().enumerate() {
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
        row(sheet, k, &cells)?;
    }
    Ok(())
}
