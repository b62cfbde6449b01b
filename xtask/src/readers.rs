//! Programs that others wrote read back what gridshell writes: the tests in `tests/readers`, with the versions pinned
//! there. They are installed below cargo's target folder with `python3 -m venv`, `pip` and `npm`; nothing else changes.

use crate::build::{target, tested};
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Numbers of tests.
#[derive(Clone, Copy, Debug)]
pub struct Tally {
    pub passed: usize,
    pub failed: usize,
    pub skipped: usize,
}

/// Debian packages of the libraries that OpenSees wants and its wheel lacks.
const LIBRARIES: [&str; 2] = ["libblas3", "libgfortran5"];

/// Run the tests; what is missing is an error, never a silent skip.
pub fn run() -> Result<Tally, String> {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/readers");
    let folder = target().join("readers");
    fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let folder = folder.canonicalize().map_err(|e| e.to_string())?;
    let python = python(&tests, &folder)?;
    let node = node(&tests, &folder)?;
    let libraries = libraries(&folder, &python);
    let gridshell = tested()?;

    let mut pytest = Command::new(&python);
    pytest.args(["-m", "pytest", "--quiet", "-p", "no:cacheprovider", "-rs"]).arg(&tests);
    pytest.env("GRIDSHELL", gridshell).env("GRIDSHELL_NODE", node);
    pytest.env("PYTHONDONTWRITEBYTECODE", "1").stdout(Stdio::piped());
    match libraries {
        Ok(path) => pytest.env("LD_LIBRARY_PATH", path),
        Err(reason) => {
            println!("OpenSees cannot run here and its input is only parsed: {reason}");
            pytest.env("GRIDSHELL_OPENSEES", reason)
        }
    };
    eprintln!("pytest {}", tests.display());
    let output = pytest.output().map_err(|e| format!("pytest does not start: {e}"))?;
    let text = String::from_utf8_lossy(&output.stdout);
    print!("{text}");
    let tally = tally(text.lines().last().unwrap_or_default());
    if tally.passed + tally.failed == 0 {
        return Err("the readers' tests did not run".to_owned());
    }
    Ok(tally)
}

/// The interpreter of an environment with everything in it.
fn python(tests: &Path, folder: &Path) -> Result<PathBuf, String> {
    let environment = folder.join("venv");
    let python = environment.join("bin/python");
    let wanted = tests.join("requirements.txt");
    if is_current(&wanted, folder)? && python.exists() {
        return Ok(python);
    }
    must(Command::new("python3").args(["-m", "venv", "--clear"]).arg(&environment))?;
    must(Command::new(&python).args(["-m", "pip", "install", "--quiet", "-r"]).arg(&wanted))?;
    remember(&wanted, folder)?;
    Ok(python)
}

/// The folder of the validator's modules.
fn node(tests: &Path, folder: &Path) -> Result<PathBuf, String> {
    let modules = folder.join("node_modules");
    let wanted = tests.join("package.json");
    if !is_current(&wanted, folder)? || !modules.exists() {
        fs::copy(&wanted, folder.join("package.json")).map_err(|e| e.to_string())?;
        let mut npm = Command::new("npm");
        npm.args(["install", "--no-audit", "--no-fund", "--loglevel=error"]).current_dir(folder);
        must(&mut npm)?;
        remember(&wanted, folder)?;
    }
    Ok(modules)
}

/// Where the dynamic loader finds what OpenSees wants; the error is why it cannot be had.
fn libraries(folder: &Path, python: &Path) -> Result<OsString, String> {
    let own = folder.join("lib");
    let below = own.join("usr/lib").join(format!("{}-linux-gnu", std::env::consts::ARCH));
    let paths = [below.join("blas"), below];
    let joined = std::env::join_paths(paths).map_err(|e| e.to_string())?;
    let imports = || {
        let mut import = Command::new(python);
        import.args(["-c", "import openseespy.opensees"]).env("LD_LIBRARY_PATH", &joined);
        import.stdout(Stdio::null()).stderr(Stdio::null());
        import.status().is_ok_and(|s| s.success())
    };
    if imports() {
        return Ok(joined);
    }
    fs::create_dir_all(&own).map_err(|e| e.to_string())?;
    let download =
        || must(Command::new("apt-get").arg("download").args(LIBRARIES).current_dir(&own));
    // The list of packages may be missing on a new machine.
    download()
        .or_else(|_| must(Command::new("apt-get").arg("update")).and_then(|()| download()))?;
    for entry in fs::read_dir(&own).map_err(|e| e.to_string())?.flatten() {
        if entry.path().extension().is_some_and(|e| e == "deb") {
            must(Command::new("dpkg").arg("-x").arg(entry.path()).arg(&own))?;
        }
    }
    if imports() { Ok(joined) } else { Err("openseespy cannot be imported".to_owned()) }
}

/// Whether what this file asks for has been installed.
fn is_current(wanted: &Path, folder: &Path) -> Result<bool, String> {
    let now = fs::read(wanted).map_err(|e| format!("{}: {e}", wanted.display()))?;
    Ok(fs::read(stamp(wanted, folder)).is_ok_and(|before| before == now))
}

fn remember(wanted: &Path, folder: &Path) -> Result<(), String> {
    fs::copy(wanted, stamp(wanted, folder)).map(|_| ()).map_err(|e| e.to_string())
}

fn stamp(wanted: &Path, folder: &Path) -> PathBuf {
    let name = wanted.file_name().unwrap_or_default().to_string_lossy();
    folder.join(format!("installed-{name}"))
}

/// Run it; anything but success is an error.
fn must(command: &mut Command) -> Result<(), String> {
    eprintln!("{command:?}");
    // What it prints is for people, and stdout is for results.
    let output = command.stdin(Stdio::null()).output();
    let output = output.map_err(|e| format!("{command:?} does not start: {e}"))?;
    if output.status.success() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    Err(format!("{command:?} failed: {}", said.lines().last().unwrap_or_default()))
}

/// The counts in pytest's last line, as in `1 failed, 23 passed, 2 skipped in 3.21s`.
fn tally(line: &str) -> Tally {
    let words: Vec<&str> = line.split([' ', ',']).filter(|w| !w.is_empty()).collect();
    let before = |kind: &str| {
        let at = words.iter().position(|w| *w == kind)?;
        words.get(at.checked_sub(1)?)?.parse().ok()
    };
    let count = |kind: &str| before(kind).unwrap_or(0);
    let failed = count("failed") + count("error") + count("errors");
    Tally { passed: count("passed"), failed, skipped: count("skipped") }
}

#[cfg(test)]
mod tests {
    use super::tally;

    #[test]
    fn the_last_line_of_pytest_is_understood() {
        let t = tally("1 failed, 23 passed, 2 skipped, 1 error in 3.21s");
        assert_eq!((t.passed, t.failed, t.skipped), (23, 2, 2));
        assert_eq!(tally("no tests ran in 0.01s").passed, 0);
    }
}
