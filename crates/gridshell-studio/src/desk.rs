//! What is on the desk: the open surface, the runs laid on it, and the one that goes on. All tabs see the same desk.

use crate::form::{self, Values};
use crate::laid::Laid;
use crate::laying::{self, Going};
use crate::message::{Event, Request, RunSummary, Shows, SurfaceInfo};
use crate::told::{self, EXPORTS};
use crate::{color, editing, measures, pick, scene};
use axum::body::Bytes;
use glam::DVec3;
use gridshell::edit::Editor;
use gridshell::error::{Error, Result};
use gridshell::inspect::{self, Sketch};
use gridshell::io::Reference;
use gridshell::recipe::Recipe;
use gridshell::stages::measure::irregular_nodes;
use gridshell::surface::{Model, Surface, builtin};
use gridshell::{io, pipeline};
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tokio::sync::{broadcast, watch};

/// Runs that are kept; the oldest go first.
const MOST_RUNS: usize = 12;
/// Events that a slow tab may fall behind before it is sent everything anew.
const BACKLOG: usize = 256;

/// What goes to a tab.
#[derive(Clone, Debug)]
pub enum Outgoing {
    /// A message.
    Event(Event),
    /// A binary frame.
    Frame(Bytes),
}

/// The open surface.
pub struct Opened {
    /// What was opened.
    pub model: Model,
    /// A coarse surface for pictures and picking.
    pub sketch: Surface,
    /// Where others find it; None where it came through the browser.
    pub reference: Option<Reference>,
    info: SurfaceInfo,
    frame: Bytes,
}

#[derive(Default)]
struct State {
    opened: Option<Arc<Opened>>,
    runs: Vec<Arc<Laid>>,
    numbers: u32,
    going: Option<Going>,
}

/// The desk.
pub struct Desk {
    state: Mutex<State>,
    events: broadcast::Sender<Outgoing>,
    live: watch::Sender<Option<Bytes>>,
}

impl Default for Desk {
    fn default() -> Desk {
        Desk {
            state: Mutex::default(),
            events: broadcast::channel(BACKLOG).0,
            live: watch::channel(None).0,
        }
    }
}

impl Desk {
    /// What is told to every tab from now on.
    pub fn events(&self) -> broadcast::Receiver<Outgoing> {
        self.events.subscribe()
    }

    /// The newest picture of the run that goes on.
    pub fn live(&self) -> watch::Receiver<Option<Bytes>> {
        self.live.subscribe()
    }

    /// Everything that a new tab has to know.
    pub fn greeting(&self) -> Vec<Outgoing> {
        let state = self.state();
        let mut all = vec![Outgoing::Event(Event::Hello(told::hello()))];
        if let Some(opened) = &state.opened {
            all.extend(shown(opened));
        }
        all.push(Outgoing::Event(runs(&state)));
        match &state.going {
            Some(going) => all.push(Outgoing::Event(Event::Progress(going.progress()))),
            None => all.push(Outgoing::Event(Event::Idle { run: None })),
        }
        all
    }

    /// Answer what a tab asks for.
    pub fn answer(self: &Arc<Self>, request: Request) -> Vec<Outgoing> {
        let about = match &request {
            Request::Open { .. } => "open",
            Request::Estimate { .. } => "estimate",
            Request::Generate { .. } => "generate",
            _ => "message",
        };
        self.try_answer(request).unwrap_or_else(|error| vec![fault(about, &error.to_string())])
    }

