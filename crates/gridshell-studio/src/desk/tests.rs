//! What stays on the desk, what is kept against crashes, and who waits for whom.

use super::*;
use crate::laid::tests::{MIDDLE, hexagon, pin, square};
use gridshell::recipe::Effort;
use std::path::{Path, PathBuf};
use std::sync::mpsc::channel;
use std::time::Duration;

fn desk() -> Arc<Desk> {
    Arc::new(Desk::new(None))
}

/// A desk that keeps its grids in `state`.
fn keeping(state: &Path) -> Arc<Desk> {
    std::thread::sleep(Duration::from_millis(2));
    let desk = desk();
    desk.keep_in(state, Arc::new(|_: &str| {})).unwrap();
    desk
}

fn numbers(desk: &Desk) -> Vec<u32> {
    desk.state().runs.iter().map(|r| r.number).collect()
}

fn settle(desk: &Desk) {
    let session = desk.state().session.clone().unwrap();
    session.settle(&[]);
}

/// The numbers of the grids that are on the disk in `state`.
fn on_disk(state: &Path) -> Vec<u32> {
    let folders = std::fs::read_dir(state).unwrap().map(|e| e.unwrap().path());
    let files = folders.flat_map(|f| std::fs::read_dir(f).unwrap().map(|e| e.unwrap().path()));
    let grids = files.filter(|f| f.extension().is_some_and(|e| e == "gridshell"));
    let mut found: Vec<u32> =
        grids.map(|f| f.file_stem().unwrap().to_str().unwrap().parse().unwrap()).collect();
    found.sort_unstable();
    found
}

/// What is told of grids that were put away.
fn put_away(events: &mut broadcast::Receiver<Outgoing>) -> Vec<String> {
    let mut told = Vec::new();
    while let Ok(outgoing) = events.try_recv() {
        if let Outgoing::Event(Event::PutAway { grids }) = outgoing {
            told.extend(grids);
        }
    }
    told
}

fn answer(desk: &Arc<Desk>, request: serde_json::Value) -> Vec<Outgoing> {
    let told = desk.answer(serde_json::from_value(request).unwrap());
    for outgoing in &told {
        if let Outgoing::Event(Event::Fault { message, .. }) = outgoing {
            panic!("{message}");
        }
    }
    told
}

/// Pin the first node that can be.
fn edit(desk: &Arc<Desk>, run: u32) {
    let pinned = (0..100).any(|node| {
        let pin = serde_json::json!({ "op": "pin", "node": node });
        let request = serde_json::json!({ "kind": "edit", "run": run, "edit": pin });
        desk.answer(serde_json::from_value(request).unwrap()).is_empty()
    });
    assert!(pinned, "no node can be pinned");
}

/// An edited grid, a recovered one and a chosen candidate stay with their copies on the disk, whatever else is laid.
#[test]
fn what_a_person_made_is_never_put_away() {
    let state = tempfile::tempdir().unwrap();
    let desk = keeping(state.path());
    let mut events = desk.events();
    let laid = hexagon(1, Effort::Draft);
    let design = laid.design.clone();
    let opened = Arc::clone(&laid.opened);
    let of_run = |number, origin: Option<&str>| {
        Laid::of_run(number, design.clone(), Arc::clone(&opened), origin.map(str::to_owned))
    };
    desk.keep(laid);
    edit(&desk, 1);
    desk.keep(square(2).recovered());
    desk.keep(of_run(3, Some("candidate 2 of run 1")));
    desk.keep(square(4));
    edit(&desk, 4);
    assert!(put_away(&mut events).is_empty());
    let mut told = Vec::new();
    for number in 5..45 {
        desk.keep(of_run(number, None));
        told.extend(put_away(&mut events));
    }
    assert_eq!(numbers(&desk), [&[1, 2, 3, 4], &*(33..45).collect::<Vec<_>>()].concat());
    assert_eq!(told.len(), 28, "each is told");
    assert!(told[0].starts_with("5: hexagon, 2.000 m, draft"), "{}", told[0]);
    settle(&desk);
    assert_eq!(on_disk(state.path())[..4], [1, 2, 3, 4]);
}

