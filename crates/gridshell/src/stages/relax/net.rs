//! The net-like method (Eq. 18 to 22): members as springs of one slack length, damped motion.
//!
//! Eq. 18 is read with the sign that pulls stretched members together. The springs to surface and boundary
//! (Eq. 4, 21) are taken to their limit: nodes slide on both exactly.

use super::Report;
use crate::grid::Grid;
use crate::job::Job;
use crate::recipe::Relax;
use crate::surface::Surface;
use glam::DVec3;

/// The paper's constants (Section 8): k_b = 10, k_f = 1, xi = 0.7 (Eq. 10).
const K_B: f64 = 10.0;
const K_F: f64 = 1.0;
const MASS: f64 = K_F * K_F / (4.0 * 0.49 * K_B);

/// Relax by damped dynamics until the largest move in a step is below `options.settled` l0.
pub fn net(surface: &Surface, grid: &mut Grid, options: &Relax, job: &Job) -> Report {
    let edges: Vec<(u32, u32)> = grid.mesh.edges().collect();
    // Springs know chords only: across a sharp bend they would pull its nodes off it and leap from sheet to
    // sheet, where the paper says that its method fails. Those nodes hold still.
    let mut held = vec![false; grid.xyz.len()];
    for (a, b) in grid.sharp_members(surface) {
        held[a as usize] = true;
        held[b as usize] = true;
    }
    // Twelve spring ends bound the stiffest mode of a node; a third of the stability limit.
    let dt = 0.7 / (12.0 * K_B / MASS).sqrt();
    let mut velocity = vec![DVec3::ZERO; grid.xyz.len()];
    let mut report = Report::default();
    while report.steps < options.max_steps && !job.stopped() {
        let slack = edges.iter().map(|&(a, b)| grid.scaled_length(surface, a, b)).sum::<f64>()
            / edges.len() as f64;
        let mut force = vec![DVec3::ZERO; grid.xyz.len()];
        for &(a, b) in &edges {
            let d = grid.xyz[b as usize] - grid.xyz[a as usize];
            let length = d.length();
            let pull = d * (K_B * (length - slack * grid.scale(surface, a, b)) / length);
            force[a as usize] += pull;
            force[b as usize] -= pull;
        }
        report.last_move = 0.0;
        for i in (0..grid.xyz.len()).filter(|&i| !held[i]) {
            let before = velocity[i];
            let along = grid.tangential(surface, i, force[i] - before * K_F);
            velocity[i] = grid.tangential(surface, i, before) + along / MASS * dt;
            let moved = grid.slide(surface, i, (before + velocity[i]) * (0.5 * dt));
            report.last_move = report.last_move.max(moved / slack);
        }
        report.steps += 1;
        report.converged = report.last_move < options.settled;
        let done = report.steps as f64 / options.max_steps as f64;
        job.progress("relax", done, grid.picture());
        if report.converged {
            break;
        }
    }
    report
}
