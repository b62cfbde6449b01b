//! A lattice start: a triangular lattice laid on a chart of the surface.

use super::boundary::{feature_pieces, member_count, pieces, place, place_on_features};
use super::random::interior_count;
use crate::bubbles::Bubbles;
use crate::math::trig::{cos, sin};
use crate::surface::{Surface, SurfacePoint, chart::Chart};
use glam::{DMat2, DVec2};

/// One lattice on the chart, and the boundary counts that go with it.
#[derive(Clone, Debug)]
pub struct Lattice {
    /// Direction of one family of lines in the chart, radians.
    pub angle: f64,
    /// Shift in units of the two lattice vectors.
    pub offset: [f64; 2],
    /// No lattice node nearer to the boundary than this, over l0.
    pub margin: f64,
    /// Members added to (or taken from) each boundary piece, then each feature.
    pub extra: Vec<i64>,
    /// Shift of the nodes of loops without corners, in members.
    pub slide: f64,
}

impl Lattice {
    /// Draw a lattice: any direction (all differ by less than a sixth of a turn) and shift.
    pub fn draw(pieces: usize, rng: &mut fastrand::Rng) -> Lattice {
        Lattice {
            angle: rng.f64() * std::f64::consts::FRAC_PI_3,
            offset: [rng.f64(), rng.f64()],
            margin: 0.4 + 0.3 * rng.f64(),
            extra: (0..pieces).map(|_| rng.i64(-1..=1)).collect(),
            slide: rng.f64(),
        }
    }

    /// The bubbles of this lattice on `surface` for members of `length` metres, `k_n` times as many as Eq. 1
    /// asks for.
    pub fn bubbles(&self, surface: &Surface, chart: &Chart, length: f64, k_n: f64) -> Bubbles {
        let pieces = pieces(surface);
        let count = |(p, extra): (_, &i64)| {
            let n = member_count(p, length) as i64 + extra;
            n.max(p.least as i64) as usize
        };
        let counts: Vec<usize> = pieces.iter().zip(&self.extra).map(count).collect();
        let boundary = place(surface, &pieces, &counts, self.slide);
        let lines = feature_pieces(surface);
        let counts: Vec<usize> = lines.iter().zip(&self.extra[pieces.len()..]).map(count).collect();
        let features = place_on_features(surface, &lines, &counts);
        let fixed = surface.fixed.clone();
        let held = features.len() + fixed.len();
        let inside = interior_count(surface, boundary.len(), length, k_n);
        let wanted = inside.saturating_sub(held) as f64;
        let mut step = length;
        let mut interior = self.interior(surface, chart, length, step);
        // The strip kept clear along the border and the chart's distortion cost nodes: draw the lattice
        // closer until it has as many as members of the wanted length ask for.
        for _ in 0..2 {
            step *= (interior.len() as f64 / wanted.max(1.0)).sqrt().clamp(0.9, 1.1);
            interior = self.interior(surface, chart, length, step);
        }
        Bubbles { boundary, features, fixed, interior }
    }

    /// Lattice points `step` apart inside the chart and off its boundary, in order of triangles.
    fn interior(
        &self,
        surface: &Surface,
        chart: &Chart,
        length: f64,
        step: f64,
    ) -> Vec<SurfacePoint> {
        let carrier = &surface.carrier;
        let (c, s) = (cos(self.angle), sin(self.angle));
        let a = DVec2::new(c, s) * step;
        let b = a * 0.5 + a.perp() * (0.5 * 3f64.sqrt());
        let to_lattice = DMat2::from_cols(a, b).inverse();
        let shift = DVec2::from_array(self.offset);
        let rim = Rim::new(surface, chart, self.margin * length);
        let mut found: Vec<([i64; 2], SurfacePoint)> = Vec::new();
        for t in 0..carrier.triangles.len() {
            let corners = chart.corners(carrier, t);
            let [p, q, r] = corners.map(|uv| to_lattice * uv - shift);
            let (low, high) = (p.min(q).min(r), p.max(q).max(r));
            let whole = (q - p).perp_dot(r - p);
            if whole <= 0.0 {
                continue;
            }
            for i in low.x.ceil() as i64..=high.x.floor() as i64 {
                for j in low.y.ceil() as i64..=high.y.floor() as i64 {
                    let x = DVec2::new(i as f64, j as f64);
                    let bary =
                        [(q - x).perp_dot(r - x), (r - x).perp_dot(p - x), (p - x).perp_dot(q - x)]
                            .map(|area| area / whole);
                    // A point on an edge shows up in both triangles: the second one is dropped below.
                    let uv = corners[0] * bary[0] + corners[1] * bary[1] + corners[2] * bary[2];
                    if bary.iter().all(|&w| w >= -1e-9) && rim.is_clear(uv) {
                        let bary = bary.map(|w| w.max(0.0));
                        found.push(([i, j], SurfacePoint { triangle: t as u32, bary }));
                    }
                }
            }
        }
        // Twice the same lattice point near the same place on the surface: it lay on an edge.
        found.sort_by_key(|f| (f.0, f.1.triangle));
        found.dedup_by(|x, y| {
            x.0 == y.0 && carrier.xyz(&x.1).distance(carrier.xyz(&y.1)) < 1e-3 * length
        });
        found.into_iter().map(|f| f.1).collect()
    }
}

/// The chart's boundary and feature segments in square cells, to keep lattice points off them.
struct Rim {
    margin: f64,
    /// (cell, segment), sorted.
    cells: Vec<([i64; 2], [DVec2; 2])>,
}

impl Rim {
    fn new(surface: &Surface, chart: &Chart, margin: f64) -> Rim {
        let mut cells = Vec::new();
        let mut enter = |p: DVec2, q: DVec2| {
            let (low, high) = (cell(p.min(q) - margin, margin), cell(p.max(q) + margin, margin));
            for i in low[0]..=high[0] {
                for j in low[1]..=high[1] {
                    cells.push(([i, j], [p, q]));
                }
            }
        };
        for chain in surface.loops.iter().chain(&surface.features) {
            for k in 0..chain.segments.len() {
                let next = chain.vertices[(k + 1) % chain.vertices.len()];
                enter(chart.uv[chain.vertices[k] as usize], chart.uv[next as usize]);
            }
        }
        for p in &surface.fixed {
            let corners = chart.corners(&surface.carrier, p.triangle as usize);
            let uv = corners[0] * p.bary[0] + corners[1] * p.bary[1] + corners[2] * p.bary[2];
            enter(uv, uv);
        }
        cells.sort_by_key(|c| c.0);
        Rim { margin, cells }
    }

    fn is_clear(&self, uv: DVec2) -> bool {
        let at = cell(uv, self.margin);
        let start = self.cells.partition_point(|c| c.0 < at);
        let here = self.cells[start..].iter().take_while(|c| c.0 == at);
        here.map(|c| distance(uv, c.1)).all(|d| d >= self.margin)
    }
}

fn cell(p: DVec2, size: f64) -> [i64; 2] {
    (p / size).floor().to_array().map(|x| x as i64)
}

fn distance(p: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    let d = b - a;
    let t = ((p - a).dot(d) / d.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    p.distance(a + d * t)
}
