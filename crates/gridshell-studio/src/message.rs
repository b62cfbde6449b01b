//! Every message between the server and the page. `page/src/messages.ts` is generated from here; a test fails when
//! the two differ.
//!
//! Numbers that are drawn or pointed at are in local coordinates ([`gridshell::surface::Origin`]), which single precision
//! holds well; what people read is in those of the surface's file.

use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// What the page asks for.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(test, derive(Serialize, ts_rs::TS))]
#[serde(tag = "kind", rename_all = "snake_case", deny_unknown_fields)]
pub enum Request {
    /// Open a built-in surface.
    Open {
        /// Its name.
        name: String,
    },
    /// Read the open file again: only what is on these layers, and of that only the objects of these names; all that
    /// the file shows without any.
    Choose {
        /// Layers by name, those below them included.
        layers: Vec<String>,
        /// Objects by name.
        objects: Vec<String>,
    },
    /// What this recipe would make.
    Estimate {
        /// Values of the form by key.
        #[cfg_attr(test, ts(type = "Record<string, unknown>"))]
        values: BTreeMap<String, Value>,
    },
    /// Lay a grid.
    Generate {
        /// Values of the form by key.
        #[cfg_attr(test, ts(type = "Record<string, unknown>"))]
        values: BTreeMap<String, Value>,
    },
    /// Stop; the best grid so far is kept.
    Cancel,
    /// Send a run and its grid.
    Look {
        /// Which run.
        run: u32,
        /// The stage whose grid is wanted; the last one's without it.
        stage: Option<String>,
    },
    /// Send the colors of a grid.
    Color {
        /// Which run.
        run: u32,
        /// One of the colorings that [`Hello`] lists.
        by: String,
    },
    /// What is under the pointer.
    Pick {
        /// Which run.
        run: u32,
        /// A point of the line of sight, metres.
        origin: [f64; 3],
        /// Its direction, away from the eye.
        direction: [f64; 3],
        /// Number of the question, to be repeated in the answer.
        question: u32,
    },
    /// The nodes inside a rectangle of the screen.
    Select {
        /// Which run.
        run: u32,
        /// World to screen, column by column; the rectangle is from -1 to 1.
        matrix: Vec<f64>,
        /// Left, bottom, right, top, each from -1 to 1.
        rectangle: [f64; 4],
    },
    /// How far two points are apart.
    Distance {
        /// One, metres.
        from: [f64; 3],
        /// The other.
        to: [f64; 3],
    },
    /// Change a grid by hand.
    Edit {
        /// Which run.
        run: u32,
        /// The edit as it stands in logs: `op`, `nodes` ...
        #[cfg_attr(test, ts(type = "Record<string, unknown>"))]
        edit: Value,
    },
    /// Send the candidates of a run, small and in plan.
    Candidates {
        /// Which run.
        run: u32,
    },
    /// Show a candidate as it was when the best one was chosen.
    Candidate {
        /// Of which run.
        run: u32,
        /// Its place in the list, from 0.
        index: u32,
    },
    /// Relax a candidate and keep it as a grid of its own.
    Take {
        /// Of which run.
        run: u32,
        /// Its place in the list, from 0.
        index: u32,
    },
    /// Take the last edit back.
    Undo {
        /// Of which run.
        run: u32,
    },
    /// Do again what was taken back.
    Redo {
        /// Of which run.
        run: u32,
    },
    /// What each operation on a member would do.
    Hover {
        /// Which run.
        run: u32,
        /// The member.
        nodes: [u32; 2],
        /// Number of the question, to be repeated in the answer.
        question: u32,
    },
    /// The edits that would better a grid most.
    Suggest {
        /// Which run.
        run: u32,
    },
    /// A grid was saved, as it was in this version, and the user has seen that it was.
    Saved {
        /// Which run.
        run: u32,
        /// The version that the file's answer told.
        version: u32,
    },
    /// Forget a run.
    Forget {
        /// Which one.
        run: u32,
    },
    /// Put what an earlier session left on the desk.
    Recover {
        /// Its name.
        session: String,
    },
    /// Throw away what an earlier session left.
    Discard {
        /// Its name.
        session: String,
    },
}

