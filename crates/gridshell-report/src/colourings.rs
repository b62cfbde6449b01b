//! What grids are coloured by, in one table: sheets, pages, the studio and the command have their colourings from here.
//! A new one is a line in [`ALL`] and the function that works out its values.

use crate::picture::drawing::Rgb;
use crate::picture::svg::hex;
use gridshell::DVec3;
use gridshell::degree::{REGULAR, adjusted_degree};
use gridshell::design::Design;
use gridshell::grid::Grid;
use gridshell::math::trig;
use gridshell::merit;
use gridshell::schedule::groups_within;
use gridshell::surface::{Locator, Surface};

/// A way to colour grids.
pub struct Colouring {
    /// Its name in messages, pages and on the command line.
    pub key: &'static str,
    /// For people.
    pub label: &'static str,
    /// Unit, or empty.
    pub unit: &'static str,
    /// One sentence of help.
    pub help: &'static str,
    /// What is coloured.
    pub on: Element,
    /// The colours from one end of the scale to the other.
    ramp: &'static [Rgb],
    rule: Rule,
    values: fn(&Subject) -> Vec<f64>,
}

/// Kinds of elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Element {
    /// Members.
    Members,
    /// Nodes.
    Nodes,
    /// Panels.
    Panels,
}

impl Element {
    /// As messages and scripts know it.
    pub fn name(self) -> &'static str {
        match self {
            Element::Members => "members",
            Element::Nodes => "nodes",
            Element::Panels => "panels",
        }
    }
}

/// How a scale comes from the values.
enum Rule {
    /// As far below as above the wanted length.
    AboutLength,
    /// From nothing, up to at least this.
    FromZero { least: f64 },
    /// Up to 1, from at most this.
    ToOne { most: f64 },
    /// A colour of its own for this whole number and those that follow it; the last ones stand for what lies beyond.
    Counts { first: i32 },
    /// A colour for each group from 0; they come again where there are more groups than colours.
    Groups,
}

/// All of them, in the order in which people are offered them.
pub static ALL: [Colouring; 7] = [
    Colouring {
        key: "length",
        label: "Member length",
        unit: "m",
        help: "Members by length: grey is as wanted, blue shorter, red longer.",
        on: Element::Members,
        ramp: &[SHORT, WANTED, LONG],
        rule: Rule::AboutLength,
        values: |s| s.lengths(),
    },
    Colouring {
        key: "degree",
        label: "Node degree",
        unit: "",
        help: "Nodes by their number of members, those at the border with the ones that lack there: 6 is regular.",
        on: Element::Nodes,
        ramp: &DEGREES,
        rule: Rule::Counts { first: REGULAR - 2 },
        values: degrees,
    },
    Colouring {
        key: "disfluency",
        label: "Angle disfluency",
        unit: "deg",
        help: "Regular nodes inside by how much the lines bend there: 0 where they run straight.",
        on: Element::Nodes,
        ramp: &[SMOOTH, BENT, BROKEN],
        rule: Rule::FromZero { least: LEAST_ANGLE },
        values: bends,
    },
    Colouring {
        key: "shape",
        label: "Panel shape",
        unit: "",
        help: "Panels by their shape q: 1 is equilateral.",
        on: Element::Panels,
        ramp: &[BROKEN, BENT, EQUILATERAL],
        rule: Rule::ToOne { most: LEAST_SHAPE },
        values: shapes,
    },
    Colouring {
        key: "fold",
        label: "Member fold",
        unit: "deg",
        help: "Members by the angle between the panels on both sides.",
        on: Element::Members,
        ramp: &[SMOOTH, BENT, BROKEN],
        rule: Rule::FromZero { least: LEAST_ANGLE },
        values: folds,
    },
    Colouring {
        key: "deviation",
        label: "Panel deviation",
        unit: "mm",
        help: "Panels by how far their middle is from the surface.",
        on: Element::Panels,
        ramp: &[SMOOTH, BENT, BROKEN],
        rule: Rule::FromZero { least: LEAST_DEVIATION },
        values: deviations,
    },
    Colouring {
        key: "group",
        label: "Member group",
        unit: "",
        help: "Members by group: those of one group are made alike; neighbouring lengths have unlike colours.",
        on: Element::Members,
        ramp: &GROUPS,
        rule: Rule::Groups,
        values: groups,
    },
];

