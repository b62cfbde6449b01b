//! A grid as IFC4 (STEP text): a building with one assembly of members, each with its axis and an extruded body, and of
//! plates, each a triangle. Metres. Everything stands in world coordinates, so members share the points of their nodes.
//! After the IFC4 ADD2 specification.

use super::{GridFile, digest};
use crate::schedule::Schedule;
use crate::structure::{Section, Shape};
use glam::DVec3;
use std::fmt::Write;

/// The file as it grows.
struct Writer {
    out: String,
    /// Number of the latest entity.
    last: usize,
    /// What global identifiers are made of, besides a name.
    own: String,
}

/// Entities that all others refer to.
struct Common {
    origin: usize,
    placement: usize,
    up: usize,
    axis: usize,
    body: usize,
}

/// The file's bytes.
pub(super) fn encode(grid: &GridFile) -> Vec<u8> {
    let name = plain(&grid.document.name);
    let program = format!("gridshell {}", grid.document.version);
    let mut out = String::from("ISO-10303-21;\nHEADER;\n");
    out.push_str("FILE_DESCRIPTION(('ViewDefinition [ReferenceView_V1.2]'),'2;1');\n");
    // The same grid gives the same bytes on any day.
    let _ = writeln!(
        out,
        "FILE_NAME('{name}.ifc','2000-01-01T00:00:00',(''),(''),'{program}','{program}','');"
    );
    out.push_str("FILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n");
    let mut w = Writer { out, last: 0, own: grid.headline() };

    let (common, project) = context(&mut w, &name, &plain(&grid.headline()));
    let Common { placement, .. } = common;
    let id = w.id("building");
    let building =
        w.put(format_args!("IFCBUILDING('{id}',$,'{name}',$,$,#{placement},$,$,.ELEMENT.,$,$,$)"));
    let id = w.id("building of project");
    w.put(format_args!("IFCRELAGGREGATES('{id}',$,$,$,#{project},(#{building}))"));
    let id = w.id("assembly");
    let assembly = w.put(format_args!(
        "IFCELEMENTASSEMBLY('{id}',$,'{name}',$,'Gridshell',#{placement},$,$,.NOTDEFINED.,.USERDEFINED.)"
    ));
    let id = w.id("assembly in building");
    w.put(format_args!(
        "IFCRELCONTAINEDINSPATIALSTRUCTURE('{id}',$,$,$,(#{assembly}),#{building})"
    ));
    facts(&mut w, grid, assembly);
    let members = members(&mut w, grid, &common);
    let plates = plates(&mut w, grid, &common);
    let id = w.id("parts of assembly");
    let parts = references(members.clone().chain(plates.clone()));
    w.put(format_args!("IFCRELAGGREGATES('{id}',$,$,$,#{assembly},({parts}))"));
    let material = &grid.structure.material;
    for (parts, what, kind) in [
        (references(members), material.name, material.kind),
        (references(plates), crate::structure::Structure::PANE.name, "Glass"),
    ] {
        let material = w.put(format_args!("IFCMATERIAL('{what}',$,'{kind}')"));
        let id = w.id(what);
        w.put(format_args!("IFCRELASSOCIATESMATERIAL('{id}',$,$,$,({parts}),#{material})"));
    }
    w.out.push_str("ENDSEC;\nEND-ISO-10303-21;\n");
    w.out.into_bytes()
}

/// Units, contexts and what all share; and the project.
fn context(w: &mut Writer, name: &str, told: &str) -> (Common, usize) {
    let units = [
        ("LENGTHUNIT", "METRE"),
        ("AREAUNIT", "SQUARE_METRE"),
        ("VOLUMEUNIT", "CUBIC_METRE"),
        ("PLANEANGLEUNIT", "RADIAN"),
    ];
    let units = units.map(|(kind, unit)| w.put(format_args!("IFCSIUNIT(*,.{kind}.,$,.{unit}.)")));
    let [length, area, volume, angle] = units;
    let units = w.put(format_args!("IFCUNITASSIGNMENT((#{length},#{area},#{volume},#{angle}))"));
    let zero = w.put(format_args!("IFCCARTESIANPOINT((0.,0.,0.))"));
    let world = w.put(format_args!("IFCAXIS2PLACEMENT3D(#{zero},$,$)"));
    let model =
        w.put(format_args!("IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-6,#{world},$)"));
    let mut sub = |what: &str, view: &str| {
        w.put(format_args!(
            "IFCGEOMETRICREPRESENTATIONSUBCONTEXT('{what}','Model',*,*,*,*,#{model},$,.{view}.,$)"
        ))
    };
    let (axis, body) = (sub("Axis", "GRAPH_VIEW"), sub("Body", "MODEL_VIEW"));
    let placement = w.put(format_args!("IFCLOCALPLACEMENT($,#{world})"));
    let up = w.put(format_args!("IFCDIRECTION((0.,0.,1.))"));
    let flat = w.put(format_args!("IFCCARTESIANPOINT((0.,0.))"));
    let origin = w.put(format_args!("IFCAXIS2PLACEMENT2D(#{flat},$)"));
    let id = w.id("project");
    let project =
        w.put(format_args!("IFCPROJECT('{id}',$,'{name}','{told}',$,$,$,(#{model}),#{units})"));
    (Common { origin, placement, up, axis, body }, project)
}

