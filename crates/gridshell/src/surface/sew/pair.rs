//! Which pieces of naked edges run alongside each other, two by two.
//!
//! Nearest first; where three or more lie together, those two whose faces go on into each other most smoothly.

use super::PHASE;
use super::split::{Piece, Pieces};
use crate::job::Job;
use crate::surface::Brep;
use crate::surface::exact::project::Seeds;
use glam::{DVec2, DVec3};

/// Gaps below this share of the tolerance count as none when pairs are chosen.
const CLOSED: f64 = 1e-3;
/// Looks along a piece for the distance to another, at least and at most.
const LOOKS: [usize; 2] = [8, 64];
/// Pieces of one face join only where the face between them is wider than so many tolerances.
const WIDTH: f64 = 20.0;
/// More pieces than this between the same two places are not compared: there is nothing sensible to join.
const MOST_TOGETHER: usize = 64;

/// Two pieces that are one edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joint {
    /// Indices of the pieces, ascending.
    pub pieces: [u32; 2],
    /// They run in opposite directions.
    pub opposed: bool,
    /// Their largest distance, metres.
    pub gap: f64,
}

/// What is to be joined.
pub(super) struct Pairs {
    pub joints: Vec<Joint>,
    /// Faces that lie on another one.
    pub twins: Vec<u32>,
    /// Middles of pieces that would have been the third at their edge.
    pub crowded: Vec<DVec3>,
}

/// Pair the pieces.
pub(super) fn pairs(brep: &Brep, pieces: &Pieces, tolerance: f64, job: &Job) -> Pairs {
    let mut found = candidates(brep, &pieces.all, tolerance, job);
    let twins = twins(brep, &pieces.all, &found, tolerance);
    let is_twin = |i: u32| twins.binary_search(&pieces.all[i as usize].used.face).is_ok();
    found.retain(|j| !j.pieces.iter().any(|&i| is_twin(i)));
    let mut rivals = vec![0_u32; pieces.all.len()];
    for i in found.iter().flat_map(|j| j.pieces) {
        rivals[i as usize] += 1;
    }
    // How far from smooth each candidate is; only asked for where there is a choice.
    let mut order: Vec<(u8, f64, Joint)> = found
        .into_iter()
        .map(|j| {
            let [a, b] = j.pieces.map(|i| &pieces.all[i as usize]);
            let choice = j.pieces.iter().any(|&i| rivals[i as usize] > 1);
            let fold = if choice && !job.is_over(PHASE) { fold(brep, a, b) } else { 0.0 };
            let open = u8::from(j.gap > CLOSED * tolerance);
            (open, fold, j)
        })
        .collect();
    order.sort_by(|(o, f, j), (p, g, k)| {
        let by_gap = if *o == 1 && *p == 1 { j.gap.total_cmp(&k.gap) } else { o.cmp(p) };
        by_gap.then(f.total_cmp(g)).then(j.pieces.cmp(&k.pieces))
    });
    let mut taken = vec![false; pieces.all.len()];
    let mut joints: Vec<Joint> = Vec::new();
    for (_, _, j) in &order {
        if j.pieces.iter().all(|&i| !taken[i as usize]) {
            for i in j.pieces {
                taken[i as usize] = true;
            }
            joints.push(*j);
        }
    }
    joints.sort_by_key(|j| j.pieces);
    let mut crowded = Vec::new();
    for (i, piece) in pieces.all.iter().enumerate() {
        if rivals[i] > 0 && !taken[i] {
            crowded.push(piece.points[piece.points.len() / 2]);
        }
    }
    Pairs { joints, twins, crowded }
}