#[test]
fn only_grids_with_changes_are_more_than_ever_put_away() {
    let desk = desk();
    let mut events = desk.events();
    for number in 1..=30 {
        let laid = desk.keep(square(number));
        pin(&laid, MIDDLE);
    }
    assert_eq!(numbers(&desk).len(), 30);
    assert!(put_away(&mut events).is_empty());
}

#[test]
fn drafts_make_way_first_then_what_was_looked_at_longest_ago() {
    let desk = desk();
    for number in 1..=12 {
        let effort = if [4, 9].contains(&number) { Effort::Draft } else { Effort::Standard };
        desk.keep(hexagon(number, effort));
    }
    desk.keep(hexagon(13, Effort::Draft));
    desk.keep(hexagon(14, Effort::Standard));
    let kept = |gone: &[u32], last| (1..=last).filter(|n| !gone.contains(n)).collect::<Vec<_>>();
    assert_eq!(numbers(&desk), kept(&[4, 9], 14), "the newest stays, draft or not");
    answer(&desk, serde_json::json!({ "kind": "look", "run": 1, "stage": null }));
    desk.keep(hexagon(15, Effort::Standard));
    desk.keep(hexagon(16, Effort::Standard));
    assert_eq!(numbers(&desk), kept(&[4, 9, 13, 2], 16), "1 was looked at");
}

/// Exporting is not a saving; what the page says was saved is, in the version that was.
#[test]
fn the_copy_against_crashes_stays_until_the_user_has_the_grid() {
    let state = tempfile::tempdir().unwrap();
    let desk = keeping(state.path());
    for number in 1..=3 {
        desk.keep(hexagon(number, Effort::Standard));
    }
    for (number, format) in [(1, "gridshell"), (2, "obj"), (3, "run.json")] {
        desk.export(number, format).unwrap();
    }
    settle(&desk);
    assert_eq!(on_disk(state.path()), [1, 2, 3]);
    let version = desk.export(1, "gridshell").unwrap().version;
    let saved = |version| serde_json::json!({ "kind": "saved", "run": 1, "version": version });
    edit(&desk, 1);
    answer(&desk, saved(version));
    settle(&desk);
    assert_eq!(on_disk(state.path()), [1, 2, 3], "it was changed since");
    answer(&desk, saved(desk.export(1, "gridshell").unwrap().version));
    settle(&desk);
    assert_eq!(on_disk(state.path()), [2, 3]);
    answer(&desk, serde_json::json!({ "kind": "undo", "run": 1 }));
    settle(&desk);
    assert_eq!(on_disk(state.path()), [1, 2, 3], "changed again, kept again");
}

/// Recover what a session left of these grids, after `harm` was done to its files; its folder.
fn recovered(state: &Path, harm: impl Fn(&Path)) -> (Arc<Desk>, PathBuf) {
    let first = keeping(state);
    for number in 1..=3 {
        first.keep(square(number).recovered());
    }
    settle(&first);
    drop(first);
    // The writer and its lock end with the last word to them.
    std::thread::sleep(Duration::from_millis(50));
    let folder = std::fs::read_dir(state).unwrap().next().unwrap().unwrap().path();
    harm(&folder);
    let desk = keeping(state);
    (desk, folder)
}

fn recover(desk: &Arc<Desk>, folder: &Path) {
    let session = folder.file_name().unwrap().to_str().unwrap();
    answer(desk, serde_json::json!({ "kind": "recover", "session": session }));
}

fn left_now(desk: &Desk) -> Vec<crate::message::Left> {
    desk.state().left.iter().map(Ended::told).collect()
}

