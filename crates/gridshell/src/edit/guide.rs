//! Guides put in and taken out by hand: the surface changes, and the grid is laid on it anew where it must be.

use super::workbench::Workbench;
use super::{Editor, Effect, Outcome, Refusal};
use crate::grid::{Grid, Place};
use crate::surface::{Chain, Locator, Surface};
use glam::DVec3;
use std::sync::Arc;

/// Places nearer than this, over l0, are one.
const SAME: f64 = 1e-6;

/// Cut a guide into the surface and bring the row of nodes nearest to it onto it.
pub(super) fn add(editor: &Editor, points: &[[f64; 3]]) -> Result<Outcome, Refusal> {
    let length = editor.edge_length;
    let guide: Vec<DVec3> = points.iter().map(|&p| editor.surface.origin.local(p.into())).collect();
    if guide.len() < 2 || guide.iter().any(|p| !p.is_finite() || p.length() > 1e9) {
        return Err(Refusal::new("that is not a line", "give two points or more on the surface"));
    }
    let corner_angle = editor.recipe.corner_angle_deg.to_radians();
    let surface = editor.surface.with_guide(&guide, corner_angle, length, &editor.job);
    let surface = surface.map_err(|e| {
        Refusal::new(e.to_string(), "give a line on the surface, longer than a member")
    })?;
    let is_old = |chain: &Chain| {
        let middle = chain.xyz(&surface.carrier, 0.5 * chain.length());
        let old = editor.surface.nearest_on_features(middle);
        old.is_some_and(|(_, off)| off <= SAME * length)
    };
    let chains = 0..surface.features.len() as u32;
    let new: Vec<u32> = chains.filter(|&c| !is_old(&surface.features[c as usize])).collect();
    if new.is_empty() {
        let advice = "members follow it already";
        return Err(Refusal::new("there is a crease or guide along that line", advice));
    }
    if new.iter().any(|&c| surface.features[c as usize].is_closed()) {
        return Err(Refusal::new(
            "the guide is closed",
            "leave a gap between its ends, or generate with it",
        ));
    }
    let grid = moved_over(&editor.grid, &editor.surface, &surface, length);
    let base = editor.on(Arc::new(surface), grid);
    let mut bench = Workbench::new(&base);
    let mut changed = Vec::new();
    for chain in new {
        changed.extend(bench.lay_row(chain, &editor.surface)?);
    }
    finish(editor, &base, bench, changed)
}

/// Let members no longer follow the feature that the member between `a` and `b` is on.
pub(super) fn remove(editor: &Editor, [a, b]: [u32; 2]) -> Result<Outcome, Refusal> {
    let bench = Workbench::new(editor);
    bench.check_node(a)?;
    bench.check_node(b)?;
    let on = editor.grid.mesh.adjacent(a, b) && editor.grid.mesh.is_feature_edge(a, b);
    let middle = if on { editor.grid.middle_on_feature(&editor.surface, a, b) } else { None };
    let Some(Place::Feature(at)) = middle else {
        return Err(Refusal::new(
            format!("no crease or guide runs from node {a} to {b}"),
            "choose a member that follows the one to be removed",
        ));
    };
    let corner_angle = editor.recipe.corner_angle_deg.to_radians();
    let surface = editor.surface.without_feature(at.chain, corner_angle);
    let mut grid = editor.grid.clone();
    let is_on =
        |v: u32| matches!(grid.places[v as usize], Place::Feature(p) if p.chain == at.chain);
    let row: Vec<u32> = grid.mesh.vertices().filter(|&v| is_on(v)).collect();
    if row.is_empty() {
        grid.mesh.unmark_feature(a, b);
    }
    for &v in &row {
        for w in grid.mesh.along_features(v).to_vec() {
            grid.mesh.unmark_feature(v, w);
        }
        grid.places[v as usize] =
            Place::Interior(grid.places[v as usize].surface_point(&editor.surface));
    }
    let length = editor.edge_length;
    let grid = moved_over(&grid, &editor.surface, &surface, length);
    let base = editor.on(Arc::new(surface), grid);
    let bench = Workbench::new(&base);
    finish(editor, &base, bench, row)
}

fn finish(
    editor: &Editor,
    base: &Editor,
    mut bench: Workbench,
    changed: Vec<u32>,
) -> Result<Outcome, Refusal> {
    let effect = bench.conclude(changed)?;
    let effect = Effect { before: editor.figures(), ..effect };
    let surface = Some(Arc::clone(&base.surface));
    Ok(Outcome { effect, grid: bench.into_grid(), surface })
}

/// The grid with its places on `there` instead of `here`. Where the surface is the same, so are they.
fn moved_over(grid: &Grid, here: &Surface, there: &Surface, length: f64) -> Grid {
    let locator = Locator::new(there);
    let mut grid = grid.clone();
    let alive: Vec<u32> = grid.mesh.vertices().collect();
    for v in alive {
        let place = grid.places[v as usize];
        let xyz = place.xyz(here);
        let same = |t: u32| same_triangle(here, there, t);
        grid.places[v as usize] = match place {
            Place::Interior(p) | Place::Fixed(p) if same(p.triangle) => place,
            Place::Interior(_) => locator.nearest(xyz).map_or(place, Place::Interior),
            Place::Fixed(_) => {
                let at = |p: &&_| there.carrier.xyz(p).distance(xyz) <= SAME * length;
                let fixed = there.fixed.iter().find(at).copied();
                fixed.or_else(|| locator.nearest(xyz)).map_or(place, Place::Fixed)
            }
            Place::Boundary(at) | Place::Corner(at) => {
                let same = same_chain(
                    here.loops.get(at.chain as usize),
                    there.loops.get(at.chain as usize),
                );
                let found = if same { Some(at) } else { locator.nearest_on_loops(xyz) };
                match (place, found) {
                    (Place::Corner(_), Some(at)) => Place::Corner(at),
                    (_, Some(at)) => Place::Boundary(at),
                    (_, None) => place,
                }
            }
            Place::Feature(at) => {
                let of = |s: &Surface| s.features.get(at.chain as usize).cloned();
                if same_chain(of(here).as_ref(), of(there).as_ref()) {
                    place
                } else {
                    there.nearest_on_features(xyz).map_or(place, |(at, _)| Place::Feature(at))
                }
            }
        };
        if grid.places[v as usize] != place {
            grid.xyz[v as usize] = grid.places[v as usize].exact(there);
        }
    }
    grid
}

/// Whether triangle `t` is the same on both.
fn same_triangle(here: &Surface, there: &Surface, t: u32) -> bool {
    let corners = |s: &Surface| (s.carrier.triangles[t as usize], s.carrier.corners(t));
    corners(here) == corners(there)
        && here.carrier.uv.get(t as usize).map(|uv| uv.map(|p| p.to_array().map(f64::to_bits)))
            == there.carrier.uv.get(t as usize).map(|uv| uv.map(|p| p.to_array().map(f64::to_bits)))
}

fn same_chain(here: Option<&Chain>, there: Option<&Chain>) -> bool {
    match (here, there) {
        (Some(h), Some(t)) => h.vertices == t.vertices && h.arc == t.arc,
        _ => false,
    }
}
