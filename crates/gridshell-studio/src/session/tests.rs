//! What is kept against crashes, and what is never touched.

use super::own::{LOCK, MARK};
use super::*;
use crate::laid::tests::square;
use std::fs;
use std::sync::Mutex;
use std::sync::mpsc::Receiver;

fn quiet() -> Told {
    Arc::new(|_| {})
}

/// A session in `state`, whose name differs from that of the one before.
fn begin(state: &Path) -> Session {
    std::thread::sleep(Duration::from_millis(2));
    Session::begin(state, quiet()).unwrap()
}

/// A session with these grids in `state` that has ended; its folder.
fn ended(state: &Path, numbers: &[u32]) -> PathBuf {
    let session = begin(state);
    for &number in numbers {
        session.save(&Arc::new(square(number)));
    }
    assert!(session.settle(numbers).iter().all(|written| *written));
    session.folder.clone()
}

/// A session that tells, and what it tells.
fn told(state: &Path) -> (Session, Receiver<Option<String>>) {
    let (tell, told) = channel();
    let tell = Mutex::new(tell);
    let tell = move |fault| drop(tell.lock().unwrap().send(fault));
    (Session::begin(state, Arc::new(tell)).unwrap(), told)
}

#[test]
fn a_session_is_offered_once_it_has_ended_and_cleared_away_where_it_left_nothing() {
    let state = tempfile::tempdir().unwrap();
    let own = begin(state.path());
    let running = begin(state.path());
    running.save(&Arc::new(square(3)));
    running.settle(&[3]);
    assert!(own.left(state.path()).0.is_empty(), "another studio is at it");
    drop(running);
    let nothing = ended(state.path(), &[]);
    let (left, more) = own.left(state.path());
    assert_eq!((left.len(), more), (1, 0));
    assert_eq!(left[0].told().grids, ["square, 9 nodes"]);
    assert!(!nothing.exists());
    assert!(own.left(state.path()).0.is_empty(), "it is offered by one studio only");
    left.into_iter().for_each(Ended::discard);
    assert!(own.left(state.path()).0.is_empty());
    assert_eq!(fs::read_dir(state.path()).unwrap().count(), 1, "only the running one is left");
}

/// Damaged files are told with what is wrong, alone or beside whole ones, and stay until the user discards them.
#[test]
fn damaged_grids_are_told_and_left_where_they_are() {
    let kinds: [&[u8]; 5] =
        [b"", b"{ half a gr", b"\0\xff\xfe\x01", b"[]", b"{\"schema\": \"another/9\"}"];
    for whole in [&[] as &[u32], &[1, 7]] {
        let state = tempfile::tempdir().unwrap();
        let folder = ended(state.path(), &[&[90], whole].concat());
        for (k, bytes) in kinds.iter().enumerate() {
            fs::write(folder.join(format!("{}.gridshell", 90 + k)), bytes).unwrap();
        }
        let own = begin(state.path());
        for _ in 0..2 {
            let (mut left, _) = own.left(state.path());
            assert_eq!(left.len(), 1);
            let told = left[0].told();
            assert_eq!((told.grids.len(), told.damaged.len()), (whole.len(), kinds.len()));
            for (k, damaged) in told.damaged.iter().enumerate() {
                assert_eq!(damaged.file, format!("{}.gridshell", 90 + k));
                assert!(!damaged.reason.is_empty());
            }
            // As after recovering the whole ones, but that they stay here.
            left[0].grids.clear();
            left[0].clear();
            assert!(!left[0].is_done(), "there is something to tell");
            assert!((90..95).all(|n| folder.join(format!("{n}.gridshell")).exists()));
        }
        own.left(state.path()).0.into_iter().for_each(Ended::discard);
        assert!(!folder.exists(), "discarded by the user");
    }
}

