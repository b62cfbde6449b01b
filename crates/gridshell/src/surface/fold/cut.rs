//! Rings cut along one line of constant u or v after the other, halving what is left each time.
//!
//! Where rings meet a line they are broken into chains that keep to one side of it. Seen along the line, each end of
//! a chain on a side begins or ends the inside there: between two places where both sides are inside the line
//! becomes an edge, run one way for either side. On each side chains and edges then close to rings again.

use super::draft::Draft;
use super::lines::{Line, Lines};
use super::ring::{self, Piece, Ring, Spot, area, holds};
use crate::surface::brep::BrepEdge;
use crate::surface::exact::nurbs::{NurbsCurve, NurbsSurface};
use crate::surface::tessellate::trim::Edges;
use crate::surface::{Curve, Shape};
use glam::{DVec2, DVec3};

/// Steps to where an edge meets a line at most.
const STEPS: usize = 80;
/// It meets it where it is nearer than this share of what counts as on the line.
const EXACT: f64 = 1e-7;

/// A part of a face: a piece of its patch between folds, and the rings in it, the first of them the outer one.
pub(super) struct Cell {
    pub shape: Shape,
    pub rings: Vec<Ring>,
}

/// What cuts one face.
pub(super) struct Cutter<'a, 'd> {
    pub patch: &'a NurbsSurface,
    pub shape: &'a Shape,
    pub edges: &'a Edges<'a>,
    pub draft: &'d mut Draft,
}

/// Where a piece lies, seen along a line in the direction of growing parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Side {
    Left,
    Right,
    Along,
}

/// Pieces from one place on a line to the next.
struct Chain {
    pieces: Vec<Piece>,
    side: Side,
    /// Places on the line where it begins and ends.
    nodes: [usize; 2],
}

/// A place on a line: its other parameter, and a vertex there.
#[derive(Clone, Copy)]
struct Node {
    along: f64,
    vertex: u32,
}

impl Line {
    /// The parameter along it.
    fn along(&self, uv: DVec2) -> f64 {
        uv[1 - self.fixed]
    }

    fn at(&self, along: f64) -> DVec2 {
        let uv = [self.value, along];
        if self.fixed == 0 { DVec2::from(uv) } else { DVec2::new(uv[1], uv[0]) }
    }

    /// How far to its left a place is; 0 on it.
    fn left(&self, uv: DVec2) -> f64 {
        let off = uv[self.fixed] - self.value;
        match off {
            _ if off.abs() <= self.near[0] => 0.0,
            // Left of growing v is lower u, left of growing u is higher v.
            _ if self.fixed == 0 => -off,
            _ => off,
        }
    }
}

impl Cutter<'_, '_> {
    /// The parts of what `rings` bound; None where they do not fit the lines.
    pub fn part(
        &mut self,
        rings: Vec<Ring>,
        all: &[Vec<Line>; 2],
        folds: &Lines,
    ) -> Option<Vec<Cell>> {
        let mut open = grouped(rings)?;
        let mut cells = Vec::new();
        while let Some(rings) = open.pop() {
            let (lo, hi) = ring::reach(&rings[..1]);
            let inside = |k: usize| {
                let from = all[k].partition_point(|l| l.value - l.near[0] <= lo[k]);
                let to = all[k].partition_point(|l| l.value + l.near[0] < hi[k]);
                &all[k][from.min(to)..to]
            };
            let lines = if inside(0).len() >= inside(1).len() { inside(0) } else { inside(1) };
            if let Some(line) = lines.get(lines.len() / 2) {
                open.extend(self.cut(rings, line)?);
            } else {
                let shape = Shape::Nurbs(folds.piece(self.patch, 0.5 * (lo + hi))?);
                cells.push(Cell { shape, rings });
            }
        }
        Some(cells)
    }

