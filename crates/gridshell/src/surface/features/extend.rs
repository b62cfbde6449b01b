//! Guides put in and features taken out where a grid lies on the surface already.

use super::Fixtures;
use crate::error::Result;
use crate::job::Job;
use crate::surface::{Chain, ChainPoint, Locator, Surface};
use glam::DVec3;

impl Surface {
    /// A copy with one more guide; all that was fixed before stays fixed. Carrier vertices keep their numbers.
    ///
    /// # Errors
    /// As [`Surface::fix`].
    pub fn with_guide(
        &self,
        guide: &[DVec3],
        corner_angle: f64,
        edge_length: f64,
        job: &Job,
    ) -> Result<Surface> {
        let mut more = self.clone();
        let anchors = self.fixed_points();
        more.fix(
            &Fixtures {
                crease_angle: None,
                guides: &[guide.to_vec()],
                anchors: &anchors,
                corner_angle,
                edge_length,
            },
            job,
        )?;
        more.take_over_wishes(self);
        Ok(more)
    }

    /// A copy in which members need not follow feature `chain` any more. Its ends stay fixed.
    #[must_use]
    pub fn without_feature(&self, chain: u32, corner_angle: f64) -> Surface {
        let mut less = self.clone();
        let gone = &self.features[chain as usize];
        for k in 0..gone.segments.len() {
            let next = gone.vertices[(k + 1) % gone.vertices.len()];
            less.tracks.unmark(gone.vertices[k], next);
        }
        less.gather(&self.fixed_vertices(), corner_angle);
        less
    }

    /// The place on a feature that is nearest to `xyz`, and how far off it is; None without features.
    pub fn nearest_on_features(&self, xyz: DVec3) -> Option<(ChainPoint, f64)> {
        let on = |(c, chain): (usize, &Chain)| {
            let (s, off) = chain.nearest(&self.carrier, xyz);
            (ChainPoint { chain: c as u32, s }, off)
        };
        self.features.iter().enumerate().map(on).min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Carrier vertices that are fixed nodes, on the boundary and inside.
    fn fixed_vertices(&self) -> Vec<u32> {
        let corner =
            |l: &Chain| -> Vec<u32> { l.corners.iter().map(|&k| l.vertices[k as usize]).collect() };
        let mut fixed: Vec<u32> = self.loops.iter().flat_map(corner).collect();
        for p in &self.fixed {
            let k = p.bary.iter().position(|&b| b == 1.0).expect("fixed points are vertices");
            fixed.push(self.carrier.triangles[p.triangle as usize][k]);
        }
        fixed
    }

    fn fixed_points(&self) -> Vec<DVec3> {
        self.fixed_vertices().iter().map(|&v| self.carrier.points[v as usize]).collect()
    }

    /// Give new carrier vertices the wanted lengths and directions that they would have had.
    fn take_over_wishes(&mut self, before: &Surface) {
        if before.scale.is_empty() && before.direction.is_empty() {
            return;
        }
        let locator = Locator::new(before);
        for &p in &self.carrier.points[before.carrier.points.len()..] {
            let Some(at) = locator.nearest(p) else { continue };
            if !before.scale.is_empty() {
                self.scale.push(before.scale_at(&at));
            }
            if !before.direction.is_empty() {
                self.direction.push(before.direction_at(&at).unwrap_or_default());
            }
        }
    }
}
