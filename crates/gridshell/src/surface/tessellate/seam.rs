//! Faces given the edges that their files leave out: sides of an untrimmed patch, and seams of a patch that
//! closes on itself.
//!
//! A face without loops covers its whole patch: it is bounded by the patch's four sides, where sides that
//! coincide are one seam edge used twice, and sides that are poles have no edge. A loop that runs once round
//! a closed patch bounds nothing by itself: a seam leads from it to its partner on the other side, or to the
//! pole there.

use super::edges::{fault, sample_edges};
use super::poles;
use super::trim::{Edges, Node, Traced, Tracer};
use crate::error::Result;
use crate::job::Job;
use crate::surface::brep::{BrepEdge, Coedge};
use crate::surface::exact::shape::Pole;
use crate::surface::{Brep, Curve, PREPARING, Sampling, Shape};
use glam::DVec2;
use std::sync::Arc;

/// `brep` with every face bounded by loops that close in (u, v).
///
/// # Errors
/// [`Error::Surface`](crate::Error::Surface) naming the face that has neither loops nor an end.
pub(super) fn complete(brep: &Brep, sampling: &Sampling, job: &Job) -> Result<Brep> {
    let mut brep = brep.clone();
    poles::part(&mut brep);
    // Most faces without loops have been bounded by sewing.
    for i in 0..brep.faces.len() {
        if brep.faces[i].loops.is_empty() {
            bound(&mut brep, i)?;
        }
    }
    let closed: Vec<usize> =
        (0..brep.faces.len()).filter(|&i| brep.faces[i].shape.closed() != [false; 2]).collect();
    if closed.is_empty() {
        return Ok(brep);
    }
    let (points, polylines) = sample_edges(&brep, sampling, job)?;
    let curves: Vec<Curve> = brep.edges.iter().map(|e| e.curve.clone()).collect();
    let origin = brep.origin;
    let edges = Edges { curves: &curves, polylines: &polylines, points: &points, origin };
    for i in closed {
        job.check(PREPARING)?;
        close(&mut brep, i, &edges, sampling, job)?;
    }
    Ok(brep)
}

/// Give face `i`, whose patch closes, the seams that its loops leave out. `edges` are those of `brep`; ones that were
/// added since may be missing.
///
/// # Errors
/// [`Error::Surface`](crate::Error::Surface) naming the face where its loops bound nothing.
pub(in crate::surface) fn close(
    brep: &mut Brep,
    i: usize,
    edges: &Edges,
    sampling: &Sampling,
    job: &Job,
) -> Result<()> {
    // What was broken off tells nothing of the face.
    let fault = |brep: &Brep, i: usize, what: &str| {
        job.check(PREPARING).err().unwrap_or_else(|| fault(brep, i, what))
    };
    let shape = brep.faces[i].shape.clone();
    let tracer = Tracer::new(&shape, edges, sampling, job);
    let traced = |reversed: bool, brep: &Brep| -> std::result::Result<Vec<Traced>, String> {
        brep.faces[i].loops.iter().map(|l| tracer.trace(l, reversed)).collect()
    };
    let mut reversed = brep.faces[i].reversed;
    let mut all = traced(reversed, brep).map_err(|what| fault(brep, i, &what))?;
    if let Some(loops) = without_seams(brep, i, &all) {
        brep.faces[i].loops = loops;
        all = traced(reversed, brep).map_err(|what| fault(brep, i, &what))?;
        if only_holes(&shape, &all, tracer.poles(), 1.0) {
            reversed = !reversed;
            brep.faces[i].reversed = reversed;
            all = traced(reversed, brep).map_err(|what| fault(brep, i, &what))?;
        }
    }
    if only_holes(&shape, &all, tracer.poles(), -1.0) {
        let from = clear_of(&shape, &all).map_err(|what| fault(brep, i, &what))?;
        bound_from(brep, i, from)?;
        return Ok(());
    }
    let Err(what) = cut(brep, i, &all, tracer.poles()) else { return Ok(()) };
    // What bounds nothing to its left may do so to its right: the file has the face the wrong way round.
    brep.faces[i].reversed = !reversed;
    traced(!reversed, brep)
        .and_then(|all| cut(brep, i, &all, tracer.poles()))
        .map_err(|_| fault(brep, i, &what))?;
    Ok(())
}

