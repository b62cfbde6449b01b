//! Built-in surfaces, exact and analytic, by name. Metres.

mod barrel;
mod conic;
mod dome;
mod facade;
mod great_court;
mod hexagon;
mod known;
mod roof;
mod saddle;
mod sketch;
mod sphere;
mod spline;
mod torus;

use super::{Brep, Model};

/// One built-in surface.
#[derive(Clone, Copy, Debug)]
pub struct Builtin {
    /// Name on the command line.
    pub name: &'static str,
    /// What it is, in one line.
    pub description: &'static str,
    /// A sensible edge length l0, metres.
    pub edge_length: f64,
    build: fn() -> Brep,
}

/// All built-in surfaces; the first one is the default of the command.
pub const ALL: &[Builtin] = &[
    Builtin {
        name: "great-court",
        description: "roof of the British Museum Great Court, 73 x 97 m, after C. J. K. Williams",
        edge_length: 2.12,
        build: great_court::brep,
    },
    Builtin {
        name: "hexagon",
        description: "plane regular hexagon of side 4 m: 61 nodes are the perfect lattice",
        edge_length: 1.0,
        build: hexagon::brep,
    },
    Builtin {
        name: "dome",
        description: "hemisphere of radius 10 m",
        edge_length: 1.0,
        build: dome::brep,
    },
    Builtin {
        name: "saddle",
        description: "saddle over a square of 30 m, with a round hole",
        edge_length: 1.0,
        build: saddle::brep,
    },
    Builtin {
        name: "barrel",
        description: "cylindrical vault, 30 x 20 m with a rise of 6 m",
        edge_length: 1.0,
        build: barrel::brep,
    },
    Builtin {
        name: "torus",
        description: "closed torus of radii 10 and 4 m",
        edge_length: 1.0,
        build: torus::brep,
    },
    Builtin {
        name: "sphere",
        description: "closed sphere of radius 10 m",
        edge_length: 1.0,
        build: sphere::brep,
    },
    Builtin {
        name: "roof",
        description: "free-form roof, 78 x 39 x 12 m, with two voids and an open notch",
        edge_length: 3.1,
        build: roof::brep,
    },
    Builtin {
        name: "facade",
        description: "free-form band of 11 joined patches, 650 x 240 x 33 m",
        edge_length: 24.4,
        build: facade::brep,
    },
];

/// The built-in surface of this name.
pub fn model(name: &str) -> Option<Model> {
    ALL.iter().find(|b| b.name == name).map(|b| Model::Brep((b.build)()))
}

#[cfg(test)]
mod tests;
