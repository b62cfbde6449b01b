//! The model rebuilt with one edge for each pair.

use super::pair::Pairs;
use super::split::{Pieces, Union};
use crate::math::digits::three;
use crate::surface::brep::{BrepEdge, Coedge};
use crate::surface::{Brep, Loss, Origin};
use crate::words;
use glam::DVec3;

/// An edge whose ends became one place and that is no longer than so many tolerances is not an edge any more.
const SHORT: f64 = 4.0;
/// Notes name so many places.
const MOST_PLACES: usize = 3;

/// What had to go.
#[derive(Default)]
pub(super) struct Lost {
    /// Edges shorter than the tolerance.
    pub edges: usize,
    /// Openings that were smaller than the tolerance.
    pub openings: usize,
    /// Faces, by number, that were narrower than the tolerance.
    pub faces: Vec<u32>,
    /// Their area, at most, square metres.
    pub area: f64,
}

/// What became of a piece.
#[derive(Clone, Copy)]
struct Fate {
    edge: u32,
    opposed: bool,
}

/// Join the pairs in `brep`.
pub(super) fn join(brep: &mut Brep, pieces: &Pieces, pairs: &Pairs, tolerance: f64) -> Lost {
    let all = &pieces.all;
    let mut partner: Vec<Option<(u32, bool)>> = vec![None; all.len()];
    let mut places = brep.vertices.clone();
    places.extend(&pieces.splits);
    let mut union = Union::new(places.len());
    for j in &pairs.joints {
        let [a, b] = j.pieces;
        partner[a as usize] = Some((b, j.opposed));
        partner[b as usize] = Some((a, j.opposed));
        let ends = all[b as usize].nodes;
        let ends = if j.opposed { [ends[1], ends[0]] } else { ends };
        for k in 0..2 {
            union.join(all[a as usize].nodes[k], ends[k]);
        }
    }
    let fates = edges(brep, pieces, &partner);
    // Loops over the new edges.
    let mut lines: Vec<Option<(usize, usize)>> = vec![None; brep.edges.len()];
    let mut from = 0;
    for group in all.chunk_by(|a, b| a.edge == b.edge) {
        lines[group[0].edge as usize] = Some((from, from + group.len()));
        from += group.len();
    }
    for coedges in brep.faces.iter_mut().flat_map(|f| &mut f.loops) {
        let mut new: Vec<Coedge> = Vec::with_capacity(coedges.len());
        for c in coedges.iter() {
            let Some((from, to)) = lines[c.edge as usize] else {
                new.push(*c);
                continue;
            };
            let first = new.len();
            for fate in &fates[from..to] {
                let coedge = Coedge { edge: fate.edge, reversed: c.reversed != fate.opposed };
                // Pieces that nobody shares are one edge still.
                if new[first..].last().is_none_or(|l| l.edge != coedge.edge) {
                    new.push(coedge);
                }
            }
            if c.reversed {
                new[first..].reverse();
            }
        }
        *coedges = new;
    }
    move_vertices(brep, &mut union, &places);
    clean(brep, pairs, tolerance)
}

/// Put the new edges in place of the old ones; the edge that each piece has become.
fn edges(brep: &mut Brep, pieces: &Pieces, partner: &[Option<(u32, bool)>]) -> Vec<Fate> {
    let all = &pieces.all;
    let mut fates = vec![Fate { edge: 0, opposed: false }; all.len()];
    let mut i = 0;
    while i < all.len() {
        if let Some((other, opposed)) = partner[i].filter(|&(other, _)| (other as usize) < i) {
            fates[i] = Fate { edge: fates[other as usize].edge, opposed };
            i += 1;
            continue;
        }
        // Pieces after this one on the same edge that nobody shares either go with it.
        let mut end = i + 1;
        if partner[i].is_none() {
            while end < all.len() && all[end].edge == all[i].edge && partner[end].is_none() {
                end += 1;
            }
        }
        let (first, last) = (&all[i], &all[end - 1]);
        let range = [first.range[0], last.range[1]];
        let ends = [first.nodes[0], last.nodes[1]];
        let old = &brep.edges[first.edge as usize];
        let edge = if old.range == range {
            first.edge
        } else {
            brep.edges.push(BrepEdge { curve: old.curve.clone(), range, ends });
            brep.edges.len() as u32 - 1
        };
        fates[i..end].fill(Fate { edge, opposed: false });
        i = end;
    }
    fates
}

