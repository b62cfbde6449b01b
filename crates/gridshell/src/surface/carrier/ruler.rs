//! Lengths along a chain as its members count them: metres over the scale wanted on the way.

use super::chain::Chain;
use crate::surface::Surface;

/// A chain measured so that equal steps are members of the lengths wanted.
pub struct Ruler<'a> {
    chain: &'a Chain,
    /// Measure at each vertex and at the end; None where it is the arc length.
    sums: Option<Vec<f64>>,
}

impl<'a> Ruler<'a> {
    /// The ruler of a chain of `surface`.
    pub fn new(surface: &Surface, chain: &'a Chain) -> Ruler<'a> {
        let sums = || {
            let n = chain.vertices.len();
            let mut sums = vec![0.0];
            for k in 0..chain.segments.len() {
                let ends = [k, (k + 1) % n].map(|k| surface.scale[chain.vertices[k] as usize]);
                sums.push(sums[k] + 2.0 * (chain.arc[k + 1] - chain.arc[k]) / (ends[0] + ends[1]));
            }
            sums
        };
        Ruler { chain, sums: (!surface.scale.is_empty()).then(sums) }
    }

    /// Measure of the whole chain.
    pub fn whole(&self) -> f64 {
        self.sums.as_ref().map_or(self.chain.length(), |sums| sums[self.chain.segments.len()])
    }

    /// Measure at arc length `s`.
    pub fn at_arc(&self, s: f64) -> f64 {
        let Some(sums) = &self.sums else { return s };
        let (k, f) = self.chain.locate(s);
        sums[k] + (sums[k + 1] - sums[k]) * f
    }

    /// Arc length at this measure.
    pub fn arc(&self, measure: f64) -> f64 {
        let Some(sums) = &self.sums else { return measure };
        let measure = measure - (measure / self.whole()).floor() * self.whole();
        let k = sums.partition_point(|&x| x <= measure).clamp(1, self.chain.segments.len()) - 1;
        let f = ((measure - sums[k]) / (sums[k + 1] - sums[k])).clamp(0.0, 1.0);
        self.chain.arc[k] + (self.chain.arc[k + 1] - self.chain.arc[k]) * f
    }
}
