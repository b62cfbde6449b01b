//! A grid as IFC4 (STEP text): a building with one assembly of members, each with its axis and an extruded body, and of
//! plates, each a triangle; and where it is supported, a structural analysis model. Metres. Everything stands in world
//! coordinates, so members share the points of their nodes. After the IFC4 ADD2 specification.

mod analysis;
mod step;

use super::GridFile;
use crate::job::Job;
use crate::schedule::Schedule;
use crate::structure::{Material, Section, Shape, Structure};
use std::fmt::Write;
use step::{Real, Step, Triple, encoded, references};

/// Entities that all others refer to.
struct Common {
    placement: usize,
    up: usize,
    axis: usize,
    body: usize,
    reference: usize,
    /// Section and material of the members.
    profile: usize,
    material: usize,
    /// The point of the first node; the others follow.
    points: usize,
}

/// The file's bytes.
pub(super) fn encode(grid: &GridFile, job: &Job) -> Vec<u8> {
    let name = encoded(&grid.document.name);
    let program = format!("gridshell {}", grid.document.version);
    let mut out = String::from("ISO-10303-21;\nHEADER;\n");
    let views = if is_held(grid) {
        "ReferenceView_V1.2, StructuralAnalysisView"
    } else {
        "ReferenceView_V1.2"
    };
    let _ = writeln!(out, "FILE_DESCRIPTION(('ViewDefinition [{views}]'),'2;1');");
    // The same grid gives the same bytes on any day.
    let _ = writeln!(
        out,
        "FILE_NAME('{name}.ifc','2000-01-01T00:00:00',(''),(''),'{program}','{program}','');"
    );
    out.push_str("FILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n");
    let mut w = Step::new(out, &grid.headline(), job);

    let (common, project) = context(&mut w, grid, &name);
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
    let pane = w.put(format_args!("IFCMATERIAL('{}',$,'Glass')", Structure::PANE.name));
    for (parts, what, material) in [
        (references(members), "material of members", common.material),
        (references(plates), "material of panels", pane),
    ] {
        let id = w.id(what);
        w.put(format_args!("IFCRELASSOCIATESMATERIAL('{id}',$,$,$,({parts}),#{material})"));
    }
    if is_held(grid) {
        analysis::put(&mut w, grid, &common, building);
    }
    w.out.push_str("ENDSEC;\nEND-ISO-10303-21;\n");
    w.out.into_bytes()
}

/// Whether it is supported: a frame that nothing holds is not a model for analysis.
fn is_held(grid: &GridFile) -> bool {
    !grid.document.supports.is_empty()
}

/// Units, contexts and what all share; and the project.
fn context(w: &mut Step, grid: &GridFile, name: &str) -> (Common, usize) {
    let units = [
        ("LENGTHUNIT", "METRE"),
        ("AREAUNIT", "SQUARE_METRE"),
        ("VOLUMEUNIT", "CUBIC_METRE"),
        ("PLANEANGLEUNIT", "RADIAN"),
        ("PRESSUREUNIT", "PASCAL"),
    ];
    let units = units.map(|(kind, unit)| w.put(format_args!("IFCSIUNIT(*,.{kind}.,$,.{unit}.)")));
    let units = references(units.into_iter());
    let units = w.put(format_args!("IFCUNITASSIGNMENT(({units}))"));
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
    let reference = sub("Reference", "GRAPH_VIEW");
    let placement = w.put(format_args!("IFCLOCALPLACEMENT($,#{world})"));
    let up = w.put(format_args!("IFCDIRECTION((0.,0.,1.))"));
    let flat = w.put(format_args!("IFCCARTESIANPOINT((0.,0.))"));
    let origin = w.put(format_args!("IFCAXIS2PLACEMENT2D(#{flat},$)"));
    let (id, told) = (w.id("project"), encoded(&grid.headline()));
    let project =
        w.put(format_args!("IFCPROJECT('{id}',$,'{name}','{told}',$,$,$,(#{model}),#{units})"));
    let profile = profile(w, &grid.structure.section, origin);
    let material = material(w, &grid.structure.material);
    let points = w.last + 1;
    for p in &grid.schedule.nodes.xyz {
        w.triple("IFCCARTESIANPOINT", *p);
    }
    (Common { placement, up, axis, body, reference, profile, material, points }, project)
}

