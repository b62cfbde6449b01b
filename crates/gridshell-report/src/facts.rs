//! The figures of a grid in the order and the words that people get them in: on sheets, in reports, side by side.

use gridshell::design::Design;

/// One figure.
pub struct Fact {
    pub name: &'static str,
    /// As it is written, with its unit.
    pub value: String,
    /// What it is ranked by, if that makes sense.
    pub rank: Option<Rank>,
}

/// Which of two figures is the better one.
#[derive(Clone, Copy)]
pub enum Rank {
    Less(f64),
    More(f64),
}

impl Rank {
    /// Smaller is better.
    pub fn key(self) -> f64 {
        match self {
            Rank::Less(x) => x,
            Rank::More(x) => -x,
        }
    }
}

/// All figures of a grid.
pub fn facts(design: &Design) -> Vec<Fact> {
    let (q, f) = (&design.quality, &design.schedule.figures);
    let mut facts = Facts(Vec::new());
    facts.count("nodes", q.nodes);
    facts.count("members", q.members);
    facts.count("panels", q.panels);
    facts.plain("wanted member length", format!("{:.3} m", design.edge_length));
    let l = &f.length.spread;
    facts.plain("mean member length", format!("{:.3} m", l.mean));
    facts.plain("members from", format!("{:.3} to {:.3} m", l.min, l.max));
    facts.plain("all members together", format!("{:.1} m", f.length.total));
    facts.plain("all panels together", format!("{:.1} m2", f.panel.total_area));
    let fluency = q.fluency.unwrap_or(f64::INFINITY);
    let text = q.fluency.map_or("infinite".to_owned(), |x| format!("{x:.2}"));
    facts.more("fluency Q", fluency, text);
    facts.less("length spread r", q.edge_length.cv, format!("{:.4}", q.edge_length.cv));
    facts.more("mean panel shape q", q.shape.mean, format!("{:.4}", q.shape.mean));
    facts.more("least panel shape q", q.shape.min, format!("{:.3}", q.shape.min));
    let mu = format!("{:.3} (floor {:.3})", q.mu, q.mu_floor);
    facts.less("degree residual mu", q.mu, mu);
    let delta = format!("{:.2} deg (floor {:.2})", q.delta_deg, q.delta_floor_deg);
    facts.less("angle disfluency delta", q.delta_deg, delta);
    let irregular = q.irregular.interior as f64;
    facts.less("irregular nodes inside", irregular, q.irregular.interior.to_string());
    let irregular = q.irregular.boundary as f64;
    facts.less("irregular nodes at the border", irregular, q.irregular.boundary.to_string());
    let millimetres = 1e3 * f.length_tolerance;
    let within = |n: usize| format!("{n} within {millimetres:.1} mm");
    facts.less("different member lengths", f.length.groups as f64, within(f.length.groups));
    facts.less("different panels", f.panel.distinct as f64, within(f.panel.distinct));
    let nodes = format!("{} within {} deg", f.distinct_nodes, f.angle_tolerance_deg);
    facts.less("different nodes", f.distinct_nodes as f64, nodes);
    let (least, greatest) = (f.angle_deg.min, f.angle_deg.max);
    facts.more("angles of panels", least, format!("{least:.1} to {greatest:.1} deg"));
    facts.less("greatest fold", f.fold_deg.max, format!("{:.2} deg", f.fold_deg.max));
    facts.less("greatest twist", f.twist_deg.max, format!("{:.2} deg", f.twist_deg.max));
    facts.plain("area over the surface's", format!("{:.4}", q.area_ratio));
    let off = q.surface_deviation * design.edge_length * 1e3;
    facts.plain("off the surface", format!("{off:.3} mm at most"));
    facts.0
}

struct Facts(Vec<Fact>);

impl Facts {
    fn plain(&mut self, name: &'static str, value: String) {
        self.0.push(Fact { name, value, rank: None });
    }

    fn count(&mut self, name: &'static str, n: usize) {
        self.plain(name, n.to_string());
    }

    fn less(&mut self, name: &'static str, x: f64, value: String) {
        self.0.push(Fact { name, value, rank: Some(Rank::Less(x)) });
    }

    fn more(&mut self, name: &'static str, x: f64, value: String) {
        self.0.push(Fact { name, value, rank: Some(Rank::More(x)) });
    }
}
