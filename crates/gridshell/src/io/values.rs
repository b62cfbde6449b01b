//! Tables of values at points: CSV, one point a line, numbers separated by commas, semicolons or blanks; a first line
//! of words is a header. What follows `#` is a comment.

use super::{file, scan};
use crate::error::Result;
use crate::job::Job;
use std::path::Path;

/// More points than this are no table of wishes.
const MOST_POINTS: usize = 1_000_000;

/// Read wanted lengths at points: `x, y, z, length`, metres.
///
/// # Errors
/// [`Error::Io`](crate::Error::Io), [`Error::Parse`](crate::Error::Parse) with the line.
pub fn read_lengths(path: &Path, job: &Job) -> Result<Vec<[f64; 4]>> {
    let positive = |row: &[f64; 4]| {
        if row[3] > 0.0 {
            return Ok(());
        }
        Err(format!("the length is {}: it must be positive", row[3]))
    };
    read(path, ["x", "y", "z", "length"], positive, job)
}

/// Read wanted directions at points: `x, y, z, dx, dy, dz`.
///
/// # Errors
/// As [`read_lengths`].
pub fn read_directions(path: &Path, job: &Job) -> Result<Vec<[f64; 6]>> {
    let nonzero = |row: &[f64; 6]| {
        if row[3..].iter().any(|&d| d != 0.0) {
            return Ok(());
        }
        Err("the vector is zero: a direction must be longer".to_owned())
    };
    read(path, ["x", "y", "z", "dx", "dy", "dz"], nonzero, job)
}

fn read<const N: usize>(
    path: &Path,
    names: [&str; N],
    check: impl Fn(&[f64; N]) -> std::result::Result<(), String>,
    job: &Job,
) -> Result<Vec<[f64; N]>> {
    let bytes = file::read(path, job)?;
    let text = String::from_utf8_lossy(&bytes);
    let parts = |c: char| c == ',' || c == ';' || c.is_whitespace();
    let mut rows = Vec::new();
    for (k, line) in scan::lines(path, &text, job).enumerate() {
        let words: Vec<&str> = line.text.split(parts).filter(|w| !w.is_empty()).collect();
        if k == 0 && words.iter().all(|w| w.parse::<f64>().is_err()) {
            continue;
        }
        if words.len() != N {
            let all = names.join(", ");
            return Err(line.error(format!("{N} numbers are wanted here: {all}")));
        }
        let mut row = [0.0_f64; N];
        for ((value, word), name) in row.iter_mut().zip(&words).zip(names) {
            *value = line.number(Some(word), &format!("a number ({name})"))?;
            if !value.is_finite() {
                return Err(line.error(format!("{name} is not finite")));
            }
        }
        check(&row).map_err(|message| line.error(message))?;
        rows.push(row);
        if rows.len() > MOST_POINTS {
            return Err(line.error("too many points: thin them out"));
        }
    }
    if rows.is_empty() {
        let all = names.join(", ");
        return Err(scan::error(path, "end of file", format!("there is no point in it: {all}")));
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lengths(name: &str, text: &str) -> Result<Vec<[f64; 4]>> {
        let path = std::env::temp_dir().join(format!("gridshell-{}-{name}", std::process::id()));
        std::fs::write(&path, text).expect("temporary files can be written");
        let rows = read_lengths(&path, &Job::default());
        std::fs::remove_file(&path).expect("it was just written");
        rows
    }

    #[test]
    fn a_header_commas_and_comments_are_understood() {
        let text = "x,y,z,length\n0,0,0,1.5\n# between\n1; 2; 3; 2e0 # two\r\n\n4 5 6 7\n";
        let rows = lengths("good.csv", text).expect("all is well");
        assert_eq!(rows, [[0.0, 0.0, 0.0, 1.5], [1.0, 2.0, 3.0, 2.0], [4.0, 5.0, 6.0, 7.0]]);
    }

    #[test]
    fn whatever_is_wrong_is_told_with_its_line() {
        for (text, told) in [
            ("0,0,0,1\n0,0,1\n", "line 2: 4 numbers"),
            ("x,y,z,l\n0,0,0,-1\n", "line 2: the length is -1"),
            ("0,0,0,nan\n", "line 1: length is not finite"),
            ("0,0,0,1\nx,y,z,l\n", "line 2: `x` is not a number (x)"),
            ("x,y,z,l\n", "no point in it"),
        ] {
            let error = lengths("bad.csv", text).expect_err(text).to_string();
            assert!(error.contains(told) && error.contains("bad.csv"), "{error}");
        }
    }
}
