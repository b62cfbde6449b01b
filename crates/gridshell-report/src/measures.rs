//! The measures of a grid, each with its name, unit, digits and meaning: the one place that sheets, pages, comparisons
//! and the studio have them from.

use gridshell::design::Design;
use gridshell::schedule::Figures;
use gridshell::stages::measure::Quality;
use gridshell::structure::Structure;

/// A measure of grids.
pub struct Measure {
    /// Its name in programs.
    pub key: &'static str,
    /// What it belongs to.
    pub group: Group,
    /// Its name for people, with its symbol.
    pub name: &'static str,
    /// Unit, or empty.
    pub unit: &'static str,
    /// Digits behind the point.
    pub digits: usize,
    /// Which of two values is better.
    pub better: Better,
    /// What it is, in a sentence or two.
    pub meaning: &'static str,
    /// Whether anything but 0 tells of something wrong.
    pub is_fault: bool,
    value: fn(&Known) -> Option<f64>,
    floor: Option<fn(&Known) -> f64>,
    within: Option<fn(&Known) -> Option<String>>,
}

/// What lengths of a group differ by at most.
const BY_LENGTH: Option<fn(&Known) -> Option<String>> =
    Some(|k| Some(format!("within {:.1} mm", 1e3 * k.figures?.length_tolerance)));
/// What angles at alike nodes differ by at most.
const BY_ANGLE: Option<fn(&Known) -> Option<String>> =
    Some(|k| Some(format!("within {} deg", k.figures?.angle_tolerance_deg)));

/// Headings that measures stand under.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// How much there is of it.
    Size,
    /// How lines flow.
    Fluency,
    /// Member lengths.
    Lengths,
    /// Shapes of panels.
    Panels,
    /// Angles at nodes.
    Nodes,
    /// What an architect sees first.
    Boundary,
    /// Whether it is the surface.
    Fit,
}

/// Which of two values is the better one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Better {
    /// The smaller one.
    Less,
    /// The larger one.
    More,
    /// It says nothing of good and bad.
    Neither,
}

/// What is known of a grid. Lengths in metres.
#[derive(Clone, Copy)]
pub struct Known<'a> {
    /// Its measures.
    pub quality: &'a Quality,
    /// What its schedules come to; without them some measures have no value.
    pub figures: Option<&'a Figures>,
    /// What lengths are measured against.
    pub edge_length: f64,
    /// What members and panels are made of; without it they have no mass.
    pub structure: Option<&'a Structure>,
}

impl<'a> Known<'a> {
    /// All of a design.
    pub fn of(design: &'a Design) -> Known<'a> {
        Known {
            quality: &design.quality,
            figures: Some(&design.schedule.figures),
            edge_length: design.edge_length,
            structure: Some(&design.structure),
        }
    }
}

impl Measure {
    /// The measure of this key.
    ///
    /// # Panics
    /// Where there is none: keys are written in code.
    pub fn named(key: &str) -> &'static Measure {
        ALL.iter().find(|m| m.key == key).unwrap_or_else(|| panic!("there is no measure `{key}`"))
    }

    /// Its value; infinite for the fluency of a perfect lattice, None where what it needs is not known.
    pub fn value(&self, known: &Known) -> Option<f64> {
        (self.value)(known)
    }

    /// Its value as it is read, without its unit.
    pub fn text(&self, known: &Known) -> Option<String> {
        self.value(known).map(|x| self.written(x))
    }

    /// What it cannot fall below, as it is read.
    pub fn floor(&self, known: &Known) -> Option<String> {
        self.floor.map(|floor| self.written(floor(known)))
    }

    /// Its value with unit, floor, and what it holds for: a tolerance, or what was assumed.
    pub fn full_text(&self, known: &Known) -> Option<String> {
        let mut text = self.text(known)?;
        if !self.unit.is_empty() {
            text += " ";
            text += self.unit;
        }
        if let Some(floor) = self.floor(known) {
            text += &format!(" (floor {floor})");
        }
        if let Some(within) = self.within.and_then(|within| within(known)) {
            text += " ";
            text += &within;
        }
        Some(text)
    }

    /// What two grids are ranked by, smaller is better; None where neither is.
    pub fn rank(&self, known: &Known) -> Option<f64> {
        match self.better {
            Better::Less => self.value(known),
            Better::More => self.value(known).map(|x| -x),
            Better::Neither => None,
        }
    }

