//! Wanted lengths that vary over the surface: a field on the carrier's vertices.
//!
//! However it is made, the field is held to a gradation: along the surface the wanted length changes by no more
//! than [`GRADATION`] per metre per metre, so that a member is at most about a quarter longer than the next one.

use crate::math::blend::Blend;
use crate::math::trig::{exp, ln};
use crate::surface::{Carrier, Surface, SurfacePoint};
use glam::DVec3;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Largest change of the wanted length over the way along the surface: successive members of 1 and
/// (1 + g / 2) / (1 - g / 2) = 1.22.
pub const GRADATION: f64 = 0.2;
/// Curvatures below this share of the root mean square one count as this: flat parts are not endless.
const FLAT: f64 = 0.1;
/// Sweeps of smoothing of a curvature field: over about two members of a carrier half as fine.
const SWEEPS: usize = 24;

impl Surface {
    /// Wanted length at a point over the mean one.
    pub fn scale_at(&self, p: &SurfacePoint) -> f64 {
        if self.scale.is_empty() {
            return 1.0;
        }
        let corners = self.carrier.triangles[p.triangle as usize];
        (0..3).map(|k| self.scale[corners[k] as usize] * p.bary[k]).sum()
    }

    /// The area, square metres, of a surface that has as much room for members of one length as this one has for
    /// members of its varying lengths: the integral of dA / scale^2.
    pub fn room(&self) -> f64 {
        if self.scale.is_empty() {
            return self.area;
        }
        let carrier = &self.carrier;
        let (mut whole, mut room) = (0.0, 0.0);
        for t in 0..carrier.triangles.len() as u32 {
            let area = carrier.triangle_area(t);
            let scale = mean_at(carrier, t, &self.scale);
            whole += area;
            room += area / (scale * scale);
        }
        // The carrier's chords cut a little off the exact area.
        room * self.area / whole
    }

    /// Have lengths vary as `lengths` (one for each carrier vertex, any unit), with `mean` metres of that unit
    /// as the wanted length l0.
    pub fn grade(&mut self, lengths: &[f64], mean: f64) {
        self.scale = lengths.iter().map(|l| l / mean).collect();
    }
}

/// Mean length of the members of a grid that follows these lengths: there are 1 / l^2 of them per area.
pub fn mean_length(carrier: &Carrier, lengths: &[f64]) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for t in 0..carrier.triangles.len() as u32 {
        let l = mean_at(carrier, t, lengths);
        let area = carrier.triangle_area(t);
        sum += area / l;
        count += area / (l * l);
    }
    sum / count
}

fn mean_at(carrier: &Carrier, t: u32, values: &[f64]) -> f64 {
    carrier.triangles[t as usize].iter().map(|&v| values[v as usize]).sum::<f64>() / 3.0
}

/// Lengths that fall with curvature, in no unit: with strength 1 as the root of the curvature's inverse, which
/// keeps the height of the surface over its panels the same; with strength 0 not at all. The longest and the
/// shortest are within `range`, where 1 stands for the root mean square curvature.
pub fn by_curvature(carrier: &Carrier, range: [f64; 2], strength: f64) -> Vec<f64> {
    let mut sums = vec![(0.0, 0.0); carrier.points.len()];
    for (a, b) in sides(carrier) {
        let d = carrier.points[b] - carrier.points[a];
        let bend = (carrier.normals[b] - carrier.normals[a]).dot(d) / d.length_squared();
        for v in [a, b] {
            sums[v].0 += bend * bend;
            sums[v].1 += 1.0;
        }
    }
    let squares: Vec<f64> = sums.iter().map(|s| s.0 / f64::max(s.1, 1.0)).collect();
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    if mean == 0.0 {
        return vec![1.0; squares.len()];
    }
    let length = |square: &f64| -0.25 * strength * ln(square / mean + FLAT * FLAT);
    let mut logarithms: Vec<f64> = squares.iter().map(length).collect();
    smooth(carrier, &mut logarithms);
    logarithms.iter().map(|&x| exp(x).clamp(range[0], range[1])).collect()
}

/// Lengths in metres, blended smoothly from those at some points.
pub fn by_points(carrier: &Carrier, points: &[[f64; 4]]) -> Vec<f64> {
    let (mut least, mut most) = (f64::INFINITY, 0.0f64);
    let given: Vec<(DVec3, DVec3)> = points
        .iter()
        .map(|&[x, y, z, length]| {
            (least, most) = (least.min(length), most.max(length));
            (DVec3::new(x, y, z), DVec3::new(ln(length), 0.0, 0.0))
        })
        .collect();
    let blend = Blend::through(&given);
    // Beyond the points the blend runs on: nobody asked for those lengths.
    carrier.points.iter().map(|&p| exp(blend.at(p).x).clamp(least, most)).collect()
}

