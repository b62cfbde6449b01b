//! What a grid file holds, whatever its format.

use super::Document;
use crate::schedule::Schedule;
use crate::structure::Structure;

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
        [
            format!("gridshell {}: grid on {name}", document.version),
            format!("{run}lengths in metres"),
        ]
    }

    /// The same in one line of plain letters.
    pub(super) fn headline(&self) -> String {
        let plain = |c: char| if c.is_ascii_graphic() || c == ' ' { c } else { '_' };
        self.header().join(", ").chars().map(plain).collect()
    }

    /// Whether each node is supported.
    pub(super) fn supported(&self) -> Vec<bool> {
        let mut supported = vec![false; self.document.nodes.len()];
        for &v in &self.document.supports {
            supported[v as usize] = true;
        }
        supported
    }
}
