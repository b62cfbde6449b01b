//! Which product each mapped item belongs to: the parser tells the items of a representation that it maps only.

use super::text::{Record, Text, references};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use step_io::scene::Scene;
use step_io::{EntityKey, Report};

/// Mapped items by the product definition whose shape they are part of.
pub(super) fn of_mapped_items(
    text: &Text,
    report: &Report,
    scene: &Scene,
) -> HashMap<EntityKey, EntityKey> {
    let items: Vec<EntityKey> = scene.all_mapped_instances().map(|m| m.key()).collect();
    if items.is_empty() {
        return HashMap::new();
    }
    let definitions: Vec<EntityKey> = scene.all_product_definitions().map(|d| d.key()).collect();
    // The parser keeps entities of a kind in the order of the file.
    let item_ids = kept(text, report, &["MAPPED_ITEM"]);
    let definition_ids =
        kept(text, report, &["PRODUCT_DEFINITION", "PRODUCT_DEFINITION_WITH_ASSOCIATED_DOCUMENTS"]);
    if item_ids.len() != items.len() || definition_ids.len() != definitions.len() {
        return HashMap::new();
    }
    let definition_of: BTreeMap<u64, EntityKey> =
        definition_ids.into_iter().zip(definitions).collect();
    let mut holder: BTreeMap<u64, u64> = BTreeMap::new();
    for record in text.records.iter().filter(|r| text.keyword(r).ends_with(b"REPRESENTATION")) {
        for item in text.list(record).get(1).into_iter().flat_map(|l| references(text, l)) {
            holder.entry(item).or_insert(record.id);
        }
    }
    let shapes = Shapes::of(text);
    let owner = |id: &u64| definition_of.get(&shapes.definition(*holder.get(id)?)?).copied();
    let pairs = item_ids.iter().zip(items);
    pairs.filter_map(|(id, key)| Some((key, owner(id)?))).collect()
}

/// Identifiers of the entities of these kinds that the parser kept, kind by kind.
pub(super) fn kept(text: &Text, report: &Report, keywords: &[&str]) -> Vec<u64> {
    let kept = |r: &&Record| report.dropped.binary_search_by_key(&r.id, |(id, _)| *id).is_err();
    let of_kind = |keyword: &&str| {
        let keyword = keyword.as_bytes().to_vec();
        let all = text.records.iter().filter(move |r| text.keyword(r) == keyword);
        all.filter(kept).map(|r| r.id).collect::<Vec<_>>()
    };
    keywords.iter().flat_map(of_kind).collect()
}

/// Whose shape each representation is.
struct Shapes {
    definitions: BTreeMap<u64, u64>,
    /// Representations of one thing.
    alike: BTreeMap<u64, Vec<u64>>,
}

impl Shapes {
    fn of(text: &Text) -> Shapes {
        let mut shapes = Shapes { definitions: BTreeMap::new(), alike: BTreeMap::new() };
        for record in &text.records {
            match text.keyword(record) {
                b"SHAPE_DEFINITION_REPRESENTATION" => {
                    let shape = text.target(record, 0).and_then(|s| text.target(s, 2));
                    let Some((part, held)) = shape.zip(text.target(record, 1)) else { continue };
                    shapes.definitions.insert(held.id, part.id);
                }
                b"SHAPE_REPRESENTATION_RELATIONSHIP" | b"REPRESENTATION_RELATIONSHIP" => {
                    let pair = text.target(record, 2).zip(text.target(record, 3));
                    let Some([a, b]) = pair.map(|(a, b)| [a.id, b.id]) else { continue };
                    shapes.alike.entry(a).or_default().push(b);
                    shapes.alike.entry(b).or_default().push(a);
                }
                _ => {}
            }
        }
        shapes
    }

    fn definition(&self, representation: u64) -> Option<u64> {
        let (mut open, mut met) = (vec![representation], BTreeSet::new());
        while let Some(id) = open.pop().filter(|id| met.insert(*id)) {
            if let Some(&found) = self.definitions.get(&id) {
                return Some(found);
            }
            open.extend(self.alike.get(&id).into_iter().flatten());
        }
        None
    }
}
