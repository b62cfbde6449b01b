//! The balance of a grid: Gauss-Newton on the spread of lengths and the bending of lines.
//!
//! Minimises  sum over members (l / l_mean - 1)^2
//!          + s * sum over regular interior nodes and their three lines |(x_j + x_(j+3) - 2 x_i)_t|^2 / l_mean^2
//! where t is the part in the tangent plane: a line that bends only with the surface costs nothing, and when
//! all three lines of a node run straight its opposite angles are equal (the two parts of Eq. 28 to 30).
//! Nodes move in their tangent plane, boundary nodes along the boundary, corners not at all: the linear
//! system is solved for 3D moves projected to those spaces, by preconditioned conjugate gradients.

use crate::grid::{Grid, Place};
use crate::job::Job;
use crate::math::conjugate::conjugate_gradients;
use crate::surface::Surface;
use glam::DVec3;

/// Damping of the normal equations against moves that change nothing, relative to a spring.
const DAMPING: f64 = 1e-4;
/// Largest move of a node in one step, over the mean length.
const REACH: f64 = 0.25;

/// Halvings (and more) of a step that does not lower the energy.
const BACK_OFFS: usize = 8;

/// Conjugate-gradient steps in a Gauss-Newton step, at most.
const SOLVER_STEPS: usize = 200;

/// How to balance.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Weight s of straightness.
    pub straightness: f64,
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
    let mut energy = f64::INFINITY;
    while report.steps < options.max_steps && !job.stopped() {
        let step = system.step(surface, grid);
        if energy.is_infinite() {
            energy = system.energy(surface, grid);
        }
        let longest = step.iter().map(|d| d.length()).fold(0.0, f64::max);
        let mut scale = (REACH * system.mean / longest).min(1.0);
        // Gauss-Newton leaves out what compressed members lack in stiffness: back off where it overshoots.
        let mut lower = false;
        for _ in 0..BACK_OFFS {
            let before = grid.clone();
            report.last_move = 0.0;
            for (i, d) in step.iter().enumerate() {
                let moved = grid.slide(surface, i, *d * scale);
                report.last_move = report.last_move.max(moved / system.mean);
            }
            let after = system.energy(surface, grid);
            lower = after < energy;
            if lower || report.last_move < options.settled {
                energy = after;
                break;
            }
            *grid = before;
            scale *= 0.4;
        }
        // No step along this direction lowers the energy: it is as low as rounding lets it be.
        report.converged = !lower || report.last_move < options.settled;
        report.steps += 1;
        if report.converged {
            break;
        }
        job.progress("relax", report.steps as f64 / options.max_steps as f64, &grid.flat_xyz());
    }
    report
}

/// A straight line through a regular node: (node, neighbour, opposite neighbour).
type Line = [u32; 3];

/// The linearised problem at the present positions.
struct System {
    edges: Vec<(u32, u32)>,
    lines: Vec<Line>,
    straightness: f64,
    mean: f64,
    /// Unit directions of the edges.
    directions: Vec<DVec3>,
    /// What a node may do: its normal (interior), its tangent (boundary), nothing (corner).
    freedom: Vec<Freedom>,
    /// Diagonal of the matrix, one number a node.
    diagonal: Vec<f64>,
    accuracy: f64,
    /// Whether the surface bends so sharply that lengths are to follow it.
    bends: bool,
}

#[derive(Clone, Copy)]
enum Freedom {
    Plane(DVec3),
    Line(DVec3),
    None,
}

impl Freedom {
    fn project(self, v: DVec3) -> DVec3 {
        match self {
            Freedom::Plane(n) => v - n * v.dot(n),
            Freedom::Line(t) => t * v.dot(t),
            Freedom::None => DVec3::ZERO,
        }
    }
}

impl System {
    fn new(surface: &Surface, grid: &Grid, options: &Options) -> System {
        let straightness = options.straightness;
        let mesh = &grid.mesh;
        let edges: Vec<(u32, u32)> = mesh.edges().collect();
        let regular = mesh.vertices().filter(|&v| !mesh.is_boundary(v) && mesh.degree(v) == 6);
        let mut lines: Vec<Line> = regular
            .flat_map(|v| (0..3).map(move |j| [v, mesh.ring(v)[j], mesh.ring(v)[j + 3]]))
            .collect();
        let sharp = grid.sharp_members(surface);
        let is_sharp = |a: u32, b: u32| sharp.binary_search(&(a.min(b), a.max(b))).is_ok();
        // Lines run on past a sharp bend without being held straight there.
        lines.retain(|&[i, j, k]| !is_sharp(i, j) && !is_sharp(i, k));
        let mut diagonal = vec![DAMPING; mesh.slots()];
        for &(a, b) in &edges {
            diagonal[a as usize] += 0.5;
            diagonal[b as usize] += 0.5;
        }
        for &[i, j, k] in &lines {
            diagonal[i as usize] += 4.0 * straightness;
            diagonal[j as usize] += straightness;
            diagonal[k as usize] += straightness;
        }
        System {
            edges,
            lines,
            straightness,
            mean: 0.0,
            directions: Vec::new(),
            freedom: Vec::new(),
            diagonal,
            accuracy: options.accuracy,
            bends: !sharp.is_empty(),
        }
    }