/// All pairs of pieces that run within `tolerance` of each other from end to end.
fn candidates(brep: &Brep, pieces: &[Piece], tolerance: f64, job: &Job) -> Vec<Joint> {
    let mut order: Vec<u32> = (0..pieces.len() as u32).collect();
    let key = |i: u32| {
        let [a, b] = pieces[i as usize].clusters;
        (a.min(b), a.max(b))
    };
    order.sort_by_key(|&i| (key(i), i));
    let mut found = Vec::new();
    for group in order.chunk_by(|&i, &j| key(i) == key(j)) {
        if group.len() > MOST_TOGETHER || job.is_over(PHASE) {
            continue;
        }
        for (n, &i) in group.iter().enumerate() {
            for &j in &group[n + 1..] {
                let [a, b] = [i, j].map(|i| &pieces[i as usize]);
                let Some((gap, opposed)) = alongside(brep, a, b, tolerance) else { continue };
                if a.used.face != b.used.face || closes(brep, a, b, opposed, tolerance) {
                    found.push(Joint { pieces: [i, j], opposed, gap });
                }
            }
        }
    }
    found
}

/// The largest distance between two pieces, and whether they run in opposite directions. None where it is more
/// than the tolerance.
fn alongside(brep: &Brep, a: &Piece, b: &Piece, tolerance: f64) -> Option<(f64, bool)> {
    if a.length().min(b.length()) <= tolerance {
        return None;
    }
    let (there, forward) = beside(brep, a, b, tolerance)?;
    let (back, _) = beside(brep, b, a, tolerance)?;
    Some((there.max(back), !forward))
}

/// The largest distance of points of `a` from `b`, and whether both run the same way.
fn beside(brep: &Brep, a: &Piece, b: &Piece, tolerance: f64) -> Option<(f64, bool)> {
    let edge = |p: &Piece| &brep.edges[p.edge as usize];
    let looks = (a.points.len() - 1).clamp(LOOKS[0], LOOKS[1]);
    let mut gap = 0.0_f64;
    let mut places = Vec::with_capacity(looks);
    for i in 0..looks {
        let share = (i as f64 + 0.5) / looks as f64;
        let p = edge(a).curve.point(a.range[0] + (a.range[1] - a.range[0]) * share);
        let nearest = (0..b.points.len()).min_by(|&i, &j| {
            b.points[i].distance_squared(p).total_cmp(&b.points[j].distance_squared(p))
        })?;
        let range = [b.t[nearest.saturating_sub(1)], b.t[(nearest + 1).min(b.t.len() - 1)]];
        let (t, foot) = edge(b).curve.project(b.t[nearest], range, p);
        gap = gap.max(foot.distance(p));
        if gap > tolerance {
            return None;
        }
        places.push(t);
    }
    // The middle half tells the direction, also of closed edges, whose ends are one place.
    Some((gap, places[3 * looks / 4] > places[looks / 4]))
}

/// Whether joining two edges of one face closes the face, rather than a slit in it, and leaves something of it.
fn closes(brep: &Brep, a: &Piece, b: &Piece, opposed: bool, tolerance: f64) -> bool {
    if a.edge == b.edge {
        return false;
    }
    let face = &brep.faces[a.used.face as usize];
    let runs_back = |p: &Piece| {
        let u = p.used;
        brep.faces[u.face as usize].loops[u.boundary as usize][u.place as usize].reversed
    };
    // Along a seam the face lies on both sides, so its loop runs there and back.
    if (runs_back(a) == runs_back(b)) != opposed {
        return false;
    }
    if face.shape.closed() != [false; 2] {
        return true;
    }
    let seeds = Seeds::new(&face.shape);
    let inner = |p: &Piece| inward(brep, p, &seeds).map(|(uv, _)| uv);
    let (Some(p), Some(q)) = (inner(a), inner(b)) else { return false };
    let jet = face.shape.jet(0.5 * (p + q));
    let d: DVec2 = q - p;
    (jet.du * d.x).length().max((jet.dv * d.y).length()) > WIDTH * tolerance
}

