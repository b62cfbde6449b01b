//! The place on a surface nearest to a point in space, where nothing is known of it yet (a grid read from a
//! file). Everywhere else points are *traced*, which cannot jump to another sheet as this can.

use super::SurfacePoint;
use super::chain::ChainPoint;
use crate::surface::Surface;
use glam::DVec3;
use rstar::primitives::{GeomWithData, Line};
use rstar::{AABB, PointDistance, RTree, RTreeObject};

/// Finds nearest places on one surface. Distances are to the carrier.
pub struct Locator<'a> {
    surface: &'a Surface,
    facets: RTree<Facet>,
    /// Segments of the loops, with (loop, segment).
    borders: RTree<Border>,
}

type Border = GeomWithData<Line<[f64; 3]>, (u32, u32)>;

/// One carrier triangle in the tree.
struct Facet {
    triangle: u32,
    corners: [DVec3; 3],
}

impl<'a> Locator<'a> {
    /// Sort the carrier's triangles and the loops' segments into trees.
    pub fn new(surface: &'a Surface) -> Locator<'a> {
        let carrier = &surface.carrier;
        let facets = (0..carrier.triangles.len() as u32)
            .map(|triangle| Facet { triangle, corners: carrier.corners(triangle) })
            .collect();
        let mut borders = Vec::new();
        for (l, chain) in surface.loops.iter().enumerate() {
            for k in 0..chain.segments.len() {
                let ends = [k, (k + 1) % chain.vertices.len()];
                let [a, b] = ends.map(|i| carrier.points[chain.vertices[i] as usize].to_array());
                borders.push(GeomWithData::new(Line::new(a, b), (l as u32, k as u32)));
            }
        }
        Locator { surface, facets: RTree::bulk_load(facets), borders: RTree::bulk_load(borders) }
    }

    /// The carrier point nearest to `xyz`; None on a surface without triangles.
    pub fn nearest(&self, xyz: DVec3) -> Option<SurfacePoint> {
        let facet = self.facets.nearest_neighbor(xyz.to_array())?;
        Some(SurfacePoint {
            triangle: facet.triangle,
            bary: nearest_in_triangle(facet.corners, xyz),
        })
    }

    /// The place on the boundary nearest to `xyz`; None on a closed surface.
    pub fn nearest_on_loops(&self, xyz: DVec3) -> Option<ChainPoint> {
        let found = self.borders.nearest_neighbor(xyz.to_array())?;
        let (chain, k) = found.data;
        let [a, b] = [found.geom().from, found.geom().to].map(DVec3::from_array);
        let along = b - a;
        let f =
            ((xyz - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let arc = &self.surface.loops[chain as usize].arc;
        let (start, end) = (arc[k as usize], arc[k as usize + 1]);
        Some(ChainPoint { chain, s: start + (end - start) * f })
    }
}

impl RTreeObject for Facet {
    type Envelope = AABB<[f64; 3]>;

    fn envelope(&self) -> Self::Envelope {
        AABB::from_points(self.corners.map(|c| c.to_array()).iter())
    }
}

impl PointDistance for Facet {
    fn distance_2(&self, point: &[f64; 3]) -> f64 {
        let xyz = DVec3::from_array(*point);
        let b = nearest_in_triangle(self.corners, xyz);
        let [p, q, r] = self.corners;
        (p * b[0] + q * b[1] + r * b[2]).distance_squared(xyz)
    }
}

/// Barycentric coordinates of the point of a triangle nearest to `x`: its foot in the plane if that lies
/// inside, else the nearest of the three feet on the sides.
pub(in crate::surface) fn nearest_in_triangle(p: [DVec3; 3], x: DVec3) -> [f64; 3] {
    let n = (p[1] - p[0]).cross(p[2] - p[0]);
    let nn = n.length_squared();
    let inside =
        [0, 1, 2].map(|k| n.dot((p[(k + 2) % 3] - p[(k + 1) % 3]).cross(x - p[(k + 1) % 3])) / nn);
    if nn > 0.0 && inside.iter().all(|&b| b >= 0.0) {
        return inside;
    }
    let mut best = (f64::INFINITY, [1.0, 0.0, 0.0]);
    for k in 0..3 {
        let (a, side) = (p[k], p[(k + 1) % 3] - p[k]);
        let f = ((x - a).dot(side) / side.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let distance = (a + side * f).distance_squared(x);
        if distance < best.0 {
            let mut bary = [0.0; 3];
            bary[k] = 1.0 - f;
            bary[(k + 1) % 3] = f;
            best = (distance, bary);
        }
    }
    best.1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The unit square in the plane z = 0, cut by the diagonal from (0, 0) to (1, 1).
    fn square() -> Surface {
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
        Surface::from_facets("square", points, vec![[0, 1, 2], [0, 2, 3]])
    }

    #[test]
    fn a_point_above_lands_below_itself() {
        let surface = square();
        let locator = Locator::new(&surface);
        let place = locator.nearest(DVec3::new(0.7, 0.2, 5.0)).expect("a place");
        assert_eq!(place.triangle, 0);
        assert!(surface.carrier.xyz(&place).distance(DVec3::new(0.7, 0.2, 0.0)) < 1e-12);
    }

    #[test]
    fn a_point_outside_lands_on_the_side_or_the_corner() {
        let surface = square();
        let locator = Locator::new(&surface);
        let nearest =
            |x, y| surface.carrier.xyz(&locator.nearest(DVec3::new(x, y, 0.0)).expect("a place"));
        assert!(nearest(0.3, -2.0).distance(DVec3::new(0.3, 0.0, 0.0)) < 1e-12);
        assert!(nearest(3.0, 4.0).distance(DVec3::new(1.0, 1.0, 0.0)) < 1e-12);
    }

    #[test]
    fn the_nearest_place_on_the_boundary_is_given_by_its_arc_length() {
        let surface = square();
        let locator = Locator::new(&surface);
        let place = locator.nearest_on_loops(DVec3::new(0.9, 0.6, 0.3)).expect("a place");
        assert_eq!(place.chain, 0);
        assert!((place.s - 1.6).abs() < 1e-12, "one side and 0.6 of the next");
    }

    #[test]
    fn a_closed_surface_has_no_place_on_the_boundary() {
        let points = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
        let surface = Surface::from_facets(
            "tetrahedron",
            points,
            vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
        );
        assert!(surface.loops.is_empty());
        assert_eq!(Locator::new(&surface).nearest_on_loops(DVec3::ONE), None);
    }
}
