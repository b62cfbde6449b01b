//! What a file says of itself: version, program, unit, layers.

use super::convert::METRES;
use crate::surface::{Object, Source, Unit};
use cadmpeg_ir::CadIr;
use std::collections::BTreeMap;

/// A layer.
pub(super) struct Layer {
    /// Its place in the file's table.
    pub index: i64,
    /// Its name behind those of the layers that hold it: `Roof::Panels`.
    pub path: String,
    /// Neither it nor one that holds it is hidden.
    pub shown: bool,
}

/// All layers by their identifier.
pub(super) fn layers(ir: &CadIr) -> BTreeMap<String, Layer> {
    let mut known: BTreeMap<String, (String, Option<String>, bool, i64)> = BTreeMap::new();
    let records = ir.native.namespace("rhino").and_then(|n| n.arenas().get("layers"));
    for record in records.into_iter().flatten() {
        let text = |field: &str| record.field(field)?.as_str().map(str::to_owned);
        let shown = record.field("visible").and_then(|v| v.as_bool()) != Some(false);
        let index = record.field("archive_index").and_then(|v| v.as_i64()).unwrap_or(-1);
        if let (Some(id), Some(name)) = (text("source_uuid"), text("name")) {
            known.insert(id, (name, text("parent_uuid"), shown, index));
        }
    }
    let layer = |id: &String| {
        let (mut path, mut parent, mut shown, index) = known[id].clone();
        // No deeper than there are layers: some files have cycles.
        for _ in 0..known.len() {
            let Some((name, above, on, _)) = parent.as_ref().and_then(|p| known.get(p)) else {
                break;
            };
            path = format!("{name}::{path}");
            shown &= on;
            parent.clone_from(above);
        }
        Layer { index, path, shown }
    };
    known.keys().map(|id| (id.clone(), layer(id))).collect()
}

/// The version of Rhino by the file's first 32 bytes: a text and a number of eight digits, blanks before it.
pub(super) fn version(bytes: &[u8]) -> String {
    let digits = bytes.get(24..32).map(String::from_utf8_lossy).unwrap_or_default();
    match digits.trim().parse::<u32>() {
        // From Rhino 5 on there is a digit for changes within a version.
        Ok(n) if n >= 50 => format!("Rhino {}", n / 10),
        Ok(n) => format!("Rhino {n}"),
        Err(_) => String::new(),
    }
}

/// What the file says of itself.
pub(super) fn source(ir: &CadIr, objects: Vec<Object>) -> Source {
    let meta = ir.source.as_ref();
    let attribute = |name: &str| {
        let found = meta?.attributes.iter().find(|(key, _)| key.as_str() == name);
        found.map(|(_, value)| value.trim().to_owned()).filter(|value| !value.is_empty())
    };
    let unit = attribute("millimeters_per_unit").and_then(|mm| mm.parse::<f64>().ok());
    let unit = unit.filter(|mm| mm.is_finite() && *mm > 0.0).map(|mm| Unit::of_metres(mm * METRES));
    let name = attribute("application_name");
    let details = attribute("application_details");
    let application = [name, details].into_iter().flatten().collect::<Vec<_>>().join(", ");
    Source { application, unit, objects, ..Source::of_format("3DM") }
}
