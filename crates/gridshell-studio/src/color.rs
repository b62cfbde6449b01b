//! What grids are colored by: a value for every member, panel or node.

use crate::frame::Frame;
use crate::message::{Coloring, Scale, Shows};
use axum::body::Bytes;
use glam::DVec3;
use gridshell::degree::{REGULAR, adjusted_degree};
use gridshell::grid::Grid;
use gridshell::merit;
use gridshell::surface::{Locator, Surface};

/// Shares of the values left out at the scale's ends, so that single ones do not wash out the rest.
const TAIL: f64 = 0.01;

/// A way to color, with what the page is told of it.
struct Way {
    told: [&'static str; 4],
    on: &'static str,
}

const WAYS: [Way; 6] = [
    Way { told: ["length", "Length", "m", "Length of each member."], on: "members" },
    Way {
        told: ["degree", "Degree", "", "Adjusted degree of each node; 6 is regular."],
        on: "nodes",
    },
    Way {
        told: [
            "disfluency",
            "Disfluency",
            "°",
            "Angle fluency index of each regular node inside: 0 where lines run straight.",
        ],
        on: "nodes",
    },
    Way {
        told: ["shape", "Panel shape", "", "Shape q of each panel: 1 is equilateral."],
        on: "panels",
    },
    Way {
        told: ["fold", "Fold", "°", "Angle between the panels on both sides of each member."],
        on: "members",
    },
    Way {
        told: [
            "deviation",
            "Deviation",
            "mm",
            "Distance of the middle of each panel from the surface.",
        ],
        on: "panels",
    },
];

/// All ways.
pub fn colorings() -> Vec<Coloring> {
    let told = |w: &Way| {
        let [name, label, unit, help] = w.told.map(str::to_owned);
        Coloring { name, label, unit, help }
    };
    WAYS.iter().map(told).collect()
}

/// The values that `grid` is colored by, as a frame; None for an unknown way.
pub fn frame(run: u32, grid: &Grid, surface: &Surface, by: &str) -> Option<Bytes> {
    let way = WAYS.iter().find(|w| w.told[0] == by)?;
    let values = values(grid, surface, by);
    let [name, label, unit, _] = way.told.map(str::to_owned);
    let scale = Scale {
        by: name,
        label,
        unit,
        on: way.on.into(),
        range: range(by, &values),
        extent: extent(&values),
        whole: by == "degree",
    };
    let frame = Frame::new(Shows::Colors, run).scaled(scale);
    Some(frame.floats("values", values.into_iter()).bytes())
}

/// A value for each member, panel or node; NaN where there is none.
pub fn values(grid: &Grid, surface: &Surface, by: &str) -> Vec<f64> {
    let mesh = &grid.mesh;
    let at = |v: u32| grid.xyz[v as usize];
    let mut nodes = vec![f64::NAN; grid.xyz.len()];
    match by {
        "length" => mesh.edges().map(|(a, b)| grid.length(a, b)).collect(),
        "degree" => {
            for v in mesh.vertices() {
                nodes[v as usize] = f64::from(adjusted_degree(mesh, &grid.xyz, v));
            }
            nodes
        }
        "disfluency" => {
            for v in mesh.vertices() {
                if !mesh.is_boundary(v) && mesh.degree(v) as i32 == REGULAR {
                    nodes[v as usize] = merit::delta(grid, v).to_degrees();
                }
            }
            nodes
        }
        "shape" => mesh.triangles().map(|t| merit::shape(t.map(at))).collect(),
        "fold" => mesh.edges().map(|(a, b)| fold_deg(grid, a, b)).collect(),
        _ => deviation_mm(grid, surface),
    }
}

/// Angle between the panels beside a member, degrees; NaN on the boundary.
fn fold_deg(grid: &Grid, a: u32, b: u32) -> f64 {
    let (Some(l), Some(r)) = (grid.mesh.left(a, b), grid.mesh.right(a, b)) else { return f64::NAN };
    let [a, b, l, r] = [a, b, l, r].map(|v| grid.xyz[v as usize]);
    let normals = [(b - a).cross(l - a), (r - a).cross(b - a)];
    gridshell::math::trig::angle(normals[0], normals[1]).to_degrees()
}

fn deviation_mm(grid: &Grid, surface: &Surface) -> Vec<f64> {
    let locator = Locator::new(surface);
    let off = |t: [u32; 3]| {
        let middle = t.map(|v| grid.xyz[v as usize]).iter().sum::<DVec3>() / 3.0;
        locator.nearest(middle).map_or(f64::NAN, |p| 1e3 * surface.deviation(&p, middle))
    };
    grid.mesh.triangles().map(off).collect()
}

fn extent(values: &[f64]) -> [f64; 2] {
    let known = values.iter().copied().filter(|x| x.is_finite());
    known
        .fold(None, |e: Option<[f64; 2]>, x| {
            Some(e.map_or([x, x], |[lo, hi]| [lo.min(x), hi.max(x)]))
        })
        .unwrap_or([0.0, 1.0])
}

/// The scale's ends: all but the tails, and what a scale of this kind begins with.
fn range(by: &str, values: &[f64]) -> [f64; 2] {
    let mut known: Vec<f64> = values.iter().copied().filter(|x| x.is_finite()).collect();
    if by == "degree" {
        return [4.0, 8.0];
    }
    if known.is_empty() {
        return [0.0, 1.0];
    }
    known.sort_unstable_by(f64::total_cmp);
    let at = |share: f64| known[((known.len() - 1) as f64 * share).round() as usize];
    let [low, high] = match by {
        "shape" => [at(TAIL), 1.0],
        "length" => [at(TAIL), at(1.0 - TAIL)],
        _ => [0.0, at(1.0 - TAIL)],
    };
    if high - low > 1e-9 * high.abs().max(1e-9) { [low, high] } else { [low - 0.5, high + 0.5] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measures::tests::square;

    #[test]
    fn every_way_has_a_value_for_each_of_what_it_is_on() {
        let (grid, surface) = square();
        for way in &WAYS {
            let count = match way.on {
                "members" => grid.mesh.edge_count(),
                "panels" => grid.mesh.face_count(),
                _ => grid.xyz.len(),
            };
            assert_eq!(values(&grid, &surface, way.told[0]).len(), count, "{}", way.told[0]);
        }
        assert!(frame(1, &grid, &surface, "taste").is_none());
    }

    #[test]
    fn plane_panels_fold_by_nothing_and_right_angles_have_their_shape() {
        let (grid, surface) = square();
        let folds = values(&grid, &surface, "fold");
        assert!(folds.iter().all(|f| f.is_nan() || f.abs() < 1e-6), "{folds:?}");
        // A right isosceles triangle: 4 sqrt(3) A over the sum of squares, 2 sqrt(3) / 4.
        let shape = values(&grid, &surface, "shape")[0];
        assert!((shape - 3f64.sqrt() / 2.0).abs() < 1e-12, "{shape}");
    }
}
