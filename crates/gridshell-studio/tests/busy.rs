//! The studio while all threads that runs share are busy: by itself, as other tests want those threads.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod up;

use serde_json::json;
use up::{generate, hear, say, status, up};

/// While the threads that runs share are busy, as in a long run, everything is answered; and a pick passes suggestions.
#[tokio::test(flavor = "multi_thread")]
async fn a_busy_run_holds_up_no_answers() {
    let up = up().await;
    let mut tab = up.tab().await;
    hear(&mut tab, &["idle"]).await;
    let run = generate(&up, &mut tab).await;
    hear(&mut tab, &["idle"]).await;
    let (begun, begins) = std::sync::mpsc::channel();
    let ends: Vec<_> = (0..rayon::current_num_threads())
        .map(|_| {
            let (end, ended) = std::sync::mpsc::channel::<()>();
            let begun = begun.clone();
            rayon::spawn(move || {
                let _ = begun.send(());
                let _ = ended.recv();
            });
            end
        })
        .collect();
    tokio::task::spawn_blocking(move || ends_begin(&begins)).await.unwrap();
    let pick = json!({ "kind": "pick", "run": run, "question": 1, "origin": [0, 0, 9], "direction": [0, 0, -1] });
    for (wish, answer) in [
        (json!({ "kind": "suggest", "run": run }), "suggested"),
        (pick, "picked"),
        (json!({ "kind": "hover", "run": run, "nodes": [20, 21], "question": 1 }), "hovered"),
        (json!({ "kind": "estimate", "values": {} }), "estimate"),
        (json!({ "kind": "edit", "run": run, "edit": { "op": "relax_all" } }), "history"),
        (json!({ "kind": "undo", "run": run }), "history"),
        (json!({ "kind": "look", "run": run, "stage": null }), "run"),
        (json!({ "kind": "open", "name": "dome" }), "surface"),
    ] {
        say(&mut tab, &wish).await;
        hear(&mut tab, &[answer]).await;
    }
    for format in ["gridshell", "edits.json"] {
        let path = format!("/{}/export?run={run}&format={format}", up.token);
        assert_eq!(status(&up.get(&path, &up.host, "").await), "200", "{format}");
    }
    drop(ends);
}

/// Wait until all the shared threads are taken.
fn ends_begin(begins: &std::sync::mpsc::Receiver<()>) {
    for _ in 0..rayon::current_num_threads() {
        begins.recv().unwrap();
    }
}
