//! The paper's measures of this grid, each with what it means and how good and bad look.

use crate::picture::drawing::{Drawing, Rgb, Unit};
use crate::picture::svg;
use gridshell::design::Design;
use gridshell::math::trig;
use gridshell::stages::measure::Lengths;
use std::f64::consts::{FRAC_PI_2, TAU};

const SIZE: [f64; 2] = [150.0, 92.0];
const INK: Rgb = [0.25, 0.28, 0.32];
const GOOD: Rgb = [0.10, 0.48, 0.32];
const BAD: Rgb = [0.74, 0.12, 0.12];
const PAPER: Rgb = [1.0, 1.0, 1.0];
/// Height of an equilateral triangle over its side.
const HIGH: f64 = 0.866_025_403_784_438_6;

/// A measure as the page shows it.
struct Measure {
    name: &'static str,
    value: String,
    meaning: String,
    good: Option<Drawing>,
    bad: Option<Drawing>,
}

/// All measures.
pub fn section(design: &Design) -> String {
    let cards: String = all(design).iter().map(card).collect();
    format!("<section><h2>What makes it good</h2><div class=\"measures\">{cards}</div></section>")
}

fn card(measure: &Measure) -> String {
    let Measure { name, value, meaning, good, bad } = measure;
    let figure = |drawing: &Option<Drawing>, caption: &str| {
        drawing.as_ref().map_or(String::new(), |d| {
            format!("<figure>{}<figcaption>{caption}</figcaption></figure>", svg::encode(d))
        })
    };
    let pair = match good {
        None => String::new(),
        Some(_) => {
            format!("<div class=\"pair\">{}{}</div>", figure(good, "good"), figure(bad, "bad"))
        }
    };
    format!(
        "<div class=\"measure\"><h3><span>{name}</span><span>{value}</span></h3><p>{meaning}</p>{pair}</div>"
    )
}

fn all(design: &Design) -> Vec<Measure> {
    let q = &design.quality;
    let measure = |name, value, meaning: &str, good, bad| Measure {
        name,
        value,
        meaning: meaning.to_owned(),
        good: Some(good),
        bad: Some(bad),
    };
    let lengths = match q.lengths {
        Lengths::AsBuilt => {
            "standard deviation of the member lengths over their mean: 0 if all are alike."
        }
        Lengths::OverLocal => {
            "standard deviation of the member lengths over what is wanted where they are: 0 if all are as wanted."
        }
    };
    let fluency = q.fluency.map_or("&infin;".to_owned(), |x| format!("{x:.2}"));
    let off = 1e3 * design.edge_length;
    let share = design.schedule.figures.curvature_share;
    let share = share.map_or(String::new(), |s| {
        format!(" {:.0} % of the bending at regular nodes comes from the surface.", 100.0 * s)
    });
    vec![
        measure(
            "Fluency Q",
            fluency,
            "How calmly the lines of members flow over the surface, taken all together: regular nodes, lines that go \
             straight on. Larger is better.",
            lattice(|p| p),
            defect(5, |p| {
                [p[0] + 0.12 * trig::sin(5.0 * p[1]), p[1] + 0.1 * trig::sin(4.0 * p[0])]
            }),
        ),
        measure(
            "Length spread r",
            format!("{:.4}", q.edge_length.cv),
            &format!("How different members are: {lengths} Smaller is better."),
            lattice(|p| p),
            lattice(|p| [p[0] + 0.28 * trig::sin(1.9 * p[0]), p[1] + 0.22 * trig::sin(2.3 * p[1])]),
        ),
        measure(
            "Panel shape q",
            format!("{:.4}, least {:.3}", q.shape.mean, q.shape.min),
            "How near panels are to equilateral triangles: 1 is equilateral, 0 a sliver. Larger is better.",
            lattice(|p| p),
            lattice(|p| [0.8 * p[0] + 0.55 * p[1], 0.72 * p[1]]),
        ),
        measure(
            "Degree residual mu",
            format!("{:.3} (floor {:.3})", q.mu, q.mu_floor),
            "How far nodes are from having six members, on average; at the border, from as many as its angle asks for. \
             The floor is what the shape of the surface and its border demand. Smaller is better.",
            lattice(|p| p),
            defect(5, |p| p),
        ),
        measure(
            "Angle disfluency delta",
            format!("{:.2} deg (floor {:.2})", q.delta_deg, q.delta_floor_deg),
            &format!(
                "How much lines bend from member to member at regular nodes, on average. The floor is what the \
                 curvature of the surface demands.{share} Smaller is better."
            ),
            lattice(|p| p),
            lattice(|p| {
                let zigzag = if (p[1] / HIGH).round() as i64 % 2 == 0 { 0.17 } else { -0.17 };
                [p[0] + zigzag, p[1] + 0.12 * trig::sin(3.1 * p[0])]
            }),
        ),
        measure(
            "Regular share rho",
            format!("{:.3}", q.rho),
            "Weighted share of the nodes inside that are regular: 1 where all lines go through. Larger is better.",
            lattice(|p| p),
            defect(7, |p| p),
        ),
        Measure {
            name: "True to the surface",
            value: format!("{:.3} mm", off * q.surface_deviation),
            meaning: format!(
                "Farthest that a node is from the surface; at the border {:.3} mm from its edge. The panels have \
                 {:.2} % of its area: they cut the corners of its curves.",
                off * q.boundary_deviation,
                100.0 * q.area_ratio
            ),
            good: None,
            bad: None,
        },
    ]
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
