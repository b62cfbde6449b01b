//! The file's own table of objects, read past the decoder, so that nothing it drops is dropped in silence.
//!
//! A file is a header of 32 bytes and chunks: a code, a length (four bytes to Rhino 4, eight from Rhino 5 on), and so
//! many bytes; where the code's highest bit is set, a value stands in place of the length and nothing follows.
//! Rhino 1 has no such table.

use glam::DVec3;
use std::fmt::Write;

/// Codes of chunks (`opennurbs_3dm.h`).
const OBJECT_TABLE: u32 = 0x1000_0013;
const BLOCK_TABLE: u32 = 0x1000_0021;
const END_OF_TABLE: u32 = 0xffff_ffff;
const OBJECT_RECORD: u32 = 0x2000_8070;
const OBJECT_TYPE: u32 = 0x8200_0071;
const OBJECT_ATTRIBUTES: u32 = 0x0200_8072;
const OBJECT_CLASS: u32 = 0x0002_7ffa;
const CLASS_ID: u32 = 0x0002_fffb;
const CLASS_DATA: u32 = 0x0002_fffc;
/// The class of plane surfaces.
const PLANE_SURFACE: &str = "4ed7d4df-e947-11d3-bfe5-0010830122f0";
const SHORT: u32 = 0x8000_0000;
/// A bit of codes whose chunks end with a check sum.
const CHECKED: u32 = 0x8000;
/// Bytes before the first chunk.
const HEADER: usize = 32;
/// The marks of a name among the attributes of Rhino 5 and later.
const NAME: u8 = 1;
/// Longer names are none.
const LONGEST_NAME: usize = 4096;

/// An object as the table has it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    /// As the decoder writes it; empty where the file has none.
    pub id: String,
    pub kind: Kind,
    pub name: String,
    /// The layer by its place in the table of layers.
    pub layer: i32,
    /// Corners of a plane surface, in the file's unit: the decoder forgets where one ends. Seen from its outside,
    /// lower left, upper left, lower right, upper right.
    pub plane: Option<[DVec3; 4]>,
}

/// What an object is; curves, points, lights and texts are `Other`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Surface,
    Brep,
    Mesh,
    Block,
    SubD,
    Extrusion,
    Other,
}

impl Kind {
    fn of(value: u64) -> Kind {
        match value {
            0x8 => Kind::Surface,
            0x10 => Kind::Brep,
            0x20 => Kind::Mesh,
            0x1000 => Kind::Block,
            0x4_0000 => Kind::SubD,
            0x4000_0000 => Kind::Extrusion,
            _ => Kind::Other,
        }
    }

    /// As people call it.
    pub fn told(self) -> &'static str {
        match self {
            Kind::Surface => "surface",
            Kind::Brep => "brep",
            Kind::Mesh => "mesh",
            Kind::Block => "block",
            Kind::SubD => "SubD",
            Kind::Extrusion => "extrusion",
            Kind::Other => "object",
        }
    }
}

/// The file with an empty table of definitions of blocks, so that their members are objects like others.
pub(super) fn without_blocks(mut bytes: Vec<u8>) -> Vec<u8> {
    let Some(wide) = wide(&bytes) else { return bytes };
    let head = if wide { 12 } else { 8 };
    let Some((at, length)) = table_of_blocks(&bytes, wide) else { return bytes };
    let number = |n: usize| (n as u64).to_le_bytes()[..head - 4].to_vec();
    let end_of_table = [END_OF_TABLE.to_le_bytes().to_vec(), number(0)].concat();
    let empty = [BLOCK_TABLE.to_le_bytes().to_vec(), number(head), end_of_table].concat();
    bytes.splice(at..at + head + length, empty);
    // The last chunk tells how long the file is.
    let size = number(bytes.len());
    if let Some(last) = bytes.len().checked_sub(size.len()).filter(|&k| k > HEADER) {
        bytes[last..].copy_from_slice(&size);
    }
    bytes
}

/// Where the table of definitions of blocks begins, and the length of its contents.
fn table_of_blocks(bytes: &[u8], wide: bool) -> Option<(usize, usize)> {
    let mut chunks = Chunks { bytes: &bytes[HEADER..], wide };
    loop {
        let at = bytes.len() - chunks.bytes.len();
        let chunk = chunks.next()?;
        if chunk.code & !CHECKED == BLOCK_TABLE {
            return Some((at, chunk.body.len()));
        }
    }
}

