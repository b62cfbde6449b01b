//! What is given to others: the crates, and an archive of the command.

use crate::build::{cargo, gridshell, target};
use crate::{licences, page};
use sha2::{Digest, Sha256};
use std::env::consts::EXE_SUFFIX;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What the archive has from the top of the repository.
const PAPERS: [&str; 4] = ["README.md", "CHANGELOG.md", "LICENSE-MIT", "LICENSE-APACHE"];

/// The crates as they are published. The studio's has the built page inside, which cargo takes for a change that is
/// not committed: so changes are looked for here.
pub fn crates() -> Result<(), String> {
    let changed = output("git", &["status", "--porcelain"])?;
    if !changed.is_empty() {
        return Err(format!("packages are made of what is committed; changed are\n{changed}"));
    }
    page::build()?;
    cargo(&["package", "--workspace", "--exclude", "xtask", "--allow-dirty"], &[])
}

/// An archive with the command for this machine and all that belongs to it, and its checksum beside it.
pub fn dist() -> Result<(), String> {
    // First, as a command without its page is not for others.
    page::build()?;
    let command = gridshell()?;
    let triple = triple()?;
    let name = format!("gridshell-{}-{triple}", env!("CARGO_PKG_VERSION"));
    let dist = target().join("dist");
    let folder = dist.join(&name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("bin")).map_err(|e| told(&folder, &e))?;
    let copy = |from: &Path, to: &str| {
        fs::copy(from, folder.join(to)).map(|_| ()).map_err(|e| told(from, &e))
    };
    copy(&command, &format!("bin/gridshell{EXE_SUFFIX}"))?;
    output(&command.to_string_lossy(), &["manual", &folder.to_string_lossy()])?;
    for paper in PAPERS {
        copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(paper), paper)?;
    }
    let page = fs::read_to_string(page::licences()).map_err(|e| told(&page::licences(), &e))?;
    let all = licences::of_dependencies(&triple)? + "\nThe studio's page:\n\n" + &page;
    write(&folder.join("LICENCES-OF-DEPENDENCIES.txt"), &all)?;
    write(&folder.join("SHA256SUMS"), &checksums(&folder)?)?;
    let archive = format!("{name}.tar.gz");
    output(
        "tar",
        &["-czf", &dist.join(&archive).to_string_lossy(), "-C", &dist.to_string_lossy(), &name],
    )?;
    let sum = checksum(&dist.join(&archive))?;
    write(&dist.join(format!("{archive}.sha256")), &format!("{sum}  {archive}\n"))?;
    println!("wrote {}", dist.join(archive).display());
    Ok(())
}

/// What the compiler calls this machine.
fn triple() -> Result<String, String> {
    let version = output("rustc", &["-vV"])?;
    let host = version.lines().find_map(|line| line.strip_prefix("host: "));
    host.map(str::to_owned).ok_or_else(|| "rustc names no host".to_owned())
}

/// SHA-256 of every file below a folder, as `sha256sum --check` reads them.
fn checksums(folder: &Path) -> Result<String, String> {
    let mut files = Vec::new();
    collect(folder, "", &mut files).map_err(|e| told(folder, &e))?;
    files.sort();
    let lines = files.iter().map(|(name, path)| Ok(format!("{}  {name}\n", checksum(path)?)));
    lines.collect()
}

fn collect(folder: &Path, prefix: &str, files: &mut Vec<(String, PathBuf)>) -> std::io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let name = format!("{prefix}{name}");
        if path.is_dir() {
            collect(&path, &format!("{name}/"), files)?;
        } else {
            files.push((name, path));
        }
    }
    Ok(())
}

fn checksum(file: &Path) -> Result<String, String> {
    let bytes = fs::read(file).map_err(|e| told(file, &e))?;
    let mut digits = String::new();
    for byte in Sha256::digest(bytes) {
        let _ = write!(digits, "{byte:02x}");
    }
    Ok(digits)
}

fn write(file: &Path, text: &str) -> Result<(), String> {
    fs::write(file, text).map_err(|e| told(file, &e))
}

/// What a program prints.
fn output(program: &str, arguments: &[&str]) -> Result<String, String> {
    let output = Command::new(program).args(arguments).output();
    let output = output.map_err(|e| format!("{program} does not start: {e}"))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    Err(format!("{program} failed: {}", String::from_utf8_lossy(&output.stderr).trim()))
}

fn told(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {error}", path.display())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checksums_are_those_of_every_file_below() {
        let folder = target().join("tmp-checksums");
        fs::create_dir_all(folder.join("b")).unwrap();
        fs::write(folder.join("b/c"), "abc").unwrap();
        fs::write(folder.join("a"), "").unwrap();
        let sums = checksums(&folder).unwrap();
        fs::remove_dir_all(&folder).unwrap();
        let empty = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
        let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(sums, format!("{empty}  a\n{abc}  b/c\n"));
    }
}
