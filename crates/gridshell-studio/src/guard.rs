//! Who may speak to the server: this machine's own pages only, and of those only the one that was given the token.
//!
//! Other pages in the same browser can send requests to loopback too. They know neither the token, nor can they
//! make a browser leave out their Origin, nor (by a name that they let point to 127.0.0.1) send our Host.
//!
//! The token stands in the address that the browser is given. Whoever comes with it gets a cookie, the pass, and from
//! then on needs no token: the page takes it out of its address. Browsers send the pass with our own pages' requests
//! only (`SameSite=Strict`); those of a page at another port of this machine, which counts as the same site, say so.

use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, Uri, header};
use std::fmt::Write;

/// Bytes of the token, and of the pass.
const SECRET_BYTES: usize = 16;
/// From where a browser says that a request comes.
const FETCH_SITE: HeaderName = HeaderName::from_static("sec-fetch-site");

/// What a request must show.
pub struct Guard {
    token: String,
    pass: String,
    /// Cookies know no ports: those of several studios must not have one name.
    cookie: String,
    hosts: [String; 2],
}

/// How a request was let in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shown {
    /// By the token in its path.
    Token,
    /// By the pass.
    Pass,
}

impl Guard {
    /// A guard with a new token for a server at this port of 127.0.0.1.
    ///
    /// # Errors
    /// Where the system gives no random numbers.
    pub fn new(port: u16) -> std::io::Result<Guard> {
        Ok(Guard {
            token: secret()?,
            pass: secret()?,
            cookie: format!("gridshell-{port}"),
            hosts: [format!("127.0.0.1:{port}"), format!("localhost:{port}")],
        })
    }

    /// The token, 32 hexadecimal digits.
    pub fn token(&self) -> &str {
        &self.token
    }

    /// What gives the pass to a browser, until it is closed.
    pub fn set_cookie(&self) -> String {
        format!("{}={}; Path=/; HttpOnly; SameSite=Strict", self.cookie, self.pass)
    }

    /// How a request is let in; else why not.
    ///
    /// # Errors
    /// What is wrong with it, for the log.
    pub fn check(
        &self,
        method: &Method,
        uri: &Uri,
        headers: &HeaderMap,
    ) -> Result<Shown, &'static str> {
        let text = |name| headers.get(name).map(|v| v.to_str().unwrap_or("?"));
        if uri.scheme().is_some() || uri.authority().is_some() {
            return Err("an address with a host in it");
        }
        let several = |name| headers.get_all(name).iter().nth(1).is_some();
        if several(header::HOST) || several(header::ORIGIN) {
            return Err("several Hosts or Origins");
        }
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
        let given = uri.path().trim_start_matches('/').split('/').next().unwrap_or_default();
        if same(given.as_bytes(), self.token.as_bytes()) {
            return Ok(Shown::Token);
        }
        if !self.has_pass(headers) {
            return Err("a wrong token");
        }
        match headers.get(FETCH_SITE).map(HeaderValue::as_bytes) {
            None | Some(b"same-origin" | b"none") => Ok(Shown::Pass),
            Some(_) => Err("another page's request"),
        }
    }

    fn has_pass(&self, headers: &HeaderMap) -> bool {
        let all = headers.get_all(header::COOKIE).iter().filter_map(|v| v.to_str().ok());
        let mut cookies = all.flat_map(|v| v.split(';')).filter_map(|c| c.trim().split_once('='));
        cookies.any(|(name, value)| {
            name == self.cookie && same(value.as_bytes(), self.pass.as_bytes())
        })
    }
}

/// Random hexadecimal digits.
fn secret() -> std::io::Result<String> {
    let mut bytes = [0; SECRET_BYTES];
    getrandom::fill(&mut bytes).map_err(|e| std::io::Error::other(e.to_string()))?;
    let mut digits = String::new();
    for byte in bytes {
        let _ = write!(digits, "{byte:02x}");
    }
    Ok(digits)
}