/// What the server tells.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Event {
    /// First of all: what there is.
    Hello(Hello),
    /// A surface was opened.
    Surface(SurfaceInfo),
    /// What a recipe would make.
    Estimate {
        /// Wanted member length, metres.
        edge_length: f64,
        /// About so many nodes.
        nodes: u32,
    },
    /// A run goes on.
    Progress(Progress),
    /// No run goes on any more.
    Idle {
        /// The last one's number, where it gave a grid.
        run: Option<u32>,
    },
    /// The runs there are, the oldest first.
    Runs {
        /// In one line each.
        runs: Vec<RunSummary>,
        /// The one that was laid last.
        newest: Option<u32>,
    },
    /// All about one run.
    Run(RunInfo),
    /// What is under the pointer.
    Picked(Picked),
    /// The nodes inside the rectangle.
    Selected {
        /// Which run.
        run: u32,
        /// Their numbers.
        nodes: Vec<u32>,
        /// Of those irregular.
        irregular: u32,
    },
    /// How far two points are apart.
    Distance {
        /// Straight, metres.
        straight: f64,
        /// In plan, metres.
        plan: f64,
        /// In height, metres.
        height: f64,
    },
    /// What each operation on a member would do.
    Hovered {
        /// Which run.
        run: u32,
        /// The number of the question.
        question: u32,
        /// The operations.
        ways: Vec<Step>,
    },
    /// The edits that would better a grid most, the best first.
    Suggested {
        /// Which run.
        run: u32,
        /// See the field before.
        steps: Vec<Step>,
    },
    /// The recipe of a grid that was opened from a file, for the form; its method is `file`.
    Recipe {
        /// Number of the grid.
        run: u32,
        /// Values of the form by key.
        #[cfg_attr(test, ts(type = "Record<string, unknown>"))]
        values: BTreeMap<String, Value>,
    },
    /// What earlier sessions left unsaved, the newest first.
    Left {
        /// See the field before.
        sessions: Vec<Left>,
        /// So many more are offered when these are dealt with.
        more: u32,
    },
    /// Grids without changes by hand that were taken off the desk to make room.
    PutAway {
        /// A line on each.
        grids: Vec<String>,
    },
    /// Whether grids are kept against crashes.
    Autosave {
        /// Why they cannot be; null where they are.
        fault: Option<String>,
    },
    /// The edits of a run.
    History {
        /// Which run.
        run: u32,
        /// What was done before its file was written, in words, the oldest first; it cannot be undone.
        before: Vec<String>,
        /// What was done, the oldest first.
        done: Vec<Step>,
        /// What was taken back, the next to be done again first.
        undone: Vec<Step>,
    },
    /// Something is done that takes a while; it can be cancelled.
    Working {
        /// To which run.
        run: u32,
        /// What, in words.
        what: String,
        /// Share that is done, 0 to 1.
        fraction: f64,
    },
    /// It is done, or was cancelled.
    Worked,
    /// Something that was asked for could not be done.
    Fault {
        /// What was asked for: `open`, `generate`, `estimate`, `message` ...
        about: String,
        /// Why, and what to do.
        message: String,
    },
}

/// What there is.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Hello {
    /// Version of gridshell.
    pub version: String,
    /// The built-in surfaces.
    pub builtins: Vec<Named>,
    /// The recipe's fields.
    pub form: Vec<Field>,
    /// What grids can be colored by.
    pub colorings: Vec<Coloring>,
    /// Extensions of the files that can be opened.
    pub accepts: Vec<String>,
    /// Extensions of the files that can be exported.
    pub exports: Vec<Named>,
    /// Largest file that can be opened, bytes.
    pub upload_limit: u32,
}

