//! The quick way: where the surface has a chart that nowhere overlaps, Delaunay in the chart's plane.
//!
//! A chart distorts lengths by some per cent, so edges differ here and there from the intrinsic Delaunay ones;
//! what follows flips edges anyway. Far less work than taking the carrier apart.

use crate::bubbles::Bubbles;
use crate::grid::{Grid, Place};
use crate::job::Job;
use crate::math::delaunay;
use crate::mesh::Mesh;
use crate::surface::{ChainPoint, Surface, chart::Chart};
use glam::DVec2;

/// The Delaunay grid of `bubbles` in the chart; None where the chart overlaps itself, or bubbles lie so that
/// the boundary polygons cross or leave some outside.
pub fn triangulate(surface: &Surface, chart: &Chart, bubbles: &Bubbles, job: &Job) -> Option<Grid> {
    if job.is_over("triangulating") {
        return None;
    }
    let mut points: Vec<DVec2> =
        bubbles.boundary.iter().map(|c| chart.on_chain(&surface.loops, c)).collect();
    let mut rims = Vec::with_capacity(points.len());
    let mut first = 0;
    for same in bubbles.boundary.chunk_by(|a, b| a.chain == b.chain) {
        let n = same.len() as u32;
        rims.extend((0..n).map(|k| [first + k, first + (k + 1) % n]));
        first += n;
    }
    points.extend(bubbles.features.iter().map(|c| chart.on_chain(&surface.features, c)));
    let along = bubbles.along_features(surface);
    // A line used twice, there and back, has the inside on both its sides.
    rims.extend(along.iter().flat_map(|&pair| [pair; 2]));
    let inside = bubbles.fixed.iter().chain(&bubbles.interior);
    points.extend(inside.map(|p| chart.at(&surface.carrier, p)));
    let triangles = delaunay::triangles(&points, &rims, job).ok()?;
    let mut mesh = Mesh::from_triangles(points.len(), &triangles).ok()?;
    if mesh.euler_characteristic() != surface.euler_characteristic() {
        return None;
    }
    let on_loop = |c: &ChainPoint| {
        let chain = &surface.loops[c.chain as usize];
        let k = chain.corners.partition_point(|&k| chain.arc[k as usize] < c.s);
        let corner = chain.corners.get(k);
        if corner.is_some_and(|&k| chain.arc[k as usize] == c.s) {
            Place::Corner(*c)
        } else {
            Place::Boundary(*c)
        }
    };
    let inside = bubbles.interior.iter().map(|&p| Place::Interior(p));
    let on_feature = bubbles.features.iter().map(|&c| Place::Feature(c));
    let fixed = bubbles.fixed.iter().map(|&p| Place::Fixed(p));
    let lines = bubbles.boundary.iter().map(on_loop).chain(on_feature);
    let places: Vec<Place> = lines.chain(fixed).chain(inside).collect();
    for (v, place) in places.iter().enumerate() {
        let on_boundary = matches!(place, Place::Boundary(_) | Place::Corner(_));
        if mesh.is_boundary(v as u32) != on_boundary {
            return None;
        }
        mesh.pin(v as u32, place.is_fixed());
    }
    for [a, b] in along {
        mesh.mark_feature(a, b).ok()?;
    }
    let xyz = places.iter().map(|p| p.xyz(surface)).collect();
    Some(Grid { mesh, places, xyz })
}
