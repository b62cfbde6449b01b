//! Faces turned to the same side, and refused where they do not make a manifold.

use crate::error::{Error, Result};
use glam::DVec3;

/// The triangles of one face.
#[derive(Default)]
pub(super) struct Wing {
    pub triangles: Vec<[u32; 3]>,
}

/// One use of an edge by a triangle of a face.
struct Use {
    edge: (u32, u32),
    face: usize,
    /// The triangle runs it from the lower to the upper vertex.
    upwards: bool,
}

/// Which faces to turn over so that all of a connected piece look the same way as its first.
///
/// # Errors
/// [`Error::Surface`] where three faces meet in an edge, where the surface has only one side (a Moebius
/// band), or where it touches itself in a point.
pub(super) fn alike(wings: &[Wing], points: &[DVec3]) -> Result<Vec<bool>> {
    let mut uses: Vec<Use> = Vec::new();
    for (face, wing) in wings.iter().enumerate() {
        for t in &wing.triangles {
            for k in 0..3 {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                uses.push(Use { edge: (a.min(b), a.max(b)), face, upwards: a < b });
            }
        }
    }
    uses.sort_by_key(|u| (u.edge, u.face, u.upwards));
    // Pairs of faces that share an edge, and whether one of them must be turned.
    let mut links: Vec<Vec<(usize, bool)>> = vec![Vec::new(); wings.len()];
    let mut rims = vec![0_u8; points.len()];
    for group in uses.chunk_by(|a, b| a.edge == b.edge) {
        match group {
            [one] => {
                for v in [one.edge.0, one.edge.1] {
                    rims[v as usize] = rims[v as usize].saturating_add(1);
                }
            }
            [one, two] => {
                links[one.face].push((two.face, one.upwards == two.upwards));
                links[two.face].push((one.face, one.upwards == two.upwards));
            }
            more => {
                let at = points[more[0].edge.0 as usize];
                return Err(fault(&format!("{} triangles share an edge", more.len()), at));
            }
        }
    }
    if let Some(v) = rims.iter().position(|&n| n > 2) {
        return Err(fault("the surface touches itself in a point", points[v]));
    }
    let mut turned: Vec<Option<bool>> = vec![None; wings.len()];
    for start in 0..wings.len() {
        if turned[start].is_some() {
            continue;
        }
        turned[start] = Some(false);
        let mut open = vec![start];
        while let Some(face) = open.pop() {
            let here = turned[face] == Some(true);
            for &(other, opposed) in &links[face] {
                match turned[other] {
                    None => {
                        turned[other] = Some(here != opposed);
                        open.push(other);
                    }
                    Some(there) if there != (here != opposed) => {
                        let at = points[wings[face].triangles[0][0] as usize];
                        return Err(fault("the faces cannot be turned to the same side", at));
                    }
                    Some(_) => {}
                }
            }
        }
    }
    Ok(turned.into_iter().map(|t| t == Some(true)).collect())
}

fn fault(what: &str, at: DVec3) -> Error {
    Error::Surface(format!(
        "{what} near ({:.4}, {:.4}, {:.4}); a surface must be a manifold: remove or cut the extra face",
        at.x, at.y, at.z
    ))
}