/// The run and its figures as properties of the assembly.
fn facts(w: &mut Writer, grid: &GridFile, assembly: usize) {
    let (document, figures) = (grid.document, &grid.schedule.figures);
    let mut facts = vec![
        ("Program", format!("IFCLABEL('gridshell {}')", document.version)),
        ("Units", "IFCLABEL('m')".to_owned()),
        ("Nodes", format!("IFCINTEGER({})", document.nodes.len())),
        ("Members", format!("IFCINTEGER({})", grid.schedule.members.ends.len())),
        ("Panels", format!("IFCINTEGER({})", grid.schedule.panels.nodes.len())),
        ("LengthGroups", format!("IFCINTEGER({})", figures.length.groups)),
        ("DistinctPanels", format!("IFCINTEGER({})", figures.panel.distinct)),
        ("DistinctNodes", format!("IFCINTEGER({})", figures.distinct_nodes)),
        ("TotalLength", format!("IFCLENGTHMEASURE({})", real(figures.length.total))),
        ("TotalArea", format!("IFCAREAMEASURE({})", real(figures.panel.total_area))),
    ];
    if let Some(seed) = document.seed {
        // Larger seeds than its integers hold are labels.
        facts.push(("Seed", format!("IFCLABEL('{seed}')")));
    }
    if let Some(length) = document.edge_length {
        facts.push(("EdgeLength", format!("IFCLENGTHMEASURE({})", real(length))));
    }
    let first = w.last + 1;
    for (name, value) in &facts {
        w.put(format_args!("IFCPROPERTYSINGLEVALUE('{name}',$,{value},$)"));
    }
    let properties = references(first..=w.last);
    let id = w.id("facts");
    let set = w.put(format_args!("IFCPROPERTYSET('{id}',$,'Gridshell',$,({properties}))"));
    let id = w.id("facts of assembly");
    w.put(format_args!("IFCRELDEFINESBYPROPERTIES('{id}',$,$,$,(#{assembly}),#{set})"));
}

/// All members; gives their numbers.
fn members(
    w: &mut Writer,
    grid: &GridFile,
    common: &Common,
) -> impl Iterator<Item = usize> + Clone + use<> {
    /// Entities of a member, of which it is the last one.
    const EACH: usize = 9;
    let Schedule { nodes, members, .. } = grid.schedule;
    let section = &grid.structure.section;
    let profile = profile(w, section, common.origin);
    let points = w.last + 1;
    for p in &nodes.xyz {
        w.triple("IFCCARTESIANPOINT", *p);
    }
    let first = w.last + EACH;
    let Common { placement, up, axis, body, .. } = common;
    let kind = plain(&section.name);
    for (k, &[a, b]) in members.ends.iter().enumerate() {
        let x = (nodes.xyz[b as usize] - nodes.xyz[a as usize]).normalize_or_zero();
        let (from, to) = (points + a as usize, points + b as usize);
        let length = real(members.length[k]);
        let line = w.put(format_args!("IFCPOLYLINE((#{from},#{to}))"));
        let line =
            w.put(format_args!("IFCSHAPEREPRESENTATION(#{axis},'Axis','Curve3D',(#{line}))"));
        let along = w.triple("IFCDIRECTION", x);
        // The profile's height stands along the normal.
        let across = w.triple("IFCDIRECTION", members.normal[k].cross(x));
        let at = w.put(format_args!("IFCAXIS2PLACEMENT3D(#{from},#{along},#{across})"));
        let solid = w.put(format_args!("IFCEXTRUDEDAREASOLID(#{profile},#{at},#{up},{length})"));
        let solid =
            w.put(format_args!("IFCSHAPEREPRESENTATION(#{body},'Body','SweptSolid',(#{solid}))"));
        let shape = w.put(format_args!("IFCPRODUCTDEFINITIONSHAPE($,$,(#{line},#{solid}))"));
        let id = w.id(format_args!("member {k}"));
        let group = members.group[k];
        w.put(format_args!(
            "IFCMEMBER('{id}',$,'M{k}','length {length} m, group {group}','{kind}',#{placement},#{shape},'{k}',.MEMBER.)"
        ));
    }
    (first..=w.last).step_by(EACH)
}