    /// What is left on both sides of a line, each with its outer ring first.
    fn cut(&mut self, rings: Vec<Ring>, line: &Line) -> Option<Vec<Vec<Ring>>> {
        let mut sides = [Vec::new(), Vec::new()];
        let mut broken = Vec::new();
        for ring in rings {
            let parted: Vec<(Piece, Side)> =
                ring.into_iter().flat_map(|piece| self.parted(piece, line)).collect();
            let on = |piece: &Piece| line.left(piece.path[0].uv) == 0.0;
            let Some(first) = parted.iter().position(|(piece, _)| on(piece)) else {
                let side = usize::from(parted[0].1 == Side::Right);
                sides[side].push(parted.into_iter().map(|p| p.0).collect());
                continue;
            };
            let mut parted = parted;
            parted.rotate_left(first);
            for (piece, side) in parted {
                if on(&piece) {
                    broken.push((Vec::new(), side));
                }
                let chain: &mut (Vec<Piece>, Side) = broken.last_mut()?;
                // Off the line a chain cannot change sides.
                if chain.1 != side {
                    return None;
                }
                chain.0.push(piece);
            }
        }
        let (mut chains, nodes) = placed(broken, line);
        self.bridge(&mut chains, &nodes, line)?;
        for (side, done) in [Side::Left, Side::Right].into_iter().zip(&mut sides) {
            done.extend(closed(&chains, side, nodes.len())?);
        }
        let [left, right] = sides;
        let mut all = grouped(left)?;
        all.extend(grouped(right)?);
        Some(all)
    }

    /// A piece parted where it crosses a line, and where each part lies.
    fn parted(&mut self, mut piece: Piece, line: &Line) -> Vec<(Piece, Side)> {
        let off: Vec<f64> = piece.path.iter().map(|s| line.left(s.uv)).collect();
        let last = off.len() - 1;
        for end in [0, last] {
            if off[end] == 0.0 {
                piece.path[end].uv[line.fixed] = line.value;
            }
        }
        let mut parts = Vec::new();
        let (mut before, mut from) = (None::<usize>, 0);
        for i in (0..=last).filter(|&i| off[i] != 0.0) {
            let crossed = before.filter(|&b| off[b] * off[i] < 0.0);
            if let Some(b) = crossed {
                let (spot, vertex, [to, next]) = self.crossing(&piece, [b, i], line);
                let mut path: Vec<Spot> = piece.path[from..to].to_vec();
                if let Some(first) =
                    parts.last().map(|p: &(Piece, Side)| p.0.path[p.0.path.len() - 1])
                {
                    path.insert(0, first);
                }
                path.push(spot);
                let ends = [piece.ends[0], vertex];
                let side = if off[b] > 0.0 { Side::Left } else { Side::Right };
                parts.push((Piece { edge: piece.edge, ends, path }, side));
                piece.ends[0] = vertex;
                from = next;
            }
            before = Some(i);
        }
        let side = match before {
            None => Side::Along,
            Some(b) if off[b] > 0.0 => Side::Left,
            Some(_) => Side::Right,
        };
        let mut path: Vec<Spot> = piece.path.split_off(from);
        if let Some(first) = parts.last().map(|p| p.0.path[p.0.path.len() - 1]) {
            path.insert(0, first);
        }
        if side == Side::Along {
            for spot in &mut path {
                spot.uv[line.fixed] = line.value;
            }
        }
        parts.push((Piece { path, ..piece }, side));
        parts
    }

    /// Where a piece crosses a line between two places on either side of it; the vertex there, and how many of its
    /// places come before, and up to where they count as on the line.
    fn crossing(
        &mut self,
        piece: &Piece,
        [b, i]: [usize; 2],
        line: &Line,
    ) -> (Spot, u32, [usize; 2]) {
        let path = &piece.path;
        // A place on the line is where the edge has a kink, as like as not.
        let (spot, next) = if i > b + 1 {
            let middle = b + (i - b) / 2;
            (path[middle], [middle, middle + 1])
        } else {
            (self.root(piece, path[b], path[i], line), [i, i])
        };
        let at = |t: f64, uv: DVec2| Spot { t, uv: line.at(line.along(uv)) };
        let Some(edge) = piece.edge else { return (at(spot.t, spot.uv), piece.ends[0], next) };
        let (t, vertex) = self.draft.split(edge, spot.t);
        (at(t, spot.uv), vertex, next)
    }

