//! JSON as a plain tree, lean enough for files of any contents: members of an object stay in a list, in their order.

use super::scan;
use crate::error::Result;
use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::path::Path;

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Json {
    /// `null`.
    Null,
    /// `true` or `false`.
    Truth(bool),
    /// Any number.
    Number(f64),
    /// A string.
    Text(Box<str>),
    /// An array.
    List(Box<[Json]>),
    /// An object.
    Map(Box<[(Box<str>, Json)]>),
}

/// The tree in a file's bytes.
///
/// # Errors
/// [`Error::Parse`](crate::Error::Parse) with the line.
pub(super) fn parse(path: &Path, bytes: &[u8]) -> Result<Json> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    serde_json::from_slice(bytes).map_err(|e| {
        // Python writes what no other program reads.
        let odd = ["NaN", "Infinity"]
            .into_iter()
            .find(|n| bytes.windows(n.len()).any(|w| w == n.as_bytes()));
        let hint = odd.map_or_else(String::new, |n| {
            format!("; `{n}` in it is not valid JSON; correct the value in the program that wrote the file")
        });
        scan::error(path, format!("line {}", e.line()), format!("this is no JSON: {e}{hint}"))
    })
}

impl Json {
    /// The member of this name, if it is an object that has one.
    pub fn get(&self, name: &str) -> Option<&Json> {
        self.members().iter().find(|m| &*m.0 == name).map(|m| &m.1)
    }

    /// The members of an object; none of anything else.
    pub fn members(&self) -> &[(Box<str>, Json)] {
        if let Json::Map(members) = self { members } else { &[] }
    }

    /// The items of an array, if it is one.
    pub fn list(&self) -> Option<&[Json]> {
        if let Json::List(items) = self { Some(items) } else { None }
    }

    /// The number, if it is one.
    pub fn number(&self) -> Option<f64> {
        if let Json::Number(x) = self { Some(*x) } else { None }
    }

    /// The string, if it is one.
    pub fn text(&self) -> Option<&str> {
        if let Json::Text(text) = self { Some(text) } else { None }
    }
}

impl<'de> Deserialize<'de> for Json {
    fn deserialize<D: Deserializer<'de>>(from: D) -> std::result::Result<Json, D::Error> {
        from.deserialize_any(Tree)
    }
}

struct Tree;

impl<'de> Visitor<'de> for Tree {
    type Value = Json;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> std::result::Result<Json, E> {
        Ok(Json::Null)
    }

    fn visit_bool<E>(self, truth: bool) -> std::result::Result<Json, E> {
        Ok(Json::Truth(truth))
    }

    fn visit_i64<E>(self, number: i64) -> std::result::Result<Json, E> {
        Ok(Json::Number(number as f64))
    }

    fn visit_u64<E>(self, number: u64) -> std::result::Result<Json, E> {
        Ok(Json::Number(number as f64))
    }

    fn visit_f64<E>(self, number: f64) -> std::result::Result<Json, E> {
        Ok(Json::Number(number))
    }

    fn visit_str<E>(self, text: &str) -> std::result::Result<Json, E> {
        Ok(Json::Text(text.into()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> std::result::Result<Json, A::Error> {
        let mut items = Vec::new();
        while let Some(item) = seq.next_element()? {
            items.push(item);
        }
        Ok(Json::List(items.into_boxed_slice()))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> std::result::Result<Json, A::Error> {
        let mut members = Vec::new();
        while let Some(member) = map.next_entry()? {
            members.push(member);
        }
        Ok(Json::Map(members.into_boxed_slice()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_of_every_kind_are_found_by_name_and_faults_by_line() {
        let text = br#"{"a": [1, -2.5, 1e3], "b": {"c": "d", "e": null, "f": true}}"#;
        let tree = parse(Path::new("x.json"), text).expect("JSON");
        let numbers = tree.get("a").and_then(Json::list).expect("a list");
        assert_eq!(numbers.iter().filter_map(Json::number).collect::<Vec<_>>(), [1.0, -2.5, 1e3]);
        let b = tree.get("b").expect("an object");
        assert_eq!(b.get("c").and_then(Json::text), Some("d"));
        assert_eq!((b.get("e"), b.get("f")), (Some(&Json::Null), Some(&Json::Truth(true))));
        let said =
            parse(Path::new("x.json"), b"{\n\"a\": [1,\n}").expect_err("cut off").to_string();
        assert!(said.starts_with("x.json: line 3: "), "{said}");
        let deep = "[".repeat(100_000);
        assert!(parse(Path::new("x.json"), deep.as_bytes()).is_err());
    }
}