    /// What it is, and which way is better.
    pub fn help(&self) -> String {
        let way = match self.better {
            Better::Less if !self.is_fault => " Smaller is better.",
            Better::More => " Larger is better.",
            _ => "",
        };
        format!("{}{way}", self.meaning)
    }

    /// Its name as a heading.
    pub fn title(&self) -> String {
        let mut letters = self.name.chars();
        letters.next().map_or(String::new(), |first| {
            first.to_uppercase().collect::<String>() + letters.as_str()
        })
    }

    fn written(&self, x: f64) -> String {
        if x.is_infinite() { "infinite".to_owned() } else { format!("{x:.*}", self.digits) }
    }
}

impl Group {
    /// As a heading.
    pub fn title(self) -> &'static str {
        match self {
            Group::Size => "Size",
            Group::Fluency => "Fluency",
            Group::Lengths => "Lengths",
            Group::Panels => "Panels",
            Group::Nodes => "Nodes",
            Group::Boundary => "Boundary",
            Group::Fit => "Fit to the surface",
        }
    }
}

/// All measures, in the order that people get them in.
pub const ALL: &[Measure] = &[
    Measure {
        key: "nodes",
        group: Group::Size,
        name: "nodes",
        unit: "",
        digits: 0,
        better: Better::Neither,
        meaning: "Joints of the members.",
        value: |k| Some(k.quality.nodes as f64),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "members",
        group: Group::Size,
        name: "members",
        unit: "",
        digits: 0,
        better: Better::Neither,
        meaning: "Straight pieces from node to node.",
        value: |k| Some(k.quality.members as f64),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "panels",
        group: Group::Size,
        name: "panels",
        unit: "",
        digits: 0,
        better: Better::Neither,
        meaning: "Triangles between three members.",
        value: |k| Some(k.quality.panels as f64),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "total_length",
        group: Group::Size,
        name: "all members together",
        unit: "m",
        digits: 1,
        better: Better::Neither,
        meaning: "Sum of the member lengths.",
        value: |k| k.figures.map(|f| f.length.total),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "total_area",
        group: Group::Size,
        name: "all panels together",
        unit: "m2",
        digits: 1,
        better: Better::Neither,
        meaning: "Sum of the panel areas.",
        value: |k| k.figures.map(|f| f.panel.total_area),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "member_mass",
        group: Group::Size,
        name: "mass of members",
        unit: "kg",
        digits: 0,
        better: Better::Neither,
        meaning: "All members in the section and material that files are written with, from node to node; joints come on top.",
        value: |k| Some(k.structure?.member_mass(k.figures?.length.total)),
        floor: None,
        is_fault: false,
        within: Some(|k| Some(format!("({})", k.structure?.section.name))),
    },
    Measure {
        key: "pane_mass",
        group: Group::Size,
        name: "mass of panes",
        unit: "kg",
        digits: 0,
        better: Better::Neither,
        meaning: "All panels as glass of the thickness that files are written with, up to the axes of the members.",
        value: |k| Some(k.structure?.pane_mass(k.figures?.panel.total_area)),
        floor: None,
        is_fault: false,
        within: Some(|k| Some(format!("({} mm)", k.structure?.pane_mm))),
    },
    Measure {
        key: "fluency",
        group: Group::Fluency,
        name: "fluency Q",
        unit: "",
        digits: 2,
        better: Better::More,
        meaning: "How calmly the lines of members flow over the surface, taken all together (Eq. 31): regular nodes, lines that go straight on.",
        value: |k| Some(k.quality.fluency.unwrap_or(f64::INFINITY)),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "mu",
        group: Group::Fluency,
        name: "degree residual mu",
        unit: "",
        digits: 4,
        better: Better::Less,
        meaning: "How far nodes are from having six members, on average (Eq. 27); on the boundary, from as many as its angle asks for. The floor is what the shape of the surface and its boundary demand.",
        value: |k| Some(k.quality.mu),
        floor: Some(|k| k.quality.mu_floor),
        is_fault: false,
        within: None,
    },
    Measure {
        key: "delta_deg",
        group: Group::Fluency,
        name: "angle disfluency delta",
        unit: "deg",
        digits: 2,
        better: Better::Less,
        meaning: "How much lines bend from member to member at regular nodes, on average (Eq. 30). The floor is what the curvature of the surface demands.",
        value: |k| Some(k.quality.delta_deg),
        floor: Some(|k| k.quality.delta_floor_deg),
        is_fault: false,
        within: None,
    },
    Measure {
        key: "rho",
        group: Group::Fluency,
        name: "regular share rho",
        unit: "",
        digits: 3,
        better: Better::More,
        meaning: "Weighted share of the interior nodes that are regular (Eq. 32): 1 where all lines go through.",
        value: |k| Some(k.quality.rho),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "irregular_interior",
        group: Group::Fluency,
        name: "irregular nodes inside",
        unit: "",
        digits: 0,
        better: Better::Less,
        meaning: "Interior nodes with more or fewer than six members.",
        value: |k| Some(k.quality.irregular.interior as f64),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "irregular_boundary",
        group: Group::Fluency,
        name: "irregular nodes on the boundary",
        unit: "",
        digits: 0,
        better: Better::Less,
        meaning: "Boundary nodes with more or fewer members than the angle of the boundary asks for.",
        value: |k| Some(k.quality.irregular.boundary as f64),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "edge_length",
        group: Group::Lengths,
        name: "wanted member length",
        unit: "m",
        digits: 3,
        better: Better::Neither,
        meaning: "What lengths are measured against.",
        value: |k| Some(k.edge_length),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "mean_length",
        group: Group::Lengths,
        name: "mean member length",
        unit: "m",
        digits: 3,
        better: Better::Neither,
        meaning: "Mean length of the members.",
        value: |k| Some(k.quality.edge_length.mean),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "min_length",
        group: Group::Lengths,
        name: "shortest member",
        unit: "m",
        digits: 3,
        better: Better::Neither,
        meaning: "Least length of a member.",
        value: |k| Some(k.quality.edge_length.min),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "max_length",
        group: Group::Lengths,
        name: "longest member",
        unit: "m",
        digits: 3,
        better: Better::Neither,
        meaning: "Greatest length of a member.",
        value: |k| Some(k.quality.edge_length.max),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "cv",
        group: Group::Lengths,
        name: "length spread r",
        unit: "",
        digits: 4,
        better: Better::Less,
        meaning: "Standard deviation of the member lengths over their mean (Eq. 24), or over what is wanted where they are: 0 if all are alike.",
        value: |k| Some(k.quality.edge_length.cv),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "length_groups",
        group: Group::Lengths,
        name: "different member lengths",
        unit: "",
        digits: 0,
        better: Better::Less,
        meaning: "Groups of members whose lengths differ by no more than the length tolerance.",
        value: |k| k.figures.map(|f| f.length.groups as f64),
        floor: None,
        is_fault: false,
        within: BY_LENGTH,
    },
    Measure {
        key: "shape",
        group: Group::Panels,
        name: "mean panel shape q",
        unit: "",
        digits: 4,
        better: Better::More,
        meaning: "How near panels are to equilateral triangles (Eq. 25): 1 is equilateral, 0 a sliver.",
        value: |k| Some(k.quality.shape.mean),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "min_shape",
        group: Group::Panels,
        name: "least panel shape q",
        unit: "",
        digits: 3,
        better: Better::More,
        meaning: "Shape of the worst panel.",
        value: |k| Some(k.quality.shape.min),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "min_angle_deg",
        group: Group::Panels,
        name: "least angle of a panel",
        unit: "deg",
        digits: 1,
        better: Better::More,
        meaning: "Least angle between two members of a panel.",
        value: |k| Some(k.quality.min_angle_deg),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "distinct_panels",
        group: Group::Panels,
        name: "different panels",
        unit: "",
        digits: 0,
        better: Better::Less,
        meaning: "Kinds of panels within the length tolerance; a panel and its mirror image differ.",
        value: |k| k.figures.map(|f| f.panel.distinct as f64),
        floor: None,
        is_fault: false,
        within: BY_LENGTH,
    },
    Measure {
        key: "distinct_nodes",
        group: Group::Nodes,
        name: "different nodes",
        unit: "",
        digits: 0,
        better: Better::Less,
        meaning: "Kinds of nodes within the angle tolerance.",
        value: |k| k.figures.map(|f| f.distinct_nodes as f64),
        floor: None,
        is_fault: false,
        within: BY_ANGLE,
    },
    Measure {
        key: "fold_deg",
        group: Group::Nodes,
        name: "greatest fold",
        unit: "deg",
        digits: 2,
        better: Better::Less,
        meaning: "Greatest angle between neighbouring panels.",
        value: |k| k.figures.map(|f| f.fold_deg.max),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "twist_deg",
        group: Group::Nodes,
        name: "greatest twist",
        unit: "deg",
        digits: 2,
        better: Better::Less,
        meaning: "Greatest twist of the nodes along a member.",
        value: |k| k.figures.map(|f| f.twist_deg.max),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "border_shape",
        group: Group::Boundary,
        name: "mean panel shape q at the boundary",
        unit: "",
        digits: 4,
        better: Better::More,
        meaning: "Mean shape of the panels at the boundary.",
        value: |k| Some(k.quality.border.shape_mean),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "border_cv",
        group: Group::Boundary,
        name: "length spread r at the boundary",
        unit: "",
        digits: 4,
        better: Better::Less,
        meaning: "Length spread of the members at the boundary.",
        value: |k| Some(k.quality.border.edge_length_cv),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "area_ratio",
        group: Group::Fit,
        name: "area over that of the surface",
        unit: "",
        digits: 4,
        better: Better::Neither,
        meaning: "Area of the panels over that of the surface: they cut the corners of its curves.",
        value: |k| Some(k.quality.area_ratio),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "surface_deviation",
        group: Group::Fit,
        name: "off the surface",
        unit: "mm",
        digits: 3,
        better: Better::Less,
        meaning: "Farthest that a node is from the surface.",
        value: |k| Some(1e3 * k.edge_length * k.quality.surface_deviation),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "boundary_deviation",
        group: Group::Fit,
        name: "off the boundary",
        unit: "mm",
        digits: 3,
        better: Better::Less,
        meaning: "Farthest that a boundary node is from the boundary.",
        value: |k| Some(1e3 * k.edge_length * k.quality.boundary_deviation),
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "direction_deviation_deg",
        group: Group::Fit,
        name: "off the direction",
        unit: "deg",
        digits: 1,
        better: Better::Less,
        meaning: "Mean angle between the wanted direction and the nearest member.",
        value: |k| k.quality.direction_deviation_deg,
        floor: None,
        is_fault: false,
        within: None,
    },
    Measure {
        key: "folded_panels",
        group: Group::Fit,
        name: "folded panels",
        unit: "",
        digits: 0,
        better: Better::Less,
        meaning: "Panels that lie folded back; there should be none.",
        value: |k| Some(k.quality.folded_panels as f64),
        floor: None,
        is_fault: true,
        within: None,
    },
    Measure {
        key: "bridging_members",
        group: Group::Fit,
        name: "bridging members",
        unit: "",
        digits: 0,
        better: Better::Less,
        meaning: "Members that leap from one sheet of the surface to another; there should be none.",
        value: |k| Some(k.quality.bridging_members as f64),
        floor: None,
        is_fault: true,
        within: None,
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use gridshell::DVec3;
    use gridshell::grid::Grid;
    use gridshell::math::trig;
    use gridshell::recipe;
    use gridshell::stages::measure::measure;
    use std::collections::BTreeSet;

    #[test]
    fn every_measure_has_a_key_and_a_name_of_its_own() {
        let keys: BTreeSet<_> = ALL.iter().map(|m| m.key).collect();
        let names: BTreeSet<_> = ALL.iter().map(|m| m.name).collect();
        assert_eq!((keys.len(), names.len()), (ALL.len(), ALL.len()));
        assert!(ALL.iter().all(|m| m.meaning.ends_with('.')));
    }

    /// A perfect lattice, a hexagon of six panels, has no finite fluency.
    #[test]
    fn an_infinite_fluency_is_written_and_ranks_first() {
        let corner = |k: u32| {
            let angle = std::f64::consts::FRAC_PI_3 * f64::from(k);
            DVec3::new(trig::cos(angle), trig::sin(angle), 0.0)
        };
        let points = std::iter::once(DVec3::ZERO).chain((0..6).map(corner)).collect();
        let panels: Vec<[u32; 3]> = (0..6).map(|k| [0, 1 + k, 1 + (k + 1) % 6]).collect();
        let (grid, surface) = Grid::alone("hexagon", points, &panels).unwrap();
        let quality = measure(&grid, &surface, 1.0, &recipe::Measure::default());
        let known = Known { quality: &quality, figures: None, edge_length: 1.0, structure: None };
        let fluency = Measure::named("fluency");
        assert_eq!(fluency.full_text(&known).as_deref(), Some("infinite"));
        assert_eq!(fluency.rank(&known), Some(f64::NEG_INFINITY));
        assert_eq!(Measure::named("fold_deg").text(&known), None, "schedules were not made");
    }
}
