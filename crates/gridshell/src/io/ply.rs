//! Polygon File Format (PLY, Stanford): text, and binary of either byte order. Own reader, because the head
//! may promise any number of elements: nothing is set aside before the data has been seen.

use super::grid_file::GridFile;
use super::mesh::soup::{Digits, Soup};
use super::{LengthUnit, file, scan};
use crate::error::{Error, Result};
use crate::io::WRITING;
use crate::job::Job;
use crate::schedule::Schedule;
use glam::DVec3;
use std::fmt::Write;
use std::path::Path;

/// How the numbers of the body are written.
#[derive(Clone, Copy, PartialEq)]
enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// The type of a number.
#[derive(Clone, Copy)]
enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

struct Property {
    name: String,
    scalar: Scalar,
    /// Type of the length in front of a list.
    list: Option<Scalar>,
}

struct Element {
    name: String,
    count: u64,
    properties: Vec<Property>,
}

struct Head {
    encoding: Encoding,
    elements: Vec<Element>,
    /// What a comment states.
    unit: Option<LengthUnit>,
}

/// Read the elements `vertex` (x, y, z), `face` and `tristrips` (`vertex_indices` or `vertex_index`); others, and other
/// properties, are passed over.
///
/// # Errors
/// [`Error::Parse`] with the line of the head or the element of the body.
pub(super) fn read(path: &Path, job: &Job) -> Result<Soup> {
    let bytes = file::read(path, job)?;
    let (head, body) = split_head(path, &bytes)?;
    let mut body = Body { path, encoding: head.encoding, rest: body, place: String::new() };
    let mut soup = Soup { unit: head.unit, digits: head.digits(), ..Soup::default() };
    for element in &head.elements {
        match element.name.as_str() {
            "vertex" => read_vertices(&mut body, element, &mut soup)?,
            "face" => read_faces(&mut body, element, &mut soup)?,
            "tristrips" => read_strips(&mut body, element, &mut soup)?,
            _ => body.skip(element)?,
        }
    }
    // Faces may stand before the vertices, so their numbers are checked at the end.
    for (k, face) in soup.faces.iter().enumerate() {
        if let Some(v) = face.iter().find(|&&v| v as usize >= soup.points.len()) {
            let message =
                format!("it uses vertex {v}, but there are only {}, from 0", soup.points.len());
            return Err(scan::error(path, format!("face {k}"), message));
        }
    }
    Ok(soup)
}

/// The head's meaning and the bytes behind it.
fn split_head<'a>(path: &Path, bytes: &'a [u8]) -> Result<(Head, &'a [u8])> {
    if !bytes.starts_with(b"ply") {
        return Err(scan::error(
            path,
            "line 1",
            "this is no PLY file: it does not begin with `ply`",
        ));
    }
    let mut head = Head { encoding: Encoding::Text, elements: Vec::new(), unit: None };
    let mut rest = bytes;
    let mut number = 0;
    // Lines end as the first one does: in a binary body either byte may follow the head.
    let old = bytes.starts_with(b"ply\r") && !bytes.starts_with(b"ply\r\n");
    let ends = if old { b'\r' } else { b'\n' };
    while let Some(end) = rest.iter().position(|&b| b == ends) {
        number += 1;
        let line = String::from_utf8_lossy(&rest[..end]);
        rest = &rest[end + 1..];
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        if words == ["end_header"] {
            return Ok((head, rest));
        }
        head.take(&words)
            .map_err(|message| scan::error(path, format!("line {number}"), message))?;
    }
    Err(scan::error(path, "end of file", "the head has no `end_header`; export the file again"))
}

impl Head {
    /// Take in one line of the head; the error is what is wrong with it.
    fn take(&mut self, words: &[&str]) -> std::result::Result<(), String> {
        match *words {
            ["format", format, _] => {
                self.encoding = match format {
                    "ascii" => Encoding::Text,
                    "binary_little_endian" => Encoding::LittleEndian,
                    "binary_big_endian" => Encoding::BigEndian,
                    _ => return Err(format!("unknown format `{}`", scan::clip(format))),
                };
            }
            ["element", name, count] => {
                let count =
                    count.parse().map_err(|_| format!("`{}` is not a count", scan::clip(count)))?;
                self.elements.push(Element {
                    name: name.to_owned(),
                    count,
                    properties: Vec::new(),
                });
            }
            ["property", "list", length, scalar, name] => {
                self.push(Property {
                    name: name.to_owned(),
                    scalar: parse(scalar)?,
                    list: Some(parse(length)?),
                })?;
            }
            ["property", scalar, name] => {
                self.push(Property { name: name.to_owned(), scalar: parse(scalar)?, list: None })?;
            }
            ["comment" | "obj_info", ..] => {
                self.unit = self.unit.or_else(|| LengthUnit::stated(&words[1..].join(" ")));
            }
            ["ply"] | [] => {}
            _ => return Err(format!("`{}` is not understood", scan::clip(&words.join(" ")))),
        }
        Ok(())
    }

