//! The same model whatever unit it was written in: the last bits of its numbers, which a change of unit leaves to
//! chance, are rounded away. The search for a grid multiplies the smallest difference, so they must agree in full.

use super::nurbs::{NurbsCurve, NurbsSurface};
use super::{Brep, Curve, Shape, size};
use glam::DVec3;

/// Steps in the size of the model: a quarter of a micrometre for a roof of 60 metres, and what files of twelve digits
/// agree in.
const STEPS: f64 = (1u64 << 28) as f64;

/// Round points, weights and ranges of `brep` to lattices so fine that nobody could build them.
pub fn snap(brep: &mut Brep) {
    let step = lattice(size::of_brep(brep));
    for p in &mut brep.vertices {
        round_point(p, step);
    }
    for edge in &mut brep.edges {
        if let Curve::Nurbs(NurbsCurve { points, weights, knots, .. }) = &mut edge.curve {
            round_spline(points, weights, step);
            let (from, to) = (knots[0], knots[knots.len() - 1]);
            for t in &mut edge.range {
                round(t, lattice(to - from));
                *t = t.clamp(from, to);
            }
        }
    }
    for face in &mut brep.faces {
        if let Shape::Nurbs(NurbsSurface { points, weights, .. }) = &mut face.shape {
            round_spline(points, weights, step);
        }
    }
}

fn round_spline(points: &mut [DVec3], weights: &mut [f64], step: f64) {
    for p in points {
        round_point(p, step);
    }
    for w in weights {
        round(w, lattice(*w));
    }
}

fn round_point(p: &mut DVec3, step: f64) {
    for x in p.as_mut() {
        round(x, step);
    }
}

/// To the nearest multiple of `step`, a power of two: nothing else changes. What is no number stays it.
fn round(x: &mut f64, step: f64) {
    let rounded = (*x / step).round() * step;
    if rounded.is_finite() {
        *x = rounded;
    }
}

/// The step for numbers of this size.
fn lattice(size: f64) -> f64 {
    let power = f64::from_bits(size.to_bits() & (0x7ff << 52));
    power / STEPS
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_moved_by_half_a_step_at_most_and_twice_is_once() {
        let step = lattice(97.15);
        assert_eq!(step, 64.0 / STEPS);
        for x in [0.0, -31.4, 73.25, 1e-9] {
            let (mut once, mut twice) = (x, x);
            round(&mut once, step);
            assert!((once - x).abs() <= 0.5 * step, "{x}");
            round(&mut twice, step);
            round(&mut twice, step);
            assert_eq!(once.to_bits(), twice.to_bits());
        }
    }

    #[test]
    fn what_has_no_size_is_left_as_it_is() {
        let mut brep = Brep { vertices: vec![DVec3::splat(0.1)], ..Brep::default() };
        snap(&mut brep);
        assert_eq!(brep.vertices, [DVec3::splat(0.1)]);
    }
}
