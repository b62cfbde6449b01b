//! Work that is stopped at any moment, in any phase: by the number of the poll, so that no clock is involved. It ends
//! with an error that says so, or with a valid grid, and never goes on for long without a poll.

use crate::promise::{check, model, quick};
use gridshell::error::{Error, Result};
use gridshell::inspect;
use gridshell::io::{self, Document, GridFile, Opening};
use gridshell::job::Job;
use gridshell::pipeline;
use gridshell::recipe::{Recipe, Symmetry};
use gridshell::schedule::{Schedule, Tolerances};
use gridshell::stages::measure::measure_within;
use gridshell::structure::Structure;
use gridshell::surface::{Model, Sampling, sew};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Moments tried for each work.
const MOMENTS: usize = 12;
const NEVER: u64 = u64::MAX;

/// On one thread polls come in the same order again.
fn alone<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap().install(work)
}

/// How often `work` polls, by phase.
fn polls(work: impl Fn(&Job) + Sync) -> BTreeMap<&'static str, u64> {
    let job = Job::counting(NEVER, 0);
    alone(|| work(&job));
    job.polls()
}

/// Random numbers of polls, from the first to the last; the same in every run of the test.
fn moments(polls: &BTreeMap<&'static str, u64>, seed: u64) -> Vec<u64> {
    let all: u64 = polls.values().sum();
    let mut rng = fastrand::Rng::with_seed(seed);
    let mut moments = vec![1, all];
    moments.extend((0..MOMENTS).map(|_| rng.u64(1..=all)));
    moments
}

fn was_stopped(error: &Error) -> bool {
    matches!(error, Error::Stopped { .. })
}

/// Stop `work` at many moments: it gives up with the error that says so, or was done just then.
fn stop_everywhere<T: Send>(what: &str, work: impl Fn(&Job) -> Result<T> + Sync) {
    let all = polls(|job| {
        work(job).unwrap_or_else(|e| panic!("{what}: {e}"));
    });
    for moment in moments(&all, 1) {
        let job = Job::counting(moment, 0);
        if let Err(error) = alone(|| work(&job)) {
            assert!(was_stopped(&error), "{what}, poll {moment}: {error}");
        }
    }
}

fn runs_stopped_everywhere(name: &str, recipe: &Recipe) {
    let model = model(name);
    let all = polls(|job| {
        pipeline::generate(&model, recipe, job).unwrap();
    });
    for moment in moments(&all, 2) {
        // Who waits gets a grid; who does not gets one if it is there.
        for patience in [NEVER, 0] {
            let job = Job::counting(moment, patience);
            match alone(|| pipeline::generate(&model, recipe, &job)) {
                Ok(run) => {
                    assert!(run.stopped, "{name}, poll {moment} of {all:?}");
                    check(&model, &run);
                }
                Err(e) => assert!(patience == 0 && was_stopped(&e), "{name}, poll {moment}: {e}"),
            }
        }
    }
}

#[test]
fn a_run_on_a_lattice_stops_anywhere() {
    runs_stopped_everywhere("saddle", &quick(4.0));
}

#[test]
fn a_run_on_bubbles_stops_anywhere() {
    runs_stopped_everywhere("torus", &quick(4.0));
}

#[test]
fn a_run_with_holes_and_creases_stops_anywhere() {
    runs_stopped_everywhere("great-court", &quick(8.0));
}

#[test]
fn a_symmetric_run_stops_anywhere() {
    let recipe = Recipe { symmetry: Symmetry::Auto, ..quick(4.0) };
    runs_stopped_everywhere("saddle", &recipe);
}

/// A wavy sheet of `side` by `side` squares, as OBJ.
fn sheet(side: usize) -> String {
    let mut text = String::new();
    for k in 0..(side + 1) * (side + 1) {
        let (x, y) = ((k / (side + 1)) as f64, (k % (side + 1)) as f64);
        text += &format!("v {x} {y} {}\n", 0.3 * (x - y) * (x + y) / side as f64);
    }
    for k in 0..side * side {
        let a = 1 + k / side * (side + 1) + k % side;
        text += &format!("f {} {} {} {}\n", a, a + side + 1, a + side + 2, a + 1);
    }
    text
}

/// A file of the test's own, which goes with it.
struct File(PathBuf);

impl File {
    fn new(name: &str, text: &str) -> File {
        let name = format!("gridshell-moments-{}-{name}", std::process::id());
        let path = std::env::temp_dir().join(name);
        std::fs::write(&path, text).unwrap();
        File(path)
    }
}

impl Drop for File {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}

