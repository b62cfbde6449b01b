//! What the colours of a grid mean: the one place that sheets, reports and viewers have it from.

use super::drawing::Rgb;
use gridshell::degree::REGULAR;
use gridshell::design::Design;

/// What is shown by colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum Coloring {
    /// Members by length: blue is shorter than wanted, red longer.
    Length,
    /// Nodes by their number of members.
    Degree,
    /// Members by how much the lines bend at their ends.
    Disfluency,
    /// Panels by shape: how far from equilateral.
    Shape,
    /// No colours.
    None,
}

/// The colours of one grid.
pub struct Colours {
    /// None without colours.
    pub scale: Option<Scale>,
    /// Step of each member's colour; None for plain ones.
    pub members: Vec<Option<u8>>,
    /// Step of each panel's colour; None for plain ones.
    pub panels: Vec<Option<u8>>,
    /// Step of each node's colour; None for unmarked ones.
    pub nodes: Vec<Option<u8>>,
}

/// A scale of colours and what it stands for.
pub struct Scale {
    pub title: &'static str,
    pub steps: Vec<Rgb>,
    /// Where on the scale, from 0 to 1, and what is there.
    pub labels: Vec<(f64, String)>,
    /// How many elements have each step.
    pub counts: Vec<usize>,
}

/// Steps of scales of measured values.
const STEPS: usize = 13;
/// The colours of a scale's ends show what lies beyond them too: so many of a hundred values lie within.
const WITHIN: usize = 95;
/// A scale reaches at least this far from the wanted length, over it: less is no difference.
const LEAST_SPREAD: f64 = 0.01;
/// The scale of bends ends here at least, degrees.
const LEAST_BEND: f64 = 1.0;
/// The scale of shapes begins here at most: closer to 1 is no difference.
const LEAST_SHAPE: f64 = 0.95;

const SHORT: Rgb = [0.08, 0.30, 0.72];
const WANTED: Rgb = [0.72, 0.73, 0.74];
const LONG: Rgb = [0.80, 0.12, 0.10];
/// From smooth to bent lines, and from good to bad shapes.
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

impl Colours {
    /// The colours of this grid.
    pub fn new(coloring: Coloring, design: &Design) -> Colours {
        let schedule = &design.schedule;
        let mut colours = Colours {
            scale: None,
            members: vec![None; schedule.members.ends.len()],
            panels: vec![None; schedule.panels.nodes.len()],
            nodes: vec![None; schedule.nodes.xyz.len()],
        };
        match coloring {
            Coloring::None => {}
            Coloring::Length => colours.lengths(design),
            Coloring::Disfluency => colours.bends(design),
            Coloring::Shape => colours.shapes(design),
            Coloring::Degree => colours.degrees(design),
        }
        colours
    }

    /// The colour of a step.
    pub fn of(&self, step: Option<u8>) -> Option<Rgb> {
        self.scale.as_ref()?.steps.get(usize::from(step?)).copied()
    }

    fn lengths(&mut self, design: &Design) {
        let (lengths, wanted) = (&design.schedule.members.length, design.edge_length);
        let off = lengths.iter().map(|l| (l - wanted).abs());
        let half = most_within(off.collect()).clamp(LEAST_SPREAD * wanted, 0.9 * wanted);
        let steps = blended(&[SHORT, WANTED, LONG]);
        let digits = decimals(half);
        let label = |x: f64| format!("{x:.digits$}");
        let labels = [
            (0.0, format!("{} or less", label(wanted - half))),
            (0.5, label(wanted)),
            (1.0, format!("{} or more", label(wanted + half))),
        ];
        let place = |&l: &f64| Some(stepped((l - wanted + half) / (2.0 * half)));
        self.members = lengths.iter().map(place).collect();
        self.scale =
            Some(Scale::new("Length of members, m", steps, labels.to_vec(), &self.members));
    }

    fn bends(&mut self, design: &Design) {
        let bends = &design.schedule.members.bend_deg;
        let most = most_within(bends.iter().flatten().copied().collect()).max(LEAST_BEND);
        let steps = blended(&[SMOOTH, BENT, BROKEN]);
        let labels = [
            (0.0, "0".to_owned()),
            (0.5, format!("{:.1}", most / 2.0)),
            (1.0, format!("{most:.1} or more")),
        ];
        self.members = bends.iter().map(|b| b.map(|b| stepped(b / most))).collect();
        let title = "Angle disfluency: bend of the lines at a member's ends, deg";
        self.scale = Some(Scale::new(title, steps, labels.to_vec(), &self.members));
    }

    fn shapes(&mut self, design: &Design) {
        let shapes = &design.schedule.panels.shape;
        let off = most_within(shapes.iter().map(|q| 1.0 - q).collect());
        let from = (1.0 - off).min(LEAST_SHAPE);
        let steps = blended(&[BROKEN, BENT, EQUILATERAL]);
        let labels = [
            (0.0, format!("{from:.2} or less")),
            (0.5, format!("{:.2}", f64::midpoint(from, 1.0))),
            (1.0, "1".to_owned()),
        ];
        let place = |&q: &f64| Some(stepped((q - from) / (1.0 - from)));
        self.panels = shapes.iter().map(place).collect();
        let title = "Shape q of panels: 1 is equilateral";
        self.scale = Some(Scale::new(title, steps, labels.to_vec(), &self.panels));
    }

    fn degrees(&mut self, design: &Design) {
        let step = |&d: &i32| (d - REGULAR + 2).clamp(0, 4) as u8;
        self.nodes = design.schedule.nodes.adjusted_degree.iter().map(|d| Some(step(d))).collect();
        let names = ["4 or fewer", "5", "6", "7", "8 or more"];
        let labels = (0..5).map(|k| ((k as f64 + 0.5) / 5.0, names[k].to_owned())).collect();
        let title = "Members at nodes (at the border: with those that lack)";
        self.scale = Some(Scale::new(title, DEGREES.to_vec(), labels, &self.nodes));
    }
}

impl Scale {
    fn new(
        title: &'static str,
        steps: Vec<Rgb>,
        labels: Vec<(f64, String)>,
        of: &[Option<u8>],
    ) -> Scale {
        let mut counts = vec![0; steps.len()];
        for step in of.iter().flatten() {
            counts[usize::from(*step)] += 1;
        }
        Scale { title, steps, labels, counts }
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

/// Steps from the first colour over the second to the third.
fn blended(inks: &[Rgb; 3]) -> Vec<Rgb> {
    let step = |k: usize| {
        let x = 2.0 * k as f64 / (STEPS - 1) as f64;
        let (from, to, x) = if x <= 1.0 { (0, 1, x) } else { (1, 2, x - 1.0) };
        [0, 1, 2].map(|c| inks[from][c] + x * (inks[to][c] - inks[from][c]))
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

    #[test]
    fn one_long_member_does_not_take_the_colour_from_all_others() {
        let mut values = vec![0.1; 99];
        values.push(50.0);
        assert_eq!(most_within(values), 0.1);
        assert_eq!(most_within(Vec::new()), 0.0);
    }

    #[test]
    fn the_middle_of_a_scale_has_the_middle_colour() {
        let steps = blended(&[SHORT, WANTED, LONG]);
        for (share, ink) in [(0.5, WANTED), (-3.0, SHORT), (3.0, LONG)] {
            let step = steps[usize::from(stepped(share))];
            assert!((0..3).all(|c| (step[c] - ink[c]).abs() < 1e-12), "{share}: {step:?}");
        }
    }
}
