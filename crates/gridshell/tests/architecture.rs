//! Who may know whom: the imports of every room, held against the table in ARCHITECTURE.md.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

type Rooms = BTreeMap<String, BTreeSet<String>>;

/// The table of the library's rooms.
fn allowed() -> Rooms {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../ARCHITECTURE.md");
    table(&fs::read_to_string(path).expect("ARCHITECTURE.md stands at the root"))
}

/// The description of the surface's rooms, with their table.
fn surface() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/surface/mod.rs");
    let text = fs::read_to_string(path).expect("the surface's top file");
    let lines = text.lines().filter_map(|l| l.strip_prefix("//! "));
    lines.collect::<Vec<_>>().join("\n")
}

/// A table: each room, and the rooms it may use.
fn table(text: &str) -> Rooms {
    let mut rooms = Rooms::new();
    for (room, uses) in rows(text) {
        let uses = match uses.as_str() {
            "all above" => rooms.keys().cloned().collect(),
            list => list.split(',').map(|r| r.trim().trim_matches('`').to_owned()).collect(),
        };
        rooms.insert(room, uses);
    }
    rooms
}

/// The table's rows, in its order: a room, and what is written of the rooms it may use.
fn rows(text: &str) -> Vec<(String, String)> {
    let rows = text.lines().filter(|l| l.starts_with("| `")).map(|line| {
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        (cells[1].trim_matches('`').to_owned(), cells[3].to_owned())
    });
    rows.collect()
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

/// Tests stand at the end of a file, or in one of their own; comments may link wherever they like.
fn without_tests(text: &str) -> String {
    let mark = "#[cfg(test)]\nmod ";
    let here =
        |at: &usize| text[at + mark.len()..].lines().next().is_some_and(|l| l.ends_with('{'));
    let end = text.match_indices(mark).map(|(at, _)| at).find(here);
    let lines =
        text[..end.unwrap_or(text.len())].lines().filter(|l| !l.trim_start().starts_with("//"));
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

/// The room of the surface that a source file belongs to; `mod` for the surface's own top file.
fn surface_room(path: &Path) -> Option<String> {
    let inside = path.strip_prefix("surface").ok()?;
    Some(room_of(inside))
}

/// The rooms that the surface's top file takes names from for all others to use, by name.
fn taken_up(code: &str) -> BTreeMap<String, String> {
    let mut names = BTreeMap::new();
    for rest in code.lines().filter_map(|l| l.split_once("use ").map(|(_, rest)| rest)) {
        let Some((room, items)) = rest.trim_end_matches(';').split_once("::") else { continue };
        let items = items.trim_matches(['{', '}']).split(',').map(str::trim);
        names.extend(items.map(|item| (item.to_owned(), room.to_owned())));
    }
    names
}

#[test]
fn rooms_of_the_surface_stand_in_their_table_one_above_the_other() {
    let text = surface();
    let rooms = table(&text);
    let mut above = BTreeSet::new();
    for (room, _) in rows(&text) {
        let below: Vec<_> = rooms[&room].iter().filter(|r| rooms.contains_key(*r)).collect();
        let below: Vec<_> = below.into_iter().filter(|r| !above.contains(*r)).collect();
        assert!(below.is_empty(), "{room} may use {below:?}, which stand no higher");
        above.insert(room);
    }
    for room in sources().iter().filter_map(|(path, _)| surface_room(path)) {
        assert!(room == "mod" || rooms.contains_key(&room), "surface/mod.rs has no room {room:?}");
    }
}

#[test]
fn rooms_of_the_surface_know_only_whom_their_table_allows() {
    let rooms = table(&surface());
    let sources = sources();
    let top = sources.iter().find(|(path, _)| path.ends_with("surface/mod.rs"));
    let taken = taken_up(&top.expect("the surface has a top file").1);
    let mut trespasses = Vec::new();
    for (path, code) in &sources {
        let Some(room) = surface_room(path).filter(|room| room != "mod") else { continue };
        let depth = path.iter().count() - usize::from(path.ends_with("mod.rs"));
        let mut names = names_after(code, "crate::surface::");
        names.extend(names_after(code, &"super::".repeat(depth - 1)));
        for name in names {
            let other = taken.get(&name).unwrap_or(&name);
            if rooms.contains_key(other) && *other != room && !rooms[&room].contains(other) {
                trespasses.push(format!("{}: {room} uses {other}", path.display()));
            }
        }
    }
    assert!(trespasses.is_empty(), "not in surface/mod.rs's table:\n{}", trespasses.join("\n"));
}

#[test]
fn groups_of_imports_are_read_whole() {
    let code = "use crate::{error::{Error, Result}, mesh::Mesh};\nlet x = crate::grid::Grid;";
    let names: Vec<_> = names_after(code, "crate::").into_iter().collect();
    assert_eq!(names, ["error", "grid", "mesh"]);
}