#[test]
fn reading_stops_anywhere() {
    let obj = File::new("sheet.obj", &sheet(20));
    let off = {
        let text = sheet(6);
        let lines = |kind: &str| -> Vec<String> {
            let of = text.lines().filter_map(|l| l.strip_prefix(kind));
            of.map(|l| l.trim().to_owned()).collect()
        };
        let face = |l: &String| {
            let corners = l.split(' ').map(|w| (w.parse::<usize>().unwrap() - 1).to_string());
            format!("4 {}", corners.collect::<Vec<_>>().join(" "))
        };
        let (points, faces) = (lines("v"), lines("f"));
        let faces: Vec<String> = faces.iter().map(face).collect();
        let head = format!("OFF\n{} {} 0", points.len(), faces.len());
        [vec![head], points, faces].concat().join("\n")
    };
    let off = File::new("sheet.off", &off);
    let guides = File::new("guides.txt", "0 0 0\n1 0 0\n2 0 0\n\n0 1 0\n1 1 0\n");
    for file in [&obj, &off] {
        stop_everywhere("a mesh", |job| io::load(&file.0, &Opening::default(), job));
    }
    stop_everywhere("guides", |job| io::read_guides(&guides.0, job));
}

#[test]
fn sewing_and_inspecting_stop_anywhere() {
    for name in ["pleats", "great-court", "tower"] {
        let Model::Brep(brep) = model(name) else { panic!("{name} is of patches") };
        stop_everywhere(name, |job| sew(&mut brep.clone(), None, job));
        let model = Model::Brep(brep);
        stop_everywhere(name, |job| inspect::inspect(&model, job).map(|_| ()));
    }
}

#[test]
fn measuring_and_writing_stop_anywhere_and_leave_no_part_of_a_file() {
    let (model, recipe) = (model("saddle"), quick(4.0));
    let run = pipeline::generate(&model, &recipe, &Job::default()).unwrap();
    let (surface, length) = pipeline::surface(&model, &recipe, &Job::default()).unwrap();
    stop_everywhere("measuring", |job| {
        measure_within(&run.grid, &surface, length, &recipe.measure, job)?;
        Schedule::within(&run.grid, &surface, &Tolerances::default(), job)
    });
    let document = Document::of_grid("saddle", &run.grid, run.origin);
    let structure = Structure::default();
    let file = GridFile { document: &document, schedule: &run.schedule, structure: &structure };
    for end in [
        "gridshell",
        "obj",
        "ply",
        "stl",
        "off",
        "glb",
        "dxf",
        "compas.json",
        "vtu",
        "saf.xlsx",
        "ifc",
        "tcl",
    ] {
        let path = File::new(&format!("out.{end}"), "before");
        let work = |job: &Job| {
            std::fs::write(&path.0, "before").unwrap();
            let done = io::write(&path.0, &file, job);
            let kept = std::fs::read(&path.0).unwrap() == b"before";
            assert_eq!(kept, done.is_err(), "{end}: old or new, and never a part");
            done
        };
        stop_everywhere(end, work);
    }
}

/// Between two polls there is bounded work: four times the carrier, about four times the polls of each phase that
/// works through it.
#[test]
fn polls_grow_with_the_work() {
    let cases: [(&str, &[&str]); 3] = [
        ("saddle", &["preparing the surface", "triangulating"]),
        ("torus", &["triangulating"]),
        ("barrel", &["preparing the surface"]),
    ];
    for (name, phases) in cases {
        let model = model(name);
        // Finer than what is looked at on any face, however coarse its carrier.
        let length = 0.04 * model.size();
        let counted = |length: f64| {
            polls(|job| {
                let sampling =
                    Sampling { max_edge: length, chord_error: 0.01 * length, corner_angle: 0.5 };
                let surface = model.surface(&sampling, job).unwrap();
                let bubbles = gridshell::bubbles::Bubbles {
                    boundary: Vec::new(),
                    features: Vec::new(),
                    fixed: Vec::new(),
                    interior: Vec::new(),
                };
                let _ = gridshell::stages::triangulate::triangulate(&surface, &bubbles, job);
            })
        };
        let (coarse, fine) = (counted(length), counted(0.5 * length));
        for phase in phases {
            let of = |polls: &BTreeMap<&str, u64>| polls.get(phase).copied().unwrap_or(0);
            assert!(of(&fine) > 2 * of(&coarse) && of(&coarse) > 10, "{name}: {coarse:?} {fine:?}");
        }
    }
    let read = |side: usize| {
        let file = File::new(&format!("{side}.obj"), &sheet(side));
        let load = |path: &Path, job: &Job| io::load(path, &Opening::default(), job).map(|_| ());
        polls(|job| load(&file.0, job).unwrap())["reading"]
    };
    assert!(read(20) > 3 * read(10));
}