/// Folders of others, whatever they are named and hold, stay as they are; in one of ours the files of others do.
#[test]
fn only_what_a_studio_wrote_is_ever_removed() {
    let state = tempfile::tempdir().unwrap();
    let make = |folder: &str, files: &[(&str, &str)]| {
        for (file, contents) in files {
            let path = state.path().join(folder).join(file);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, contents).unwrap();
        }
    };
    make("mydata", &[(LOCK, ""), ("deep/thesis.docx", "years")]);
    make("mydata2", &[(LOCK, MARK), ("thesis.docx", "years")]);
    make("2024-backup", &[(LOCK, MARK), ("a.txt", "")]);
    make("-", &[(LOCK, MARK)]);
    make("2024-11", &[(LOCK, "locked by another program"), ("photo.jpg", "")]);
    make("2024-12", &[(LOCK, ""), ("photo.jpg", "")]);
    make("2025-1", &[(LOCK, MARK), ("photo.jpg", ""), ("0123456789abcdef/photo.jpg", "")]);
    make("2025-2", &[("photo.jpg", "")]);
    let everything = |folder: &Path| {
        let mut all = Vec::new();
        let mut folders = vec![folder.to_owned()];
        while let Some(folder) = folders.pop() {
            for path in fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()) {
                all.push(path.clone());
                if path.is_dir() {
                    folders.push(path);
                }
            }
        }
        all.sort();
        all
    };
    let before = everything(state.path());
    let own = begin(state.path());
    assert!(own.left(state.path()).0.is_empty());
    let folder = own.folder.clone();
    let kept: Vec<PathBuf> =
        everything(state.path()).into_iter().filter(|p| !p.starts_with(&folder)).collect();
    assert_eq!(kept, before);

    // A session that was discarded: only what was ours in it goes.
    let ours = ended(state.path(), &[1, 2]);
    for other in ["notes.txt", "01.gridshell", "my.gridshell", "0123456789abcdef/roof.step"] {
        let path = ours.join(other);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, "mine").unwrap();
    }
    let (left, _) = own.left(state.path());
    assert_eq!(left.len(), 1);
    left.into_iter().for_each(Ended::discard);
    assert!(!ours.join("1.gridshell").exists() && !ours.join("2.gridshell").exists());
    for other in ["notes.txt", "01.gridshell", "my.gridshell", "0123456789abcdef/roof.step", LOCK] {
        assert!(ours.join(other).exists(), "{other}");
    }
}

#[cfg(unix)]
#[test]
fn links_are_not_followed() {
    let [state, elsewhere] = [0, 1].map(|_| tempfile::tempdir().unwrap());
    let there = ended(elsewhere.path(), &[1]);
    std::os::unix::fs::symlink(&there, state.path().join("1-1")).unwrap();
    let ours = ended(state.path(), &[2]);
    std::os::unix::fs::symlink(there.join("1.gridshell"), ours.join("3.gridshell")).unwrap();
    std::os::unix::fs::symlink(&there, ours.join("0123456789abcdef")).unwrap();
    let (left, _) = begin(state.path()).left(state.path());
    assert_eq!(left.len(), 1, "the link to a session elsewhere is none");
    assert_eq!(left[0].grids.len(), 1, "nor is a link to a grid");
    left.into_iter().for_each(Ended::discard);
    assert!(there.join("1.gridshell").exists());
}

#[test]
fn a_copy_of_a_surface_goes_with_its_last_grid() {
    let state = tempfile::tempdir().unwrap();
    let folder = ended(state.path(), &[5]);
    let roof = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let loose = state.path().join("roof.obj");
    fs::write(&loose, roof).unwrap();
    let reference =
        io::reference(&loose.to_string_lossy(), &io::Opening::default(), &Job::default()).unwrap();
    let Reference::File { fnv1a, .. } = reference else { panic!("a file") };
    let copy = folder.join(fnv1a);
    fs::create_dir(&copy).unwrap();
    fs::write(copy.join("roof.obj"), roof).unwrap();
    fs::copy(folder.join("5.gridshell"), copy.join("6.gridshell")).unwrap();
    let own = begin(state.path());
    let (left, _) = own.left(state.path());
    let (first, second) = (&left[0].grids[0].0, &left[0].grids[1].0);
    Ended::remove(first);
    left[0].clear();
    assert!(copy.join("roof.obj").exists(), "a grid lies on it");
    Ended::remove(second);
    left[0].clear();
    assert!(!folder.exists());
}

