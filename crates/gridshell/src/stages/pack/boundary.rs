//! Bubbles on the boundary loops and on features.

use crate::surface::{Chain, ChainPoint, Surface};

/// A piece of a loop between two corners (or the whole loop), or a whole feature: from where to where, metres of
/// arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Index of the loop, or of the feature.
    pub chain: u32,
    /// Arc length where it starts.
    pub start: f64,
    /// Its length.
    pub length: f64,
    /// Fewest members on it, so that its loop keeps three nodes and no two members join the same nodes.
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
        for (i, &start) in cuts.iter().enumerate() {
            let end = cuts.get(i + 1).copied().unwrap_or(cuts[0] + chain.length());
            pieces.push(Piece { chain: chain_id, start, length: end - start, least });
        }
    }
    pieces
}

/// All features, each a piece.
pub fn feature_pieces(surface: &Surface) -> Vec<Piece> {
    let ends = |chain: &Chain| {
        let (first, last) = (chain.vertices[0], chain.vertices[chain.vertices.len() - 1]);
        (first.min(last), first.max(last))
    };
    let twins = |chain: &Chain| {
        surface.features.iter().filter(|c| !c.is_closed() && ends(c) == ends(chain)).count()
    };
    let piece = |(c, chain): (usize, &Chain)| {
        let (first, last) = ends(chain);
        let least = match (chain.is_closed() || first == last, twins(chain)) {
            (true, _) => 3,
            (false, 1) => 1,
            // Several features from one fixed node to another.
            _ => 2,
        };
        Piece { chain: c as u32, start: 0.0, length: chain.length(), least }
    };
    surface.features.iter().enumerate().map(piece).collect()
}

/// Bubbles at equal distances on features, but for the fixed ones at their ends: `counts[i]` members on piece i.
pub fn place_on_features(surface: &Surface, pieces: &[Piece], counts: &[usize]) -> Vec<ChainPoint> {
    let mut points = Vec::new();
    for (piece, &count) in pieces.iter().zip(counts) {
        let first = usize::from(!surface.features[piece.chain as usize].is_closed());
        let step = piece.length / count as f64;
        points
            .extend((first..count).map(|k| ChainPoint { chain: piece.chain, s: step * k as f64 }));
    }
    points
}

/// Number of members on a piece at this edge length.
pub fn member_count(piece: &Piece, edge_length: f64) -> usize {
    ((piece.length / edge_length).round() as usize).max(piece.least)
}

/// Bubbles at equal distances: `counts[i]` members on piece i. A piece without corners starts at
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
        points.extend((0..count).map(|k| {
            let s = chain.wrap(piece.start + shift + step * k as f64);
            ChainPoint { chain: piece.chain, s }
        }));
    }
    // Ascending along each loop: a shifted or corner-started piece may wrap round the loop's first vertex.
    points.sort_by(|a, b| a.chain.cmp(&b.chain).then(a.s.total_cmp(&b.s)));
    points
}
