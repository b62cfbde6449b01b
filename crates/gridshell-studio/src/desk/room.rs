//! Room on the desk: which grids are kept, and which make way for new ones.

use super::{Desk, State, runs};
use crate::laid::Laid;
use crate::message::Event;
use gridshell::error::Result;
use std::cmp::Reverse;
use std::sync::Arc;

/// Grids without changes by hand that are kept: enough to compare, and small beside the memory of a machine. Those
/// with changes that are in no file stay, however many.
const MOST_UNTOUCHED: usize = 12;

impl Desk {
    /// Keep a grid; against crashes, too, if no file of the user's holds it.
    pub fn keep(&self, laid: Laid) -> Arc<Laid> {
        let laid = Arc::new(laid);
        self.used(&laid);
        let mut state = self.state();
        state.runs.push(Arc::clone(&laid));
        if let (Some(session), true) = (&state.session, laid.design.run.is_some() || laid.unsaved())
        {
            session.save(&laid);
        }
        let gone = state.put_away();
        if !gone.is_empty() {
            let told = |laid: &Arc<Laid>| {
                let summary = laid.summary();
                format!("{}: {}, {}", summary.run, summary.title, summary.detail)
            };
            self.tell(Event::PutAway { grids: gone.iter().map(told).collect() });
        }
        self.tell(runs(&state));
        // Large grids are dropped after the state is free again.
        drop(state);
        laid
    }

    /// A grid is looked at.
    pub(super) fn used(&self, laid: &Laid) {
        let mut state = self.state();
        state.looks += 1;
        laid.use_at(state.looks);
    }

    /// The user has this version of a grid in a file: as long as that is the grid as it is, it need not be kept
    /// against crashes.
    pub(super) fn saved(&self, run: u32, version: u32) -> Result<()> {
        let laid = self.laid(run)?;
        let state = self.state();
        if laid.saved(version) {
            state.no_longer(run);
        }
        self.tell(runs(&state));
        Ok(())
    }

    /// Take a grid off the desk, as the user asked.
    pub(super) fn forget(&self, run: u32) {
        let mut state = self.state();
        state.runs.retain(|r| r.number != run);
        state.no_longer(run);
        self.tell(runs(&state));
    }
}

impl State {
    /// Take grids off the desk where there are too many without changes by hand; these.
    fn put_away(&mut self) -> Vec<Arc<Laid>> {
        let changed = self.work.as_ref().map(|work| work.0);
        let surplus = surplus(&self.runs, changed);
        let (gone, kept) = self.runs.drain(..).partition(|r| surplus.contains(&r.number));
        self.runs = kept;
        let gone: Vec<Arc<Laid>> = gone;
        for laid in &gone {
            self.no_longer(laid.number);
        }
        gone
    }

    /// A grid need not be kept against crashes any more.
    fn no_longer(&self, number: u32) {
        if let Some(session) = &self.session {
            session.forget(number);
        }
    }
}

/// The grids that make way: of those without changes by hand the drafts first, then those that were looked at longest
/// ago; never the newest, nor the one that is being changed.
fn surplus(runs: &[Arc<Laid>], changed: Option<u32>) -> Vec<u32> {
    let mut untouched: Vec<&Arc<Laid>> =
        runs.iter().filter(|r| !r.unsaved() && Some(r.number) != changed).collect();
    let surplus = untouched.len().saturating_sub(MOST_UNTOUCHED);
    let newest = runs.last().map(|r| r.number);
    untouched.retain(|r| Some(r.number) != newest);
    untouched.sort_by_key(|r| (Reverse(r.is_draft()), r.used()));
    untouched.iter().take(surplus).map(|r| r.number).collect()
}
