//! The door every mesh comes through: from a soup of faces to an oriented manifold.
//!
//! In turn: merge vertices at the same place, drop degenerate and repeated faces, refuse edges with more
//! than two faces, turn neighbours to agree, choose the outside, part pieces that touch in one vertex, and
//! drop unused vertices. What was done is told in the notes.

use crate::error::{Error, Result};
use crate::surface::PolygonMesh;
use glam::DVec3;
use std::collections::{HashMap, HashSet};
use std::path::Path;

/// Vertices closer than this share of the model's box are the same.
const SAME: f64 = 1e-9;
/// An open piece has a top side where its mean normal leans this far from the horizon (a sine).
const LEANS: f64 = 0.05;
/// A face's corner, given by face and place, with the direction of its edge.
type Use = (u32, u32, u32, bool);

/// The mesh as a manifold, its faces oriented alike.
///
/// # Errors
/// [`Error::Surface`] where there is no face, an edge has more than two, or the surface has one side only.
pub(super) fn weld(path: &Path, mut mesh: PolygonMesh) -> Result<PolygonMesh> {
    mesh.notes.push("the file states no unit: metres are assumed".into());
    merge_vertices(&mut mesh);
    drop_degenerate(&mut mesh);
    if mesh.faces.is_empty() {
        return Err(Error::Surface(format!("{}: the file holds no faces", path.display())));
    }
    let neighbors = neighbors(path, &mesh)?;
    orient(path, &mut mesh, &neighbors)?;
    part_at_vertices(&mut mesh);
    drop_unused(&mut mesh);
    Ok(mesh)
}

/// Lowest and highest coordinates; zero when there are no points.
pub(super) fn bounds(points: &[DVec3]) -> (DVec3, DVec3) {
    let Some(&first) = points.first() else { return (DVec3::ZERO, DVec3::ZERO) };
    points.iter().fold((first, first), |(low, high), &p| (low.min(p), high.max(p)))
}

/// Replace every vertex by the first one at its place.
fn merge_vertices(mesh: &mut PolygonMesh) {
    let (low, high) = bounds(&mesh.points);
    let tolerance = SAME * (high - low).length();
    // Cells are much wider than the tolerance, so that most points touch one cell only.
    let cell = 64.0 * tolerance.max(f64::MIN_POSITIVE);
    let key = |p: DVec3| ((p - low) / cell).floor().to_array().map(|c| c as i64);
    let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    let mut keep: Vec<u32> = Vec::with_capacity(mesh.points.len());
    for (i, &p) in mesh.points.iter().enumerate() {
        let [from, to] = [key(p - tolerance), key(p + tolerance)];
        let mut same = None;
        for x in from[0]..=to[0] {
            for y in from[1]..=to[1] {
                for z in from[2]..=to[2] {
                    let near = cells.get(&[x, y, z]).into_iter().flatten().copied();
                    same = near
                        .filter(|&j| mesh.points[j as usize].distance(p) <= tolerance)
                        .chain(same)
                        .min();
                }
            }
        }
        if same.is_none() {
            cells.entry(key(p)).or_default().push(i as u32);
        }
        keep.push(same.unwrap_or(i as u32));
    }
    let merged = keep.iter().enumerate().filter(|&(i, &k)| k != i as u32).count();
    if merged > 0 {
        mesh.notes.push(format!("merged {merged} duplicate vertices"));
    }
    for v in mesh.faces.iter_mut().flatten() {
        *v = keep[*v as usize];
    }
}

/// Drop corners that repeat the one before, faces with fewer than three corners or a corner twice, and
/// faces over the same corners as an earlier one.
fn drop_degenerate(mesh: &mut PolygonMesh) {
    let before = mesh.faces.len();
    mesh.faces.retain_mut(|face| {
        face.dedup();
        while face.len() > 1 && face.first() == face.last() {
            face.pop();
        }
        let mut sorted = face.clone();
        sorted.sort_unstable();
        sorted.dedup();
        sorted.len() == face.len() && face.len() >= 3
    });
    note_count(mesh, before - mesh.faces.len(), "dropped", "degenerate faces");
    let before = mesh.faces.len();
    let mut seen: HashSet<Vec<u32>> = HashSet::new();
    mesh.faces.retain(|face| {
        let mut sorted = face.clone();
        sorted.sort_unstable();
        seen.insert(sorted)
    });
    note_count(mesh, before - mesh.faces.len(), "dropped", "repeated faces");
}

