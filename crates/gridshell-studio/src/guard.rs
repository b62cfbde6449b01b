//! Who may speak to the server: this machine's own pages only, and of those only the one that was given the token.
//!
//! Other pages in the same browser can send requests to loopback too. They know neither the token, nor can they
//! make a browser leave out their Origin, nor (by a name that they let point to 127.0.0.1) send our Host.

use axum::http::{HeaderMap, Method, header};
use std::fmt::Write;

/// Bytes of the token.
const TOKEN_BYTES: usize = 16;

/// What a request must show.
pub struct Guard {
    token: String,
    hosts: [String; 2],
}

impl Guard {
    /// A guard with a new token for a server at this port of 127.0.0.1.
    ///
    /// # Errors
    /// Where the system gives no random numbers.
    pub fn new(port: u16) -> std::io::Result<Guard> {
        let mut bytes = [0; TOKEN_BYTES];
        getrandom::fill(&mut bytes).map_err(|e| std::io::Error::other(e.to_string()))?;
        let mut token = String::new();
        for byte in bytes {
            let _ = write!(token, "{byte:02x}");
        }
        Ok(Guard { token, hosts: [format!("127.0.0.1:{port}"), format!("localhost:{port}")] })
    }

    /// The token, 32 hexadecimal digits.
    pub fn token(&self) -> &str {
        &self.token
    }

    /// Whether a request is let in; else why not.
    ///
    /// # Errors
    /// What is wrong with it, for the log.
    pub fn check(
        &self,
        method: &Method,
        path: &str,
        headers: &HeaderMap,
    ) -> Result<(), &'static str> {
        let text = |name| headers.get(name).map(|v| v.to_str().unwrap_or("?"));
        let host = text(header::HOST).unwrap_or_default();
        if !self.hosts.iter().any(|h| h == host) {
            return Err("another Host");
        }
        let origin = text(header::ORIGIN);
        let own =
            |origin: &str| self.hosts.iter().any(|h| origin.strip_prefix("http://") == Some(h));
        if origin.is_some_and(|o| !own(o)) {
            return Err("another Origin");
        }
        let changes = method != Method::GET || headers.contains_key(header::UPGRADE);
        if changes && origin.is_none() {
            return Err("no Origin");
        }
        let given = path.trim_start_matches('/').split('/').next().unwrap_or_default();
        if same(given.as_bytes(), self.token.as_bytes()) { Ok(()) } else { Err("a wrong token") }
    }
}

/// Whether they are the same, in a time that does not tell where they differ.
fn same(a: &[u8], b: &[u8]) -> bool {
    a.len() == b.len() && a.iter().zip(b).fold(0, |d, (x, y)| d | (x ^ y)) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn headers(host: &str, origin: Option<&str>) -> HeaderMap {
        let mut headers = HeaderMap::new();
        headers.insert(header::HOST, host.parse().unwrap());
        if let Some(origin) = origin {
            headers.insert(header::ORIGIN, origin.parse().unwrap());
        }
        headers
    }

    #[test]
    fn only_our_own_page_with_the_token_is_let_in() {
        let guard = Guard::new(8123).unwrap();
        let path = format!("/{}/socket", guard.token());
        let check =
            |path: &str, host, origin| guard.check(&Method::GET, path, &headers(host, origin));
        assert_eq!(check(&path, "127.0.0.1:8123", None), Ok(()));
        assert_eq!(check(&path, "localhost:8123", Some("http://localhost:8123")), Ok(()));
        assert_eq!(check(&path, "evil.example", None), Err("another Host"));
        assert_eq!(check(&path, "127.0.0.1:80", None), Err("another Host"));
        assert_eq!(
            check(&path, "127.0.0.1:8123", Some("http://evil.example")),
            Err("another Origin")
        );
        assert_eq!(check(&path, "127.0.0.1:8123", Some("null")), Err("another Origin"));
        assert_eq!(check("/0000/", "127.0.0.1:8123", None), Err("a wrong token"));
        assert_eq!(check("/", "127.0.0.1:8123", None), Err("a wrong token"));
        let post = guard.check(&Method::POST, &path, &headers("127.0.0.1:8123", None));
        assert_eq!(post, Err("no Origin"));
    }

    #[test]
    fn every_server_has_its_own_token() {
        assert_ne!(Guard::new(1).unwrap().token(), Guard::new(1).unwrap().token());
    }
}
