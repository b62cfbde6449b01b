//! The paper's measures of this grid, each with what it means and how good and bad look.

use crate::measures::{Known, Measure};
use crate::picture::drawing::{Drawing, Rgb, Unit};
use crate::picture::svg;
use gridshell::design::Design;
use gridshell::math::trig;
use std::f64::consts::{FRAC_PI_2, TAU};

const SIZE: [f64; 2] = [150.0, 92.0];
const INK: Rgb = [0.25, 0.28, 0.32];
const GOOD: Rgb = [0.10, 0.48, 0.32];
const BAD: Rgb = [0.74, 0.12, 0.12];
const PAPER: Rgb = [1.0, 1.0, 1.0];
/// Height of an equilateral triangle over its side.
const HIGH: f64 = 0.866_025_403_784_438_6;

/// How good and bad look by a measure.
type Pair = [Drawing; 2];

/// The measures that are drawn, each with a good and a bad grid.
fn drawn_measures() -> [(&'static str, Pair); 6] {
    let good = || lattice(|p| p);
    [
        (
            "fluency",
            [
                good(),
                defect(5, |p| {
                    [p[0] + 0.12 * trig::sin(5.0 * p[1]), p[1] + 0.1 * trig::sin(4.0 * p[0])]
                }),
            ],
        ),
        (
            "cv",
            [
                good(),
                lattice(|p| {
                    [p[0] + 0.28 * trig::sin(1.9 * p[0]), p[1] + 0.22 * trig::sin(2.3 * p[1])]
                }),
            ],
        ),
        ("shape", [good(), lattice(|p| [0.8 * p[0] + 0.55 * p[1], 0.72 * p[1]])]),
        ("mu", [good(), defect(5, |p| p)]),
        (
            "delta_deg",
            [
                good(),
                lattice(|p| {
                    let zigzag = if (p[1] / HIGH).round() as i64 % 2 == 0 { 0.17 } else { -0.17 };
                    [p[0] + zigzag, p[1] + 0.12 * trig::sin(3.1 * p[0])]
                }),
            ],
        ),
        ("rho", [good(), defect(7, |p| p)]),
    ]
}

/// The measures that make a grid good, and how true it is to its surface.
pub fn section(design: &Design) -> String {
    let known = Known::of(design);
    let mut cards = String::new();
    for (key, pair) in drawn_measures() {
        let measure = Measure::named(key);
        let mut meaning = measure.help();
        if let ("delta_deg", Some(share)) = (key, design.schedule.figures.curvature_share) {
            meaning += &format!(
                " {:.0} % of the bending at regular nodes comes from the surface.",
                100.0 * share
            );
        }
        cards += &card(measure, &known, &meaning, Some(&pair));
    }
    for key in ["surface_deviation", "boundary_deviation", "area_ratio"] {
        let measure = Measure::named(key);
        cards += &card(measure, &known, &measure.help(), None);
    }
    format!("<section><h2>What makes it good</h2><div class=\"measures\">{cards}</div></section>")
}

fn card(measure: &Measure, known: &Known, meaning: &str, pair: Option<&Pair>) -> String {
    let figure = |drawing: &Drawing, caption: &str| {
        format!("<figure>{}<figcaption>{caption}</figcaption></figure>", svg::encode(drawing))
    };
    let pair = pair.map_or(String::new(), |[good, bad]| {
        format!("<div class=\"pair\">{}{}</div>", figure(good, "good"), figure(bad, "bad"))
    });
    let value = measure.full_text(known).unwrap_or_default();
    format!(
        "<div class=\"measure\"><h3><span>{}</span><span>{value}</span></h3><p>{meaning}</p>{pair}</div>",
        measure.title()
    )
}

/// A piece of a lattice, its nodes moved; unit members.
fn lattice(moved: impl Fn([f64; 2]) -> [f64; 2]) -> Drawing {
    let at = |i: i32, j: i32| {
        moved([f64::from(i) + 0.5 * f64::from(j.rem_euclid(2)), HIGH * f64::from(j)])
    };
    let mut lines = Vec::new();
    for j in -4i32..=4 {
        for i in -6i32..=6 {
            let shift = j.rem_euclid(2);
            lines.push([at(i, j), at(i + 1, j)]);
            lines.push([at(i, j), at(i + shift, j + 1)]);
            lines.push([at(i, j), at(i + shift - 1, j + 1)]);
        }
    }
    let bad = moved([0.3, 0.4]) != [0.3, 0.4];
    drawn(&lines, None, if bad { BAD } else { GOOD })
}

/// Rings about a node of this many members.
fn defect(members: usize, moved: impl Fn([f64; 2]) -> [f64; 2]) -> Drawing {
    let at = |ring: usize, k: usize| {
        if ring == 0 {
            return moved([0.0, 0.0]);
        }
        let corner = |c: usize| {
            let angle = FRAC_PI_2 + TAU * (c % members) as f64 / members as f64;
            [ring as f64 * trig::cos(angle), ring as f64 * trig::sin(angle)]
        };
        let (from, to) = (corner(k / ring % members), corner(k / ring + 1));
        let share = (k % ring) as f64 / ring as f64;
        moved([0, 1].map(|i| from[i] + share * (to[i] - from[i])))
    };
    let mut lines = Vec::new();
    for ring in 1..=5 {
        for k in 0..ring * members {
            lines.push([at(ring, k), at(ring, k + 1)]);
            // Inwards to the node or nodes before it on the smaller ring.
            let (side, step) = (k / ring, k % ring);
            let inner = |step: usize| at(ring - 1, side * (ring - 1) + step);
            if step < ring {
                lines.push([at(ring, k), inner(step.min(ring.saturating_sub(1)))]);
            }
            if step > 0 {
                lines.push([at(ring, k), inner(step - 1)]);
            }
        }
    }
    drawn(&lines, Some(moved([0.0, 0.0])), BAD)
}

/// The lines within the picture, the node marked.
fn drawn(lines: &[[[f64; 2]; 2]], node: Option<[f64; 2]>, rgb: Rgb) -> Drawing {
    let mut drawing = Drawing::new(SIZE, Unit::Pixel, String::new());
    let scale = 26.0;
    let place = |p: [f64; 2]| [SIZE[0] / 2.0 + scale * p[0], SIZE[1] / 2.0 - scale * p[1]];
    let inside = |p: &[f64; 2]| (0..2).all(|k| (0.0..=SIZE[k]).contains(&p[k]));
    for ends in lines {
        let ends = ends.map(place);
        if ends.iter().all(inside) {
            drawing.line(ends.to_vec(), 1.6, rgb);
        }
    }
    if let Some(node) = node {
        drawing.disc(place(node), 4.5, PAPER, INK);
    }
    drawing
}