fn note_count(mesh: &mut PolygonMesh, count: usize, verb: &str, what: &str) {
    if count > 0 {
        mesh.notes.push(format!("{verb} {count} {what}"));
    }
}

/// For each face, its neighbours, and whether the two run along their common edge the same way: then they
/// disagree on the outside.
fn neighbors(path: &Path, mesh: &PolygonMesh) -> Result<Vec<Vec<(u32, bool)>>> {
    let mut uses: Vec<Use> = Vec::new();
    for (f, face) in mesh.faces.iter().enumerate() {
        for k in 0..face.len() {
            let (a, b) = (face[k], face[(k + 1) % face.len()]);
            uses.push((a.min(b), a.max(b), f as u32, a < b));
        }
    }
    uses.sort_unstable();
    let mut neighbors = vec![Vec::new(); mesh.faces.len()];
    for edge in uses.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        match *edge {
            [(_, _, f, up), (_, _, g, other_up)] => {
                neighbors[f as usize].push((g, up == other_up));
                neighbors[g as usize].push((f, up == other_up));
            }
            [(a, b, ..), _, _, ..] => {
                return Err(Error::Surface(format!(
                    "{}: {} faces meet in the edge from {} to {}; a surface has at most two there: remove the \
                     extra ones, or split the model",
                    path.display(),
                    edge.len(),
                    place(mesh.points[a as usize]),
                    place(mesh.points[b as usize]),
                )));
            }
            _ => {}
        }
    }
    Ok(neighbors)
}

fn place(p: DVec3) -> String {
    format!("({}, {}, {})", p.x, p.y, p.z)
}

/// Turn faces so that neighbours agree, piece by piece.
fn orient(path: &Path, mesh: &mut PolygonMesh, neighbors: &[Vec<(u32, bool)>]) -> Result<()> {
    let mut flip: Vec<Option<bool>> = vec![None; mesh.faces.len()];
    let (mut pieces, mut turned) = (0_usize, 0_usize);
    for seed in 0..mesh.faces.len() {
        if flip[seed].is_some() {
            continue;
        }
        pieces += 1;
        let piece = flood(path, mesh, neighbors, seed as u32, &mut flip)?;
        let flipped = |f: u32| flip[f as usize] == Some(true);
        let minority = piece.iter().filter(|&&f| flipped(f)).count();
        let mut outside = 2 * minority > piece.len();
        turned += minority.min(piece.len() - minority);
        let closed =
            piece.iter().all(|&f| neighbors[f as usize].len() == mesh.faces[f as usize].len());
        if wrong_side(mesh, &piece, closed, |f| flipped(f) != outside) {
            outside = !outside;
        }
        for &f in &piece {
            if flipped(f) != outside {
                mesh.faces[f as usize].reverse();
            }
        }
    }
    note_count(mesh, turned, "turned", "faces to agree with their neighbours");
    if pieces > 1 {
        mesh.notes.push(format!("the mesh has {pieces} separate pieces"));
    }
    Ok(())
}

