//! The balance linearised: two unknowns a node (its moves along two directions of its tangent plane, one along
//! the boundary, none at a corner) and a sparse matrix of blocks of two by two.
//!
//! Row i couples node i to its neighbours (members, lines) and to the nodes straight across each neighbour
//! (lines through that neighbour). Off the diagonal, single precision is enough: the matrix only has to be
//! near the true one for a step to be good, and it is read some hundred times.

use super::{DAMPING, Options, arc_over_chord, directions};
use crate::grid::Grid;
use crate::job::Job;
use crate::math::chunks::{collect, sum, sweep};
use crate::math::conjugate::conjugate_gradients;
use crate::mesh::Mesh;
use crate::surface::Surface;
use glam::{DMat2, DVec2, DVec3};

/// Conjugate-gradient steps in a Gauss-Newton step, at most.
const SOLVER_STEPS: usize = 200;

/// Chords shorter than this, over the mean one, resist more firmly, and by how much more.
const SHORT: f64 = 0.66;
const FIRMNESS: f64 = 2.0;

/// No node straight across.
const NONE: u32 = u32::MAX;

/// A block off the diagonal, column by column.
type Block = [f32; 4];

/// The linearised problem at the present positions.
pub(super) struct System {
    straightness: f64,
    accuracy: f64,
    /// Whether the surface bends so sharply that lengths are to follow it.
    bends: bool,
    /// Weight of the lengths of members that touch the border.
    border: f64,
    /// Whether each node is on the border.
    at_border: Vec<bool>,
    /// Sum of the weights of all members.
    weights: f64,
    /// Where row i begins; it has the neighbours in ring order, then as many nodes across them.
    starts: Vec<usize>,
    columns: Vec<u32>,
    /// Which of its three lines are held straight at each node, a bit each.
    held: Vec<u8>,
    /// Weighted mean length at the last linearisation, metres.
    pub mean: f64,
    /// Chords below this resist being short more firmly, metres.
    short: f64,
    /// The directions in which each node may move there.
    frames: Vec<[DVec3; 2]>,
    diagonal: Vec<DMat2>,
    inverse: Vec<DMat2>,
    blocks: Vec<Block>,
}

impl System {
    pub fn new(surface: &Surface, grid: &Grid, options: &Options) -> System {
        let mesh = &grid.mesh;
        let sharp = grid.sharp_members(surface);
        let is_sharp = |a: u32, b: u32| sharp.binary_search(&(a.min(b), a.max(b))).is_ok();
        let held = collect(mesh.slots(), |i| {
            let v = i as u32;
            if !mesh.is_alive(v) || mesh.is_boundary(v) || mesh.degree(v) != 6 {
                return 0;
            }
            let ring = mesh.ring(v);
            // Lines run on past a sharp bend without being held straight there.
            let straight =
                |j: usize| sharp.is_empty() || (!is_sharp(v, ring[j]) && !is_sharp(v, ring[j + 3]));
            (0..3).map(|j| u8::from(straight(j)) << j).sum()
        });
        let mut starts = Vec::with_capacity(mesh.slots() + 1);
        let mut columns = Vec::with_capacity(12 * mesh.slots());
        for v in 0..mesh.slots() as u32 {
            starts.push(columns.len());
            columns.extend(mesh.ring(v));
            columns.extend(mesh.ring(v).iter().map(|&j| across(mesh, &held, v, j)));
        }
        starts.push(columns.len());
        let at_border: Vec<bool> =
            (0..mesh.slots() as u32).map(|v| mesh.is_alive(v) && mesh.is_boundary(v)).collect();
        let touching =
            mesh.edges().filter(|e| at_border[e.0 as usize] || at_border[e.1 as usize]).count();
        System {
            straightness: options.straightness,
            accuracy: options.accuracy,
            bends: !sharp.is_empty(),
            border: options.border,
            at_border,
            weights: mesh.edge_count() as f64 + (options.border - 1.0) * touching as f64,
            blocks: vec![[0.0; 4]; columns.len()],
            starts,
            columns,
            held,
            mean: 0.0,
            short: 0.0,
            frames: Vec::new(),
            diagonal: vec![DMat2::ZERO; mesh.slots()],
            inverse: vec![DMat2::ZERO; mesh.slots()],
        }
    }