#[test]
fn recovering_some_grids_never_removes_others() {
    let kinds: [(&str, &[u8]); 3] = [
        ("2.gridshell", b""),
        ("1.gridshell", b"{\"half\": "),
        // It can be read, but its panels are no surface.
        ("3.gridshell", b"twisted"),
    ];
    for (file, bytes) in kinds {
        let state = tempfile::tempdir().unwrap();
        let (desk, folder) = recovered(state.path(), |folder| {
            let path = folder.join(file);
            let text = std::fs::read_to_string(&path).unwrap();
            let mut document: serde_json::Value = serde_json::from_str(&text).unwrap();
            let panels = document["panels"].as_array_mut();
            match (bytes, panels) {
                (b"twisted", Some(panels)) => {
                    let first = panels[0].clone();
                    panels.extend([first.clone(), first.clone(), first]);
                    std::fs::write(&path, document.to_string()).unwrap();
                }
                _ => std::fs::write(&path, bytes).unwrap(),
            }
        });
        recover(&desk, &folder);
        assert_eq!(numbers(&desk).len(), 2, "{file}");
        assert!(folder.join(file).exists(), "{file} stays");
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 2, "{file} and the lock");
        let told = left_now(&desk);
        assert_eq!((told.len(), told[0].grids.len(), told[0].damaged.len()), (1, 0, 1), "{file}");
        assert_eq!(told[0].damaged[0].file, file);
        assert!(!told[0].damaged[0].reason.is_empty());
    }
}

#[test]
fn what_cannot_be_kept_anew_is_not_removed_where_it_was() {
    let state = tempfile::tempdir().unwrap();
    let (desk, folder) = recovered(state.path(), |_| {});
    // This session's folder is gone: nothing can be written.
    let all = std::fs::read_dir(state.path()).unwrap().map(|e| e.unwrap().path());
    let own = all.into_iter().find(|f| *f != folder).unwrap();
    std::fs::remove_dir_all(own).unwrap();
    recover(&desk, &folder);
    assert_eq!(numbers(&desk).len(), 3);
    assert_eq!(on_disk(state.path()), [1, 2, 3], "still where they were");
    let fault = desk.greeting().into_iter().find_map(|o| match o {
        Outgoing::Event(Event::Autosave { fault }) => fault,
        _ => None,
    });
    assert!(fault.unwrap().starts_with("run "), "new tabs are told too");
}

/// An edit that takes its time, and all that others want meanwhile.
#[test]
fn nobody_waits_for_an_edit() {
    let state = tempfile::tempdir().unwrap();
    let desk = keeping(state.path());
    desk.keep(hexagon(1, Effort::Draft));
    let ((begun, begins), (end, ended)) = (channel::<Job>(), channel::<()>());
    let editing = {
        let desk = Arc::clone(&desk);
        std::thread::spawn(move || {
            desk.change(1, "a long edit", |_, job| {
                begun.send(job.clone()).unwrap();
                ended.recv().unwrap();
                Ok(())
            })
        })
    };
    let job = begins.recv().unwrap();
    let (done, told) = channel();
    let others = {
        let desk = Arc::clone(&desk);
        std::thread::spawn(move || {
            for _ in 0..3 {
                assert!(desk.greeting().len() > 3);
            }
            let [a, b] = desk.laid(1).unwrap().grid().mesh.triangles().next().unwrap()[..2] else {
                panic!("a panel has three nodes")
            };
            for wish in [
                serde_json::json!({ "kind": "look", "run": 1, "stage": null }),
                serde_json::json!({ "kind": "color", "run": 1, "by": "length" }),
                serde_json::json!({ "kind": "hover", "run": 1, "nodes": [a, b], "question": 1 }),
                serde_json::json!({ "kind": "suggest", "run": 1 }),
                serde_json::json!({ "kind": "pick", "run": 1, "question": 1, "origin": [0, 0, 9], "direction": [0, 0, -1] }),
                serde_json::json!({ "kind": "open", "name": "dome" }),
            ] {
                assert!(answer(&desk, wish).len() < 4);
            }
            desk.keep(square(2));
            for format in ["gridshell", "obj", "edits.json", "run.json"] {
                desk.export(1, format).unwrap();
            }
            settle(&desk);
            desk.cancel();
            done.send(()).unwrap();
        })
    };
    told.recv_timeout(Duration::from_secs(60)).expect("somebody waits for the edit");
    others.join().unwrap();
    assert!(job.stopped(), "it can be cancelled");
    let refused = desk.change(1, "another", |_, _| Ok(()));
    assert!(refused.err().unwrap().to_string().contains("another edit is in progress"));
    end.send(()).unwrap();
    editing.join().unwrap().unwrap();
    assert!(desk.laid(1).unwrap().unsaved());
}