    /// Where an edge meets a line between two of its places.
    fn root(&self, piece: &Piece, a: Spot, b: Spot, line: &Line) -> Spot {
        let off = |s: &Spot| s.uv[line.fixed] - line.value;
        let share = off(&a) / (off(&a) - off(&b));
        let between = |a: &Spot, b: &Spot, share: f64| Spot {
            t: a.t + (b.t - a.t) * share,
            uv: a.uv.lerp(b.uv, share),
        };
        let straight = between(&a, &b, share);
        let Some(edge) = piece.edge else { return straight };
        let Some(curve) = self.edges.curves.get(edge as usize) else {
            // An edge along another line, whose parameter is that along it.
            let t = line.value;
            return Spot { t, uv: line.at(line.along(straight.uv)) };
        };
        // Where a straight line would meet it, for most edges the place, and the middle, in turns.
        let (mut low, mut high, mut best) = (a, b, straight);
        for k in 0..STEPS {
            let share = if k % 2 == 0 { off(&low) / (off(&low) - off(&high)) } else { 0.5 };
            let guess = between(&low, &high, share);
            // From beyond a fold the way may end in it: from either side, too.
            let target = curve.point(guess.t);
            let feet = [guess.uv, low.uv, high.uv].map(|uv| self.shape.project(uv, target));
            let far = |foot: &DVec3| foot.distance_squared(target);
            let near = feet.into_iter().min_by(|f, g| far(&f.1).total_cmp(&far(&g.1)));
            best = Spot { t: guess.t, uv: near.map_or(guess.uv, |foot| foot.0) };
            let d = off(&best);
            if d.abs() <= EXACT * line.near[0] {
                break;
            }
            if (d < 0.0) == (off(&low) < 0.0) { low = best } else { high = best }
        }
        best
    }

    /// Add edges along the line where both sides of it are inside.
    fn bridge(&mut self, chains: &mut Vec<Chain>, nodes: &[Node], line: &Line) -> Option<()> {
        let mut ends = vec![[0_usize; 2]; nodes.len()];
        let mut along = vec![0_usize; nodes.len()];
        for chain in chains.iter() {
            let [a, b] = chain.nodes;
            if chain.side == Side::Along {
                // Past another place where rings touch the line.
                if a.abs_diff(b) != 1 {
                    return None;
                }
                along[a.min(b)] += 1;
                continue;
            }
            let side = usize::from(chain.side == Side::Right);
            ends[a][side] += 1;
            ends[b][side] += 1;
        }
        let mut inside = [false; 2];
        let mut curve = None;
        for i in 0..nodes.len() {
            for side in 0..2 {
                inside[side] ^= ends[i][side] % 2 == 1;
            }
            let last = i + 1 == nodes.len();
            match (inside, along[i]) {
                ([true, true], 0) if !last => {
                    let whole = curve.get_or_insert_with(|| self.patch.iso(line.fixed, line.value));
                    let pair = [nodes[i], nodes[i + 1]];
                    chains.extend(self.edge(whole.clone()?, pair, i, line));
                }
                ([true, true], 2) | ([false, false], 0 | 2) => {}
                ([true, false] | [false, true], 1) if !last => {}
                _ => return None,
            }
        }
        (inside == [false; 2]).then_some(())
    }

    /// A new edge between two places, as a chain for either side.
    fn edge(&mut self, curve: NurbsCurve, [a, b]: [Node; 2], i: usize, line: &Line) -> [Chain; 2] {
        let ends = [a.vertex, b.vertex];
        let range = [a.along, b.along];
        let curve = curve.part(range).unwrap_or(curve);
        let edge = self.draft.add(BrepEdge { curve: Curve::Nurbs(curve), range, ends });
        let up = range.map(|t| Spot { t, uv: line.at(t) });
        let chain = |path: [Spot; 2], ends: [u32; 2], nodes: [usize; 2], side: Side| Chain {
            pieces: vec![Piece { edge: Some(edge), ends, path: path.to_vec() }],
            side,
            nodes,
        };
        [
            chain(up, ends, [i, i + 1], Side::Left),
            chain([up[1], up[0]], [ends[1], ends[0]], [i + 1, i], Side::Right),
        ]
    }
}

