//! The server from outside: who is let in, what is refused, and that nothing is lost.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod up;

use futures_util::{SinkExt, StreamExt};
use gridshell::io::Opening;
use gridshell::job::Job;
use serde_json::json;
use std::path::PathBuf;
use std::time::Duration;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;
use up::{generate, hear, say, status, up};

#[tokio::test(flavor = "multi_thread")]
async fn strangers_are_refused_and_logged() {
    let up = up().await;
    let path = format!("/{}/", up.token);
    let fine = up.get(&path, &up.host, "").await;
    assert_eq!(status(&fine), "200");
    assert!(fine.ends_with("the page") && fine.to_lowercase().contains("content-security-policy"));

    for wrong in
        ["/", "/0123456789abcdef0123456789abcdef/", "/%2e%2e/", &format!("/{}0/", up.token)]
    {
        assert_eq!(status(&up.get(wrong, &up.host, "").await), "403", "{wrong}");
    }
    assert!(up.logged("a wrong token"));
    assert_eq!(status(&up.get(&path, "rebound.example", "").await), "403");
    assert!(up.logged("another Host"));
    assert_eq!(status(&up.get(&path, &up.host, "Origin: http://other.example\r\n").await), "403");
    assert!(up.logged("another Origin"));

    assert!(up.connect("no-token", Some(&format!("http://{}", up.host))).await.is_err());
    assert!(up.connect(&up.token, Some("http://other.example")).await.is_err());
    assert!(up.connect(&up.token, None).await.is_err());
    assert!(up.logged("no Origin"));
}

/// The pass that comes with the page serves for the token in every request after it, and from our own pages only.
#[tokio::test(flavor = "multi_thread")]
async fn after_the_first_request_a_cookie_serves_for_the_token() {
    let up = up().await;
    let first = up.get(&format!("/{}/", up.token), &up.host, "").await;
    let lines = first.lines().find_map(|l| l.strip_prefix("set-cookie: "));
    let given = lines.expect("a cookie comes with the page");
    for word in ["HttpOnly", "SameSite=Strict", "Path=/"] {
        assert!(given.contains(word), "{given}");
    }
    assert!(!given.contains(&up.token) && !given.contains("Domain"), "{given}");
    let pass = given.split(';').next().unwrap();
    let cookie = format!("Cookie: other=1; {pass}\r\n");
    for (path, said) in [("/", "the page"), ("/main.js", "the script")] {
        let answer = up.get(path, &up.host, &cookie).await;
        assert_eq!(status(&answer), "200", "{path}");
        assert!(answer.ends_with(said) && !answer.contains("set-cookie"), "{answer}");
        assert_eq!(status(&up.get(path, &up.host, "").await), "403", "{path} without it");
    }
    for site in ["same-site", "cross-site"] {
        let more = format!("{cookie}Sec-Fetch-Site: {site}\r\n");
        assert_eq!(status(&up.get("/", &up.host, &more).await), "403", "{site}");
    }
    assert!(up.logged("another page's request"));
    // The socket and files go by it too, if they have our Origin.
    let origin = format!("http://{}", up.host);
    for (origin, open) in [(Some(&*origin), true), (None, false), (Some("http://a.example"), false)]
    {
        let mut request = format!("ws://{}/socket", up.host).into_client_request().unwrap();
        request.headers_mut().insert("Cookie", pass.parse().unwrap());
        if let Some(origin) = origin {
            request.headers_mut().insert("Origin", origin.parse().unwrap());
        }
        let stream = TcpStream::connect(&up.host).await.unwrap();
        let opened = tokio_tungstenite::client_async(request, stream).await;
        assert_eq!(opened.is_ok(), open, "{origin:?}");
    }
    let head = format!(
        "POST /open?name=bad.obj HTTP/1.1\r\nHost: {0}\r\nOrigin: {origin}\r\n{cookie}Content-Length: 4\r\nConnection: close\r\n\r\n",
        up.host
    );
    assert_eq!(status(&up.raw(&head, b"oops").await), "422");
}

