//! Why an edit is not done, and what to do instead.

use crate::grid::Grid;
use crate::mesh;
use std::fmt;

/// An edit that was not done; the grid is as it was.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// What stands against it, with the nodes concerned.
    pub reason: String,
    /// What to do.
    pub advice: &'static str,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}: {}", self.reason, self.advice)
    }
}

impl std::error::Error for Refusal {}

impl Refusal {
    /// For this reason.
    pub(super) fn new(reason: impl Into<String>, advice: &'static str) -> Refusal {
        Refusal { reason: reason.into(), advice }
    }

    /// There is no such node.
    pub(super) fn no_node(v: u32) -> Refusal {
        Refusal::new(format!("there is no node {v}"), "it was removed or never was; choose another")
    }

    /// The mesh refused to flip this member.
    pub(super) fn of_flip(grid: &Grid, a: u32, b: u32, why: mesh::Refusal) -> Refusal {
        let mesh = &grid.mesh;
        match why {
            mesh::Refusal::Boundary => Refusal::new(
                format!("member {a}-{b} is on the boundary"),
                "it has one panel only; split or collapse it, or flip a member inside",
            ),
            mesh::Refusal::Degree => {
                let least = |v: u32| if mesh.is_boundary(v) { 2 } else { 3 };
                let v = if mesh.degree(a) <= least(a) { a } else { b };
                Refusal::new(
                    format!(
                        "flipping {a}-{b} would leave node {v} with degree {}",
                        mesh.degree(v) - 1
                    ),
                    "collapse one of its members instead",
                )
            }
            mesh::Refusal::Doubled => {
                let [c, d] = [mesh.left(a, b), mesh.right(a, b)].map(Option::unwrap_or_default);
                Refusal::new(
                    format!("flipping {a}-{b} would join {c} and {d}, which are joined already"),
                    "flip or collapse another member of theirs first",
                )
            }
            other => Refusal::of_member(a, b, other),
        }
    }

    /// The mesh refused to split or collapse this member.
    pub(super) fn of_collapse(a: u32, b: u32, why: mesh::Refusal) -> Refusal {
        match why {
            mesh::Refusal::Pinned => Refusal::new(
                format!("nodes {a} and {b} are both pinned, corners or anchors"),
                "one of them must be free to go: unpin it, or collapse another member",
            ),
            mesh::Refusal::Link | mesh::Refusal::Boundary => Refusal::new(
                format!("collapsing {a}-{b} would pinch the grid or take a node off its boundary"),
                "collapse along the boundary, or split an adjacent member first",
            ),
            mesh::Refusal::Degree => Refusal::new(
                format!("collapsing {a}-{b} would leave a node beside it with too few members"),
                "flip a member towards that node first",
            ),
            mesh::Refusal::Feature => Refusal::new(
                format!("collapsing {a}-{b} would take a node off its crease or guide"),
                "collapse a member along that line instead",
            ),
            other => Refusal::of_member(a, b, other),
        }
    }

    /// What may be said of a member, whatever the operation.
    pub(super) fn of_member(a: u32, b: u32, why: mesh::Refusal) -> Refusal {
        match why {
            mesh::Refusal::NoEdge => Refusal::new(
                format!("no member joins nodes {a} and {b}"),
                "choose two nodes of one member",
            ),
            mesh::Refusal::Feature => Refusal::new(
                format!("member {a}-{b} follows a crease or guide"),
                "split or collapse it along the line, or choose a member beside it",
            ),
            other => Refusal::new(format!("member {a}-{b}: {other}"), "choose another member"),
        }
    }
}
