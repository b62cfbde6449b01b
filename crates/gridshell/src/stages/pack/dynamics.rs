//! The bubbles' dynamics (Eq. 2 to 10): damped motion under inter-bubble forces and the surface's pull.

use crate::bubbles::{Bubbles, neighbors::Neighbors};
use crate::job::{Job, Picture};
use crate::recipe::Pack;
use crate::surface::{Surface, SurfacePoint};
use glam::DVec3;
use rayon::prelude::*;

/// What settling did.
#[derive(Clone, Copy, Debug)]
pub struct Report {
    /// Steps made.
    pub steps: usize,
    /// Largest move of a bubble in the last step, over l0.
    pub last_move: f64,
    /// Whether that is below the recipe's `settled`.
    pub converged: bool,
}

/// One moving bubble.
#[derive(Clone, Copy)]
struct Body {
    at: DVec3,
    velocity: DVec3,
    /// Closest point on the surface, followed as the bubble moves: never on another sheet.
    foot: SurfacePoint,
}

/// Share of the stability limit taken as the time step.
const STEP_SHARE: f64 = 0.35;
/// Neighbours are listed this much farther than bubbles reach, over l0, and listed anew when one moved by
/// half of it.
const SKIN: f64 = 0.4;

/// Let the interior bubbles move until the largest move in a step is below `options.settled` l0.
///
/// The mass follows from Eq. 10, the step from the stiffest mode (six neighbours and the surface).
pub fn settle(
    surface: &Surface,
    bubbles: &mut Bubbles,
    edge_length: f64,
    options: &Pack,
    job: &Job,
) -> Report {
    let carrier = &surface.carrier;
    let fixed: Vec<SurfacePoint> = bubbles.surface_points(surface)[..bubbles.held()].to_vec();
    let mut bodies: Vec<Body> = bubbles
        .interior
        .iter()
        .map(|&foot| Body { at: carrier.xyz(&foot), velocity: DVec3::ZERO, foot })
        .collect();
    let diameter = options.diameter * edge_length;
    let mass = options.k_f * options.k_f / (4.0 * options.xi * options.xi * options.k_b);
    let dt = STEP_SHARE * 2.0 / ((options.k_c + 6.0 * options.k_b) / mass).sqrt();
    let mut report = Report { steps: 0, last_move: f64::INFINITY, converged: bodies.is_empty() };
    let mut neighbors = Neighbors::default();
    let mut listed_at: Vec<DVec3> = Vec::new();
    while !report.converged && report.steps < options.max_steps && !job.stopped() {
        let feet: Vec<SurfacePoint> =
            fixed.iter().copied().chain(bodies.iter().map(|b| b.foot)).collect();
        let xyz: Vec<DVec3> = feet.iter().map(|p| carrier.xyz(p)).collect();
        let scales: Vec<f64> = feet.iter().map(|p| surface.scale_at(p)).collect();
        let largest = scales.iter().copied().fold(0.0, f64::max);
        let stray = 0.5 * SKIN * edge_length;
        let strayed = |(p, q): (&DVec3, &DVec3)| p.distance(*q) > stray;
        if listed_at.is_empty() || xyz.iter().zip(&listed_at).any(strayed) {
            let radius = diameter * largest + SKIN * edge_length;
            neighbors.list(carrier, &feet, &xyz, radius, stray);
            listed_at.clone_from(&xyz);
        }
        bodies.par_iter_mut().enumerate().for_each(|(i, body)| {
            let i = fixed.len() + i;
            let push = neighbors.lists[i]
                .iter()
                .map(|&j| {
                    let diameter = diameter * 0.5 * (scales[i] + scales[j as usize]);
                    repulsion(xyz[i], xyz[j as usize], diameter, i)
                })
                .sum::<DVec3>();
            let force =
                push * options.k_b + (xyz[i] - body.at) * options.k_c - body.velocity * options.k_f;
            let before = body.velocity;
            body.velocity += force / mass * dt;
            body.at += (before + body.velocity) * (0.5 * dt);
            body.foot = carrier.follow(&body.foot, body.at);
        });
        let moved =
            bodies.iter().zip(&xyz[fixed.len()..]).map(|(b, &p)| carrier.xyz(&b.foot).distance(p));
        report.last_move = moved.fold(0.0, f64::max) / edge_length;
        report.steps += 1;
        report.converged = report.last_move < options.settled;
        let picture = Picture::Bubbles { xyz: &xyz, scales: &scales, diameter };
        job.progress("pack", report.steps as f64 / options.max_steps as f64, picture);
    }
    bubbles.interior = bodies.into_iter().map(|b| b.foot).collect();
    report
}

/// Eq. 2 over k_b: overlapping bubbles repel. Two at the very same place part in a direction of their own.
fn repulsion(at: DVec3, other: DVec3, diameter: f64, index: usize) -> DVec3 {
    let d = at - other;
    let distance = d.length();
    if distance >= diameter {
        return DVec3::ZERO;
    }
    if distance < 1e-9 * diameter {
        let angle = index as f64;
        return DVec3::new(crate::math::trig::cos(angle), crate::math::trig::sin(angle), 0.0)
            * diameter;
    }
    d * ((diameter - distance) / distance)
}
