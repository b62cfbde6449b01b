//! Surfaces drawn at random, as files: patches with folds, waves and uneven weights; meshes with slivers, needles and
//! openings; ragged outlines; near the origin and far from it.

use super::patch::Patch;
use fastrand::Rng;
use std::collections::HashSet;
use std::f64::consts::TAU;

/// A file, and what is true of the surface in it.
pub struct Drawn {
    /// What it is, for the list.
    pub what: &'static str,
    /// How its name ends.
    pub extension: &'static str,
    /// The file.
    pub text: String,
    /// Square metres.
    pub area: f64,
    /// Vertices less edges and faces.
    pub euler: i64,
    /// The cosine of the sharpest bend between two of its faces; 1 where that is not asked.
    pub sharpest: f64,
}

/// Where a survey's coordinates begin.
const FAR: [f64; 3] = [500_000.0, 4_000_000.0, 120.0];

/// The surface of this number.
pub fn draw(seed: u64) -> Drawn {
    let mut rng = Rng::with_seed(seed);
    let shift = if rng.u8(0..5) == 0 { FAR } else { [0.0; 3] };
    match rng.u8(0..8) {
        0 => patch("patch", &mut rng, [3, 3], 0.3, shift),
        1 => patch("folded patch", &mut rng, [1, 3], 0.3, shift),
        2 => patch("rough patch", &mut rng, [3, 3], 1.0, shift),
        3 => waves(&mut rng, shift),
        4 => sheet(&mut rng, shift, Trouble::Slivers),
        5 => sheet(&mut rng, shift, Trouble::Needles),
        6 => tube(&mut rng, shift),
        _ => outline(&mut rng, shift),
    }
}

fn size(rng: &mut Rng) -> [f64; 2] {
    let wide = 4.0 * 25_f64.powf(rng.f64());
    [wide, wide * (0.3 + 0.7 * rng.f64())]
}

/// A patch over a rectangle. Its heights are a smooth wave and `rough` of a pole's spacing at random.
fn patch(
    what: &'static str,
    rng: &mut Rng,
    most: [usize; 2],
    rough: f64,
    shift: [f64; 3],
) -> Drawn {
    let degree = most.map(|d| if d == 1 { 1 } else { rng.usize(2..=d) });
    let count = degree.map(|d| d + rng.usize(2..8));
    let [wide, deep] = size(rng);
    let step = wide.min(deep) / 10.0;
    let (turn, rise) = (TAU * rng.f64(), 0.15 * wide * rng.f64());
    let weighted = rng.u8(0..3) == 0;
    let mut patch = Patch::new(degree, count, rng);
    for i in 0..count[0] {
        for j in 0..count[1] {
            let [s, t] = [i as f64 / (count[0] - 1) as f64, j as f64 / (count[1] - 1) as f64];
            let wave = rise * (3.0 * s + 2.0 * t + turn).sin();
            let lift = wave + rough * step * (rng.f64() - 0.5);
            patch.points.push([wide * s + shift[0], deep * t + shift[1], lift + shift[2]]);
            let weight = if weighted { (3.0 * (rng.f64() - 0.5)).exp() } else { 1.0 };
            patch.weights.push(weight);
        }
    }
    drawn(what, &patch, rng)
}

/// A dense net with many small waves.
fn waves(rng: &mut Rng, shift: [f64; 3]) -> Drawn {
    let count = [rng.usize(40..200), rng.usize(4..8)];
    let [wide, deep] = size(rng);
    let (waves, rise) = (rng.f64() * 0.4 * count[0] as f64, 0.02 * wide * rng.f64());
    let mut patch = Patch::new([3, 3], count, rng);
    for i in 0..count[0] {
        for j in 0..count[1] {
            let [s, t] = [i as f64 / (count[0] - 1) as f64, j as f64 / (count[1] - 1) as f64];
            let lift = rise * (TAU * waves * s).sin();
            patch.points.push([wide * s + shift[0], deep * t + shift[1], lift + shift[2]]);
            patch.weights.push(1.0);
        }
    }
    drawn("waves", &patch, rng)
}

fn drawn(what: &'static str, patch: &Patch, rng: &mut Rng) -> Drawn {
    let text = patch.step(rng.bool());
    Drawn { what, extension: "step", text, area: patch.area(), euler: 1, sharpest: 1.0 }
}

/// What is wrong with a mesh.
#[derive(Clone, Copy, PartialEq)]
enum Trouble {
    /// Vertices a hair beside edges.
    Slivers,
    /// Cells a hundred times as long as wide.
    Needles,
}

/// A mesh over a rectangle, with openings.
fn sheet(rng: &mut Rng, shift: [f64; 3], trouble: Trouble) -> Drawn {
    let [wide, deep] = size(rng);
    let count = match trouble {
        Trouble::Slivers => [rng.usize(6..30), rng.usize(6..30)],
        Trouble::Needles => [rng.usize(60..200), rng.usize(2..5)],
    };
    let (turn, rise) = (TAU * rng.f64(), 0.15 * wide * rng.f64());
    let height = |s: f64, t: f64| rise * (3.0 * s + 2.0 * t + turn).sin();
    let mut mesh = Mesh::default();
    for i in 0..=count[0] {
        for j in 0..=count[1] {
            let inside = i % count[0] != 0 && j % count[1] != 0;
            let mut jitter = || if inside { 0.6 * (rng.f64() - 0.5) } else { 0.0 };
            let s = (i as f64 + jitter()) / count[0] as f64;
            let t = (j as f64 + jitter()) / count[1] as f64;
            mesh.points.push([wide * s, deep * t, height(s, t)]);
        }
    }
    for i in 0..count[0] {
        for j in 0..count[1] {
            let open = i % 4 == 1 && j % 4 == 1 && i + 1 < count[0] && j + 1 < count[1];
            if open && rng.u8(0..6) == 0 {
                continue;
            }
            let at = |i: usize, j: usize| i * (count[1] + 1) + j;
            mesh.quad([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], rng.bool());
        }
    }
    if trouble == Trouble::Slivers {
        mesh.add_slivers(rng);
    }
    mesh.drawn(if trouble == Trouble::Slivers { "slivers" } else { "needles" }, shift)
}

