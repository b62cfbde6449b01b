//! What there is and what is open, told to the page.

use crate::message::{Fact, Hello, Named, SurfaceInfo};
use crate::{color, form};
use gridshell::inspect::Inspection;
use gridshell::pipeline;
use gridshell::surface::{Surface, builtin};

/// Extensions of the files that can be opened.
pub const ACCEPTS: [&str; 12] =
    ["step", "stp", "iges", "igs", "obj", "ply", "stl", "off", "gltf", "glb", "json", "3dm"];
/// Extensions of the files that can be exported.
pub const EXPORTS: [(&str, &str); 14] = [
    ("gridshell", "gridshell: the grid and how it was made"),
    ("obj", "OBJ: panels, and members as lines"),
    ("ply", "PLY: panels"),
    ("stl", "STL: panels"),
    ("off", "OFF: panels"),
    ("glb", "glTF: for viewers"),
    ("dxf", "DXF: for drawings"),
    ("compas.json", "COMPAS mesh"),
    ("vtu", "VTK: with figures"),
    ("saf.xlsx", "SAF: for structural analysis"),
    ("ifc", "IFC4"),
    ("tcl", "OpenSees"),
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
pub fn info(inspection: &Inspection, sketch: &Surface) -> SurfaceInfo {
    let surface = &inspection.surface;
    let known = builtin::ALL.iter().find(|b| b.name == surface.name);
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
    let several = inspection.parts.len() > 1;
    let mut objects: Vec<String> = inspection
        .source
        .objects
        .iter()
        .map(|o| {
            [o.layer.as_str(), o.name.as_str()]
                .into_iter()
                .filter(|s| !s.is_empty())
                .collect::<Vec<_>>()
                .join(" / ")
        })
        .filter(|s| !s.is_empty())
        .collect();
    objects.dedup();
    SurfaceInfo {
        name: surface.name.clone(),
        source: known.map_or_else(|| inspection.source.format.clone(), |b| b.description.into()),
        facts,
        parts: if several {
            inspection.parts.iter().map(gridshell::run::PartSummary::told).collect()
        } else {
            Vec::new()
        },
        objects,
        notes: surface.notes.clone(),
        edge_length,
        bounds: [surface.bounds.min, surface.bounds.max],
    }
}

/// A number of things.
fn counted(n: usize, thing: &str) -> String {
    format!("{n} {thing}{}", if n == 1 { "" } else { "s" })
}