#[test]
fn no_session_is_removed_for_there_being_many() {
    let state = tempfile::tempdir().unwrap();
    let folders: Vec<PathBuf> = (1..=14).map(|n| ended(state.path(), &[n])).collect();
    let (left, more) = begin(state.path()).left(state.path());
    assert_eq!((left.len(), more), (10, 4));
    assert!(folders.iter().all(|f| f.exists()));
    left.into_iter().for_each(Ended::discard);
    let (left, more) = begin(state.path()).left(state.path());
    assert_eq!((left.len(), more), (4, 0), "the others come when these are dealt with");
}

/// However writing fails, it is told once, tried again, and told when it works.
#[test]
fn a_failing_autosave_is_told_and_again_when_it_works() {
    type Harm = fn(&Path);
    let kinds: [(Harm, Harm); 3] = [
        (
            |f| fs::rename(f, f.with_extension("away")).unwrap(),
            |f| {
                fs::rename(f.with_extension("away"), f).unwrap();
            },
        ),
        (
            |f| fs::create_dir_all(f.join("4.gridshell/in the way")).unwrap(),
            |f| {
                fs::remove_dir_all(f.join("4.gridshell")).unwrap();
            },
        ),
        (
            |f| {
                fs::rename(f, f.with_extension("away")).unwrap();
                fs::write(f, "a file").unwrap();
            },
            |f| {
                fs::remove_file(f).unwrap();
                fs::rename(f.with_extension("away"), f).unwrap();
            },
        ),
    ];
    for (harm, mend) in kinds {
        let state = tempfile::tempdir().unwrap();
        let (session, told) = told(state.path());
        harm(&session.folder);
        session.save(&Arc::new(square(4)));
        let fault = told.recv_timeout(Duration::from_secs(20)).unwrap().unwrap();
        assert!(fault.starts_with("run 4: "), "{fault}");
        assert_eq!(session.settle(&[4, 5]), [false, true]);
        mend(&session.folder);
        assert_eq!(told.recv_timeout(Duration::from_secs(20)), Ok(None));
        assert!(session.folder.join("4.gridshell").is_file(), "nobody had to ask again");
        assert!(told.try_recv().is_err(), "told once");
    }
}

#[cfg(unix)]
#[test]
fn a_folder_that_others_may_write_to_is_narrowed_or_refused() {
    use std::os::unix::fs::PermissionsExt;
    let mode = |path: &Path| path.metadata().unwrap().permissions().mode() & 0o7777;
    // Mode, whether it holds something of the user's, and the mode after; None where it is refused.
    for (before, full, after) in [
        (0o777, false, Some(0o700)),
        (0o755, false, Some(0o700)),
        (0o700, true, Some(0o700)),
        (0o755, true, Some(0o755)),
        (0o777, true, None),
        (0o775, true, None),
        (0o1777, false, None),
    ] {
        let state = tempfile::tempdir().unwrap();
        ended(state.path(), &[1]);
        if full {
            fs::write(state.path().join("letter.txt"), "").unwrap();
        }
        fs::set_permissions(state.path(), fs::Permissions::from_mode(before)).unwrap();
        std::thread::sleep(Duration::from_millis(2));
        let begun = Session::begin(state.path(), quiet());
        match (after, &begun) {
            (Some(after), Ok(session)) => {
                assert_eq!((mode(state.path()), mode(&session.folder)), (after, 0o700));
            }
            (None, Err(error)) => {
                let words = error.to_string();
                assert!(words.contains("chmod go-w") && words.contains("--state"), "{words}");
                assert_eq!(mode(state.path()), before, "it is the user's to change");
            }
            _ => panic!("{before:o} {full}: {:?}", begun.err()),
        }
    }
}