/// A name and a line on it.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Named {
    /// What stands in messages.
    pub name: String,
    /// For people.
    pub description: String,
}

/// One field of the recipe's form.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Field {
    /// Its name in messages: the path in the recipe, with points.
    pub key: String,
    /// For people.
    pub label: String,
    /// Unit, or empty.
    pub unit: String,
    /// One line of help.
    pub help: String,
    /// Heading that it stands under.
    pub group: String,
    /// How it is given.
    pub control: Control,
    /// What it is until it is given; null where the surface decides.
    #[cfg_attr(test, ts(type = "unknown"))]
    pub value: Value,
}

/// How a field is given.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Control {
    /// A number.
    Number {
        /// Least.
        min: f64,
        /// Largest.
        max: f64,
        /// A sensible step.
        step: f64,
        /// Whether it may be left empty.
        optional: bool,
    },
    /// One of several.
    Choice {
        /// What there is.
        options: Vec<Named>,
    },
    /// Points: x, y, z, one a line.
    Points,
    /// A vector: x, y, z; may be left empty.
    Vector,
}

/// A way to color grids.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Coloring {
    /// Its name in messages.
    pub name: String,
    /// For people.
    pub label: String,
    /// One line of help.
    pub help: String,
}

/// A surface in words and figures.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct SurfaceInfo {
    /// Built-in name or file stem.
    pub name: String,
    /// Whether it is built in.
    pub built_in: bool,
    /// Where it comes from.
    pub source: String,
    /// What to know of it.
    pub facts: Vec<Fact>,
    /// The parts, where there are several.
    pub parts: Vec<Part>,
    /// The objects of its file, where the format knows any.
    pub objects: Vec<Object>,
    /// What was skipped or repaired.
    pub notes: Vec<String>,
    /// A sensible edge length, metres.
    pub edge_length: f64,
    /// Least and largest coordinates, metres.
    pub bounds: [[f64; 3]; 2],
}

/// Faces that hang together.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Part {
    /// Counted from 1.
    pub number: u32,
    /// Names of the file's objects that it is made of.
    pub name: String,
    /// Number of faces.
    pub faces: u32,
    /// Area, square metres.
    pub area: f64,
    /// Why no grid can be laid on it.
    pub fault: Option<String>,
}

/// An object of a file.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Object {
    /// Its name, or empty.
    pub name: String,
    /// The layer it is on, or empty.
    pub layer: String,
    /// What it is: `brep`, `mesh` ...
    pub kind: String,
    /// Faces read from it; 0 where it was left out.
    pub faces: u32,
}

/// What an earlier session left unsaved.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Left {
    /// Its name.
    pub session: String,
    /// When its last grid was kept: seconds since 1970, UTC.
    pub seconds: f64,
    /// A line on each of its grids.
    pub grids: Vec<String>,
    /// Those that cannot be recovered.
    pub damaged: Vec<Damaged>,
    /// The folder that they are in.
    pub folder: String,
}

/// A file that cannot be read.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Damaged {
    /// Its name in its session's folder.
    pub file: String,
    /// What is wrong with it.
    pub reason: String,
}

/// A figure with its name.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Fact {
    /// Its name.
    pub label: String,
    /// The figure, with its unit.
    pub value: String,
}

/// How far a run is.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Progress {
    /// Number of the run.
    pub run: u32,
    /// Whether this is the quick one that is shown before.
    pub draft: bool,
    /// `prepare`, `surface`, `fix`, `flatten`, `pack`, `triangulate`, `regularize`, `relax` or `measure`.
    pub stage: String,
    /// Share of the stage, 0 to 1.
    pub fraction: f64,
    /// Since it began, seconds.
    pub seconds: f64,
}