/// A loop with a seam goes once round its closed patch, and no farther than this.
const ONCE: f64 = 1.0 + 1e-6;

/// Bound every face that has no loops and can be bounded; the others are refused later, by name.
pub(in crate::surface) fn bound_all(brep: &mut Brep) {
    for i in 0..brep.faces.len() {
        if brep.faces[i].loops.is_empty() {
            let _ = bound(brep, i);
        }
    }
}

/// Whether the loops are holes in a patch that has no sides but seams and poles, such as a sphere; run clockwise
/// (`way` -1) as holes should, or counter-clockwise (1).
fn only_holes(shape: &Shape, traced: &[Traced], poles: &[Pole], way: f64) -> bool {
    let closed = shape.closed();
    let sides = |k: usize| poles.iter().filter(|p| p.fixed == k).count();
    let endless = (0..2).all(|k| closed[k] || sides(k) == 2);
    let largest = traced.iter().map(Traced::area).max_by(|a, b| a.abs().total_cmp(&b.abs()));
    endless
        && traced.iter().all(|t| t.winding == DVec2::ZERO)
        && largest.is_some_and(|area| area * way > 0.0)
}

/// The loops of face `i` without edges that it uses twice, where a loop with such edges goes farther round than once:
/// several seams meet in one place there, and the file took the wrong one. None where all is well.
fn without_seams(brep: &Brep, i: usize, traced: &[Traced]) -> Option<Vec<Vec<Coedge>>> {
    let face = &brep.faces[i];
    let period = face.shape.period();
    let wide = |t: &Traced| {
        (0..2).filter(|&k| period[k] > 0.0).any(|k| {
            let all = || t.nodes.iter().map(|n| n.uv[k]);
            let width = all().fold(f64::MIN, f64::max) - all().fold(f64::MAX, f64::min);
            t.winding == DVec2::ZERO && width > period[k] * ONCE
        })
    };
    let all = || face.loops.iter().flatten();
    let once = |c: &&Coedge| all().filter(|d| d.edge == c.edge).count() == 1;
    if !traced.iter().any(wide) || all().all(|c| once(&c)) {
        return None;
    }
    let mut rest: Vec<Coedge> = all().filter(once).copied().collect();
    let end =
        |c: &Coedge, last: bool| brep.edges[c.edge as usize].ends[usize::from(last != c.reversed)];
    let mut loops = Vec::new();
    while let Some(first) = rest.pop() {
        let mut coedges = vec![first];
        while end(&coedges[coedges.len() - 1], true) != end(&first, false) {
            let at = end(&coedges[coedges.len() - 1], true);
            let next = rest.iter().position(|c| end(c, false) == at)?;
            coedges.push(rest.remove(next));
        }
        loops.push(coedges);
    }
    Some(loops).filter(|l| !l.is_empty())
}

/// Parameters through which seams meet no loop.
fn clear_of(shape: &Shape, traced: &[Traced]) -> std::result::Result<DVec2, String> {
    const TRIED: usize = 256;
    let (domain, period) = (shape.domain(), shape.period());
    let mut from = DVec2::new(domain[0][0], domain[1][0]);
    for k in (0..2).filter(|&k| period[k] > 0.0) {
        let spans: Vec<[f64; 2]> = traced
            .iter()
            .map(|t| {
                let all = || t.nodes.iter().map(|n| n.uv[k]);
                [all().fold(f64::MAX, f64::min), all().fold(f64::MIN, f64::max)]
            })
            .collect();
        // Distance to the nearest loop, negative within one.
        let room = |place: f64| {
            let to = |[lo, hi]: &[f64; 2]| {
                let turns = ((0.5 * (lo + hi) - place) / period[k]).round();
                let place = place + turns * period[k];
                (lo - place).max(place - hi)
            };
            spans.iter().map(to).fold(f64::MAX, f64::min)
        };
        let place = |i: usize| domain[k][0] + period[k] * i as f64 / TRIED as f64;
        let best = (0..TRIED).map(place).max_by(|&a, &b| room(a).total_cmp(&room(b)));
        from[k] = best.filter(|&place| room(place) > 0.0).ok_or(
            "its holes leave no room for a seam: split the closed surface in two before exporting",
        )?;
    }
    Ok(from)
}

