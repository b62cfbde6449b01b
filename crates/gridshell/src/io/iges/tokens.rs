//! Free-format fields: numbers and Hollerith strings between delimiters.

/// One field.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Field {
    /// Left out: its default counts.
    Empty,
    Number(f64),
    Text(String),
}

/// The characters between fields and after the last one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Delimiters {
    pub field: u8,
    pub record: u8,
}

/// The fields from `bytes` up to the end of the record. What is wrong where there is none, or a field is neither
/// number nor string.
pub(super) fn fields(bytes: &[u8], marks: Delimiters) -> Result<Vec<Field>, String> {
    let mut fields = Vec::new();
    let mut at = 0;
    loop {
        let start = at;
        while at < bytes.len() && bytes[at] == b' ' {
            at += 1;
        }
        let digits = at;
        while at < bytes.len() && bytes[at].is_ascii_digit() {
            at += 1;
        }
        if at > digits && bytes.get(at) == Some(&b'H') {
            let count = number(&bytes[digits..at]).filter(|c| *c < 1e9).unwrap_or(f64::MAX);
            let from = at + 1;
            let rest = bytes.len() - from;
            if count > rest as f64 {
                return Err(format!("a string of {count} characters runs past the end"));
            }
            let to = from + count as usize;
            fields.push(Field::Text(String::from_utf8_lossy(&bytes[from..to]).into_owned()));
            at = to;
            while at < bytes.len() && bytes[at] == b' ' {
                at += 1;
            }
        } else {
            at = start;
            while at < bytes.len() && bytes[at] != marks.field && bytes[at] != marks.record {
                at += 1;
            }
            fields.push(plain(&bytes[start..at])?);
        }
        match bytes.get(at) {
            Some(b) if *b == marks.record => return Ok(fields),
            Some(b) if *b == marks.field => at += 1,
            Some(_) => return Err("something follows a string before the next delimiter".into()),
            None => return Err("its record does not end".into()),
        }
    }
}

/// A field that is not a string.
fn plain(bytes: &[u8]) -> Result<Field, String> {
    if bytes.iter().all(|&b| b == b' ') {
        return Ok(Field::Empty);
    }
    number(bytes).map(Field::Number).ok_or_else(|| {
        let shown: String =
            bytes.iter().take(24).flat_map(|&b| char::from(b).escape_default()).collect();
        format!("`{}` is not a number", shown.trim())
    })
}

/// A number, whose exponent may be marked D as Fortran has it.
pub(super) fn number(bytes: &[u8]) -> Option<f64> {
    let text: String = bytes
        .iter()
        .filter(|&&b| b != b' ')
        .map(|&b| if b == b'D' || b == b'd' { 'E' } else { char::from(b) })
        .collect();
    text.parse().ok().filter(|x: &f64| x.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    const MARKS: Delimiters = Delimiters { field: b',', record: b';' };

    #[test]
    fn strings_may_hold_delimiters_and_numbers_fortran_exponents() {
        let f = fields(b"128, 4Ha,;b,,1.5D-2, -3;", MARKS).unwrap();
        let text = Field::Text("a,;b".into());
        let want =
            [Field::Number(128.0), text, Field::Empty, Field::Number(0.015), Field::Number(-3.0)];
        assert_eq!(f, want);
    }

    #[test]
    fn strings_and_records_without_end_are_refused() {
        for text in ["1,2,3", "99999999999999999999Hab;", "5Habc;", "1,x;", "2Habc;", "1,nan;", ""]
        {
            assert!(fields(text.as_bytes(), MARKS).is_err(), "{text}");
        }
    }
}
