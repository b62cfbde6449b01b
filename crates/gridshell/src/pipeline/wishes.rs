//! What the recipe fixes, and its varying lengths and directions, laid on a surface.

use crate::error::Result;
use crate::job::Job;
use crate::recipe::{Direction, Recipe, Size};
use crate::surface::{Fixtures, Surface, fields::grading};
use glam::DVec3;
use std::f64::consts::PI;

/// A carrier as fine as members of l0 ask for is made anew where members are to be shorter than this share of it.
const SHORT: f64 = 0.8;
/// But never finer than for this share.
const SHORTEST: f64 = 0.2;

/// The surface for members of `length` metres, with features, anchors, lengths and directions as the recipe wants
/// them, and what the user should know of them; `make` gives the surface that suits members of a length.
pub fn surface(
    recipe: &Recipe,
    length: f64,
    make: impl Fn(f64) -> Result<Surface>,
    job: &Job,
) -> Result<(Surface, Vec<String>)> {
    let mut surface = make(length)?;
    let mut told = fix(&mut surface, length, recipe, job)?;
    grade(&mut surface, recipe, Some(length));
    let least = surface.scale.iter().copied().fold(1.0, f64::min);
    if least < SHORT {
        surface = make(length * least.max(SHORTEST))?;
        told = fix(&mut surface, length, recipe, job)?;
        grade(&mut surface, recipe, Some(length));
    }
    direct(&mut surface, &recipe.direction);
    Ok((surface, told))
}

/// Fix what the recipe asks for; gives what the user should know of it.
fn fix(surface: &mut Surface, length: f64, recipe: &Recipe, job: &Job) -> Result<Vec<String>> {
    let guides: Vec<Vec<DVec3>> =
        recipe.guides.iter().map(|g| g.iter().map(|&p| p.into()).collect()).collect();
    let anchors: Vec<DVec3> = recipe.anchors.iter().map(|&p| p.into()).collect();
    let (anchors, shared) = surface.apart(&anchors, length);
    let wanted = Fixtures {
        crease_angle: Some(recipe.feature_angle_deg.to_radians()).filter(|&a| a < PI),
        guides: &guides,
        anchors: &anchors,
        corner_angle: recipe.corner_angle_deg.to_radians(),
        edge_length: length,
    };
    let mut told = surface.fix(&wanted, job)?;
    told.extend(shared);
    Ok(told)
}

/// Have the lengths on `surface` vary as the recipe says, about `length` metres where that is known. Gives the mean
/// length where the recipe itself says it: at points, without an edge length or a number of nodes beside them.
pub fn grade(surface: &mut Surface, recipe: &Recipe, length: Option<f64>) -> Option<f64> {
    let carrier = &surface.carrier;
    let mut lengths = match &recipe.size {
        Size::Uniform => return None,
        Size::Curvature { range, strength } => grading::by_curvature(carrier, *range, *strength),
        Size::Points { points } => grading::by_points(carrier, points),
    };
    let given = recipe.edge_length.is_some() || recipe.nodes.is_some();
    if matches!(recipe.size, Size::Points { .. }) && !given {
        grading::limit(carrier, &mut lengths);
        let mean = length.unwrap_or_else(|| grading::mean_length(carrier, &lengths));
        surface.grade(&lengths, mean);
        return Some(mean);
    }
    if let Some(length) = length {
        scale_to(surface, &mut lengths, length);
        grading::limit(&surface.carrier, &mut lengths);
    }
    let mean = grading::mean_length(&surface.carrier, &lengths);
    surface.grade(&lengths, mean);
    None
}

fn scale_to(surface: &Surface, lengths: &mut [f64], mean: f64) {
    let factor = mean / grading::mean_length(&surface.carrier, lengths);
    for l in lengths {
        *l *= factor;
    }
}

fn direct(surface: &mut Surface, direction: &Direction) {
    match direction {
        Direction::Any => {}
        Direction::Vector { xyz } => surface.direct(|_| DVec3::from_array(*xyz)),
        Direction::Points { points } => surface.direct_by_points(points),
        Direction::Boundary => surface.direct_along_boundary(),
    }
}
