//! Whether a job is to stop, and why: one atomic number that polls read, set by who cancels or by a thread that
//! watches a limit.

use super::memory;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicU8, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

/// How often limits are looked at. Shorter costs wake-ups, longer lets a greedy loop take more memory in between: a
/// thread fills at most about a gigabyte a second.
const TICK: Duration = Duration::from_millis(20);
/// How long a stopped job may still work towards its first grid, so that small ones are there at once and large ones
/// end within a second.
const PATIENCE: Duration = Duration::from_millis(500);

const GO_ON: u8 = 0;
const ASKED: u8 = 1;
const MEMORY: u8 = 2;

/// The state that all clones of a job share.
#[derive(Default)]
pub(super) struct Stop {
    state: AtomicU8,
    /// When it was asked to stop.
    since: OnceLock<Instant>,
    patience: OnceLock<Duration>,
    /// Bytes.
    memory: OnceLock<u64>,
    count: Option<Count>,
}

/// The polls of a test.
struct Count {
    polls: AtomicU64,
    by_phase: Mutex<BTreeMap<&'static str, u64>>,
    stop: u64,
    over: u64,
}

impl Count {
    /// Count a poll; gives its number.
    fn poll(&self, phase: &'static str) -> u64 {
        *self.by_phase.lock().unwrap_or_else(PoisonError::into_inner).entry(phase).or_default() +=
            1;
        self.polls.fetch_add(1, Ordering::Relaxed) + 1
    }
}

impl Stop {
    pub(super) fn counting(stop: u64, patience: u64) -> Stop {
        let over = stop.saturating_add(patience);
        let (polls, by_phase) = (AtomicU64::new(0), Mutex::default());
        Stop { count: Some(Count { polls, by_phase, stop, over }), ..Stop::default() }
    }

    pub(super) fn polls(&self) -> BTreeMap<&'static str, u64> {
        let by_phase = self.count.as_ref().map(|c| &c.by_phase);
        by_phase.map_or_else(BTreeMap::new, |m| {
            m.lock().unwrap_or_else(PoisonError::into_inner).clone()
        })
    }

    pub(super) fn set_patience(&self, patience: Duration) {
        // The first one counts.
        let _ = self.patience.set(patience);
    }

    /// Ask to stop, as of `since`.
    pub(super) fn ask(&self, since: Instant) {
        let _ = self.since.set(since);
        let _ = self.state.compare_exchange(GO_ON, ASKED, Ordering::Release, Ordering::Relaxed);
    }

    pub(super) fn is_asked(&self, phase: &'static str) -> bool {
        if let Some(count) = &self.count
            && count.poll(phase) >= count.stop
        {
            return true;
        }
        self.state.load(Ordering::Relaxed) != GO_ON
    }

    pub(super) fn is_over(&self, phase: &'static str) -> bool {
        if let Some(count) = &self.count
            && count.poll(phase) >= count.over
        {
            return true;
        }
        match self.state.load(Ordering::Acquire) {
            GO_ON => false,
            MEMORY => true,
            _ => {
                let patience = self.patience.get().copied().unwrap_or(PATIENCE);
                self.since.get().is_none_or(|since| since.elapsed() >= patience)
            }
        }
    }

    pub(super) fn memory_limit(&self) -> Option<u64> {
        self.memory.get().copied()
    }

    /// The limit, where that is why the job is over.
    pub(super) fn short_of_memory(&self) -> Option<u64> {
        let short = self.state.load(Ordering::Relaxed) == MEMORY;
        self.memory_limit().filter(|_| short)
    }
}

/// Ask to stop at `deadline`.
pub(super) fn watch_time(stop: &Arc<Stop>, deadline: Instant) {
    watch(stop, move |stop| {
        let left = deadline.saturating_duration_since(Instant::now());
        if left.is_zero() {
            stop.ask(deadline);
        }
        left
    });
}

/// Ask to stop when the process holds more than `limit` bytes.
pub(super) fn watch_memory(stop: &Arc<Stop>, limit: u64) {
    if stop.memory.set(limit).is_err() {
        return;
    }
    watch(stop, move |stop| {
        // Where the system does not tell, only estimates count.
        let Some(held) = memory::resident() else { return Duration::ZERO };
        if held > limit {
            stop.state.store(MEMORY, Ordering::Release);
            return Duration::ZERO;
        }
        TICK
    });
}

/// Look now, and from a thread of its own as long as the job lives and `look` says how long to wait (at most) before the next look;
/// zero ends it.
fn watch(stop: &Arc<Stop>, look: impl Fn(&Stop) -> Duration + Send + 'static) {
    let mut wait = look(stop);
    let job = Arc::downgrade(stop);
    let watching = move || {
        while !wait.is_zero() {
            std::thread::sleep(wait.min(TICK));
            let Some(stop) = job.upgrade() else { return };
            wait = look(&stop);
        }
    };
    // A system without room for a thread cannot run the stages either.
    let _ = std::thread::Builder::new().name("limits".into()).spawn(watching);
}
