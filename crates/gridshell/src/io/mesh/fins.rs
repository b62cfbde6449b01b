//! Edges with more than two faces: slivers that hang on a surface are cut off, anything larger is named.

use super::work::{Use, Work, place, uses};
use crate::error::{Error, Result};
use crate::surface::Loss;
use std::path::Path;

/// What hangs on a surface is a sliver below this share of the whole area.
const SLIVER: f64 = 1e-3;
/// Cutting off slivers may lay others bare: so many rounds at most.
const ROUNDS: usize = 8;
/// Places named in an error.
const NAMED: usize = 5;

/// Leave no edge with more than two faces.
///
/// # Errors
/// [`Error::Surface`] naming the edges and their faces.
pub(super) fn cut(path: &Path, work: &mut Work) -> Result<()> {
    for _ in 0..ROUNDS {
        let uses = uses(&work.faces);
        let crowded: Vec<&[Use]> = by_edge(&uses).filter(|edge| edge.len() > 2).collect();
        if crowded.is_empty() {
            return Ok(());
        }
        let gone = slivers(work, &uses, &crowded);
        if !gone.contains(&true) {
            return Err(fault(path, work, &crowded));
        }
        let at = gone.iter().position(|&g| g).map_or(0, |f| work.faces[f][0]);
        let count = gone.iter().filter(|&&g| g).count();
        let at = place(work.points[at as usize]);
        let lost = work.faces.iter().zip(&gone).filter(|(_, g)| **g);
        work.losses.push(Loss {
            what: "slivers".to_owned(),
            why: format!("they hung on edges with two other faces, the first near {at}"),
            faces: count,
            area: Some(lost.map(|(face, _)| work.area(face)).sum()),
            whole: false,
        });
        work.drop_faces(&gone);
    }
    let uses = uses(&work.faces);
    let crowded: Vec<&[Use]> = by_edge(&uses).filter(|edge| edge.len() > 2).collect();
    if crowded.is_empty() { Ok(()) } else { Err(fault(path, work, &crowded)) }
}

fn by_edge(uses: &[Use]) -> impl Iterator<Item = &[Use]> {
    uses.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1))
}

/// The faces of the smallest sheets on each crowded edge that are slivers; two sheets stay on each.
fn slivers(work: &Work, uses: &[Use], crowded: &[&[Use]]) -> Vec<bool> {
    let sheet = sheets(work.faces.len(), uses);
    let count = sheet.iter().max().map_or(0, |&s| s as usize + 1);
    let mut area = vec![0.0; count];
    for (face, &s) in work.faces.iter().zip(&sheet) {
        area[s as usize] += work.area(face);
    }
    let total: f64 = area.iter().sum();
    let mut gone = vec![false; count];
    for edge in crowded {
        let mut here: Vec<u32> = edge.iter().map(|u| sheet[u.2 as usize]).collect();
        here.sort_by(|&a, &b| area[a as usize].total_cmp(&area[b as usize]).then(a.cmp(&b)));
        let mut left = here.iter().filter(|&&s| !gone[s as usize]).count();
        for s in here {
            if left > 2 && !gone[s as usize] && area[s as usize] <= SLIVER * total {
                gone[s as usize] = true;
                left -= 1;
            }
        }
    }
    sheet.iter().map(|&s| gone[s as usize]).collect()
}

/// For each face the sheet it is in: faces joined through edges of two faces.
fn sheets(faces: usize, uses: &[Use]) -> Vec<u32> {
    let mut neighbors: Vec<Vec<u32>> = vec![Vec::new(); faces];
    for edge in by_edge(uses) {
        if let [one, two] = edge {
            neighbors[one.2 as usize].push(two.2);
            neighbors[two.2 as usize].push(one.2);
        }
    }
    let mut sheet = vec![u32::MAX; faces];
    let mut count = 0;
    for seed in 0..faces {
        if sheet[seed] != u32::MAX {
            continue;
        }
        sheet[seed] = count;
        let mut open = vec![seed as u32];
        while let Some(f) = open.pop() {
            for &g in &neighbors[f as usize] {
                if sheet[g as usize] == u32::MAX {
                    sheet[g as usize] = count;
                    open.push(g);
                }
            }
        }
        count += 1;
    }
    sheet
}

fn fault(path: &Path, work: &Work, crowded: &[&[Use]]) -> Error {
    let named: Vec<String> = crowded.iter().take(NAMED).map(|edge| named(work, edge)).collect();
    let more = crowded.len().saturating_sub(NAMED);
    let more = if more > 0 { format!("; and {more} more such edges") } else { String::new() };
    Error::Surface(format!(
        "{}: {}{more}; a surface has at most two there: remove the extra ones, or split the model",
        path.display(),
        named.join("; ")
    ))
}

fn named(work: &Work, edge: &[Use]) -> String {
    let numbers: Vec<String> = edge.iter().take(NAMED).map(|u| work.number(u.2)).collect();
    let dots = if edge.len() > NAMED { ", ..." } else { "" };
    let [from, to] = [edge[0].0, edge[0].1].map(|v| place(work.points[v as usize]));
    let count = edge.len();
    format!("{count} faces ({}{dots}) meet in the edge from {from} to {to}", numbers.join(", "))
}