    /// Neighbours of `i`, and the nodes straight across them from it.
    fn row(&self, i: usize) -> (&[u32], &[u32]) {
        let row = &self.columns[self.starts[i]..self.starts[i + 1]];
        row.split_at(row.len() / 2)
    }

    /// Weight of the length of the member from `i` to `j`.
    fn weight(&self, i: usize, j: usize) -> f64 {
        if self.at_border[i] || self.at_border[j] { self.border } else { 1.0 }
    }

    /// All members as they lie, with normals and scales where lengths need them.
    fn members<'a>(&self, surface: &Surface, grid: &'a Grid) -> Members<'a> {
        let places = &grid.places;
        let graded = !surface.scale.is_empty();
        Members {
            xyz: &grid.xyz,
            short: self.short,
            normals: self.bends.then(|| collect(places.len(), |i| places[i].normal(surface))),
            scales: graded.then(|| collect(places.len(), |i| places[i].scale(surface))),
        }
    }

    /// Linearise at the grid's positions and solve for the move of every node; gives the energy there too.
    pub fn step(&mut self, surface: &Surface, grid: &Grid, job: &Job) -> (Vec<DVec3>, f64) {
        let mut members = self.members(surface, grid);
        self.short = SHORT * self.total(|i, j| members.chord(i, j)) / self.weights;
        members.short = self.short;
        self.mean = self.total(|i, j| members.length(i, j)) / self.weights;
        self.frames = collect(grid.xyz.len(), |i| directions(surface, grid, i));
        let right = self.assemble(&members);
        let energy = self.energy_of(&members);
        let x = self.solve(right, job);
        let step = collect(x.len(), |i| self.frames[i][0] * x[i].x + self.frames[i][1] * x[i].y);
        (step, energy)
    }

    /// What is minimised, up to the curvature of the surface: the spread of lengths and the bends in the
    /// tangent planes of the last linearisation.
    pub fn energy(&self, surface: &Surface, grid: &Grid) -> f64 {
        self.energy_of(&self.members(surface, grid))
    }

    /// Weighted sum over all members.
    fn total(&self, value: impl Fn(usize, usize) -> f64 + Sync) -> f64 {
        sum(self.held.len(), |r| {
            let values = r.flat_map(|i| {
                let later = self.row(i).0.iter().map(|&j| j as usize).filter(move |&j| j > i);
                let value = &value;
                later.map(move |j| self.weight(i, j) * value(i, j))
            });
            values.sum()
        })
    }

    fn energy_of(&self, members: &Members) -> f64 {
        // Against the last mean: the sum of squares about the true one follows without cancellation.
        let off = self.total(|i, j| members.length(i, j)) - self.weights * self.mean;
        let about = sum(self.held.len(), |r| {
            r.map(|i| {
                let ring = self.row(i).0;
                let later = ring.iter().map(|&j| j as usize).filter(|&j| j > i);
                let spread: f64 = later
                    .map(|j| self.weight(i, j) * (members.length(i, j) - self.mean).powi(2))
                    .sum();
                spread + self.straightness * self.bend_energy(members, i, ring)
            })
            .sum()
        });
        about - off * off / self.weights
    }

    fn bend_energy(&self, members: &Members, i: usize, ring: &[u32]) -> f64 {
        let lines = (0..3).filter(|j| self.held[i] >> j & 1 == 1);
        lines
            .map(|j| {
                in_frame(&self.frames[i], members.bend(i, ring[j], ring[j + 3])).length_squared()
            })
            .sum()
    }

    /// Fill in the matrix; gives the right side.
    fn assemble(&mut self, members: &Members) -> Vec<DVec2> {
        let mut blocks = std::mem::take(&mut self.blocks);
        let mut diagonal = std::mem::take(&mut self.diagonal);
        let mut right = vec![DVec2::ZERO; diagonal.len()];
        {
            let this = &*self;
            // Rows are of different lengths: hand out the blocks row by row first.
            let mut rows: Vec<(&mut [Block], &mut DMat2, &mut DVec2)> =
                Vec::with_capacity(right.len());
            let mut rest = blocks.as_mut_slice();
            for (i, (d, b)) in diagonal.iter_mut().zip(&mut right).enumerate() {
                let (row, others) = rest.split_at_mut(this.starts[i + 1] - this.starts[i]);
                rest = others;
                rows.push((row, d, b));
            }
            sweep(&mut rows, |first, piece| {
                for (k, (row, d, b)) in piece.iter_mut().enumerate() {
                    (**d, **b) = this.assemble_row(members, first + k, row);
                }
            });
        }
        self.inverse = collect(diagonal.len(), |i| diagonal[i].inverse());
        self.blocks = blocks;
        self.diagonal = diagonal;
        right
    }

    /// Row `i`: its blocks, its diagonal block and its right side.
    fn assemble_row(&self, members: &Members, i: usize, row: &mut [Block]) -> (DMat2, DVec2) {
        let frame = &self.frames[i];
        let (ring, over) = self.row(i);
        let (near, far) = row.split_at_mut(ring.len());
        let weight = self.straightness;
        let mut diagonal = DMat2::from_diagonal(DVec2::splat(DAMPING));
        let mut right = DVec2::ZERO;
        let mut own = DVec3::ZERO;
        let mut through = DVec3::ZERO;
        for (k, &j) in ring.iter().enumerate() {
            let other = &self.frames[j as usize];
            let (length, slope, u) = members.span(i, j as usize);
            let rate = members.rate(i, j as usize);
            let weight_of_length = self.weight(i, j as usize);
            let stiffness = weight_of_length * slope * slope;
            let (a, b) = (in_frame(frame, u), in_frame(other, u));
            right += a * (weight_of_length * slope * (length - self.mean));
            diagonal += outer(a, a) * stiffness;
            let mut block = -outer(a, b) * stiffness;
            let turn = between(frame, other);
            if self.held[i] >> (k % 3) & 1 == 1 {
                let both = rate + members.rate(i, ring[(k + 3) % 6] as usize);
                block -= turn * (both * rate * weight);
                if k < 3 {
                    diagonal += DMat2::IDENTITY * (both * both * weight);
                    own += members.bend(i, j, ring[k + 3]) * both;
                }
            }
            far[k] = [0.0; 4];
            if over[k] != NONE {
                let o = over[k];
                let there = other_frame(frame, other, &self.frames[o as usize]);
                let beyond = members.rate(j as usize, o as usize);
                block -= turn * ((rate + beyond) * rate * weight);
                diagonal += turn * turn.transpose() * (rate * rate * weight);
                far[k] = single(there * (rate * beyond * weight));
                through += project(other, members.bend(j as usize, i as u32, o)) * rate;
            }
            near[k] = single(block);
        }
        right += in_frame(frame, own - through) * weight;
        (diagonal, right)
    }

    fn apply(&self, x: &[DVec2], y: &mut [DVec2]) {
        sweep(y, |first, piece| {
            for (k, y) in piece.iter_mut().enumerate() {
                let i = first + k;
                let row = self.starts[i]..self.starts[i + 1];
                let mut sum = self.diagonal[i] * x[i];
                for (b, &j) in self.blocks[row.clone()].iter().zip(&self.columns[row]) {
                    // Where there is no node across, the block is zero.
                    let v = x[if j == NONE { i } else { j as usize }];
                    sum.x += f64::from(b[0]) * v.x + f64::from(b[2]) * v.y;
                    sum.y += f64::from(b[1]) * v.x + f64::from(b[3]) * v.y;
                }
                *y = sum;
            }
        });
    }

    fn solve(&self, right: Vec<DVec2>, job: &Job) -> Vec<DVec2> {
        let mut x = vec![DVec2::ZERO; right.len()];
        let precondition = |r: &[DVec2], z: &mut [DVec2]| {
            sweep(z, |first, piece| {
                for (k, z) in piece.iter_mut().enumerate() {
                    *z = self.inverse[first + k] * r[first + k];
                }
            });
        };
        let enough = |first: f64| first * self.accuracy * self.accuracy;
        let apply = |v: &[DVec2], y: &mut [DVec2]| self.apply(v, y);
        let go_on = || !job.stopped();
        conjugate_gradients(&mut x, right, apply, precondition, enough, SOLVER_STEPS, go_on);
        x
    }
}

