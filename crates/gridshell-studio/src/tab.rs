//! A tab without a browser: messages go in as text and are answered as the server would, for tests and fuzzing.

use crate::desk::{Desk, Outgoing};
use crate::message::{Event, Request};
use serde_json::{Value, json};
use std::sync::Arc;
use std::time::Duration;

/// How often a run that was cancelled is looked at until it has ended.
const LOOK_EVERY: Duration = Duration::from_millis(1);

/// A desk with the built-in hexagon and a draft of 19 nodes on it, seen from its only tab.
pub struct Tab {
    desk: Arc<Desk>,
    run: u32,
}

impl Default for Tab {
    fn default() -> Tab {
        let mut tab = Tab { desk: Arc::new(Desk::new(None)), run: 0 };
        tab.say(&json!({ "kind": "open", "name": "hexagon" }).to_string());
        let values = json!({ "edge_length": 2.0, "effort": "draft" });
        tab.ask(&json!({ "kind": "generate", "values": values }).to_string());
        tab.wait();
        tab.run = tab.desk.newest().unwrap_or_default();
        tab
    }
}

impl Tab {
    /// The number of the grid that it was opened with.
    pub fn run(&self) -> u32 {
        self.run
    }

    /// Send a message and wait until it is answered and no run goes on: one that it began is cancelled. The faults that
    /// are told; None where the text is not a message.
    pub fn say(&self, text: &str) -> Option<Vec<String>> {
        let told = self.ask(text);
        self.desk.cancel();
        self.wait();
        told
    }

    fn ask(&self, text: &str) -> Option<Vec<String>> {
        let request: Request = serde_json::from_str(text).ok()?;
        let told = self.desk.answer(request).into_iter().filter_map(|outgoing| match outgoing {
            Outgoing::Event(Event::Fault { message, .. }) => Some(message),
            Outgoing::Event(_) | Outgoing::Frame(_) => None,
        });
        Some(told.collect())
    }

    fn wait(&self) {
        while self.desk.is_busy() {
            std::thread::sleep(LOOK_EVERY);
        }
    }

    /// The grid that it was opened with, as a grid file holds it.
    ///
    /// # Errors
    /// Why it cannot be had.
    pub fn grid(&self) -> Result<Value, String> {
        let exported = self.desk.export(self.run, "gridshell").map_err(|e| e.to_string())?;
        serde_json::from_slice(&exported.bytes).map_err(|e| e.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_are_answered_as_a_tab_would_be() {
        let tab = Tab::default();
        let run = tab.run();
        assert_eq!(tab.grid().unwrap()["nodes"].as_array().unwrap().len(), 19);
        assert_eq!(tab.say("{}"), None);
        let color =
            |by: &str| tab.say(&json!({ "kind": "color", "run": run, "by": by }).to_string());
        assert!(color("length").unwrap().is_empty());
        assert!(color("taste").unwrap()[0].contains("taste"));
        let select =
            json!({ "kind": "select", "run": run, "matrix": [1, 2], "rectangle": [0, 0, 1, 1] });
        assert!(tab.say(&select.to_string()).unwrap()[0].contains("16"));
        let values = json!({ "edge_length": 0.05, "effort": "best" });
        let began = json!({ "kind": "generate", "values": values });
        assert!(tab.say(&began.to_string()).unwrap().is_empty());
    }
}
