//! A lattice start: a triangular lattice laid on a chart of the surface.

use super::boundary::{feature_pieces, member_count, pieces, place, place_on_features};
use super::random::interior_count;
use super::rim::Rim;
use super::rows::{APART, HEIGHT, Rows, rows};
use crate::bubbles::Bubbles;
use crate::job::Job;
use crate::math::trig::{cos, sin};
use crate::surface::{ChainPoint, Surface, SurfacePoint, chart::Chart};
use glam::{DMat2, DVec2};

/// One lattice on the chart, and the boundary counts that go with it.
#[derive(Clone, Debug)]
pub struct Lattice {
    /// Direction of one family of lines in the chart, radians.
    pub angle: f64,
    /// Shift in units of the two lattice vectors.
    pub offset: [f64; 2],
    /// A point of the chart that a row of nodes is to run through.
    pub through: Option<DVec2>,
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
            through: None,
            margin: 0.4 + 0.3 * rng.f64(),
            extra: (0..pieces).map(|_| rng.i64(-1..=1)).collect(),
            slide: rng.f64(),
        }
    }

    /// The bubbles of this lattice on `surface` for members of `length` metres, `k_n` times as many as Eq. 1
    /// asks for, and with a row along the border wherever the lattice is off by at most `row_angle`, radians.
    pub fn bubbles(
        &self,
        surface: &Surface,
        chart: &Chart,
        length: f64,
        k_n: f64,
        row_angle: Option<f64>,
        job: &Job,
    ) -> Bubbles {
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
        let rows = rows(surface, chart, &boundary, self.angle, length, row_angle);
        let rim = self.rim(surface, chart, &boundary, &rows, length);
        let held = features.len() + fixed.len() + rows.bubbles.len();
        let wanted = interior_count(surface, boundary.len(), length, k_n) as f64 - held as f64;
        let mut step = length;
        let mut interior = self.interior(surface, chart, &rim, step, job);
        // The strip kept clear along the border and the chart's distortion cost nodes: draw the lattice
        // closer until it has as many as members of the wanted length ask for.
        for _ in 0..2 {
            step *= (interior.len() as f64 / wanted.max(1.0)).sqrt().clamp(0.9, 1.1);
            interior = self.interior(surface, chart, &rim, step, job);
        }
        interior.extend(rows.bubbles);
        Bubbles { boundary, features, fixed, interior }
    }

    /// What the lattice keeps off: the border, or the row along it.
    fn rim(
        &self,
        surface: &Surface,
        chart: &Chart,
        boundary: &[ChainPoint],
        rows: &Rows,
        length: f64,
    ) -> Rim {
        let clear = |chain: usize, s: f64| {
            let first = boundary.partition_point(|b| (b.chain as usize) < chain);
            let count = boundary[first..].partition_point(|b| b.chain as usize == chain);
            let before = boundary[first..first + count].partition_point(|b| b.s <= s);
            // Before the loop's first node is the member that begins at its last one.
            let member = first + before.checked_sub(1).unwrap_or(count - 1);
            let row = if rows.along[member] { HEIGHT } else { 0.0 };
            (row + self.margin) * length
        };
        let inside = self.margin * length;
        Rim::of_border_and(surface, chart, clear, inside, &rows.uv, APART * length)
    }

    /// Lattice points `step` apart inside the chart and off its boundary, in order of triangles.
    fn interior(
        &self,
        surface: &Surface,
        chart: &Chart,
        rim: &Rim,
        step: f64,
        job: &Job,
    ) -> Vec<SurfacePoint> {
        let carrier = &surface.carrier;
        let (c, s) = (cos(self.angle), sin(self.angle));
        let a = DVec2::new(c, s) * step;
        let b = a * 0.5 + a.perp() * (0.5 * 3f64.sqrt());
        let to_lattice = DMat2::from_cols(a, b).inverse();
        let mut shift = DVec2::from_array(self.offset);
        if let Some(at) = self.through {
            shift.y = (to_lattice * at).y;
        }
        let mut found: Vec<([i64; 2], SurfacePoint)> = Vec::new();
        for t in 0..carrier.triangles.len() {
            if job.is_over("packing") {
                break;
            }
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
            x.0 == y.0 && carrier.xyz(&x.1).distance(carrier.xyz(&y.1)) < 1e-3 * step
        });
        found.into_iter().map(|f| f.1).collect()
    }
}
