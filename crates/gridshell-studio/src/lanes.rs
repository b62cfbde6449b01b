//! What of a tab's wishes waits for what. Those of one lane are answered in turn, lanes beside each other: a pick does
//! not wait for suggestions, nor an edit for a file that is read.

use crate::aside::aside;
use crate::desk::{self, Desk, Outgoing};
use crate::message::Request as Wish;
use std::sync::Arc;
use tokio::sync::mpsc::{Receiver, Sender, channel, error::TrySendError};

/// Wishes of one lane that wait.
const WAITING: usize = 64;

/// What takes about as long as its fellows.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Lane {
    /// Looks: milliseconds.
    Quick,
    /// What operations on a member would do; only the last question matters.
    Hover,
    /// Suggestions: seconds; only the last question matters.
    Suggest,
    /// Changes: seconds, or minutes.
    Change,
    /// Surfaces and what is asked of them: a large file takes seconds.
    Surface,
}

const LANES: [Lane; 5] = [Lane::Quick, Lane::Hover, Lane::Suggest, Lane::Change, Lane::Surface];

/// The lane of a wish.
fn lane(wish: &Wish) -> Lane {
    match wish {
        Wish::Hover { .. } => Lane::Hover,
        Wish::Suggest { .. } => Lane::Suggest,
        Wish::Edit { .. } | Wish::Undo { .. } | Wish::Redo { .. } | Wish::Take { .. } => {
            Lane::Change
        }
        Wish::Open { .. }
        | Wish::Choose { .. }
        | Wish::Recover { .. }
        | Wish::Discard { .. }
        | Wish::Estimate { .. }
        | Wish::Generate { .. } => Lane::Surface,
        Wish::Cancel
        | Wish::Look { .. }
        | Wish::Color { .. }
        | Wish::Pick { .. }
        | Wish::Select { .. }
        | Wish::Distance { .. }
        | Wish::Candidates { .. }
        | Wish::Candidate { .. }
        | Wish::Saved { .. }
        | Wish::Forget { .. } => Lane::Quick,
    }
}

/// The lanes of one tab, until it goes.
pub struct Lanes([Sender<Wish>; LANES.len()]);

impl Lanes {
    /// Answer on `answers` from now on.
    pub fn begin(desk: &Arc<Desk>, answers: &Sender<Outgoing>) -> Lanes {
        Lanes(LANES.map(|lane| {
            let (wishes, waiting) = channel(WAITING);
            tokio::spawn(answer_all(lane, waiting, Arc::clone(desk), answers.clone()));
            wishes
        }))
    }

    /// Have a wish answered in its turn; false where too many wait.
    pub fn wish(&self, wish: Wish) -> bool {
        let lane = lane(&wish);
        let at = LANES.iter().position(|l| *l == lane).unwrap_or(0);
        // A lane that is closed is one of a tab that is gone.
        !matches!(self.0[at].try_send(wish), Err(TrySendError::Full(_)))
    }
}

async fn answer_all(
    lane: Lane,
    mut waiting: Receiver<Wish>,
    desk: Arc<Desk>,
    answers: Sender<Outgoing>,
) {
    while let Some(mut wish) = waiting.recv().await {
        if matches!(lane, Lane::Hover | Lane::Suggest) {
            while let Ok(newer) = waiting.try_recv() {
                wish = newer;
            }
        }
        let desk = Arc::clone(&desk);
        let answer = move || match lane {
            // Nothing in them is worth threads of its own.
            Lane::Quick | Lane::Hover => desk.answer(wish),
            Lane::Suggest | Lane::Change | Lane::Surface => aside(|| desk.answer(wish)),
        };
        let all = tokio::task::spawn_blocking(answer).await;
        let broken = |_| vec![desk::fault("message", "answering broke off: please report it")];
        for outgoing in all.unwrap_or_else(broken) {
            if answers.send(outgoing).await.is_err() {
                return;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn of_questions_on_the_pointer_only_the_last_is_answered() {
        for lane in [Lane::Hover, Lane::Suggest] {
            let (wishes, waiting) = channel(WAITING);
            let (answers, mut answered) = channel(WAITING);
            for run in 1..=3 {
                wishes.send(Wish::Suggest { run }).await.unwrap();
            }
            drop(wishes);
            answer_all(lane, waiting, Arc::new(Desk::new(None)), answers).await;
            let Some(Outgoing::Event(told)) = answered.recv().await else { panic!("no answer") };
            assert!(format!("{told:?}").contains("there is no run 3"), "{told:?}");
            assert!(answered.recv().await.is_none(), "one answer");
        }
    }
}
