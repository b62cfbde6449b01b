//! A run that goes on: a draft at once, then what was asked for, told and shown while it is laid.

use crate::desk::Desk;
use crate::laid::Laid;
use crate::message::{Event, Progress, Shows};
use crate::opened::Opened;
use crate::scene;
use gridshell::Error;
use gridshell::design::Design;
use gridshell::job::{self, Job, Picture};
use gridshell::recipe::{Effort, Recipe, RegularizeMethod};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, ThreadId};
use std::time::{Duration, Instant};

/// Pictures follow each other no faster: 30 a second.
const PICTURE_EVERY: Duration = Duration::from_millis(33);
/// Messages on progress likewise.
const TELL_EVERY: Duration = Duration::from_millis(100);
/// Another thread's work is shown when the one that is shown says nothing for so long.
const PATIENCE: Duration = Duration::from_millis(300);

/// What is known of the run that goes on.
pub struct Going {
    /// To stop it.
    pub job: Job,
    progress: Arc<Mutex<Progress>>,
    began: Instant,
}

impl Going {
    /// How far it is.
    pub fn progress(&self) -> Progress {
        let told = self.progress.lock().unwrap_or_else(PoisonError::into_inner).clone();
        Progress { seconds: self.began.elapsed().as_secs_f64(), ..told }
    }
}

/// Begin to lay a grid. The draft gets the number `number`, the grid the next one.
pub fn start(desk: &Arc<Desk>, opened: Arc<Opened>, recipe: Recipe, number: u32) -> Going {
    let job = desk.job();
    let began = Instant::now();
    let progress = Progress {
        run: number,
        draft: has_draft(&recipe),
        stage: "prepare".into(),
        fraction: 0.0,
        seconds: 0.0,
    };
    let progress = Arc::new(Mutex::new(progress));
    let going = Going { job: job.clone(), progress: Arc::clone(&progress), began };
    let desk = Arc::clone(desk);
    thread::spawn(move || {
        let mut end = End { desk: Arc::clone(&desk), told: None };
        end.told = Some(lay_both(&desk, &opened, &recipe, &job, &progress, began, number));
    });
    going
}

/// Tells the desk that the run has ended, however it did.
struct End {
    desk: Arc<Desk>,
    told: Option<Result<Option<u32>, String>>,
}

impl Drop for End {
    fn drop(&mut self) {
        match self.told.take() {
            Some(Ok(run)) => self.desk.ended(run, None),
            Some(Err(message)) => self.desk.ended(None, Some(message)),
            None => self.desk.ended(
                None,
                Some("the run crashed. This is a bug in gridshell; please report it".into()),
            ),
        }
    }
}

/// The draft comes first where the grid asked for takes longer.
fn has_draft(recipe: &Recipe) -> bool {
    recipe.effort != Effort::Draft && recipe.regularize.method == RegularizeMethod::Search
}

fn lay_both(
    desk: &Arc<Desk>,
    opened: &Arc<Opened>,
    recipe: &Recipe,
    job: &Job,
    progress: &Arc<Mutex<Progress>>,
    began: Instant,
    number: u32,
) -> Result<Option<u32>, String> {
    let mut draft = None;
    if has_draft(recipe) {
        let quick = Recipe { effort: Effort::Draft, candidates: None, ..recipe.clone() };
        draft = match lay(desk, opened, &quick, job, progress, began, number) {
            Ok(draft) => Some(draft),
            // Who asked for it need not be told.
            Err(Error::Stopped { .. }) => return Ok(None),
            Err(e) => return Err(e.to_string()),
        };
        if job.stopped() {
            return Ok(draft);
        }
    }
    let next = Progress {
        run: number + 1,
        draft: false,
        stage: "prepare".into(),
        fraction: 0.0,
        seconds: 0.0,
    };
    *progress.lock().unwrap_or_else(PoisonError::into_inner) = next;
    match lay(desk, opened, recipe, job, progress, began, number + 1) {
        Ok(run) => Ok(Some(run)),
        Err(Error::Stopped { .. }) => Ok(draft),
        Err(e) => Err(e.to_string()),
    }
}

fn lay(
    desk: &Arc<Desk>,
    opened: &Arc<Opened>,
    recipe: &Recipe,
    job: &Job,
    progress: &Arc<Mutex<Progress>>,
    began: Instant,
    number: u32,
) -> gridshell::Result<u32> {
    let watcher = Mutex::new(Watcher::new(number));
    let (shown_on, told_in) = (Arc::clone(desk), Arc::clone(progress));
    let watched = job.clone().with_progress(move |p| {
        // Who finds another thread at it has nothing to add.
        if let Ok(mut watcher) = watcher.try_lock() {
            watcher.see(p, &shown_on, &told_in, began);
        }
    });
    let design = Design::generate(&opened.model, recipe, &watched)?;
    desk.keep(Laid::of_run(number, design, Arc::clone(opened), None));
    Ok(number)
}

/// Chooses what is shown of the work on many candidates: that of one thread, until it falls silent.
struct Watcher {
    number: u32,
    worker: Option<ThreadId>,
    heard: Option<Instant>,
    shown: Option<Instant>,
    told: Option<Instant>,
    stage: &'static str,
    fraction: f64,
}

impl Watcher {
    fn new(number: u32) -> Watcher {
        Watcher {
            number,
            worker: None,
            heard: None,
            shown: None,
            told: None,
            stage: "",
            fraction: 0.0,
        }
    }

    fn see(&mut self, p: &job::Progress, desk: &Desk, progress: &Mutex<Progress>, began: Instant) {
        let now = Instant::now();
        let long = |since: Option<Instant>, limit| since.is_none_or(|t| now - t >= limit);
        if p.stage != self.stage {
            (self.stage, self.fraction) = (p.stage, 0.0);
        }
        self.fraction = self.fraction.max(p.fraction);
        if long(self.told, TELL_EVERY) {
            self.told = Some(now);
            let mut told = progress.lock().unwrap_or_else(PoisonError::into_inner);
            told.stage = p.stage.into();
            told.fraction = self.fraction;
            told.seconds = began.elapsed().as_secs_f64();
            desk.tell(Event::Progress(told.clone()));
        }
        let worker = Some(thread::current().id());
        if worker != self.worker && !long(self.heard, PATIENCE) {
            return;
        }
        (self.worker, self.heard) = (worker, Some(now));
        if !long(self.shown, PICTURE_EVERY) {
            return;
        }
        match p.picture {
            Picture::None => return,
            Picture::Bubbles { xyz, scales, diameter } => {
                desk.show_live(scene::bubbles(self.number, xyz, scales, diameter));
            }
            Picture::Grid { mesh, xyz } => {
                desk.show_live(scene::nodes_of(Shows::Live, self.number, mesh, xyz));
            }
        }
        self.shown = Some(now);
    }
}
