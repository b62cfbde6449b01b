//! The studio from a program of one's own: `cargo run -p gridshell-studio --example serve [SURFACE] [PAGE]`.

use gridshell_studio::{Options, run};
use std::sync::Arc;

fn main() -> Result<(), gridshell_studio::Error> {
    let mut arguments = std::env::args().skip(1);
    let surface = arguments.next().unwrap_or_else(|| "great-court".into());
    let log = Arc::new(|line: &str| eprintln!("{line}"));
    let page = arguments.next().map(Into::into);
    let options = Options { surface, port: 0, log, page, state: None, memory_limit: None };
    run(options, |address| {
        println!("{address}");
        None
    })
}
