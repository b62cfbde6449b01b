//! The records of an IGES file: lines of 80 columns, sorted into sections.

use super::Fault;

/// What is wrong with a file that was saved in another form.
const OTHER_FORM: &str =
    "the file is not in the ASCII form of fixed 80 columns; save it in that form";

/// The sections of a file. Line numbers count from 1.
pub(super) struct Records {
    /// Columns 1 to 72 of the global section, joined.
    pub global: Vec<u8>,
    /// Line of the first record of the global section.
    pub global_line: usize,
    /// Directory records and their lines.
    pub directory: Vec<(Vec<u8>, usize)>,
    /// Columns 1 to 64 of the parameter records and their lines.
    pub parameters: Vec<(Vec<u8>, usize)>,
    /// Whether the terminate section is there.
    pub ended: bool,
    /// Number of the last line.
    pub last_line: usize,
}

/// Sort the lines of `bytes` into sections.
pub(super) fn read(bytes: &[u8]) -> Result<Records, Fault> {
    let mut records = Records {
        global: Vec::new(),
        global_line: 0,
        directory: Vec::new(),
        parameters: Vec::new(),
        ended: false,
        last_line: 0,
    };
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(Fault::new("file", "it is empty"));
    }
    for (i, line) in lines(bytes).enumerate() {
        let number = i + 1;
        if records.ended || line.iter().all(u8::is_ascii_whitespace) {
            continue;
        }
        records.last_line = number;
        let at = format!("line {number}");
        let Some(&section) = line.get(72) else {
            if number == 1 {
                return Err(Fault::new(
                    &at,
                    "not an IGES file: its first line ends before column 73",
                ));
            }
            return Err(Fault::new(
                &at,
                "the line ends before column 73: the file is cut off; export it again",
            ));
        };
        match section {
            b'S' => {}
            b'G' => {
                if records.global.is_empty() {
                    records.global_line = number;
                }
                records.global.extend(&line[..72]);
            }
            b'D' => records.directory.push((line[..72].to_vec(), number)),
            b'P' => records.parameters.push((line[..64].to_vec(), number)),
            b'T' => records.ended = true,
            b'C' | b'B' if number == 1 => return Err(Fault::new(&at, OTHER_FORM)),
            _ if number == 1 => {
                return Err(Fault::new(
                    &at,
                    "not an IGES file: column 73 of its first line is not S",
                ));
            }
            other => {
                let shown = char::from(other).escape_default();
                return Err(Fault::new(
                    &at,
                    format!("column 73 holds `{shown}`, none of S, G, D, P and T"),
                ));
            }
        }
    }
    if records.directory.is_empty() {
        return Err(Fault::new(
            &format!("line {}", records.last_line),
            "the file ends before its directory",
        ));
    }
    if !records.directory.len().is_multiple_of(2) {
        let line = records.directory[records.directory.len() - 1].1;
        return Err(Fault::new(&format!("line {line}"), "the directory ends within an entry"));
    }
    Ok(records)
}

/// Lines without their ends; pieces of 80 where the file has none.
fn lines(bytes: &[u8]) -> Box<dyn Iterator<Item = &[u8]> + '_> {
    let looks = &bytes[..bytes.len().min(200)];
    if bytes.len() >= 160 && !looks.iter().any(|&b| b == b'\n' || b == b'\r') {
        return Box::new(bytes.chunks(80));
    }
    let old = !looks.contains(&b'\n');
    let end = move |b: &u8| if old { *b == b'\r' } else { *b == b'\n' };
    Box::new(bytes.split(end).map(|l| l.strip_suffix(b"\r").unwrap_or(l)))
}
