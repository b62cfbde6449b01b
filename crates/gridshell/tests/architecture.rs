//! Who may know whom: the imports of every room, held against the table in ARCHITECTURE.md.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

type Rooms = BTreeMap<String, BTreeSet<String>>;

/// The table: each room, and the rooms it may use.
fn allowed() -> Rooms {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../ARCHITECTURE.md");
    let text = fs::read_to_string(path).expect("ARCHITECTURE.md stands at the root");
    let mut rooms = Rooms::new();
    for line in text.lines().filter(|l| l.starts_with("| `")) {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let room = cells[1].trim_matches('`').to_owned();
        let uses = match cells[3] {
            "all above" => rooms.keys().cloned().collect(),
            list => list.split(',').map(|r| r.trim().trim_matches('`').to_owned()).collect(),
        };
        rooms.insert(room, uses);
    }
    rooms
}

/// The library's source files, without the tests beside the code.
fn sources() -> Vec<(PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut folders = vec![root.clone()];
    let mut sources = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder of sources") {
            let path = entry.expect("readable").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") && !path.ends_with("tests.rs") {
                let text = fs::read_to_string(&path).expect("a source file");
                let inside = path.strip_prefix(&root).expect("found below the root").to_owned();
                sources.push((inside, without_tests(&text)));
            }
        }
    }
    sources.sort();
    sources
}

/// Tests stand at the end of a file; comments may link wherever they like.
fn without_tests(text: &str) -> String {
    let code = text.split("#[cfg(test)]\nmod ").next().unwrap_or_default();
    let lines = code.lines().filter(|l| !l.trim_start().starts_with("//"));
    lines.collect::<Vec<_>>().join("\n")
}

/// The first name of every path that begins with `prefix`, groups in braces included.
fn names_after(code: &str, prefix: &str) -> BTreeSet<String> {
    let name = |s: &str| {
        s.trim().split(|c: char| !c.is_alphanumeric() && c != '_').next().map(str::to_owned)
    };
    let mut names = BTreeSet::new();
    for rest in code.split(prefix).skip(1) {
        match rest.strip_prefix('{') {
            None => names.extend(name(rest)),
            Some(group) => names.extend(top_level(group).iter().filter_map(|item| name(item))),
        }
    }
    names
}

/// The items of a group in braces, up to its closing brace; inner groups stay whole.
fn top_level(group: &str) -> Vec<String> {
    let mut items = vec![String::new()];
    let mut depth = 0;
    for c in group.chars() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => break,
            '}' => depth -= 1,
            ',' if depth == 0 => items.push(String::new()),
            _ if depth == 0 => items.last_mut().expect("begun with one").push(c),
            _ => {}
        }
    }
    items
}

fn room_of(path: &Path) -> String {
    let first = path.iter().next().expect("not empty").to_string_lossy();
    first.trim_end_matches(".rs").to_owned()
}

#[test]
fn every_room_stands_in_the_table() {
    let rooms = allowed();
    for (path, _) in sources() {
        let room = room_of(&path);
        assert!(room == "lib" || rooms.contains_key(&room), "ARCHITECTURE.md has no room {room:?}");
    }
}

#[test]
fn rooms_know_only_whom_the_table_allows() {
    let rooms = allowed();
    let mut trespasses = Vec::new();
    for (path, code) in sources().iter().filter(|(path, _)| room_of(path) != "lib") {
        let room = room_of(path);
        for other in names_after(code, "crate::").into_iter().filter(|o| rooms.contains_key(o)) {
            if other != room && !rooms[&room].contains(&other) {
                trespasses.push(format!("{}: {room} uses {other}", path.display()));
            }
        }
    }
    assert!(trespasses.is_empty(), "not in ARCHITECTURE.md's table:\n{}", trespasses.join("\n"));
}

#[test]
fn a_stage_never_sees_another() {
    let stages: Vec<_> = sources()
        .into_iter()
        .filter(|(p, _)| p.starts_with("stages") && p.iter().count() > 1)
        .collect();
    let stage_of = |path: &Path| {
        let name = path.iter().nth(1).expect("below the room").to_string_lossy();
        name.trim_end_matches(".rs").to_owned()
    };
    let names: BTreeSet<_> =
        stages.iter().map(|(p, _)| stage_of(p)).filter(|n| n != "mod").collect();
    for (path, code) in stages.iter().filter(|(p, _)| stage_of(p) != "mod") {
        let own = stage_of(path);
        // `super` of a stage's own top file is the room of all stages.
        let top =
            path.iter().count() == 2 || (path.iter().count() == 3 && path.ends_with("mod.rs"));
        let mut seen = names_after(code, "crate::stages::");
        seen.extend(names_after(code, if top { "super::" } else { "super::super::" }));
        seen.remove(&own);
        let others: Vec<_> = seen.intersection(&names).collect();
        assert!(others.is_empty(), "{} sees {others:?}", path.display());
    }
}

#[test]
fn groups_of_imports_are_read_whole() {
    let code = "use crate::{error::{Error, Result}, mesh::Mesh};\nlet x = crate::grid::Grid;";
    let names: Vec<_> = names_after(code, "crate::").into_iter().collect();
    assert_eq!(names, ["error", "grid", "mesh"]);
}
