//! Built-in surfaces, exact and analytic, by name. Metres.

mod barrel;
mod cone;
mod conic;
mod dome;
mod facade;
mod fold;
mod great_court;
mod hexagon;
mod known;
mod onion;
mod pleats;
mod pyramid;
mod quilt;
mod ramp;
mod ribbon;
mod ring;
mod roof;
mod saddle;
mod sail;
mod sketch;
mod skylights;
mod sphere;
mod spline;
mod torus;
mod tower;
mod tripod;
mod vault;
mod wave;

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
    Builtin {
        name: "fold",
        description: "two parallel sheets of 10 x 12 m, 0.4 m apart, joined by a bend",
        edge_length: 1.0,
        build: fold::brep,
    },
    Builtin {
        name: "ribbon",
        description: "long S-shaped vault, 126 m along its middle and 8 m wide",
        edge_length: 1.2,
        build: ribbon::brep,
    },
    Builtin {
        name: "ramp",
        description: "spiral ramp of one and a half turns, 4 m wide",
        edge_length: 0.7,
        build: ramp::brep,
    },
    Builtin {
        name: "skylights",
        description: "shallow oval dome, 40 x 26 m, with five round skylights",
        edge_length: 1.0,
        build: skylights::brep,
    },
    Builtin {
        name: "tripod",
        description: "shell on three sharp points, 16 m from its middle to each",
        edge_length: 0.8,
        build: tripod::brep,
    },
    Builtin {
        name: "sail",
        description: "hypar sail between two high and two low sharp points, 24 x 24 m",
        edge_length: 0.9,
        build: sail::brep,
    },
    Builtin {
        name: "wave",
        description: "free-form roof with an irregular L-shaped outline, 56 x 31 m",
        edge_length: 1.5,
        build: wave::brep,
    },
    Builtin {
        name: "ring",
        description: "torus of radii 10 and 4 m with a doorway",
        edge_length: 1.25,
        build: ring::brep,
    },
    Builtin {
        name: "cone",
        description: "truncated cone, open at the top, 28 m wide and 6 m high",
        edge_length: 1.0,
        build: cone::brep,
    },
    Builtin {
        name: "tower",
        description: "hyperboloid, 18 m wide at its foot and 22 m high",
        edge_length: 1.0,
        build: tower::brep,
    },
    Builtin {
        name: "onion",
        description: "onion dome, overhanging, 17 m high",
        edge_length: 1.0,
        build: onion::brep,
    },
    Builtin {
        name: "pleats",
        description: "folded-plate roof of six plates, 18 x 24 m",
        edge_length: 1.0,
        build: pleats::brep,
    },
    Builtin {
        name: "pyramid",
        description: "pyramid roof over a square of 16 m",
        edge_length: 0.9,
        build: pyramid::brep,
    },
    Builtin {
        name: "vault",
        description: "groin vault over a square of 16 m",
        edge_length: 0.8,
        build: vault::brep,
    },
];

/// The built-in surface of this name.
pub fn model(name: &str) -> Option<Model> {
    ALL.iter().find(|b| b.name == name).map(|b| Model::Brep((b.build)()))
}

#[cfg(test)]
mod tests;
