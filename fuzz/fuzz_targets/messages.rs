//! Messages of the studio's page, one a line: each is answered or refused, and the grid stays a list of numbers.
#![no_main]
use gridshell_studio::Tab;
use std::cell::RefCell;

/// Lines of one input that are sent.
const MOST: usize = 8;

thread_local! {
    static TAB: RefCell<Tab> = RefCell::default();
}

libfuzzer_sys::fuzz_target!(|text: &str| {
    TAB.with_borrow_mut(|tab| {
        let mut edited = false;
        for line in text.lines().take(MOST) {
            edited |= tab.say(line).is_some();
        }
        if !edited {
            return;
        }
        // A run that was forgotten is refused in words.
        if let Ok(grid) = tab.grid() {
            let nodes = grid["nodes"].as_array().expect("a grid has nodes");
            let numbers = |node: &serde_json::Value| node.to_string().contains("null");
            assert!(!nodes.iter().any(numbers), "a place that is none");
        }
        *tab = Tab::default();
    });
});