/// Chains with the places on the line where they begin and end, in order along it.
fn placed(broken: Vec<(Vec<Piece>, Side)>, line: &Line) -> (Vec<Chain>, Vec<Node>) {
    let ends = |pieces: &[Piece]| {
        let (first, last) = (&pieces[0], &pieces[pieces.len() - 1]);
        let start = (line.along(first.path[0].uv), first.ends[0]);
        [start, (line.along(last.path[last.path.len() - 1].uv), last.ends[1])]
    };
    let mut order: Vec<(f64, u32, usize)> = Vec::with_capacity(2 * broken.len());
    for (c, (pieces, _)) in broken.iter().enumerate() {
        for (e, (along, vertex)) in ends(pieces).into_iter().enumerate() {
            order.push((along, vertex, 2 * c + e));
        }
    }
    order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
    let mut nodes: Vec<Node> = Vec::new();
    let mut of_end = vec![0; order.len()];
    for (along, vertex, end) in order {
        if nodes.last().is_none_or(|n| along - n.along > line.near[1]) {
            nodes.push(Node { along, vertex });
        }
        of_end[end] = nodes.len() - 1;
    }
    let chain = |(c, (pieces, side)): (usize, (Vec<Piece>, Side))| Chain {
        pieces,
        side,
        nodes: [of_end[2 * c], of_end[2 * c + 1]],
    };
    (broken.into_iter().enumerate().map(chain).collect(), nodes)
}

/// The rings that the chains on a side close to; None where one does not close.
fn closed(chains: &[Chain], side: Side, nodes: usize) -> Option<Vec<Ring>> {
    // What runs along the line has the inside to its left.
    let ours = |c: &Chain| match c.side {
        Side::Along => (c.nodes[1] > c.nodes[0]) == (side == Side::Left),
        other => other == side,
    };
    let mut leaving: Vec<Vec<usize>> = vec![Vec::new(); nodes];
    for (i, chain) in chains.iter().enumerate().filter(|c| ours(c.1)) {
        leaving[chain.nodes[0]].push(i);
    }
    let mut met = vec![false; chains.len()];
    let mut rings = Vec::new();
    for start in (0..chains.len()).filter(|&i| ours(&chains[i])) {
        if met[start] {
            continue;
        }
        let (mut ring, mut here) = (Vec::new(), start);
        loop {
            met[here] = true;
            ring.extend(chains[here].pieces.iter().cloned());
            here = leftmost(chains, here, &leaving[chains[here].nodes[1]])?;
            if here == start {
                break;
            }
            if met[here] {
                return None;
            }
        }
        rings.push(ring);
    }
    Some(rings)
}

/// The chain that turns farthest to the left from the end of `from`.
fn leftmost(chains: &[Chain], from: usize, leaving: &[usize]) -> Option<usize> {
    if let [only] = leaving {
        return Some(*only);
    }
    let path = |c: usize, last: bool| {
        let pieces = &chains[c].pieces;
        &pieces[if last { pieces.len() - 1 } else { 0 }].path
    };
    let arriving = path(from, true);
    let back = arriving[arriving.len() - 2].uv - arriving[arriving.len() - 1].uv;
    // Clockwise from where it came, as a number that grows with the angle.
    let turned = |&c: &usize| {
        let way = path(c, false)[1].uv - path(c, false)[0].uv;
        let (sine, cosine) = (-back.perp_dot(way), back.dot(way));
        let share = cosine / (sine.abs() + cosine.abs()).max(f64::MIN_POSITIVE);
        match sine {
            s if s > 0.0 => 1.0 - share,
            s if s < 0.0 => 3.0 + share,
            _ if cosine < 0.0 => 2.0,
            _ => 4.0,
        }
    };
    leaving.iter().copied().min_by(|a, b| turned(a).total_cmp(&turned(b)))
}

/// Outer rings, each first and with the holes in it.
fn grouped(rings: Vec<Ring>) -> Option<Vec<Vec<Ring>>> {
    let (outer, holes): (Vec<Ring>, Vec<Ring>) = rings.into_iter().partition(|r| area(r) > 0.0);
    let mut groups: Vec<Vec<Ring>> = outer.into_iter().map(|r| vec![r]).collect();
    if groups.len() == 1 {
        groups[0].extend(holes);
        return Some(groups);
    }
    let sizes: Vec<f64> = groups.iter().map(|g| area(&g[0])).collect();
    for hole in holes {
        let place = hole[0].path[0].uv.midpoint(hole[0].path[1].uv);
        let around = (0..groups.len()).filter(|&g| holds(&groups[g][0], place));
        let least = around.min_by(|&a, &b| sizes[a].total_cmp(&sizes[b]))?;
        groups[least].push(hole);
    }
    Some(groups)
}
