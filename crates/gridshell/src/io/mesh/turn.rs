//! Faces turned to the same side, piece by piece: as most of them are, but closed pieces outwards and open ones
//! upwards where they lean from the vertical.

use super::work::{Work, place};
use crate::error::{Error, Result};
use glam::DVec3;
use std::path::Path;

/// An open piece has a top side where its mean normal leans this far from the horizon (a sine).
const LEANS: f64 = 0.05;

/// Turn faces so that neighbours agree; for each face, its neighbours and whether the two disagree.
///
/// # Errors
/// [`Error::Surface`] where a piece has one side only.
pub(super) fn alike(path: &Path, work: &mut Work, neighbors: &[Vec<(u32, bool)>]) -> Result<()> {
    let mut flip: Vec<Option<bool>> = vec![None; work.faces.len()];
    let (mut pieces, mut turned) = (0_usize, 0_usize);
    for seed in 0..work.faces.len() {
        if flip[seed].is_some() {
            continue;
        }
        pieces += 1;
        let piece = flood(path, work, neighbors, seed as u32, &mut flip)?;
        let flipped = |f: u32| flip[f as usize] == Some(true);
        let minority = piece.iter().filter(|&&f| flipped(f)).count();
        let mut outside = 2 * minority > piece.len();
        turned += minority.min(piece.len() - minority);
        let closed =
            piece.iter().all(|&f| neighbors[f as usize].len() == work.faces[f as usize].len());
        if wrong_side(work, &piece, closed, |f| flipped(f) != outside) {
            outside = !outside;
        }
        for &f in &piece {
            if flipped(f) != outside {
                work.faces[f as usize].reverse();
            }
        }
    }
    work.note_count(
        turned,
        "turned",
        ["face to agree with its neighbours", "faces to agree with their neighbours"],
    );
    if pieces > 1 {
        work.notes.push(format!(
            "the mesh has {pieces} separate pieces: those that should join may be sewn (--sew TOL)"
        ));
    }
    Ok(())
}

/// The piece of the mesh that `seed` belongs to; `flip` says for each face whether it must be turned to
/// agree with the seed.
fn flood(
    path: &Path,
    work: &Work,
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
                    let corner = work.points[work.faces[g as usize][0] as usize];
                    return Err(Error::Surface(format!(
                        "{}: the surface near {} (face {}) has one side only, like a Möbius strip; cut it open",
                        path.display(),
                        place(corner),
                        work.number(g)
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
fn wrong_side(work: &Work, piece: &[u32], closed: bool, turned: impl Fn(u32) -> bool) -> bool {
    let origin = work.points[work.faces[piece[0] as usize][0] as usize];
    let (mut volume, mut normal, mut area) = (0.0, DVec3::ZERO, 0.0);
    for &f in piece {
        let face = &work.faces[f as usize];
        let sign = if turned(f) { -1.0 } else { 1.0 };
        let corner = |k: usize| work.points[face[k] as usize] - origin;
        for k in 2..face.len() {
            let n = (corner(k - 1) - corner(0)).cross(corner(k) - corner(0)) * sign;
            volume += corner(0).dot(n);
            normal += n;
            area += n.length();
        }
    }
    if closed { volume < 0.0 } else { normal.z < -LEANS * area }
}
