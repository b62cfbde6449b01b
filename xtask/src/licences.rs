//! The licences of all that is in the command.

use crate::build::read_cargo;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// How files with licences begin.
const NAMES: [&str; 5] = ["license", "licence", "copying", "notice", "unlicense"];

/// A package with its licences.
struct Package {
    name: String,
    version: String,
    licence: String,
    texts: Vec<(String, String)>,
}

/// Every package of others in the command as it is built for this target, with its licence and the texts that it brings.
pub fn of_dependencies(target: &str) -> Result<String, String> {
    let metadata = read_cargo(&[
        "metadata",
        "--format-version",
        "1",
        "--locked",
        "--filter-platform",
        target,
    ])?;
    let metadata: Value = serde_json::from_str(&metadata).map_err(|e| e.to_string())?;
    let inside = inside(&metadata, "gridshell-cli");
    let packages = list(&metadata["packages"])
        .filter(|p| inside.contains(text(&p["id"])) && p["source"].is_string());
    let mut packages: Vec<Package> = packages.map(package).collect();
    packages.sort_by(|a, b| (&a.name, &a.version).cmp(&(&b.name, &b.version)));
    Ok(document(&packages))
}

/// The ids of a package and of all that it needs to run.
fn inside<'a>(metadata: &'a Value, name: &str) -> BTreeSet<&'a str> {
    let nodes: BTreeMap<&str, &Value> =
        list(&metadata["resolve"]["nodes"]).map(|node| (text(&node["id"]), node)).collect();
    let first = list(&metadata["packages"]).find(|p| p["name"] == name);
    let mut waiting: Vec<&str> = first.map(|p| text(&p["id"])).into_iter().collect();
    let mut inside = BTreeSet::new();
    while let Some(id) = waiting.pop() {
        if inside.insert(id) {
            let needed = nodes.get(id).map(|node| list(&node["deps"])).into_iter().flatten();
            let normal = |dep: &&Value| list(&dep["dep_kinds"]).any(|kind| kind["kind"].is_null());
            waiting.extend(needed.filter(normal).map(|dep| text(&dep["pkg"])));
        }
    }
    inside
}

fn package(package: &Value) -> Package {
    let folder = Path::new(text(&package["manifest_path"])).parent();
    let entries = folder.and_then(|folder| fs::read_dir(folder).ok()).into_iter().flatten();
    let mut texts: Vec<(String, String)> = entries
        .flatten()
        .map(|entry| (entry.file_name().to_string_lossy().into_owned(), entry.path()))
        .filter(|(name, _)| NAMES.iter().any(|n| name.to_lowercase().starts_with(n)))
        .filter_map(|(name, path)| Some((name, fs::read_to_string(path).ok()?)))
        .collect();
    texts.sort();
    Package {
        name: text(&package["name"]).to_owned(),
        version: text(&package["version"]).to_owned(),
        licence: package["license"].as_str().unwrap_or("see its text").to_owned(),
        texts,
    }
}

/// A list of the packages, then their texts, each once.
fn document(packages: &[Package]) -> String {
    let mut all = "The command gridshell contains these packages:\n\n".to_owned();
    for Package { name, version, licence, .. } in packages {
        let _ = writeln!(all, "{name} {version}: {licence}");
    }
    let mut first = BTreeMap::new();
    for Package { name, version, texts, .. } in packages {
        let _ = writeln!(all, "\n{}\n{name} {version}\n", "=".repeat(80));
        if texts.is_empty() {
            all += "The package has no text of its licence.\n";
        }
        for (file, text) in texts {
            let here = format!("{file} of {name} {version}");
            let before = first.entry(text.trim()).or_insert_with(|| here.clone());
            let _ = if *before == here {
                writeln!(all, "--- {file}\n\n{}\n", text.trim())
            } else {
                writeln!(all, "--- {file}: the same as {before}")
            };
        }
    }
    all
}

fn list(value: &Value) -> impl Iterator<Item = &Value> {
    value.as_array().into_iter().flatten()
}

fn text(value: &Value) -> &str {
    value.as_str().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn only_what_the_command_needs_to_run_is_inside() {
        let dep = |id: &str, kind: Value| json!({ "pkg": id, "dep_kinds": [{ "kind": kind }] });
        let metadata = json!({
            "packages": [{ "name": "gridshell-cli", "id": "cli" }],
            "resolve": { "nodes": [
                { "id": "cli", "deps": [dep("a", Value::Null), dep("test", json!("dev"))] },
                { "id": "a", "deps": [dep("b", Value::Null), dep("cc", json!("build"))] },
                { "id": "b", "deps": [] },
            ]},
        });
        let inside: Vec<_> = inside(&metadata, "gridshell-cli").into_iter().collect();
        assert_eq!(inside, ["a", "b", "cli"]);
    }

    #[test]
    fn a_text_is_written_once() {
        let package = |name: &str, texts: &[(&str, &str)]| Package {
            name: name.to_owned(),
            version: "1.0.0".to_owned(),
            licence: "MIT".to_owned(),
            texts: texts.iter().map(|(n, t)| ((*n).to_owned(), (*t).to_owned())).collect(),
        };
        let packages = [
            package("a", &[("LICENSE", "Do.\n")]),
            package("b", &[("MIT", "Do.")]),
            package("c", &[]),
        ];
        let all = document(&packages);
        assert_eq!(all.matches("Do.").count(), 1);
        assert!(all.contains("--- MIT: the same as LICENSE of a 1.0.0\n"), "{all}");
        assert!(all.contains("b 1.0.0: MIT\n") && all.contains("has no text"), "{all}");
    }
}
