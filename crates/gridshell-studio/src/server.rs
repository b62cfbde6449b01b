//! The server: the page's files, one socket for each tab, files in and out. All of it behind the [`Guard`].

use crate::aside::aside;
use crate::desk::{self, Desk, Outgoing};
use crate::export::Exported;
use crate::guard::Guard;
use crate::lanes::Lanes;
use crate::message::Request as Wish;
use crate::page::Page;
use crate::told::{ACCEPTS, UPLOAD_LIMIT};
use axum::Router;
use axum::body::Bytes;
use axum::extract::ws::{Message, WebSocket, WebSocketUpgrade};
use axum::extract::{DefaultBodyLimit, FromRequest, Path, Query, Request, State};
use axum::http::{HeaderName, HeaderValue, StatusCode, header};
use axum::middleware::{self, Next};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use serde::Deserialize;
use std::future::{Ready, ready};
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::broadcast::error::RecvError;
use tokio::sync::{Notify, mpsc};

/// Largest message from the page, bytes.
const MESSAGE_LIMIT: usize = 1 << 20;
/// Answers to one tab that wait.
const ANSWERS: usize = 64;
/// The body of a request has to be here after so long: even the largest file takes seconds on one machine.
const BODY_PATIENCE: Duration = Duration::from_secs(30);

/// What a stranger is told, or a user whose address or browser is of another day.
const REFUSED: &str = "This is not the studio's address: take the whole of it from the terminal where gridshell runs.";

/// What the page may load and speak to: this server only.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; \
    img-src 'self' data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Tells the version of a grid that an export holds.
const VERSION: HeaderName = HeaderName::from_static("gridshell-version");

/// Where refusals are written.
pub type Log = Arc<dyn Fn(&str) + Send + Sync>;

/// What all requests share.
pub struct Server {
    /// Who is let in.
    pub guard: Guard,
    /// What is on the desk.
    pub desk: Arc<Desk>,
    /// The page's files.
    pub page: Page,
    /// Where refusals are written.
    pub log: Log,
    /// Told when the page is first asked for.
    pub entered: Notify,
}

/// All that the server answers to.
pub fn router(server: Arc<Server>) -> Router {
    let mut all = Router::new();
    // The same with the token and without it.
    let entrance = format!("/{}", server.guard.token());
    for way in ["", &entrance] {
        all = all
            .route(&format!("{way}/socket"), get(socket))
            .route(&format!("{way}/open"), post(open))
            .route(&format!("{way}/export"), get(export))
            .route(&format!("{way}/{{*file}}"), get(file));
    }
    all.route("/", get(index))
        .route(&format!("{entrance}/"), get(enter))
        .layer(DefaultBodyLimit::max(UPLOAD_LIMIT))
        .layer(middleware::from_fn_with_state(Arc::clone(&server), guarded))
        .with_state(server)
}