/// A bent tube, open or closed to a ring.
fn tube(rng: &mut Rng, shift: [f64; 3]) -> Drawn {
    let count = [rng.usize(12..60), rng.usize(8..24)];
    let (large, closed) = (size(rng)[0], rng.bool());
    let small = large * (0.15 + 0.3 * rng.f64());
    let mut mesh = Mesh::default();
    let rows = if closed { count[0] } else { count[0] + 1 };
    let turn = if closed { TAU } else { 0.5 * TAU };
    for i in 0..rows {
        for j in 0..count[1] {
            let (a, b) = (turn * i as f64 / count[0] as f64, TAU * j as f64 / count[1] as f64);
            let r = large + small * b.cos();
            mesh.points.push([r * a.cos(), r * a.sin(), small * b.sin()]);
        }
    }
    for i in 0..count[0] {
        for j in 0..count[1] {
            let at = |i: usize, j: usize| i % rows * count[1] + j % count[1];
            mesh.quad([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], rng.bool());
        }
    }
    mesh.drawn(if closed { "ring" } else { "tube" }, shift)
}

/// A flat polygon with a ragged outline.
fn outline(rng: &mut Rng, shift: [f64; 3]) -> Drawn {
    let corners = rng.usize(12..400);
    let radius = size(rng)[0];
    let ragged = 0.3 * rng.f64();
    let mut mesh = Mesh { points: vec![[0.0; 3]], ..Mesh::default() };
    for k in 0..corners {
        let a = TAU * k as f64 / corners as f64;
        let r = radius * (1.0 - ragged * rng.f64());
        mesh.points.push([r * a.cos(), r * a.sin(), 0.0]);
    }
    for k in 0..corners {
        mesh.faces.push([0, 1 + k, 1 + (k + 1) % corners]);
    }
    mesh.drawn("outline", shift)
}

#[derive(Default)]
struct Mesh {
    points: Vec<[f64; 3]>,
    faces: Vec<[usize; 3]>,
}

impl Mesh {
    fn quad(&mut self, [a, b, c, d]: [usize; 4], other: bool) {
        let two = if other { [[a, b, d], [b, c, d]] } else { [[a, b, c], [a, c, d]] };
        self.faces.extend(two);
    }

    /// Put vertices into some faces, a hair from one of their sides.
    fn add_slivers(&mut self, rng: &mut Rng) {
        for t in 0..self.faces.len() {
            if rng.u8(0..8) != 0 {
                continue;
            }
            let [a, b, c] = self.faces[t];
            let hair = 10_f64.powf(-2.0 - 6.0 * rng.f64());
            let along = 0.1 + 0.8 * rng.f64();
            let share = [(1.0 - along) * (1.0 - hair), along * (1.0 - hair), hair];
            let corners = [a, b, c].map(|v| self.points[v]);
            let at = [0, 1, 2].map(|k| (0..3).map(|i| share[i] * corners[i][k]).sum());
            let m = self.points.len();
            self.points.push(at);
            self.faces[t] = [a, b, m];
            self.faces.extend([[b, c, m], [c, a, m]]);
        }
    }

    /// As an OBJ file; vertices of no face stay out of it.
    fn drawn(self, what: &'static str, shift: [f64; 3]) -> Drawn {
        let mut number = vec![0; self.points.len()];
        let mut text = String::new();
        let mut used = 0;
        for &v in self.faces.iter().flatten() {
            if number[v] == 0 {
                used += 1;
                number[v] = used;
                let [x, y, z] = [0, 1, 2].map(|k| self.points[v][k] + shift[k]);
                text += &format!("v {x:?} {y:?} {z:?}\n");
            }
        }
        let mut sides = HashSet::new();
        let mut area = 0.0;
        for f in &self.faces {
            let [a, b, c] = f.map(|v| number[v]);
            text += &format!("f {a} {b} {c}\n");
            sides.extend([(a.min(b), a.max(b)), (b.min(c), b.max(c)), (a.min(c), a.max(c))]);
            area += super::patch::triangle(f.map(|v| self.points[v]));
        }
        let euler = i64::from(used) - sides.len() as i64 + self.faces.len() as i64;
        let sharpest = super::check::sharpest(&self.points, &self.faces);
        Drawn { what, extension: "obj", text, area, euler, sharpest }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_draws_one_file_with_an_area() {
        for seed in 0..40 {
            let (a, b) = (draw(seed), draw(seed));
            assert_eq!(a.text, b.text);
            assert!(a.area > 1.0 && a.area.is_finite(), "{seed} {}: {}", a.what, a.area);
            assert!(a.euler <= 1, "{seed} {}: {}", a.what, a.euler);
        }
    }
}
