//! Which objects of a file are read, by the names of layers and objects.

#[cfg(feature = "3dm")]
use crate::error::{Error, Result};
use crate::surface::Object;
use serde::{Deserialize, Serialize};
#[cfg(feature = "3dm")]
use std::path::Path;

/// Longer lists of names are cut.
#[cfg(feature = "3dm")]
const MOST_TOLD: usize = 30;

/// Which objects of a file are read. Without names: all that the file shows.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Choice {
    /// Layers, by name or by path (`Roof::Panels`), those below them included.
    pub layers: Vec<String>,
    /// Objects, by name.
    pub objects: Vec<String>,
}

impl Choice {
    /// Whether nothing is chosen: all is read.
    pub fn is_all(&self) -> bool {
        self.layers.is_empty() && self.objects.is_empty()
    }

    /// Whether an object is among the chosen ones, or `shown` where nothing is chosen.
    pub fn takes(&self, object: &Object, shown: bool) -> bool {
        let on_layer = self.layers.iter().any(|name| is_below(&object.layer, name));
        let named = self.objects.iter().any(|name| same(&object.name, name));
        match (self.layers.is_empty(), self.objects.is_empty()) {
            (true, true) => shown,
            (false, true) => on_layer,
            (true, false) => named,
            (false, false) => on_layer && named,
        }
    }

    /// Refuse names that no object has.
    ///
    /// # Errors
    /// [`Error::Option`] listing the names there are.
    #[cfg(feature = "3dm")]
    pub(super) fn check(&self, path: &Path, objects: &[Object]) -> Result<()> {
        let unknown = |kind: &str, name: &str, known: Vec<&str>| {
            let mut known: Vec<&str> = known.into_iter().filter(|k| !k.is_empty()).collect();
            known.sort_unstable();
            known.dedup();
            let more = known.len().saturating_sub(MOST_TOLD);
            known.truncate(MOST_TOLD);
            let mut list = known.join(", ");
            match (more, list.is_empty()) {
                (0, true) => "none has a name".clone_into(&mut list),
                (0, false) => {}
                _ => list += &format!(" and {more} more"),
            }
            let path = path.display();
            Err(Error::Option(format!(
                "{path}: nothing to read on {kind} `{name}`; there are: {list}"
            )))
        };
        for name in &self.layers {
            if !objects.iter().any(|o| is_below(&o.layer, name)) {
                return unknown("layer", name, objects.iter().map(|o| o.layer.as_str()).collect());
            }
        }
        for name in &self.objects {
            if !objects.iter().any(|o| same(&o.name, name)) {
                return unknown("object", name, objects.iter().map(|o| o.name.as_str()).collect());
            }
        }
        Ok(())
    }
}

/// Names are compared as people do, whatever their case.
fn same(a: &str, b: &str) -> bool {
    a.to_lowercase() == b.to_lowercase()
}

/// Whether the layer of this path is `name`, or lies below it.
fn is_below(path: &str, name: &str) -> bool {
    let mut from = 0;
    loop {
        let rest = &path[from..];
        let ends = rest.match_indices("::").map(|(k, _)| k).chain([rest.len()]);
        if ends.into_iter().any(|k| same(&rest[..k], name)) {
            return true;
        }
        match rest.find("::") {
            Some(k) => from += k + 2,
            None => return false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_are_found_by_name_and_by_path_and_hold_those_below() {
        for name in ["Roof", "roof", "Roof::Panels", "Panels", "Panels::Left", "Left"] {
            assert!(is_below("Roof::Panels::Left", name), "{name}");
        }
        for name in ["Roo", "Roof::Left", "Panel", ""] {
            assert!(!is_below("Roof::Panels::Left", name), "{name}");
        }
    }

    #[test]
    fn hidden_objects_are_read_only_where_they_are_chosen() {
        let object = Object { name: "shell".into(), layer: "Roof".into(), ..Object::default() };
        let choice = |layers: &[&str], objects: &[&str]| Choice {
            layers: layers.iter().map(|&s| s.to_owned()).collect(),
            objects: objects.iter().map(|&s| s.to_owned()).collect(),
        };
        assert!(!choice(&[], &[]).takes(&object, false));
        assert!(choice(&["roof"], &[]).takes(&object, false));
        assert!(!choice(&["roof"], &["other"]).takes(&object, true));
    }

    #[cfg(feature = "3dm")]
    #[test]
    fn names_that_are_not_there_are_refused_with_those_that_are() {
        let object = Object { layer: "Roof".into(), ..Object::default() };
        let choice = Choice { layers: vec!["Rof".into()], ..Choice::default() };
        let error = choice.check(Path::new("a.3dm"), &[object]).unwrap_err();
        assert!(error.to_string().contains("there are: Roof"), "{error}");
    }
}
