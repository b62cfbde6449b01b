//! Stereolithography (STL), binary and text: loose triangles, joined by [`weld`](super::mesh::weld). The binary
//! form holds single precision only: far from the origin, coordinates lose digits (0.25 m at 4,000 km).

use super::grid_file::GridFile;
use super::mesh::soup::{Digits, Soup};
use super::{LengthUnit, file, mesh, scan, text};
use crate::error::Result;
use crate::io::WRITING;
use crate::job::Job;
use glam::{DVec3, Vec3};
use std::fmt::Write;
use std::path::Path;

/// Bytes of the binary head: 80 of text and the count.
const HEAD: usize = 84;
/// Bytes of a binary facet: normal, three corners, two spare bytes.
const FACET: usize = 50;
/// Single precision is taken to have lost shape where its step exceeds this share of the model's box.
const COARSE: f64 = 1e-5;

/// A grid is written as text where the step of single precision exceeds this share of the mean member: less and files
/// of large roofs would be five times as long for nothing, more and their panels would be told apart by the format.
const COARSE_MEMBER: f64 = 1e-4;

/// Read a binary or text STL file, told apart by its length: binary files may begin with `solid` too.
///
/// # Errors
/// [`Error::Parse`](crate::Error::Parse) with line or facet.
pub(super) fn read(path: &Path, job: &Job) -> Result<Soup> {
    let bytes = file::read(path, job)?;
    let facets = bytes.get(80..HEAD).map(|c| u32::from_le_bytes([c[0], c[1], c[2], c[3]]) as usize);
    let start = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(&bytes).trim_ascii_start();
    let text_like = start.get(..5).is_some_and(|s| s.eq_ignore_ascii_case(b"solid"));
    let whole = bytes.len().saturating_sub(HEAD) / FACET;
    let mut soup = match facets {
        // Who writes as he goes may never come back to the count.
        Some(0) if !text_like && whole > 0 && bytes.len() == HEAD + whole * FACET => {
            let soup = read_binary(path, &bytes[HEAD..], whole)?;
            let note = format!("the head promises no facets, but there are {whole}: all were read");
            Soup { digits: Digits::Single, notes: vec![note], ..soup }
        }
        Some(n) if bytes.len() - HEAD >= n.saturating_mul(FACET) && (n > 0 || !text_like) => {
            let unit = LengthUnit::stated(&String::from_utf8_lossy(&bytes[..80]));
            Soup { unit, digits: Digits::Single, ..read_binary(path, &bytes[HEAD..], n)? }
        }
        // A text file has no zero bytes; a cut-off binary one surely does.
        _ if text_like && !bytes.contains(&0) => read_text(path, &bytes, job)?,
        Some(n) => {
            let message =
                format!("the file ends here, but its head promises {n} facets; export it again");
            return Err(scan::error(path, format!("facet {}", whole + 1), message));
        }
        None => {
            return Err(scan::error(
                path,
                "end of file",
                "this is no STL file, or nothing but its beginning",
            ));
        }
    };
    soup.first = 1;
    note_precision(&mut soup);
    Ok(soup)
}

fn read_binary(path: &Path, bytes: &[u8], facets: usize) -> Result<Soup> {
    let mut soup = Soup::default();
    for (k, facet) in bytes.chunks_exact(FACET).take(facets).enumerate() {
        let number =
            |i: usize| f32::from_le_bytes([facet[i], facet[i + 1], facet[i + 2], facet[i + 3]]);
        // The first three numbers are the normal, which follows from the corners.
        let corners =
            [12, 24, 36].map(|i| Vec3::new(number(i), number(i + 4), number(i + 8)).as_dvec3());
        if !corners.iter().all(|c| c.is_finite()) {
            return Err(scan::error(
                path,
                format!("facet {}", k + 1),
                "a coordinate is not finite",
            ));
        }
        push_facet(&mut soup, corners);
    }
    Ok(soup)
}

