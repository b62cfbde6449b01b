//! Offset surfaces (140), exactly.

use super::directory::Parameters;
use super::surfaces::Sheet;
use super::{Fault, File};
use crate::surface::exact::project::Seeds;
use crate::surface::{OffsetSurface, Shape};
use glam::{DVec2, DVec3};

/// As many points of a boundary, about, tell on which side of its basis an offset lies.
const MOST_LOOKS: usize = 8;

impl File<'_> {
    /// 140: a surface at a distance from another, on the side that a normal shows. Where that was taken programs differ
    /// on; what bounds the face tells which side is meant where they do.
    pub fn offset(&self, p: &Parameters, reach: &[DVec3], level: usize) -> Result<Sheet, Fault> {
        let side = DVec3::from_slice(&p.numbers(0, 3)?).normalize_or_zero();
        let distance = p.number(3)?;
        let basis = p.pointer(4)?.ok_or_else(|| p.fault("its surface is missing"))?;
        let Sheet { shape, range } = self.surface_at(basis, reach, level + 1)?;
        let at = |share: f64| {
            let uv = range.map(|[a, b]| a + (b - a) * share);
            shape.jet(DVec2::from(uv)).normal().dot(side)
        };
        // At a pole there is no normal.
        let with = [0.5, 0.0, 1e-3].into_iter().map(at).find(|d| d.abs() > 0.1);
        let distance = if with.is_some_and(|d| d < 0.0) { -distance } else { distance };
        let offset = |distance: f64| match &shape {
            Shape::Nurbs(basis) => Some(OffsetSurface::new(basis.clone(), distance)),
            Shape::Offset(s) => {
                Some(OffsetSurface::new(s.basis().clone(), s.distance() + distance))
            }
            Shape::Height(_) => None,
        };
        let whole = |distance: f64| offset(distance).map(|s| Shape::Offset(Box::new(s)));
        let (stated, other) = whole(distance)
            .zip(whole(-distance))
            .ok_or_else(|| p.fault("it is an offset of what is not a spline"))?;
        let near = off(&stated, reach) <= 2.0 * off(&other, reach);
        Ok(Sheet { shape: if near { stated } else { other }, range })
    }
}

/// How far some of these points are from a surface, in all.
fn off(shape: &Shape, points: &[DVec3]) -> f64 {
    let seeds = Seeds::new(shape);
    let some = points.iter().step_by((points.len() / MOST_LOOKS).max(1));
    some.map(|&p| seeds.project(shape, p).1.distance(p)).sum()
}
