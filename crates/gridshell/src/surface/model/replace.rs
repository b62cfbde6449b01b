//! A model put elsewhere: moved, near the origin for one, or taken in another unit.

use super::{Model, PolygonMesh, size};
use crate::error::{Error, Result};
use crate::surface::{Brep, Curve, OffsetSurface, Origin, Shape};
use glam::DVec3;
use std::collections::HashMap;
use std::sync::Arc;

/// Where a point goes.
type Place<'a> = &'a dyn Fn(DVec3) -> DVec3;

/// Patches that edges are drawn on, as they are now, by their address before; with each the one before, which keeps
/// the address taken.
type Replaced = HashMap<*const Shape, [Arc<Shape>; 2]>;

impl Model {
    /// Make all lengths so many times as long.
    ///
    /// # Errors
    /// [`Error::Surface`] for a shape that cannot be scaled; files have none.
    pub fn scale(&mut self, factor: f64) -> Result<()> {
        match self {
            Model::Brep(brep) => {
                brep.tolerance *= factor;
                brep.replace(factor, &|p| p * factor)
            }
            Model::Mesh(mesh) => {
                mesh.points.iter_mut().for_each(|p| *p *= factor);
                Ok(())
            }
        }
    }
}

impl Brep {
    /// Put every point where `place` says, which makes lengths `scale` times as long and keeps shapes.
    pub(super) fn replace(&mut self, scale: f64, place: Place) -> Result<()> {
        put_all(&mut self.vertices, place);
        for face in &mut self.faces {
            put_shape(&mut face.shape, scale, place)?;
        }
        // Edges may share the patch that they are drawn on.
        let mut replaced = Replaced::new();
        for edge in &mut self.edges {
            put_curve(&mut edge.curve, scale, place, &mut replaced)?;
        }
        Ok(())
    }
}

fn put_all(points: &mut [DVec3], place: Place) {
    for p in points {
        *p = place(*p);
    }
}

fn put_shape(shape: &mut Shape, scale: f64, place: Place) -> Result<()> {
    match shape {
        Shape::Nurbs(s) => put_all(&mut s.points, place),
        Shape::Offset(s) => {
            let mut basis = s.basis().clone();
            put_all(&mut basis.points, place);
            **s = OffsetSurface::new(basis, s.distance() * scale);
        }
        Shape::Height(_) => {
            return Err(Error::Surface("a height function stays where it is".into()));
        }
    }
    Ok(())
}

fn put_curve(curve: &mut Curve, scale: f64, place: Place, replaced: &mut Replaced) -> Result<()> {
    match curve {
        Curve::Nurbs(c) => put_all(&mut c.points, place),
        Curve::OnShape(shape, _) | Curve::UvLine { shape, .. } => {
            put_shared(shape, scale, place, replaced)?;
        }
        Curve::Guide { shape, line, .. } => {
            put_all(line, place);
            put_shared(shape, scale, place, replaced)?;
        }
    }
    Ok(())
}

fn put_shared(
    shape: &mut Arc<Shape>,
    scale: f64,
    place: Place,
    replaced: &mut Replaced,
) -> Result<()> {
    if let Some([_, now]) = replaced.get(&Arc::as_ptr(shape)) {
        *shape = Arc::clone(now);
        return Ok(());
    }
    let mut now = Shape::clone(shape);
    put_shape(&mut now, scale, place)?;
    let now = Arc::new(now);
    let before = std::mem::replace(shape, Arc::clone(&now));
    replaced.insert(Arc::as_ptr(&before), [before, now]);
    Ok(())
}

impl Model {
    /// Move a model in its file's coordinates to near the origin, if it is far from it.
    ///
    /// # Errors
    /// [`Error::Surface`] for a shape that cannot be moved; files have none.
    pub fn settle(&mut self) -> Result<()> {
        match self {
            Model::Brep(brep) => brep.settle(),
            Model::Mesh(mesh) => {
                mesh.settle();
                Ok(())
            }
        }
    }
}

impl PolygonMesh {
    /// As [`Model::settle`].
    pub fn settle(&mut self) {
        let far = Origin::of_points(&self.points);
        if self.origin.is_near() && !far.is_near() {
            self.origin = far;
            for p in &mut self.points {
                *p = far.local(*p);
            }
        }
    }
}

impl Brep {
    fn settle(&mut self) -> Result<()> {
        let (low, high) = size::bounds(self);
        let far = Origin::of_box(low, high);
        if !self.origin.is_near() || far.is_near() {
            return Ok(());
        }
        self.origin = far;
        self.replace(1.0, &|p| far.local(p))
    }
}