/// The piece of the mesh that `seed` belongs to; `flip` says for each face whether it must be turned to
/// agree with the seed.
fn flood(
    path: &Path,
    mesh: &PolygonMesh,
    neighbors: &[Vec<(u32, bool)>],
    seed: u32,
    flip: &mut [Option<bool>],
) -> Result<Vec<u32>> {
    flip[seed as usize] = Some(false);
    let mut piece = vec![seed];
    let mut next = 0;
    while let Some(&f) = piece.get(next) {
        next += 1;
        let turned = flip[f as usize] == Some(true);
        for &(g, disagree) in &neighbors[f as usize] {
            match flip[g as usize] {
                None => {
                    flip[g as usize] = Some(turned != disagree);
                    piece.push(g);
                }
                Some(known) if known != (turned != disagree) => {
                    let corner = mesh.points[mesh.faces[g as usize][0] as usize];
                    return Err(Error::Surface(format!(
                        "{}: the surface near {} has one side only, like a Möbius strip; cut it open",
                        path.display(),
                        place(corner)
                    )));
                }
                Some(_) => {}
            }
        }
    }
    Ok(piece)
}

/// Whether a piece, oriented as it stands but for the faces `turned`, has its outside inside (where it is
/// closed) or below (where it is open and leans from the vertical).
fn wrong_side(
    mesh: &PolygonMesh,
    piece: &[u32],
    closed: bool,
    turned: impl Fn(u32) -> bool,
) -> bool {
    let origin = mesh.points[mesh.faces[piece[0] as usize][0] as usize];
    let (mut volume, mut normal, mut area) = (0.0, DVec3::ZERO, 0.0);
    for &f in piece {
        let face = &mesh.faces[f as usize];
        let sign = if turned(f) { -1.0 } else { 1.0 };
        let corner = |k: usize| mesh.points[face[k] as usize] - origin;
        for k in 2..face.len() {
            let n = (corner(k - 1) - corner(0)).cross(corner(k) - corner(0)) * sign;
            volume += corner(0).dot(n);
            normal += n;
            area += n.length();
        }
    }
    if closed { volume < 0.0 } else { normal.z < -LEANS * area }
}

/// Give each fan of faces round a vertex its own vertex, so that no two touch in a vertex alone.
fn part_at_vertices(mesh: &mut PolygonMesh) {
    // The steps round each vertex: in this face, from this next corner to that previous one.
    let mut steps: Vec<Vec<(u32, u32, u32)>> = vec![Vec::new(); mesh.points.len()];
    for (f, face) in mesh.faces.iter().enumerate() {
        let n = face.len();
        for k in 0..n {
            steps[face[k] as usize].push((f as u32, face[(k + 1) % n], face[(k + n - 1) % n]));
        }
    }
    let mut parted = 0;
    for (v, steps) in steps.into_iter().enumerate() {
        for fan in fans(steps).into_iter().skip(1) {
            let twin = mesh.points.len() as u32;
            mesh.points.push(mesh.points[v]);
            for f in fan {
                for c in mesh.faces[f as usize].iter_mut().filter(|c| **c == v as u32) {
                    *c = twin;
                }
            }
            parted += 1;
        }
    }
    note_count(mesh, parted, "parted", "places where the surface touched itself in one vertex");
}

/// The faces round a vertex in fans whose faces share edges.
fn fans(mut left: Vec<(u32, u32, u32)>) -> Vec<Vec<u32>> {
    let mut fans = Vec::new();
    while !left.is_empty() {
        let first = left.remove(0);
        let mut fan = vec![first];
        let mut next = 0;
        while let Some(&(_, a, b)) = fan.get(next) {
            next += 1;
            while let Some(i) = left.iter().position(|s| s.1 == b || s.2 == a) {
                fan.push(left.remove(i));
            }
        }
        fans.push(fan.into_iter().map(|s| s.0).collect());
    }
    fans
}

/// Keep the vertices that faces use, in their order.
fn drop_unused(mesh: &mut PolygonMesh) {
    let mut used = vec![false; mesh.points.len()];
    for &v in mesh.faces.iter().flatten() {
        used[v as usize] = true;
    }
    let mut new = vec![0; mesh.points.len()];
    let mut kept = Vec::new();
    for v in (0..mesh.points.len()).filter(|&v| used[v]) {
        new[v] = kept.len() as u32;
        kept.push(mesh.points[v]);
    }
    mesh.points = kept;
    for v in mesh.faces.iter_mut().flatten() {
        *v = new[*v as usize];
    }
}