/// Whether they are the same, in a time that does not tell where they differ.
fn same(a: &[u8], b: &[u8]) -> bool {
    a.len() == b.len() && a.iter().zip(b).fold(0, |d, (x, y)| d | (x ^ y)) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn headers(host: &str, more: &[(HeaderName, &str)]) -> HeaderMap {
        let mut headers = HeaderMap::new();
        headers.insert(header::HOST, host.parse().unwrap());
        for (name, value) in more {
            headers.append(name, value.parse().unwrap());
        }
        headers
    }

    const HOST: &str = "127.0.0.1:8123";

    #[test]
    fn only_our_own_page_with_the_token_is_let_in() {
        let guard = Guard::new(8123).unwrap();
        let path = format!("/{}/socket", guard.token());
        let check = |path: &str, host, origin: Option<&str>| {
            let more: Vec<_> = origin.iter().map(|o| (header::ORIGIN, *o)).collect();
            guard.check(&Method::GET, &path.parse().unwrap(), &headers(host, &more))
        };
        let token = Ok(Shown::Token);
        assert_eq!(check(&path, HOST, None), token);
        assert_eq!(check(&path, "localhost:8123", Some("http://localhost:8123")), token);
        assert_eq!(check(&path, "evil.example", None), Err("another Host"));
        assert_eq!(check(&path, "127.0.0.1:80", None), Err("another Host"));
        assert_eq!(check(&path, HOST, Some("http://evil.example")), Err("another Origin"));
        assert_eq!(check(&path, HOST, Some("null")), Err("another Origin"));
        assert_eq!(check("/0000/", HOST, None), Err("a wrong token"));
        assert_eq!(check("/", HOST, None), Err("a wrong token"));
        let post = guard.check(&Method::POST, &path.parse().unwrap(), &headers(HOST, &[]));
        assert_eq!(post, Err("no Origin"));
    }

    #[test]
    fn a_pass_serves_for_the_token_but_for_other_pages_requests() {
        let guard = Guard::new(8123).unwrap();
        let given = guard.set_cookie();
        assert!(given.contains("HttpOnly") && given.contains("SameSite=Strict"));
        assert!(!given.contains(guard.token()), "the pass does not tell the token");
        let pass = given.split(';').next().unwrap();
        let check = |cookie: &str, site: Option<&str>| {
            let more: Vec<_> = site.iter().map(|s| (FETCH_SITE, *s)).collect();
            let more = [&[(header::COOKIE, cookie)], &*more].concat();
            guard.check(&Method::GET, &"/socket".parse().unwrap(), &headers(HOST, &more))
        };
        for site in [None, Some("same-origin"), Some("none")] {
            assert_eq!(check(pass, site), Ok(Shown::Pass), "{site:?}");
            assert_eq!(check(&format!("a=b; {pass}; c=d"), site), Ok(Shown::Pass), "{site:?}");
        }
        for site in ["same-site", "cross-site", "?"] {
            assert_eq!(check(pass, Some(site)), Err("another page's request"), "{site}");
        }
        let of_another_port = pass.replace("8123", "8124");
        for cookie in
            ["", "gridshell-8123", "gridshell-8123=", "gridshell-8123=0", &of_another_port]
        {
            assert_eq!(check(cookie, None), Err("a wrong token"), "{cookie}");
        }
        let post = headers(HOST, &[(header::COOKIE, pass)]);
        let post = guard.check(&Method::POST, &"/open".parse().unwrap(), &post);
        assert_eq!(post, Err("no Origin"));
    }

    #[test]
    fn what_says_two_things_is_refused() {
        let guard = Guard::new(8123).unwrap();
        let path = format!("/{}/", guard.token());
        let check = |uri: &str, more: &[_]| {
            guard.check(&Method::GET, &uri.parse().unwrap(), &headers(HOST, more))
        };
        for uri in ["http://evil.example", "http://127.0.0.1:8123", "https://localhost:8123"] {
            let uri = format!("{uri}{path}");
            assert_eq!(check(&uri, &[]), Err("an address with a host in it"), "{uri}");
        }
        for host in [HOST, "localhost:8123", "evil.example"] {
            assert_eq!(check(&path, &[(header::HOST, host)]), Err("several Hosts or Origins"));
        }
        let own = (header::ORIGIN, "http://127.0.0.1:8123");
        let other = (header::ORIGIN, "http://evil.example");
        assert_eq!(check(&path, &[own, other]), Err("several Hosts or Origins"));
    }

    #[test]
    fn every_server_has_its_own_token() {
        assert_ne!(Guard::new(1).unwrap().token(), Guard::new(1).unwrap().token());
    }
}
