//! How many threads work, and how the process is set up before the work begins.

use crate::failure::Failure;
use crate::say;
use std::env;

/// More threads than this for each core only stand in each other's way.
const MOST_PER_CORE: usize = 4;

/// Start the threads: as many as are asked for by `--threads` or `RAYON_NUM_THREADS`, else one a core.
pub fn start(asked: Option<u16>) -> Result<(), Failure> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let by_flag = asked.map(usize::from);
    let wanted = by_flag.or_else(by_environment).unwrap_or(cores);
    let most = MOST_PER_CORE * cores;
    if wanted > most {
        let whole = if cores == 1 { "1 core" } else { &format!("{cores} cores") };
        say::note(&format!(
            "note: {wanted} threads on {whole} would only slow each other down: {most} are used"
        ));
    }
    let count = wanted.min(most);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build_global();
    pool.map_err(|e| {
        Failure::other(format!("{count} threads cannot be started: {e}; try --threads 1"))
    })
}

fn by_environment() -> Option<usize> {
    env::var("RAYON_NUM_THREADS").ok()?.trim().parse().ok().filter(|&n| n > 0)
}

/// Have a file that may not grow any more end in an error of the write, as a full disk does, and not end the process.
#[cfg(unix)]
pub fn keep_when_files_are_limited() {
    use signal_hook::consts::SIGXFSZ;
    // Where that is not allowed the process ends as it always did.
    let _ = signal_hook::flag::register(SIGXFSZ, std::sync::Arc::default());
}

#[cfg(not(unix))]
pub fn keep_when_files_are_limited() {}