/// A run in one line.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct RunSummary {
    /// Its number.
    pub run: u32,
    /// The surface and what was asked for.
    pub title: String,
    /// Effort, seed.
    pub detail: String,
    /// Number of nodes.
    pub nodes: u32,
    /// Fluency; null when it is infinite.
    pub fluency: Option<f64>,
    /// Irregular nodes.
    pub irregular: u32,
    /// Whether it has changes by hand that are in no file of the user's.
    pub unsaved: bool,
}

/// All about one run.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct RunInfo {
    /// In one line.
    pub summary: RunSummary,
    /// Wanted member length, metres.
    pub edge_length: f64,
    /// Whether it was stopped early.
    pub stopped: bool,
    /// All measures.
    pub measures: Vec<Measure>,
    /// How lengths, shapes ... are spread.
    pub histograms: Vec<Histogram>,
    /// The stages in their order.
    pub stages: Vec<StageRow>,
    /// The candidates, the one kept first.
    pub candidates: Vec<CandidateRow>,
    /// What the user should know.
    pub warnings: Vec<String>,
}

/// One measure.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Measure {
    /// Its name in run documents.
    pub key: String,
    /// For people.
    pub label: String,
    /// Its value, as it is to be read.
    pub value: String,
    /// What it cannot fall below, or exceed.
    pub floor: Option<String>,
    /// Unit, or empty.
    pub unit: String,
    /// One line of help.
    pub help: String,
    /// Heading that it stands under.
    pub group: String,
    /// Whether it tells of something wrong.
    pub bad: bool,
}

/// How a figure is spread.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Histogram {
    /// What is counted.
    pub title: String,
    /// Unit, or empty.
    pub unit: String,
    /// Where the bins begin and end: one more than there are counts.
    pub edges: Vec<f64>,
    /// How many in each bin.
    pub counts: Vec<u32>,
}

/// One stage.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct StageRow {
    /// `pack`, `triangulate`, `regularize` or `relax`.
    pub name: String,
    /// Time it took.
    pub seconds: f64,
    /// Whether it came to its own end.
    pub converged: bool,
    /// Irregular nodes after it.
    pub irregular: Option<u32>,
    /// mu after it.
    pub mu: Option<f64>,
    /// Mean angle fluency index, degrees.
    pub delta_deg: Option<f64>,
    /// Length spread.
    pub cv: Option<f64>,
    /// Fluency.
    pub fluency: Option<f64>,
    /// What it did.
    pub notes: Vec<String>,
}

/// One candidate.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct CandidateRow {
    /// Its seed, in full.
    pub seed: String,
    /// `lattice` or `random`.
    pub start: String,
    /// Heats it came through.
    pub heats: u32,
    /// What it was judged by.
    pub merit: f64,
    /// Fluency.
    pub fluency: Option<f64>,
    /// Length spread.
    pub cv: f64,
}

/// What is under the pointer.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Picked {
    /// Which run.
    pub run: u32,
    /// The number of the question.
    pub question: u32,
    /// Where the line of sight meets the grid, metres; null where it does not.
    pub at: Option<[f64; 3]>,
    /// The nearest node.
    pub node: Option<u32>,
    /// Its position, metres.
    pub node_at: Option<[f64; 3]>,
    /// The nearest member.
    pub member: Option<[u32; 2]>,
    /// Its ends, metres.
    pub member_at: Option<[[f64; 3]; 2]>,
    /// Whether the node is nearer than the member.
    pub node_first: bool,
    /// What to know of them.
    pub facts: Vec<Fact>,
}

/// One edit, done or possible.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Step {
    /// The edit as it stands in logs.
    #[cfg_attr(test, ts(type = "Record<string, unknown>"))]
    pub edit: Value,
    /// In words.
    pub label: String,
    /// What it does to the figures, in words; empty where it is refused.
    pub effect: String,
    /// Why it is refused.
    pub refusal: Option<String>,
    /// Whether the grid is better for it.
    pub better: bool,
    /// Where it is, metres.
    pub at: Option<[f64; 3]>,
}

