//! The page's files, as they were built into this program; where Node was missing then, a page that says so.

use std::borrow::Cow;
use std::path::Path;

include!(concat!(env!("OUT_DIR"), "/page.rs"));

/// What is shown instead of a page that was not built.
const MISSING: &str = include_str!("missing.html");

/// A file of the page.
pub struct File {
    name: String,
    bytes: Cow<'static, [u8]>,
}

/// All files of the page.
pub struct Page {
    files: Vec<File>,
}

impl Page {
    /// The page built into this program.
    pub fn built_in() -> Page {
        let file = |&(name, bytes): &(&str, &'static [u8])| File {
            name: name.into(),
            bytes: bytes.into(),
        };
        Page { files: FILES.iter().map(file).collect() }
    }

    /// The page in a folder, read once: for working on the page.
    ///
    /// # Errors
    /// What reading says.
    pub fn in_folder(folder: &Path) -> std::io::Result<Page> {
        let mut files = Vec::new();
        let mut folders = vec![folder.to_owned()];
        while let Some(inner) = folders.pop() {
            for entry in std::fs::read_dir(inner)? {
                let path = entry?.path();
                if path.is_dir() {
                    folders.push(path);
                    continue;
                }
                let name =
                    path.strip_prefix(folder).unwrap_or(&path).to_string_lossy().replace('\\', "/");
                files.push(File { name, bytes: std::fs::read(&path)?.into() });
            }
        }
        Ok(Page { files })
    }

    /// The file of this name, and its type; the page itself without a name.
    pub fn file(&self, name: &str) -> Option<(&'static str, Cow<'static, [u8]>)> {
        let name = if name.is_empty() { "index.html" } else { name };
        let found = self.files.iter().find(|f| f.name == name).map(|f| f.bytes.clone());
        let missing =
            (self.files.is_empty() && name == "index.html").then(|| MISSING.as_bytes().into());
        found.or(missing).map(|bytes| (kind(name), bytes))
    }
}

fn kind(name: &str) -> &'static str {
    match name.rsplit('.').next().unwrap_or_default() {
        "html" => "text/html; charset=utf-8",
        "js" => "text/javascript; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "md" => "text/markdown; charset=utf-8",
        "svg" => "image/svg+xml",
        "woff2" => "font/woff2",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_without_a_page_says_how_to_get_it() {
        let page = Page { files: Vec::new() };
        let (kind, bytes) = page.file("").unwrap();
        assert!(kind.starts_with("text/html"));
        assert!(String::from_utf8_lossy(&bytes).contains("Node"));
        assert!(page.file("main.js").is_none());
    }
}
