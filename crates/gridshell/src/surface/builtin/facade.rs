//! A free-form band of 650 x 240 x 33 m: eleven bicubic patches in a row, cut from one smooth surface, so
//! that neighbours share their edges exactly and join without a crease.

use super::known;
use super::sketch::{Sketch, against, along};
use super::spline::clamped_knots;
use crate::surface::exact::nurbs::NurbsCurve;
use crate::surface::{Brep, Shape};
use glam::DVec3;

const PATCHES: usize = 11;
/// Control points across the band.
const ACROSS: usize = 6;

/// Control points along the band, metres: x and y of the lower and of the upper edge, and the relief of
/// the middle. A uniform cubic: the band begins one and ends one control point in.
const STATIONS: [[f64; 5]; PATCHES + 3] = [
    [-70.0, -78.0, -52.0, 10.0, 5.5],
    [-4.0, -56.0, 4.0, 34.0, 11.0],
    [60.0, -26.0, 58.0, 78.0, 21.0],
    [122.0, -14.0, 112.0, 98.0, 30.5],
    [180.0, -30.0, 172.0, 96.0, 29.5],
    [236.0, -56.0, 236.0, 104.0, 18.5],
    [294.0, -66.0, 300.0, 118.0, 9.0],
    [352.0, -60.0, 360.0, 92.0, 5.5],
    [410.0, -70.0, 416.0, 50.0, 13.0],
    [464.0, -106.0, 472.0, 20.0, 25.5],
    [520.0, -138.0, 530.0, 12.0, 32.5],
    [580.0, -98.0, 588.0, 28.0, 29.5],
    [638.0, -54.0, 646.0, 46.0, 18.5],
    [696.0, -22.0, 704.0, 62.0, 10.0],
];

pub(super) fn brep() -> Brep {
    let mut sketch = Sketch::new("facade");
    let columns = columns();
    let vertices: Vec<[u32; 2]> = columns
        .iter()
        .step_by(3)
        .map(|c| [c[0], c[ACROSS - 1]].map(|p| sketch.vertex(p)))
        .collect();
    let seams: Vec<u32> = columns
        .iter()
        .step_by(3)
        .zip(&vertices)
        .map(|(column, &ends)| sketch.whole(across(column.to_vec()), ends))
        .collect();
    for k in 0..PATCHES {
        let net = &columns[3 * k..3 * k + 4];
        let row = |j: usize| {
            known::curve(
                3,
                clamped_knots(4, 0.0, 1.0),
                net.iter().map(|column| column[j]).collect(),
                Vec::new(),
            )
        };
        let lower = sketch.whole(row(0), [vertices[k][0], vertices[k + 1][0]]);
        let upper = sketch.whole(row(ACROSS - 1), [vertices[k][1], vertices[k + 1][1]]);
        let shape = known::surface(
            [3, 3],
            [clamped_knots(4, 0.0, 1.0), clamped_knots(ACROSS, 0.0, 1.0)],
            [4, ACROSS],
            net.as_flattened().to_vec(),
            Vec::new(),
        );
        let outline = vec![along(lower), along(seams[k + 1]), against(upper), against(seams[k])];
        sketch.face(Shape::Nurbs(shape), vec![outline]);
    }
    sketch.finish()
}

fn across(points: Vec<DVec3>) -> NurbsCurve {
    known::curve(3, clamped_knots(ACROSS, 0.0, 1.0), points, Vec::new())
}

/// Columns of Bézier control points along the band: patch k has columns 3k to 3k + 3.
fn columns() -> Vec<[DVec3; ACROSS]> {
    let net: Vec<[DVec3; ACROSS]> = STATIONS.iter().map(station).collect();
    let mix = |weights: [f64; 3], at: usize| -> [DVec3; ACROSS] {
        std::array::from_fn(|j| {
            net[at][j] * weights[0] + net[at + 1][j] * weights[1] + net[at + 2][j] * weights[2]
        })
    };
    let (knot, third) = ([1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0], [0.0, 2.0 / 3.0, 1.0 / 3.0]);
    let two_thirds = [0.0, 1.0 / 3.0, 2.0 / 3.0];
    let mut columns = vec![mix(knot, 0)];
    for k in 0..PATCHES {
        columns.extend([mix(third, k), mix(two_thirds, k), mix(knot, k + 1)]);
    }
    columns
}

/// Control points across the band at one station: a gentle bulge, lower along the lower edge.
fn station(&[lower_x, lower_y, upper_x, upper_y, relief]: &[f64; 5]) -> [DVec3; ACROSS] {
    let lower = DVec3::new(lower_x, lower_y, 0.15 * relief);
    let upper = DVec3::new(upper_x, upper_y, 0.4 * relief);
    // Greville abscissae and bulge of the six control points.
    let profile = [
        [0.0, 0.0],
        [1.0 / 9.0, 0.3],
        [1.0 / 3.0, 0.85],
        [2.0 / 3.0, 0.85],
        [8.0 / 9.0, 0.3],
        [1.0, 0.0],
    ];
    profile.map(|[f, bulge]| lower.lerp(upper, f) + DVec3::Z * (bulge * relief))
}
