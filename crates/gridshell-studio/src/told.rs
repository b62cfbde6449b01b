//! What there is and what is open, told to the page.

use crate::message::{Fact, Hello, Named, Object, Part, SurfaceInfo};
use crate::{color, form};
use gridshell::inspect::Inspection;
use gridshell::pipeline;
use gridshell::run::PartSummary;
use gridshell::surface::{Surface, builtin};
use gridshell::words::counted;

/// Extensions of the files that can be opened.
pub const ACCEPTS: [&str; 13] = [
    "gridshell",
    "step",
    "stp",
    "iges",
    "igs",
    "obj",
    "ply",
    "stl",
    "off",
    "gltf",
    "glb",
    "json",
    "3dm",
];
/// Extensions of the files that can be exported.
pub const EXPORTS: [(&str, &str); 16] = [
    ("gridshell", "gridshell: grid, surface, recipe and edits, to go on with"),
    ("report.html", "Report: one page with pictures, measures and tables"),
    ("csv.zip", "CSV: schedules of nodes, members and panels"),
    ("obj", "OBJ: panels, and members as lines"),
    ("dxf", "DXF: members, panels and nodes in layers"),
    ("ifc", "IFC4: members and plates"),
    ("saf.xlsx", "SAF: structural model"),
    ("compas.json", "COMPAS: mesh"),
    ("glb", "glTF: panels and members"),
    ("ply", "PLY: panels, with measures"),
    ("stl", "STL: panels"),
    ("off", "OFF: panels"),
    ("vtu", "VTK: panels and members, with measures"),
    ("tcl", "OpenSees: elastic frame under its own weight"),
    ("run.json", "JSON: the run document, all measures"),
    ("edits.json", "JSON: the log of edits, for `gridshell edit`"),
];
/// Largest file that can be opened, bytes.
pub const UPLOAD_LIMIT: usize = 64 << 20;

/// What there is.
pub fn hello() -> Hello {
    let named = |name: &str, description: &str| Named {
        name: name.into(),
        description: description.into(),
    };
    Hello {
        version: env!("CARGO_PKG_VERSION").into(),
        builtins: builtin::ALL.iter().map(|b| named(b.name, b.description)).collect(),
        form: form::fields(),
        colorings: color::colorings(),
        accepts: ACCEPTS.map(str::to_owned).to_vec(),
        exports: EXPORTS.iter().map(|e| named(e.0, e.1)).collect(),
        upload_limit: UPLOAD_LIMIT as u32,
    }
}

/// What is known of a surface.
pub fn info(inspection: &Inspection, sketch: &Surface, built_in: bool) -> SurfaceInfo {
    let surface = &inspection.surface;
    let known = builtin::ALL.iter().find(|b| built_in && b.name == surface.name);
    let edge_length = known.map_or_else(|| pipeline::length_for(sketch, 1000), |b| b.edge_length);
    let fact = |label: &str, value: String| Fact { label: label.into(), value };
    let size = [0, 1, 2].map(|k| surface.bounds.max[k] - surface.bounds.min[k]);
    let mut facts = vec![
        fact("Area", format!("{:.1} m²", surface.area)),
        fact("Size", format!("{:.1} × {:.1} × {:.1} m", size[0], size[1], size[2])),
        fact(
            "Patches",
            if surface.patches == 0 { "a mesh".into() } else { surface.patches.to_string() },
        ),
        fact(
            "Boundary",
            format!("{}, {}", counted(surface.loops, "loop"), counted(surface.corners, "corner")),
        ),
    ];
    if !inspection.creases.is_empty() {
        facts.push(fact("Creases", inspection.creases.len().to_string()));
    }
    // As lists of layers and objects have it: without its kind and layer.
    let short = |told: &String| {
        let mut objects = inspection.source.objects.iter();
        let named = objects.find(|o| o.told() == *told && !o.name.is_empty());
        named.map_or_else(|| told.clone(), |o| o.name.clone())
    };
    let part = |p: &PartSummary| Part {
        number: p.number as u32,
        name: p.objects.iter().map(short).collect::<Vec<_>>().join(", "),
        faces: p.faces as u32,
        area: p.area,
        fault: p.fault.clone(),
    };
    let object = |o: &gridshell::surface::Object| Object {
        name: o.name.clone(),
        layer: o.layer.clone(),
        kind: o.kind.clone(),
        faces: o.faces as u32,
    };
    let several = Some(&inspection.parts).filter(|parts| parts.len() > 1);
    SurfaceInfo {
        name: surface.name.clone(),
        built_in,
        source: known.map_or_else(|| inspection.source.format.clone(), |b| b.description.into()),
        facts,
        parts: several.into_iter().flatten().map(part).collect(),
        objects: inspection.source.objects.iter().map(object).collect(),
        // What is missing comes first: no grid is laid without it unless that is accepted.
        notes: inspection.source.told_losses().into_iter().chain(surface.notes.clone()).collect(),
        edge_length,
        bounds: [surface.bounds.min, surface.bounds.max],
    }
}
