//! Numbers out of a glTF file's buffers: accessors, views, and the bytes behind them.

use super::document::{Accessor, Document, Sparse};
use crate::error::{Error, Result};
use crate::io::{file, scan};
use crate::job::Job;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::DVec3;
use std::borrow::Cow;
use std::path::{Component, Path};

/// More buffers are refused: each may be a large file.
const MOST_BUFFERS: usize = 64;
/// More points that all begin at zero are refused: they cost the file nothing.
const MOST_ZEROS: usize = 1_000_000;
/// Numbers of the types of components.
const I8: u32 = 5120;
const U8: u32 = 5121;
const I16: u32 = 5122;
const U16: u32 = 5123;
const U32: u32 = 5125;
const F32: u32 = 5126;

/// The buffers of a file and how they are read.
pub(super) struct Numbers<'a> {
    path: &'a Path,
    document: &'a Document,
    buffers: Vec<Cow<'a, [u8]>>,
}

impl<'a> Numbers<'a> {
    /// Fetch all buffers: the binary chunk, `data:` or a file in the same folder.
    ///
    /// # Errors
    /// [`Error::Parse`] with the buffer, [`Error::Io`] for a file beside this one.
    pub fn new(
        path: &'a Path,
        document: &'a Document,
        binary: Option<&'a [u8]>,
        job: &Job,
    ) -> Result<Numbers<'a>> {
        let mut buffers = Vec::new();
        if document.buffers.len() > MOST_BUFFERS {
            let place = format!("buffer {MOST_BUFFERS}");
            return Err(scan::error(
                path,
                place,
                "no more buffers than this are read; pack them into one",
            ));
        }
        for (b, buffer) in document.buffers.iter().enumerate() {
            buffers.push(match (&buffer.uri, binary) {
                (Some(uri), _) => Cow::Owned(fetch(path, uri, &format!("buffer {b}"), job)?),
                (None, Some(binary)) if b == 0 => Cow::Borrowed(binary),
                (None, _) => Cow::Borrowed(&[][..]),
            });
        }
        Ok(Numbers { path, document, buffers })
    }

    /// The points that an accessor holds.
    ///
    /// # Errors
    /// [`Error::Parse`] with the accessor.
    pub fn points(&self, accessor: usize) -> Result<Vec<DVec3>> {
        Ok(self.rows::<3>(accessor)?.into_iter().map(DVec3::from).collect())
    }

    /// The vectors of three or four numbers that an accessor holds.
    ///
    /// # Errors
    /// [`Error::Parse`] with the accessor.
    pub fn rows<const N: usize>(&self, accessor: usize) -> Result<Vec<[f64; N]>> {
        let at = self.accessor(accessor, &format!("VEC{N}"))?;
        let scale = match (at.normalized, at.component_type) {
            (true, I8) => 1.0 / f64::from(i8::MAX),
            (true, U8) => 1.0 / f64::from(u8::MAX),
            (true, I16) => 1.0 / f64::from(i16::MAX),
            (true, U16) => 1.0 / f64::from(u16::MAX),
            _ => 1.0,
        };
        let row = |item: &[u8]| {
            let size = item.len() / N;
            std::array::from_fn(|c| {
                let x = number(&item[c * size..(c + 1) * size], at.component_type) * scale;
                if at.normalized { x.max(-1.0) } else { x }
            })
        };
        let mut rows: Vec<[f64; N]> = match (&at.sparse, at.buffer_view) {
            (Some(_), None) if at.count <= MOST_ZEROS => vec![[0.0; N]; at.count],
            _ => self.items(accessor, at, N)?.map(row).collect(),
        };
        if let Some(sparse) = &at.sparse {
            for (k, replaced) in self.replaced(accessor, at, sparse, row)? {
                rows[k] = replaced;
            }
        }
        match rows.iter().position(|row| !row.iter().all(|x| x.is_finite())) {
            Some(k) => Err(self.error(accessor, format!("item {k} is not finite"))),
            None => Ok(rows),
        }
    }

    /// The rows of an accessor that are given apart, with their places.
    fn replaced<const N: usize>(
        &self,
        accessor: usize,
        at: &Accessor,
        sparse: &Sparse,
        row: impl Fn(&[u8]) -> [f64; N],
    ) -> Result<Vec<(usize, [f64; N])>> {
        let part = |of: &Accessor, component_type: u32| Accessor {
            buffer_view: of.buffer_view,
            byte_offset: of.byte_offset,
            component_type,
            count: sparse.count,
            ..Accessor::default()
        };
        let places = part(&sparse.indices, sparse.indices.component_type);
        let values = part(&sparse.values, at.component_type);
        let place = |item: &[u8]| match number(item, places.component_type) {
            k if k >= 0.0 && k < at.count as f64 => Ok(k as usize),
            k => Err(self.error(accessor, format!("it replaces item {k} of {}", at.count))),
        };
        let places: Vec<usize> =
            self.items(accessor, &places, 1)?.map(place).collect::<Result<_>>()?;
        Ok(places.into_iter().zip(self.items(accessor, &values, N)?.map(row)).collect())
    }

    /// Whether the file holds the numbers of an accessor as they are, whatever else it says of them.
    pub fn holds(&self, accessor: usize) -> bool {
        let view = self.document.accessors.get(accessor).and_then(|at| at.buffer_view);
        let view = view.and_then(|v| self.document.buffer_views.get(v));
        view.is_some_and(|v| self.buffers.get(v.buffer).is_some_and(|b| !b.is_empty()))
    }

    /// The vertex numbers that an accessor holds.
    ///
    /// # Errors
    /// [`Error::Parse`] with the accessor.
    pub fn indices(&self, accessor: usize) -> Result<Vec<u32>> {
        let at = self.accessor(accessor, "SCALAR")?;
        if at.sparse.is_some() {
            let message = "vertex numbers in sparse accessors cannot be read; export without them";
            return Err(self.error(accessor, message));
        }
        if !matches!(at.component_type, U8 | U16 | U32) {
            return Err(self.error(accessor, "vertex numbers must be unsigned whole numbers"));
        }
        Ok(self
            .items(accessor, at, 1)?
            .map(|item| number(item, at.component_type) as u32)
            .collect())
    }

    fn accessor(&self, accessor: usize, kind: &str) -> Result<&'a Accessor> {
        let Some(at) = self.document.accessors.get(accessor) else {
            return Err(self.error(accessor, "it is used, but there is none"));
        };
        if at.kind != kind {
            let message = format!("it should be {kind}, but is `{}`", scan::clip(&at.kind));
            return Err(self.error(accessor, message));
        }
        Ok(at)
    }

    /// The bytes of each item of an accessor.
    fn items(
        &self,
        accessor: usize,
        at: &Accessor,
        parts: usize,
    ) -> Result<impl Iterator<Item = &[u8]>> {
        let part = match at.component_type {
            I8 | U8 => 1,
            I16 | U16 => 2,
            U32 | F32 => 4,
            other => {
                return Err(self.error(accessor, format!("{other} is not a type of components")));
            }
        };
        let size = part * parts;
        let view = at.buffer_view.and_then(|v| self.document.buffer_views.get(v));
        let Some(view) = view else {
            return Err(self.error(accessor, "it has no buffer view"));
        };
        if view.extensions.meshopt.is_some() && !self.holds(accessor) {
            let message = "it is compressed (EXT_meshopt_compression), which cannot be read; export it without compression";
            return Err(self.error(accessor, message));
        }
        let stride = view.byte_stride.unwrap_or(size);
        if stride < size {
            return Err(
                self.error(accessor, format!("its items of {size} bytes lie {stride} apart"))
            );
        }
        let bytes = (self.buffers.get(view.buffer))
            .and_then(|b| b.get(view.byte_offset..view.byte_offset.checked_add(view.byte_length)?))
            .and_then(|b| b.get(at.byte_offset..));
        // The last item need not fill its stride.
        let wanted =
            at.count.saturating_sub(1).checked_mul(stride).and_then(|n| n.checked_add(size));
        let Some(bytes) = bytes.filter(|b| at.count == 0 || wanted.is_some_and(|n| n <= b.len()))
        else {
            let message =
                format!("its {} items end outside the buffer; export the file again", at.count);
            return Err(self.error(accessor, message));
        };
        Ok((0..at.count).map(move |k| &bytes[k * stride..k * stride + size]))
    }

    fn error(&self, accessor: usize, message: impl Into<String>) -> Error {
        scan::error(self.path, format!("accessor {accessor}"), message)
    }
}

