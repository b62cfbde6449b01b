//! A command run and watched: its exit code, what it says, its time, and the most memory it had.

use std::fs;
use std::io::Read;
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

/// How often the memory is looked at.
const LOOK: Duration = Duration::from_millis(5);

/// What came of a command.
pub struct Watched {
    /// Exit code; None where a signal ended it.
    pub code: Option<i32>,
    /// Standard output.
    pub stdout: String,
    /// Standard error.
    pub stderr: String,
    /// Time from start to end.
    pub seconds: f64,
    /// Processor time, all threads; 0 where the system does not tell, as below.
    pub processor: f64,
    /// Most memory in use, MB; 0 where the system does not tell (it is read from /proc).
    pub megabytes: f64,
}

/// Run `command` to its end.
///
/// # Errors
/// What the system says where it cannot be started.
pub fn run(command: &mut Command) -> Result<Watched, String> {
    let start = Instant::now();
    let mut child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|e| format!("{}: {e}", command.get_program().to_string_lossy()))?;
    let told = [drain(child.stdout.take()), drain(child.stderr.take())];
    let status = format!("/proc/{}/status", child.id());
    let clock = format!("/proc/{}/stat", child.id());
    let mut megabytes = 0.0_f64;
    let mut processor = 0.0_f64;
    let code = loop {
        megabytes = megabytes.max(peak(&status));
        processor = processor.max(spent(&clock));
        if let Some(status) = child.try_wait().map_err(|e| e.to_string())? {
            break status.code();
        }
        thread::sleep(LOOK);
    };
    let seconds = start.elapsed().as_secs_f64();
    let [stdout, stderr] = told.map(|t| t.join().unwrap_or_default());
    Ok(Watched { code, stdout, stderr, seconds, processor, megabytes })
}

/// Read a pipe to its end beside the watching, so that the command never waits for us.
fn drain(pipe: Option<impl Read + Send + 'static>) -> thread::JoinHandle<String> {
    thread::spawn(move || {
        let mut bytes = Vec::new();
        if let Some(mut pipe) = pipe {
            // What was read until it failed is told.
            let _ = pipe.read_to_end(&mut bytes);
        }
        String::from_utf8_lossy(&bytes).into_owned()
    })
}

/// Processor seconds of the process so far: its own and the system's for it, in hundredths.
fn spent(stat: &str) -> f64 {
    let text = fs::read_to_string(stat).unwrap_or_default();
    // Behind the name, which may hold anything, the first of the two is the twelfth field.
    let fields = text.rsplit(')').next().unwrap_or_default().split_whitespace();
    fields.skip(11).take(2).filter_map(|w| w.parse::<f64>().ok()).sum::<f64>() / 100.0
}

/// The most memory the process has had, MB.
fn peak(status: &str) -> f64 {
    let text = fs::read_to_string(status).unwrap_or_default();
    let line = text.lines().find_map(|l| l.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|l| l.split_whitespace().next()?.parse::<f64>().ok());
    kilobytes.unwrap_or(0.0) / 1024.0
}
