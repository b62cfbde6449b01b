//! The global section: delimiters, unit of length, resolution, application.

use super::Fault;
use super::records::Records;
use super::tokens::{Delimiters, Field, fields};

/// What the global section says.
pub(super) struct Global {
    pub marks: Delimiters,
    /// One unit of the model in metres, its scale included.
    pub metres: f64,
    /// Smallest distance that counts, in units of the model; 0 where it is not given.
    pub resolution: f64,
    /// The program that wrote the file.
    pub application: String,
    /// The unit was not named.
    pub unit_guessed: bool,
}

/// Read the global section.
pub(super) fn read(records: &Records) -> Result<Global, Fault> {
    let at = format!("line {}", records.global_line);
    let fault = |what: &str| Fault::new(&at, format!("the global section: {what}"));
    if records.global.is_empty() {
        return Err(Fault::new("file", "the global section is missing"));
    }
    let (marks, rest) =
        delimiters(&records.global).ok_or_else(|| fault("it names no delimiters"))?;
    let fields = fields(rest, marks).map_err(|what| fault(&what))?;
    // Fields count from 1, and two of them were the delimiters.
    let field = |k: usize| fields.get(k - 3).unwrap_or(&Field::Empty);
    let number = |k: usize| match field(k) {
        Field::Number(x) => Some(*x),
        _ => None,
    };
    let text = |k: usize| match field(k) {
        Field::Text(t) => t.trim().to_owned(),
        _ => String::new(),
    };
    let unit = unit(number(14), &text(15));
    let scale = number(13).filter(|s| *s > 0.0).unwrap_or(1.0);
    let metres = unit.unwrap_or(0.001) / scale;
    if !(1e-9..=1e6).contains(&metres) {
        return Err(fault("its scale makes no sensible unit of length"));
    }
    let resolution = number(19).filter(|r| *r > 0.0).unwrap_or(0.0);
    let words = |k: usize| text(k).split_whitespace().collect::<Vec<_>>().join(" ");
    let application = if words(5).is_empty() { words(6) } else { words(5) };
    Ok(Global { marks, metres, resolution, application, unit_guessed: unit.is_none() })
}

/// The two delimiters, each given as `1Hx` or left out, and what follows.
fn delimiters(global: &[u8]) -> Option<(Delimiters, &[u8])> {
    let skip = |from: usize| from + global[from..].iter().take_while(|&&b| b == b' ').count();
    let mut at = skip(0);
    let mut field = b',';
    if global.get(at..at + 2)? == b"1H" {
        field = *global.get(at + 2)?;
        at = skip(at + 3);
    }
    if global.get(at) != Some(&field) {
        return None;
    }
    at = skip(at + 1);
    let mut record = b';';
    if global.get(at..at + 2)? == b"1H" {
        record = *global.get(at + 2)?;
        at = skip(at + 3);
    }
    if global.get(at) != Some(&field) || field == record {
        return None;
    }
    Some((Delimiters { field, record }, &global[at + 1..]))
}

/// A unit in metres, by its flag, or where that is 3 by its name.
fn unit(flag: Option<f64>, name: &str) -> Option<f64> {
    const NAMES: [(&str, f64); 15] = [
        ("IN", 1.0),
        ("INCH", 1.0),
        ("MM", 2.0),
        ("FT", 4.0),
        ("FOOT", 4.0),
        ("FEET", 4.0),
        ("MI", 5.0),
        ("M", 6.0),
        ("METER", 6.0),
        ("METRE", 6.0),
        ("KM", 7.0),
        ("MIL", 8.0),
        ("UM", 9.0),
        ("CM", 10.0),
        ("UIN", 11.0),
    ];
    let by_name = || {
        let name = name.to_ascii_uppercase();
        NAMES.iter().find(|n| n.0 == name).map(|n| n.1)
    };
    let flag = flag.filter(|f| *f != 3.0).or_else(by_name)?;
    match flag as i64 {
        1 => Some(0.0254),
        2 => Some(1e-3),
        4 => Some(0.3048),
        5 => Some(1609.344),
        6 => Some(1.0),
        7 => Some(1e3),
        8 => Some(2.54e-5),
        9 => Some(1e-6),
        10 => Some(0.01),
        11 => Some(2.54e-8),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn delimiters_are_given_or_usual() {
        let usual = Delimiters { field: b',', record: b';' };
        assert_eq!(delimiters(b",,3Habc,"), Some((usual, &b"3Habc,"[..])));
        assert_eq!(delimiters(b"1H,,1H;,x"), Some((usual, &b"x"[..])));
        let other = Delimiters { field: b'/', record: b'#' };
        assert_eq!(delimiters(b"1H//1H#/x"), Some((other, &b"x"[..])));
        assert_eq!(delimiters(b"1H"), None);
        assert_eq!(delimiters(b"garbage"), None);
    }

    #[test]
    fn units_go_by_flag_and_by_name() {
        assert_eq!(unit(Some(2.0), "M"), Some(1e-3));
        assert_eq!(unit(Some(3.0), "cm"), Some(0.01));
        assert_eq!(unit(None, "INCH"), Some(0.0254));
        assert_eq!(unit(Some(77.0), "M"), None);
    }
}