/// All objects, in the order of the file; empty where there is no table.
pub(super) fn rows(bytes: &[u8]) -> Vec<Row> {
    let Some(wide) = wide(bytes) else { return Vec::new() };
    let mut chunks = Chunks { bytes: &bytes[HEADER..], wide };
    let table = chunks.find(|c| c.code & !CHECKED == OBJECT_TABLE);
    let records = table.map(|table| Chunks { bytes: table.body, wide });
    let records = records.into_iter().flatten().filter(|c| c.code == OBJECT_RECORD);
    records.map(|record| row(record.body, wide)).collect()
}

/// Whether lengths have eight bytes; None where there are no chunks of this kind.
fn wide(bytes: &[u8]) -> Option<bool> {
    let digits = String::from_utf8_lossy(bytes.get(24..HEADER)?);
    let version: u32 = digits.trim().parse().ok()?;
    (version >= 2).then_some(version >= 50)
}

fn row(body: &[u8], wide: bool) -> Row {
    let (id, name) = (String::new(), String::new());
    let mut row = Row { id, kind: Kind::Other, name, layer: -1, plane: None };
    for chunk in (Chunks { bytes: body, wide }) {
        match chunk.code {
            OBJECT_TYPE => row.kind = Kind::of(chunk.value & u64::from(u32::MAX)),
            OBJECT_CLASS => row.plane = plane(Chunks { bytes: chunk.body, wide }),
            OBJECT_ATTRIBUTES => {
                let _ = attributes(chunk.body, &mut row);
            }
            _ => {}
        }
    }
    row
}

/// The corners of a plane surface: its axes, then the stretch along each, as parameters and (from 1.1) as lengths.
fn plane(mut object: Chunks) -> Option<[DVec3; 4]> {
    let class = object.next().filter(|c| c.code & !CHECKED == CLASS_ID & !CHECKED)?;
    let data = object.next().filter(|c| c.code & !CHECKED == CLASS_DATA & !CHECKED)?;
    if uuid(class.body.get(..16)?) != PLANE_SURFACE {
        return None;
    }
    let version = *data.body.first()?;
    let number = |k: usize| {
        let at = 1 + 8 * k;
        let x = f64::from_le_bytes(data.body.get(at..at + 8)?.try_into().ok()?);
        x.is_finite().then_some(x)
    };
    let vector = |k: usize| Some(DVec3::new(number(k)?, number(k + 1)?, number(k + 2)?));
    let (origin, x, y) = (vector(0)?, vector(3)?, vector(6)?);
    let from = if version.trailing_zeros() >= 4 { 16 } else { 20 };
    let [left, right, low, high] =
        [number(from)?, number(from + 1)?, number(from + 2)?, number(from + 3)?];
    let corner = |u: f64, v: f64| origin + x * u + y * v;
    Some([corner(left, low), corner(left, high), corner(right, low), corner(right, high)])
}

/// Identifier, layer and name; None where they are cut off.
fn attributes(body: &[u8], row: &mut Row) -> Option<()> {
    let major = body.first()? >> 4;
    row.id = uuid(body.get(1..17)?);
    row.layer = i32::from_le_bytes(body.get(17..21)?.try_into().ok()?);
    let name = match major {
        // Material, colour, line style, thickness, scale, density and sources lie before it.
        1 => body.get(21 + 36..)?,
        2 if *body.get(21)? == NAME => body.get(22..)?,
        _ => return Some(()),
    };
    let count = u32::from_le_bytes(name.get(..4)?.try_into().ok()?) as usize;
    if count > LONGEST_NAME {
        return None;
    }
    let wide = name.get(4..4 + 2 * count)?.chunks_exact(2);
    let units: Vec<u16> = wide.map(|pair| u16::from_le_bytes([pair[0], pair[1]])).collect();
    String::from_utf16_lossy(&units).trim_end_matches('\0').clone_into(&mut row.name);
    Some(())
}

