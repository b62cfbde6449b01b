//! A studio that is up, and a tab to speak with it.

#![allow(dead_code, reason = "not every test speaks of everything")]

use futures_util::{SinkExt, StreamExt};
use gridshell_studio::{Options, Studio};
use serde_json::{Value, json};
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::Duration;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;
use tokio_tungstenite::tungstenite::{self, Message};

pub type Socket = tokio_tungstenite::WebSocketStream<TcpStream>;

/// A server that is up.
pub struct Up {
    pub host: String,
    pub token: String,
    pub log: Arc<Mutex<Vec<String>>>,
}

pub async fn up() -> Up {
    let log: Arc<Mutex<Vec<String>>> = Arc::default();
    let lines = Arc::clone(&log);
    let page = tempfile::tempdir().unwrap();
    std::fs::write(page.path().join("index.html"), "the page").unwrap();
    std::fs::write(page.path().join("main.js"), "the script").unwrap();
    let options = Options {
        surface: "hexagon".into(),
        port: 0,
        log: Arc::new(move |line: &str| lines.lock().unwrap().push(line.to_owned())),
        page: Some(PathBuf::from(page.path())),
        state: None,
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
    pub async fn raw(&self, request: &str, body: &[u8]) -> String {
        let mut stream = TcpStream::connect(&self.host).await.unwrap();
        stream.write_all(request.as_bytes()).await.unwrap();
        // A server that refuses by the head need not read the body.
        let _ = stream.write_all(body).await;
        let mut answer = Vec::new();
        let _ =
            tokio::time::timeout(Duration::from_secs(20), stream.read_to_end(&mut answer)).await;
        String::from_utf8_lossy(&answer).into_owned()
    }

    pub async fn get(&self, path: &str, host: &str, more: &str) -> String {
        let head =
            format!("GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n{more}\r\n");
        self.raw(&head, b"").await
    }

    pub async fn post(&self, path: &str, body: &[u8]) -> String {
        let (host, length) = (&self.host, body.len());
        let head = format!(
            "POST {path} HTTP/1.1\r\nHost: {host}\r\nOrigin: http://{host}\r\nContent-Length: {length}\r\nConnection: close\r\n\r\n"
        );
        self.raw(&head, body).await
    }

    pub async fn connect(
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

    pub async fn tab(&self) -> Socket {
        self.connect(&self.token, Some(&format!("http://{}", self.host))).await.unwrap()
    }

    pub fn logged(&self, words: &str) -> bool {
        self.log.lock().unwrap().iter().any(|line| line.contains(words))
    }
}

pub async fn say(socket: &mut Socket, message: &Value) {
    socket.send(Message::Text(message.to_string().into())).await.unwrap();
}

/// The next message of one of these kinds.
pub async fn hear(socket: &mut Socket, kinds: &[&str]) -> Value {
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

pub fn status(answer: &str) -> &str {
    answer.split_whitespace().nth(1).unwrap_or("none")
}

pub async fn generate(up: &Up, tab: &mut Socket) -> u64 {
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