/// Give all edges the joined vertices, each in the middle of those that it was, and drop what nothing uses.
fn move_vertices(brep: &mut Brep, union: &mut Union, places: &[DVec3]) {
    let mut sums = vec![(DVec3::ZERO, 0.0); places.len()];
    for (v, p) in places.iter().enumerate() {
        let sum = &mut sums[union.find(v as u32) as usize];
        // About the first one, so that equal places stay as they are to the last digit.
        let first = places[union.find(v as u32) as usize];
        *sum = (sum.0 + (*p - first), sum.1 + 1.0);
    }
    let mut used_edges = vec![false; brep.edges.len()];
    for c in brep.faces.iter().flat_map(|f| f.loops.iter().flatten()) {
        used_edges[c.edge as usize] = true;
    }
    let mut new_edge = vec![u32::MAX; brep.edges.len()];
    let mut new_vertex = vec![u32::MAX; places.len()];
    let (mut edges, mut vertices) = (Vec::new(), Vec::new());
    for (i, mut edge) in std::mem::take(&mut brep.edges).into_iter().enumerate() {
        if !used_edges[i] {
            continue;
        }
        edge.ends = edge.ends.map(|v| {
            let set = union.find(v) as usize;
            if new_vertex[set] == u32::MAX {
                new_vertex[set] = vertices.len() as u32;
                vertices.push(places[set] + sums[set].0 / sums[set].1);
            }
            new_vertex[set]
        });
        new_edge[i] = edges.len() as u32;
        edges.push(edge);
    }
    brep.edges = edges;
    brep.vertices = vertices;
    for c in brep.faces.iter_mut().flat_map(|f| f.loops.iter_mut().flatten()) {
        c.edge = new_edge[c.edge as usize];
    }
}

/// Take out edges that have shrunk to a place, and what they leave without a boundary; and faces that lie on others.
fn clean(brep: &mut Brep, pairs: &Pairs, tolerance: f64) -> Lost {
    let mut lost = Lost::default();
    let gone: Vec<bool> = brep
        .edges
        .iter()
        .map(|e| {
            let places =
                (0..=8).map(|i| e.range[0] + (e.range[1] - e.range[0]) * f64::from(i) / 8.0);
            let at: Vec<DVec3> = places.map(|t| e.curve.point(t)).collect();
            let length: f64 = at.windows(2).map(|w| w[0].distance(w[1])).sum();
            e.ends[0] == e.ends[1] && length <= SHORT * tolerance
        })
        .collect();
    lost.edges = gone.iter().filter(|&&g| g).count();
    let objects = std::mem::take(&mut brep.object_of);
    let mut faces = Vec::with_capacity(brep.faces.len());
    for (f, mut face) in std::mem::take(&mut brep.faces).into_iter().enumerate() {
        if pairs.twins.binary_search(&(f as u32)).is_ok() {
            continue;
        }
        let loops = face.loops.len();
        for l in &mut face.loops {
            l.retain(|c| !gone[c.edge as usize]);
        }
        face.loops.retain(|l| !l.is_empty());
        lost.openings +=
            (loops - face.loops.len()).saturating_sub(usize::from(face.loops.is_empty()));
        if face.loops.is_empty() && loops > 0 {
            lost.faces.push(f as u32 + 1);
            // All that was left of its boundary were edges of about the tolerance.
            lost.area += (SHORT * tolerance).powi(2);
            continue;
        }
        brep.object_of.extend(objects.get(f));
        faces.push(face);
    }
    brep.faces = faces;
    lost
}

/// Faces by their numbers.
fn named(faces: &[u32]) -> String {
    format!("{} {}", if faces.len() == 1 { "face" } else { "faces" }, list(faces))
}

fn it_or_them(n: usize) -> &'static str {
    if n == 1 { "it" } else { "them" }
}

impl Lost {
    /// Faces that went, where some did.
    pub fn loss(&self, tolerance: f64) -> Option<Loss> {
        (!self.faces.is_empty()).then(|| Loss {
            what: named(&self.faces),
            why: format!(
                "smaller than the sewing tolerance of {} m; a smaller one (--sew) keeps them",
                three(tolerance)
            ),
            faces: self.faces.len(),
            area: Some(self.area),
            whole: false,
        })
    }

    /// In words.
    pub fn told(&self, pairs: &Pairs, tolerance: f64, origin: Origin) -> Vec<String> {
        let mut told = Vec::new();
        if self.edges > 0 {
            told.push(format!(
                "{} shorter than the sewing tolerance of {} m became {}; a smaller one keeps {}",
                words::counted(self.edges, "edge"),
                three(tolerance),
                if self.edges == 1 { "a point" } else { "points" },
                it_or_them(self.edges)
            ));
        }
        if self.openings > 0 {
            told.push(format!(
                "closed {} smaller than the sewing tolerance of {} m; a smaller one keeps {}",
                words::counted(self.openings, "opening"),
                three(tolerance),
                it_or_them(self.openings)
            ));
        }
        if !pairs.twins.is_empty() {
            let numbers: Vec<u32> = pairs.twins.iter().map(|f| f + 1).collect();
            let lies = if numbers.len() == 1 { "lies on another" } else { "lie on others" };
            told.push(format!("left out {}, which {lies}", named(&numbers)));
        }
        if let Some(&at) = pairs.crowded.first() {
            let at = origin.world(at);
            told.push(format!(
                "{} where two others are joined already, the first near ({:.4}, {:.4}, {:.4}): more than two faces meet \
                 there, and only the two that go on most smoothly are joined",
                words::one_or_more(pairs.crowded.len(), ["edge lies", "edges lie"]),
                at.x,
                at.y,
                at.z
            ));
        }
        told
    }
}

fn list(numbers: &[u32]) -> String {
    let shown: Vec<String> = numbers.iter().take(MOST_PLACES).map(u32::to_string).collect();
    let more = numbers.len().saturating_sub(MOST_PLACES);
    if more > 0 { format!("{} and {more} more", shown.join(", ")) } else { shown.join(", ") }
}
