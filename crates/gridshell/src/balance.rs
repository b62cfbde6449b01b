//! The balance of a grid: Gauss-Newton on the spread of lengths and the bending of lines.
//!
//! Minimises  sum over members w (l / l_mean - 1)^2
//!          + s * sum over regular interior nodes and their three lines |(x_j + x_(j+3) - 2 x_i)_t|^2 / l_mean^2
//! where t is the part in the tangent plane: a line that bends only with the surface costs nothing, and when
//! all three lines of a node run straight its opposite angles are equal (the two parts of Eq. 28 to 30).
//! The weight w is 1, or more at members that touch the border. Where lengths are to vary, l is a member's length
//! over the mean scale of its ends, and so are the two halves of a line. What a member's chord lacks to two thirds
//! of l_mean counts threefold: no member is much shorter than the rest.
//! Nodes move in their tangent plane, boundary nodes along the boundary, corners not at all: the linear
//! system is solved for 3D moves projected to those spaces, by preconditioned conjugate gradients.

mod system;

use crate::grid::{Grid, Place};
use crate::job::Job;
use crate::math::frame::tangents;
use crate::surface::Surface;
use glam::DVec3;
use system::System;

/// Damping of the normal equations against moves that change nothing, relative to a spring.
const DAMPING: f64 = 1e-4;
/// Largest move of a node in one step, over the mean length.
const REACH: f64 = 0.25;

/// A step that lowers the energy by less than this share is the last: on a carrier of flat triangles what is
/// left is its roughness, and a hundred more steps would not change any measure's third digit.
const LEAST_GAIN: f64 = 1e-5;

/// Halvings (and more) of a step that does not lower the energy.
const BACK_OFFS: usize = 8;

/// How to balance.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Weight s of straightness.
    pub straightness: f64,
    /// Weight w of the lengths of members that touch the border.
    pub border: f64,
    /// Balanced when the largest move in a step falls below this share of the mean length.
    pub settled: f64,
    /// Most Gauss-Newton steps.
    pub max_steps: usize,
    /// Residual at which the linear system of a step counts as solved, relative to its first one.
    pub accuracy: f64,
}

/// What balancing did.
#[derive(Clone, Copy, Debug, Default)]
pub struct Report {
    /// Steps made.
    pub steps: usize,
    /// Largest move of a node in the last step, over the mean length.
    pub last_move: f64,
    /// Whether that is below `settled`.
    pub converged: bool,
}

/// Move the nodes to the nearest balance of lengths and lines. Positions end on the carrier.
pub fn balance(surface: &Surface, grid: &mut Grid, options: &Options, job: &Job) -> Report {
    let mut report = Report::default();
    let mut system = System::new(surface, grid, options);
    let mut energy = None;
    while report.steps < options.max_steps && !job.stopped() {
        let (step, here) = system.step(surface, grid, job);
        let before = energy.unwrap_or(here);
        let longest = step.iter().map(|d| d.length_squared()).fold(0.0, f64::max).sqrt();
        let mut scale = (REACH * system.mean / longest).min(1.0);
        let start = (grid.places.clone(), grid.xyz.clone());
        // Gauss-Newton leaves out what compressed members lack in stiffness: back off where it overshoots.
        let (mut lower, mut gain) = (false, 0.0);
        for _ in 0..BACK_OFFS {
            report.last_move = slide_all(surface, grid, &step, scale) / system.mean;
            let after = system.energy(surface, grid);
            lower = after < before;
            gain = (before - after) / before;
            if lower || report.last_move < options.settled {
                energy = Some(after);
                break;
            }
            grid.places.clone_from(&start.0);
            grid.xyz.clone_from(&start.1);
            scale *= 0.4;
        }
        // No step along this direction lowers the energy: it is as low as rounding lets it be.
        report.converged = !lower || gain < LEAST_GAIN || report.last_move < options.settled;
        report.steps += 1;
        let done = report.steps as f64 / options.max_steps as f64;
        job.progress("relax", done, grid.picture());
        if report.converged {
            break;
        }
    }
    report
}

/// Slide every node; gives the largest distance moved, metres.
fn slide_all(surface: &Surface, grid: &mut Grid, step: &[DVec3], scale: f64) -> f64 {
    let mut longest = 0.0_f64;
    for (i, d) in step.iter().enumerate() {
        longest = longest.max(grid.slide(surface, i, *d * scale));
    }
    longest
}

/// Length of an arc over its chord when the surface normal turns from `m` to `n` along it: the circle's
/// x / sin x at half the angle, as a series in sin x. Without it, members would rather leap across a fold than
/// follow a bend tighter than they are long.
pub fn arc_over_chord(m: DVec3, n: DVec3) -> f64 {
    let s = 0.5 * (1.0 - m.dot(n));
    1.0 + s * (1.0 / 6.0 + 0.404 * s * s)
}

/// The unit directions in which node `i` may move: two in the tangent plane, one along the boundary (and zero),
/// none where it is fixed or pinned.
fn directions(surface: &Surface, grid: &Grid, i: usize) -> [DVec3; 2] {
    if grid.mesh.is_pinned(i as u32) {
        return [DVec3::ZERO; 2];
    }
    match &grid.places[i] {
        Place::Interior(p) => {
            let normal = surface.carrier.normal(p);
            if normal == DVec3::ZERO {
                return [DVec3::ZERO; 2];
            }
            tangents(normal)
        }
        Place::Boundary(c) => {
            [surface.loops[c.chain as usize].tangent(&surface.carrier, c.s), DVec3::ZERO]
        }
        Place::Feature(c) => {
            [surface.features[c.chain as usize].tangent(&surface.carrier, c.s), DVec3::ZERO]
        }
        Place::Corner(_) | Place::Fixed(_) => [DVec3::ZERO; 2],
    }
}