    /// Single where the coordinates are binary floats.
    fn digits(&self) -> Digits {
        let vertex = self.elements.iter().find(|e| e.name == "vertex");
        let x = vertex.and_then(|e| e.properties.iter().find(|p| p.name == "x"));
        match x.map(|p| p.scalar) {
            Some(Scalar::F32) => Digits::Single,
            _ => Digits::Double,
        }
    }

    fn push(&mut self, property: Property) -> std::result::Result<(), String> {
        let element = self.elements.last_mut().ok_or("a property stands before any element")?;
        element.properties.push(property);
        Ok(())
    }
}

fn parse(name: &str) -> std::result::Result<Scalar, String> {
    Ok(match name {
        "char" | "int8" => Scalar::I8,
        "uchar" | "uint8" => Scalar::U8,
        "short" | "int16" => Scalar::I16,
        "ushort" | "uint16" => Scalar::U16,
        "int" | "int32" => Scalar::I32,
        "uint" | "uint32" => Scalar::U32,
        "float" | "float32" => Scalar::F32,
        "double" | "float64" => Scalar::F64,
        _ => return Err(format!("unknown type `{}`", scan::clip(name))),
    })
}

fn read_vertices(body: &mut Body, element: &Element, soup: &mut Soup) -> Result<()> {
    let place = |name: &str| {
        let found = element.properties.iter().position(|p| p.name == name && p.list.is_none());
        found.ok_or_else(|| {
            scan::error(body.path, "head", format!("the vertices have no property {name}"))
        })
    };
    let xyz = [place("x")?, place("y")?, place("z")?];
    for k in 0..element.count {
        body.place = format!("vertex {k}");
        let mut values = Vec::with_capacity(element.properties.len());
        for property in &element.properties {
            values.push(if property.list.is_some() {
                body.list(property, drop)?
            } else {
                body.number(property.scalar)?
            });
        }
        let p = DVec3::from(xyz.map(|i| values[i]));
        if !p.is_finite() {
            return Err(body.error("a coordinate is not finite"));
        }
        soup.points.push(p);
    }
    Ok(())
}

fn is_corners(p: &Property) -> bool {
    p.list.is_some() && matches!(p.name.as_str(), "vertex_indices" | "vertex_index")
}

fn read_faces(body: &mut Body, element: &Element, soup: &mut Soup) -> Result<()> {
    if !element.properties.iter().any(is_corners) {
        return Err(scan::error(
            body.path,
            "head",
            "the faces have no property list vertex_indices",
        ));
    }
    for k in 0..element.count {
        body.place = format!("face {k}");
        let mut face = Vec::new();
        for property in &element.properties {
            if is_corners(property) {
                body.list(property, |v| face.push(v))?;
            } else {
                body.pass(property)?;
            }
        }
        let corners: Vec<u32> = face.iter().map(|&v| body.vertex(v)).collect::<Result<_>>()?;
        if corners.len() >= 3 {
            soup.faces.push(corners);
        }
    }
    Ok(())
}

/// Strips of triangles, as scanners write them: each vertex makes a triangle with the two before it; -1 ends a strip.
fn read_strips(body: &mut Body, element: &Element, soup: &mut Soup) -> Result<()> {
    for k in 0..element.count {
        body.place = format!("strip {k}");
        let mut corners = Vec::new();
        for property in &element.properties {
            if is_corners(property) {
                body.list(property, |v| corners.push(v))?;
            } else {
                body.pass(property)?;
            }
        }
        for strip in corners.split(|&v| v == -1.0) {
            let strip = strip.iter().map(|&v| body.vertex(v)).collect::<Result<Vec<u32>>>()?;
            for (k, t) in strip.windows(3).enumerate() {
                // Strips go on by standing still.
                if t[0] != t[1] && t[1] != t[2] && t[2] != t[0] {
                    soup.faces.push(if k % 2 == 0 { t.to_vec() } else { vec![t[1], t[0], t[2]] });
                }
            }
        }
    }
    Ok(())
}

/// What is left to read behind the head.
struct Body<'a> {
    path: &'a Path,
    encoding: Encoding,
    rest: &'a [u8],
    /// The element being read.
    place: String,
}

