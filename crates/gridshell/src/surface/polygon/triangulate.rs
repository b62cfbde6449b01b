//! Splitting a polygon in space into triangles over its own corners: a quad along a diagonal, more corners in the
//! polygon's mean plane, by clipping ears where it touches or crosses itself there.

use super::plane;
use glam::{DVec2, DVec3};

/// An ear is flat, and clipped last, below this share of the polygon's area: rounding decides its sign.
const FLAT: f64 = 1e-12;
/// Corners looked at in the search for ears of one polygon; beyond, any open corner must do.
const MOST_LOOKS: usize = 50_000_000;

/// Split the face with these corners and add its triangles to `out`; they keep its orientation.
pub fn split(points: &[DVec3], face: &[u32], out: &mut Vec<[u32; 3]>) {
    match *face {
        [a, b, c] => out.push([a, b, c]),
        [a, b, c, d] => out.extend(split_quad(points, [a, b, c, d])),
        _ => {
            let plan = flatten(points, face);
            match plane::split(&plan) {
                Some(triangles) => out.extend(triangles.iter().map(|t| t.map(|k| face[k]))),
                None => clip_ears(&plan, face, out),
            }
        }
    }
}

/// Normal of a polygon by Newell's sums; its length is twice the area of a plane one.
pub fn newell(points: &[DVec3], face: &[u32]) -> DVec3 {
    let origin = points[face[0] as usize];
    let corner = |k: usize| points[face[k % face.len()] as usize] - origin;
    (0..face.len()).map(|k| corner(k).cross(corner(k + 1))).sum()
}

/// Along the shorter diagonal; where the quad has a reflex corner, along the one that stays inside.
fn split_quad(points: &[DVec3], [a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    let normal = newell(points, &[a, b, c, d]);
    let over = |t: &[u32; 3]| newell(points, t).dot(normal) > FLAT * normal.length_squared();
    let [ac, bd] = [[[a, b, c], [a, c, d]], [[a, b, d], [b, c, d]]];
    let shorter = |p: u32, q: u32| points[p as usize].distance_squared(points[q as usize]);
    let (first, second) = if shorter(b, d) < shorter(a, c) { (bd, ac) } else { (ac, bd) };
    if !first.iter().all(over) && second.iter().all(over) { second } else { first }
}

fn clip_ears(plan: &[DVec2], face: &[u32], out: &mut Vec<[u32; 3]>) {
    let mut looks = 0;
    let mut left: Vec<usize> = (0..face.len()).collect();
    let mut at = 0;
    while left.len() > 3 {
        let n = left.len();
        let ear = (0..n).map(|k| (at + k) % n).find(|&k| {
            looks += n;
            looks <= MOST_LOOKS && is_ear(plan, &left, k)
        });
        if looks > MOST_LOOKS {
            break;
        }
        // A polygon that crosses itself may have none: the most open corner must do.
        let k = ear.unwrap_or_else(|| sharpest(plan, &left));
        out.push([(k + n - 1) % n, k, (k + 1) % n].map(|i| face[left[i]]));
        left.remove(k);
        // The next ear is sought one corner on, so that the triangles do not all meet in one place.
        at = (k + 1) % left.len();
    }
    // Three corners are left, or so many that it would take minutes to look at them any longer.
    out.extend((2..left.len()).map(|k| [left[0], left[k - 1], left[k]].map(|i| face[i])));
}

/// The polygon seen along its normal, scaled to an area of about one.
fn flatten(points: &[DVec3], face: &[u32]) -> Vec<DVec2> {
    let normal = newell(points, face);
    let n = normal.try_normalize().unwrap_or(DVec3::Z);
    let (x, y) = n.any_orthonormal_pair();
    let scale = 1.0 / normal.length().sqrt().max(f64::MIN_POSITIVE);
    let origin = points[face[0] as usize];
    face.iter()
        .map(|&v| {
            let p = (points[v as usize] - origin) * scale;
            DVec2::new(p.dot(x), p.dot(y))
        })
        .collect()
}

/// Twice the signed area of the corner k of what is left.
fn turn(plan: &[DVec2], left: &[usize], k: usize) -> f64 {
    let n = left.len();
    let [a, b, c] = [(k + n - 1) % n, k, (k + 1) % n].map(|i| plan[left[i]]);
    (b - a).perp_dot(c - b)
}

/// Whether corner k is convex and no other corner lies in its triangle.
fn is_ear(plan: &[DVec2], left: &[usize], k: usize) -> bool {
    if turn(plan, left, k) <= FLAT {
        return false;
    }
    let n = left.len();
    let own = [(k + n - 1) % n, k, (k + 1) % n];
    let [a, b, c] = own.map(|i| plan[left[i]]);
    // Where the polygon is cut open to a hole, other corners lie on these.
    let apart = |p: &DVec2| *p != a && *p != b && *p != c;
    !(0..n).filter(|i| !own.contains(i)).map(|i| plan[left[i]]).filter(apart).any(|p| {
        (b - a).perp_dot(p - a) >= 0.0
            && (c - b).perp_dot(p - b) >= 0.0
            && (a - c).perp_dot(p - c) >= 0.0
    })
}

fn sharpest(plan: &[DVec2], left: &[usize]) -> usize {
    (0..left.len())
        .fold(0, |best, k| if turn(plan, left, k) > turn(plan, left, best) { k } else { best })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangles of a plane polygon, each of them counter-clockwise, and their total area.
    fn area_of_split(outline: &[[f64; 2]]) -> f64 {
        let points: Vec<DVec3> = outline.iter().map(|p| DVec3::new(p[0], p[1], 0.0)).collect();
        let face: Vec<u32> = (0..points.len() as u32).collect();
        let mut triangles = Vec::new();
        split(&points, &face, &mut triangles);
        assert_eq!(triangles.len(), outline.len() - 2);
        let areas = triangles.iter().map(|t| newell(&points, t).z / 2.0);
        assert!(areas.clone().all(|a| a > 0.0), "{triangles:?}");
        areas.sum()
    }

    #[test]
    fn reflex_quad_is_split_inside_though_the_other_diagonal_is_shorter() {
        assert!(
            (area_of_split(&[[0.0, 0.0], [1.0, -1.0], [0.0, 10.0], [-1.0, -1.0]]) - 10.0).abs()
                < 1e-12
        );
    }

    #[test]
    fn comb_and_polygon_with_straight_corners_lose_no_area() {
        let comb = [
            [0.0, 0.0],
            [5.0, 0.0],
            [5.0, 4.0],
            [4.0, 1.0],
            [3.0, 4.0],
            [2.0, 1.0],
            [1.0, 4.0],
            [0.0, 1.0],
        ];
        let shoelace: f64 = (0..8)
            .map(|k| comb[k][0] * comb[(k + 1) % 8][1] - comb[(k + 1) % 8][0] * comb[k][1])
            .sum::<f64>()
            / 2.0;
        assert!((area_of_split(&comb) - shoelace).abs() < 1e-12);
        let square = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0]];
        assert!((area_of_split(&square) - 4.0).abs() < 1e-12);
    }

    #[test]
    fn polygon_without_ears_ends_all_the_same() {
        let points = vec![DVec3::ZERO; 7];
        let mut triangles = Vec::new();
        split(&points, &[0, 1, 2, 3, 4, 5, 6], &mut triangles);
        assert_eq!(triangles.len(), 5);
    }
}
