//! What a grid file holds, whatever its format.

use super::Document;
use crate::schedule::Schedule;
use crate::structure::Structure;

/// Nodes at the border no farther apart than this, over the mean member length, are one joint.
const SAME_JOINT: f64 = 1e-6;

/// A grid to be written. Metres.
#[derive(Clone, Copy, Debug)]
pub struct GridFile<'a> {
    /// The grid and its history.
    pub document: &'a Document,
    /// Its nodes, members and panels with their figures.
    pub schedule: &'a Schedule,
    /// What engineering formats state beside them.
    pub structure: &'a Structure,
}

impl GridFile<'_> {
    /// Lines for the head of the file: version, seed, units. No line breaks inside.
    pub(super) fn header(&self) -> [String; 2] {
        let document = self.document;
        let name = document.name.replace(char::is_control, " ");
        let run = match (document.edge_length, document.seed) {
            (Some(length), Some(seed)) => format!("edge length {length} m, seed {seed}, "),
            _ => String::new(),
        };
        let invalid = document.invalid.as_ref().map_or(String::new(), |what| {
            format!("NOT VALID: {}; ", what.replace(char::is_control, " "))
        });
        [
            format!("gridshell {}: grid on {name}", document.version),
            format!("{invalid}{run}lengths in metres"),
        ]
    }

    /// The same in one line of plain letters.
    pub(super) fn headline(&self) -> String {
        let plain = |c: char| if c.is_ascii_graphic() || c == ' ' { c } else { '_' };
        self.header().join(", ").chars().map(plain).collect()
    }

    /// The joint that each node is part of, named by its first node: where borders touch in a point, the surface has a
    /// node on either side, and a structure one joint.
    pub(super) fn joints(&self) -> Vec<u32> {
        let xyz = &self.schedule.nodes.xyz;
        let close = SAME_JOINT * self.schedule.figures.length.spread.mean;
        let mut order: Vec<u32> = (0..xyz.len() as u32).collect();
        order.sort_by(|&a, &b| xyz[a as usize].x.total_cmp(&xyz[b as usize].x).then(a.cmp(&b)));
        let mut joints: Vec<u32> = (0..xyz.len() as u32).collect();
        // Only borders touch.
        let border = &self.schedule.nodes.boundary;
        order.retain(|&v| border[v as usize]);
        for (i, &a) in order.iter().enumerate() {
            let p = xyz[a as usize];
            let beside = order[i + 1..].iter().take_while(|&&b| xyz[b as usize].x - p.x <= close);
            for &b in beside {
                if xyz[b as usize].distance(p) <= close {
                    let joint = joints[a as usize].min(joints[b as usize]);
                    (joints[a as usize], joints[b as usize]) = (joint, joint);
                }
            }
        }
        joints
    }

    /// Whether each node is supported.
    pub(super) fn supported(&self) -> Vec<bool> {
        let mut supported = vec![false; self.document.nodes.len()];
        for &v in &self.document.supports {
            supported[v as usize] = true;
        }
        supported
    }

    /// Whether each of [these joints](GridFile::joints), at its first node, is supported.
    pub(super) fn held(&self, joints: &[u32]) -> Vec<bool> {
        let mut held = vec![false; joints.len()];
        for &v in &self.document.supports {
            held[joints[v as usize] as usize] = true;
        }
        held
    }
}
