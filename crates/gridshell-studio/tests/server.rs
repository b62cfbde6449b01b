//! The server from outside: who is let in, what is refused, and that nothing is lost.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use futures_util::{SinkExt, StreamExt};
use gridshell::io::Opening;
use gridshell::job::Job;
use gridshell_studio::{Options, Studio};
use serde_json::{Value, json};
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::Duration;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;
use tokio_tungstenite::tungstenite::{self, Message};

type Socket = tokio_tungstenite::WebSocketStream<TcpStream>;

/// A server that is up.
struct Up {
    host: String,
    token: String,
    log: Arc<Mutex<Vec<String>>>,
}

async fn up() -> Up {
    let log: Arc<Mutex<Vec<String>>> = Arc::default();
    let lines = Arc::clone(&log);
    let page = tempfile::tempdir().unwrap();
    std::fs::write(page.path().join("index.html"), "the page").unwrap();
    let options = Options {
        surface: "hexagon".into(),
        port: 0,
        log: Arc::new(move |line: &str| lines.lock().unwrap().push(line.to_owned())),
        page: Some(PathBuf::from(page.path())),
        state: None,
        report: Some(|grid| format!("{} nodes", grid.grid.xyz.len())),
        memory_limit: None,
    };
    let studio = Studio::bind(options).await.unwrap();
    let address = studio.address();
    let mut parts = address.trim_start_matches("http://").trim_end_matches('/').split('/');
    let up = Up { host: parts.next().unwrap().into(), token: parts.next().unwrap().into(), log };
    tokio::spawn(studio.serve());
    up
}

impl Up {
    /// Send bytes as they are; the answer.
    async fn raw(&self, request: &str, body: &[u8]) -> String {
        let mut stream = TcpStream::connect(&self.host).await.unwrap();
        stream.write_all(request.as_bytes()).await.unwrap();
        // A server that refuses by the head need not read the body.
        let _ = stream.write_all(body).await;
        let mut answer = Vec::new();
        let _ =
            tokio::time::timeout(Duration::from_secs(20), stream.read_to_end(&mut answer)).await;
        String::from_utf8_lossy(&answer).into_owned()
    }

    async fn get(&self, path: &str, host: &str, more: &str) -> String {
        let head =
            format!("GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n{more}\r\n");
        self.raw(&head, b"").await
    }

    async fn post(&self, path: &str, body: &[u8]) -> String {
        let (host, length) = (&self.host, body.len());
        let head = format!(
            "POST {path} HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nContent-Length: {length}\r\nConnection: close\r\n\r\n"
        );
        self.raw(&head, body).await
    }

    async fn connect(
        &self,
        token: &str,
        origin: Option<&str>,
    ) -> Result<Socket, tungstenite::Error> {
        let mut request = format!("ws://{}/{token}/socket", self.host).into_client_request()?;
        if let Some(origin) = origin {
            request.headers_mut().insert("Origin", origin.parse().unwrap());
        }
        let stream = TcpStream::connect(&self.host).await?;
        Ok(tokio_tungstenite::client_async(request, stream).await?.0)
    }

    async fn tab(&self) -> Socket {
        self.connect(&self.token, Some(&format!("http://{}", self.host))).await.unwrap()
    }

    fn logged(&self, words: &str) -> bool {
        self.log.lock().unwrap().iter().any(|line| line.contains(words))
    }
}

async fn say(socket: &mut Socket, message: &Value) {
    socket.send(Message::Text(message.to_string().into())).await.unwrap();
}

/// The next message of one of these kinds.
async fn hear(socket: &mut Socket, kinds: &[&str]) -> Value {
    let heard = async {
        loop {
            let message = socket.next().await.expect("the socket is open").expect("a message");
            let Message::Text(text) = message else { continue };
            let event: Value = serde_json::from_str(&text).unwrap();
            if kinds.iter().any(|k| event["kind"] == *k) {
                return event;
            }
        }
    };
    tokio::time::timeout(Duration::from_secs(120), heard).await.expect("an answer in time")
}

fn status(answer: &str) -> &str {
    answer.split_whitespace().nth(1).unwrap_or("none")
}

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
    let files = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../gridshell/tests/files");
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

async fn generate(up: &Up, tab: &mut Socket) -> u64 {
    say(tab, &json!({ "kind": "generate", "values": { "effort": "draft", "edge_length": 0.8 } }))
        .await;
    let runs = loop {
        let runs = hear(tab, &["runs", "fault"]).await;
        assert_eq!(runs["kind"], "runs", "{runs} {:?}", up.log);
        if runs["newest"].is_u64() {
            break runs;
        }
    };
    runs["newest"].as_u64().unwrap()
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
    let told = hear(&mut tab, &["progress", "idle"]).await;
    assert_eq!(told["kind"], "progress", "the run goes on without its tab");
    say(&mut tab, &json!({ "kind": "generate", "values": {} })).await;
    assert_eq!(hear(&mut tab, &["fault"]).await["about"], "generate");
    say(&mut tab, &json!({ "kind": "cancel" })).await;
    let idle = hear(&mut tab, &["idle"]).await;
    assert!(idle["run"].is_u64(), "the best so far is kept: {idle}");
}
