//! What the designer fixes, from files: guides (polylines) and anchors (points). Metres.
//!
//! - OBJ: `v x y z` and `l i j k ...`; every `l` is a polyline. Anchors are its `v` alone.
//! - Anything else is text: one point `x y z` a line, with commas, semicolons or blanks between the numbers; a
//!   blank line begins the next polyline. A first line without any number is taken for a heading, what follows
//!   a `#` for a comment.

use super::scan::{self, Line};
use super::{READING, extension, file, text};
use crate::error::Result;
use crate::job::Job;
use glam::DVec3;
use std::path::Path;

/// More points than this are not read: guides and anchors are drawn by hand.
const MOST_POINTS: usize = 100_000;

/// The polylines in a file.
///
/// # Errors
/// [`Error::Parse`](crate::Error::Parse) with the line; a file without a polyline is one, too.
pub fn read_guides(path: &Path, job: &Job) -> Result<Vec<Vec<DVec3>>> {
    let bytes = file::read(path, job)?;
    let text = text::decode(&bytes);
    let guides =
        if extension(path) == "obj" { obj(path, &text, job)?.1 } else { plain(path, &text, job)? };
    job.check(READING)?;
    if guides.is_empty() {
        return Err(scan::error(path, "whole file", "there is no polyline in it"));
    }
    Ok(guides)
}

/// The points in a file.
///
/// # Errors
/// As [`read_guides`].
pub fn read_anchors(path: &Path, job: &Job) -> Result<Vec<DVec3>> {
    let bytes = file::read(path, job)?;
    let text = text::decode(&bytes);
    let anchors: Vec<DVec3> = if extension(path) == "obj" {
        obj(path, &text, job)?.0
    } else {
        points(path, &text, job)?.into_iter().map(|p| p.1).collect()
    };
    job.check(READING)?;
    if anchors.is_empty() {
        return Err(scan::error(path, "whole file", "there is no point in it"));
    }
    Ok(anchors)
}

/// Points and polylines of an OBJ file.
fn obj(path: &Path, text: &str, job: &Job) -> Result<(Vec<DVec3>, Vec<Vec<DVec3>>)> {
    let (mut points, mut guides) = (Vec::new(), Vec::new());
    for line in scan::lines(path, text, job) {
        let mut words = line.text.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                points.push(line.point(&mut words)?);
                check_count(&line, points.len())?;
            }
            Some("l") => {
                let guide: Result<Vec<DVec3>> = words
                    .map(|word| Ok(points[scan::vertex(&line, word, [points.len(); 2])? as usize]))
                    .collect();
                let guide = guide?;
                if guide.len() < 2 {
                    return Err(line.error("a polyline needs two points or more"));
                }
                guides.push(guide);
            }
            _ => {}
        }
    }
    Ok((points, guides))
}

/// Polylines of a plain text: runs of points on lines that follow one another.
fn plain(path: &Path, text: &str, job: &Job) -> Result<Vec<Vec<DVec3>>> {
    let points = points(path, text, job)?;
    // The last run of a file that was not read to its end may be short.
    job.check(READING)?;
    let mut guides = Vec::new();
    for run in points.chunk_by(|a, b| b.0.number_in_file() == a.0.number_in_file() + 1) {
        if run.len() < 2 {
            return Err(run[0]
                .0
                .error("a polyline needs two points or more, on lines that follow one another"));
        }
        guides.push(run.iter().map(|p| p.1).collect());
    }
    Ok(guides)
}

fn points<'a>(path: &'a Path, text: &'a str, job: &'a Job) -> Result<Vec<(Line<'a>, DVec3)>> {
    let mut points = Vec::new();
    for line in scan::lines(path, text, job) {
        let mut words = line.text.split([',', ';', ' ', '\t']).filter(|w| !w.is_empty());
        let is_heading = points.is_empty() && words.clone().all(|w| w.parse::<f64>().is_err());
        if is_heading && line.number_in_file() == 1 {
            continue;
        }
        let point = line.point(&mut words)?;
        if let Some(word) = words.next() {
            let word = scan::clip(word);
            return Err(line.error(format!("`{word}` follows the three coordinates x y z")));
        }
        points.push((line, point));
        check_count(&line, points.len())?;
    }
    Ok(points)
}

fn check_count(line: &Line, count: usize) -> Result<()> {
    if count <= MOST_POINTS {
        return Ok(());
    }
    Err(line.error(format!("more than {MOST_POINTS} points; give fewer")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    fn guides(name: &str, text: &str) -> std::result::Result<Vec<Vec<DVec3>>, String> {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let own = (std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(format!("gridshell-{}-{}-{name}", own.0, own.1));
        std::fs::write(&path, text).unwrap();
        let said = |e: crate::Error| e.to_string().replace(&path.display().to_string(), name);
        let read = read_guides(&path, &Job::default()).map_err(said);
        std::fs::remove_file(&path).unwrap();
        read
    }

    #[test]
    fn lines_of_an_obj_are_polylines() {
        let read = guides("g.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\nl -1 1\n").unwrap();
        assert_eq!(
            read,
            [
                vec![DVec3::ZERO, DVec3::X, DVec3::new(1., 1., 0.)],
                vec![DVec3::new(1., 1., 0.), DVec3::ZERO]
            ]
        );
    }

    #[test]
    fn blank_lines_part_the_polylines_of_a_text() {
        let read = guides("g.csv", "x,y,z\n0,0,0\n1,0,0 # end\n\n1;1;0\n0 0 1\n").unwrap();
        assert_eq!(read, [[DVec3::ZERO, DVec3::X], [DVec3::new(1., 1., 0.), DVec3::Z]]);
    }

    #[test]
    fn errors_name_the_line() {
        let said = |name, text| guides(name, text).unwrap_err();
        assert!(said("g.csv", "0,0,0\n1,b,0\n").starts_with("g.csv: line 2: `b`"));
        assert!(said("g.csv", "0,0,0\n1,0\n").starts_with("g.csv: line 2: a coordinate (z)"));
        assert!(said("g.csv", "0,0,0\n1,0,0,4\n").starts_with("g.csv: line 2: `4` follows"));
        assert!(
            said("g.csv", "0,0,0\n1,0,inf\n").starts_with("g.csv: line 2: a coordinate is not")
        );
        assert!(said("g.csv", "0,0,0\n\n1,0,0\n2,0,0\n").starts_with("g.csv: line 1: a polyline"));
        assert!(said("g.obj", "v 0 0 0\nl 1 2\n").starts_with("g.obj: line 2: "));
        assert!(said("g.obj", "v 0 0 0\n").contains("no polyline"));
    }
}