/// Positions, normals where lengths are arcs, and scales where lengths are to vary.
struct Members<'a> {
    xyz: &'a [DVec3],
    short: f64,
    normals: Option<Vec<DVec3>>,
    scales: Option<Vec<f64>>,
}

impl Members<'_> {
    /// Chord from node `i` to `j` over the scale there.
    fn chord(&self, i: usize, j: usize) -> f64 {
        self.xyz[i].distance(self.xyz[j]) * self.rate(i, j)
    }

    /// Length from node `i` to `j`: of the chord, or where the surface bends sharply of the arc above it; over the
    /// scale there. What a chord lacks to `short` counts several times.
    fn length(&self, i: usize, j: usize) -> f64 {
        let chord = self.chord(i, j);
        chord * self.arc(i, j) - FIRMNESS * (self.short - chord).max(0.0)
    }

    fn arc(&self, i: usize, j: usize) -> f64 {
        self.normals.as_ref().map_or(1.0, |n| arc_over_chord(n[i], n[j]))
    }

    /// How fast the chord from node `i` to `j` grows with the distance: one over the scale.
    fn rate(&self, i: usize, j: usize) -> f64 {
        self.scales.as_ref().map_or(1.0, |s| 2.0 / (s[i] + s[j]))
    }

    /// Length from node `i` to `j`, how fast it grows with the distance (arcs as if they were chords), and the
    /// direction there.
    fn span(&self, i: usize, j: usize) -> (f64, f64, DVec3) {
        let rate = self.rate(i, j);
        let direction = (self.xyz[j] - self.xyz[i]).normalize_or_zero();
        let firm = if self.chord(i, j) < self.short { 1.0 + FIRMNESS } else { 1.0 };
        (self.length(i, j), rate * firm, direction)
    }

    /// How the line from `j` over `i` to `k` bends.
    fn bend(&self, i: usize, j: u32, k: u32) -> DVec3 {
        let half = |j: u32| (self.xyz[j as usize] - self.xyz[i]) * self.rate(i, j as usize);
        half(j) + half(k)
    }
}