    fn try_answer(self: &Arc<Self>, request: Request) -> Result<Vec<Outgoing>> {
        let one = |event| Ok(vec![Outgoing::Event(event)]);
        match request {
            Request::Open { name } => {
                let model = builtin::model(&name).ok_or_else(|| {
                    Error::Option(format!("there is no built-in surface `{name}`"))
                })?;
                self.put(model, Some(Reference::Builtin(name)))?;
                Ok(Vec::new())
            }
            Request::Estimate { values } => one(self.estimate(&values)?),
            Request::Generate { values } => {
                self.generate(&values)?;
                Ok(Vec::new())
            }
            Request::Cancel => {
                self.cancel();
                Ok(Vec::new())
            }
            Request::Look { run, stage } => self.look(run, stage.as_deref()),
            Request::Color { run, by } => {
                let laid = self.laid(run)?;
                let frame = color::frame(run, &laid.grid(), &laid.opened.sketch, &by);
                let frame = frame.ok_or_else(|| Error::Option(format!("no coloring `{by}`")))?;
                Ok(vec![Outgoing::Frame(frame)])
            }
            Request::Pick { run, origin, direction, question } => {
                let laid = self.laid(run)?;
                let [origin, direction] = [origin, direction].map(DVec3::from);
                one(Event::Picked(pick::pick(&laid.grid(), run, question, origin, direction)))
            }
            Request::Select { run, matrix, rectangle } => {
                let laid = self.laid(run)?;
                let matrix = matrix
                    .try_into()
                    .map_err(|_| Error::Option("a matrix has 16 numbers".into()))?;
                let grid = laid.grid();
                let nodes = pick::within(&grid, &matrix, rectangle);
                let odd = irregular_nodes(&grid)
                    .into_iter()
                    .filter(|n| nodes.binary_search(&n.node).is_ok());
                let irregular = odd.count() as u32;
                one(Event::Selected { run, nodes, irregular })
            }
            Request::Distance { from, to } => {
                let d = DVec3::from(to) - DVec3::from(from);
                one(Event::Distance {
                    straight: d.length(),
                    plan: d.truncate().length(),
                    height: d.z,
                })
            }
            Request::Edit { run, edit } => {
                let edit = editing::parse(edit)?;
                self.edited(run, |editor| {
                    let done = editor.apply(edit).map(|_| ());
                    done.map_err(|refusal| Error::Option(refusal.to_string()))
                })
            }
            Request::Undo { run } => self.edited(run, |editor| {
                editor
                    .undo()
                    .map(|_| ())
                    .ok_or_else(|| Error::Option("there is nothing to undo".into()))
            }),
            Request::Redo { run } => self.edited(run, |editor| {
                editor
                    .redo()
                    .map(|_| ())
                    .ok_or_else(|| Error::Option("there is nothing to redo".into()))
            }),
            Request::Hover { run, nodes, question } => {
                let laid = self.laid(run)?;
                one(laid.edit(|editor| Ok(editing::hover(run, question, editor, nodes)))?)
            }
            Request::Suggest { run } => {
                let laid = self.laid(run)?;
                one(laid.edit(|editor| Ok(editing::suggest(run, editor)))?)
            }
            Request::Forget { run } => {
                let mut state = self.state();
                state.runs.retain(|r| r.number != run);
                self.tell(runs(&state));
                Ok(Vec::new())
            }
        }
    }

    /// Open a built-in surface or a file.
    ///
    /// # Errors
    /// What [`io::open`] and [`inspect::inspect`] say.
    pub fn open(&self, name_or_path: &str) -> Result<()> {
        let reference = io::reference(name_or_path, &io::Opening::default())?;
        self.put(io::open(name_or_path)?, Some(reference))
    }

    /// Open the file at `path`, which was sent under `name`; messages tell of the name.
    ///
    /// # Errors
    /// As [`Desk::open`].
    pub fn open_sent(&self, path: &Path, name: &str) -> Result<()> {
        let model = io::load(path, &io::Opening::default()).map_err(|e| {
            let told = e.to_string().replace(&path.display().to_string(), name);
            Error::Surface(told)
        })?;
        self.put(model, None)
    }

    fn put(&self, model: Model, reference: Option<Reference>) -> Result<()> {
        let inspection = inspect::inspect(&model)?;
        let Sketch { surface: sketch, .. } = inspect::sketch(&model)?;
        let info = told::info(&inspection, &sketch);
        let frame = scene::surface(&sketch);
        let opened = Arc::new(Opened { model, sketch, reference, info, frame });
        self.cancel();
        let mut state = self.state();
        state.opened = Some(Arc::clone(&opened));
        for outgoing in shown(&opened) {
            self.send(outgoing);
        }
        Ok(())
    }

    fn estimate(&self, values: &Values) -> Result<Event> {
        let opened = self.opened()?;
        let recipe = form::recipe(values)?;
        let edge_length = edge_length(&opened, &recipe)?;
        // What makes so many nodes makes members of so many metres: the inverse by bisection of a falling function.
        let (mut low, mut high) = (3.0_f64, 2e6_f64);
        while high - low > 0.5 {
            let middle = f64::midpoint(low, high);
            if pipeline::length_for(&opened.sketch, middle as usize) > edge_length {
                low = middle;
            } else {
                high = middle;
            }
        }
        Ok(Event::Estimate { edge_length, nodes: high.round() as u32 })
    }

    fn generate(self: &Arc<Self>, values: &Values) -> Result<()> {
        let opened = self.opened()?;
        let recipe = form::recipe(values)?;
        let mut state = self.state();
        if state.going.is_some() {
            return Err(Error::Option("a run goes on already: cancel it first".into()));
        }
        let going = laying::start(self, opened, recipe, state.numbers + 1);
        state.numbers += 2;
        self.tell(Event::Progress(going.progress()));
        state.going = Some(going);
        Ok(())
    }

