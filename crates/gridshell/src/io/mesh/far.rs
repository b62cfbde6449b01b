//! Small pieces far from everything else: leftovers of the drawing, not of the surface.

use super::work::{Work, bounds, place};
use crate::surface::Loss;
use crate::words;
use glam::DVec3;

/// A piece is small below this share of the largest one's area.
const SMALL: f64 = 0.01;
/// And far beyond this many of its diagonals.
const FAR: f64 = 1.0;

/// Faces that hang together through their vertices.
struct Piece {
    faces: Vec<u32>,
    low: DVec3,
    high: DVec3,
    area: f64,
}

/// Drop the small pieces that lie farther from the largest one than it is long.
pub(super) fn drop_far(work: &mut Work) {
    let pieces = pieces(work);
    let Some(main) = pieces.iter().reduce(|a, b| if b.area > a.area { b } else { a }) else {
        return;
    };
    let reach = FAR * (main.high - main.low).length();
    let mut gone = vec![false; work.faces.len()];
    let mut told = Vec::new();
    for piece in &pieces {
        let gap = (main.low - piece.high).max(piece.low - main.high).max(DVec3::ZERO).length();
        if piece.area >= SMALL * main.area || gap <= reach {
            continue;
        }
        for &f in &piece.faces {
            gone[f as usize] = true;
        }
        told.push(format!("{} faces near {}", piece.faces.len(), place(piece.low)));
    }
    let Some(first) = told.first() else { return };
    let more =
        if told.len() > 1 { format!(", and {} more", told.len() - 1) } else { String::new() };
    let (faces, area) = gone
        .iter()
        .zip(&work.faces)
        .filter(|(g, _)| **g)
        .fold((0, 0.0), |(n, area), (_, face)| (n + 1, area + work.area(face)));
    work.losses.push(Loss {
        what: words::counted(told.len(), "small piece"),
        why: format!(
            "far from the rest, so taken for leftovers of the drawing: {first}{more}; export them to a file of their own \
             if they are meant"
        ),
        faces,
        area: Some(area),
        whole: false,
    });
    work.drop_faces(&gone);
}

fn pieces(work: &Work) -> Vec<Piece> {
    // Faces are joined through their vertices, each of which points on to the lowest one of its piece.
    let mut root: Vec<u32> = (0..work.points.len() as u32).collect();
    for face in &work.faces {
        for &v in &face[1..] {
            let (a, b) = (find(&mut root, face[0]), find(&mut root, v));
            root[a.max(b) as usize] = a.min(b);
        }
    }
    let mut number = vec![u32::MAX; work.points.len()];
    let mut pieces: Vec<Piece> = Vec::new();
    for (face, f) in work.faces.iter().zip(0..) {
        let r = find(&mut root, face[0]) as usize;
        if number[r] == u32::MAX {
            number[r] = pieces.len() as u32;
            let (low, high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            pieces.push(Piece { faces: Vec::new(), low, high, area: 0.0 });
        }
        let piece = &mut pieces[number[r] as usize];
        let (low, high) = bounds(face.iter().map(|&v| work.points[v as usize]));
        piece.faces.push(f);
        piece.area += work.area(face);
        (piece.low, piece.high) = (piece.low.min(low), piece.high.max(high));
    }
    pieces
}

fn find(root: &mut [u32], mut v: u32) -> u32 {
    while root[v as usize] != v {
        // Shorten the way for the next one.
        root[v as usize] = root[root[v as usize] as usize];
        v = root[v as usize];
    }
    v
}