/// The material of the members, with its moduli.
fn material(w: &mut Step, material: &Material) -> usize {
    let number = w.put(format_args!("IFCMATERIAL('{}',$,'{}')", material.name, material.kind));
    let first = w.last + 1;
    for (name, mpa) in [("YoungModulus", material.youngs_mpa), ("ShearModulus", material.shear_mpa)]
    {
        let value = Real(1e6 * mpa);
        w.put(format_args!(
            "IFCPROPERTYSINGLEVALUE('{name}',$,IFCMODULUSOFELASTICITYMEASURE({value}),$)"
        ));
    }
    let facts = references(first..=w.last);
    w.put(format_args!("IFCMATERIALPROPERTIES('Pset_MaterialMechanical',$,({facts}),#{number})"));
    number
}

/// The run and its figures as properties of the assembly.
fn facts(w: &mut Step, grid: &GridFile, assembly: usize) {
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
        ("TotalLength", format!("IFCLENGTHMEASURE({})", Real(figures.length.total))),
        ("TotalArea", format!("IFCAREAMEASURE({})", Real(figures.panel.total_area))),
    ];
    if let Some(seed) = document.seed {
        // Larger seeds than its integers hold are labels.
        facts.push(("Seed", format!("IFCLABEL('{seed}')")));
    }
    if let Some(length) = document.edge_length {
        facts.push(("EdgeLength", format!("IFCLENGTHMEASURE({})", Real(length))));
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
    w: &mut Step,
    grid: &GridFile,
    common: &Common,
) -> impl Iterator<Item = usize> + Clone + use<> {
    /// Entities of a member, of which it is the last one.
    const EACH: usize = 9;
    let Schedule { nodes, members, .. } = grid.schedule;
    let section = &grid.structure.section;
    let first = w.last + EACH;
    let Common { placement, up, axis, body, profile, points, .. } = common;
    let kind = encoded(&section.name);
    for (k, &[a, b]) in members.ends.iter().enumerate() {
        let x = (nodes.xyz[b as usize] - nodes.xyz[a as usize]).normalize_or_zero();
        let (from, to) = (points + a as usize, points + b as usize);
        let length = Real(members.length[k]);
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
    w: &mut Step,
    grid: &GridFile,
    common: &Common,
) -> impl Iterator<Item = usize> + Clone + use<> {
    /// Entities of a panel, of which it is the last one.
    const EACH: usize = 5;
    let Schedule { nodes, panels, .. } = grid.schedule;
    let first = w.last + EACH;
    let Common { placement, body, .. } = common;
    for (k, t) in panels.nodes.iter().enumerate() {
        let [a, b, c] = t.map(|v| Triple(nodes.xyz[v as usize]));
        let points = w.put(format_args!("IFCCARTESIANPOINTLIST3D(({a},{b},{c}))"));
        let face = w.put(format_args!("IFCTRIANGULATEDFACESET(#{points},$,.F.,((1,2,3)),$)"));
        let face =
            w.put(format_args!("IFCSHAPEREPRESENTATION(#{body},'Body','Tessellation',(#{face}))"));
        let shape = w.put(format_args!("IFCPRODUCTDEFINITIONSHAPE($,$,(#{face}))"));
        let id = w.id(format_args!("panel {k}"));
        let (area, group) = (Real(panels.area[k]), panels.group[k]);
        w.put(format_args!(
            "IFCPLATE('{id}',$,'P{k}','area {area} m2, group {group}',$,#{placement},#{shape},'{k}',.CURTAIN_PANEL.)"
        ));
    }
    (first..=w.last).step_by(EACH)
}

fn profile(w: &mut Step, section: &Section, origin: usize) -> usize {
    let m = |mm: f64| Real(mm / 1e3);
    let name = encoded(&section.name);
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
