//! The plane in which a face is triangulated: (u, v) scaled to lengths, and near poles so that angles keep.

use crate::surface::Shape;
use crate::surface::exact::jet::Jet;
use crate::surface::exact::shape::Pole;
use glam::DVec2;

/// Samples of a stretched direction.
const STEPS: usize = 1000;
/// Samples across it.
const ACROSS: usize = 8;
/// Probes of a patch in each direction.
const EACH: usize = 12;
/// A circle round a pole counts as no shorter than this many `max_edge`: the pole itself stays in reach.
const LEAST_CIRCLE: f64 = 1.0;

/// A map from (u, v) to the plane, each direction by itself.
pub(super) struct Stretch {
    /// Lengths per parameter.
    scale: DVec2,
    /// A direction stretched as a Mercator map is: its index, its range, and the stretched places.
    stretched: Option<(usize, [f64; 2], Vec<f64>)>,
}

impl Stretch {
    /// The map for the box of parameters `lo` to `hi`.
    pub fn new(shape: &Shape, poles: &[Pole], lo: DVec2, hi: DVec2, max_edge: f64) -> Stretch {
        let scale = mean_metric(shape, lo, hi);
        let within = |p: &&Pole| p.value >= lo[p.fixed] && p.value <= hi[p.fixed];
        let Some(pole) = poles.iter().find(within) else {
            return Stretch { scale, stretched: None };
        };
        let (k, across) = (pole.fixed, 1 - pole.fixed);
        let width = hi[across] - lo[across];
        let mut places = Vec::with_capacity(STEPS + 1);
        let mut place = 0.0;
        places.push(place);
        for i in 0..STEPS {
            let (mut along, mut round) = (0.0, 0.0);
            for j in 0..ACROSS {
                let mut uv = lo;
                uv[k] += (hi[k] - lo[k]) * (i as f64 + 0.5) / STEPS as f64;
                uv[across] += width * (j as f64 + 0.5) / ACROSS as f64;
                let jet = shape.jet(uv);
                let (a, r) = if k == 0 { (jet.du, jet.dv) } else { (jet.dv, jet.du) };
                along += a.length();
                round += r.length();
            }
            let least = LEAST_CIRCLE * max_edge * ACROSS as f64 / width;
            place += along / round.max(least);
            places.push(place);
        }
        let step = (hi[k] - lo[k]) / STEPS as f64;
        for p in &mut places {
            *p *= step * scale[across];
        }
        Stretch { scale, stretched: Some((k, [lo[k], hi[k]], places)) }
    }

    /// Lengths per parameter, on average.
    pub fn scale(&self) -> DVec2 {
        self.scale
    }

    /// The place of `uv` in the plane.
    pub fn place(&self, uv: DVec2) -> DVec2 {
        let mut p = uv * self.scale;
        if let Some((k, [lo, hi], places)) = &self.stretched {
            let at = ((uv[*k] - lo) / (hi - lo) * STEPS as f64).clamp(0.0, STEPS as f64);
            let cell = (at as usize).min(STEPS - 1);
            p[*k] = places[cell] + (places[cell + 1] - places[cell]) * (at - cell as f64);
        }
        p
    }
}

/// Mean lengths of the derivatives over the box.
fn mean_metric(shape: &Shape, lo: DVec2, hi: DVec2) -> DVec2 {
    let mut sum = DVec2::ZERO;
    for jet in probes(shape, lo, hi) {
        sum += DVec2::new(jet.du.length(), jet.dv.length());
    }
    (sum / (EACH * EACH) as f64).max(DVec2::splat(1e-12))
}

/// Area to a unit of (u, v), on average over the box.
pub(super) fn mean_area(shape: &Shape, lo: DVec2, hi: DVec2) -> f64 {
    let all = probes(shape, lo, hi).map(|jet| jet.du.cross(jet.dv).length());
    all.sum::<f64>() / (EACH * EACH) as f64
}

fn probes(shape: &Shape, lo: DVec2, hi: DVec2) -> impl Iterator<Item = Jet> {
    (0..EACH * EACH).map(move |k| {
        let share = DVec2::new((k / EACH) as f64 + 0.5, (k % EACH) as f64 + 0.5) / EACH as f64;
        shape.jet(lo + (hi - lo) * share)
    })
}
