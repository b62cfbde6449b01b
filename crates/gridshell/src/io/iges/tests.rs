//! Reading of small IGES files, put together here.

use super::*;
use crate::job::Job;
use crate::surface::{Sampling, Surface, sew, tessellate};
use glam::DVec3;
use std::f64::consts::PI;
use std::fmt::Write;

/// A file while it is written: entities in order; the first one has number 1, the next 3.
#[derive(Default)]
struct Sketch {
    directory: String,
    parameters: String,
    entities: usize,
    records: usize,
}

impl Sketch {
    /// Add an entity; its number. `status` is that of the directory.
    fn add(&mut self, kind: u32, form: i32, matrix: u32, status: &str, text: &str) -> u32 {
        let number = 2 * self.entities + 1;
        let text = format!("{kind},{text};");
        let first = self.records + 1;
        for piece in text.as_bytes().chunks(64) {
            self.records += 1;
            let piece = String::from_utf8_lossy(piece);
            let _ = writeln!(self.parameters, "{piece:64}{number:8}P{:7}", self.records);
        }
        let count = self.records + 1 - first;
        let _ = writeln!(
            self.directory,
            "{kind:8}{first:8}{:8}{:8}{:8}{:8}{matrix:8}{:8}{status:>8}D{number:7}",
            0, 0, 0, 0, 0
        );
        let _ = writeln!(
            self.directory,
            "{kind:8}{:8}{:8}{count:8}{form:8}{:32}D{:7}",
            0,
            0,
            "",
            number + 1
        );
        self.entities += 1;
        number as u32
    }

    fn plain(&mut self, kind: u32, text: &str) -> u32 {
        self.add(kind, 0, 0, "00010000", text)
    }

    /// The file with a unit by its flag.
    fn text(&self, unit: u32) -> String {
        let global =
            format!(",,4Htest,4Htest,4Htest,1H1,32,38,6,308,15,4Htest,1.,{unit},,1,0.1,,1E-6,10.;");
        let mut text = format!("{:72}S{:7}\n", "", 1);
        for (i, piece) in global.as_bytes().chunks(72).enumerate() {
            let _ = writeln!(text, "{:72}G{:7}", String::from_utf8_lossy(piece), i + 1);
        }
        text += &self.directory;
        text += &self.parameters;
        let _ = writeln!(text, "{:72}T{:7}", "S      1G      2", 1);
        text
    }

    fn read(&self) -> Brep {
        parse(self.text(6).as_bytes()).unwrap()
    }

    /// A bilinear surface over [0, 1]^2 through four corners: (0, 0), (1, 0), (0, 1), (1, 1).
    fn bilinear(&mut self, status: &str, corners: [[f64; 3]; 4]) -> u32 {
        let corners: Vec<String> =
            corners.iter().map(|c| format!("{},{},{}", c[0], c[1], c[2])).collect();
        let text = format!(
            "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,{},0.,1.,0.,1.",
            corners.join(",")
        );
        self.add(128, 0, 0, status, &text)
    }

    /// The closed path of these points on surface `sheet`, as a 142.
    fn path(&mut self, sheet: u32, points: &[[f64; 3]]) -> u32 {
        let mut text = format!("2,{}", points.len() + 1);
        for p in points.iter().chain(&points[..1]) {
            let _ = write!(text, ",{},{},{}", p[0], p[1], p[2]);
        }
        let line = self.add(106, 12, 0, "00010000", &text);
        self.plain(142, &format!("1,{sheet},0,{line},2"))
    }
}

const SQUARE: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [4.0, 4.0, 0.0]];

fn surface(brep: &Brep) -> Surface {
    let mut brep = brep.clone();
    sew(&mut brep, None, &Job::default()).unwrap();
    tessellate(
        &brep,
        &Sampling { max_edge: 0.2, chord_error: 1e-3, corner_angle: 0.5 },
        &Job::default(),
    )
    .unwrap()
}

#[test]
fn trimmed_square_has_its_hole_whichever_way_its_boundaries_run() {
    for (turn, back) in [(false, false), (true, false), (false, true), (true, true)] {
        let mut sketch = Sketch::default();
        let sheet = sketch.bilinear("00010000", SQUARE);
        let run = |mut points: Vec<[f64; 3]>, back: bool| {
            if back {
                points.reverse();
            }
            points
        };
        let outer =
            run(vec![[0.5, 0.5, 0.0], [3.5, 0.5, 0.0], [3.5, 3.5, 0.0], [0.5, 3.5, 0.0]], turn);
        let hole =
            run(vec![[1.0, 1.0, 0.0], [2.0, 1.0, 0.0], [2.0, 2.0, 0.0], [1.0, 2.0, 0.0]], back);
        let outer = sketch.path(sheet, &outer);
        let hole = sketch.path(sheet, &hole);
        sketch.plain(144, &format!("{sheet},1,1,{outer},{hole}"));
        let brep = sketch.read();
        assert_eq!(brep.faces.len(), 1, "{:?}", brep.notes);
        let s = surface(&brep);
        assert!((s.area - 8.0).abs() < 1e-12, "{}", s.area);
        assert_eq!(s.loops.len(), 2);
    }
}