/// Steps of scales of measured values: few enough to be told apart in a legend, and an odd number, so that there is a
/// middle one.
const STEPS: usize = 13;
/// The colours of a scale's ends show what lies beyond them too: so many of a hundred values lie within. More, and single
/// values wash out the rest; fewer, and what is extreme cannot be told from what is common.
const WITHIN: usize = 95;
/// A scale reaches at least this far from the wanted length, over it: less is no difference.
const LEAST_SPREAD: f64 = 0.01;
/// A scale reaches at most this far from the wanted length, over it: no member is shorter than nothing.
const MOST_SPREAD: f64 = 0.9;
/// Scales of angles end here at least, degrees: less is not seen.
const LEAST_ANGLE: f64 = 1.0;
/// The scale of deviations ends here at least, millimetres: nothing is built to less.
const LEAST_DEVIATION: f64 = 0.1;
/// The scale of shapes begins here at most: closer to 1 is no difference.
const LEAST_SHAPE: f64 = 0.95;

const SHORT: Rgb = [0.08, 0.30, 0.72];
const WANTED: Rgb = [0.72, 0.73, 0.74];
const LONG: Rgb = [0.80, 0.12, 0.10];
/// From good to bad.
const SMOOTH: Rgb = [0.74, 0.78, 0.80];
const BENT: Rgb = [0.93, 0.58, 0.12];
const BROKEN: Rgb = [0.55, 0.02, 0.16];
const EQUILATERAL: Rgb = [0.93, 0.95, 0.96];
/// Of nodes with two and one too few members, a regular number, one and two too many.
const DEGREES: [Rgb; 5] = [
    [0.05, 0.18, 0.50],
    [0.25, 0.55, 0.90],
    [0.72, 0.73, 0.74],
    [0.96, 0.60, 0.15],
    [0.72, 0.08, 0.12],
];
/// Of groups, so that any two near each other in the list are told apart.
const GROUPS: [Rgb; 12] = [
    [0.12, 0.47, 0.71],
    [1.00, 0.50, 0.05],
    [0.17, 0.63, 0.17],
    [0.84, 0.15, 0.16],
    [0.58, 0.40, 0.74],
    [0.80, 0.74, 0.10],
    [0.09, 0.75, 0.81],
    [0.89, 0.47, 0.76],
    [0.55, 0.34, 0.29],
    [0.60, 0.87, 0.54],
    [0.10, 0.20, 0.45],
    [0.98, 0.75, 0.50],
];

/// The colouring of this key.
pub fn of(key: &str) -> Option<&'static Colouring> {
    ALL.iter().find(|c| c.key == key)
}

/// A grid to be coloured, with its elements in the order in which colours are wanted.
pub struct Subject<'a> {
    /// The grid.
    pub grid: &'a Grid,
    /// What it lies on.
    pub surface: &'a Surface,
    /// The nodes of its members.
    pub members: Vec<[u32; 2]>,
    /// The nodes of its panels.
    pub panels: Vec<[u32; 3]>,
    /// The length that was wanted, metres.
    pub edge_length: f64,
    /// Members of a group differ in length by at most this, metres.
    pub length_tolerance: f64,
}

