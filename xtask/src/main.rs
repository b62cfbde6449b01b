//! The project's own chores: `cargo xtask lint | test | readers | cases | bench | picture | pictures | prove |
//! fuzz | package | dist`.
//!
//! Everything here builds in the dev profile, so that the dependencies are compiled once; only the chores that
//! lay grids run the release build of the command, because they tell times or take theirs.

mod build;
mod cases;
mod check;
mod fuzz;
mod laid;
mod licences;
mod package;
mod page;
mod prove;
mod quality;
mod readers;
mod watched;

use quality::Scope;
use std::process::ExitCode;

const USAGE: &str = "\
usage: cargo xtask CHORE
  lint                    format, clippy and rustdoc, warnings denied
  test                    lint, then every test, the documentation's and the studio's page's included, then what
                          `readers` does; the page wants npm and Chromium (CHROMIUM, or /usr/bin/chromium)
  readers                 programs that others wrote read back every format (installs them below the target folder)
  cases FOLDER [--draft] [NAME]...
                          a grid on every case in FOLDER's README.md table (or the named ones), as a table,
                          and what becomes of its broken files; --draft: quick grids
  bench quality [--cases FOLDER] [--quick] [NAME]...
                          the figures of all grids against their bars, into docs/quality.md unless only
                          some are named; --cases: on STEP files, --quick: one seed
  pictures [--cases FOLDER] [NAME]...
                          a plan and a perspective of each of these grids into docs/gallery, and the page
                          docs/gallery.md unless only some are named
  picture SURFACE FILE    a grid on SURFACE seen from above, as a PNG
  prove [--cases N] [--seed N] [--damaged]
                          surfaces drawn at random (or files of them, damaged) through the command: each must give a
                          valid grid or a refusal in words, within 10 processor seconds and 500 MB
  fuzz [READER]... [--minutes N]
                          damaged files for every reader (or these), 15 minutes each; needs the nightly
                          compiler and cargo-fuzz
  package                 the crates as they are published, each built from its package; wants npm
  dist                    an archive of the command for this machine, with completions, man pages, licences and
                          checksums, into the target folder; wants npm and tar";

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    let result = match args.as_slice() {
        ["lint"] => check::lint(),
        ["test"] => check::lint().and_then(|()| check::test()),
        ["readers"] => check::readers(),
        ["cases", folder, names @ ..] => cases::run(folder.as_ref(), names),
        ["picture", surface, file] => quality::picture(surface, file.as_ref()),
        ["prove", rest @ ..] => prove::Plan::parse(rest).and_then(|plan| prove::run(&plan)),
        ["fuzz", rest @ ..] => fuzz::Plan::parse(rest).and_then(|plan| fuzz::run(&plan)),
        ["package"] => package::crates(),
        ["dist"] => package::dist(),
        ["bench", "quality", rest @ ..] => Scope::parse(rest).and_then(|s| quality::bench(&s)),
        ["pictures", rest @ ..] => Scope::parse(rest).and_then(|s| quality::gallery(&s)),
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("xtask: {message}");
            ExitCode::FAILURE
        }
    }
}
