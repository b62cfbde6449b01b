//! A grid as DXF (AutoCAD 2000, text): members as lines, panels as faces, nodes as points, the boundary as closed
//! polylines, each on a layer of its own; metres. After Autodesk's DXF reference.

use super::GridFile;
use crate::io::WRITING;
use crate::job::Job;
use crate::schedule::{Panels, Schedule};
use glam::DVec3;
use std::collections::BTreeMap;
use std::fmt::{Display, Write};

/// Layers and their colours (AutoCAD colour index).
const LAYERS: [(&str, u8); 7] = [
    ("0", 7),
    ("members", 7),
    ("panels", 9),
    ("nodes", 8),
    ("irregular", 1),
    ("boundary", 5),
    ("supports", 3),
];

/// Handles of what others refer to.
const MODEL_SPACE: u64 = 0x20;
const PAPER_SPACE: u64 = 0x21;
const ROOT: u64 = 0x22;
const GROUPS: u64 = 0x23;
/// Handles of everything else begin here.
const FIRST: u64 = 0x100;

/// The text as it grows: pairs of a group code and a value.
struct Writer<'a> {
    /// Once it is over nothing more is written; the caller is to check.
    job: &'a Job,
    out: String,
    handle: u64,
}

/// The file's bytes.
pub(super) fn encode(grid: &GridFile, job: &Job) -> Vec<u8> {
    // The body first: the head tells the next free handle.
    let mut body = Writer { job, out: String::new(), handle: FIRST };
    body.tables();
    body.blocks();
    body.entities(grid);
    body.objects();
    body.pair(0, "EOF");
    let mut head = Writer { job, out: String::new(), handle: 0 };
    head.pair(999, grid.headline());
    head.begin("HEADER");
    head.pair(9, "$ACADVER");
    head.pair(1, "AC1015");
    head.pair(9, "$HANDSEED");
    head.pair(5, format!("{:X}", body.handle));
    // Metres.
    head.pair(9, "$INSUNITS");
    head.pair(70, 6);
    head.pair(9, "$MEASUREMENT");
    head.pair(70, 1);
    head.pair(0, "ENDSEC");
    head.begin("CLASSES");
    head.pair(0, "ENDSEC");
    head.out.push_str(&body.out);
    head.out.into_bytes()
}