/// Bound face `i`, whose loops are at most holes, by the sides of its patch.
///
/// # Errors
/// [`Error::Surface`](crate::Error::Surface) where the patch has no end, or no side that is a curve.
pub(crate) fn bound(brep: &mut Brep, i: usize) -> Result<()> {
    let [[u, _], [v, _]] = brep.faces[i].shape.domain();
    bound_from(brep, i, DVec2::new(u, v))
}

/// Bound face `i` by the sides of its patch; where it closes, its seam lies at the parameter `from`.
fn bound_from(brep: &mut Brep, i: usize, from: DVec2) -> Result<()> {
    let shape = Arc::new(brep.faces[i].shape.clone());
    let [[u0, u1], [v0, v1]] = shape.domain();
    let (u0, u1, v0, v1) = (from.x, from.x + (u1 - u0), from.y, from.y + (v1 - v0));
    if ![u0, u1, v0, v1].iter().all(|t| t.is_finite()) {
        return Err(fault(brep, i, "it has no boundary and its surface no end"));
    }
    let closed = shape.closed();
    let poles = shape.poles();
    // Corners counter-clockwise; those that are one point are one vertex.
    let corners = [[u0, v0], [u1, v0], [u1, v1], [u0, v1]].map(DVec2::from);
    let mut vertices = [0_u32; 4];
    for k in 0..4 {
        let same = (0..k).find(|&j| {
            let d = (corners[j] - corners[k]).abs();
            let by_period = (d.x == 0.0 || closed[0]) && (d.y == 0.0 || closed[1]);
            let by_pole = poles
                .iter()
                .any(|p| corners[j][p.fixed] == p.value && corners[k][p.fixed] == p.value);
            by_period || by_pole
        });
        vertices[k] = if let Some(j) = same {
            vertices[j]
        } else {
            brep.vertices.push(shape.point(corners[k]));
            brep.vertices.len() as u32 - 1
        };
    }
    let mut sides: [Option<Coedge>; 4] = [None; 4];
    for k in 0..4 {
        // Sides 0 (v lower) and 2 (v upper) run along u; 1 (u upper) and 3 (u lower) along v.
        let fixed = 1 - k % 2;
        let upper = k == 1 || k == 2;
        if poles.iter().any(|p| p.fixed == fixed && p.upper == upper) {
            continue;
        }
        // On a closed patch the side across is the same edge, run the other way.
        let across = k.checked_sub(2).and_then(|j| sides[j]).filter(|_| closed[fixed]);
        sides[k] = Some(if let Some(across) = across {
            Coedge { edge: across.edge, reversed: true }
        } else {
            let ends = [corners[k], corners[(k + 1) % 4]];
            let curve = Curve::UvLine { shape: shape.clone(), ends };
            let ends = [vertices[k], vertices[(k + 1) % 4]];
            brep.edges.push(BrepEdge { curve, range: [0.0, 1.0], ends });
            Coedge { edge: brep.edges.len() as u32 - 1, reversed: false }
        });
    }
    let mut coedges: Vec<Coedge> = sides.into_iter().flatten().collect();
    if coedges.is_empty() {
        return Err(fault(brep, i, "its surface has no side that is a curve"));
    }
    if brep.faces[i].reversed {
        flip(&mut coedges);
    }
    brep.faces[i].loops.push(coedges);
    Ok(())
}

/// Run the other way.
fn flip(coedges: &mut [Coedge]) {
    coedges.reverse();
    for c in coedges {
        c.reversed = !c.reversed;
    }
}