#[test]
fn a_hole_without_an_outer_boundary_is_cut_from_the_whole_surface() {
    let mut sketch = Sketch::default();
    let sheet = sketch.bilinear("00010000", SQUARE);
    // A circle of radius 1 given in parameters, of which one is 4 m.
    let circle = sketch.plain(100, "0.,0.5,0.5,0.75,0.5,0.75,0.5");
    let hole = sketch.plain(142, &format!("1,{sheet},{circle},0,1"));
    sketch.plain(144, &format!("{sheet},0,1,0,{hole}"));
    let s = surface(&sketch.read());
    assert!((s.area - (16.0 - PI)).abs() < 1e-4, "{}", s.area);
    assert_eq!(s.loops.len(), 2);
}

#[test]
fn inches_a_transformation_and_a_part_of_the_parameters_are_kept_to() {
    let mut sketch = Sketch::default();
    let matrix = sketch.plain(124, "0.,-1.,0.,10.,1.,0.,0.,0.,0.,0.,1.,5.");
    let text =
        "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0,0,0,4,0,0,0,4,0,4,4,0,0.,.5,0.,1.";
    sketch.add(128, 0, matrix, "00000000", text);
    let brep = parse(sketch.text(1).as_bytes()).unwrap();
    assert_eq!(brep.unit_in_metres, 0.0254);
    let s = surface(&brep);
    assert!((s.area - 8.0 * 0.0254 * 0.0254).abs() < 1e-12);
    let points = || s.carrier.points.iter().copied();
    let (lo, hi) = (points().reduce(DVec3::min).unwrap(), points().reduce(DVec3::max).unwrap());
    assert!((lo / 0.0254).distance(DVec3::new(6.0, 0.0, 5.0)) < 1e-9, "{lo}");
    assert!((hi / 0.0254).distance(DVec3::new(10.0, 2.0, 5.0)) < 1e-9, "{hi}");
}

#[test]
fn swept_surfaces_are_exact() {
    let mut sketch = Sketch::default();
    let axis = sketch.plain(110, "0,0,0,0,0,1");
    let side = sketch.plain(110, "2,0,0,2,0,3");
    sketch.add(120, 0, 0, "00000000", &format!("{axis},{side},0.,{}", PI / 2.0));
    let arc = sketch.plain(100, "0.,10.,0.,11.,0.,10.,1.");
    sketch.add(122, 0, 0, "00000000", &format!("{arc},11.,0.,2."));
    let low = sketch.plain(110, "20,0,0,24,0,0");
    let high = sketch.add(106, 12, 0, "00010000", "2,3,20,3,4,22,3,4,24,3,4");
    sketch.add(118, 1, 0, "00000000", &format!("{low},{high},0,0"));
    let brep = sketch.read();
    assert_eq!(brep.faces.len(), 3, "{:?}", brep.notes);
    let s = surface(&brep);
    assert!((s.area - (3.0 * PI + PI + 20.0)).abs() < 1e-5, "{}", s.area - (4.0 * PI + 20.0));
}

#[test]
fn shell_of_two_faces_shares_its_edge() {
    let mut sketch = Sketch::default();
    let left = sketch.bilinear("00010000", SQUARE);
    let right = sketch.bilinear("00010000", SQUARE.map(|[x, y, z]| [x + 4.0, y, z]));
    let ends = [[0, 0], [4, 0], [8, 0], [8, 4], [4, 4], [0, 4]];
    let list: Vec<String> = ends.iter().map(|p| format!("{},{},0", p[0], p[1])).collect();
    let vertices = sketch.add(502, 1, 0, "00010000", &format!("6,{}", list.join(",")));
    let mut edges = Vec::new();
    for (a, b) in [(1, 2), (2, 3), (3, 4), (4, 5), (5, 6), (6, 1), (2, 5)] {
        let [p, q] = [ends[a - 1], ends[b - 1]];
        let line = sketch.plain(110, &format!("{},{},0,{},{},0", p[0], p[1], q[0], q[1]));
        edges.push(format!("{line},{vertices},{a},{vertices},{b}"));
    }
    let list = sketch.add(504, 1, 0, "00010001", &format!("7,{}", edges.join(",")));
    let mut ring = |uses: &[(usize, u8)]| {
        let uses: Vec<String> = uses.iter().map(|(e, o)| format!("0,{list},{e},{o},0")).collect();
        sketch.add(508, 1, 0, "00010000", &format!("{},{}", uses.len(), uses.join(",")))
    };
    let one = ring(&[(1, 1), (7, 1), (5, 1), (6, 1)]);
    let two = ring(&[(2, 1), (3, 1), (4, 1), (7, 0)]);
    let one = sketch.add(510, 1, 0, "00010000", &format!("{left},1,1,{one}"));
    let two = sketch.add(510, 1, 0, "00010000", &format!("{right},1,1,{two}"));
    sketch.add(514, 1, 0, "00010000", &format!("2,{one},1,{two},1"));
    let brep = sketch.read();
    assert_eq!(
        (brep.faces.len(), brep.edges.len(), brep.vertices.len()),
        (2, 7, 6),
        "{:?}",
        brep.notes
    );
    let s = surface(&brep);
    assert!((s.area - 32.0).abs() < 1e-12);
    assert_eq!(s.loops.len(), 1);
}