/// One number, the least significant byte first.
fn number(bytes: &[u8], component_type: u32) -> f64 {
    match (component_type, bytes) {
        (I8, &[a]) => f64::from(a as i8),
        (U8, &[a]) => f64::from(a),
        (I16, &[a, b]) => f64::from(i16::from_le_bytes([a, b])),
        (U16, &[a, b]) => f64::from(u16::from_le_bytes([a, b])),
        (U32, &[a, b, c, d]) => f64::from(u32::from_le_bytes([a, b, c, d])),
        (F32, &[a, b, c, d]) => f64::from(f32::from_le_bytes([a, b, c, d])),
        _ => unreachable!("items are cut to the size of their type"),
    }
}

/// What a URI holds.
fn fetch(path: &Path, uri: &str, place: &str, job: &Job) -> Result<Vec<u8>> {
    if let Some(data) = uri.strip_prefix("data:") {
        let Some((_, text)) = data.split_once(";base64,") else {
            return Err(scan::error(path, place, "its data is not in base64"));
        };
        return STANDARD
            .decode(text)
            .map_err(|e| scan::error(path, place, format!("its base64 is damaged: {e}")));
    }
    let name = unescape(uri);
    let beside = Path::new(&name);
    // A model has no business outside its folder, nor on the net.
    if uri.contains(':')
        || !beside.components().all(|c| matches!(c, Component::Normal(_) | Component::CurDir))
    {
        let message = format!("`{}` is not a file in this folder", scan::clip(uri));
        return Err(scan::error(path, place, message));
    }
    file::read(&path.parent().unwrap_or(Path::new("")).join(beside), job)
}

/// A URI without its percent signs.
fn unescape(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, others)) = rest.split_first() {
        let hex =
            others.get(..2).filter(|_| first == b'%').and_then(|h| std::str::from_utf8(h).ok());
        if let Some(byte) = hex.and_then(|h| u8::from_str_radix(h, 16).ok()) {
            bytes.push(byte);
            rest = &others[2..];
        } else {
            bytes.push(first);
            rest = others;
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}