/// All panels; gives their numbers.
fn plates(
    w: &mut Writer,
    grid: &GridFile,
    common: &Common,
) -> impl Iterator<Item = usize> + Clone + use<> {
    /// Entities of a panel, of which it is the last one.
    const EACH: usize = 5;
    let Schedule { nodes, panels, .. } = grid.schedule;
    let first = w.last + EACH;
    let Common { placement, body, .. } = common;
    for (k, t) in panels.nodes.iter().enumerate() {
        let [a, b, c] = t.map(|v| triple(nodes.xyz[v as usize]));
        let points = w.put(format_args!("IFCCARTESIANPOINTLIST3D(({a},{b},{c}))"));
        let face = w.put(format_args!("IFCTRIANGULATEDFACESET(#{points},$,.F.,((1,2,3)),$)"));
        let face =
            w.put(format_args!("IFCSHAPEREPRESENTATION(#{body},'Body','Tessellation',(#{face}))"));
        let shape = w.put(format_args!("IFCPRODUCTDEFINITIONSHAPE($,$,(#{face}))"));
        let id = w.id(format_args!("panel {k}"));
        let (area, group) = (real(panels.area[k]), panels.group[k]);
        w.put(format_args!(
            "IFCPLATE('{id}',$,'P{k}','area {area} m2, group {group}',$,#{placement},#{shape},'{k}',.CURTAIN_PANEL.)"
        ));
    }
    (first..=w.last).step_by(EACH)
}

fn profile(w: &mut Writer, section: &Section, origin: usize) -> usize {
    let m = |mm: f64| real(mm / 1e3);
    let name = plain(&section.name);
    let head = format!(".AREA.,'{name}',#{origin}");
    match section.shape {
        Shape::Tube { height, width, wall } => {
            let [outer, inner] = Shape::radii(wall).map(m);
            let (width, height, wall) = (m(width), m(height), m(wall));
            w.put(format_args!(
                "IFCRECTANGLEHOLLOWPROFILEDEF({head},{width},{height},{wall},{inner},{outer})"
            ))
        }
        Shape::Pipe { diameter, wall } => {
            let (radius, wall) = (m(0.5 * diameter), m(wall));
            w.put(format_args!("IFCCIRCLEHOLLOWPROFILEDEF({head},{radius},{wall})"))
        }
        Shape::Bar { height, width } => {
            let (width, height) = (m(width), m(height));
            w.put(format_args!("IFCRECTANGLEPROFILEDEF({head},{width},{height})"))
        }
    }
}

impl Writer {
    /// Put an entity behind the others; gives its number.
    fn put(&mut self, entity: std::fmt::Arguments) -> usize {
        self.last += 1;
        let _ = writeln!(self.out, "#{}={entity};", self.last);
        self.last
    }

    fn triple(&mut self, kind: &str, p: DVec3) -> usize {
        self.put(format_args!("{kind}({})", triple(p)))
    }

    /// A global identifier for this name in this file.
    fn id(&self, name: impl std::fmt::Display) -> String {
        digest::ifc_id(digest::fnv1a_128(format!("{} | {name}", self.own).as_bytes()))
    }
}

fn triple(p: DVec3) -> String {
    format!("({},{},{})", real(p.x), real(p.y), real(p.z))
}

/// A number as STEP wants it: with a point, and no exponent.
fn real(x: f64) -> String {
    let mut text = x.to_string();
    if !text.contains('.') {
        text.push('.');
    }
    text
}

fn references(numbers: impl Iterator<Item = usize>) -> String {
    let mut text = String::new();
    for n in numbers {
        let comma = if text.is_empty() { "" } else { "," };
        let _ = write!(text, "{comma}#{n}");
    }
    text
}

/// Letters that need no escape.
fn plain(text: &str) -> String {
    let known = |c: char| c == ' ' || c.is_ascii_graphic() && c != '\'' && c != '\\';
    text.chars().map(|c| if known(c) { c } else { '_' }).collect()
}
