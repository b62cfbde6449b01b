//! Triangles without area, whose third corner lies on their longest edge. Nothing can walk over them, so that
//! edge is flipped; on the boundary, where the corner then takes the edge's place, the triangle goes.

use glam::DVec3;
use std::collections::{HashMap, HashSet};

/// A triangle is flat when its height is below this share of its longest edge.
const FLAT: f64 = 1e-9;
/// Rounds of flips; flat triangles side by side take a round each.
const ROUNDS: usize = 32;

/// Rid `triangles` of flat ones where that leaves a manifold.
pub(in crate::surface) fn flatten(points: &[DVec3], triangles: &mut Vec<[u32; 3]>) {
    for _ in 0..ROUNDS {
        let flat: Vec<usize> =
            (0..triangles.len()).filter(|&t| is_flat(points, triangles[t])).collect();
        if flat.is_empty() || !round(points, triangles, &flat) {
            return;
        }
    }
}

fn is_flat(points: &[DVec3], triangle: [u32; 3]) -> bool {
    let [a, b, c] = longest_first(points, triangle).map(|v| points[v as usize]);
    (b - a).cross(c - a).length() <= FLAT * (b - a).length_squared()
}

/// The triangle turned so that its longest edge comes first.
fn longest_first(points: &[DVec3], t: [u32; 3]) -> [u32; 3] {
    let length = |k: usize| points[t[k] as usize].distance_squared(points[t[(k + 1) % 3] as usize]);
    let longest = (1..3).fold(0, |best, k| if length(k) > length(best) { k } else { best });
    [0, 1, 2].map(|k| t[(longest + k) % 3])
}

/// Treat the triangles `flat`; whether anything changed.
fn round(points: &[DVec3], triangles: &mut Vec<[u32; 3]>, flat: &[usize]) -> bool {
    let mut left_of: HashMap<(u32, u32), usize> = HashMap::new();
    for (t, c) in triangles.iter().enumerate() {
        for k in 0..3 {
            left_of.insert((c[k], c[(k + 1) % 3]), t);
        }
    }
    let mut rim = vec![false; points.len()];
    for c in triangles.iter() {
        for k in 0..3 {
            let (a, b) = (c[k], c[(k + 1) % 3]);
            if !left_of.contains_key(&(b, a)) {
                (rim[a as usize], rim[b as usize]) = (true, true);
            }
        }
    }
    let mut touched = vec![false; triangles.len()];
    let mut gone = vec![false; triangles.len()];
    let mut joined: HashSet<(u32, u32)> = HashSet::new();
    for &t in flat {
        let [a, b, c] = longest_first(points, triangles[t]);
        let Some(&other) = left_of.get(&(b, a)) else {
            // A corner on the boundary would be left alone, or part its fan in two.
            let around = [left_of.get(&(c, b)), left_of.get(&(a, c))];
            let [Some(&p), Some(&q)] = around else { continue };
            if !rim[c as usize] && ![t, p, q].iter().any(|&t| touched[t]) {
                (gone[t], rim[c as usize]) = (true, true);
                for t in [t, p, q] {
                    touched[t] = true;
                }
            }
            continue;
        };
        let apex = triangles[other].into_iter().find(|&v| v != a && v != b);
        let Some(d) = apex.filter(|_| !touched[t] && !touched[other]) else { continue };
        let new = (c.min(d), c.max(d));
        if left_of.contains_key(&(c, d)) || left_of.contains_key(&(d, c)) || joined.contains(&new) {
            continue;
        }
        joined.insert(new);
        (touched[t], touched[other]) = (true, true);
        (triangles[t], triangles[other]) = ([a, d, c], [d, b, c]);
    }
    let mut t = 0;
    triangles.retain(|_| {
        t += 1;
        !gone[t - 1]
    });
    touched.contains(&true)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flat_triangles_are_flipped_inside_and_dropped_on_the_rim() {
        let points = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0], [1.0, -1.0]]
            .map(|[x, y]| DVec3::new(x, y, 0.0));
        // Corner 2 lies on the edge from 0 to 1.
        let mut inside = vec![[0, 1, 2], [0, 2, 3], [2, 1, 3], [1, 0, 4]];
        flatten(&points, &mut inside);
        assert_eq!(inside.len(), 4);
        assert!(inside.iter().all(|&t| !is_flat(&points, t)), "{inside:?}");
        let mut rim = vec![[0, 1, 2], [0, 2, 3], [2, 1, 3]];
        flatten(&points, &mut rim);
        assert_eq!(rim, [[0, 2, 3], [2, 1, 3]]);
    }
}