/// As it is written: the first three numbers lie with their lowest byte first. Empty where it is nothing but zeros.
fn uuid(bytes: &[u8]) -> String {
    const ORDER: [usize; 16] = [3, 2, 1, 0, 5, 4, 7, 6, 8, 9, 10, 11, 12, 13, 14, 15];
    if bytes.iter().all(|&b| b == 0) {
        return String::new();
    }
    let mut text = String::new();
    for (k, &i) in ORDER.iter().enumerate() {
        if [4, 6, 8, 10].contains(&k) {
            text.push('-');
        }
        let _ = write!(text, "{:02x}", bytes[i]);
    }
    text
}

struct Chunk<'a> {
    code: u32,
    value: u64,
    body: &'a [u8],
}

/// Chunks one after the other, to the first that does not fit.
struct Chunks<'a> {
    bytes: &'a [u8],
    wide: bool,
}

impl<'a> Iterator for Chunks<'a> {
    type Item = Chunk<'a>;

    fn next(&mut self) -> Option<Chunk<'a>> {
        let code = u32::from_le_bytes(self.bytes.get(..4)?.try_into().ok()?);
        let head = if self.wide { 12 } else { 8 };
        let value = match *self.bytes.get(4..head)? {
            [a, b, c, d] => u64::from(u32::from_le_bytes([a, b, c, d])),
            [a, b, c, d, e, f, g, h] => u64::from_le_bytes([a, b, c, d, e, f, g, h]),
            _ => return None,
        };
        let length = if code & SHORT == 0 { usize::try_from(value).ok()? } else { 0 };
        let body = self.bytes.get(head..head.checked_add(length)?)?;
        self.bytes = &self.bytes[head + length..];
        Some(Chunk { code, value, body })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chunk(code: u32, body: &[u8], wide: bool) -> Vec<u8> {
        let mut bytes = code.to_le_bytes().to_vec();
        bytes.extend(&(body.len() as u64).to_le_bytes()[..if wide { 8 } else { 4 }]);
        bytes.extend(body);
        bytes
    }

    fn short(code: u32, value: u32, wide: bool) -> Vec<u8> {
        let mut bytes = code.to_le_bytes().to_vec();
        bytes.extend(&u64::from(value).to_le_bytes()[..if wide { 8 } else { 4 }]);
        bytes
    }

    /// A file of one object of this type, named "Dach", on layer 3.
    fn file(version: u32, kind: u32) -> Vec<u8> {
        let wide = version >= 50;
        let mut body = vec![if wide { 0x20 } else { 0x10 }];
        body.extend(1..=16);
        body.extend(3_i32.to_le_bytes());
        body.extend(if wide { vec![NAME] } else { vec![0; 36] });
        body.extend(5_u32.to_le_bytes());
        body.extend("Dach\0".encode_utf16().flat_map(u16::to_le_bytes));
        let record = [
            short(OBJECT_TYPE, kind, wide),
            chunk(OBJECT_ATTRIBUTES, &body, wide),
            short(0x8200_007F, 0, wide),
        ];
        let record = chunk(OBJECT_RECORD, &record.concat(), wide);
        let mut bytes = format!("3D Geometry File Format {version:8}").into_bytes();
        bytes.extend(chunk(1, b"a comment", wide));
        bytes.extend(chunk(OBJECT_TABLE, &record, wide));
        bytes
    }

    /// Short lengths and fixed attributes of Rhino 2 and 4, long lengths and marked ones from Rhino 5 on.
    #[test]
    fn objects_are_listed_with_kind_name_and_layer_in_every_version() {
        for (version, code, kind) in [
            (2, 0x10, Kind::Brep),
            (4, 0x20, Kind::Mesh),
            (50, 0x4_0000, Kind::SubD),
            (60, 0x1000, Kind::Block),
            (80, 0x4000_0000, Kind::Extrusion),
        ] {
            let id = "04030201-0605-0807-090a-0b0c0d0e0f10".to_owned();
            let row = Row { id, kind, name: "Dach".into(), layer: 3, plane: None };
            assert_eq!(rows(&file(version, code)), [row], "version {version}");
        }
    }

    #[test]
    fn cut_off_files_list_what_is_whole() {
        let whole = file(70, 0x10);
        for cut in 0..whole.len() {
            assert!(rows(&whole[..cut]).len() <= 1);
        }
    }
}
