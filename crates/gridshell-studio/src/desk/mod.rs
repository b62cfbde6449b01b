//! What is on the desk: the open surface, the grids laid on it, and the run that goes on. All tabs see the same desk.

mod answer;
mod files;
mod room;

use crate::export::{self, Exported};
use crate::form::{self, Values};
use crate::laid::Laid;
use crate::laying::{self, Going};
use crate::message::{Event, RunSummary};
use crate::opened::Opened;
use crate::session::{Ended, Session};
use crate::told::{self, EXPORTS};
use axum::body::Bytes;
use gridshell::error::{Error, Result};
use gridshell::job::{Job, Picture};
use gridshell::recipe::Recipe;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tokio::sync::{broadcast, watch};

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

#[derive(Default)]
struct State {
    opened: Option<Arc<Opened>>,
    runs: Vec<Arc<Laid>>,
    numbers: u32,
    going: Option<Going>,
    /// What is being opened, or was last.
    opening: Option<Job>,
    /// Another work that goes on, an edit, say; and on which run.
    work: Option<(u32, Job)>,
    /// The recipe of the grid that was opened last, and its number: what the form begins with.
    recipe: Option<(u32, Recipe)>,
    /// Where grids are kept against crashes.
    session: Option<Arc<Session>>,
    /// Why they cannot be kept.
    autosave: Option<String>,
    /// What earlier sessions left.
    left: Vec<Ended>,
    /// So many more sessions are not read yet.
    left_more: u32,
    /// Counts what is looked at.
    looks: u64,
}

/// The desk. Its state is locked for moments only, never while anything is worked on, read or written: so tabs are
/// greeted and work is cancelled at any time.
pub struct Desk {
    memory_limit: Option<u64>,
    state: Mutex<State>,
    events: broadcast::Sender<Outgoing>,
    live: watch::Sender<Option<Bytes>>,
}

impl Desk {
    /// An empty desk; `memory_limit` is in bytes.
    pub fn new(memory_limit: Option<u64>) -> Desk {
        Desk {
            memory_limit,
            state: Mutex::default(),
            events: broadcast::channel(BACKLOG).0,
            live: watch::channel(None).0,
        }
    }

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
        all.extend(recipe(&state).map(Outgoing::Event));
        all.push(Outgoing::Event(runs(&state)));
        all.push(Outgoing::Event(left(&state)));
        all.push(Outgoing::Event(Event::Autosave { fault: state.autosave.clone() }));
        match &state.going {
            Some(going) => all.push(Outgoing::Event(Event::Progress(going.progress()))),
            None => all.push(Outgoing::Event(Event::Idle { run: None })),
        }
        all
    }

    fn generate(self: &Arc<Self>, values: &Values) -> Result<()> {
        let opened = self.opened()?;
        let recipe = self.recipe(values)?;
        let mut state = self.state();
        if state.going.is_some() {
            return Err(Error::Option("a run is already in progress; cancel it first".into()));
        }
        let going = laying::start(self, opened, recipe, state.numbers + 1);
        state.numbers += 2;
        self.tell(Event::Progress(going.progress()));
        state.going = Some(going);
        Ok(())
    }

    /// Ask whatever goes on to stop.
    pub fn cancel(&self) {
        let state = self.state();
        let going = state.going.iter().map(|going| &going.job);
        let work = state.work.iter().map(|work| &work.1);
        going.chain(work).chain(&state.opening).for_each(Job::cancel);
    }

    /// Whether a run goes on.
    pub fn is_busy(&self) -> bool {
        self.state().going.is_some()
    }

    /// The number of the grid that came last.
    pub fn newest(&self) -> Option<u32> {
        self.state().runs.last().map(|run| run.number)
    }

    /// Begin something that may take a while: told of when it does, until it is dropped.
    fn begin(self: &Arc<Self>, run: u32, what: &str) -> Result<Work> {
        let job = self.job();
        {
            let mut state = self.state();
            if state.work.is_some() {
                let message = "another edit is in progress; wait for it or cancel it";
                return Err(Error::Option(message.into()));
            }
            state.work = Some((run, job.clone()));
        }
        let (desk, what) = (Arc::downgrade(self), what.to_owned());
        let watched = job.with_progress(move |p| {
            let Some(desk) = desk.upgrade() else { return };
            desk.tell(Event::Working { run, what: what.clone(), fraction: p.fraction });
        });
        watched.progress("begin", 0.0, Picture::None);
        Ok(Work { desk: Arc::clone(self), job: watched })
    }

    /// A job for work on the desk, within the limits.
    pub(crate) fn job(&self) -> Job {
        match self.memory_limit {
            Some(limit) => Job::default().with_memory_limit(limit),
            None => Job::default(),
        }
    }

    /// A job for opening something.
    fn opening(&self) -> Job {
        let job = self.job();
        self.state().opening = Some(job.clone());
        job
    }

    /// The next grid's number.
    fn number(&self) -> u32 {
        let mut state = self.state();
        state.numbers += 1;
        state.numbers
    }

    /// The recipe that the form's values make.
    fn recipe(&self, values: &Values) -> Result<Recipe> {
        let state = self.state();
        form::recipe(values, state.recipe.as_ref().map(|r| &r.1))
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

    /// The grid of a run in the format of this extension. Changes nothing: whether the file arrives is not known.
    ///
    /// # Errors
    /// [`Error::Option`] for an unknown run or format.
    pub fn export(&self, run: u32, extension: &str) -> Result<Exported> {
        if !EXPORTS.iter().any(|e| e.0 == extension) {
            return Err(Error::Option(format!("no format `{extension}`")));
        }
        let laid = self.laid(run)?;
        export::file(&laid, extension)
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

/// Something that goes on beside the run.
struct Work {
    desk: Arc<Desk>,
    job: Job,
}

impl Drop for Work {
    fn drop(&mut self) {
        self.desk.state().work = None;
        self.desk.tell(Event::Worked);
    }
}

fn recipe(state: &State) -> Option<Event> {
    let (run, recipe) = state.recipe.as_ref()?;
    Some(Event::Recipe { run: *run, values: form::values(recipe) })
}

fn left(state: &State) -> Event {
    Event::Left { sessions: state.left.iter().map(Ended::told).collect(), more: state.left_more }
}

fn runs(state: &State) -> Event {
    let runs: Vec<RunSummary> = state.runs.iter().map(|r| r.summary()).collect();
    Event::Runs { newest: runs.last().map(|r| r.run), runs }
}

fn shown(opened: &Opened) -> [Outgoing; 2] {
    [Outgoing::Event(Event::Surface(opened.info.clone())), Outgoing::Frame(opened.frame.clone())]
}

#[cfg(test)]
mod tests;
