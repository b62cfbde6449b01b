//! Builds the page into the program: a copy of its sources in the output folder, so that the source tree stays clean.
//! The packaged crate has the built page instead of the sources, and needs no Node.
//!
//! Without npm, or where its packages cannot be had, the program is built without the page and says so when it is
//! opened. With `CARGO_NET_OFFLINE=true` only npm's own cache is asked; `GRIDSHELL_NO_PAGE` leaves the page out.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{env, fs, io};

/// What the page is made of.
const SOURCES: [&str; 6] =
    ["index.html", "package.json", "package-lock.json", "tsconfig.json", "vite.config.ts", "src"];

fn main() {
    let packaged = !Path::new("page/package.json").exists();
    if packaged {
        println!("cargo::rerun-if-changed=page/dist");
    } else {
        for source in SOURCES {
            println!("cargo::rerun-if-changed=page/{source}");
        }
    }
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-env-changed=GRIDSHELL_NO_PAGE");
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets it"));
    let built = if env::var_os("GRIDSHELL_NO_PAGE").is_some() {
        Err("GRIDSHELL_NO_PAGE is set".to_owned())
    } else if packaged {
        Ok(packed().expect("the package has the built page: `cargo xtask package` makes it"))
    } else {
        build(Path::new("page"), &out.join("page"))
    };
    let files = built.unwrap_or_else(|reason| {
        println!("cargo::warning=the studio is built without its page: {reason}");
        Vec::new()
    });
    let mut list = String::from("static FILES: &[(&str, &[u8])] = &[\n");
    for (name, path) in files {
        let path = path.display().to_string();
        let _ = writeln!(list, "    ({name:?}, include_bytes!({path:?})),");
    }
    list += "];\n";
    fs::write(out.join("page.rs"), list).expect("the output folder can be written to");
}

/// The files of the page that was built before packaging, by name and path.
fn packed() -> io::Result<Vec<(String, PathBuf)>> {
    let mut files = Vec::new();
    collect(&env::current_dir()?.join("page/dist"), "", &mut files)?;
    files.sort();
    Ok(files)
}

/// The page's files, by name and path.
fn build(from: &Path, to: &Path) -> Result<Vec<(String, PathBuf)>, String> {
    let told = |e: io::Error| e.to_string();
    let lock = fs::read(from.join("package-lock.json")).map_err(told)?;
    let stamp = to.join("installed.lock");
    let installed = fs::read(&stamp).is_ok_and(|old| old == lock);
    for source in SOURCES {
        if source == "src" {
            let _ = fs::remove_dir_all(to.join(source));
        }
        copy(&from.join(source), &to.join(source)).map_err(told)?;
    }
    if !installed {
        let _ = fs::remove_file(&stamp);
        let mut arguments =
            vec!["ci", "--no-audit", "--no-fund", "--fetch-retries=0", "--fetch-timeout=20000"];
        let offline = env::var("CARGO_NET_OFFLINE").is_ok_and(|v| v == "true");
        arguments.push(if offline { "--offline" } else { "--prefer-offline" });
        npm(to, &arguments)?;
        fs::write(&stamp, lock).map_err(told)?;
    }
    let _ = fs::remove_dir_all(to.join("dist"));
    npm(to, &["run", "build"])?;
    let mut files = Vec::new();
    collect(&to.join("dist"), "", &mut files).map_err(told)?;
    files.sort();
    Ok(files)
}

fn npm(folder: &Path, arguments: &[&str]) -> Result<(), String> {
    let program = if cfg!(windows) { "npm.cmd" } else { "npm" };
    let output = Command::new(program)
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .map_err(|_| "npm is missing; it comes with Node 20.19 or newer".to_owned())?;
    if output.status.success() {
        return Ok(());
    }
    let all = [output.stdout, output.stderr].concat();
    let all = String::from_utf8_lossy(&all);
    let lines: Vec<&str> = all.lines().filter(|l| !l.trim().is_empty()).collect();
    let last = lines[lines.len().saturating_sub(4)..].join(" | ");
    Err(format!("npm {} failed: {last}", arguments[0]))
}

fn copy(from: &Path, to: &Path) -> io::Result<()> {
    if !from.is_dir() {
        return fs::create_dir_all(to.parent().unwrap_or(to))
            .and_then(|()| fs::copy(from, to))
            .map(|_| ());
    }
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        copy(&entry.path(), &to.join(entry.file_name()))?;
    }
    Ok(())
}

fn collect(folder: &Path, prefix: &str, files: &mut Vec<(String, PathBuf)>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
        if entry.path().is_dir() {
            collect(&entry.path(), &format!("{name}/"), files)?;
        } else {
            files.push((name, entry.path()));
        }
    }
    Ok(())
}