    /// Lengths of the edges: chords, or where the surface bends sharply the arcs above them.
    fn lengths(&self, surface: &Surface, grid: &Grid) -> Vec<f64> {
        if !self.bends {
            return self.edges.iter().map(|&(a, b)| grid.length(a, b)).collect();
        }
        let normals: Vec<DVec3> = grid.places.iter().map(|p| p.normal(surface)).collect();
        let arc = |&(a, b): &(u32, u32)| {
            grid.length(a, b) * arc_over_chord(normals[a as usize], normals[b as usize])
        };
        self.edges.iter().map(arc).collect()
    }

    /// What is minimised, up to the curvature of the surface: the spread of lengths and the bends in the
    /// tangent planes of the last linearisation.
    fn energy(&self, surface: &Surface, grid: &Grid) -> f64 {
        let lengths = self.lengths(surface, grid);
        let mean = lengths.iter().sum::<f64>() / self.edges.len() as f64;
        let spread: f64 = lengths.iter().map(|l| (l - mean) * (l - mean)).sum();
        let bends: f64 = self
            .lines
            .iter()
            .map(|&[i, j, k]| {
                let [p, q, r] = [i, j, k].map(|v| grid.xyz[v as usize]);
                let bend = q + r - p * 2.0;
                self.freedom.get(i as usize).map_or(bend, |f| f.project(bend)).length_squared()
            })
            .sum();
        spread + self.straightness * bends
    }

    /// Linearise at the grid's positions and solve for the move of every node.
    fn step(&mut self, surface: &Surface, grid: &Grid) -> Vec<DVec3> {
        let lengths = self.lengths(surface, grid);
        self.mean = lengths.iter().sum::<f64>() / lengths.len() as f64;
        self.directions = self
            .edges
            .iter()
            .map(|&(a, b)| (grid.xyz[b as usize] - grid.xyz[a as usize]).normalize_or_zero())
            .collect();
        self.freedom = (0..grid.xyz.len()).map(|i| freedom(surface, grid, i)).collect();
        let mut gradient = vec![DVec3::ZERO; grid.xyz.len()];
        for ((&(a, b), &l), &u) in self.edges.iter().zip(&lengths).zip(&self.directions) {
            let pull = u * (l - self.mean);
            gradient[a as usize] += pull;
            gradient[b as usize] -= pull;
        }
        for &line in &self.lines {
            let [i, j, k] = line.map(|v| v as usize);
            let bend = grid.xyz[j] + grid.xyz[k] - grid.xyz[i] * 2.0;
            self.add_bend(&mut gradient, line, -bend);
        }
        for (g, f) in gradient.iter_mut().zip(&self.freedom) {
            *g = f.project(*g);
        }
        self.solve(&gradient)
    }

    /// Add the force of a line's bend to its three nodes.
    fn add_bend(&self, to: &mut [DVec3], [i, j, k]: Line, bend: DVec3) {
        let b = self.freedom[i as usize].project(bend) * self.straightness;
        to[j as usize] += b;
        to[k as usize] += b;
        to[i as usize] -= b * 2.0;
    }

    fn apply(&self, x: &[DVec3]) -> Vec<DVec3> {
        let mut y: Vec<DVec3> = x.iter().map(|&v| v * DAMPING).collect();
        for (&(a, b), &u) in self.edges.iter().zip(&self.directions) {
            let f = u * (x[b as usize] - x[a as usize]).dot(u);
            y[a as usize] -= f;
            y[b as usize] += f;
        }
        for &line in &self.lines {
            let [i, j, k] = line.map(|v| v as usize);
            self.add_bend(&mut y, line, x[j] + x[k] - x[i] * 2.0);
        }
        for (v, f) in y.iter_mut().zip(&self.freedom) {
            *v = f.project(*v);
        }
        y
    }

    fn solve(&self, right: &[DVec3]) -> Vec<DVec3> {
        let mut x = vec![DVec3::ZERO; right.len()];
        let enough = |first: f64| first * self.accuracy * self.accuracy;
        let (apply, dot) = (|v: &[DVec3]| self.apply(v), DVec3::dot);
        let residual = right.to_vec();
        conjugate_gradients(&mut x, residual, &self.diagonal, apply, dot, enough, SOLVER_STEPS);
        x
    }
}

/// Length of an arc over its chord when the surface normal turns from `m` to `n` along it: the circle's
/// x / sin x at half the angle, as a series in sin x. Without it, members would rather leap across a fold than
/// follow a bend tighter than they are long.
pub fn arc_over_chord(m: DVec3, n: DVec3) -> f64 {
    let s = 0.5 * (1.0 - m.dot(n));
    1.0 + s * (1.0 / 6.0 + 0.404 * s * s)
}

fn freedom(surface: &Surface, grid: &Grid, i: usize) -> Freedom {
    match &grid.places[i] {
        Place::Interior(p) => Freedom::Plane(surface.carrier.normal(p)),
        Place::Boundary(c) => {
            Freedom::Line(surface.loops[c.chain as usize].tangent(&surface.carrier, c.s))
        }
        Place::Feature(c) => {
            Freedom::Line(surface.features[c.chain as usize].tangent(&surface.carrier, c.s))
        }
        Place::Corner(_) | Place::Fixed(_) => Freedom::None,
    }
}