fn read_text(path: &Path, bytes: &[u8], job: &Job) -> Result<Soup> {
    let text = text::decode(bytes);
    let mut soup = Soup::default();
    let mut corners = Vec::new();
    for line in scan::lines(path, &text, job) {
        let mut words = line.text.split_ascii_whitespace();
        match words.next().map(str::to_ascii_lowercase).as_deref() {
            Some("vertex") => corners.push(line.point(&mut words)?),
            Some("endloop") => {
                let Ok(facet) = <[DVec3; 3]>::try_from(std::mem::take(&mut corners)) else {
                    return Err(line.error("a facet must have three vertices"));
                };
                push_facet(&mut soup, facet);
            }
            Some("solid") => soup.unit = soup.unit.or_else(|| LengthUnit::stated(line.text)),
            None | Some("facet" | "outer" | "endfacet" | "endsolid" | "color") => {}
            Some(word) => {
                return Err(line.error(format!("`{}` is not a word of STL", scan::clip(word))));
            }
        }
    }
    if !corners.is_empty() {
        return Err(scan::error(
            path,
            "end of file",
            "the file ends within a facet; export it again",
        ));
    }
    Ok(soup)
}

fn push_facet(soup: &mut Soup, corners: [DVec3; 3]) {
    let first = soup.points.len() as u32;
    soup.points.extend(corners);
    soup.faces.push(vec![first, first + 1, first + 2]);
}

fn note_precision(soup: &mut Soup) {
    let (low, high) = mesh::work::bounds(soup.points.iter().copied());
    let step = low.abs().max(high.abs()).max_element() * f64::from(f32::EPSILON);
    if step > COARSE * (high - low).max_element() {
        soup.notes.push(format!(
            "STL holds single precision: this far from the origin coordinates are rounded to {step:.2} m; \
             use OBJ, or move the model to the origin before export"
        ));
    }
}

/// The grid as binary STL, or as text where single precision would move its nodes; the format has no place for members,
/// and 80 letters for the rest.
pub(super) fn encode(grid: &GridFile, job: &Job) -> Vec<u8> {
    let document = grid.document;
    let seed = document.seed.map_or_else(String::new, |seed| format!(", seed {seed}"));
    let title = format!("gridshell {}{seed}, unit metre", document.version);
    let farthest =
        grid.schedule.nodes.xyz.iter().fold(0.0, |d: f64, p| d.max(p.abs().max_element()));
    let step = farthest * f64::from(f32::EPSILON);
    if step > COARSE_MEMBER * grid.schedule.figures.length.spread.mean {
        return encode_text(grid, &title);
    }
    // It must not begin with `solid`, which marks the text form.
    let mut out: Vec<u8> = title.bytes().chain(std::iter::repeat(b' ')).take(80).collect();
    let panels = &grid.schedule.panels;
    out.extend((panels.nodes.len() as u32).to_le_bytes());
    for (t, normal) in panels.nodes.iter().zip(&panels.normal).take_while(|_| !job.is_over(WRITING))
    {
        let corners = t.map(|v| grid.schedule.nodes.xyz[v as usize]);
        for p in [*normal, corners[0], corners[1], corners[2]] {
            for c in p.as_vec3().to_array() {
                out.extend(c.to_le_bytes());
            }
        }
        out.extend([0, 0]);
    }
    out
}

fn encode_text(grid: &GridFile, title: &str) -> Vec<u8> {
    let panels = &grid.schedule.panels;
    let mut out = format!("solid {title}\n");
    for (t, n) in panels.nodes.iter().zip(&panels.normal) {
        let _ = writeln!(out, "facet normal {} {} {}\nouter loop", n.x, n.y, n.z);
        for v in t {
            let p = grid.schedule.nodes.xyz[*v as usize];
            let _ = writeln!(out, "vertex {} {} {}", p.x, p.y, p.z);
        }
        out.push_str("endloop\nendfacet\n");
    }
    out.push_str("endsolid\n");
    out.into_bytes()
}
