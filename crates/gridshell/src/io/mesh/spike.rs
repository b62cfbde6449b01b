//! A single vertex far away from all others: a number in the file is wrong, and a spike to it is not a roof.

use super::work::{Work, place};
use crate::error::{Error, Result};
use crate::surface::FARTHEST;
use glam::DVec3;

/// Meshes of fewer vertices say nothing about where a vertex belongs.
const FEWEST: usize = 6;

/// Refuse a mesh of which one vertex is far away from all others.
///
/// # Errors
/// [`Error::Surface`] with the vertex and one of its faces.
pub(super) fn check(work: &Work) -> Result<()> {
    let used = work.used();
    let all = || (0..used.len()).filter(|&v| used[v]).map(|v| (v, work.points[v]));
    if all().take(FEWEST).count() < FEWEST {
        return Ok(());
    }
    // The lowest and the highest vertex along each axis, and what the box would be without them.
    let ends =
        [0, 1, 2].map(|k| [1.0, -1.0].map(|sign| outermost(all().map(|(v, p)| (v, sign * p[k])))));
    for &(vertex, ..) in ends.iter().flatten() {
        let without = |k: usize| {
            let [low, high] =
                ends[k].map(|(v, first, second)| if v == vertex { second } else { first });
            [low, -high]
        };
        let low = DVec3::from([0, 1, 2].map(|k| without(k)[0]));
        let high = DVec3::from([0, 1, 2].map(|k| without(k)[1]));
        let (p, size) = (work.points[vertex], low.distance(high));
        let off = p.distance(p.clamp(low, high));
        if off > FARTHEST * size {
            let face = work.faces.iter().position(|f| f.contains(&(vertex as u32))).unwrap_or(0);
            return Err(Error::Surface(format!(
                "face {}: its vertex at {} is {:.0} times as far from all others as these are apart, so a number is \
                 most likely wrong; repair it in the program that made the file",
                work.number(face as u32),
                place(p),
                off / size
            )));
        }
    }
    Ok(())
}

/// The vertex of the lowest number, that number and the next one.
fn outermost(numbers: impl Iterator<Item = (usize, f64)>) -> (usize, f64, f64) {
    let mut best = (0, f64::INFINITY, f64::INFINITY);
    for (v, x) in numbers {
        if x < best.1 {
            best = (v, x, best.1);
        } else if x < best.2 {
            best.2 = x;
        }
    }
    best
}