/// Every answer, refusals too, says that no other site may use it.
#[tokio::test(flavor = "multi_thread")]
async fn all_answers_have_the_headers_that_keep_others_out() {
    let up = up().await;
    let token = format!("/{}", up.token);
    for path in [
        "/".into(),
        format!("{token}/"),
        format!("{token}/none"),
        format!("{token}/export?run=9&format=obj"),
    ] {
        let answer = up.get(&path, &up.host, "").await.to_lowercase();
        for header in [
            "cross-origin-resource-policy: same-origin",
            "cross-origin-opener-policy: same-origin",
            "x-content-type-options: nosniff",
            "referrer-policy: no-referrer",
            "cache-control: no-store",
            "content-security-policy: default-src 'none'; script-src 'self'; style-src 'self';",
        ] {
            assert!(answer.contains(header), "{path}: {header} in {answer}");
        }
        assert!(!answer.contains("unsafe-inline"), "{path}");
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn requests_that_say_two_things_are_refused() {
    let up = up().await;
    let (host, path) = (&up.host, format!("/{}/", up.token));
    for (target, hosts) in [
        (format!("http://evil.example{path}"), vec![&**host]),
        (format!("http://{host}{path}"), vec![&**host]),
        (path.clone(), vec![&**host, "evil.example"]),
        (path.clone(), vec!["evil.example", &**host]),
        (path.clone(), vec![&**host, &**host]),
        (path.clone(), vec![]),
    ] {
        let hosts = hosts.iter().map(|h| format!("Host: {h}\r\n")).collect::<Vec<_>>().concat();
        let head = format!("GET {target} HTTP/1.1\r\n{hosts}Connection: close\r\n\r\n");
        let answer = up.raw(&head, b"").await;
        assert!(["400", "403"].contains(&status(&answer)), "{head}{answer}");
        assert!(!answer.contains("the page"));
    }
}

/// Requests that never come to their end are given up, wherever they stop; tabs without a word are not.
#[tokio::test(flavor = "multi_thread")]
async fn half_requests_are_given_up() {
    let up = up().await;
    let mut tab = up.tab().await;
    hear(&mut tab, &["idle"]).await;
    let (host, path) = (&up.host, format!("/{}/", up.token));
    let halves = [
        String::new(),
        "GE".into(),
        format!("GET {path} HTTP/1.1\r\nHost: {host}\r\n"),
        format!(
            "POST {path}open?name=a.obj HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nContent-Length: 100\r\n\r\nv 0"
        ),
    ];
    let mut streams = Vec::new();
    for half in &halves {
        let mut stream = TcpStream::connect(host).await.unwrap();
        stream.write_all(half.as_bytes()).await.unwrap();
        streams.push(stream);
    }
    for (half, mut stream) in halves.iter().zip(streams) {
        let mut answer = Vec::new();
        let ended = tokio::time::timeout(Duration::from_secs(90), stream.read_to_end(&mut answer));
        assert!(ended.await.is_ok(), "still open: {half:?}");
    }
    say(&mut tab, &json!({ "kind": "distance", "from": [0, 0, 0], "to": [3, 4, 0] })).await;
    assert_eq!(hear(&mut tab, &["distance"]).await["straight"], 5.0);
}

#[tokio::test(flavor = "multi_thread")]
async fn paths_lead_nowhere() {
    let up = up().await;
    let secret = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(secret.path(), "secret").unwrap();
    let to = secret.path().display().to_string();
    for path in [
        "../../../../etc/passwd",
        "..%2f..%2fetc%2fpasswd",
        &to,
        "assets/../../index.html",
        "%00",
        "C:%5cwindows",
    ] {
        let answer = up.get(&format!("/{}/{path}", up.token), &up.host, "").await;
        assert_ne!(status(&answer), "200", "{path}");
        assert!(!answer.contains("secret") && !answer.contains("root:"), "{path}");
    }
    for name in ["../../evil.sh", "/etc/passwd", "x", "a.exe", ".obj"] {
        let escaped = name.replace('/', "%2F");
        let answer = up.post(&format!("/{}/open?name={escaped}", up.token), b"v 0 0 0").await;
        assert_eq!(status(&answer), "415", "{name}");
    }
    assert!(up.logged("refused a file"));
    // A name with a path keeps its last part only, and what it holds is read as what it says it is.
    let answer =
        up.post(&format!("/{}/open?name=..%2F..%2Fbad.obj", up.token), b"nothing of use").await;
    assert_eq!(status(&answer), "422");
    assert!(answer.contains("bad.obj") && !answer.contains("/tmp"), "{answer}");
    let answer = up.get(&format!("/{}/export?run=1&format=..%2Fobj", up.token), &up.host, "").await;
    assert_eq!(status(&answer), "404");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_grid_file_comes_back_as_it_was_and_reads_nothing_else_from_the_disk() {
    let up = up().await;
    let mut tab = up.tab().await;
    hear(&mut tab, &["idle"]).await;
    let run = generate(&up, &mut tab).await;
    let pin = json!({ "kind": "edit", "run": run, "edit": { "op": "pin", "node": 40 } });
    say(&mut tab, &pin).await;
    hear(&mut tab, &["history"]).await;
    let path = format!("/{}/export?run={run}&format=gridshell", up.token);
    let answer = up.get(&path, &up.host, "").await;
    let file = answer.split_once("\r\n\r\n").unwrap().1.to_owned();
    let open = format!("/{}/open?name=again.gridshell", up.token);
    assert_eq!(status(&up.post(&open, file.as_bytes()).await), "204");
    assert_eq!(hear(&mut tab, &["recipe"]).await["values"]["edge_length"], 0.8);
    let again = hear(&mut tab, &["runs"]).await["newest"].as_u64().unwrap();
    say(&mut tab, &json!({ "kind": "look", "run": again, "stage": null })).await;
    assert!(hear(&mut tab, &["history"]).await["before"][0].as_str().unwrap().contains("pin 40"));
    let path = format!("/{}/export?run={again}&format=gridshell", up.token);
    let answer = up.get(&path, &up.host, "").await;
    assert_eq!(answer.split_once("\r\n\r\n").unwrap().1, file, "saved again it is the same");

    // The file of another surface lies on the disk just as the grid tells; nobody opened it here.
    let folder = tempfile::tempdir().unwrap();
    let secret = folder.path().join("secret.obj");
    std::fs::write(&secret, "v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\n").unwrap();
    let reference =
        gridshell::io::reference(&secret.to_string_lossy(), &Opening::default(), &Job::default());
    let told = serde_json::to_string(&reference.unwrap()).unwrap();
    let file = file.replace("{\"builtin\":\"hexagon\"}", &told);
    assert!(file.contains("secret.obj"));
    assert_eq!(status(&up.post(&open, file.as_bytes()).await), "204");
    let surface = hear(&mut tab, &["surface"]).await;
    assert_eq!(surface["name"], "hexagon", "the grid is its own surface");
    let alone = hear(&mut tab, &["runs"]).await["newest"].as_u64().unwrap();
    say(&mut tab, &json!({ "kind": "look", "run": alone, "stage": null })).await;
    let warning = hear(&mut tab, &["run"]).await["warnings"][0].to_string();
    assert!(warning.contains("open that file first"), "{warning}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_file_named_like_a_built_in_surface_is_still_the_users() {
    let up = up().await;
    let mut tab = up.tab().await;
    hear(&mut tab, &["idle"]).await;
    let files = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/files");
    let file = std::fs::read(files.join("assembly_m.step")).unwrap();
    let answer = up.post(&format!("/{}/open?name=dome.step", up.token), &file).await;
    assert_eq!(status(&answer), "204", "{answer}");
    let surface = hear(&mut tab, &["surface"]).await;
    assert_eq!((&surface["built_in"], &surface["source"]), (&json!(false), &json!("STEP")));
    let parts = surface["parts"].as_array().unwrap();
    assert!(parts.len() > 1 && parts.iter().all(|p| p["area"].as_f64().unwrap() > 0.0));
    // Its own length, not the one that suits the dome.
    say(&mut tab, &json!({ "kind": "estimate", "values": { "part": "all" } })).await;
    let nodes = hear(&mut tab, &["estimate"]).await["nodes"].as_u64().unwrap();
    assert!((900..1100).contains(&nodes), "{nodes}");
    say(&mut tab, &json!({ "kind": "choose", "layers": ["Roof"], "objects": [] })).await;
    let fault = hear(&mut tab, &["fault"]).await["message"].to_string();
    assert!(fault.contains("in 3DM files only") && !fault.contains("/tmp"), "{fault}");
}

#[tokio::test(flavor = "multi_thread")]
async fn messages_without_sense_change_nothing() {
    let up = up().await;
    let mut tab = up.tab().await;
    hear(&mut tab, &["idle"]).await;
    for text in [
        "",
        "{",
        "[]",
        "{\"kind\":\"destroy\"}",
        "{\"kind\":\"open\"}",
        "{\"kind\":\"open\",\"name\":\"x\",\"more\":1}",
    ] {
        tab.send(Message::Text(text.into())).await.unwrap();
        assert_eq!(hear(&mut tab, &["fault"]).await["about"], "message", "{text}");
    }
    assert!(up.logged("refused a message"));
    tab.send(Message::Binary(vec![0; 100].into())).await.unwrap();
    hear(&mut tab, &["fault"]).await;
    assert!(up.logged("refused a binary message"));
    for wish in [
        json!({ "kind": "open", "name": "/etc/passwd" }),
        json!({ "kind": "look", "run": 99, "stage": null }),
        json!({ "kind": "undo", "run": 99 }),
        json!({ "kind": "generate", "values": { "edge_length": -1 } }),
        json!({ "kind": "generate", "values": { "edge_length": 1e-7 } }),
        json!({ "kind": "generate", "values": { "guides": "x" } }),
    ] {
        say(&mut tab, &wish).await;
        let fault = hear(&mut tab, &["fault", "surface", "runs"]).await;
        assert_eq!(fault["kind"], "fault", "{wish}: {fault}");
    }
    // The surface is what it was.
    let mut another = up.tab().await;
    assert_eq!(hear(&mut another, &["surface"]).await["name"], "hexagon");
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_too_large_is_refused() {
    let up = up().await;
    let mut tab = up.tab().await;
    hear(&mut tab, &["idle"]).await;
    let _ = tab.send(Message::Text("x".repeat(2 << 20).into())).await;
    while let Some(Ok(_)) = tab.next().await {}
    assert!(up.logged("closed a socket"), "{:?}", up.log.lock().unwrap());
    let (host, length) = (&up.host, 65 << 20);
    let head = format!(
        "POST /{}/open?name=a.obj HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nContent-Length: {length}\r\nConnection: close\r\n\r\n",
        up.token
    );
    assert_eq!(status(&up.raw(&head, b"v 0 0 0").await), "413");
    assert!(up.logged("larger than"));
    // Others are served as before.
    hear(&mut up.tab().await, &["hello"]).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn two_hundred_edits_and_many_reconnections_lose_nothing() {
    let up = up().await;
    let mut tab = up.tab().await;
    hear(&mut tab, &["idle"]).await;
    let run = generate(&up, &mut tab).await;
    let mut rng = fastrand::Rng::with_seed(7);
    let (mut done, mut undone, mut made) = (0_usize, 0_usize, 0);
    for k in 0..200 {
        if rng.u8(..10) == 0 {
            // Now and then without a word of farewell.
            if rng.bool() {
                let _ = tab.close(None).await;
            }
            tab = up.tab().await;
            hear(&mut tab, &["idle"]).await;
        }
        let node = rng.u32(..60);
        let wish = match rng.u8(..10) {
            0 | 1 => json!({ "kind": "undo", "run": run }),
            2 => json!({ "kind": "redo", "run": run }),
            3 => json!({ "kind": "edit", "run": run, "edit": { "op": "pin", "node": node } }),
            n => {
                let ops = ["flip", "split", "collapse"];
                let nodes = [node, node + 1 + rng.u32(..9)];
                json!({ "kind": "edit", "run": run, "edit": { "op": ops[usize::from(n) % 3], "nodes": nodes } })
            }
        };
        say(&mut tab, &wish).await;
        let answer = hear(&mut tab, &["history", "fault"]).await;
        if answer["kind"] == "fault" {
            continue;
        }
        match wish["kind"].as_str().unwrap() {
            "undo" => (done, undone) = (done - 1, undone + 1),
            "redo" => (done, undone) = (done + 1, undone - 1),
            _ => (done, undone, made) = (done + 1, 0, made + 1),
        }
        let told = [&answer["done"], &answer["undone"]].map(|list| list.as_array().unwrap().len());
        assert_eq!(told, [done, undone], "after wish {k}: {wish}");
    }
    assert!(made > 20, "hardly any edit was possible: {made}");
    // Another tab is told the same, and the export holds as many nodes as are told.
    let mut another = up.tab().await;
    hear(&mut another, &["idle"]).await;
    say(&mut another, &json!({ "kind": "look", "run": run, "stage": null })).await;
    let nodes = hear(&mut another, &["run"]).await["summary"]["nodes"].as_u64().unwrap();
    let history = hear(&mut another, &["history"]).await;
    assert_eq!(history["done"].as_array().unwrap().len(), done);
    let file = up.get(&format!("/{}/export?run={run}&format=obj", up.token), &up.host, "").await;
    assert_eq!(status(&file), "200");
    assert_eq!(file.lines().filter(|l| l.starts_with("v ")).count() as u64, nodes);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_run_can_be_cancelled_and_survives_its_tab() {
    let up = up().await;
    let mut tab = up.tab().await;
    hear(&mut tab, &["idle"]).await;
    say(
        &mut tab,
        &json!({ "kind": "generate", "values": { "effort": "best", "edge_length": 0.2 } }),
    )
    .await;
    hear(&mut tab, &["progress"]).await;
    drop(tab);
    let mut tab = up.tab().await;
    let mut runs = hear(&mut tab, &["runs"]).await;
    let told = hear(&mut tab, &["progress", "idle"]).await;
    assert_eq!(told["kind"], "progress", "the run goes on without its tab");
    // Who cancels before there is any grid gets none.
    while !runs["newest"].is_u64() {
        runs = hear(&mut tab, &["runs"]).await;
    }
    say(&mut tab, &json!({ "kind": "generate", "values": {} })).await;
    assert_eq!(hear(&mut tab, &["fault"]).await["about"], "generate");
    say(&mut tab, &json!({ "kind": "cancel" })).await;
    let idle = hear(&mut tab, &["idle"]).await;
    assert!(idle["run"].is_u64(), "the best so far is kept: {idle}");
}
