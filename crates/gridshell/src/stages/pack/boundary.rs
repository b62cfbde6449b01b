//! Bubbles on the boundary loops and on features.

use crate::surface::{Chain, ChainPoint, Ruler, Surface};

/// Lengths of one piece differ by less than this share from file to file: half a member more is always one more.
const ROUNDING: f64 = 1e-6;

/// A piece of a loop between two corners (or the whole loop), or a whole feature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Index of the loop, or of the feature.
    pub chain: u32,
    /// Arc length where it starts, metres.
    pub start: f64,
    /// Its length in metres, over the scale wanted on it where lengths are to vary.
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
        let length = Ruler::new(surface, chain).whole();
        Piece { chain: c as u32, start: 0.0, length, least }
    };
    surface.features.iter().enumerate().map(piece).collect()
}

/// Bubbles at equal distances (over the scale wanted there) on features, but for the fixed ones at their ends: `counts[i]` members on piece i.
pub fn place_on_features(surface: &Surface, pieces: &[Piece], counts: &[usize]) -> Vec<ChainPoint> {
    let mut points = Vec::new();
    for (piece, &count) in pieces.iter().zip(counts) {
        let chain = &surface.features[piece.chain as usize];
        let ruler = Ruler::new(surface, chain);
        let first = usize::from(!chain.is_closed());
        let step = piece.length / count as f64;
        points.extend(
            (first..count).map(|k| ChainPoint {
                chain: piece.chain,
                s: chain.wrap(ruler.arc(step * k as f64)),
            }),
        );
    }
    points
}

/// Number of members on a piece at this edge length.
pub fn member_count(piece: &Piece, edge_length: f64) -> usize {
    ((piece.length / edge_length + ROUNDING).round() as usize).max(piece.least)
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
