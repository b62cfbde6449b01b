//! What lattice points keep off: the chart's border and the rows along it, features and anchors.

use crate::surface::{Surface, chart::Chart};
use glam::DVec2;

/// Segments in the chart, each with its clearance, in square cells.
pub struct Rim {
    size: f64,
    segments: Vec<Segment>,
    /// (cell, segment), sorted.
    cells: Vec<([i64; 2], u32)>,
}

/// From one end to the other (they may coincide), and how far points stay off it.
#[derive(Clone, Copy)]
struct Segment {
    ends: [DVec2; 2],
    clear: f64,
}

impl Rim {
    /// The border, kept clear by `clear(loop, arc length there)`, and what is fixed inside, by `inside`.
    pub fn of_border(
        surface: &Surface,
        chart: &Chart,
        clear: impl Fn(usize, f64) -> f64,
        inside: f64,
    ) -> Rim {
        Rim::of_border_and(surface, chart, clear, inside, &[], 0.0)
    }

    /// The border as above, and `points` kept clear by `gap`.
    pub fn of_border_and(
        surface: &Surface,
        chart: &Chart,
        clear: impl Fn(usize, f64) -> f64,
        inside: f64,
        points: &[DVec2],
        gap: f64,
    ) -> Rim {
        let mut segments = border(surface, chart, clear);
        segments.extend(fixed(surface, chart, inside));
        Rim::new(segments, points, gap)
    }

    fn new(mut segments: Vec<Segment>, points: &[DVec2], gap: f64) -> Rim {
        segments.extend(points.iter().map(|&p| Segment { ends: [p; 2], clear: gap }));
        let size = segments.iter().map(|s| s.clear).fold(f64::MIN_POSITIVE, f64::max);
        let mut cells = Vec::new();
        for (k, Segment { ends: [p, q], clear }) in segments.iter().enumerate() {
            let (low, high) = (cell(p.min(*q) - *clear, size), cell(p.max(*q) + *clear, size));
            for i in low[0]..=high[0] {
                for j in low[1]..=high[1] {
                    cells.push(([i, j], k as u32));
                }
            }
        }
        cells.sort_unstable();
        Rim { size, segments, cells }
    }

    /// Whether a point is clear of all.
    pub fn is_clear(&self, uv: DVec2) -> bool {
        let at = cell(uv, self.size);
        let start = self.cells.partition_point(|c| c.0 < at);
        let here = self.cells[start..].iter().take_while(|c| c.0 == at);
        here.map(|c| &self.segments[c.1 as usize]).all(|s| distance(uv, s.ends) >= s.clear)
    }
}

fn border(surface: &Surface, chart: &Chart, clear: impl Fn(usize, f64) -> f64) -> Vec<Segment> {
    let mut segments = Vec::new();
    for (c, chain) in surface.loops.iter().enumerate() {
        for k in 0..chain.vertices.len() {
            let next = (k + 1) % chain.vertices.len();
            let ends = [k, next].map(|k| chart.uv[chain.vertices[k] as usize]);
            segments
                .push(Segment { ends, clear: clear(c, 0.5 * (chain.arc[k] + chain.arc[k + 1])) });
        }
    }
    segments
}

/// Features and fixed points, all kept clear by the same.
fn fixed(surface: &Surface, chart: &Chart, clear: f64) -> Vec<Segment> {
    let mut segments = Vec::new();
    for chain in &surface.features {
        for k in 0..chain.segments.len() {
            let next = (k + 1) % chain.vertices.len();
            let ends = [k, next].map(|k| chart.uv[chain.vertices[k] as usize]);
            segments.push(Segment { ends, clear });
        }
    }
    let points = surface.fixed.iter().map(|p| chart.at(&surface.carrier, p));
    segments.extend(points.map(|p| Segment { ends: [p; 2], clear }));
    segments
}

fn cell(p: DVec2, size: f64) -> [i64; 2] {
    (p / size).floor().to_array().map(|x| x as i64)
}

fn distance(p: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    let d = b - a;
    let t = ((p - a).dot(d) / d.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    p.distance(a + d * t)
}