/// The node straight across `j` from its neighbour `v`, where a line through `j` is held straight.
fn across(mesh: &Mesh, held: &[u8], v: u32, j: u32) -> u32 {
    if held[j as usize] == 0 {
        return NONE;
    }
    let at = mesh.position(j, v).expect("neighbours are mutual");
    if held[j as usize] >> (at % 3) & 1 == 0 {
        return NONE;
    }
    mesh.ring(j)[(at + 3) % 6]
}

fn in_frame(frame: &[DVec3; 2], v: DVec3) -> DVec2 {
    DVec2::new(frame[0].dot(v), frame[1].dot(v))
}

fn project(frame: &[DVec3; 2], v: DVec3) -> DVec3 {
    frame[0] * frame[0].dot(v) + frame[1] * frame[1].dot(v)
}

/// Components in `to` of the directions of `from`.
fn between(to: &[DVec3; 2], from: &[DVec3; 2]) -> DMat2 {
    DMat2::from_cols(in_frame(to, from[0]), in_frame(to, from[1]))
}

/// Components in `to` of the directions of `from`, seen in the plane of `by`.
fn other_frame(to: &[DVec3; 2], by: &[DVec3; 2], from: &[DVec3; 2]) -> DMat2 {
    between(to, by) * between(by, from)
}