/// Shorten lengths (metres) until they change by no more than [`GRADATION`] along the carrier's edges.
pub fn limit(carrier: &Carrier, lengths: &mut [f64]) {
    let mut rows: Vec<Vec<(u32, f64)>> = vec![Vec::new(); lengths.len()];
    for (a, b) in sides(carrier) {
        let rise = GRADATION * carrier.points[a].distance(carrier.points[b]);
        rows[a].push((b as u32, rise));
        rows[b].push((a as u32, rise));
    }
    // Lengths are positive: their bits are in their order.
    let mut queue: BinaryHeap<Reverse<(u64, u32)>> =
        lengths.iter().enumerate().map(|(v, l)| Reverse((l.to_bits(), v as u32))).collect();
    while let Some(Reverse((bits, v))) = queue.pop() {
        if lengths[v as usize].to_bits() != bits {
            continue;
        }
        for &(w, rise) in &rows[v as usize] {
            let most = lengths[v as usize] + rise;
            if lengths[w as usize] > most {
                lengths[w as usize] = most;
                queue.push(Reverse((most.to_bits(), w)));
            }
        }
    }
}

fn smooth(carrier: &Carrier, values: &mut [f64]) {
    let sides: Vec<(usize, usize)> = sides(carrier).collect();
    for _ in 0..SWEEPS {
        let mut sums = vec![(0.0, 0.0); values.len()];
        for &(a, b) in &sides {
            for (v, w) in [(a, b), (b, a)] {
                sums[v].0 += values[w];
                sums[v].1 += 1.0;
            }
        }
        for (value, (sum, count)) in values.iter_mut().zip(sums) {
            *value = 0.5 * *value + 0.5 * sum / f64::max(count, 1.0);
        }
    }
}

/// The sides of all triangles: inner edges come twice, once from either side.
fn sides(carrier: &Carrier) -> impl Iterator<Item = (usize, usize)> + '_ {
    carrier.triangles.iter().flat_map(|t| (0..3).map(|k| (t[k] as usize, t[(k + 1) % 3] as usize)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Job;
    use crate::surface::{Sampling, builtin};

    fn sampled(name: &str, max_edge: f64) -> Surface {
        let sampling = Sampling { max_edge, chord_error: 1e-2 * max_edge, corner_angle: 0.5 };
        builtin::model(name).expect("built in").surface(&sampling, &Job::default()).expect(name)
    }

    #[test]
    fn a_jump_in_length_becomes_a_slope() {
        let mut carrier = sampled("hexagon", 0.25).carrier;
        carrier.points.iter_mut().for_each(|p| p.z = 0.0);
        let wanted = |p: &DVec3| if p.x < 0.0 { 0.3 } else { 2.0 };
        let mut lengths: Vec<f64> = carrier.points.iter().map(wanted).collect();
        limit(&carrier, &mut lengths);
        for (a, b) in sides(&carrier) {
            let way = carrier.points[a].distance(carrier.points[b]);
            assert!((lengths[a] - lengths[b]).abs() <= GRADATION * way * (1.0 + 1e-12));
        }
        for (p, l) in carrier.points.iter().zip(&lengths) {
            assert!(*l <= wanted(p) && (p.x >= 0.0 || *l == 0.3));
            // No shorter than the slope asks for, but for the edges' detours.
            assert!(*l >= (0.3 + GRADATION * p.x).min(2.0) - 1e-12, "{p} {l}");
        }
    }

    #[test]
    fn lengths_that_are_all_the_same_change_nothing() {
        let mut surface = sampled("saddle", 2.0);
        let lengths = by_points(&surface.carrier, &[[0.0, 0.0, 0.0, 1.7], [9.0, 9.0, 0.0, 1.7]]);
        assert!((mean_length(&surface.carrier, &lengths) - 1.7).abs() < 1e-12);
        surface.grade(&lengths, 1.7);
        assert!((surface.room() / surface.area - 1.0).abs() < 1e-12);
    }

    #[test]
    fn room_counts_members_of_the_lengths_there() {
        // Half the lengths everywhere: four times the room.
        let mut surface = sampled("hexagon", 0.5);
        let lengths = vec![0.5; surface.carrier.points.len()];
        surface.grade(&lengths, 1.0);
        assert!((surface.room() / surface.area - 4.0).abs() < 1e-12);
    }

    #[test]
    fn only_curvature_that_varies_makes_lengths_vary() {
        let flat = sampled("hexagon", 0.5);
        assert!(by_curvature(&flat.carrier, [0.5, 2.0], 1.0).iter().all(|&l| l == 1.0));
        let dome = sampled("dome", 0.8);
        let lengths = by_curvature(&dome.carrier, [0.5, 2.0], 1.0);
        let (least, most) =
            lengths.iter().fold((f64::MAX, 0.0f64), |(lo, hi), &l| (lo.min(l), hi.max(l)));
        assert!(most / least < 1.1, "{least} {most}");
    }
}