async fn guarded(State(server): State<Arc<Server>>, request: Request, next: Next) -> Response {
    let checked = server.guard.check(request.method(), request.uri(), request.headers());
    let mut response = match checked {
        // Before a byte of it is read.
        Ok(_) if length(&request) > UPLOAD_LIMIT as u64 => too_large(&server),
        Ok(_) => next.run(request).await,
        Err(reason) => {
            (server.log)(&format!("refused: {reason}"));
            (StatusCode::FORBIDDEN, REFUSED).into_response()
        }
    };
    let headers = response.headers_mut();
    for (name, value) in [
        (header::CONTENT_SECURITY_POLICY, POLICY),
        (HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
        (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::CACHE_CONTROL, "no-store"),
    ] {
        headers.insert(name, HeaderValue::from_static(value));
    }
    response
}

/// How long a request says that its body is.
fn length(request: &Request) -> u64 {
    let told = request.headers().get(header::CONTENT_LENGTH);
    told.and_then(|v| v.to_str().ok()?.parse().ok()).unwrap_or(0)
}

fn too_large(server: &Server) -> Response {
    let message = format!("the file is larger than {} MB", UPLOAD_LIMIT >> 20);
    (server.log)(&format!("refused a file: {message}"));
    (StatusCode::PAYLOAD_TOO_LARGE, message).into_response()
}

/// The page for who comes with the token: gets the pass, too.
fn enter(State(server): State<Arc<Server>>) -> Ready<Response> {
    server.entered.notify_one();
    let mut response = page_file(&server, "");
    if let Ok(pass) = HeaderValue::from_str(&server.guard.set_cookie()) {
        response.headers_mut().insert(header::SET_COOKIE, pass);
    }
    ready(response)
}

fn index(State(server): State<Arc<Server>>) -> Ready<Response> {
    ready(page_file(&server, ""))
}

fn file(State(server): State<Arc<Server>>, Path(name): Path<String>) -> Ready<Response> {
    ready(page_file(&server, &name))
}

fn page_file(server: &Server, name: &str) -> Response {
    // Names are looked up among the files in memory: no path is made of them.
    match server.page.file(name) {
        Some((kind, bytes)) => ([(header::CONTENT_TYPE, kind)], bytes.into_owned()).into_response(),
        None => StatusCode::NOT_FOUND.into_response(),
    }
}

#[derive(Deserialize)]
struct Sent {
    name: String,
}

/// A file sent by the page.
async fn open(
    State(server): State<Arc<Server>>,
    Query(Sent { name }): Query<Sent>,
    request: Request,
) -> Response {
    let refuse = |status: StatusCode, message: String| {
        (server.log)(&format!("refused a file: {message}"));
        (status, message).into_response()
    };
    let body = Bytes::from_request(request, &());
    let bytes = match tokio::time::timeout(BODY_PATIENCE, body).await {
        Ok(Ok(bytes)) => bytes,
        Ok(Err(_)) => return too_large(&server),
        Err(_) => return refuse(StatusCode::REQUEST_TIMEOUT, "it did not come to its end".into()),
    };
    let Some(name) = file_name(&name) else {
        let known = ACCEPTS.join(", ");
        return refuse(
            StatusCode::UNSUPPORTED_MEDIA_TYPE,
            format!("only files of these kinds can be opened: {known}"),
        );
    };
    let desk = Arc::clone(&server.desk);
    let read = move || aside(|| desk.open_sent(&name, &bytes).map_err(|e| e.to_string()));
    match tokio::task::spawn_blocking(read).await {
        Ok(Ok(())) => StatusCode::NO_CONTENT.into_response(),
        Ok(Err(message)) => (StatusCode::UNPROCESSABLE_ENTITY, message).into_response(),
        Err(_) => refuse(StatusCode::INTERNAL_SERVER_ERROR, "reading it broke off".into()),
    }
}

/// The last part of a name, of plain characters and with a known extension.
fn file_name(name: &str) -> Option<String> {
    let last = name.rsplit(['/', '\\']).next()?;
    let (stem, extension) = last.rsplit_once('.')?;
    let extension = extension.to_ascii_lowercase();
    let plain = |c: char| if c.is_alphanumeric() || "-_ ".contains(c) { c } else { '_' };
    let stem: String = stem.chars().take(80).map(plain).collect();
    (ACCEPTS.contains(&extension.as_str()) && !stem.trim().is_empty())
        .then(|| format!("{stem}.{extension}"))
}

#[derive(Deserialize)]
struct Wanted {
    run: u32,
    format: String,
}

async fn export(
    State(server): State<Arc<Server>>,
    Query(Wanted { run, format }): Query<Wanted>,
) -> Response {
    let desk = Arc::clone(&server.desk);
    let written = tokio::task::spawn_blocking(move || aside(|| desk.export(run, &format))).await;
    match written {
        Ok(Ok(Exported { name, bytes, version })) => {
            let attached = format!("attachment; filename*=UTF-8''{}", escaped(&name));
            let kind = (header::CONTENT_TYPE, "application/octet-stream".to_owned());
            let version = (VERSION, version.to_string());
            ([kind, (header::CONTENT_DISPOSITION, attached), version], bytes).into_response()
        }
        Ok(Err(error)) => (StatusCode::NOT_FOUND, error.to_string()).into_response(),
        Err(_) => StatusCode::INTERNAL_SERVER_ERROR.into_response(),
    }
}

/// A name as headers have it (RFC 5987).
fn escaped(name: &str) -> String {
    let plain = |b: u8| b.is_ascii_alphanumeric() || b"-_.".contains(&b);
    name.bytes()
        .map(|b| if plain(b) { char::from(b).to_string() } else { format!("%{b:02X}") })
        .collect()
}

fn socket(State(server): State<Arc<Server>>, upgrade: WebSocketUpgrade) -> Ready<Response> {
    let limited = upgrade.max_message_size(MESSAGE_LIMIT).max_frame_size(MESSAGE_LIMIT);
    ready(limited.on_upgrade(move |socket| converse(socket, server)))
}

/// One tab, until it goes.
async fn converse(mut socket: WebSocket, server: Arc<Server>) {
    let mut events = server.desk.events();
    let mut live = server.desk.live();
    live.mark_changed();
    let (answers, mut answered) = mpsc::channel::<Outgoing>(ANSWERS);
    let lanes = Lanes::begin(&server.desk, &answers);
    let mut pending = server.desk.greeting();
    loop {
        for outgoing in pending.drain(..) {
            if send(&mut socket, outgoing).await.is_err() {
                return;
            }
        }
        tokio::select! {
            message = socket.recv() => match message {
                Some(Ok(Message::Text(text))) => match serde_json::from_str::<Wish>(&text) {
                    Ok(Wish::Cancel) => server.desk.cancel(),
                    Ok(wish) => if !lanes.wish(wish) {
                        pending.push(desk::fault("message", "too much at once: wait for the answers"));
                    },
                    Err(error) => {
                        (server.log)(&format!("refused a message: {error}"));
                        pending.push(desk::fault("message", &format!("a message that makes no sense: {error}")));
                    }
                },
                Some(Ok(Message::Binary(_))) => {
                    (server.log)("refused a binary message");
                    pending.push(desk::fault("message", "binary messages are not understood"));
                }
                Some(Ok(Message::Ping(_) | Message::Pong(_))) => {}
                Some(Ok(Message::Close(_))) | None => return,
                Some(Err(error)) => {
                    (server.log)(&format!("closed a socket: {error}"));
                    return;
                }
            },
            Some(outgoing) = answered.recv() => pending.push(outgoing),
            event = events.recv() => match event {
                Ok(outgoing) => pending.push(outgoing),
                Err(RecvError::Lagged(_)) => pending = server.desk.greeting(),
                Err(RecvError::Closed) => return,
            },
            changed = live.changed() => {
                if changed.is_err() { return }
                let frame = live.borrow_and_update().clone();
                pending.extend(frame.map(Outgoing::Frame));
            }
        }
    }
}

async fn send(socket: &mut WebSocket, outgoing: Outgoing) -> Result<(), axum::Error> {
    match outgoing {
        Outgoing::Frame(bytes) => socket.send(Message::Binary(bytes)).await,
        Outgoing::Event(event) => {
            let text = serde_json::to_string(&event).expect("events have text keys only");
            socket.send(Message::Text(text.into())).await
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_are_no_paths() {
        let name = |text| file_name(text);
        assert_eq!(name("../../etc/roof.STEP").as_deref(), Some("roof.step"));
        assert_eq!(name("C:\\temp\\a b.obj").as_deref(), Some("a b.obj"));
        assert_eq!(name("..obj").as_deref(), Some("_.obj"));
        assert_eq!(name("a\0b.obj").as_deref(), Some("a_b.obj"));
        for bad in ["", "roof", "roof.exe", "/etc/passwd", ".obj", "roof.step/.."] {
            assert_eq!(name(bad), None, "{bad}");
        }
    }
}