fn outer(a: DVec2, b: DVec2) -> DMat2 {
    DMat2::from_cols(a * b.x, a * b.y)
}

fn single(m: DMat2) -> Block {
    m.to_cols_array().map(|x| x as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::Place;
    use crate::surface::{Sampling, builtin};

    /// A lattice on the flat hexagon, its inner nodes pushed about, with lengths that are to vary.
    fn ruffled() -> (Surface, Grid) {
        let sampling = Sampling { max_edge: 0.5, chord_error: 2e-3, corner_angle: 0.5 };
        let mut surface =
            builtin::model("hexagon").unwrap().surface(&sampling, &Job::default()).unwrap();
        surface.scale = surface.carrier.points.iter().map(|p| 1.0 + 0.08 * p.x).collect();
        let points = surface.carrier.points.clone();
        let mut grid = Grid::from_panels(points, &surface.carrier.triangles, &surface).unwrap();
        let mut rng = fastrand::Rng::with_seed(1);
        for i in 0..grid.xyz.len() {
            let push = DVec3::new(rng.f64() - 0.5, rng.f64() - 0.5, 0.0) * 0.05;
            if matches!(grid.places[i], Place::Interior(_)) {
                grid.slide(&surface, i, push);
            }
        }
        (surface, grid)
    }

    fn linearised() -> (Surface, Grid, System) {
        let (surface, grid) = ruffled();
        let options =
            Options { straightness: 0.3, border: 2.0, settled: 0.0, max_steps: 1, accuracy: 1e-3 };
        let mut system = System::new(&surface, &grid, &options);
        system.step(&surface, &grid, &Job::default());
        (surface, grid, system)
    }

    #[test]
    fn matrix_is_symmetric_and_positive() {
        let (_, grid, system) = linearised();
        let mut rng = fastrand::Rng::with_seed(2);
        let mut any = || -> Vec<DVec2> {
            grid.xyz.iter().map(|_| DVec2::new(rng.f64() - 0.5, rng.f64() - 0.5)).collect()
        };
        let times = |v: &[DVec2]| {
            let mut y = vec![DVec2::ZERO; v.len()];
            system.apply(v, &mut y);
            y
        };
        let dot = |a: &[DVec2], b: &[DVec2]| a.iter().zip(b).map(|(p, q)| p.dot(*q)).sum::<f64>();
        let (a, b) = (any(), any());
        let whole = dot(&a, &times(&a));
        assert!(whole > 0.0);
        assert!((dot(&a, &times(&b)) - dot(&b, &times(&a))).abs() < 1e-6 * whole);
    }

    #[test]
    fn right_side_is_half_the_slope_of_the_energy() {
        let (surface, grid, mut system) = linearised();
        let members = system.members(&surface, &grid);
        let right = system.assemble(&members);
        let h = 1e-6;
        for i in (0..grid.xyz.len()).filter(|&i| matches!(grid.places[i], Place::Interior(_))) {
            for k in 0..2 {
                let energy = |h: f64| {
                    let mut moved = grid.clone();
                    moved.xyz[i] += system.frames[i][k] * h;
                    system.energy(&surface, &moved)
                };
                let slope = (energy(h) - energy(-h)) / (2.0 * h);
                assert!((slope + 2.0 * right[i][k]).abs() < 1e-6, "{slope} {}", right[i][k]);
            }
        }
    }
}