impl Body<'_> {
    fn error(&self, message: &str) -> Error {
        scan::error(self.path, self.place.clone(), message)
    }

    /// A number as that of a vertex.
    fn vertex(&self, v: f64) -> Result<u32> {
        let whole = v >= 0.0 && v < f64::from(u32::MAX) && v.fract() == 0.0;
        if whole { Ok(v as u32) } else { Err(self.error(&format!("{v} is not a vertex number"))) }
    }

    fn cut_off(&self) -> Error {
        self.error("the file ends here, before all the elements its head promises; export it again")
    }

    /// Pass over all of an element.
    fn skip(&mut self, element: &Element) -> Result<()> {
        if element.properties.is_empty() {
            return Ok(());
        }
        for k in 0..element.count {
            self.place = format!("{} {k}", scan::clip(&element.name));
            for property in &element.properties {
                self.pass(property)?;
            }
        }
        Ok(())
    }

    /// Pass over one property.
    fn pass(&mut self, property: &Property) -> Result<()> {
        if property.list.is_some() {
            self.list(property, drop)?;
        } else {
            self.number(property.scalar)?;
        }
        Ok(())
    }

    /// Hand each number of a list to `to`; how many there were.
    fn list(&mut self, property: &Property, mut to: impl FnMut(f64)) -> Result<f64> {
        let length = self.number(property.list.unwrap_or(Scalar::U8))?;
        if !(length >= 0.0 && length.fract() == 0.0) {
            return Err(self.error(&format!("{length} is not a length of a list")));
        }
        for _ in 0..length as u64 {
            to(self.number(property.scalar)?);
        }
        Ok(length)
    }

    fn number(&mut self, scalar: Scalar) -> Result<f64> {
        match self.encoding {
            Encoding::Text => self.word(),
            Encoding::LittleEndian | Encoding::BigEndian => self.binary(scalar),
        }
    }

    fn word(&mut self) -> Result<f64> {
        let rest = self.rest.trim_ascii_start();
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        let (word, rest) = rest.split_at(end);
        self.rest = rest;
        if word.is_empty() {
            return Err(self.cut_off());
        }
        let word = String::from_utf8_lossy(word);
        word.parse().map_err(|_| self.error(&format!("`{}` is not a number", scan::clip(&word))))
    }

    fn binary(&mut self, scalar: Scalar) -> Result<f64> {
        Ok(match scalar {
            Scalar::I8 => f64::from(i8::from_le_bytes(self.take()?)),
            Scalar::U8 => f64::from(u8::from_le_bytes(self.take()?)),
            Scalar::I16 => f64::from(i16::from_le_bytes(self.take()?)),
            Scalar::U16 => f64::from(u16::from_le_bytes(self.take()?)),
            Scalar::I32 => f64::from(i32::from_le_bytes(self.take()?)),
            Scalar::U32 => f64::from(u32::from_le_bytes(self.take()?)),
            Scalar::F32 => f64::from(f32::from_le_bytes(self.take()?)),
            Scalar::F64 => f64::from_le_bytes(self.take()?),
        })
    }

    /// The next bytes, the least significant first.
    fn take<const N: usize>(&mut self) -> Result<[u8; N]> {
        let Some((first, rest)) = self.rest.split_first_chunk::<N>() else {
            return Err(self.cut_off());
        };
        self.rest = rest;
        let mut bytes = *first;
        if self.encoding == Encoding::BigEndian {
            bytes.reverse();
        }
        Ok(bytes)
    }
}

/// The grid as text PLY with an element for the members; its measures are properties.
pub(super) fn encode(grid: &GridFile, job: &Job) -> Vec<u8> {
    let Schedule { nodes, members, panels, .. } = grid.schedule;
    let mut out = String::from("ply\nformat ascii 1.0\n");
    for line in grid.header() {
        let _ = writeln!(out, "comment {line}");
    }
    let _ = writeln!(out, "element vertex {}", grid.schedule.nodes.xyz.len());
    out.push_str("property double x\nproperty double y\nproperty double z\n");
    out.push_str("property double nx\nproperty double ny\nproperty double nz\n");
    out.push_str("property int degree\nproperty int adjusted_degree\n");
    out.push_str("property uchar boundary\nproperty uchar support\nproperty int group\n");
    let _ = writeln!(out, "element face {}", panels.nodes.len());
    out.push_str("property list uchar int vertex_indices\n");
    out.push_str("property double area\nproperty double shape\nproperty int group\n");
    let _ = writeln!(out, "element edge {}", members.ends.len());
    out.push_str("property int vertex1\nproperty int vertex2\n");
    out.push_str("property double length\nproperty double twist_deg\nproperty int group\n");
    out.push_str("property double nx\nproperty double ny\nproperty double nz\n");
    out.push_str("end_header\n");
    let supported = grid.supported();
    for (v, DVec3 { x, y, z }) in nodes.xyz.iter().enumerate().take_while(|_| !job.is_over(WRITING))
    {
        let n = nodes.normal[v];
        let _ = write!(out, "{x} {y} {z} {} {} {} ", n.x, n.y, n.z);
        let (boundary, support) = (u8::from(nodes.boundary[v]), u8::from(supported[v]));
        let (degree, adjusted) = (nodes.degree[v], nodes.adjusted_degree[v]);
        let _ = writeln!(out, "{degree} {adjusted} {boundary} {support} {}", nodes.group[v]);
    }
    for (k, [a, b, c]) in panels.nodes.iter().enumerate().take_while(|_| !job.is_over(WRITING)) {
        let (area, shape, group) = (panels.area[k], panels.shape[k], panels.group[k]);
        let _ = writeln!(out, "3 {a} {b} {c} {area} {shape} {group}");
    }
    for (k, [a, b]) in members.ends.iter().enumerate().take_while(|_| !job.is_over(WRITING)) {
        let (length, twist, n) = (members.length[k], members.twist_deg[k], members.normal[k]);
        let _ = write!(out, "{a} {b} {length} {twist} {} ", members.group[k]);
        let _ = writeln!(out, "{} {} {}", n.x, n.y, n.z);
    }
    out.into_bytes()
}