/// Head of a binary frame: told in JSON, padded to a multiple of 4 bytes, after its length in 4 bytes (little
/// endian); then the arrays, one after the other.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct FrameHead {
    /// What it shows.
    pub shows: Shows,
    /// Number of the run; 0 for a surface.
    pub run: u32,
    /// The arrays.
    pub arrays: Vec<ArrayHead>,
    /// The scale, where values to color by are among them.
    pub scale: Option<Scale>,
}

/// What a frame shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "snake_case")]
pub enum Shows {
    /// `xyz`, `normals`, `part` (of each point, counted from 1), `triangles`, `lines`.
    Surface,
    /// `xyz`, `radii`.
    Bubbles,
    /// `xyz`, `panels`, `members`, `features` (members on creases and guides), `fixed` (nodes that do not move),
    /// `irregular`, `excess` of a grid being laid.
    Live,
    /// The same of a grid that is done.
    Grid,
    /// The same of a grid between two stages.
    Stage,
    /// `members0` (x, y of both ends), `few0` and `many0` (x, y of irregular nodes) of the first candidate, seen from
    /// above, from 0 to 1; `members1` ... of the next.
    Candidates,
    /// `steps`: the number of each element's color in the scale, 2^32 - 1 without one.
    Colors,
}

/// One array of a frame.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct ArrayHead {
    /// Its name.
    pub name: String,
    /// `f32` or `u32`.
    pub of: String,
    /// Number of numbers.
    pub length: u32,
}

/// What colors stand for.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Scale {
    /// The coloring's name.
    pub by: String,
    /// What is shown, with its unit.
    pub title: String,
    /// What has colors: `members`, `panels` or `nodes`.
    pub on: String,
    /// The colors of the steps, `#rrggbb`.
    pub inks: Vec<String>,
    /// What stands where on the scale.
    pub labels: Vec<Label>,
    /// What else to know, or empty.
    pub note: String,
    /// Whether every node has a color.
    pub all_nodes: bool,
}

/// A label of a scale.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Label {
    /// Where, from 0 to 1.
    pub at: f64,
    /// What is there.
    pub text: String,
}

#[cfg(test)]
mod tests {
    use super::*;
    use ts_rs::{Config, TS};

    /// All types, one after the other.
    fn generated() -> String {
        let config = Config::new();
        let head = "// Generated from message.rs: run `GRIDSHELL_BLESS=1 cargo test -p gridshell-studio`.\n";
        let types = [
            Request::decl(&config),
            Event::decl(&config),
            Hello::decl(&config),
            Named::decl(&config),
            Field::decl(&config),
            Control::decl(&config),
            Coloring::decl(&config),
            SurfaceInfo::decl(&config),
            Part::decl(&config),
            Object::decl(&config),
            Left::decl(&config),
            Damaged::decl(&config),
            Fact::decl(&config),
            Progress::decl(&config),
            RunSummary::decl(&config),
            RunInfo::decl(&config),
            Measure::decl(&config),
            Histogram::decl(&config),
            StageRow::decl(&config),
            CandidateRow::decl(&config),
            Picked::decl(&config),
            Step::decl(&config),
            FrameHead::decl(&config),
            Shows::decl(&config),
            ArrayHead::decl(&config),
            Scale::decl(&config),
            Label::decl(&config),
        ];
        let types: Vec<String> = types.iter().map(|t| format!("export {t}\n")).collect();
        head.to_owned() + &types.join("")
    }

    #[test]
    fn the_page_knows_the_same_messages() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/page/src/messages.ts");
        if std::env::var_os("GRIDSHELL_BLESS").is_some() {
            std::fs::write(path, generated()).unwrap();
        }
        let page = std::fs::read_to_string(path).unwrap_or_default();
        assert_eq!(page, generated(), "page/src/messages.ts is not what message.rs says");
    }
}