#[test]
fn what_is_blanked_or_part_of_something_else_is_no_face() {
    let mut sketch = Sketch::default();
    sketch.bilinear("01000000", SQUARE);
    sketch.bilinear("00010000", SQUARE);
    sketch.bilinear("00000000", SQUARE);
    let brep = sketch.read();
    assert_eq!(brep.faces.len(), 1);
    assert!(brep.notes.iter().any(|n| n.contains("blanked")), "{:?}", brep.notes);
}

#[test]
fn subfigures_are_placed_and_may_not_hold_themselves() {
    let mut sketch = Sketch::default();
    let sheet = sketch.bilinear("00010000", SQUARE);
    let figure = sketch.add(308, 0, 0, "00000200", &format!("0,1Ha,1,{sheet}"));
    sketch.add(408, 0, 0, "00000000", &format!("{figure},0.,0.,0.,1."));
    sketch.add(408, 0, 0, "00000000", &format!("{figure},10.,0.,0.,2."));
    assert!((surface(&sketch.read()).area - 80.0).abs() < 1e-9);
    let mut sketch = Sketch::default();
    // The figure is number 1, the instance in it 3.
    sketch.add(308, 0, 0, "00000200", "0,1Ha,2,3,3");
    sketch.add(408, 0, 0, "00000000", "1,0.,0.,0.,1.");
    sketch.add(408, 0, 0, "00000000", "1,0.,0.,0.,1.");
    assert!(parse(sketch.text(6).as_bytes()).is_err());
}

#[test]
fn curves_that_contain_themselves_end_in_a_note_with_the_entity() {
    let mut sketch = Sketch::default();
    sketch.bilinear("00000000", SQUARE);
    // Composite number 3 holds itself twice; so would 2^32 visits.
    sketch.plain(102, "2,3,3");
    sketch.add(122, 0, 0, "00000000", "3,0.,0.,1.");
    let brep = sketch.read();
    assert_eq!(brep.faces.len(), 1);
    let lost = &brep.source.losses;
    assert!(lost.iter().any(|l| l.why.contains("D3") && l.why.contains("nested")), "{lost:?}");
}

#[test]
fn huge_counts_are_refused_before_anything_is_set_aside() {
    for text in [
        "99999999,99999999,3,3,0,0,1,0,0,0.",
        "1e9,1e9,1,1,0,0,1,0,0,0.,0.",
        "-1,1,1,1,0,0,1,0,0",
        "1.5,1,1,1",
    ] {
        let mut sketch = Sketch::default();
        sketch.add(128, 0, 0, "00000000", text);
        let fault = parse(sketch.text(6).as_bytes()).unwrap_err();
        assert!(fault.what.contains("D1"), "{}", fault.what);
    }
}

#[test]
fn every_cut_of_a_file_is_an_error_unless_all_entities_are_there() {
    let mut sketch = Sketch::default();
    let sheet = sketch.bilinear("00010000", SQUARE);
    let outer = sketch.path(sheet, &[[0.5, 0.5, 0.0], [3.5, 0.5, 0.0], [3.5, 3.5, 0.0]]);
    sketch.plain(144, &format!("{sheet},1,0,{outer}"));
    let text = sketch.text(6);
    let end = text.find("S      1G").unwrap();
    for cut in (1..end - 1).step_by(7) {
        if let Ok(brep) = parse(&text.as_bytes()[..cut]) {
            // Within the numbers at the end of the last parameter line.
            assert!(end - cut <= 20, "cut at {cut} of {end}");
            assert!(brep.notes.iter().any(|n| n.contains("no end section")), "{:?}", brep.notes);
        }
    }
    assert!(parse(b"").is_err());
    assert!(parse(b"ISO-10303-21;\nHEADER;").is_err());
}