    /// Ask the run that goes on to stop.
    pub fn cancel(&self) {
        if let Some(going) = &self.state().going {
            going.job.cancel();
        }
    }

    /// Keep a run.
    pub fn keep(&self, laid: Laid) {
        let mut state = self.state();
        state.runs.push(Arc::new(laid));
        let surplus = state.runs.len().saturating_sub(MOST_RUNS);
        state.runs.drain(..surplus);
        self.tell(runs(&state));
    }

    /// The run that went on has ended.
    pub fn ended(&self, run: Option<u32>, fault: Option<String>) {
        self.state().going = None;
        self.live.send_replace(None);
        if let Some(message) = fault {
            self.tell(Event::Fault { about: "generate".into(), message });
        }
        self.tell(Event::Idle { run });
    }

    /// Tell every tab.
    pub fn tell(&self, event: Event) {
        self.send(Outgoing::Event(event));
    }

    /// Show the run that goes on.
    pub fn show_live(&self, frame: Bytes) {
        self.live.send_replace(Some(frame));
    }

    /// The grid of a run in the format of this extension.
    ///
    /// # Errors
    /// [`Error::Option`] for an unknown run or format.
    pub fn export(&self, run: u32, extension: &str) -> Result<(String, Vec<u8>)> {
        if !EXPORTS.iter().any(|e| e.0 == extension) {
            return Err(Error::Option(format!("no format `{extension}`")));
        }
        let laid = self.laid(run)?;
        laid.file(extension)
    }

    /// Change a run's grid; every tab is told.
    fn edited(
        &self,
        run: u32,
        work: impl FnOnce(&mut Editor) -> Result<()>,
    ) -> Result<Vec<Outgoing>> {
        let laid = self.laid(run)?;
        laid.change(work)?;
        for outgoing in self.look(run, None)? {
            self.send(outgoing);
        }
        let state = self.state();
        self.tell(runs(&state));
        Ok(Vec::new())
    }

    fn look(&self, run: u32, stage: Option<&str>) -> Result<Vec<Outgoing>> {
        let laid = self.laid(run)?;
        if let Some(name) = stage {
            let found =
                laid.run.stages.iter().find(|s| s.name == name).and_then(|s| s.grid.as_ref());
            let grid =
                found.ok_or_else(|| Error::Option(format!("no stage `{name}` with a grid")))?;
            return Ok(vec![Outgoing::Frame(scene::grid(Shows::Stage, run, grid))]);
        }
        let summary = laid.summary();
        let now = laid.now();
        let info = measures::told(summary, &laid.run, &now.quality, &now.grid, &laid.opened.sketch);
        let history = match &now.editor {
            Some(editor) => editing::history(run, editor),
            None => Event::History { run, done: Vec::new(), undone: Vec::new() },
        };
        let frame = scene::grid(Shows::Grid, run, &now.grid);
        Ok(vec![
            Outgoing::Frame(frame),
            Outgoing::Event(Event::Run(info)),
            Outgoing::Event(history),
        ])
    }

    fn opened(&self) -> Result<Arc<Opened>> {
        self.state().opened.clone().ok_or_else(|| Error::Option("open a surface first".into()))
    }

    fn laid(&self, run: u32) -> Result<Arc<Laid>> {
        let found = self.state().runs.iter().find(|r| r.number == run).cloned();
        found.ok_or_else(|| Error::Option(format!("there is no run {run} any more")))
    }

    fn send(&self, outgoing: Outgoing) {
        // Without a tab nobody listens.
        let _ = self.events.send(outgoing);
    }

    /// The state; a thread that panicked has left it whole: nothing in here is changed halfway.
    fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// What a fault looks like.
pub fn fault(about: &str, message: &str) -> Outgoing {
    Outgoing::Event(Event::Fault { about: about.into(), message: message.into() })
}

/// The member length that a recipe aims at, metres.
fn edge_length(opened: &Opened, recipe: &Recipe) -> Result<f64> {
    match (recipe.edge_length, recipe.nodes) {
        (Some(length), _) => {
            Recipe::check_edge_length(length, opened.sketch.area)?;
            Ok(length)
        }
        (None, Some(nodes)) => Ok(pipeline::length_for(&opened.sketch, nodes)),
        (None, None) => Ok(opened.info.edge_length),
    }
}

fn runs(state: &State) -> Event {
    let runs: Vec<RunSummary> = state.runs.iter().map(|r| r.summary()).collect();
    Event::Runs { newest: runs.last().map(|r| r.run), runs }
}

fn shown(opened: &Opened) -> [Outgoing; 2] {
    [Outgoing::Event(Event::Surface(opened.info.clone())), Outgoing::Frame(opened.frame.clone())]
}
