//! What can be done to a grid by hand, as it stands in a log.

use crate::surface::Origin;
use serde::{Deserialize, Serialize};
use std::fmt;

/// One edit. Nodes are named by their ids, members by the ids of their two nodes in either order. Ids stay what they
/// are through a whole log: a removed node's is not given again, a new node's is one more than the highest so far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "op", rename_all = "snake_case", deny_unknown_fields)]
pub enum Edit {
    /// Let the two panels at a member share their other diagonal.
    Flip {
        /// The member.
        nodes: [u32; 2],
    },
    /// Put a node in the middle of a member.
    Split {
        /// The member.
        nodes: [u32; 2],
    },
    /// Make one node of a member's two: of the one that is bound more (pinned, on the boundary, on a feature), else
    /// of the first.
    Collapse {
        /// The member.
        nodes: [u32; 2],
    },
    /// Carry a neighbouring pair of too low and too high a degree sideways through the regular grid, by flips, until
    /// it meets another irregular node or the boundary (Fig. 12 d).
    Drift {
        /// The pair.
        nodes: [u32; 2],
        /// Apex of one of the panels at the pair's member: the side to drift to. Without it the shorter way.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        toward: Option<u32>,
        /// Flips at most; without it as far as it goes.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        steps: Option<u32>,
    },
    /// Move a node: inside along the surface to the place below or above `to`, on a line as near to it as the next
    /// nodes there leave room for. The others stay.
    Move {
        /// The node.
        node: u32,
        /// Target, metres in the surface's file.
        to: [f64; 3],
    },
    /// Let a node neither move nor be removed.
    Pin {
        /// The node.
        node: u32,
    },
    /// Take a pin out.
    Unpin {
        /// The node.
        node: u32,
    },
    /// Bring the nearest node to a point of the surface and fix it there.
    AddAnchor {
        /// The point, metres in the surface's file.
        at: [f64; 3],
    },
    /// Free a node that an anchor fixes.
    RemoveAnchor {
        /// The node.
        node: u32,
    },
    /// Bring the nearest row of nodes onto a line, which members follow from then on.
    AddGuide {
        /// Points of a polyline on the surface, metres in its file.
        points: Vec<[f64; 3]>,
    },
    /// Let members no longer follow the crease or guide, from one of its fixed nodes to the next, that this member is
    /// on. Those two nodes stay fixed.
    RemoveGuide {
        /// A member on it.
        nodes: [u32; 2],
    },
    /// Regularise a region: try short runs of operations at its irregular nodes and keep what betters the grid.
    Heal {
        /// In its middle.
        nodes: Vec<u32>,
        /// Rings of nodes round them that belong to it.
        rings: u32,
        /// Another seed finds another way.
        #[serde(default)]
        seed: u64,
    },
    /// Move the nodes of a region to an even balance; those around stay.
    Relax {
        /// In its middle.
        nodes: Vec<u32>,
        /// Rings of nodes round them that belong to it.
        rings: u32,
    },
    /// Move all nodes to an even balance.
    RelaxAll {},
}

impl Edit {
    /// An edit whose places are given in coordinates of this origin, as logs have it: in those of the surface's file.
    #[must_use]
    pub fn from_local(mut self, origin: Origin) -> Edit {
        let place = |p: &mut [f64; 3]| *p = origin.world((*p).into()).to_array();
        match &mut self {
            Edit::Move { to: at, .. } | Edit::AddAnchor { at } => place(at),
            Edit::AddGuide { points } => points.iter_mut().for_each(place),
            _ => {}
        }
        self
    }
}

impl fmt::Display for Edit {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Edit::Flip { nodes: [a, b] } => write!(f, "flip {a}-{b}"),
            Edit::Split { nodes: [a, b] } => write!(f, "split {a}-{b}"),
            Edit::Collapse { nodes: [a, b] } => write!(f, "collapse {a}-{b}"),
            Edit::Drift { nodes: [a, b], .. } => write!(f, "drift {a}-{b}"),
            Edit::Move { node, .. } => write!(f, "move {node}"),
            Edit::Pin { node } => write!(f, "pin {node}"),
            Edit::Unpin { node } => write!(f, "unpin {node}"),
            Edit::AddAnchor { at: [x, y, z] } => {
                write!(f, "add an anchor at ({x:.3}, {y:.3}, {z:.3})")
            }
            Edit::RemoveAnchor { node } => write!(f, "remove the anchor at {node}"),
            Edit::AddGuide { points } => write!(f, "add a guide of {} points", points.len()),
            Edit::RemoveGuide { nodes: [a, b] } => write!(f, "remove the guide at {a}-{b}"),
            Edit::Heal { nodes, rings, .. } => {
                write!(f, "heal {rings} rings round {}", Few(nodes))
            }
            Edit::Relax { nodes, rings } => write!(f, "relax {rings} rings round {}", Few(nodes)),
            Edit::RelaxAll {} => f.write_str("relax all"),
        }
    }
}

/// A list of nodes in a few words.
struct Few<'a>(&'a [u32]);

impl fmt::Display for Few<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.0 {
            [] => f.write_str("no node"),
            [one] => write!(f, "{one}"),
            [first, rest @ ..] => write!(f, "{first} and {} more", rest.len()),
        }
    }
}
