//! Bubbles on the boundary loops.

use crate::surface::{ChainPoint, Ruler, Surface};

/// A piece of a loop between two corners (or the whole loop).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Index of the loop.
    pub chain: u32,
    /// Arc length where it starts, metres.
    pub start: f64,
    /// Its length in metres, over the scale wanted on it where lengths are to vary.
    pub length: f64,
    /// Fewest members on it, so that its loop keeps three nodes.
    pub least: usize,
}

/// All loops cut at their corners, loop by loop.
pub fn pieces(surface: &Surface) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for (c, chain) in surface.loops.iter().enumerate() {
        let chain_id = c as u32;
        let cuts: Vec<f64> = match chain.corners.len() {
            0 => vec![0.0],
            _ => chain.corners.iter().map(|&k| chain.arc[k as usize]).collect(),
        };
        let least = [3, 3, 2, 1][cuts.len().min(3)];
        let ruler = Ruler::new(surface, chain);
        for (i, &start) in cuts.iter().enumerate() {
            let from = ruler.at_arc(start);
            let to = cuts
                .get(i + 1)
                .map_or(ruler.at_arc(cuts[0]) + ruler.whole(), |&end| ruler.at_arc(end));
            pieces.push(Piece { chain: chain_id, start, length: to - from, least });
        }
    }
    pieces
}

/// Number of members on a piece at this edge length.
pub fn member_count(piece: &Piece, edge_length: f64) -> usize {
    ((piece.length / edge_length).round() as usize).max(piece.least)
}

/// Bubbles at equal distances (over the scale wanted there): `counts[i]` members on piece i. A piece without corners starts at
/// `offset` (a share of a member, 0 to 1) past its loop's first vertex.
pub fn place(
    surface: &Surface,
    pieces: &[Piece],
    counts: &[usize],
    offset: f64,
) -> Vec<ChainPoint> {
    let mut points = Vec::new();
    for (piece, &count) in pieces.iter().zip(counts) {
        let chain = &surface.loops[piece.chain as usize];
        let step = piece.length / count as f64;
        let shift = if chain.corners.is_empty() { offset * step } else { 0.0 };
        let ruler = Ruler::new(surface, chain);
        let from = ruler.at_arc(piece.start);
        points.extend((0..count).map(|k| {
            let s = match k {
                // A corner as it is, untouched by rounding.
                0 if shift == 0.0 => piece.start,
                _ => ruler.arc(from + shift + step * k as f64),
            };
            ChainPoint { chain: piece.chain, s: chain.wrap(s) }
        }));
    }
    // Ascending along each loop: a shifted or corner-started piece may wrap round the loop's first vertex.
    points.sort_by(|a, b| a.chain.cmp(&b.chain).then(a.s.total_cmp(&b.s)));
    points
}