/// Cut face `i` open where loops run round its closed patch.
fn cut(
    brep: &mut Brep,
    i: usize,
    traced: &[Traced],
    poles: &[Pole],
) -> std::result::Result<(), String> {
    let round: Vec<usize> =
        (0..traced.len()).filter(|&l| traced[l].winding != DVec2::ZERO).collect();
    match round[..] {
        [] => Ok(()),
        [one] => {
            let winding = traced[one].winding;
            let k = usize::from(winding.x == 0.0);
            // The face lies to the left: above a loop that runs along +u, at lower u of one along +v.
            let upper = (winding[k] > 0.0) == (k == 0);
            let pole = poles
                .iter()
                .find(|p| p.fixed == 1 - k && p.upper == upper)
                .ok_or("a loop runs round it, and nothing bounds the other side")?;
            let start = traced[one].nodes[0];
            let mut end = start.uv;
            end[pole.fixed] = pole.value;
            brep.vertices.push(pole.point);
            let tip = brep.vertices.len() as u32 - 1;
            let seam = add_seam(brep, i, [start.uv, end], [start.vertex, tip]);
            let out = Coedge { edge: seam, reversed: false };
            let back = Coedge { edge: seam, reversed: true };
            let reversed = brep.faces[i].reversed;
            // Seen in (u, v), each loop starts at its first node: after it has come round, go out and back.
            let coedges = &mut brep.faces[i].loops[one];
            if reversed {
                flip(coedges);
            }
            coedges.extend([out, back]);
            if reversed {
                flip(coedges);
            }
            Ok(())
        }
        [one, two] if opposite(traced[one].winding, traced[two].winding) => {
            let shape = brep.faces[i].shape.clone();
            let (start, there, turn) = nearest(brep, i, &traced[one], &traced[two], &shape, two);
            let seam = add_seam(brep, i, [start.uv, there.uv], [start.vertex, there.vertex]);
            let reversed = brep.faces[i].reversed;
            let mut second = brep.faces[i].loops[two].clone();
            let first = &mut brep.faces[i].loops[one];
            if reversed {
                flip(first);
                flip(&mut second);
            }
            second.rotate_left(turn);
            first.push(Coedge { edge: seam, reversed: false });
            first.extend(second);
            first.push(Coedge { edge: seam, reversed: true });
            if reversed {
                flip(first);
            }
            brep.faces[i].loops.remove(two);
            Ok(())
        }
        _ => Err(format!("{} loops run round it", round.len())),
    }
}

/// Whether two windings cancel, up to rounding.
fn opposite(a: DVec2, b: DVec2) -> bool {
    (a + b).length() < 1e-6 * a.length()
}

/// The vertex of loop `two` nearest in (u, v) to the first node of `one`, shifted to where it is nearest, and
/// the number of coedges before it.
fn nearest(
    brep: &Brep,
    i: usize,
    one: &Traced,
    two: &Traced,
    shape: &Shape,
    loop_two: usize,
) -> (Node, Node, usize) {
    let start = one.nodes[0];
    let period = shape.period();
    let mut coedges = brep.faces[i].loops[loop_two].clone();
    if brep.faces[i].reversed {
        flip(&mut coedges);
    }
    let mut best = (f64::INFINITY, two.nodes[0], 0);
    for (turn, c) in coedges.iter().enumerate() {
        let ends = brep.edges[c.edge as usize].ends;
        let vertex = ends[usize::from(c.reversed)];
        for &node in two.nodes.iter().filter(|n| n.vertex == vertex) {
            let mut there = node;
            for k in (0..2).filter(|&k| period[k] > 0.0) {
                there.uv[k] += ((start.uv[k] - node.uv[k]) / period[k]).round() * period[k];
            }
            let d = there.uv.distance(start.uv);
            if d < best.0 {
                best = (d, there, turn);
            }
        }
    }
    (start, best.1, best.2)
}

/// A seam edge straight in (u, v).
fn add_seam(brep: &mut Brep, i: usize, uv: [DVec2; 2], ends: [u32; 2]) -> u32 {
    let curve = Curve::UvLine { shape: Arc::new(brep.faces[i].shape.clone()), ends: uv };
    brep.edges.push(BrepEdge { curve, range: [0.0, 1.0], ends });
    brep.edges.len() as u32 - 1
}