impl Writer<'_> {
    fn pair(&mut self, code: u16, value: impl Display) {
        if !self.job.is_over(WRITING) {
            let _ = writeln!(self.out, "{code:>3}\n{value}");
        }
    }

    fn begin(&mut self, section: &str) {
        self.pair(0, "SECTION");
        self.pair(2, section);
    }

    /// A point in the group codes 1n, 2n, 3n.
    fn point(&mut self, n: u16, p: DVec3) {
        for (k, x) in p.to_array().into_iter().enumerate() {
            self.pair(10 * (k as u16 + 1) + n, x);
        }
    }

    fn next(&mut self) -> u64 {
        self.handle += 1;
        self.handle - 1
    }

    fn tables(&mut self) {
        self.begin("TABLES");
        self.table("VPORT", 0);
        self.pair(0, "ENDTAB");
        let owner = self.table("LTYPE", 3);
        for name in ["ByBlock", "ByLayer", "Continuous"] {
            self.record("LTYPE", owner, "AcDbLinetypeTableRecord", name);
            self.pair(70, 0);
            self.pair(3, "");
            self.pair(72, 65);
            self.pair(73, 0);
            self.pair(40, 0.0);
        }
        self.pair(0, "ENDTAB");
        let owner = self.table("LAYER", LAYERS.len());
        for (name, colour) in LAYERS {
            self.record("LAYER", owner, "AcDbLayerTableRecord", name);
            self.pair(70, 0);
            self.pair(62, colour);
            self.pair(6, "Continuous");
        }
        self.pair(0, "ENDTAB");
        let owner = self.table("STYLE", 1);
        self.record("STYLE", owner, "AcDbTextStyleTableRecord", "Standard");
        self.pair(70, 0);
        self.pair(40, 0.0);
        self.pair(41, 1.0);
        self.pair(50, 0.0);
        self.pair(71, 0);
        self.pair(42, 1.0);
        self.pair(3, "txt");
        self.pair(4, "");
        self.pair(0, "ENDTAB");
        for name in ["VIEW", "UCS"] {
            self.table(name, 0);
            self.pair(0, "ENDTAB");
        }
        let owner = self.table("APPID", 1);
        self.record("APPID", owner, "AcDbRegAppTableRecord", "ACAD");
        self.pair(70, 0);
        self.pair(0, "ENDTAB");
        let owner = self.table("DIMSTYLE", 1);
        self.pair(100, "AcDbDimStyleTable");
        // Its handle has a group code of its own.
        let handle = self.next();
        self.pair(0, "DIMSTYLE");
        self.pair(105, format!("{handle:X}"));
        self.pair(330, format!("{owner:X}"));
        self.pair(100, "AcDbSymbolTableRecord");
        self.pair(100, "AcDbDimStyleTableRecord");
        self.pair(2, "Standard");
        self.pair(70, 0);
        self.pair(0, "ENDTAB");
        let owner = self.table("BLOCK_RECORD", 2);
        for (handle, name) in [(MODEL_SPACE, "*Model_Space"), (PAPER_SPACE, "*Paper_Space")] {
            self.record_at(handle, "BLOCK_RECORD", owner, "AcDbBlockTableRecord", name);
        }
        self.pair(0, "ENDTAB");
        self.pair(0, "ENDSEC");
    }

    fn table(&mut self, name: &str, records: usize) -> u64 {
        let handle = self.next();
        self.pair(0, "TABLE");
        self.pair(2, name);
        self.pair(5, format!("{handle:X}"));
        self.pair(330, 0);
        self.pair(100, "AcDbSymbolTable");
        self.pair(70, records);
        handle
    }

    fn record(&mut self, kind: &str, owner: u64, class: &str, name: &str) {
        let handle = self.next();
        self.record_at(handle, kind, owner, class, name);
    }

    fn record_at(&mut self, handle: u64, kind: &str, owner: u64, class: &str, name: &str) {
        self.pair(0, kind);
        self.pair(5, format!("{handle:X}"));
        self.pair(330, format!("{owner:X}"));
        self.pair(100, "AcDbSymbolTableRecord");
        self.pair(100, class);
        self.pair(2, name);
    }

    fn blocks(&mut self) {
        self.begin("BLOCKS");
        for (owner, name) in [(MODEL_SPACE, "*Model_Space"), (PAPER_SPACE, "*Paper_Space")] {
            self.entity("BLOCK", owner, "0");
            self.pair(100, "AcDbBlockBegin");
            self.pair(2, name);
            self.pair(70, 0);
            self.point(0, DVec3::ZERO);
            self.pair(3, name);
            self.pair(1, "");
            self.entity("ENDBLK", owner, "0");
            self.pair(100, "AcDbBlockEnd");
        }
        self.pair(0, "ENDSEC");
    }

    fn entity(&mut self, kind: &str, owner: u64, layer: &str) -> u64 {
        let handle = self.next();
        let _ = write!(
            self.out,
            "  0\n{kind}\n  5\n{handle:X}\n330\n{owner:X}\n100\nAcDbEntity\n  8\n{layer}\n"
        );
        handle
    }

    fn entities(&mut self, grid: &GridFile) {
        let Schedule { nodes, members, panels, .. } = grid.schedule;
        let at = |v: u32| nodes.xyz[v as usize];
        self.begin("ENTITIES");
        for t in &panels.nodes {
            self.entity("3DFACE", MODEL_SPACE, "panels");
            self.pair(100, "AcDbFace");
            // A triangle has its last corner twice.
            for (n, v) in [t[0], t[1], t[2], t[2]].into_iter().enumerate() {
                self.point(n as u16, at(v));
            }
        }
        for &[a, b] in &members.ends {
            self.entity("LINE", MODEL_SPACE, "members");
            self.pair(100, "AcDbLine");
            self.point(0, at(a));
            self.point(1, at(b));
        }
        let all = 0..nodes.xyz.len() as u32;
        self.points("nodes", all.clone().map(at));
        self.points("irregular", all.filter(|&v| nodes.is_irregular(v as usize)).map(at));
        self.points("supports", grid.document.supports.iter().map(|&v| at(v)));
        for ring in boundary_loops(panels) {
            self.ring(&ring.into_iter().map(at).collect::<Vec<_>>());
        }
        self.pair(0, "ENDSEC");
    }

    fn points(&mut self, layer: &str, points: impl Iterator<Item = DVec3>) {
        for p in points {
            self.entity("POINT", MODEL_SPACE, layer);
            self.pair(100, "AcDbPoint");
            self.point(0, p);
        }
    }

    /// A closed polyline in space on the layer of the boundary.
    fn ring(&mut self, points: &[DVec3]) {
        let owner = self.entity("POLYLINE", MODEL_SPACE, "boundary");
        self.pair(100, "AcDb3dPolyline");
        self.pair(66, 1);
        self.point(0, DVec3::ZERO);
        // Closed, in space.
        self.pair(70, 9);
        for p in points {
            self.entity("VERTEX", owner, "boundary");
            self.pair(100, "AcDbVertex");
            self.pair(100, "AcDb3dPolylineVertex");
            self.point(0, *p);
            self.pair(70, 32);
        }
        self.entity("SEQEND", owner, "boundary");
    }

    fn objects(&mut self) {
        self.begin("OBJECTS");
        self.pair(0, "DICTIONARY");
        self.pair(5, format!("{ROOT:X}"));
        self.pair(330, 0);
        self.pair(100, "AcDbDictionary");
        self.pair(281, 1);
        self.pair(3, "ACAD_GROUP");
        self.pair(350, format!("{GROUPS:X}"));
        self.pair(0, "DICTIONARY");
        self.pair(5, format!("{GROUPS:X}"));
        self.pair(330, format!("{ROOT:X}"));
        self.pair(100, "AcDbDictionary");
        self.pair(281, 1);
        self.pair(0, "ENDSEC");
    }
}

/// The loops of sides that one panel alone has, each from its lowest node.
fn boundary_loops(panels: &Panels) -> Vec<Vec<u32>> {
    let mut sides: Vec<(u32, u32)> = Vec::new();
    for t in &panels.nodes {
        sides.extend([(t[0], t[1]), (t[1], t[2]), (t[2], t[0])]);
    }
    sides.sort_unstable();
    let twin = |s: &(u32, u32)| sides.binary_search(&(s.1, s.0)).is_ok();
    let mut next: BTreeMap<u32, u32> = sides.iter().filter(|s| !twin(s)).copied().collect();
    let mut loops = Vec::new();
    while let Some((start, mut v)) = next.pop_first() {
        let mut ring = vec![start];
        while v != start {
            ring.push(v);
            let Some(on) = next.remove(&v) else { break };
            v = on;
        }
        loops.push(ring);
    }
    loops
}
