//! Edges that run through a pole of a face's patch, parted there.
//!
//! On the two sides of a pole the parameter that means nothing at it differs by half a turn: an edge that went on
//! through would jump. Great circles through the poles of a sphere do, where its axis lies in the plane of the rim.

use crate::surface::brep::{BrepEdge, Coedge};
use crate::surface::{Brep, Curve};
use glam::DVec3;
use std::collections::BTreeSet;

/// An edge meets a pole that is nearer to it than this share of the edge's size, and is parted unless that is as
/// near to one of its ends.
const AT_POLE: f64 = 1e-7;
/// Looks along an edge for the place nearest to a pole.
const LOOKS: usize = 32;

/// Part all edges at the poles in their middle.
pub(in crate::surface) fn part(brep: &mut Brep) {
    for i in 0..brep.faces.len() {
        if brep.faces[i].loops.is_empty() {
            continue;
        }
        for pole in brep.faces[i].shape.poles() {
            let edges: BTreeSet<u32> =
                brep.faces[i].loops.iter().flatten().map(|c| c.edge).collect();
            for edge in edges {
                if let Some(t) = passes(&brep.edges[edge as usize], pole.point) {
                    split(brep, edge, t, pole.point);
                }
            }
        }
    }
}

/// Where an edge passes through a point in its middle.
fn passes(edge: &BrepEdge, at: DVec3) -> Option<f64> {
    let Curve::Nurbs(curve) = &edge.curve else { return None };
    let [a, b] = edge.range;
    let place = |k: usize| a + (b - a) * k as f64 / LOOKS as f64;
    let far: Vec<f64> = (0..=LOOKS).map(|k| curve.point(place(k)).distance(at)).collect();
    let size = far.iter().fold(0.0_f64, |s, &d| s.max(d));
    let near = (1..LOOKS).filter(|&k| far[k] <= far[k - 1] && far[k] <= far[k + 1]);
    near.filter(|&k| far[k] < 0.25 * size).find_map(|k| {
        let (t, foot) = edge.curve.project(place(k), edge.range, at);
        let close = |p: DVec3| p.distance(at) <= AT_POLE * size;
        let inside =
            !close(curve.point(a)) && !close(curve.point(b)) || (t - a).min(b - t) > 0.01 * (b - a);
        (close(foot) && inside && t > a && t < b).then_some(t)
    })
}

/// Part an edge at parameter `t`, in all loops that use it.
fn split(brep: &mut Brep, edge: u32, t: f64, at: DVec3) {
    brep.vertices.push(at);
    let vertex = brep.vertices.len() as u32 - 1;
    let BrepEdge { curve, range: [a, b], ends } = brep.edges[edge as usize].clone();
    let rest = brep.edges.len() as u32;
    brep.edges[edge as usize] =
        BrepEdge { curve: curve.clone(), range: [a, t], ends: [ends[0], vertex] };
    brep.edges.push(BrepEdge { curve, range: [t, b], ends: [vertex, ends[1]] });
    for coedges in brep.faces.iter_mut().flat_map(|f| &mut f.loops) {
        for k in (0..coedges.len()).rev().filter(|&k| coedges[k].edge == edge).collect::<Vec<_>>() {
            let reversed = coedges[k].reversed;
            let next = Coedge { edge: rest, reversed };
            coedges.insert(if reversed { k } else { k + 1 }, next);
        }
    }
}