/// How far the faces of two pieces are from going on into each other: 0 for smooth, 2 for folded back.
fn fold(brep: &Brep, a: &Piece, b: &Piece) -> f64 {
    let of = |p: &Piece| {
        let seeds = Seeds::new(&brep.faces[p.used.face as usize].shape);
        inward(brep, p, &seeds).map(|(_, into)| into)
    };
    match (of(a), of(b)) {
        (Some(p), Some(q)) => 1.0 + p.dot(q),
        _ => 1.0,
    }
}

/// Parameters of the middle of a piece on its face, and the direction from there into the face.
fn inward(brep: &Brep, piece: &Piece, seeds: &Seeds) -> Option<(DVec2, DVec3)> {
    let used = piece.used;
    let face = &brep.faces[used.face as usize];
    let coedge = face.loops[used.boundary as usize][used.place as usize];
    let middle = 0.5 * (piece.range[0] + piece.range[1]);
    let [point, along] = brep.edges[piece.edge as usize].curve.jet(middle);
    let (uv, _) = seeds.project(&face.shape, point);
    let up = face.shape.jet(uv).normal();
    let left = up.cross(along).normalize_or_zero();
    let left = if coedge.reversed == face.reversed { left } else { -left };
    uv.is_finite().then_some((uv, left))
}

/// Faces all of whose edges run alongside the edges of an earlier face and that lie on it: copies.
fn twins(brep: &Brep, pieces: &[Piece], found: &[Joint], tolerance: f64) -> Vec<u32> {
    // How many pieces of the later face run beside pieces of the earlier one.
    let mut beside: Vec<(u32, u32, u32)> = found
        .iter()
        .flat_map(|j| {
            let [a, b] = j.pieces;
            let [f, g] = j.pieces.map(|i| pieces[i as usize].used.face);
            if f <= g { [(g, f, b), (f, g, a)] } else { [(f, g, a), (g, f, b)] }
        })
        .filter(|(face, other, _)| face != other)
        .collect();
    beside.sort_unstable();
    beside.dedup();
    let count = |face: u32, other: u32| {
        let from = beside.partition_point(|b| (b.0, b.1) < (face, other));
        beside[from..].iter().take_while(|b| (b.0, b.1) == (face, other)).count()
    };
    // Edges that are not naked have no piece: faces with such ones are no copies.
    let mut whole = vec![0_usize; brep.faces.len()];
    let mut edges = vec![0_usize; brep.faces.len()];
    let mut last = None;
    for p in pieces {
        whole[p.used.face as usize] += 1;
        if last != Some(p.edge) {
            edges[p.used.face as usize] += 1;
        }
        last = Some(p.edge);
    }
    let all_naked = |f: u32| {
        let face = &brep.faces[f as usize];
        edges[f as usize] == face.loops.iter().map(Vec::len).sum::<usize>()
    };
    let mut twins: Vec<u32> = Vec::new();
    for group in beside.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let (face, other, _) = group[0];
        let copy = other < face
            && twins.binary_search(&other).is_err()
            && all_naked(face)
            && all_naked(other)
            && group.len() == whole[face as usize]
            && count(other, face) == whole[other as usize]
            && lies_on(brep, pieces, face, other, tolerance);
        if copy && twins.last() != Some(&face) {
            twins.push(face);
        }
    }
    twins
}

/// Whether the insides of two faces with the same boundary are the same: seen from points between their edges.
fn lies_on(brep: &Brep, pieces: &[Piece], face: u32, other: u32, tolerance: f64) -> bool {
    let middles: Vec<DVec3> = pieces
        .iter()
        .filter(|p| p.used.face == face)
        .map(|p| p.points[p.points.len() / 2])
        .collect();
    let [mine, its] = [face, other].map(|f| &brep.faces[f as usize].shape);
    let [from_mine, from_its] = [Seeds::new(mine), Seeds::new(its)];
    let centre = middles.iter().sum::<DVec3>() / middles.len() as f64;
    middles.iter().all(|&m| {
        let (_, inner) = from_mine.project(mine, 0.5 * (m + centre));
        let (_, foot) = from_its.project(its, inner);
        foot.distance(inner) <= 2.0 * tolerance
    })
}