impl<'a> Subject<'a> {
    /// A design, in the order of its schedules.
    pub fn of(design: &'a Design) -> Subject<'a> {
        Subject {
            grid: &design.grid,
            surface: &design.surface,
            members: design.schedule.members.ends.clone(),
            panels: design.schedule.panels.nodes.clone(),
            edge_length: design.edge_length,
            length_tolerance: design.schedule.figures.length_tolerance,
        }
    }

    /// A grid that comes from a design, in the order of its mesh: edits may have left gaps among the nodes.
    pub fn edited(design: &'a Design, grid: &'a Grid, surface: &'a Surface) -> Subject<'a> {
        Subject {
            grid,
            surface,
            members: grid.mesh.edges().map(|(a, b)| [a, b]).collect(),
            panels: grid.mesh.triangles().collect(),
            edge_length: design.edge_length,
            length_tolerance: design.schedule.figures.length_tolerance,
        }
    }

    fn lengths(&self) -> Vec<f64> {
        self.members.iter().map(|&[a, b]| self.grid.length(a, b)).collect()
    }

    /// A value for each node in use; NaN for the others and where there is none.
    fn at_nodes(&self, value: impl Fn(u32) -> Option<f64>) -> Vec<f64> {
        let mut values = vec![f64::NAN; self.grid.xyz.len()];
        for v in self.grid.mesh.vertices() {
            values[v as usize] = value(v).unwrap_or(f64::NAN);
        }
        values
    }

    fn at(&self, v: u32) -> DVec3 {
        self.grid.xyz[v as usize]
    }
}

fn degrees(s: &Subject) -> Vec<f64> {
    s.at_nodes(|v| Some(f64::from(adjusted_degree(&s.grid.mesh, &s.grid.xyz, v))))
}

fn bends(s: &Subject) -> Vec<f64> {
    let mesh = &s.grid.mesh;
    let regular = |v: u32| !mesh.is_boundary(v) && mesh.degree(v) == REGULAR as usize;
    s.at_nodes(|v| regular(v).then(|| merit::delta(s.grid, v).to_degrees()))
}

fn shapes(s: &Subject) -> Vec<f64> {
    s.panels.iter().map(|t| merit::shape(t.map(|v| s.at(v)))).collect()
}

/// NaN on the boundary.
fn folds(s: &Subject) -> Vec<f64> {
    let fold = |&[a, b]: &[u32; 2]| {
        let (left, right) = (s.grid.mesh.left(a, b)?, s.grid.mesh.right(a, b)?);
        let [a, b, left, right] = [a, b, left, right].map(|v| s.at(v));
        let normals = [(b - a).cross(left - a), (right - a).cross(b - a)];
        Some(trig::angle(normals[0], normals[1]).to_degrees())
    };
    s.members.iter().map(|ends| fold(ends).unwrap_or(f64::NAN)).collect()
}

fn deviations(s: &Subject) -> Vec<f64> {
    let locator = Locator::new(s.surface);
    let off = |t: &[u32; 3]| {
        let middle = t.map(|v| s.at(v)).iter().sum::<DVec3>() / 3.0;
        locator.nearest(middle).map_or(f64::NAN, |p| 1e3 * s.surface.deviation(&p, middle))
    };
    s.panels.iter().map(off).collect()
}

/// Numbers as in the schedules: 0 is the group of the shortest.
fn groups(s: &Subject) -> Vec<f64> {
    groups_within(&s.lengths(), s.length_tolerance).into_iter().map(f64::from).collect()
}

/// The steps of a scale.
struct Steps {
    /// The step of a value.
    place: Box<dyn Fn(f64) -> u8>,
    inks: Vec<Rgb>,
    /// What stands where, from 0 to 1.
    labels: Vec<(f64, String)>,
}

impl Colouring {
    /// The value of each element that is coloured; NaN where it has none.
    pub fn values(&self, subject: &Subject) -> Vec<f64> {
        (self.values)(subject)
    }

    /// The colours of a grid.
    pub fn colours(&self, subject: &Subject) -> Colours {
        let values = self.values(subject);
        let known: Vec<f64> = values.iter().copied().filter(|x| x.is_finite()).collect();
        let Steps { place, inks, labels } = match self.rule {
            Rule::AboutLength => {
                let wanted = subject.edge_length;
                let half = most_within(known.iter().map(|l| (l - wanted).abs()).collect())
                    .clamp(LEAST_SPREAD * wanted, MOST_SPREAD * wanted);
                self.measured([wanted - half, wanted + half], [" or less", " or more"])
            }
            Rule::FromZero { least } => {
                self.measured([0.0, most_within(known.clone()).max(least)], ["", " or more"])
            }
            Rule::ToOne { most } => {
                let off = most_within(known.iter().map(|q| 1.0 - q).collect());
                self.measured([(1.0 - off).min(most), 1.0], [" or less", ""])
            }
            Rule::Counts { first } => {
                let last = self.ramp.len() - 1;
                let label = |k: usize| {
                    let beyond = match k {
                        0 => " or fewer",
                        k if k == last => " or more",
                        _ => "",
                    };
                    (in_middle(k, last + 1), format!("{}{beyond}", first + k as i32))
                };
                let place = move |x: f64| (x - f64::from(first)).clamp(0.0, last as f64) as u8;
                Steps {
                    place: Box::new(place),
                    inks: self.ramp.to_vec(),
                    labels: (0..=last).map(label).collect(),
                }
            }
            Rule::Groups => {
                let count = known.iter().copied().fold(0.0, f64::max) as usize + 1;
                let inks = &self.ramp[..count.min(self.ramp.len())];
                let labels = (0..inks.len()).map(|k| (in_middle(k, inks.len()), k.to_string()));
                let colours = inks.len();
                let place = move |x: f64| (x as usize % colours) as u8;
                Steps { place: Box::new(place), inks: inks.to_vec(), labels: labels.collect() }
            }
        };
        let steps: Vec<Option<u8>> =
            values.iter().map(|&x| x.is_finite().then(|| place(x))).collect();
        let mut counts = vec![0; inks.len()];
        for step in steps.iter().flatten() {
            counts[usize::from(*step)] += 1;
        }
        let note = self.note(&known);
        Colours {
            on: self.on,
            scale: Scale { title: self.title(), inks, labels, counts, note },
            steps,
        }
    }

    /// Label and unit.
    pub fn title(&self) -> String {
        match self.unit {
            "" => self.label.to_owned(),
            unit => format!("{}, {unit}", self.label),
        }
    }

    /// The steps of a scale between these values.
    fn measured(&self, [low, high]: [f64; 2], beyond: [&str; 2]) -> Steps {
        let digits = decimals((high - low) / 2.0);
        let labels = [
            (0.0, format!("{low:.digits$}{}", beyond[0])),
            (0.5, format!("{:.digits$}", f64::midpoint(low, high))),
            (1.0, format!("{high:.digits$}{}", beyond[1])),
        ];
        let place = move |x: f64| stepped((x - low) / (high - low));
        Steps { place: Box::new(place), inks: blended(self.ramp), labels: labels.to_vec() }
    }

    /// What the scale does not tell of the values.
    fn note(&self, known: &[f64]) -> String {
        let least = known.iter().copied().fold(f64::INFINITY, f64::min);
        let most = known.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        match self.rule {
            Rule::Counts { .. } => String::new(),
            _ if known.is_empty() => "no values".to_owned(),
            Rule::Groups if most < self.ramp.len() as f64 => "group 0: the shortest".to_owned(),
            Rule::Groups => {
                let (last, colours) = (most, self.ramp.len());
                format!("0 (the shortest) to {last}: group {colours} has the colour of 0 again")
            }
            _ => {
                let digits = decimals((most - least) / 2.0);
                format!("all: {least:.digits$} to {most:.digits$}")
            }
        }
    }
}

/// The colours of one grid.
pub struct Colours {
    on: Element,
    /// What they stand for.
    pub scale: Scale,
    /// Step of each coloured element's colour; None for those without.
    pub steps: Vec<Option<u8>>,
}

impl Colours {
    /// The colours of a design.
    pub fn new(colouring: &Colouring, design: &Design) -> Colours {
        colouring.colours(&Subject::of(design))
    }

    /// The step of this element; None where it has no colour.
    pub fn step(&self, element: Element, k: usize) -> Option<u8> {
        if self.on == element { self.steps[k] } else { None }
    }

    /// The colour of this element.
    pub fn of(&self, element: Element, k: usize) -> Option<Rgb> {
        Some(self.scale.inks[usize::from(self.step(element, k)?)])
    }

    /// Whether nodes are what is coloured.
    pub fn on_nodes(&self) -> bool {
        self.on == Element::Nodes
    }

    /// Whether every node has a colour, so that none is black or white for its degree.
    pub fn all_nodes(&self) -> bool {
        self.on_nodes() && self.steps.iter().all(Option::is_some)
    }
}

/// A scale of colours and what it stands for.
pub struct Scale {
    /// What is shown, with its unit.
    pub title: String,
    /// The colours of the steps.
    pub inks: Vec<Rgb>,
    /// Where on the scale, from 0 to 1, and what is there.
    pub labels: Vec<(f64, String)>,
    /// How many elements have each step.
    pub counts: Vec<usize>,
    /// What else to know, or empty.
    pub note: String,
}

impl Scale {
    /// The colours as style sheets have them.
    pub fn hexes(&self) -> Vec<String> {
        self.inks.iter().map(hex).collect()
    }
}

/// The value that so many of the values do not exceed; 0 without any.
fn most_within(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let k = (values.len() * WITHIN / 100).min(values.len().saturating_sub(1));
    values.get(k).copied().unwrap_or(0.0)
}

/// The step at this share of the scale.
fn stepped(share: f64) -> u8 {
    (share.clamp(0.0, 1.0) * (STEPS - 1) as f64).round() as u8
}

/// The middle of step `k` of so many, from 0 to 1.
fn in_middle(k: usize, steps: usize) -> f64 {
    (k as f64 + 0.5) / steps as f64
}

/// Steps from the first colour over those between to the last.
fn blended(ramp: &[Rgb]) -> Vec<Rgb> {
    let step = |k: usize| {
        let x = (ramp.len() - 1) as f64 * k as f64 / (STEPS - 1) as f64;
        let from = (x as usize).min(ramp.len() - 2);
        let x = x - from as f64;
        [0, 1, 2].map(|c| ramp[from][c] + x * (ramp[from + 1][c] - ramp[from][c]))
    };
    (0..STEPS).map(step).collect()
}

/// Decimals that tell a half scale of this size apart.
fn decimals(half: f64) -> usize {
    (0..6).find(|&d| half * 10f64.powi(d) >= 10.0).unwrap_or(6) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two by two squares of side 1 in the plane, each cut by a diagonal.
    fn square() -> (Grid, Surface) {
        let points = (0..9).map(|k| DVec3::new(f64::from(k % 3), f64::from(k / 3), 0.0)).collect();
        let cell = |v: u32| [[v, v + 1, v + 4], [v, v + 4, v + 3]];
        let panels: Vec<[u32; 3]> = [0, 1, 3, 4].into_iter().flat_map(cell).collect();
        Grid::alone("square", points, &panels).unwrap()
    }

    /// What `look` makes of the square.
    fn with_square<T>(look: impl Fn(&Subject) -> T) -> T {
        let (grid, surface) = square();
        look(&Subject {
            grid: &grid,
            surface: &surface,
            members: grid.mesh.edges().map(|(a, b)| [a, b]).collect(),
            panels: grid.mesh.triangles().collect(),
            edge_length: 1.0,
            length_tolerance: 0.005,
        })
    }

    #[test]
    fn every_colouring_has_a_key_of_its_own_and_a_value_for_each_element() {
        with_square(|square| {
            for c in &ALL {
                let count = match c.on {
                    Element::Members => 16,
                    Element::Nodes => 9,
                    Element::Panels => 8,
                };
                let colours = c.colours(square);
                assert_eq!(colours.steps.len(), count, "{}", c.key);
                let coloured = colours.steps.iter().flatten().count();
                assert_eq!(colours.scale.counts.iter().sum::<usize>(), coloured, "{}", c.key);
                assert!(std::ptr::eq(of(c.key).unwrap(), c), "{}", c.key);
            }
        });
        assert!(of("taste").is_none());
    }

    #[test]
    fn plane_panels_lie_on_their_plane_without_folds_and_right_angles_have_their_shape() {
        with_square(|square| {
            let folds = folds(square);
            assert_eq!(folds.iter().filter(|f| f.is_finite()).count(), 8);
            assert!(folds.iter().all(|f| f.is_nan() || f.abs() < 1e-6), "{folds:?}");
            assert!(deviations(square).iter().all(|d| d.abs() < 1e-9));
            // A right isosceles triangle: 4 sqrt(3) A over the sum of squares, 2 sqrt(3) / 4.
            assert!((shapes(square)[0] - 3f64.sqrt() / 2.0).abs() < 1e-12);
        });
    }

    #[test]
    fn members_of_the_wanted_length_are_grey_and_diagonals_red() {
        with_square(|square| {
            let colours = of("length").unwrap().colours(square);
            for (k, length) in square.lengths().into_iter().enumerate() {
                let ink = colours.of(Element::Members, k).unwrap();
                let wanted = if length > 1.1 { LONG } else { WANTED };
                assert!((0..3).all(|c| (ink[c] - wanted[c]).abs() < 1e-12), "{length}: {ink:?}");
            }
            assert_eq!(colours.of(Element::Panels, 0), None);
        });
    }

    #[test]
    fn sides_are_one_group_and_diagonals_another_and_a_thirteenth_group_has_the_first_colour() {
        let group = of("group").unwrap();
        with_square(|square| {
            let colours = group.colours(square);
            for (step, length) in colours.steps.iter().zip(square.lengths()) {
                assert_eq!(*step, Some(u8::from(length > 1.1)), "{length}");
            }
            assert_eq!(colours.scale.counts, [12, 4]);
            // Without any tolerance and with every member of another length.
            let mut grid = square.grid.clone();
            for (k, p) in grid.xyz.iter_mut().enumerate() {
                *p *= 1.0 + 0.1 * (k * k) as f64;
            }
            let (members, panels) = (square.members.clone(), square.panels.clone());
            let (surface, edge_length) = (square.surface, square.edge_length);
            let uneven = Subject {
                grid: &grid,
                surface,
                members,
                panels,
                edge_length,
                length_tolerance: 0.0,
            };
            let (values, colours) = (group.values(&uneven), group.colours(&uneven));
            assert!(values.contains(&12.0), "{values:?}");
            for (value, step) in values.iter().zip(&colours.steps) {
                assert_eq!(step.map(f64::from), Some(value % 12.0));
            }
        });
    }

    #[test]
    fn one_long_member_does_not_take_the_colour_from_all_others() {
        let mut values = vec![0.1; 99];
        values.push(50.0);
        assert_eq!(most_within(values), 0.1);
        assert_eq!(most_within(Vec::new()), 0.0);
    }
}
